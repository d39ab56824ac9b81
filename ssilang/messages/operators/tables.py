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
    "empty-table": Message(
        "the table holds nothing at integer indices",
        "la table ne contient rien aux indices entiers",
    ),
}
