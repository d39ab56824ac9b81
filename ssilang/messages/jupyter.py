"""What ssilang/jupyter says."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "extra": Message(
        "the kernel for Jupyter needs ipykernel: pip install 'ssilang[jupyter]'",
        "le noyau pour Jupyter demande ipykernel : pip install 'ssilang[jupyter]'",
    ),
    "usage": Message(
        "tell Jupyter of the kernel that runs cells of Gibiane",
        "faire connaître à Jupyter le noyau qui exécute des cellules de Gibiane",
    ),
    "usage-sys-prefix": Message(
        "into the environment of this Python, not for this user",
        "dans l'environnement de ce Python, et non pour cet utilisateur",
    ),
    "usage-prefix": Message(
        "into an environment at that place", "dans un environnement à cet endroit"
    ),
    "installed": Message(
        "the kernel 'Gibiane (ssilang)' is in {place}",
        "le noyau « Gibiane (ssilang) » est dans {place}",
    ),
}
