"""The entries of a procedure's tables by theme, and other tables of help, as text."""

import textwrap
from collections.abc import Iterator, Sequence
from itertools import groupby, zip_longest

from ssilang.language.registry import HelpTable
from ssilang.language.vocabulary import entries
from ssilang.language.vocabulary.terms import Range
from ssilang.messages.message import COLON, spoken, teller

_COLUMNS = (
    "help.column-index",
    "help.column-types",
    "help.column-unit",
    "help.column-default",
    "help.column-meaning",
)
_MOST = (26, 10, 8, 16)
"""Widths of the columns but the last, at most."""
_LISTED = 6
"""Entries of one row that stand on lines of their own."""

Row = tuple[str, ...]
"""Index, types, unit, default, meaning."""


def entries_text(declared: entries.Declaration, language: str, width: int) -> list[str]:
    """Lines of all tables, a column each for index, types, unit, default and meaning."""
    lines: list[str] = []
    for argument in declared.arguments:
        blocks = list(blocks_of(declared, argument.name, language))
        if not blocks:
            continue
        lines += ["", title_of(declared, argument.name, language)]
        rows = [row for _, rows in blocks for row in rows]
        widths = _widths([heads_of(language), *rows], width)
        lines += _laid_out(heads_of(language), widths)
        for theme, rows in blocks:
            lines += ["", f"  {teller(language)(f'help.theme-{theme}')}"]
            lines += [line for row in rows for line in _laid_out(row, widths)]
    return lines


def tables_text(tables: Sequence[HelpTable], width: int) -> list[str]:
    """Lines of tables of the same columns, the heads before the first."""
    rows = [row for table in tables for row in table.rows]
    if not rows:
        return []
    widths = _widths([tables[0].heads, *rows], width)
    lines = ["", *_laid_out(tables[0].heads, widths)]
    for table in tables:
        lines += ["", f"  {table.title}", *([f"    {table.note}"] if table.note else [])]
        lines += [line for row in table.rows for line in _laid_out(row, widths)]
    return lines


def heads_of(language: str) -> Row:
    """Heads of the columns."""
    return tuple(map(teller(language), _COLUMNS))


def title_of(declared: entries.Declaration, name: str, language: str) -> str:
    """Title of the entries of an argument."""
    subtype = next(a.subtype for a in declared.arguments if a.name == name)
    return teller(language)("help.entries", name=name, subtype=subtype)


def blocks_of(
    declared: entries.Declaration, argument: str, language: str
) -> Iterator[tuple[str, list[Row]]]:
    """Rows of an argument by theme."""
    for theme, members in groupby(declared.of(argument), key=lambda e: e.theme):
        alike = groupby(members, key=_sameness)
        yield theme, [_row(list(group), declared, language) for _, group in alike]


def _sameness(entry: entries.TableEntry) -> tuple[object, ...]:
    """What entries that share a row have in common."""
    table = entry.path[:-2] if entry.index == entries.ANYTHING else entry.path[:-1]
    return (table, entry.types, entry.unit, str(entry.default), entry.en, entry.needed, entry.range)


def _row(group: Sequence[entries.TableEntry], declared: entries.Declaration, language: str) -> Row:
    entry = group[0]
    deep, names = len(entry.path) - 2, [_index(e, language) for e in group]
    if deep and declared.at(entry.path[:-2], entry.path[-2]) is None:  # the table has no row
        deep -= 1
        names = [f"{e.path[-2]} . {name}" for e, name in zip(group, names, strict=True)]
    before = "  " * deep + (". " if deep else "")
    index = " ".join(names) if len(names) > _LISTED else "\n".join(before + name for name in names)
    meaning = entry.said(language)
    if entry.values:
        meaning += "\n" + teller(language)(
            "help.allowed", values=" | ".join(map(entries.as_written, entry.values))
        )
    for bound, code in ((entry.range, "help.range"), (entry.usual, "help.usual-range")):
        if told := bounds_told(bound, entry.index, language):
            meaning += f"\n{teller(language)(code)}{COLON[language]}{told}"
    types = " | ".join(entry.types) or teller(language)("help.any")
    return index, types, entry.unit, _default(entry, language), meaning


def bounds_told(bound: Range, name: str, language: str) -> str:
    """'0 <= NU < 0.5', 'increasing'."""
    words = [bound.text(name), teller(language)("help.increasing") if bound.increasing else ""]
    return ", ".join(filter(None, words))


_ANY = {"": "help.any-index", "unknown": "help.any-unknown"}


def _index(entry: entries.TableEntry, language: str) -> str:
    special = {entries.NUMBER: "help.any-integer", entries.ANYTHING: _ANY[entry.by]}.get(
        entry.index
    )
    return teller(language)(special) if special else entry.index


def _default(entry: entries.TableEntry, language: str) -> str:
    if entry.needed:
        return teller(language)("help.needed")
    default = entry.default
    if default is None:
        return ""
    if isinstance(default, tuple):
        en, fr = default
        return spoken(en, fr, language)
    if isinstance(default, bool):
        return "VRAI" if default else "FAUX"
    return entries.as_written(default) if isinstance(default, str) else f"{default:g}"


def _widths(rows: Sequence[Sequence[str]], width: int) -> list[int]:
    """Widths of the columns: as wide as their longest word, the last takes what is left."""
    widths = []
    for column, most in enumerate(_MOST):
        cells = [row[column] for row in rows]
        lines = [line for cell in cells for line in cell.split("\n")]
        longest = max(
            len(line) - len(line.lstrip(" .")) + max(map(len, line.split()), default=0)
            for line in lines
        )
        widths.append(max(min(max(map(len, lines)), most), longest))
    left = width - 4 - sum(w + 2 for w in widths)
    return [*widths, max(left, 30)]


def _laid_out(row: Sequence[str], widths: Sequence[int]) -> list[str]:
    """A row on as many lines as its longest cell takes."""
    cells = [_wrapped(cell, width) for cell, width in zip(row, widths, strict=True)]
    rows = zip_longest(*cells, fillvalue="")
    padded = (map(str.ljust, row, widths) for row in rows)
    return ["    " + "  ".join(row).rstrip() for row in padded]


def _wrapped(cell: str, width: int) -> list[str]:
    return [
        line
        for part in cell.split("\n")
        for line in textwrap.wrap(part, width, break_long_words=False) or [""]
    ]
