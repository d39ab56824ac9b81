"""Systems of units that a deck may be in: OPTI 'UNIT'.

A system is a unit of length and one of force, with the second; the unit of mass is the one that
makes force = mass times acceleration (a tonne with N and mm). The powers of a quantity stand in
`terms.units`, by its unit of the SI.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ssilang.language import vocabulary
from ssilang.language.vocabulary.terms import UNSAID, Quantity, Range, units
from ssilang.remembered import tables_of

_SYMBOL = re.compile(r"[A-Za-z]+")


@dataclass(frozen=True, slots=True)
class UnitSystem:
    """A system of units.

    Attributes
    ----------
    name : str
        As OPTI 'UNIT' takes it.
    length, force : float
        Its unit of length in m, of force in N.
    symbols : mapping of str to str
        What is written in it for m, kg, N, Pa and J, where that differs.
    """

    name: str
    length: float
    force: float
    symbols: Mapping[str, str]

    @property
    def mass(self) -> float:
        """Its unit of mass in kg."""
        return self.force / self.length

    def factor(self, unit: str) -> float:
        """How many of a unit of the SI its unit here is: 1e9 for 'Pa/m' and N-MM."""
        powers = units()[unit]
        return float(self.mass**powers.mass * self.length**powers.length)

    def written(self, unit: str) -> str:
        """What stands here for a unit of the SI: 't/mm3' for 'kg/m3'."""
        return _SYMBOL.sub(lambda found: self.symbols.get(found[0], found[0]), unit)

    def base(self) -> dict[str, str]:
        """The units of this system by what is measured in them, for machines."""
        return {what: self.written(unit) for what, unit in _MEASURED.items()}

    def in_si(self) -> dict[str, float]:
        """The same with their sizes: 'length: mm' is 1e-3 m."""
        return {f"{what}: {self.written(u)}": self.factor(u) for what, u in _MEASURED.items()}


_TABLES = tables_of(Path(__file__).with_suffix(".toml"))
_MEASURED: dict[str, str] = _TABLES["measured"]
SYSTEMS = {name: UnitSystem(name, **row) for name, row in _TABLES["systems"].items()}

_GRAVITY = 9.81
_HEAVY = Range(900.0, 9000.0)
"""Usual densities (kg/m3), of weights by volume."""


def likely_units(value: float, unit: str, usual: Range, system: UnitSystem) -> dict[str, float]:
    """Units in which an unusual value would be usual, with what it is in the system's unit.

    Parameters
    ----------
    value : float
        A number that was given as one of `system`.
    unit : str
        Its unit of the SI.
    usual : Range
        What is usual, in that unit.
    """
    known = {s.written(unit): s.factor(unit) for s in SYSTEMS.values()}
    known |= _TABLES["further"].get(unit, {})
    known.pop(system.written(unit))
    here = system.factor(unit)
    found = {name: size for name, size in known.items() if value * size in usual}
    if unit == "kg/m3":
        weights = {name: size / _GRAVITY for name, size in _TABLES["weights"].items()}
        found |= {name: size for name, size in weights.items() if value * size in _HEAVY}
    return {name: value * size / here for name, size in found.items()}


def usual_of(said: Range, index: str, unit: str, system: UnitSystem | None) -> Range:
    """What a number usually is: as it is declared, else by its unit of the SI in a system."""
    if said is not UNSAID and not said.increasing:
        return said
    by_unit = _by_unit(index, unit, system)
    return replace(by_unit, increasing=True) if said.increasing else by_unit


def _by_unit(index: str, unit: str, system: UnitSystem | None) -> Range:
    """Of a parameter or of any number of the unit; without a system where that has no part."""
    powers = units().get(unit)
    if not unit or powers is None or (system is None and (powers.mass or powers.length)):
        return UNSAID
    usual = Range(powers.least, powers.most, nought=True)
    size = 1.0 if system is None else system.factor(unit)
    if not math.isfinite(usual.high):
        meant = [w for w in vocabulary.meanings("parameter", index) if isinstance(w, Quantity)]
        usual = next((w.usual for w in meant if w.unit == unit), UNSAID)
    if usual is UNSAID:
        return UNSAID
    return replace(usual, low=usual.low / size, high=usual.high / size)


MATTER: tuple[dict[str, Range], ...] = (
    {"YOUN": Range(1e6), "RHO": Range(10.0, 12e3)},  # Pa, kg/m3; a body may be very rigid
    {"YOUN": Range(1e3, 1e9), "RHO": Range(0.01, 12.0)},  # kPa, t/m3
    {"YOUN": Range(1.0, 1e6), "RHO": Range(1e-5, 0.012)},  # MPa, kt/m3
    {"YOUN": Range(1.0, 1e6), "RHO": Range(1e-11, 12e-9)},  # MPa, t/mm3
    {"YOUN": Range(high=1e4), "RHO": Range(1e-3, 100.0)},  # numbers without units
)
"""What a modulus and a density are together, in each of `SYSTEMS`, in turn, and without units:
outside of all, one of the two is in another."""


WAVES = Range(20.0, 4000.0)
"""Speeds of shear waves (m/s), from mud to the stiffest rock."""
SOIL = ("YOUNG", "POISSON", "MASSE_VOLUMIQUE")
"""Entries of an elastic soil."""
APART = 10.0
"""Times the density of another layer of one ground that none has."""


def wave_flaw(soil: Mapping[str, Any], system: UnitSystem | None) -> dict[str, float] | None:
    """What is wrong with the shear waves of a soil: their speed, in units of length by second."""
    speed = math.sqrt(soil["YOUNG"] / (2.0 + 2.0 * soil["POISSON"]) / soil["MASSE_VOLUMIQUE"])
    here = 1.0 if system is None else system.length
    told = {"speed": speed, "low": WAVES.low / here, "high": WAVES.high / here}
    scaled = system is None and soil["MASSE_VOLUMIQUE"] == 1.0  # a soil without units
    return None if scaled or speed * here in WAVES else told


def result_unit(component: str, index: str) -> str:
    """SI unit of a component of what a calculation keeps at an index, '' if that is not certain.

    UX is in m at 'DEPL' and in m/s at 'VITE'; forces and stresses are what they are.
    """
    meant = {w for w in vocabulary.meanings("component", component) if isinstance(w, Quantity)}
    units = {w.unit or "" for w in meant}
    if len(units) != 1:
        return ""
    unit, unknown = units.pop(), any(w.kind == "unknown" for w in meant)
    if index in _TABLES["rates"]:
        return unit + _TABLES["rates"][index] if unknown and unit in ("m", "rad") else ""
    return "" if unknown else unit
