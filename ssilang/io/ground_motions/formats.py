"""Ground motions in the formats of databases, and as tables with titles.

PEER (files .AT2, .VT2, .DT2), ESM and ITACA (text, files .ASC), COSMOS version 1.20 (files .V1 .V2,
.V1C .V2C): Strong Motion Programs Board, COSMOS Strong Motion Data Format, 2001: a text header, 100
integers, 100 reals, comments and the values, each block under a line that says how many follow and
in which columns. The 34th real is the step in seconds. Tables: a column of times, further columns
of values, titles with units.
"""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError, text_of
from ssilang.io.ground_motions.record import (
    GroundMotion,
    check_step,
    finite,
    is_unit,
    quantity_of,
    real,
)
from ssilang.kernel.base.arrays import FloatArray

_VERSION = re.compile(r"Format\s*v?\s*(\d+\.\d+)", re.IGNORECASE)
_COLUMNS = r"Format\s*=?\s*\(\s*(\d+)[EFG](\d+)"
_REALS = re.compile(
    r"^\s*(\d+)\s+Real-header values follow on\s+(\d+)\s+lines\s*,?\s*" + _COLUMNS, re.IGNORECASE
)
_SERIES = re.compile(
    r"^\s*(\d+)\s+(accel|veloc|displ)\w*\.?\s+(?:pts|points|data)\b(.*?)" + _COLUMNS, re.IGNORECASE
)
_UNIT_OF_COSMOS = re.compile(r"units?\s*=\s*([^(,]+)", re.IGNORECASE)
_ABOUT = re.compile(r"(?:approx\.?|for|about)\s+(\d+\.?\d*)\s*sec", re.IGNORECASE)
_QUANTITIES = {"ACCEL": "ACCE", "VELOC": "VITE", "DISPL": "DEPL"}
_STEP = 33  # place of the step among the reals
_LARGEST = 9  # digits of a number of values that a file can hold


@dataclass(frozen=True)
class _Block:
    """Where numbers stand: first line (from 0), how many, columns of a line and their width."""

    first: int
    count: int
    columns: int
    width: int


def read_cosmos(path: Path) -> list[GroundMotion]:
    """Read all records of a file, in its order.

    Raises
    ------
    InputError
        If it cannot be read, is of another version, has no record or step, a value that is no
        number or fewer values than it says, or a duration that its step does not give.
    """
    lines = text_of(path, "latin-1").splitlines()
    version = next((m[1] for line in lines[:1] if (m := _VERSION.search(line))), "")
    if version.lstrip("0") != "1.20":
        raise InputError("io.cosmos-other-version", name=path.name, version=version)
    begins = [i for i, line in enumerate(lines) if _VERSION.search(line)]
    ends = [*begins[1:], len(lines)]
    return [_record(path, lines, *part) for part in zip(begins, ends, strict=True)]


def _record(path: Path, lines: list[str], begin: int, end: int) -> GroundMotion:
    """The record of some lines."""
    step = 0.0
    for i in range(begin, end):
        if (m := _REALS.match(lines[i])) is not None:
            reals = _numbers(path, lines, _Block(i + 1, int(m[1]), int(m[3]), int(m[4])), end)
            step = float(reals[_STEP]) if len(reals) > _STEP else 0.0
        elif (m := _SERIES.match(lines[i])) is not None and len(m[1]) <= _LARGEST:
            if not step > 0.0:
                raise InputError("io.cosmos-without-step", name=path.name)
            check_step(path, step)
            block = _Block(i + 1, int(m[1]), int(m[4]), int(m[5]))
            values = _numbers(path, lines, block, end)
            _check_duration(path, m[3], step * len(values))
            unit = _UNIT_OF_COSMOS.search(m[3])
            event = lines[begin + 1].strip() if begin + 1 < end else ""
            said = "" if unit is None else unit[1].strip()
            return GroundMotion(values, step, event, _QUANTITIES[m[2].upper()], said)
    raise InputError("io.cosmos-without-series", name=path.name)


def _check_duration(path: Path, told: str, duration: float) -> None:
    """Refuse a step that does not give the duration of the line above the values."""
    about = _ABOUT.search(told)
    if about is not None and abs(duration - float(about[1])) > max(1.0, 0.02 * duration):
        said = float(about[1])
        raise InputError("io.cosmos-duration", name=path.name, said=said, duration=duration)


def _numbers(path: Path, lines: list[str], block: _Block, end: int) -> FloatArray:
    """Numbers in columns, which may touch."""
    found: list[float] = []
    for i in range(block.first, end):
        if len(found) >= block.count:
            break
        line = lines[i].rstrip()
        cells = [line[k : k + block.width] for k in range(0, len(line), block.width)]
        numbers = [real(cell) for cell in cells[: block.columns]]
        if not cells or np.isnan(numbers).any():
            break
        found += numbers
    if len(found) < block.count:
        raise InputError(
            "io.cosmos-too-few", name=path.name, line=block.first, count=block.count,
            n_values=len(found),
        )  # fmt: skip
    return finite(path, np.array(found[: block.count]))


