"""IPOL INTG PRIM on curves: interpolation, integrals, primitives."""

from ssilang.kernel.curves.algebra import (
    beyond,
    crossings,
    integral,
    integral_along,
    interpolated,
    primitive,
    spline,
)
from ssilang.kernel.curves.cloud import Cloud
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.operators.curves.extraction import numbered
from ssilang.operators.curves.words import CURVE
from ssilang.operators.dispatch import INTG
from ssilang.operators.fields.clouds import interpolate_cloud
from ssilang.operators.numbers.arithmetic import rule
from ssilang.operators.numbers.functions import mapped
from ssilang.operators.prelude import *

_WHERE = "where the function is wanted"
_NUMBER = arg("value", "FLOTTANT", en=_WHERE, range=ANY_NUMBER)
_NUMBER_OR_FIELD = arg("value", "FLOTTANT", "CHPOINT", "MCHAML", en=_WHERE, range=ANY_NUMBER)
_LIST = arg("value", "LISTREEL", en=_WHERE, range=ANY_NUMBER)
_FUNCTION = either(
    "function",
    group("curve", CURVE),
    group(
        "lists",
        arg("x", "LISTREEL", en="abscissas", range=ANY_NUMBER),
        arg("y", "LISTREEL", en="ordinates", range=ANY_NUMBER),
    ),
)


_SPLINE = (
    flag("smooth", "SPLI", en="by a cubic spline"),
    key("left", "DGAU", "FLOTTANT", range=ANY_NUMBER, en="slope of the spline at the left end"),
    key("right", "DDRO", "FLOTTANT", range=ANY_NUMBER, en="slope of the spline at the right end"),
)


def _interpolate(
    call: Call,
    value: Any,
    function: Chosen,
    smooth: bool,
    left: float | None,
    right: float | None,
) -> Any:
    """Interpolate."""
    x, y = _points_of(call, function)
    if smooth:
        return mapped(lambda at: spline(x, y, at, left, right), value)
    if isinstance(value, float | int) and function.word == "curve":
        outside = beyond(x, y, at := np.array([float(value)]))
        if outside is not None and interpolated(x, y, at).any():  # else it is over, or not begun
            told = {"value": outside, "first": float(x.min()), "last": float(x.max())}
            call.warn("operators.curves.beyond-curve", **told)
    return mapped(lambda at: interpolated(x, y, at), value)


# two lists beside a number or a field are the function, wherever these stand
ipol = operator(
    "IPOL", _NUMBER_OR_FIELD, _FUNCTION, *_SPLINE, family="curves", gives=Like("value")
)(_interpolate)


ipol.form(_LIST, _FUNCTION, *_SPLINE, gives=Like("value"))(_interpolate)


def _points_of(call: Call, function: Chosen) -> tuple[FloatArray, FloatArray]:
    """Abscissas and ordinates that `_FUNCTION` has read."""
    if function.word == "lists":
        return function["x"].values, function["y"].values
    part = numbered(call, function["curve"], 1)
    return part.abscissas, part.ordinates


@ipol.form(said("TOUS"), _NUMBER, _FUNCTION)
def all_values(call: Call, value: float, function: Chosen) -> ListReel:
    """All ordinates of a curve that goes back."""
    return ListReel(crossings(*_points_of(call, function), value))


@ipol.form(gives=Like("field"))
def of_cloud(
    cloud: Cloud = Arg("NUAGE", en="function by its points"),
    field: NodeField | CellField = Arg("CHPOINT", "MCHAML", en="where it is wanted"),
    method: str | None = Choice(
        ("GAUS", "RATI", "GRIL"), en="weights of the points (default GAUS), or a grid"
    ),
    power: float | None = Key(
        "PID",
        opt("power", "FLOTTANT", default=1.0, range=NOT_NEGATIVE),
        en="weights by powers of the distance",
    ),
    cut: float = Key(
        "ELIM",
        opt("cut", "FLOTTANT", default=0.0, range=NOT_NEGATIVE),
        default=0.0,
        en="distance within which a point gives its own values",
    ),
) -> NodeField | CellField:
    """A function of several variables."""
    if method is None:
        method = "GAUS" if power is None else "PID"
    settings = {"PID": 1.0 if power is None else power, "ELIM": cut}
    return interpolate_cloud(cloud, field, method, settings)


@ipol.form(gives="CHPOINT|MCHAML")
def in_table(
    call: Call,
    table: Table = Arg("TABLE", en="fields by times"),
    time: float = Arg("FLOTTANT", en="time", unit="s", range=ANY_NUMBER),
) -> Any:
    """The field between two of a table."""
    pairs = sorted((i, v) for i, v in table.items() if isinstance(i, float))
    if not pairs:
        raise call.error("operators.curves.no-real-index", table)
    times = [t for t, _ in pairs]
    if not times[0] <= time <= times[-1]:
        raise call.error(
            "operators.curves.outside-table", time, time=time, first=times[0], last=times[-1]
        )
    k = min(int(np.searchsorted(times, time, side="right")), len(times) - 1)
    (t0, a), (t1, b) = pairs[k - 1] if k else pairs[0], pairs[k]
    share = 0.0 if t1 == t0 else (time - t0) / (t1 - t0)
    if type(a) is not type(b) or not isinstance(a, NodeField | CellField):
        raise call.error("operators.curves.fields-of-one-kind", table, first=t0, last=t1)
    algebra: Any = node_algebra if isinstance(a, NodeField) else cell_algebra
    first = algebra.applied(a, lambda v: v * (1.0 - share))
    return algebra.added(first, b, share)


