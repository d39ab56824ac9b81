"""What ssilang/kernel/base refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "no-real-power": Message(
        "{number:g} ** {power:g} has no real value",
        "{number:g} ** {power:g} n'a pas de valeur réelle",
    ),
}