_DIGITS = 12  # of a number of values that a file can hold
_HEADER = 4  # lines: source, event and station, quantity and unit, number of values and step
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?")
_SIZES = (  # the fourth line, as files of different years have it
    re.compile(r"NPTS\s*=\s*(\d+)\s*,?\s*DT\s*=\s*([\d.EeDd+-]+)", re.IGNORECASE),
    re.compile(r"^\s*(\d+)\s+([\d.EeDd+-]+)\s*(?:NPTS|$)", re.IGNORECASE),
)
_UNIT = re.compile(r"UNITS?\s*(?:OF|IN|=|:)?\s*([A-Z][A-Z0-9/*^]*)", re.IGNORECASE)
_BY_ENDING = {".VT2": "VITE", ".DT2": "DEPL"}


def read_peer(path: Path) -> GroundMotion:
    """Read a record; neighbouring values may touch (`-.12E-02-.34E-02`).

    Raises
    ------
    InputError
        If the file cannot be read, its fourth line has no number of values and step, or it holds
        fewer values than it says, or none.
    """
    lines = text_of(path, "latin-1").splitlines()
    count, dt = _sizes(path, lines)
    values = np.array([real(t) for t in _peer_values(path, lines)])
    if len(values) < count:
        raise InputError(
            "io.line-says-values-file", name=path.name, count=count, n_values=len(values)
        )
    finite(path, values[:count])
    quantity = quantity_of(lines[2]) or _BY_ENDING.get(path.suffix.upper(), "ACCE")
    unit = _UNIT.search(lines[2])
    said = unit[1].upper() if unit is not None else ""
    left_out = len(values) - count
    return GroundMotion(values[:count], dt, lines[1].strip(), quantity, said, left_out=left_out)


def _sizes(path: Path, lines: list[str]) -> tuple[int, float]:
    if len(lines) >= _HEADER:
        for pattern in _SIZES:
            if (found := pattern.search(lines[_HEADER - 1])) is not None:
                dt = real(found[2].rstrip("."))
                if 0.0 < dt < math.inf and len(found[1]) < _DIGITS:
                    return int(found[1]), check_step(path, dt)
    raise InputError("io.line-no-npts-dt", name=path.name)


def _peer_values(path: Path, lines: list[str]) -> list[str]:
    found: list[str] = []
    for number, line in enumerate(lines[_HEADER:], start=_HEADER + 1):
        if (rest := _NUMBER.sub("", line).strip()) != "":
            raise InputError(
                "io.record-line-no-number", name=path.name, number=number, rest=rest[:20]
            )
        found += _NUMBER.findall(line)
    return found


def read_esm(path: Path) -> GroundMotion:
    """Read a record: lines 'KEY: VALUE', then a value a line.

    Raises
    ------
    InputError
        If the file cannot be read, its head has no SAMPLING_INTERVAL_S, a value is no number, or
        it holds fewer values than NDATA says.
    """
    lines = text_of(path, "latin-1").splitlines()
    begin = next((i for i, line in enumerate(lines) if _is_number(line)), len(lines))
    head = {k.strip().upper(): v.strip() for k, _, v in (x.partition(":") for x in lines[:begin])}
    dt = real(head.get("SAMPLING_INTERVAL_S", ""))
    if not 0.0 < dt < math.inf:
        raise InputError("io.esm-without-step", name=path.name)
    check_step(path, dt)
    values = _esm_values(path, lines, begin)
    if (said := head.get("NDATA", "")).isdigit() and int(said) != len(values):
        raise InputError(
            "io.esm-other-count", name=path.name, count=int(said), n_values=len(values)
        )
    quantity = quantity_of(head.get("DATA_TYPE", "")) or "ACCE"
    event = " ".join(head[k] for k in ("EVENT_NAME", "STATION_CODE", "STREAM") if head.get(k))
    return GroundMotion(values, dt, event, quantity, head.get("UNITS", "").upper())


def _is_number(text: str) -> bool:
    return not math.isnan(real(text))


def _esm_values(path: Path, lines: list[str], begin: int) -> FloatArray:
    found = []
    for number, line in enumerate(lines[begin:], start=begin + 1):
        if not (text := line.strip()):
            continue
        if not _is_number(text):
            raise InputError(
                "io.record-line-no-number", name=path.name, number=number, rest=text[:20]
            )
        found.append(real(text))
    return finite(path, np.array(found))


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
    lines = text_of(path, "latin-1").splitlines()
    text = [(i, x) for i, x in enumerate(lines, 1) if x.strip()]
    sign = next((s for s in ";\t," if any(s in x for _, x in text)), "")
    rows = [(i, _cells(x, sign)) for i, x in text]
    begins = (k for k, (_, cells) in enumerate(rows) if not np.isnan([*map(real, cells)]).any())
    first = next(begins, len(rows))
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
