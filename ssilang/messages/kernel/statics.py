"""What ssilang/kernel/statics refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "matrix-not-symmetric-eigenvalues": Message(
        "the matrix is not symmetric: its eigenvalues need not be real",
        "la matrice n'est pas symétrique : ses valeurs propres peuvent ne pas être réelles",
    ),
    "answer-law-creep-depends": Message(
        "the answer of a law of creep depends on the duration of the step",
        "la réponse d'une loi de fluage dépend de la durée du pas",
        "PASAPAS and DYNAMIC take such models",
        "PASAPAS et DYNAMIC prennent ces modèles",
    ),
    "plastic-shells-no-law": Message(
        "plastic shells have no law between their forces and strains alone",
        "les coques plastiques n'ont pas de loi entre leurs seuls efforts et déformations",
        "PASAPAS and DYNAMIC take such models",
        "PASAPAS et DYNAMIC prennent ces modèles",
    ),
    "hz-system-singular": Message(
        "at {frequency:g} Hz the system is singular",
        "à {frequency:g} Hz le système est singulier",
        "undamped resonance, or a free motion at 0 Hz: leave this frequency out or add damping",
        "résonance sans amortissement, ou mouvement libre à 0 Hz : ôter cette fréquence ou amortir",
    ),
    "load-matrices-lack": Message(
        "the load {name} has {lost}, which the matrices lack",
        "la charge {name} a {lost}, que les matrices n'ont pas",
        "forces act on nodes and unknowns of the model",
        "les forces agissent sur des noeuds et des inconnues du modèle",
    ),
    "matrix-empty-nothing-solve": Message(
        "the matrix is empty: there is nothing to solve",
        "la matrice est vide : il n'y a rien à résoudre",
    ),
    "conditions-contradict-cannot-take": Message(
        "conditions contradict each other: one on {names} cannot take the value {d:.6g}",
        "des blocages se contredisent : l'un, sur {names}, ne peut prendre la valeur {d:.6g}",
        "the same unknown is imposed twice with different values",
        "la même inconnue est imposée deux fois, avec des valeurs différentes",
    ),
    "cable-branches-node": Message(
        "the cable branches at node {node}",
        "le câble a un branchement au noeud {node}",
    ),
    "cable-node-ring-no": Message(
        "the cable at node {node} is a ring: it has no end to be pulled at",
        "le câble au noeud {node} est un anneau : il n'a pas de bout où le tirer",
    ),
    "law-element-no-criterion": Message(
        "the law {words:words} of element {element} has no criterion here",
        "la loi {words:words} de l'élément {element} n'a pas de critère ici",
        "there are {criteria} and the joints' laws",
        "il y a {criteria} et les lois des joints",
    ),
    "joints-law-no-criterion": Message(
        "joints {element} with this law have no criterion",
        "les joints {element} n'ont pas de critère avec cette loi",
    ),
    "load-needs-field-temperatures": Message(
        "the load T needs a field of temperatures",
        "le chargement T demande un champ de températures",
    ),
    "more-bodies": Message(
        "{count} more {count:body|bodies}",
        "{count} {count:autre|autres} corps",
    ),
    "motions": Message(
        "{motions}",
        "{motions}",
    ),
    "motions-of-body": Message(
        "the body of {n_nodes} {n_nodes:node|nodes} around ({place:.4g}): "
        "{motions:?{motions}|a mechanism}",
        "le corps de {n_nodes} {n_nodes:noeud|noeuds} autour de ({place:.4g}) : "
        "{motions:?{motions}|un mécanisme}",
    ),
    "translation": Message(
        "translation along {axis}",
        "translation suivant {axis}",
    ),
    "rotation": Message(
        "rotation about {axis}",
        "rotation autour de {axis}",
    ),
    "rotation-around": Message(
        "rotation about {axis} around ({place:.4g})",
        "rotation autour de {axis} au point ({place:.4g})",
    ),
    "held-by-contact-alone": Message(
        "{failure}; held by them alone: {motions:?{motions:;}|a mechanism}",
        "{failure} ; tenus par elles seules : {motions:?{motions:;}|un mécanisme}",
        "{failure!h}",
        "{failure!h}",
    ),
    "at-load-step": Message(
        "load step {step}, time {time:g}: {failure}",
        "pas de charge {step}, temps {time:g} : {failure}",
        "{failure!h}",
        "{failure!h}",
    ),
    "no-equilibrium-found-residual": Message(
        "load step {step}, time {time:g}: no equilibrium found (residual {residual:.1e} of "
        "the jump after {turns} {turns:iteration|iterations})",
        "pas de charge {step}, temps {time:g} : aucun équilibre trouvé (résidu "
        "{residual:.1e} du saut après {turns} {turns:itération|itérations})",
        "smaller load steps",
        "des pas de charge plus petits",
    ),
    "beams-sections-fibres-no": Message(
        "beams with sections of fibres have no law between their forces and strains alone",
        "les poutres à fibres n'ont pas de loi entre leurs seuls efforts et déformations",
    ),
    "unknowns-too-many-choose": Message(
        "{size} unknowns are too many to choose frequencies for",
        "{size} inconnues sont trop pour un choix des fréquences",
    ),
    "system-no-natural-frequency": Message(
        "the system has no natural frequency to choose a sweep from",
        "le système n'a pas de fréquence propre pour choisir un balayage",
    ),
    "load-ends-hz-below": Message(
        "the load ends at {high:g} Hz, below the response, which begins at {low:g} Hz",
        "le chargement finit à {high:g} Hz, sous la réponse, qui commence à {low:g} Hz",
    ),
    "unilateral-condition-no-harmonic": Message(
        "a unilateral condition has no harmonic response",
        "une condition unilatérale n'a pas de réponse harmonique",
    ),
    "pressure-without-sides": Message(
        "a load of pressure stands on no side: the model has no zones of loads",
        "un chargement de pression n'a pas de face : le modèle n'a pas de zones de chargement",
    ),
    "pressure-follows": Message(
        "in large displacements a pressure follows its sides as they turn, which a load that is "
        "given beforehand does not",
        "en grands déplacements une pression suit ses faces qui tournent, ce que ne fait pas un "
        "chargement donné d'avance",
    ),
    "pressure-is-no-field-in-cells": Message(
        "a load of pressure is made of a field in cells",
        "un chargement de pression est fait d'un champ par éléments",
    ),
    "free-strains-in-large-displacements": Message(
        "the load {name} strains bodies without stress, which is not available in large "
        "displacements",
        "le chargement {name} déforme sans contrainte, ce qui n'est pas disponible en grands "
        "déplacements",
    ),
    "given-strain-is-no-field-in-cells": Message(
        "imposed strains (DEFI) are a field in cells",
        "des déformations imposées (DEFI) sont un champ par éléments",
    ),
    "given-strain-names": Message(
        "imposed strains (DEFI) on these bodies have components {wanted:words}, this field has "
        "{given:?{given:words}|none on them}",
        "des déformations imposées (DEFI) ont sur ces corps les composantes {wanted:words}, ce "
        "champ {given:?a {given:words}|n'en a aucune}",
    ),
    "load-not-mechanical": Message(
        "the load {name} is not mechanical",
        "le chargement {name} n'est pas mécanique",
    ),
    "loads-drive-motions": Message(
        "the matrix is singular, with {count} {count:free motion|free motions} that the "
        "loads drive{motions:? ({motions:;})}",
        "la matrice est singulière : {count} {count:mouvement libre|mouvements libres}, que "
        "le chargement entraîne{motions:? ({motions:;})}",
        "not held: {free}{more:? and {more} more}{apart:?; {apart} {apart:node lies on a "
        "node|nodes lie on nodes} of another body}",
        "non tenu : {free}{more:? et {more} {more:autre|autres}}{apart:? ; {apart} "
        "{apart:noeud est sur celui|noeuds sont sur ceux} d'un autre corps}",
    ),
    "matrix-no-unknown-force": Message(
        "the matrix has no unknown for the force {lost}{more:? and {more} more}",
        "la matrice n'a pas d'inconnue pour la force {lost}{more:? et {more} {more:autre|autres}}",
        "{n_above:?node {above} lies on node {below} of the matrix|take it out of the second "
        "member}",
        "{n_above:?le noeud {above} est sur le noeud {below} de la matrice|ôtez-la du second "
        "membre}",
    ),
    "solution-without-multipliers": Message(
        "{missing} of the {n_rows} {n_rows:condition|conditions} of the matrix {missing:has|have} "
        "no multiplier LX in the solution{at:? (one holds {at})}: their reaction is not known",
        "{missing} {missing:condition|conditions} de la matrice, sur {n_rows}, "
        "{missing:n'a|n'ont} pas de multiplicateur LX dans la solution{at:? (l'une tient {at})} : "
        "leur réaction n'est pas connue",
        "{others:?conditions made again have multipliers of their own: use the very matrix that "
        "was solved with|the solution must keep its multipliers}",
        "{others:?des conditions refaites ont leurs propres multiplicateurs : prenez la matrice "
        "même de la résolution|la solution doit garder ses multiplicateurs}",
    ),
    "load-not-finite": Message(
        "the second member is not a finite number{at:? for {at}|: an imposed value}",
        "le second membre n'est pas un nombre fini{at:? pour {at}| : une valeur imposée}",
        "look for what was divided by zero, or grew without bound",
        "cherchez ce qui a été divisé par zéro, ou a grandi sans borne",
    ),
    "ground-is-not-at-a-point": Message(
        "the ground below a macro-element with COHE yields at many places, which PASAPAS and "
        "DYNAMIC follow; the law alone has no answer",
        "le sol sous un macro-élément avec COHE plastifie en beaucoup de points, que PASAPAS et "
        "DYNAMIC suivent ; la loi seule n'a pas de réponse",
        "give the model to PASAPAS or DYNAMIC",
        "donnez le modèle à PASAPAS ou à DYNAMIC",
    ),
    "footing-overloaded": Message(
        "load step {step}, time {time:g}: no equilibrium: the loads press with {pressing:.4g} N on "
        "the footing at node {node}, whose ground bears {capacity:.4g} N",
        "pas de charge {step}, temps {time:g} : pas d'équilibre : le chargement presse de "
        "{pressing:.4g} N la fondation au noeud {node}, dont le sol supporte {capacity:.4g} N",
        "a larger footing, a lighter structure, or the strength COHE (or QULT) of a better ground",
        "une fondation plus grande, une structure plus légère, ou la résistance COHE (ou QULT) "
        "d'un meilleur sol",
    ),
    "footing-gives-way": Message(
        "load step {step}, time {time:g}: no equilibrium: the ground below the footing at node "
        "{node} gives way; at the last equilibrium it carried {used:.3g} % of its vertical "
        "capacity on {share:.3g} % of the area",
        "pas de charge {step}, temps {time:g} : pas d'équilibre : le sol sous la fondation au "
        "noeud {node} cède ; au dernier équilibre il portait {used:.3g} % de sa capacité "
        "verticale sur {share:.3g} % de l'aire",
        "less eccentric or less inclined loads, imposed displacements, or a dynamic calculation",
        "un chargement moins excentré ou moins incliné, des déplacements imposés, ou un calcul "
        "dynamique",
    ),
    "no-equilibrium-full-uplift": Message(
        "load step {step}, time {time:g}: no equilibrium, full uplift: no joint point of "
        "{n_points} is pressed and nothing else holds the body at node {node}",
        "pas de charge {step}, temps {time:g} : pas d'équilibre, décollement total : aucun "
        "des {n_points} points de joint n'est pressé et rien d'autre ne tient le corps au "
        "noeud {node}",
        "less eccentric loads, a support, or a dynamic calculation; if the loads press, the "
        "joint's sides are swapped",
        "un chargement moins excentré, un appui, ou un calcul dynamique ; si le chargement "
        "presse, les côtés du joint sont inversés",
    ),
    "mechanical-load-made-nodal": Message(
        "a mechanical load is made of nodal fields",
        "un chargement mécanique est fait de champs par points",
    ),
    "mota-knows-von-mises": Message(
        "this is known for von Mises laws, not for {name}",
        "ceci est connu pour les lois de von Mises, pas pour {name}",
    ),
}
