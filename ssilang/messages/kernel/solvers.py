"""What ssilang/kernel/solvers refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-state-contact-friction": Message(
        "no state of contact and friction gives equilibrium",
        "aucun état de contact et de frottement ne donne l'équilibre",
        "a body held by friction alone slides away when the loads exceed it: hold it, give "
        "it mass in a dynamic calculation, or take smaller steps",
        "un corps tenu par le seul frottement glisse quand les charges le dépassent : le "
        "tenir, lui donner une masse en dynamique, ou prendre des pas plus petits",
    ),
    "matrix-holds-values-not": Message(
        "the matrix holds values that are not finite numbers",
        "la matrice contient des valeurs qui ne sont pas des nombres finis",
    ),
    "matrix-stays-singular-free": Message(
        "the matrix stays singular when its free motions are held",
        "la matrice reste singulière quand ses mouvements libres sont tenus",
    ),
    "uzawa-sweeps-did-not": Message(
        "Uzawa's sweeps did not converge in {most_sweeps} (last change {change:.1e})",
        "les balayages d'Uzawa n'ont pas convergé en {most_sweeps} (dernière variation "
        "{change:.1e})",
        "a coefficient near {largest:g}, or another method",
        "un coefficient proche de {largest:g}, ou une autre méthode",
    ),
    "penalty-needs-coefficient": Message(
        "penalty needs a coefficient > 0",
        "la pénalité demande un coefficient > 0",
        "a stiffness, N/m",
        "une raideur, N/m",
    ),
    "augmentation-must": Message(
        "the augmentation {c:g} must be > 0",
        "l'augmentation {c:g} doit être > 0",
    ),
    "uzawa-coefficient-not-converge": Message(
        "Uzawa's coefficient {c:g} does not converge",
        "le coefficient d'Uzawa {c:g} ne converge pas",
        "between 0 and {largest:g}",
        "entre 0 et {largest:g}",
    ),
    "number-negative-eigenvalues-cannot": Message(
        "the number of negative eigenvalues cannot be found without row exchanges",
        "le nombre de valeurs propres négatives ne se trouve pas sans échanges de lignes",
    ),
    "no-solver-called": Message(
        "no solver is called {name}",
        "aucun solveur ne s'appelle {name}",
        "known: {backends}",
        "connus : {backends}",
    ),
    "factor-unknowns-takes-memory": Message(
        "the factor of {n_a} unknowns takes {gigabytes} of memory, {gigabytes_2} is free",
        "la factorisation de {n_a} inconnues prend {gigabytes} de mémoire, il en reste "
        "{gigabytes_2}",
        "multigrid needs less: {remedy}",
        "le multigrille en demande moins : {remedy}",
    ),
    "not-installed": Message(
        "solver {name} needs the package {package}, which is not installed",
        "le solveur {name} demande le paquet {package}, qui n'est pas installé",
        "{remedy}",
        "{remedy}",
    ),
    "no-set-active-unilateral": Message(
        "no set of active unilateral conditions gives equilibrium: the reaction of one "
        "drives what it acts on further through it",
        "aucun jeu de conditions unilatérales actives ne donne l'équilibre : la réaction de "
        "l'une enfonce davantage à travers elle ce sur quoi elle agit",
    ),
    "no-set-active-unilateral-2": Message(
        "no set of active unilateral conditions gives equilibrium",
        "aucun jeu de conditions unilatérales actives ne donne l'équilibre",
    ),
    "multigrid-solves-symmetric-positive": Message(
        "multigrid solves symmetric positive matrices only",
        "le multigrille ne résout que des matrices symétriques positives",
    ),
    "multigrid-did-not-converge": Message(
        "multigrid did not converge within {most_turns} {most_turns:turn|turns}: a body is "
        "free to move, or stiffnesses differ too much",
        "le multigrille n'a pas convergé en {most_turns} {most_turns:tour|tours} : un corps "
        "est libre, ou les raideurs sont trop différentes",
    ),
}
