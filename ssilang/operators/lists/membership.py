"""DANS SAUF INTE: what lists, meshes and words hold."""

from ssilang.operators.dispatch import INTE
from ssilang.operators.lists.places import taken
from ssilang.operators.lists.search import equal_items
from ssilang.operators.prelude import *

DANS = shared("DANS", "lists")
_WAY = choice("way", ("SEQU", "QUEL"), default="SEQU", en="in sequence, or in any order")
_SECOND = "list where it is looked for"


@DANS.form()
def _point_in_mesh(
    way: str = _WAY,
    point: Point = Arg("POINT", en="point"),
    mesh: Mesh = Arg("MAILLAGE", en="mesh"),
) -> bool:
    return bool(np.any(mesh.node_ids == point.node))


@DANS.form()
def _integers_in_integers(
    way: str = _WAY,
    part: ListEnti = Arg("LISTENTI", en="list of integers", range=ANY_NUMBER),
    whole: ListEnti = Arg("LISTENTI", en=_SECOND, range=ANY_NUMBER),
) -> bool:
    p = len(part.values)
    if p == 0:
        return True
    rows = whole.values[: len(whole.values) // p * p].reshape(-1, p)
    return bool(np.any(np.all(rows == part.values, axis=1)))


@DANS.form()
def _number_in_reals(
    way: str = _WAY,
    whole: ListReel = Arg("LISTREEL", en="list of reals", range=CARRIED),
    number: float = Arg("FLOTTANT", en="number looked for", range=CARRIED),
) -> bool:
    return bool(np.any(np.abs(whole.values - number) <= _slack(whole.values)))


@DANS.form()
def _reals_in_reals(
    way: str = _WAY,
    part: ListReel = Arg("LISTREEL", en="list of reals", range=CARRIED),
    whole: ListReel = Arg("LISTREEL", en=_SECOND, range=CARRIED),
) -> bool:
    left, right = part.values, whole.values
    slack = _slack(right)
    if way == "QUEL":
        return all(bool(np.any(np.abs(right - v) <= slack)) for v in left)
    if len(left) == 0:
        return True
    if len(left) > len(right):
        return False
    windows = np.lib.stride_tricks.sliding_window_view(right, len(left))
    return bool(np.any(np.all(np.abs(windows - left) <= slack, axis=1)))


def _slack(values: Any) -> float:
    gaps = np.abs(np.diff(values))
    gaps = gaps[gaps > 0]
    return 1e-8 * float(gaps.min()) if len(gaps) else 0.0


_SUBTRACTED = ("LISTREEL", "LISTENTI", "LISTMOTS")
Subtracted = ListReel | ListEnti | ListMots


@operator("SAUF", gives=Like("first"), family="lists")
def sauf(
    call: Call,
    first: Subtracted = Arg(*_SUBTRACTED, en="list", range=CARRIED),
    second: Subtracted = Arg(*_SUBTRACTED, en="items to leave out", range=CARRIED),
    tolerance: float | None = Opt("FLOTTANT", range=NOT_NEGATIVE, en="absolute tolerance"),
    fold: bool = Flag("NOCA", en="whatever the case"),
) -> Any:
    """Subtract a list from another."""
    if type(first) is not type(second):
        raise call.error("operators.lists.lists-of-one-type", second)
    gone = np.zeros(len(first), dtype=bool)
    for item in second.values:
        gone |= equal_items(first.values, item, tolerance, fold)
    return taken(first, [int(i) for i in np.flatnonzero(~gone)])


@INTE.form()
def common_reals(
    first: ListReel = Main("LISTREEL", en="first list"),
    second: ListReel = Arg("LISTREEL", en="second list", range=CARRIED),
) -> ListReel:
    """Values in both lists, in the order of the first."""
    return ListReel(first.values[np.isin(first.values, second.values)])
