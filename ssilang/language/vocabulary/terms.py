"""What is said of a word: meanings, units, ranges."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.language.values import ListEnti, ListReel, type_of
from ssilang.messages.message import spoken
from ssilang.remembered import tables_of


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of the SI with the powers of mass, length, time and temperature in it.

    A quantity in a system of other base units has the same powers. Entries of tables are usually
    between `least` and `most`, in SI, or nought.
    """

    mass: int = 0
    length: int = 0
    time: int = 0
    temperature: int = 0
    least: float = -math.inf
    most: float = math.inf


@cache
def units() -> dict[str, Unit]:
    """All units by their symbols."""
    tables = tables_of(Path(__file__).with_name("units.toml"))
    return {symbol: Unit(**powers) for symbol, powers in tables.items()}


@dataclass(frozen=True, slots=True)
class Range:
    """Finite numbers from `low` to `high`; an open end does not belong to it.

    Lists of `increasing` ones have at least one number, and each is above the one before. Of one
    without `zero` that number makes no sense. What is `carried` may be infinite or no number. With
    `nought` zero belongs wherever the ends are; lists of `some` have a number that is not zero.
    """

    low: float = -math.inf
    high: float = math.inf
    open_low: bool = False
    open_high: bool = False
    increasing: bool = False
    zero: bool = True
    carried: bool = False
    nought: bool = False
    some: bool = False

    @property
    def bounded(self) -> bool:
        """Whether there are numbers outside of it."""
        return self is not UNSAID and not self.carried

    def flaw(self, value: Any, name: str) -> tuple[str, dict[str, object]] | None:
        """What is wrong with a number or a list of them: a code and data; None if nothing is.

        Nothing is judged where numbers are carried; of curves the ordinates are, and of other
        objects a vector alone, where it must not be zero.
        """
        if not self.bounded or isinstance(value, bool):
            return None
        if isinstance(value, int | float):
            return None if value in self else self._outside(value, name)
        curves = getattr(value, "parts", None) if type_of(value) == "EVOLUTIO" else None
        if curves is not None:  # what `check` knows of a curve has none
            numbers = np.hstack([(), *(p.ordinates for p in curves if p.ordinates.size)]).real
        elif isinstance(value, ListReel | ListEnti):
            numbers = np.asarray(value.values, dtype=float)
        else:
            vector = None if self.zero else getattr(value, "coordinates", None)
            return None if vector is None or np.any(vector) else self._outside(0.0, name)
        with np.errstate(invalid="ignore"):
            above = numbers > self.low if self.open_low else numbers >= self.low
            below = numbers < self.high if self.open_high else numbers <= self.high
        belong = np.isfinite(numbers) & above & below & (self.zero | (numbers != 0.0))
        belong |= self.nought & (numbers == 0.0)
        if not belong.all():
            return self._outside(float(numbers[~belong][0]), name)
        if self.some and numbers.size and not numbers.any():
            return "of-noughts", {}
        if not self.increasing:
            return None
        falls = np.flatnonzero(np.diff(numbers) <= 0.0)
        if numbers.size and not falls.size:
            return None
        place = int(falls[0]) + 1 if falls.size else 0
        before, after = numbers[place - 1 : place + 1].tolist() if place else (0.0, 0.0)
        told = {"value": after, "before": before, "place": place, "next_place": place + 1}
        return "not-increasing", {**told, "count": numbers.size}

    def _outside(self, value: float, name: str) -> tuple[str, dict[str, object]]:
        text = self.text(name)
        return "out-of-range" if text else "not-finite", {"value": value, "range": text}

    def __contains__(self, value: float) -> bool:
        above = value > self.low if self.open_low else value >= self.low
        below = value < self.high if self.open_high else value <= self.high
        finite = isinstance(value, int) or math.isfinite(value)  # integers may be past all reals
        return (finite and above and below and (self.zero or value != 0)) or (
            self.nought and value == 0
        )

    def text(self, name: str) -> str:
        """As an inequality: 'NU > -1', '-1 < NU <= 0.5', 'N != 0', '0 < |N| <= 10'."""
        if not self.zero:
            return f"0 < |{name}| <= {self.high:g}" if math.isfinite(self.high) else f"{name} != 0"
        bounded = math.isfinite(self.low), math.isfinite(self.high)
        left, right = "<" if self.open_low else "<=", "<" if self.open_high else "<="
        if all(bounded):
            return f"{self.low:g} {left} {name} {right} {self.high:g}"
        if bounded[0]:
            return f"{name} {left.replace('<', '>')} {self.low:g}"
        return f"{name} {right} {self.high:g}" if bounded[1] else ""


