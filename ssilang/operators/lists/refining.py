"""RAFF: lists with more values between those given."""

from __future__ import annotations

import math

import numpy as np

from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.mesh.subdivision import subdivide
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator
from ssilang.language.values import ListReel


@operator(
    "RAFF",
    family="lists",
    full_name="RAFFINER",
    help=Help(
        "A list with each interval cut: into N1 equal parts; into parts whose size is as near as "
        "can be to FLOT1; or with N1 negative into about -N1 parts whose sizes go geometrically "
        "from one interval to the next. Equal values that follow one another are repeated "
        "likewise.",
        "Une liste dont chaque intervalle est découpé : en N1 parts égales ; en parts de taille la "
        "plus proche possible de FLOT1 ; ou, si N1 est négatif, en environ -N1 parts dont les "
        "tailles vont géométriquement d'un intervalle au suivant. Les valeurs égales qui se "
        "suivent "
        "sont répétées de même.",
        "LREE2 = RAFF LREE1 N1 | FLOT1 ;",
        ("LIST (RAFF (PROG 0. 1. 3.) 2) ; LIST (RAFF (PROG 0. 1. 3.) 0.5) ;",),
    ),
    reads_itself=True,
)
def raff(call: Call) -> ListReel:
    """Refine a list."""
    values = np.asarray(call.required("LISTREEL").values, dtype=float)
    count = call.read("ENTIER")
    if count is None:
        size = call.required("FLOTTANT")
        if size <= 0.0:
            raise call.bad(f"the size of the intervals is positive, not {size:g}", size)
        return ListReel(_joined(values, [_even(_nearest(abs(d), size)) for d in np.diff(values)]))
    number = int(count.value)
    if number == 0:
        raise call.bad("an interval is cut into one part at least", number)
    if number > 0:
        return ListReel(_joined(values, [_even(number)] * (len(values) - 1)))
    return ListReel(_joined(values, _graded(np.abs(np.diff(values)), -number)))


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


def _nearest(length: float, size: float) -> int:
    return max(1, math.floor(length / size + 0.5))


def _graded(lengths: FloatArray, count: int) -> list[FloatArray]:
    """Fractions of each interval; at a value the size is the geometric mean of both sides'."""
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
    return cuts
