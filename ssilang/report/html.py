"""Pieces of HTML that pages are made of."""

import html
import json
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from ssilang.messages.message import visible
from ssilang.remembered import tables_of


def text(value: object) -> str:
    """A value as text that is no HTML."""
    return html.escape(visible(str(value)))


def json_in_page(value: object) -> str:
    """JSON that may stand in a script's element."""
    made = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return made.replace("<", "\\u003c")


@cache
def asset(name: str) -> str:
    """A file of the page."""
    return resources.files(__package__ or "").joinpath("assets", name).read_text(encoding="utf-8")


def codes() -> Any:
    """Codes of what pages say, by part."""
    return tables_of(Path(__file__).with_name("page.toml"))


def section(name: str, title: str, body: str) -> str:
    """A part of the page; nothing without a body."""
    if not body:
        return ""
    return f'<section id="{name}"><h2>{text(title)}</h2>\n{body}</section>'


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], numbers: Sequence[int]) -> str:
    """A table of cells that are HTML already; `numbers`: the columns that hold numbers."""

    def line(tag: str, cells: Iterable[str]) -> str:
        kinds = (" class=number" if i in numbers else "" for i in range(len(heads)))
        made = (f"<{tag}{kind}>{cell}</{tag[:2]}>" for kind, cell in zip(kinds, cells, strict=True))
        return f"<tr>{''.join(made)}</tr>"

    body = "".join(line("td", row) for row in rows)
    head = line("th scope=col", map(text, heads))
    return f"<div class=wide><table><thead>{head}</thead><tbody>{body}</tbody></table></div>"


def number(value: object) -> str:
    """A number in five digits, '' for none."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return ""
    return f"{value + 0.0:.5g}"


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