def read_range(text: str) -> Range:
    """A range as files write it: '> 0', '0 <= x < 0.5', 'increasing >= 0', 'any', 'some'."""
    if text in _NAMED:
        return _NAMED[text]
    increasing = text.startswith("increasing")
    low, high, opens = -math.inf, math.inf, [False, False]
    left, named, right = text.removeprefix("increasing").partition("x")
    turned = {"<": ">", "<=": ">="}
    parts = left.split() if not named else [turned[left.split()[1]], left.split()[0]]
    for sign, number in (parts, right.split()) if named else (parts,) if parts else ():
        if sign[0] == ">":
            low, opens[0] = float(number), sign == ">"
        else:
            high, opens[1] = float(number), sign == "<"
    return Range(low, high, opens[0], opens[1], increasing)


UNSAID = Range()
"""Nothing is declared: of what is no number."""
ANY_NUMBER = Range(open_low=True, open_high=True)
"""Any finite number has sense: coordinates, forces, factors."""
CARRIED = Range(open_low=True, open_high=True, carried=True)
"""What came with a warning when a list was divided by zero goes on: values of lists."""
NOT_ZERO = Range(zero=False)
CELLS_ALONG = Range(-1e7, 1e7)
"""Elements of a line, layers of a body, graded if negative, by the sizes if 0; more do not fit."""
POSITIVE = Range(0.0, open_low=True)
NOT_NEGATIVE = Range(0.0)
RISING = Range(0.0, increasing=True)
IN_ORDER = Range(increasing=True)
BELOW_CRITICAL = Range(0.0, 1.0, open_high=True)
_NAMED = {"": UNSAID, "any": ANY_NUMBER, "!= 0": NOT_ZERO, "some": Range(some=True)}


def between(low: float, high: float) -> Range:
    """From `low` to `high`, both included."""
    return Range(low, high)


@dataclass(frozen=True, slots=True)
class Word:
    """One meaning of a word.

    Attributes
    ----------
    name : str
        In full, in capitals.
    en, fr : str
        What it is, one sentence without its full stop.
    of : tuple of str
        What the meaning is limited to: laws, elements, families of elements; empty: everywhere.
    kind : str
        What sort of a word it is among those of its list ('joint' law, 'stress' component).
    """

    name: str
    en: str
    fr: str
    of: tuple[str, ...] = ()
    kind: str = ""

    def meaning(self, language: str) -> str:
        """In English ('en') or French ('fr')."""
        return spoken(self.en, self.fr, language)


@dataclass(frozen=True, slots=True)
class Quantity(Word):
    """A word that stands for a number: unit, what is admissible, what is usual.

    Attributes
    ----------
    unit : str or None
        A key of `units`; None where it is no number, or depends on what it stands in.
    range : Range
        Outside of it the value is refused.
    usual : Range
        Outside of it the value is probably in another unit (SI).
    default : float or None
        What is taken where it is not given, if that is a number and the kernel has no data of it.
    beside : mapping of str to Range
        Outside of it the ratio to that other word of the same unit is unusual.
    """

    unit: str | None = ""
    range: Range = UNSAID
    usual: Range = UNSAID
    default: float | None = None
    beside: Mapping[str, Range] = field(default_factory=dict, hash=False)


@dataclass(frozen=True, slots=True)
class Option(Word):
    """An option of OPTI.

    Attributes
    ----------
    takes : str
        Type word of its value ('ENTIER', 'MOT' ...), '' for words of its own.
    values : tuple of Word
        The words that it takes.
    default : str
        As one would write it.
    """

    takes: str = ""
    values: tuple[Word, ...] = ()
    default: str = ""
