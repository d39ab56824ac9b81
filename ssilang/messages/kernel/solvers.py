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
    "unknowns-without-stiffness": Message(
        "{idle} of {count} unknowns meet no stiffness",
        "{idle} inconnues sur {count} ne rencontrent aucune raideur",
        "leave bodies without stiffness out of the model",
        "laissez hors du modèle les corps sans raideur",
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
        "multigrid did not converge within {most_turns} {most_turns:turn|turns}: the residual is "
        "{residual:.1e} of the second member, not {tolerance:.1e}; a body is free to move, or "
        "stiffnesses differ too much",
        "le multigrille n'a pas convergé en {most_turns} {most_turns:tour|tours} : le résidu vaut "
        "{residual:.1e} du second membre, et non {tolerance:.1e} ; un corps est libre, ou les "
        "raideurs sont trop différentes",
    ),
    "petsc-did-not-converge": Message(
        "PETSc's multigrid did not converge within {most_turns} {most_turns:turn|turns}: a body "
        "is free to move, or stiffnesses differ too much",
        "le multigrille de PETSc n'a pas convergé en {most_turns} {most_turns:tour|tours} : un "
        "corps est libre, ou les raideurs sont trop différentes",
    ),
    "petsc-no-command": Message(
        "solver PETSC runs behind a command, and none is given",
        "le solveur PETSC s'exécute derrière une commande, et aucune n'est donnée",
        "ssilang --petsc 'mpirun -n 4 /usr/bin/python3' case.ssi, or the same words in the "
        "environment's SSILANG_PETSC: a Python that has petsc4py and mpi4py",
        "ssilang --petsc 'mpirun -n 4 /usr/bin/python3' cas.ssi, ou les mêmes mots dans la "
        "variable d'environnement SSILANG_PETSC : un Python qui a petsc4py et mpi4py",
    ),
    "petsc-command": Message(
        "the command {command!r} that starts PETSc is empty, or ends within quotes",
        "la commande {command!r} qui lance PETSc est vide, ou finit dans des guillemets",
        "as in a shell: mpirun -n 4 /usr/bin/python3",
        "comme dans un terminal : mpirun -n 4 /usr/bin/python3",
    ),
    "petsc-program": Message(
        "the command {command!r} that starts PETSc names the program {program}, which is not there",
        "la commande {command!r} qui lance PETSc nomme le programme {program}, qui est introuvable",
        "install MPI (Debian: mpi-default-bin), or write the program's whole path",
        "installez MPI (Debian : mpi-default-bin), ou écrivez le chemin complet du programme",
    ),
    "petsc-system": Message(
        "PETSc is asked through files that processes hand to each other, which this system lacks",
        "PETSc est interrogé par des fichiers que les processus se passent, ce que ce système "
        "n'offre pas",
        "Linux and macOS have them",
        "Linux et macOS l'offrent",
    ),
    "petsc-not-started": Message(
        "PETSc cannot be started by {command!r}: {fault}",
        "PETSc ne se lance pas par {command!r} : {fault}",
    ),
    "petsc-ended-at-start": Message(
        "the command {command!r} that starts PETSc ended with code {code} before it answered{told}",
        "la commande {command!r} qui lance PETSc a fini avec le code {code} avant de "
        "répondre{told}",
        "its Python needs petsc4py, mpi4py and numpy (Debian: python3-petsc4py python3-mpi4py); "
        "its first process must run on this machine",
        "son Python demande petsc4py, mpi4py et numpy (Debian : python3-petsc4py "
        "python3-mpi4py) ; son premier processus doit s'exécuter sur cette machine",
    ),
    "petsc-late": Message(
        "the command {command!r} that starts PETSc has not answered within {limit:g} s{told}",
        "la commande {command!r} qui lance PETSc n'a pas répondu en {limit:g} s{told}",
        "it must start a Python whose first process runs on this machine",
        "elle doit lancer un Python dont le premier processus s'exécute sur cette machine",
    ),
    "petsc-strange": Message(
        "what the command {command!r} started is not the server of this run{told}",
        "ce que la commande {command!r} a lancé n'est pas le serveur de cette exécution{told}",
        "the command ends with a Python, to which ssilang adds its server's file",
        "la commande se termine par un Python, auquel ssilang ajoute le fichier de son serveur",
    ),
    "petsc-protocol": Message(
        "the server that {command!r} started is of another version of ssilang (protocol {found}, "
        "not {wanted})",
        "le serveur lancé par {command!r} est d'une autre version de ssilang (protocole {found} au "
        "lieu de {wanted})",
        "let the command start the server of this installation",
        "faites lancer par la commande le serveur de cette installation",
    ),
    "petsc-not-real": Message(
        "the PETSc {version} that {command!r} starts is built for complex numbers",
        "le PETSc {version} que lance {command!r} est construit pour les nombres complexes",
        "one for real numbers (Debian: python3-petsc4py-real)",
        "prenez-en un pour les nombres réels (Debian : python3-petsc4py-real)",
    ),
    "petsc-not-mumps": Message(
        "the PETSc {version} that {command!r} starts has no MUMPS",
        "le PETSc {version} que lance {command!r} n'a pas MUMPS",
        "build it with --download-mumps, or take Debian's or conda's",
        "construisez-le avec --download-mumps, ou prenez celui de Debian ou de conda",
    ),
    "petsc-ended": Message(
        "PETSc, started by {command!r}, ended in the middle of the calculation (code {code}): a "
        "process or a machine was lost{told}",
        "PETSc, lancé par {command!r}, a fini au milieu du calcul (code {code}) : un processus ou "
        "une machine est perdu{told}",
        "most often memory was short: more machines, or fewer processes on each",
        "le plus souvent la mémoire a manqué : plus de machines, ou moins de processus sur chacune",
    ),
    "petsc-memory": Message(
        "the factor of {n_a} unknowns takes {needed} of memory, the processes of PETSc may take "
        "{room}; multigrid solves symmetric positive matrices only",
        "la factorisation de {n_a} inconnues prend {needed} de mémoire, les processus de PETSc "
        "peuvent en prendre {room} ; le multigrille ne résout que des matrices symétriques "
        "positives",
        "more machines, or fewer processes on each",
        "plus de machines, ou moins de processus sur chacune",
    ),
    "petsc-indices": Message(
        "a matrix of {n_a} unknowns has more entries on a process than this PETSc counts",
        "une matrice de {n_a} inconnues a plus de termes sur un processus que ce PETSc n'en compte",
        "more processes, or a PETSc of 64 bits (Debian: python3-petsc4py-64-real)",
        "plus de processus, ou un PETSc de 64 bits (Debian : python3-petsc4py-64-real)",
    ),
    "petsc-mumps": Message(
        "MUMPS gives the matrix up with error {said} ({second})",
        "MUMPS abandonne la matrice avec l'erreur {said} ({second})",
        "INFOG(1) and INFOG(2) of its manual",
        "INFOG(1) et INFOG(2) de sa notice",
    ),
}
