"""The parameters of all laws as tables, for the help of MATE: what is declared, and no prose."""

from collections.abc import Iterator

from ssilang.kernel.materials.model import Mode, Zone
from ssilang.language import vocabulary
from ssilang.language.registry import HelpTable
from ssilang.language.vocabulary.terms import Word
from ssilang.messages.message import teller
from ssilang.operators.vocabulary.pages import default_told, label
from ssilang.operators.vocabulary.words import (
    OF_BODIES,
    Row,
    parameter_rows,
    sample,
    sample_of_law,
)

_KINDS = (*OF_BODIES, "contact")
_COLUMNS = ("help.column-parameter", "help.column-unit", "help.column-default",
            "help.column-range", "help.column-meaning")  # fmt: skip


def law_tables(language: str) -> list[HelpTable]:
    """A table for each law: name, unit, default, range and meaning of its parameters.

    What an earlier law has as well stands there alone, if this one has all of it.
    """
    told = teller(language)
    heads = tuple(told(code) for code in _COLUMNS)
    before: dict[str, list[Row]] = {}
    made = []
    for law, zone in _laws():
        rows = [row for row in parameter_rows(zone) if not row.word.kind]
        like = max(
            (name for name, taken in before.items() if all(row in rows for row in taken)),
            key=lambda name: len(before[name]),
            default="",
        )
        own = [row for row in rows if row not in before.get(like, ())]
        code = "help.parameters-besides" if own else "help.parameters-of"
        note = told(code, law=like) if like else ""
        written = " ".join(zone.behaviour[-2:])
        before[written] = rows
        title = f"{written} : {label('law', law, language)}"
        made.append(HelpTable(title, note, heads, tuple(_cells(row, language) for row in own)))
    return made


def _laws() -> Iterator[tuple[Word, Zone]]:
    """Each law with a zone that has it, by kind; bonded joints before the other laws of joints."""
    for kind in _KINDS:
        if kind == "joint":
            bonded = sample("JOI2", Mode.PLANE_STRAIN, ("ELASTIQUE",))
            yield Word("ELASTIQUE", "", "", (), kind), bonded
        for law in vocabulary.words("law"):
            zone = sample_of_law(law) if law.kind == kind else None
            if zone is not None:
                yield law, zone


def _cells(row: Row, language: str) -> tuple[str, ...]:
    word = row.word
    told = (default_told(row, language), word.range.text(word.name), word.meaning(language))
    return word.name, word.unit or "", *told
