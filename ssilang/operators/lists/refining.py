"""RAFF: lists with more values between those given, meshes with smaller cells."""

import math

from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.operators.lists.progressions import check_length
from ssilang.operators.mesh.changes.cells import refined
from ssilang.operators.prelude import *

RAFF = shared("RAFF", "lists", full_name="RAFFINER")
_LIST = arg("value", "LISTREEL", en="list", range=ANY_NUMBER)

RAFF.form(
    arg("mesh", "MAILLAGE", en="mesh to refine"),
    arg("sizes", "CHPOINT", en="sizes wanted", unit="m"),
)(refined)


@RAFF.form()
def _refined_by_number(
    value: ListReel = _LIST,
    number: int = Arg(
        "ENTIER", en="parts of each interval, negative for graded ones", range=NOT_ZERO
    ),
) -> ListReel:
    values, lengths = _intervals(value)
    check_length(abs(float(number)) * len(lengths))
    if number > 0:
        return ListReel(_joined(values, [_even(number)] * (len(values) - 1)))
    # Fractions of each interval; at a value the size is the geometric mean of both sides'.
    count = -number
    sizes = lengths / count
    cuts = []
    for k, length in enumerate(lengths):
        if length == 0.0:
            cuts.append(_even(count))
            continue
        beside = [sizes[j] if 0 <= j < len(sizes) and sizes[j] > 0.0 else sizes[k]
                  for j in (k - 1, k + 1)]  # fmt: skip
        first, last = (math.sqrt(sizes[k] * other) for other in beside)
        cuts.append(subdivide(length, first, last).fractions)
    return ListReel(_joined(values, cuts))


@RAFF.form()
def _refined_by_size(
    value: ListReel = _LIST,
    size: float = Arg("FLOTTANT", en="size wanted", range=POSITIVE),
) -> ListReel:
    values, lengths = _intervals(value)
    check_length(float(np.sum(lengths / size)))
    return ListReel(_joined(values, [_even(max(1, math.floor(d / size + 0.5))) for d in lengths]))


def _intervals(value: ListReel) -> tuple[FloatArray, FloatArray]:
    """Values of a list and the lengths between them."""
    values = np.asarray(value.values, dtype=float)
    return values, np.abs(np.diff(values))


def _joined(values: FloatArray, cuts: list[FloatArray]) -> FloatArray:
    """Values with those at the fractions of each interval, ends included once."""
    if len(values) < 2:
        return values
    parts = [
        a + fractions[:-1] * (b - a)
        for a, b, fractions in zip(values[:-1], values[1:], cuts, strict=True)
    ]
    return np.concatenate([*parts, values[-1:]])


def _even(count: int) -> FloatArray:
    return np.linspace(0.0, 1.0, count + 1)
