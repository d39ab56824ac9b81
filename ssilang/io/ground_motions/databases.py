"""Ground motions in the format of the PEER database (files .AT2, .VT2, .DT2).

Ground motions in the text format of the ESM and ITACA databases (files .ASC).
"""

import math
import re
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError
from ssilang.io.ground_motions.record import (
    GroundMotion,
    check_step,
    finite,
    lines_of,
    quantity_of,
    real,
)
from ssilang.kernel.base.arrays import FloatArray

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
    lines = lines_of(path)
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
    lines = lines_of(path)
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
