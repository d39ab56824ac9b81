"""Objects of the language, as Python sees them: tables as mappings, lists as arrays, words as str.

`seen` turns an object of the language into what Python sees, `held` gives the object back.

Curves, as Python sees them: arrays, a Series, a picture.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.api.errors import MissingKey, refused
from ssilang.api.fields import CellFieldView, FieldView, MeshView, PointView
from ssilang.api.html import html_of, picture_of
from ssilang.api.view import View, library
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language import values
from ssilang.language.search import SHORT_LIKE, nearest

if TYPE_CHECKING:
    import pandas
    from xarray import DataArray


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


_MOST_SHOWN = 20


class TableView(View[values.Table], Mapping[Any, Any]):
    """A TABLE. What a calculation saved is made when it is asked for, not before.

    Examples
    --------
    >>> import ssilang
    >>> r = ssilang.run("T = TABL ; T . 'B' = 2.5 ; T . 1 = PROG 1. 2. ;")
    >>> r["T"]["B"], list(r["T"]), r["T"][1].sum()
    (2.5, ['B', 1], np.float64(3.0))
    """

    def __getitem__(self, index: Any) -> Any:
        key = held(index)
        if not self.held.has(key):
            raise self._missing(index)
        return seen(self.held.get(key), self.language)

    def __contains__(self, index: object) -> bool:
        return self.held.has(held(index))

    def __iter__(self) -> Iterator[Any]:
        return (seen(index, self.language) for index in self.held.indices())

    def __len__(self) -> int:
        return len(self.held)

    def _missing(self, index: object) -> Exception:
        known = [i for i in self.held.indices() if isinstance(i, str | int | float)]
        near = nearest(str(index), [k for k in known if isinstance(k, str)], SHORT_LIKE)
        shown = [repr(seen(k, self.language)) for k in known[:_MOST_SHOWN]]
        return refused(
            "api.no-such-index", self.language, MissingKey,
            index=repr(index), near=repr(str(near)) if near else "", known=shown,
        )  # fmt: skip

    def frame(self) -> "pandas.DataFrame":
        """Its lists of numbers as columns of a DataFrame (RESULTATS_CSV, ENERGIES ...)."""
        lists = {
            str(i): v.values
            for i, v in self.held.items()
            if isinstance(v, values.ListReel | values.ListEnti | values.ListMots)
        }
        return library("pandas", self.language).DataFrame(lists)

    def xarray(self, word: str) -> "DataArray":
        """All values in time of nodal fields of a table of results: (time, node, component).

        Parameters
        ----------
        word : str
            'DEPL', 'VITE', 'ACCE' of DYNAMIC; 'DEPLACEMENTS' ... of PASAPAS.
        """
        from ssilang.api.histories import over_time

        return over_time(self.held, word, self.language)

    def _repr_html_(self) -> str:
        return html_of(self.held)

    def __repr__(self) -> str:
        subtype = f"{self.held.subtype}, " if self.held.subtype else ""
        shown = [repr(seen(i, self.language)) for i in self.held.indices()[:8]]
        more = ", ..." if len(self) > len(shown) else ""
        return f"<TABLE {subtype}{len(self)}: {', '.join(shown)}{more}>"


class OpaqueView(View[Any]):
    """What has no form of its own in Python: RIGIDITE, MMODEL, CHARGEMENT, PROCEDUR ..."""

    def __repr__(self) -> str:
        return f"<{values.type_of(self.held)}>"


_VALUES: dict[type, Callable[[Any], Any]] = {
    values.Mot: str,
    values.ListReel: lambda v: v.values.copy(),
    values.ListEnti: lambda v: v.values.copy(),
    values.ListMots: lambda v: [str(word) for word in v.values],
}
"""What numbers and words are in Python, by the class of the list."""
_VIEWS: dict[type, Callable[[Any, str], Any]] = {
    values.ListChpo: lambda v, language: [seen(part, language) for part in v.values],
    values.ListObje: lambda v, language: [seen(part, language) for part in v.values],
    Point: PointView,
    Mesh: MeshView,
    NodeField: FieldView,
    CellField: CellFieldView,
    Curve: CurveView,
}
"""How Python sees other objects, by their class."""
_AS_THEY_ARE = (bool, int, float, str, np.ndarray)


def seen(value: Any, language: str = "en") -> Any:
    """What Python sees of an object of the language; `language` is that of what it refuses."""
    plain = _VALUES.get(type(value))
    if plain is not None:
        return plain(value)
    view = TableView if isinstance(value, values.Table) else _VIEWS.get(type(value))
    if view is not None:
        return view(value, language)
    return value if isinstance(value, _AS_THEY_ARE) else OpaqueView(value)


def held(value: Any, language: str = "en") -> Any:
    """The language's object of something in Python: a view, a number, a word, a list, a curve.

    Raises
    ------
    Error
        For what the language has no object for.
    """
    if isinstance(value, View):
        return value.held
    if isinstance(value, bool | int | float):
        return value
    if isinstance(value, str):
        return values.Mot(value)
    if isinstance(value, np.generic):
        return held(value.item(), language)
    if hasattr(value, "__fspath__"):
        return values.Mot(value.__fspath__())
    if hasattr(value, "index") and hasattr(value, "to_numpy"):  # a Series
        name = str(getattr(value, "name", "") or "")
        x, y = np.asarray(value.index, float), np.asarray(value.to_numpy(), float)
        return Curve((CurvePart(x, y, "", name[:12], name),))
    if isinstance(value, (list, tuple, range, np.ndarray)):
        return _list(value, language)
    raise refused("api.no-such-object", language, kind=type(value).__name__)


def _list(value: Any, language: str) -> Any:
    """The list of numbers or words that a sequence is."""
    if len(value) and all(isinstance(v, str) for v in value):
        return values.ListMots([str(v) for v in value])
    array = np.asarray(value)
    if array.ndim != 1 or array.dtype.kind not in "iuf":
        raise refused("api.no-such-object", language, kind=type(value).__name__)
    return values.ListEnti(array) if array.dtype.kind in "iu" else values.ListReel(array)
