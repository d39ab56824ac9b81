"""The deck's text with its lines numbered and its words coloured."""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence

from ssilang.language.say.visible import visible

MOST_LINES = 20_000

Colours = Callable[[str], Sequence[tuple[int, int, str]]]
"""Start, end and colour of the words and comments of a text, in its order."""


def deck_html(text: str, colours: Colours, wrong: Sequence[int] = ()) -> str:
    """A deck; lines that are `wrong` are marked."""
    text = "\n".join(text.split("\n")[:MOST_LINES])
    spans = colours(text)
    made: list[str] = []
    at = 0
    for start, end, colour in spans:
        if start < at:
            continue
        made.append(_plain(text[at:start]))
        parts = text[start:end].split("\n")
        made.append("\n".join(f'<i class="{colour}">{_plain(p)}</i>' if p else "" for p in parts))
        at = end
    made.append(_plain(text[at:]))
    lines = "".join(made).split("\n")
    numbered = [
        f'<li id="line-{i}"{" class=wrong" if i in wrong else ""}><code>{line or " "}</code></li>'
        for i, line in enumerate(lines, 1)
    ]
    return f"<ol class=deck>{''.join(numbered)}</ol>"


def _plain(text: str) -> str:
    return html.escape("\n".join(visible(part) for part in text.split("\n")), quote=False)
