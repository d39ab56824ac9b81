"""Ground motions in the format of COSMOS, version 1.20 (files .V1 .V2, .V1C .V2C).

Strong Motion Programs Board, COSMOS Strong Motion Data Format, 2001: a text header, 100 integers,
100 reals, comments and the values, each block under a line that says how many follow and in which
columns. The 34th real is the step in seconds.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError
from ssilang.io.ground_motions.record import GroundMotion, check_step, finite, lines_of, real
from ssilang.kernel.base.arrays import FloatArray

_VERSION = re.compile(r"Format\s*v?\s*(\d+\.\d+)", re.IGNORECASE)
_COLUMNS = r"Format\s*=?\s*\(\s*(\d+)[EFG](\d+)"
_REALS = re.compile(
    r"^\s*(\d+)\s+Real-header values follow on\s+(\d+)\s+lines\s*,?\s*" + _COLUMNS, re.IGNORECASE
)
_SERIES = re.compile(
    r"^\s*(\d+)\s+(accel|veloc|displ)\w*\.?\s+(?:pts|points|data)\b(.*?)" + _COLUMNS, re.IGNORECASE
)
_UNIT = re.compile(r"units?\s*=\s*([^(,]+)", re.IGNORECASE)
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
    lines = lines_of(path)
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
            unit = _UNIT.search(m[3])
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
