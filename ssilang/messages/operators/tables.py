"""What ssilang/operators/tables refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "unknown-type": Message(
        "'{kind}' is no type",
        "'{kind}' n'est pas un type",
        "types are {known_types:words}",
        "les types sont {known_types:words}",
    ),
    "wrong-subtype": Message(
        "the table is of sub-type '{subtype}'",
        "la table est de sous-type '{subtype}'",
        "TABL 'ESCLAVE', PART",
        "TABL 'ESCLAVE', PART",
    ),
    "entry-not-available": Message(
        "the entry '{index}' is not available: {reason}",
        "l'indice '{index}' n'est pas disponible : {reason}",
    ),
    "few-instants": Message(
        "'{index}' has {count} {count:instant|instants}",
        "'{index}' a {count} {count:instant|instants}",
        "two instants or more",
        "deux instants ou plus",
    ),
    "instants-not-increasing": Message(
        "'{index}' does not increase: {value:g} follows {before:g} "
        "(values {place} and {next_place})",
        "'{index}' ne croît pas : {value:g} suit {before:g} (valeurs {place} et {next_place})",
        "each instant after the one before it",
        "chaque instant après celui qui le précède",
    ),
    "not-a-vector": Message(
        "a table of sub-type VECTEUR is needed, found '{subtype}'",
        "il faut une table de sous-type VECTEUR, trouvé '{subtype}'",
    ),
    "empty-table": Message(
        "there is nothing to join: no object at an integer index, or none in the list",
        "il n'y a rien à réunir : aucun objet à un indice entier, ou aucun dans la liste",
    ),
}
