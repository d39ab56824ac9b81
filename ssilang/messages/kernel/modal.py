"""What ssilang/kernel/modal refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "matrix-empty-nothing-solve": Message(
        "the matrix is empty: there is nothing to solve",
        "la matrice est vide : il n'y a rien à résoudre",
    ),
    "model-stands-point-not": Message(
        "a model {behaviour} stands on one point, not {n_cells}",
        "un modèle {behaviour} s'appuie sur un seul point, pas sur {n_cells}",
        "one model for each shape, joined with ET",
        "faites un modèle par déformée, et réunissez-les par ET",
    ),
    "shape-needs": Message(
        "a shape {behaviour} needs {missing:words}",
        "une déformée {behaviour} demande {missing:words}",
    ),
    "conditions-hold-every-unknown": Message(
        "the conditions hold every unknown: there is no mode",
        "les conditions bloquent toutes les inconnues : il n'y a pas de mode",
    ),
    "modes-miss-equation": Message(
        "what the search for modes found does not satisfy K x = (2 pi f)^2 M x: the mass matrix "
        "has negative eigenvalues",
        "ce que la recherche de modes a trouvé ne vérifie pas K x = (2 pi f)^2 M x : la matrice "
        "de masse a des valeurs propres négatives",
    ),
    "search-modes-not-converge": Message(
        "the search for modes does not converge: {problem_found}",
        "la recherche de modes ne converge pas : {problem_found}",
    ),
    "link-no-positive-stiffness": Message(
        "link {place} has no positive stiffness",
        "la liaison {place} n'a pas de raideur positive",
    ),
    "law-link-wants-two": Message(
        "the law of link {place} wants two points or more, abscissas growing",
        "la loi de la liaison {place} veut deux points ou plus, abscisses croissantes",
    ),
    "law-link-not-elastic": Message(
        "the law of link {place} is not elastic, then plastic with hardening",
        "la loi de la liaison {place} n'est pas élastique, puis plastique avec écrouissage",
        "its first line is the steepest; those behind it do not descend",
        "son premier segment est le plus raide ; les suivants ne descendent pas",
    ),
    "step-numbers-steps-must": Message(
        "the step and the numbers of steps must be positive",
        "le pas et les nombres de pas doivent être positifs",
    ),
    "run-diverges": Message(
        "the run diverges",
        "le calcul diverge",
        "shorten the step: the links are stiffer than it can follow",
        "raccourcir le pas : les liaisons sont trop raides pour lui",
    ),
    "mass-modes-singular": Message(
        "the mass of the modes is singular",
        "la masse des modes est singulière",
        "each mode and static shape needs a mass",
        "chaque mode et chaque déformée statique a besoin d'une masse",
    ),
    "step-too-long-most": Message(
        "the step {h:.4g} s is too long for {scheme}: {limit:.4g} s at most",
        "le pas de {h:.4g} s est trop long pour {scheme} : {limit:.4g} s au plus",
        "shorten the step, or leave out the highest modes",
        "raccourcir le pas, ou se passer des modes les plus hauts",
    ),
    "signal-times-must-increase": Message(
        "the signal's times must increase",
        "les temps du signal doivent être croissants",
    ),
    "spectrum-needs-frequency-least": Message(
        "a spectrum needs one frequency at least",
        "un spectre demande au moins une fréquence",
    ),
    "frequency-oscillator-must-positive": Message(
        "the frequency of an oscillator must be positive",
        "la fréquence d'un oscillateur doit être positive",
    ),
    "damping-oscillator-cannot-negative": Message(
        "the damping of an oscillator cannot be negative ({damping:g})",
        "l'amortissement d'un oscillateur ne peut être négatif ({damping:g})",
    ),
    "no-unknown-may-move": Message(
        "no unknown that may move has a mass",
        "aucune inconnue libre n'a de masse",
        "give RHO, or add masses",
        "donnez RHO, ou ajoutez des masses",
    ),
    "matrix-singular-whatever-frequency": Message(
        "the matrix is singular whatever the frequency",
        "la matrice est singulière à toute fréquence",
    ),
    "mass-matrix-negative-eigenvalues": Message(
        "the mass matrix has negative eigenvalues and the stiffness is not positive",
        "la matrice de masse a des valeurs propres négatives et la raideur n'est pas positive",
    ),
    "shapes-no-strains": Message(
        "models MODAL and STATIQUE have no strains of their own",
        "les modèles MODAL et STATIQUE n'ont pas de déformations propres",
    ),
    "matrices-not-symmetric-modes": Message(
        "the matrices are not symmetric: the modes are complex",
        "les matrices ne sont pas symétriques : les modes sont complexes",
    ),
    "modes-non-associated-relations": Message(
        "modes with non-associated relations have no meaning here",
        "des modes avec des relations non associées n'ont pas de sens ici",
    ),
    "default-list-frequencies-too": Message(
        "the default list of frequencies is too long",
        "la liste de fréquences par défaut est trop longue",
    ),
}
