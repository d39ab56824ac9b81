"""Ground motions in the format of the PEER database (files .AT2, .VT2, .DT2)."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError
from ssilang.kernel.base.arrays import FloatArray
from ssilang.system_reasons import system_reason

_DIGITS = 12  # of a number of values that a file can hold
_HEADER = 4  # lines: source, event and station, quantity and unit, number of values and step
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?")
_SIZES = (  # the fourth line, as files of different years have it
    re.compile(r"NPTS\s*=\s*(\d+)\s*,?\s*DT\s*=\s*([\d.EeDd+-]+)", re.IGNORECASE),
    re.compile(r"^\s*(\d+)\s+([\d.EeDd+-]+)\s*(?:NPTS|$)", re.IGNORECASE),
)
_UNIT = re.compile(r"UNITS?\s*(?:OF|IN|=|:)?\s*([A-Z][A-Z0-9/*^]*)", re.IGNORECASE)
_IN_SI = {
    "G": 9.81,
    **dict.fromkeys(("GAL", "CM/S", "CM", "CM/S2", "CM/S/S", "CM/S**2", "CM/S^2"), 0.01),
}
_SI = frozenset(("M/S2", "M/S/S", "M/S**2", "M/S^2", "M/S", "M"))
_QUANTITIES = {"ACC": "ACCE", "VEL": "VITE", "DIS": "DEPL"}


@dataclass(frozen=True)
class PeerRecord:
    """A record: values (n,) in the file's unit, step dt (s), event, quantity ACCE VITE or DEPL.

    `unit` is what the third line says it is, '' where it says nothing.
    """

    values: FloatArray
    dt: float
    event: str
    quantity: str
    unit: str = ""

    @property
    def in_si(self) -> float:
        """Factor that makes SI of its unit, 1 for those not known."""
        return _IN_SI.get(self.unit, 1.0)

    @property
    def has_unit(self) -> bool:
        """Whether the file names a unit that is known."""
        return self.unit in _IN_SI or self.unit in _SI

    @property
    def times(self) -> FloatArray:
        """Times (n,), the first is 0."""
        return np.asarray(self.dt * np.arange(len(self.values)), dtype=np.float64)


def read_peer(path: Path) -> PeerRecord:
    """Read a record; neighbouring values may touch (`-.12E-02-.34E-02`).

    Raises
    ------
    InputError
        If the file cannot be read, its fourth line has no number of values and step, or it holds
        fewer values than it says.
    """
    try:
        lines = path.read_text(encoding="latin-1").splitlines()
    except OSError as error:
        raise InputError("io.cannot-read", path=path, strerror=system_reason(error)) from error
    count, dt = _sizes(path, lines)
    values = np.array([_real(t) for t in _values(path, lines)])
    if len(values) < count:
        raise InputError(
            "io.line-says-values-file", name=path.name, count=count, n_values=len(values)
        )
    if not np.isfinite(values[:count]).all():
        raise InputError("io.record-not-finite", name=path.name)
    quantity = next((w for k, w in _QUANTITIES.items() if k in lines[2].upper()), "ACCE")
    unit = _UNIT.search(lines[2])
    said = unit[1].upper() if unit is not None else ""
    return PeerRecord(values[:count], dt, lines[1].strip(), quantity, said)


def _sizes(path: Path, lines: list[str]) -> tuple[int, float]:
    if len(lines) >= _HEADER:
        for pattern in _SIZES:
            if (found := pattern.search(lines[_HEADER - 1])) is not None:
                dt = _real(found[2].rstrip("."))
                if 0.0 < dt < math.inf and len(found[1]) < _DIGITS:
                    return int(found[1]), dt
    raise InputError("io.line-no-npts-dt", name=path.name)


def _real(text: str) -> float:
    """A number as Fortran writes it, NaN for what is none."""
    try:
        return float(text.upper().replace("D", "E"))
    except ValueError:
        return math.nan


def _values(path: Path, lines: list[str]) -> list[str]:
    found: list[str] = []
    for number, line in enumerate(lines[_HEADER:], start=_HEADER + 1):
        if (rest := _NUMBER.sub("", line).strip()) != "":
            raise InputError("io.line-no-number-2", name=path.name, number=number, rest=rest[:20])
        found += _NUMBER.findall(line)
    return found
