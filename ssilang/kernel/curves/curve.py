"""Curves and loads: functions of one abscissa (EVOLUTION), fields in time (CHARGEMENT)."""

from dataclasses import dataclass, field, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField


@dataclass(frozen=True, eq=False)
class CurvePart:
    """One curve: abscissas and ordinates (n,), names of the axes, legend, colour index."""

    abscissas: FloatArray
    ordinates: FloatArray
    abscissa_name: str = ""
    ordinate_name: str = ""
    legend: str = ""
    colour: int = 0
    words: tuple[str, ...] = ()  # ordinates given as words (LISTMOTS), empty otherwise
    kind: str = ""  # PREE PIMA (parts of a complex curve), MODU PHAS, HIST ENTI MOTS; '' for reals
    abscissa_words: tuple[str, ...] = ()  # abscissas given as words, standing at 1, 2, 3 ...
    # SI units of both axes where they are certain; what is made from a curve has none
    units: tuple[str, str] = field(default=("", ""), init=False)
    # accelerations relative to a ground that shakes, until something else is made of them
    relative: bool = field(default=False, init=False)

    def measured(self, abscissa: str, ordinate: str = "", relative: bool = False) -> "CurvePart":
        """The same curve with the SI units of its axes ('s', 'm/s'), '' where that is unknown."""
        made = replace(self)
        object.__setattr__(made, "units", (abscissa, ordinate))
        object.__setattr__(made, "relative", relative)
        return made

    def coloured(self, colour: int) -> "CurvePart":
        """The same curve in another colour; it measures what it did."""
        return replace(self, colour=colour).measured(*self.units, self.relative)


_OVER = {
    "s": ("TEMP", "TEMPS", "TIME", "T(S)", "PERI", "PERIOD", "PERIODE", "PÉRIODE"),
    "Hz": ("FREQ", "FREQUENCE", "FRÉQUENCE", "FREQUENCY", "F(HZ)"),
}
"""First words of names of axes, by the unit that they say."""


@dataclass(frozen=True, eq=False)
class Curve:
    """One or several curves (EVOLUTION)."""

    parts: tuple[CurvePart, ...]
    title: str = ""
    kind: str = "REEL"

    @property
    def over(self) -> str:
        """Unit of its abscissas, by the name that all curves give them; '' where that says none."""
        names = [p.abscissa_name.strip().upper() for p in self.parts]
        words = [{n.partition(" ")[0], n.replace(" ", "")} for n in names]
        said = (unit for unit, known in _OVER.items() if words and all(w & {*known} for w in words))
        return next(said, "")

    def at(self, x: float) -> float:
        """Value of the first curve at `x`, linear between its points, constant outside."""
        part = self.parts[0]
        return float(np.interp(x, part.abscissas, part.ordinates))


@dataclass(frozen=True, eq=False)
class LoadPart:
    """One loading: a field in space times a curve in time, or a field at each listed time.

    Parameters
    ----------
    name : str
        Cast3M's name: 'MECA' (forces), 'DIMP' (imposed displacements), 'T', 'Q', ...
    space : NodeField or CellField, or None
        Multiplied by `time` (None with `steps`).
    steps : tuple of (float, field)
        A field at given times, linear between.
    beside : tuple of NodeField
        Of the forces of a free field: masses and dampers on the diagonal (of UX, ...) that they
        were found with, the dampers where the free field moves them.
    free : bool
        Whether it is said not to follow the matter ('LIBRE').
    """

    name: str
    space: NodeField | CellField | None = None
    time: Curve | None = None
    steps: tuple[tuple[float, NodeField | CellField], ...] = ()
    beside: tuple[NodeField, ...] = ()
    free: bool = False


@dataclass(frozen=True, eq=False)
class Load:
    """Sum of elementary loadings (CHARGEMENT)."""

    parts: tuple[LoadPart, ...] = field(default_factory=tuple)
