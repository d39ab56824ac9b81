"""What ssilang/kernel/stepping refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "force-added-during-calculation": Message(
        "a force added during the calculation is not a finite number",
        "une force ajoutée pendant le calcul n'est pas un nombre fini",
    ),
    "force-added-during-calculation-2": Message(
        "a force added during the calculation has {lost}, which the matrices lack",
        "une force ajoutée pendant le calcul a {lost}, absent des matrices",
    ),
    "tolerance-reduction": Message(
        "the tolerance of the reduction is {tolerance:g}",
        "la tolérance de la réduction est {tolerance:g}",
        "between 0 and 1",
        "entre 0 et 1",
    ),
    "mass-matrix-singular-no": Message(
        "the mass matrix is singular: no initial acceleration can be found",
        "la matrice de masse est singulière : l'accélération initiale ne peut être trouvée",
    ),
    "newmark-scheme-beta-gamma": Message(
        "Newmark's scheme with beta = {beta:g}, gamma = {gamma:g} is not unconditionally stable",
        "le schéma de Newmark avec beta = {beta:g}, gamma = {gamma:g} n'est pas "
        "inconditionnellement stable",
        "gamma >= 0.5 and beta >= gamma/2",
        "gamma >= 0.5 et beta >= gamma/2",
    ),
    "hht-parameter-range": Message(
        "the HHT parameter {alpha:g} is out of range",
        "le paramètre HHT {alpha:g} est hors de son intervalle",
        "0 <= ALPHA_F <= 1/3",
        "0 <= ALPHA_F <= 1/3",
    ),
    "spectral-radius-range": Message(
        "the spectral radius {rho_inf:g} is out of range",
        "le rayon spectral {rho_inf:g} est hors de son intervalle",
        "0 <= RHO_INF <= 1",
        "0 <= RHO_INF <= 1",
    ),
    "relation-too-many-unknowns": Message(
        "a relation with too many unknowns cannot be eliminated from a time-stepping problem",
        "une relation de trop d'inconnues ne peut être éliminée d'un calcul pas à pas",
        "split it, or write it on fewer unknowns",
        "coupez-la, ou écrivez-la sur moins d'inconnues",
    ),
    "relations-leave-motions-duals": Message(
        "the relations leave {n_T} motions, their duals {n_V}",
        "les relations laissent {n_T} mouvements, leurs duales {n_V}",
        "give each relation and its dual independent rows",
        "donnez à chaque relation et à sa duale des lignes indépendantes",
    ),
    "conditions-contradict-cannot-take": Message(
        "conditions contradict each other: one on {names} cannot take the value {d:.6g}",
        "des blocages se contredisent : l'un, sur {names}, ne peut prendre la valeur {d:.6g}",
        "the same unknown is imposed twice with different values",
        "la même inconnue est imposée deux fois, avec des valeurs différentes",
    ),
    "adapted-steps-condensed-interface": Message(
        "adapted steps are those of the condensed interface",
        "les pas adaptés sont ceux de l'interface condensée",
        "leave the conserving step and full Newton",
        "renoncez au pas conservatif et au Newton complet",
    ),
    "times-calculation-must-least": Message(
        "the times of a calculation must be at least two and strictly increase",
        "les instants d'un calcul sont deux au moins et croissent strictement",
    ),
    "step-too-short": Message(
        "a time step of {step} s is too short to calculate with",
        "un pas de temps de {step} s est trop petit pour un calcul",
        "look at the list of times",
        "regardez la liste des instants",
    ),
    "initial-field-values-not": Message(
        "an initial field has values that are not finite numbers",
        "un champ initial a des valeurs qui ne sont pas des nombres finis",
    ),
    "matrix-values-not-finite": Message(
        "the matrix {name} has values that are not finite numbers",
        "la matrice {name} a des valeurs qui ne sont pas des nombres finis",
    ),
    "load-curve-values-not": Message(
        "a load curve has values that are not finite numbers",
        "une courbe de charge a des valeurs qui ne sont pas des nombres finis",
    ),
    "step-cannot-saved": Message(
        "one step in {cadence} cannot be saved",
        "un pas sur {cadence} ne peut être sauvé",
        "a cadence of 1 or more",
        "une cadence de 1 ou plus",
    ),
    "time-save-lies-outside": Message(
        "the time {t:g} to save lies outside the calculation, {times:g} to {times_2:g}",
        "le temps {t:g} à sauver est hors du calcul, de {times:g} à {times_2:g}",
    ),
    "load-matrices-lack": Message(
        "the load {name} has {lost}, which the matrices lack",
        "la charge {name} a {lost}, que les matrices n'ont pas",
        "forces act on nodes and unknowns of the model",
        "les forces agissent sur des noeuds et des inconnues du modèle",
    ),
    "motion-grew": Message(
        "step {step}, time {time:g}: the motion grew beyond all numbers",
        "pas {step}, temps {time:g} : le mouvement a dépassé tout nombre",
        "check loads, units and the step",
        "vérifiez le chargement, les unités et le pas",
    ),
    "interface-not-converged": Message(
        "step {step}, time {time:g}: the interface iteration did not converge (residual "
        "{residual:.1e} of the jump after {turns} {turns:turn|turns})",
        "pas {step}, temps {time:g} : l'itération de l'interface n'a pas convergé (résidu "
        "{residual:.1e} du saut après {turns} {turns:tour|tours})",
        "a smaller step, or softer joints",
        "un pas plus petit, ou des joints plus souples",
    ),
    "krylov-exhausted": Message(
        "the Krylov space is exhausted",
        "l'espace de Krylov est épuisé",
    ),
    "reduction-inexact": Message(
        "{reason} (estimated error {estimate:.1e})",
        "{reason} (erreur estimée {estimate:.1e})",
    ),
    "damping-not-symmetric": Message(
        "the damping is not symmetric",
        "l'amortissement n'est pas symétrique",
    ),
    "massless-body-on-joints": Message(
        "a body without mass is held by joints alone",
        "un corps sans masse n'est tenu que par des joints",
    ),
    "vectors-not-enough": Message(
        "{n_vectors} {n_vectors:vector does|vectors do} not reach the tolerance",
        "{n_vectors} {n_vectors:vecteur n'atteint|vecteurs n'atteignent} pas la tolérance",
    ),
    "supports-move-by-too-many": Message(
        "supports move by more than {most} curves",
        "les appuis bougent suivant plus de {most} courbes",
    ),
    "initial-motion-of-supports": Message(
        "the initial motion is not the one that the supports impose",
        "le mouvement initial n'est pas celui que les appuis imposent",
    ),
    "motions-without-mass": Message(
        "the matrix is singular, with {count} {count:free motion|free motions}{motions:? "
        "({motions:;})}",
        "la matrice est singulière : {count} {count:mouvement libre|mouvements "
        "libres}{motions:? ({motions:;})}",
        "not held: {free}{more:? and {more} more}{apart:?; {apart} {apart:node lies on a "
        "node|nodes lie on nodes} of another body}; hold it, or give it mass",
        "non tenu : {free}{more:? et {more} {more:autre|autres}}{apart:? ; {apart} "
        "{apart:noeud est sur celui|noeuds sont sur ceux} d'un autre corps} ; tenez-le, ou "
        "donnez-lui une masse",
    ),
    "joints-need-parameters": Message(
        "joints need their parameters",
        "les joints demandent leurs paramètres",
    ),
    "stiffness-holds-joints-whose": Message(
        "the stiffness holds joints whose law is not linear (JOINT_SDM), and no law is given "
        "for them: they would stay bonded",
        "la raideur contient des joints dont la loi n'est pas linéaire (JOINT_SDM), et "
        "aucune loi n'est donnée pour eux : ils resteraient collés",
    ),
    "load-not-mechanical": Message(
        "the load {name} is not mechanical",
        "le chargement {name} n'est pas mécanique",
    ),
    "full-uplift": Message(
        "step {step}, time {time:g}: full uplift of the bodies: all joint points there are "
        "open and nothing else holds it",
        "pas {step}, temps {time:g} : décollement total des corps : tous les points de joint "
        "y sont ouverts et rien d'autre ne les tient",
        "give it mass, a support, or loads that press it on its joints",
        "donnez-lui une masse, un appui, ou un chargement qui le presse sur ses joints",
    ),
    "full-uplift-of-body": Message(
        "step {step}, time {time:g}: full uplift of the body at node {node}: all {n_points} "
        "joint points there are open and nothing else holds it",
        "pas {step}, temps {time:g} : décollement total du corps au noeud {node} : les "
        "{n_points} points de joint y sont tous ouverts et rien d'autre ne le tient",
        "give it mass, a support, or loads that press it on its joints",
        "donnez-lui une masse, un appui, ou un chargement qui le presse sur ses joints",
    ),
    "unilateral-relations-mini-maxi": Message(
        "unilateral relations cannot be added during a calculation",
        "des relations unilatérales ne s'ajoutent pas pendant un calcul",
    ),
    "mechanical-load-made-nodal": Message(
        "a mechanical load is made of nodal fields",
        "un chargement mécanique est fait de champs par points",
    ),
    "matrix-added-during-calculation": Message(
        "a matrix added during the calculation has {lost} at node {lost_2}, which the "
        "stiffness and the mass lack",
        "une matrice ajoutée pendant le calcul a {lost} au noeud {lost_2}, absent de la "
        "raideur et de la masse",
        "give the stiffness a term (of zero, if need be) with this unknown",
        "donnez à la raideur un terme (nul, au besoin) avec cette inconnue",
    ),
    "reduction-unilateral": Message(
        "a reduced model does not take unilateral relations",
        "un modèle réduit n'admet pas de relations unilatérales",
    ),
    "reduction-not-associated": Message(
        "a reduced model does not take non-associated relations",
        "un modèle réduit n'admet pas de relations non associées",
    ),
    "reduction-steps": Message(
        "a reduced model goes with neither conserving nor adapted steps",
        "un modèle réduit ne va ni avec des pas conservatifs ni avec des pas adaptés",
    ),
    "conserving-step-no-friction": Message(
        "the conserving step has no friction between meshes and no relations with a dual",
        "le pas conservatif n'a ni frottement entre maillages ni relations avec une duale",
    ),
    "conserving-step-no-bearings": Message(
        "the conserving step does not have the mean forces of APPUI_PLOMB and APPUI_PENDULE",
        "le pas conservatif n'a pas les efforts moyens d'APPUI_PLOMB et d'APPUI_PENDULE",
        "take another scheme (average acceleration is the default) with a smaller step",
        "prendre un autre schéma (l'accélération moyenne est celui par défaut), à pas plus petit",
    ),
    "loop-adaptive": Message(
        "condensed, steps halved where one of {q} joint unknowns or a relation opens or closes",
        "condensé, pas divisés où l'une des {q} inconnues de joint ou une relation "
        "s'ouvre ou se ferme",
    ),
    "loop-conserving": Message(
        "condensed, midpoint rule with the mean tractions of {q} joint unknowns",
        "condensé, règle du point milieu avec les tractions moyennes de {q} inconnues de joint",
    ),
    "loop-full-newton": Message(
        "full Newton: all unknowns iterated on, factorised at each iteration",
        "Newton complet : itérations sur toutes les inconnues, factorisation à chacune",
    ),
    "loop-relations-on-modes": Message(
        "compiled, all modes: linear but for the active set of the unilateral relations",
        "compilé, tous les modes : linéaire hormis le jeu actif des relations unilatérales",
    ),
    "loop-relations": Message(
        "condensed, sparse: linear but for {q} joint unknowns and an active set of relations",
        "condensé, creux : linéaire hormis {q} inconnues de joint et un jeu de relations actives",
    ),
    "loop-one-mode": Message(
        "compiled, one mode: linear while its joint stays open or closed",
        "compilé, un mode : linéaire tant que son joint reste ouvert ou fermé",
    ),
    "loop-one-spring": Message(
        "compiled, a few modes: linear but for one joint, in closed form",
        "compilé, quelques modes : linéaire hormis un joint, sous forme explicite",
    ),
    "loop-springs": Message(
        "compiled, all modes: linear but for the active set of springs that only push",
        "compilé, tous les modes : linéaire hormis le jeu actif de ressorts qui ne font "
        "que pousser",
    ),
    "loop-modes": Message(
        "compiled, all modes: linear but for {q} joint unknowns",
        "compilé, tous les modes : linéaire hormis {q} inconnues de joint",
    ),
    "loop-still-supports": Message(
        "compiled, dense, without its supports: linear but for {q} joint unknowns",
        "compilé, plein, sans ses appuis : linéaire hormis {q} inconnues de joint",
    ),
    "loop-dense": Message(
        "compiled, dense: linear but for {q} joint unknowns",
        "compilé, plein : linéaire hormis {q} inconnues de joint",
    ),
    "loop-dissection": Message(
        "condensed, nested dissection: linear but for {q} joint unknowns",
        "condensé, dissection emboîtée : linéaire hormis {q} inconnues de joint",
    ),
    "loop-multigrid": Message(
        "Newton's method, multigrid at each turn: linear but for {q} joint unknowns",
        "méthode de Newton, multigrille à chaque tour : linéaire hormis {q} inconnues de joint",
    ),
    "loop-condensed": Message(
        "condensed, sparse: linear but for {q} joint unknowns",
        "condensé, creux : linéaire hormis {q} inconnues de joint",
    ),
    "conditions-hold-every-unknown": Message(
        "the conditions hold {count:the only unknown|all {count} unknowns}: there is no motion "
        "to calculate",
        "les conditions bloquent {count:la seule inconnue|les {count} inconnues} : il n'y a pas "
        "de mouvement à calculer",
    ),
}
