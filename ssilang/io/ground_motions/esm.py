"""Ground motions in the text format of the ESM and ITACA databases (files .ASC)."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError
from ssilang.io.ground_motions.record import GroundMotion, finite, lines_of, quantity_of
from ssilang.kernel.base.arrays import FloatArray


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
    try:
        dt = float(head["SAMPLING_INTERVAL_S"])
    except (KeyError, ValueError):
        dt = math.nan
    if not 0.0 < dt < math.inf:
        raise InputError("io.esm-without-step", name=path.name)
    values = _values(path, lines, begin)
    if (said := head.get("NDATA", "")).isdigit() and int(said) != len(values):
        raise InputError(
            "io.esm-other-count", name=path.name, count=int(said), n_values=len(values)
        )
    quantity = quantity_of(head.get("DATA_TYPE", "")) or "ACCE"
    event = " ".join(head[k] for k in ("EVENT_NAME", "STATION_CODE", "STREAM") if head.get(k))
    return GroundMotion(values, dt, event, quantity, head.get("UNITS", "").upper())


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _values(path: Path, lines: list[str], begin: int) -> FloatArray:
    found = []
    for number, line in enumerate(lines[begin:], start=begin + 1):
        if not (text := line.strip()):
            continue
        if not _is_number(text):
            raise InputError(
                "io.record-line-no-number", name=path.name, number=number, rest=text[:20]
            )
        found.append(float(text))
    return finite(path, np.array(found))