@ipol.form()
def on_line(
    call: Call,
    field: NodeField = Arg("CHPOINT", en="curvilinear abscissas"),
    distance: float = Arg("FLOTTANT", en="distance along the line", unit="m", range=ANY_NUMBER),
) -> Point:
    """A point of a line."""
    if len(field.components) != 1:
        raise call.error("operators.curves.abscissas-have-one-component", field)
    (part,) = field.components.values()
    order = np.argsort(part.values, kind="stable")
    x = field.table.coordinates[part.nodes[order]]
    s = part.values[order]
    if not s[0] <= distance <= s[-1]:
        raise call.error(
            "operators.curves.outside-line", distance, distance=distance, first=s[0], last=s[-1]
        )
    ws = workspace(call.session)
    return ws.point([float(np.interp(distance, s, x[:, i])) for i in range(ws.dimension or 3)])


def _through(field: Any, curve: Curve) -> Any:
    if len(curve.parts) != 1:
        raise NoResultError("operators.curves.one-curve-wanted", n_parts=len(curve.parts))
    part = curve.parts[0]
    return mapped(lambda at: interpolated(part.abscissas, part.ordinates, at), field)


for _kind in ("CHPOINT", "MCHAML"):
    rule("* /", _kind, "EVOLUTIO")(lambda sign, field, curve: _through(field, curve))
    rule("* /", "EVOLUTIO", _kind)(lambda sign, curve, field: _through(field, curve))


# ---- integrals ----------------------------------------------------------------------------------


_BOUND = ("FLOTTANT", "LISTREEL")
_PLACE = ("ENTIER", "LISTENTI")


@INTG.form(gives="FLOTTANT|LISTREEL|NUAGE")
def integrate(
    call: Call,
    curve: Curve = Main("EVOLUTIO", en="curves"),
    absolute: bool = Flag("ABS", length=3, en="of the absolute value"),
    bounds: Any = Key(
        "BORN",
        arg("low", *_BOUND, en="lower ones", range=ANY_NUMBER),
        arg("high", *_BOUND, en="upper ones", range=ANY_NUMBER),
        en="between abscissas",
    ),
    places: Any = Key(
        "INDI",
        arg("low", *_PLACE, en="first ones", range=POSITIVE),
        arg("high", *_PLACE, en="last ones", range=POSITIVE),
        en="between places",
    ),
    low: Any = Opt(*_PLACE, en="first places, without a word: a list comes", range=POSITIVE),
    high: Any = Opt(*_PLACE, en="last places", range=POSITIVE),
) -> Any:
    """Integrals of curves."""
    bare = low is not None
    if bare:
        if high is None:
            raise call.missing(_PLACE)
        places = low, high
    word = "BORN" if bounds is not None else "INDI" if places is not None else ""
    bounds = bounds if bounds is not None else places
    way = integral if word == "BORN" else integral_along
    results = [
        [way(part, low, high, absolute) for low, high in _intervals(call, part, word, bounds)]
        for part in curve.parts
    ]
    if len(curve.parts) > 1 and len(results[0]) > 1:
        return Cloud({f"IE{i}": (ListReel(row),) for i, row in enumerate(results, start=1)})
    flat = [v for row in results for v in row]
    one = (
        not bare
        and len(curve.parts) == 1
        and (bounds is None or isinstance(bounds[0], int | float))
    )
    return flat[0] if one else ListReel(flat)


def _intervals(call: Call, part: CurvePart, word: str, bounds: Any) -> list[tuple[Any, Any]]:
    """Pairs of abscissas for 'BORN', of 0-based places otherwise."""
    count = len(part.abscissas)
    if count == 0:
        raise call.error("operators.curves.empty-curve")
    if bounds is None:
        return [(0, count - 1)]
    low, high = (np.atleast_1d(getattr(b, "values", b)) for b in bounds)
    if len(low) != len(high):
        raise call.error("operators.curves.bounds-differ", n_low=len(low), n_high=len(high))
    if word == "INDI":
        both = np.concatenate((low, high))
        if len(both) and (both.min() < 1 or both.max() > count):
            raise call.error("operators.curves.no-such-place", count=count)
        low, high = low - 1, high - 1
    return list(zip(low.tolist(), high.tolist(), strict=True))


@operator("PRIM", family="curves", full_name="PRIMITIVE")
def prim(curve: Curve = CURVE) -> Curve:
    """Running integral."""
    return replace(curve, parts=tuple(primitive(p) for p in curve.parts))
