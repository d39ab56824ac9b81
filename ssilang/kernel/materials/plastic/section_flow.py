"""Plasticity and creep on the forces of sections: associated flow on their equivalent stress."""

from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.materials.plastic.creep import DURATION, pace
from ssilang.kernel.materials.plastic.response import PointParameters, Response

TURNS = 100


@dataclass(frozen=True, eq=False)
class SectionParameters(PointParameters):
    """Parameters of sections at m points."""

    rigidity: FloatArray  # (m, w, w), w 6 or 8: forces of elastic strains and back
    softness: FloatArray
    form: FloatArray  # (m, 6, 6) the equivalent stress q of forces F has q^2 = F form F
    size: FloatArray  # (m,) area (thickness of shells): q size is conjugate to the flow p

    @property
    def moduli(self) -> FloatArray:
        """Rigidities (m, 6, 6)."""
        return self.rigidity

    @property
    def compliance(self) -> FloatArray:
        """Elastic compliance (m, 6, 6), zero where there is no rigidity."""
        return self.softness

    def elastic_energy(self, stress: FloatArray) -> FloatArray:
        """Energy (m,) that forces (m, 6) store in a unit of length or surface."""
        return 0.5 * np.einsum("mi,mij,mj->m", stress, self.softness, stress)

    def at(self, points: IntArray) -> "SectionParameters":
        """The same for some of the points."""
        own = PointParameters(self.values, self.curves).at(points)
        names = ("rigidity", "softness", "form", "size")
        return replace(
            self,
            values=own.values,
            curves=own.curves,
            **{n: getattr(self, n)[points] for n in names},
        )

    def strength(self, p: FloatArray, dp: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Limit of the equivalent stress after a flow p + dp (m,), and its slope."""
        if "ECRO" in self.curves:
            return self.curve("ECRO", p + dp)
        return self["SIGY"], np.zeros(len(p))

    def most(self, q: FloatArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """What a flow (m,) begins with, and what it does not pass."""
        return np.zeros(len(p)), np.full(len(p), np.inf)


@dataclass(frozen=True, eq=False)
class CreepingSections(SectionParameters):
    """Sections that creep by Norton's law: the stress of a flow in the step is their limit."""

    def strength(self, p: FloatArray, dp: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Stress under which the creep strain p (m,) grows by dp in the step, and its slope."""
        age, power = self["AF3"], self["AF2"]
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            grown = np.expm1(np.log1p(dp / p) / age) * p ** (1.0 / age)
            grown = np.where(p > 0.0, grown, dp ** (1.0 / age))
            q = ((grown / self[DURATION]) ** age / self["AF1"]) ** (1.0 / power)
            slope = q / power * (p + dp) ** (1.0 / age - 1.0) / grown
        idle = (self[DURATION] <= 0.0) | (self["AF1"] <= 0.0)
        return np.where(idle, np.inf, q), slope

    def most(self, q: FloatArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The creep of the stress (m,) that does not relax: never less than the flow."""
        age, unit = self["AF3"], pace(self, q)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            dp = p * np.expm1(age * np.log1p(unit / p ** (1.0 / age)))
        dp = np.where(p > 0.0, dp, unit**age)
        return dp, dp


def respond(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """`q(F - X) <= R(p)`, strains of flow `size dp dq/dF`, `dX = H dp (F - X) / q`.

    Stresses are forces (m, 6), strains those of the section. A pulled section has the axial flow
    p; a centre that moves along F - X is Prager's where the form has an inverse.
    """
    assert isinstance(parameters, SectionParameters)
    moduli = parameters.moduli
    trial = stress + np.einsum("mij,mj->mi", moduli, strain)
    centre = np.zeros_like(trial)
    kept = variables[:, 1:7]
    centre[:, : kept.shape[1]] = kept
    reduced, p, inner = trial - centre, variables[:, 0], variables.copy()
    q = np.sqrt(np.einsum("mi,mij,mj->m", reduced, parameters.form, reduced))
    limit, most = parameters.strength(p, np.zeros(len(p)))[0], parameters.most(q, p)[1]
    rows = np.flatnonzero((q > limit * (1 + 1e-14)) & (most > 0.0))
    found, tangent = trial.copy(), moduli.copy()
    if len(rows):
        given = parameters.at(rows)
        dp, moved = _flow(given, reduced[rows], p[rows])
        inner[rows, 0] += dp
        flow, shift, tangent[rows] = _consistent(given, moved, dp, p[rows])
        found[rows] -= dp[:, None] * flow
        if variables.shape[1] > 1:
            inner[rows, 1:7] += dp[:, None] * shift[:, :6]
    return Response(found, inner, tangent)


def _directions(given: SectionParameters) -> tuple[FloatArray, FloatArray]:
    """Rigidity times form times size (m, 6, 6), and H where the form counts (m, 6)."""
    active = np.einsum("mii->mi", given.form) > 0
    H = given.values.get("H", np.zeros(len(given.size)))
    return given.size[:, None, None] * (given.moduli @ given.form), H[:, None] * active


def _flow(given: SectionParameters, reduced: FloatArray, p: FloatArray) -> tuple[FloatArray, ...]:
    """The flow (m,) that brings reduced forces (m, 6) back onto the criterion, and where to."""
    back, H = _directions(given)
    one = np.eye(back.shape[-1])
    change = back + H[:, None, :] * one
    top = np.sqrt(np.einsum("mi,mij,mj->m", reduced, given.form, reduced))
    low, (dp, high) = np.zeros(len(p)), given.most(top, p)
    first = np.abs(reduced).max() / given["YOUN"].min() / given.size.min()
    for _ in range(TURNS):
        limit, slope = given.strength(p, dp)
        A = one + (dp / limit)[:, None, None] * change
        moved = np.linalg.solve(A, reduced[..., None])[..., 0]
        weighed = np.einsum("mij,mj->mi", given.form, moved)
        q = np.sqrt(np.vecdot(moved, weighed))
        if (np.abs(q - limit) <= 1e-13 * limit).all():
            break
        low, high = np.where(q > limit, dp, low), np.where(q < limit, dp, high)
        turned = np.einsum("mij,mj->mi", change, moved)
        rate = -np.linalg.solve(A, turned[..., None])[..., 0] * (limit - dp * slope)[:, None]
        steep = np.vecdot(weighed, rate) / (q * limit**2) - slope
        step = dp - (q - limit) / steep
        middle = np.where(np.isinf(high), 2 * low + first, 0.5 * (low + np.minimum(high, 1e300)))
        dp = np.where((step > low) & (step < high), step, middle)
    return dp, np.asarray(moved, dtype=np.float64)


def _consistent(
    given: SectionParameters, moved: FloatArray, dp: FloatArray, p: FloatArray
) -> tuple[FloatArray, ...]:
    """What a unit of flow takes off the forces and adds to the centre, and the tangent."""
    back, H = _directions(given)
    weighed = np.einsum("mij,mj->mi", given.form, moved)
    q = np.sqrt(np.vecdot(moved, weighed))[:, None]
    n, b = weighed / q, moved / q
    flow, shift = np.einsum("mij,mj->mi", back, b), H * b
    Dn = given.size[:, None] * np.einsum("mij,mj->mi", given.moduli, n)
    DN = (back - Dn[:, :, None] * n[:, None]) / q[..., None]
    one = np.eye(back.shape[-1])
    HB = H[:, :, None] * (one - b[:, :, None] * n[:, None]) / q[..., None]
    step = dp[:, None, None]
    change = one + step * (DN + HB)
    try:
        inverse = np.linalg.inv(change)
    except np.linalg.LinAlgError:  # of a step far beyond any equilibrium
        inverse = np.linalg.pinv(change)
    whole, v = inverse @ given.moduli, np.einsum("mij,mj->mi", inverse, flow + shift)
    hard = given.strength(p, dp)[1] + np.vecdot(n, v)
    w = np.einsum("mji,mj->mi", whole, n) / hard[:, None]
    reduced = whole - v[:, :, None] * w[:, None]
    return flow, shift, given.moduli - flow[:, :, None] * w[:, None] - step * (DN @ reduced)
