"""French of what the parts below the language report in English.

Kernel and operators raise errors whose sentence is English; they know no language. A sentence is
recognised here by its template and said again in French, with its figures and names taken over.
What has no template stays English. The templates stand in `french/*.txt`: a line of English, a line
of French, a blank line; `{}` stands for any text, the same in the same order in both; a line that
begins with # is a comment.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

PARTS: tuple[tuple[str, str], ...] = (
    (r"the body of (\d+) nodes around", r"le corps de \1 noeuds autour de"),
    (r"\btranslation along\b", "translation suivant"),
    (r"\brotation about (\w+) around\b", r"rotation autour de \1 au point"),
    (r"\brotation about\b", "rotation autour de"),
    (r"\band (\d+) more\b", r"et \1 autres"),
    (r"\bat node (\d+)", r"au noeud \1"),
    (r"\ba mechanism\b", "un mécanisme"),
    (r"\b(\d+) more bodies\b", r"\1 autres corps"),
    (r"\bcell (\d+)\b", r"l'élément \1"),
)
"""Words inside of what a `{}` stands for (regular expressions)."""


@cache
def templates() -> tuple[tuple[str, str], ...]:
    """All templates, English and French."""
    made: list[tuple[str, str]] = []
    for path in sorted(Path(__file__).with_name("french").glob("*.txt")):
        lines = [t for t in path.read_text(encoding="utf-8").splitlines() if t[:1] not in ("", "#")]
        made += zip(lines[::2], lines[1::2], strict=True)
    return tuple(made)


@cache
def _patterns() -> list[tuple[re.Pattern[str], str]]:
    ordered = sorted(templates(), key=lambda row: -len(row[0].replace("{}", "")))
    return [
        (re.compile("(.+?)".join(map(re.escape, english.split("{}"))), re.DOTALL), french)
        for english, french in ordered
    ]


def in_french(sentence: str) -> str:
    """A sentence in French, unchanged if there is no template for it; lines are told apart."""
    lines = sentence.split("\n")
    told = [in_french(line) for line in lines] if len(lines) > 1 else lines
    if told != lines:
        return "\n".join(told)
    for pattern, french in _patterns():
        found = pattern.fullmatch(sentence)
        if found is not None:
            return french.format(*map(_part, found.groups()))
    return sentence


def _part(text: str) -> str:
    for pattern, french in PARTS:
        text = re.sub(pattern, french, text)
    return text
