"""What ssilang/operators/files refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-whole-number": Message(
        "{name}, line {line}: {value} is no whole number",
        "{name}, ligne {line} : {value} n'est pas un nombre entier",
    ),
    "all-lines-read": Message(
        "{name} has only {n_lines} {n_lines:line|lines}, all have been read",
        "{name} n'a que {n_lines} {n_lines:ligne|lignes}, toutes ont été lues",
    ),
    "no-number": Message(
        "{name}, line {line}: '{item}' is no number",
        "{name}, ligne {line} : '{item}' n'est pas un nombre",
    ),
    "no-name-with-type": Message(
        "ACQU wants names, each with *TYPE",
        "ACQU veut des noms, chacun avec *TYPE",
    ),
    "type-not-read": Message(
        "'{kind}' cannot be read from a file",
        "'{kind}' ne se lit pas dans un fichier",
        "types are {types}",
        "les types sont {types}",
    ),
    "size-missing": Message(
        "the number of values must follow {name}*{kind}",
        "le nombre de valeurs doit suivre {name}*{kind}",
    ),
    "figure-not-finite": Message(
        "a figure, what is expected of it and its tolerance are finite numbers: this of '{name}' "
        "is none",
        "un résultat, ce qu'on en attend et sa tolérance sont des nombres finis : celui-ci de "
        "'{name}' n'en est pas un",
        "look for what was divided by zero, or grew without bound",
        "cherchez ce qui a été divisé par zéro, ou a grandi sans borne",
    ),
    "record-not-in-si": Message(
        "the record is in {unit}, and no factor makes metres and seconds of it: its values are "
        "read as they are",
        "l'enregistrement est en {unit}, et aucun facteur n'en fait des mètres et des secondes : "
        "ses valeurs sont lues telles quelles",
        "LIRE 'PEER' '{file}' {factor:g}; LIRE 'PEER' '{file}' 1. to have it so",
        "LIRE 'PEER' '{file}' {factor:g} ; LIRE 'PEER' '{file}' 1. pour l'avoir ainsi",
    ),
    "format-not-read": Message(
        "LIRE '{word}' is not supported",
        "LIRE '{word}' n'existe pas",
        "formats that are read: CSV, PEER, AVS, UNV, STL, PROC",
        "formats qui se lisent : CSV, PEER, AVS, UNV, STL, PROC",
    ),
    "format-not-written": Message(
        "SORT '{word}' is not supported",
        "SORT '{word}' n'existe pas",
        "formats of meshes that are written: VTK, AVS, STL, NAS, ABAQ",
        "formats de maillages qui s'écrivent : VTK, AVS, STL, NAS, ABAQ",
    ),
    "not-of-one-file": Message(
        "'{word}' is for .vtu files, 'VTKHDF' asks for one .vtkhdf file, which is packed, begins "
        "anew with each run and needs no list",
        "'{word}' vaut pour les fichiers .vtu, 'VTKHDF' demande un fichier .vtkhdf, qui est "
        "compressé, recommence à chaque calcul et se passe de liste",
        "leave '{word}' out, or take 'VTU'",
        "ôtez '{word}', ou prenez 'VTU'",
    ),
    "no-such-procedure": Message(
        "{name} defines no procedure {wanted}",
        "{name} ne définit pas de procédure {wanted}",
        "it defines {found}",
        "il définit {found}",
    ),
    "all-structures-read": Message(
        "{name} holds {done} {done:structure|structures}, all have been read",
        "{name} contient {done} {done:structure|structures}, toutes ont été lues",
    ),
    "other-units": Message(
        "{name} was saved in {saved}, and the deck is in {present}: no number is converted",
        "{name} a été sauvé en {saved} et le jeu de données est en {present} : aucun nombre n'est "
        "converti",
        "OPTI 'UNIT' '{saved}' before REST, or other objects",
        "OPTI 'UNIT' '{saved}' avant REST, ou d'autres objets",
    ),
    "no-such-label": Message(
        "{name} has no record labelled '{label}'",
        "{name} n'a pas d'enregistrement de label '{label}'",
        "its labels are: {known}",
        "ses labels sont : {known}",
    ),
    "no-object-to-save": Message(
        "there is no object '{value}' to save",
        "il n'y a pas d'objet '{value}' à sauver",
    ),
    "positive-number": Message(
        "{said} wants a positive number, not {n}",
        "{said} veut un nombre positif, pas {n}",
    ),
    "only-matrix-market": Message(
        "only 'MM' 'ASSE' is supported, the assembled matrix as Matrix Market text",
        "seul 'MM' 'ASSE' existe, la matrice assemblée en texte Matrix Market",
    ),
    "no-such-mesh": Message(
        "{name} holds no mesh '{wanted}'",
        "{name} ne contient pas de maillage '{wanted}'",
        "it holds {known}",
        "il contient {known}",
    ),
}
