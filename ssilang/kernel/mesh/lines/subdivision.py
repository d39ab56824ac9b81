"""How a length is cut into elements: equal sizes or a geometric progression."""

import math
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError

_UNIFORM = 1e-5  # ratios closer to 1 than this are taken as 1


@dataclass(frozen=True, slots=True)
class Subdivision:
    """Positions of the element ends along a path.

    Attributes
    ----------
    fractions : array (n + 1,)
        Increasing from 0 to 1, as parts of the path's length.
    start_density, end_density : float
        Mesh sizes handed to the nodes that are created, linear in between.
    """

    fractions: FloatArray
    start_density: float
    end_density: float

    @property
    def count(self) -> int:
        """Number of elements."""
        return len(self.fractions) - 1

    @property
    def middles(self) -> FloatArray:
        """Fractions at the middle of each element, shape (n,)."""
        return 0.5 * (self.fractions[:-1] + self.fractions[1:])

    def density(self, fractions: FloatArray) -> FloatArray:
        """Mesh sizes at `fractions` (m,)."""
        return self.start_density + (self.end_density - self.start_density) * fractions


def subdivide(
    length: float, start_size: float = 0.0, end_size: float = 0.0, count: int = 0
) -> Subdivision:
    """Cut a path into elements by number, by mesh sizes, or by both.

    Parameters
    ----------
    length : float
        Of the path; 0 (coincident ends) is taken as 1 when `count` is given.
    start_size, end_size : float
        Wanted element sizes at the two ends.
    count : int
        `> 0`: that many equal elements. `< 0`: that many, graded by the sizes, of which their
        difference alone counts then: they may be 0. `0`: as many as the sizes ask for, graded.

    Notes
    -----
    With sizes `d1`, `d2` relative to the length, element sizes follow a geometric progression of
    ratio q such that `sqrt(q) - 1/sqrt(q) = d2 - d1`, and their number is `ln(d2/d1)/ln q`
    rounded to the nearest whole number in the sense of ratios: the sizes are those of a mesh
    whose element size is a linear function of the position (as Cast3M does it).

    Raises
    ------
    MeshError
        If sizes are needed and one is not positive (negative, where `count` is), or the path
        has no length.
    """
    if count > 0:
        step = (length or 1.0) / count
        return Subdivision(np.linspace(0.0, 1.0, count + 1), step, step)
    if not all(0.0 < s < math.inf or (s == 0.0 and count < 0) for s in (start_size, end_size)):
        raise MeshError(
            "kernel.mesh.mesh-sizes-must-positive", start_size=start_size, end_size=end_size
        )
    if length <= 0.0:
        raise MeshError("kernel.mesh.path-zero-length-cannot")
    d1, d2 = start_size / length, end_size / length
    ratio = _ratio(d1, d2)
    graded = abs(ratio - 1.0) > _UNIFORM
    if count < 0:
        n = -count
    else:
        n = _nearest(math.log(d2 / d1) / math.log(ratio) if graded else 1.0 / d1)
    if not graded:
        return Subdivision(np.linspace(0.0, 1.0, n + 1), length / n, end_size)
    steps = ratio ** np.arange(n)
    steps /= steps.sum()
    fractions = np.concatenate([[0.0], np.cumsum(steps)])
    fractions[-1] = 1.0
    return Subdivision(fractions, float(steps[0]) / ratio * length, end_size)


def _ratio(d1: float, d2: float) -> float:
    half = 0.5 * (d1 - d2) ** 2
    root = math.sqrt(half * (2.0 + half))
    growth = 1.0 + half + root  # and 1 + half - root is its inverse, without the cancellation
    return growth if d2 >= d1 else 1.0 / growth


def _nearest(wanted: float) -> int:
    if wanted > 1e7:
        raise MeshError("kernel.mesh.mesh-sizes-ask-elements", wanted=wanted)
    n = max(1, int(wanted))
    return n + 1 if wanted * wanted > n * (n + 1) else n
