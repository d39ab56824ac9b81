"""The words of the language, declared once: what each means, in both languages, unit and range.

The vocabulary holds meanings; which parameters a law or an element has, which are mandatory, on
which cells it stands, is known by the kernel (`ssilang.operators.vocabulary.words` joins both).
Each list is a file of TOML beside this one, read when a word of it is first asked for.
"""

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from ssilang.language.search import LIKE, nearest_names
from ssilang.language.vocabulary.terms import Option, Quantity, Unit, Word, read_range
from ssilang.remembered import tables_of

__all__ = [
    "KINDS", "WORDS_OF", "Option", "Quantity", "Unit", "Word", "all_meanings", "find", "full_name",
    "meanings", "names", "near", "words", "words_of",
]  # fmt: skip

KINDS = ("formulation", "law", "element", "parameter", "component", "option", "structure")
"""The lists of words; the file of each is named after it in the plural."""

WORDS_OF: dict[str, tuple[str, ...]] = {
    "MODE": ("formulation", "law", "element"), "MATE": ("parameter",), "CARA": ("parameter",),
    "OPTI": ("option",), "VALE": ("option",), "EXCO": ("component",), "BLOQ": ("component",),
    "FORC": ("component",), "MOME": ("component",),
}  # fmt: skip
"""Lists of words that operators take besides their keywords."""

_FOUR_LETTERS = ("element", "option", "parameter", "structure")
SHORT = 4
"""Characters by which words are told apart, unless the whole word is written."""


@cache
def words(kind: str) -> tuple[Word, ...]:
    """All words of a list."""
    if kind not in KINDS:
        raise KeyError(kind)
    rows = tables_of(Path(__file__).with_name(f"{kind}s.toml"))["word"]
    return tuple(_word(kind, row) for row in rows)


def _word(kind: str, row: dict[str, Any]) -> Word:
    """A word of a list from its table in the list's file."""
    said = (row["name"], row["en"], row["fr"], tuple(row.get("of", ())), row.get("kind", ""))
    if kind == "option":
        values = tuple(Word(v["name"], v["en"], v["fr"]) for v in row.get("values", ()))
        return Option(*said, row.get("takes", ""), values, row.get("default", ""))
    if kind not in ("component", "parameter"):
        return Word(*said)
    within, usual = (read_range(row.get(name, "")) for name in ("range", "usual"))
    beside = {name: read_range(span) for name, span in row.get("beside", {}).items()}
    return Quantity(*said, row.get("unit"), within, usual, row.get("default"), beside)


@cache
def _by_name(kind: str) -> dict[str, tuple[Word, ...]]:
    table: dict[str, tuple[Word, ...]] = {}
    for word in words(kind):
        table[word.name] = (*table.get(word.name, ()), word)
    return table


def names(kind: str) -> tuple[str, ...]:
    """Names of a list, each once."""
    return tuple(_by_name(kind))


def full_name(kind: str, word: str) -> str:
    """The name that `word` writes in full or by its first four characters, '' if none.

    A longer name may be cut anywhere behind its fourth character (JOINT_S); names of four letters
    may be written longer (POUTRE, OPTI MODELE).
    """
    said, table = word.upper().strip(), _by_name(kind)
    if said in table or len(said) < SHORT:
        return said if said in table else ""
    longer = next((n for n in table if n.startswith(said)), "")
    short = said[:SHORT] if kind in _FOUR_LETTERS and said[:SHORT] in table else ""
    return longer or short


def meanings(kind: str, word: str) -> tuple[Word, ...]:
    """All meanings of a word in a list, none if it does not know it."""
    return _by_name(kind).get(full_name(kind, word), ())


def words_of(operator: str) -> tuple[str, ...]:
    """Names that an operator takes besides its keywords."""
    return tuple(dict.fromkeys(n for kind in WORDS_OF.get(operator, ()) for n in names(kind)))


def find(kind: str, word: str, of: Iterable[str] = ()) -> Word | None:
    """What a word means, for a law or an element if `of` names it (and its families).

    The meaning limited to one of `of` is taken, else the one that holds everywhere, else the first.
    """
    found, owners = meanings(kind, word), set(of)
    special = next((w for w in found if owners.intersection(w.of)), None)
    general = next((w for w in found if not w.of), None)
    return special or general or next(iter(found), None)


def all_meanings(word: str) -> list[tuple[str, Word]]:
    """Every meaning of a word: list and word; values of options come under 'value'."""
    found = [(kind, meaning) for kind in KINDS for meaning in meanings(kind, word)]
    said = word.upper().strip()
    for option in words("option"):
        values = option.values if isinstance(option, Option) else ()
        chosen = [v for v in values if said in (v.name, v.name[:SHORT])]
        found += [("value", replace(v, of=(option.name,))) for v in chosen]
    return found


def near(kind: str, word: str, among: Iterable[str] = (), least: float = LIKE) -> list[str]:
    """Names of a list (or of `among`) that look like a word, the nearest first."""
    return nearest_names(word, among or names(kind), least)
