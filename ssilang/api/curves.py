"""Curves, as Python sees them: arrays, a Series, a picture."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.api.errors import refused
from ssilang.api.html import picture_of
from ssilang.api.view import View, library
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Curve, CurvePart

if TYPE_CHECKING:
    import pandas


class CurveView(View[Curve]):
    """An EVOLUTION of one or several curves.

    Examples
    --------
    >>> import ssilang
    >>> r = ssilang.run("E = EVOL 'MANU' 'T' (PROG 0. 1. 2.) 'U' (PROG 0. 3. 1.) ;")
    >>> e = r["E"]
    >>> e.y.max(), e.x[e.y.argmax()]
    (np.float64(3.0), np.float64(1.0))
    >>> e.series()
    T
    0.0    0.0
    1.0    3.0
    2.0    1.0
    Name: U, dtype: float64
    """

    @property
    def _only(self) -> CurvePart:
        if len(self.held.parts) != 1:
            raise refused("api.which-curve", self.language, count=len(self.held.parts))
        return self.held.parts[0]

    @property
    def x(self) -> FloatArray:
        """Abscissas (n,) of its only curve."""
        return self._only.abscissas.copy()

    @property
    def y(self) -> FloatArray:
        """Ordinates (n,) of its only curve."""
        return self._only.ordinates.copy()

    @property
    def names(self) -> tuple[str, ...]:
        """What its curves are called: their legends, else the names of their ordinates."""
        return tuple(_name(part) for part in self.held.parts)

    @property
    def units(self) -> tuple[str, str]:
        """SI units of both axes of the first curve, '' where they are not known."""
        return self.held.parts[0].units if self.held.parts else ("", "")

    def __len__(self) -> int:
        return len(self.held.parts)

    def __getitem__(self, place: int) -> "CurveView":
        """One of the curves."""
        return CurveView(
            Curve((self.held.parts[place],), self.held.title, self.held.kind), self.language
        )

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        """Ordinates of its only curve."""
        return np.asarray(self.y, dtype)

    def series(self) -> "pandas.Series[float]":
        """Its only curve as a Series over the abscissas."""
        part, pd = self._only, library("pandas", self.language)
        index = pd.Index(part.abscissas, name=part.abscissa_name or None)
        return pd.Series(part.ordinates, index, name=_name(part))

    def frame(self) -> "pandas.DataFrame":
        """All curves as columns over the abscissas; NaN where a curve has no such abscissa."""
        pd = library("pandas", self.language)
        curves = [self[i].series() for i in range(len(self))]
        return pd.concat(curves, axis=1).sort_index() if curves else pd.DataFrame()

    def _repr_png_(self) -> bytes:
        return picture_of(self.held)

    def __repr__(self) -> str:
        sizes = ", ".join(f"{_name(p)} ({len(p.abscissas)})" for p in self.held.parts)
        return f"<EVOLUTION {sizes or 'empty'}>"


def _name(part: CurvePart) -> str:
    return part.legend or part.ordinate_name
