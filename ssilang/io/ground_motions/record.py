"""A ground motion as a file has it: values, step or times, quantity, and the unit it names."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError
from ssilang.kernel.base.arrays import FloatArray

G = 9.81
"""Standard gravity as the rest of the house takes it (m/s2)."""
_IN_SI = {
    "G": G, "%G": G / 100.0, "MG": G / 1000.0, "GAL": 0.01,
    "CM/S2": 0.01, "CM/S": 0.01, "CM": 0.01, "MM/S2": 1e-3, "MM/S": 1e-3, "MM": 1e-3,
    "IN/S2": 0.0254, "IN/S": 0.0254, "IN": 0.0254, "M/S2": 1.0, "M/S": 1.0, "M": 1.0,
}  # fmt: skip


def plain_unit(said: str) -> str:
    """A unit by its one spelling: 'cm/sec/sec', 'CM/S**2' and 'cm/s^2' are CM/S2."""
    unit = re.sub(r"\s|\^|\*", "", said.upper()).replace("SEC", "S").replace("\u00b2", "2")
    return unit.replace("S/S", "S2")


@dataclass(frozen=True)
class GroundMotion:
    """A record."""

    values: FloatArray  # (n,) in the file's unit
    dt: float  # step (s); 0 if `given` has the times
    event: str
    quantity: str  # 'ACCE', 'VITE' or 'DEPL'
    unit: str = ""  # what the file says it is, '' where it says nothing
    given: FloatArray | None = None  # (n,) times (s) of a file that lists them
    left_out: int = 0  # values behind those that the file says it has

    @property
    def in_si(self) -> float:
        """Factor that makes SI of its unit, 1 for those not known."""
        return _IN_SI.get(plain_unit(self.unit), 1.0)

    @property
    def motion(self) -> tuple[float, bytes]:
        """What two files of the same motion have in common: zeros before and behind are nothing."""
        step = float(np.diff(self.times[:2]).sum())
        return step, (np.trim_zeros(self.values) * self.in_si).tobytes()

    @property
    def has_unit(self) -> bool:
        """Whether the file names a unit that is known."""
        return plain_unit(self.unit) in _IN_SI

    @property
    def times(self) -> FloatArray:
        """Times (n,); the first is 0 where the file has a step."""
        if self.given is not None:
            return self.given
        return np.asarray(self.dt * np.arange(len(self.values)), dtype=np.float64)


_WORDS = {"ACC": "ACCE", "VEL": "VITE", "VIT": "VITE", "DIS": "DEPL", "DEP": "DEPL"}
_QUANTITY = re.compile(rf"(?<![A-Z])({'|'.join(_WORDS)})", re.IGNORECASE)


def quantity_of(text: str) -> str:
    """ACCE, VITE or DEPL, whichever a text names first; '' if it names none."""
    found = _QUANTITY.search(text)
    return "" if found is None else _WORDS[found[1].upper()]


def is_unit(said: str) -> bool:
    """Whether a unit is known."""
    return plain_unit(said) in _IN_SI


def real(text: str) -> float:
    """A number as Fortran writes it, NaN for what is none: `1_0` is 10 in Python alone."""
    try:
        plain = text.isascii() and "_" not in text
        return float(text.upper().replace("D", "E")) if plain else math.nan
    except ValueError:
        return math.nan


_STEPS = 1e-9, 1e3  # s: no instrument is as fast, or as slow


def check_step(path: Path, step: float, most: float = _STEPS[1]) -> float:
    """The same step (s), the smallest of a file that lists times.

    Raises
    ------
    InputError
        If no record has it.
    """
    if not _STEPS[0] <= step <= most or math.isinf(step):
        told = {"least": _STEPS[0], "most": _STEPS[1]}
        raise InputError("io.record-step", name=path.name, step=step, **told)
    return step


def finite(path: Path, values: FloatArray) -> FloatArray:
    """The same values.

    Raises
    ------
    InputError
        If there is none, or one is too large for a number.
    """
    if not values.size:
        raise InputError("io.record-empty", name=path.name)
    if not np.isfinite(values).all():
        raise InputError("io.record-not-finite", name=path.name)
    return values
