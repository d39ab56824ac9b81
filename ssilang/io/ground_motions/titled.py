"""Ground motions as a table: a column of times, further columns of values, titles with units."""

import re
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError
from ssilang.io.ground_motions.record import (
    GroundMotion,
    check_step,
    finite,
    is_unit,
    lines_of,
    quantity_of,
    real,
)
from ssilang.kernel.base.arrays import FloatArray

_IN_BRACKETS = re.compile(r"[(\[]\s*([^()\[\]]+?)\s*[)\]]")
_BEHIND = re.compile(r"(?:_|\bin\s+|\s)([^\s_]+)$", re.IGNORECASE)
_TIMES = {"S": 1.0, "SEC": 1.0, "SECOND": 1.0, "SECONDS": 1.0, "SECONDES": 1.0, "MS": 1e-3}
_BY_UNIT = {"S2": "ACCE", "G": "ACCE", "S": "VITE", "M": "DEPL"}


def read_titled(path: Path) -> list[GroundMotion]:
    """Read a table; a record for each of its columns but the first, the times.

    Cells stand between ; or , or tabs, else between blanks. The line before the first that has
    numbers alone holds the titles: `time (s); acceleration (cm/s2)`, `t [s], ax_g`.

    Raises
    ------
    InputError
        If it cannot be read, a cell is no number, there are fewer than two columns or lines, or
        times do not increase.
    """
    lines = lines_of(path)
    text = [(i, x) for i, x in enumerate(lines, 1) if x.strip()]
    sign = next((s for s in ";\t," if any(s in x for _, x in text)), "")
    rows = [(i, _cells(x, sign)) for i, x in text]
    first = next((k for k, (_, cells) in enumerate(rows) if _are_numbers(cells)), len(rows))
    values = _table(path, rows[first:])
    titles = rows[first - 1][1] if 0 < first < len(rows) else []
    if len(titles) != values.shape[1]:
        titles = [""] * values.shape[1]
    unit = _unit(titles[0]).upper()
    times = values[:, 0] * _TIMES.get(unit, 1.0)
    if unit and unit not in _TIMES:
        raise InputError("io.titled-time-unit", name=path.name, title=titles[0])
    with np.errstate(over="ignore"):  # steps of infinity are refused
        steps = np.diff(times)
    if (falling := np.flatnonzero(steps <= 0.0)).size:
        line = rows[first + int(falling[0]) + 1][0]
        raise InputError("io.titled-times-fall", name=path.name, line=line)
    for step in (steps.min(), steps.max()):
        check_step(path, float(step), np.inf)
    return [
        GroundMotion(column, 0.0, title.strip(), _quantity(title), _unit(title), times)
        for title, column in zip(titles[1:], values[:, 1:].T, strict=True)
    ]


def _cells(line: str, sign: str) -> list[str]:
    cells = line.strip().lstrip("#%").split(sign) if sign else line.strip().lstrip("#%").split()
    while len(cells) > 1 and not cells[-1].strip():
        cells.pop()
    return [c.strip().strip('"') for c in cells]


def _are_numbers(cells: list[str]) -> bool:
    return not np.isnan([real(c) for c in cells]).any()


def _table(path: Path, rows: list[tuple[int, list[str]]]) -> FloatArray:
    """Values (n, columns) of the lines below the titles."""
    if len(rows) < 2 or len(rows[0][1]) < 2:
        raise InputError("io.titled-no-table", name=path.name)
    for line, cells in rows:
        if len(cells) != len(rows[0][1]):
            raise InputError(
                "io.titled-other-columns", name=path.name, line=line, count=len(cells),
                needed=len(rows[0][1]),
            )  # fmt: skip
        if (wrong := next((c for c in cells if np.isnan(real(c))), None)) is not None:
            raise InputError("io.line-no-number", name=path.name, line=line, text=wrong)
    return finite(path, np.array([[real(c) for c in cells] for _, cells in rows]))


def _unit(title: str) -> str:
    """The unit that a title names: what stands in brackets, or its end if that is a unit."""
    if (said := _IN_BRACKETS.search(title)) is not None:
        return said[1]
    behind = _BEHIND.search(title.strip())
    if behind is not None and (is_unit(behind[1]) or behind[1].upper() in _TIMES):
        return behind[1]
    return ""


def _quantity(title: str) -> str:
    """ACCE, VITE or DEPL, by the title's words, else by its unit."""
    end = re.sub(r"SEC", "S", _unit(title).upper()).replace("^", "").replace("/S/S", "S2")
    return quantity_of(title) or next((w for k, w in _BY_UNIT.items() if end.endswith(k)), "ACCE")
