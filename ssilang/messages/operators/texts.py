"""What ssilang/operators/texts refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "format-without-brackets": Message(
        "'{text}' is not a format: it stands between parentheses",
        "'{text}' n'est pas un format : un format est entre parenthèses",
        "for example 'FORMAT' '(F8.3)'",
        "par exemple 'FORMAT' '(F8.3)'",
    ),
    "bad-format": Message(
        "'{text}' is not a format that can be read",
        "'{text}' n'est pas un format lisible",
        "for example '(1PE12.5)'",
        "par exemple '(1PE12.5)'",
    ),
    "unknown-type": Message(
        "'{kind}' is no type",
        "'{kind}' n'est pas un type",
        "{known_types:words}",
        "{known_types:words}",
    ),
    "characters-beyond-end": Message(
        "'{word}' has {size} {size:character|characters}, {first} to {last} are not in it",
        "'{word}' a {size} {size:caractère|caractères}, {first} à {last} n'y sont pas",
    ),
    "no-such-character": Message(
        "'{word}' has {size} {size:character|characters}, none at place {place}",
        "'{word}' a {size} {size:caractère|caractères}, aucun à la place {place}",
    ),
    "unknown-type-named": Message(
        "'{kind}' is no type",
        "'{kind}' n'est pas un type",
        "types are {known_types:words}",
        "les types sont {known_types:words}",
    ),
}
