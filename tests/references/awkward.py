"""Small problems in which nothing is alike: each number of a body, joint or support is its own."""

import itertools
from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.stepping.newmark import generalised_alpha, hht, newmark
from ssilang.kernel.stepping.problem.problem import Problem

from .assembled import Bench

SCHEMES = (newmark(), hht(0.1), generalised_alpha(0.5), newmark(0.3025, 0.6))
UNITS = ((1.0, 1.0), (3e-8, 2e5), (5e9, 1e-4))  # of forces and of displacements
# of joints on two points, and of joints on lines
POINTS = (
    {"law": "JOINT_SDM", "KN": 2.1e6, "KS": 0.9e6, "FROT": 0.45},
    {"law": "JOINT_SDM", "KN": 1.7e6, "KS": 0.6e6, "FU": 900.0, "GF": 1.1, "FC": -350.0},
)
LINES = (
    {"law": "JOINT_SDM", "KN": 3.3e6, "KS": 1.2e6, "FROT": 0.7},
    {"law": "JOINT_DILATANT", "KN": 2.7e6, "KS": 1.4e6, "PHI": 31.0, "MU": 9.0, "COHE": 250.0,
     "FTRC": 100.0},
)  # fmt: skip
# whole footings, of which the ground of one yields
FOOTINGS = (
    {"law": "MACRO_SEMELLE", "KN": 1.9e6, "KS": 0.8e6, "LARG": 1.3},
    {"law": "MACRO_SEMELLE", "KN": 2.6e6, "KS": 1.1e6, "LARG": 0.9, "COHE": 900.0},
)
PUSH = ({"law": "JOINT_SDM", "KN": 2.1e6, "KS": 0.0},)


def in_units(law: dict, unit: float, length: float) -> dict:
    """Parameters of a law whose forces and displacements are counted in other units."""
    factors = {"KN": unit / length, "KS": unit / length, "GF": unit * length}
    factors |= dict.fromkeys(("FU", "FC", "COHE", "FTRC"), unit)
    return {k: v * factors.get(k, 1.0) if k != "law" else v for k, v in law.items()}


@dataclass(frozen=True)
class Awkward:
    """What a problem has; `seed` draws its numbers."""

    seed: int
    scheme: int = 0
    tied: bool = True
    moving: bool = True
    damping: str = "dashpots"
    point_laws: tuple[dict, ...] = POINTS
    line_laws: tuple[dict, ...] = LINES
    steps: int = 60
    units: int = 0
    unilateral: bool = False
    footings: bool = False

    def problem(self) -> Problem:
        """Three stacks of masses on joints to points, and a beam of masses on joints to a line."""
        rng, bench = np.random.default_rng(self.seed), Bench()
        unit, length = UNITS[self.units]
        stiff = unit / length
        low, tops = [], []
        for i in range(3):
            x = 3.0 * i + rng.uniform(-0.5, 0.5)
            low.append(bench.node(x, 0.0))
            tops.append(bench.node(x, 0.8))
        for law, first in zip(self.point_laws, (0, 1), strict=False):
            bench.joint("SEG2", [low[first], tops[first]], "JOI1", **in_units(law, unit, length))
        turning = []
        for law, x in zip(FOOTINGS, (-9.0, -5.0), strict=True) if self.footings else ():
            low.append(bench.node(x, 0.0))
            turning.append(bench.node(x, 0.5))
            bench.fix(low[-1], "RZ")
            bench.joint("SEG2", [low[-1], turning[-1]], "JOI1", **in_units(law, unit, length))
        corners = np.cumsum([10.0, *rng.uniform(0.7, 1.6, 2)])
        below = [bench.node(x, 0.0) for x in corners]
        above = [bench.node(x, 0.0) for x in corners]
        for k, law in enumerate(self.line_laws):
            cell = [above[k], above[k + 1], below[k], below[k + 1]]
            bench.joint("RAC2", cell, "JOI2", **in_units(law, unit, length))
        ground, heavy = [*low, *below], [*tops, *above, *turning]
        for node in turning:
            bench.mass(stiff * rng.uniform(20.0, 60.0), node, ("RZ",))
            bench.spring(stiff * rng.uniform(1e4, 4e4), node, unknown="RZ")
        for node in heavy:
            mass = stiff * rng.uniform(60.0, 140.0)
            bench.mass(mass, node, ("UX",))
            bench.mass(1.3 * mass, node, ("UY",))
            for unknown in ("UX", "UY"):
                bench.spring(stiff * rng.uniform(1e4, 4e4), node, unknown=unknown)
                if self.damping == "dashpots":
                    bench.dashpot(stiff * rng.uniform(20.0, 300.0), node, unknown)
        for a, b in itertools.pairwise(heavy):
            bench.spring(stiff * rng.uniform(1e5, 3e5), a, b, "UX")
            bench.spring(stiff * rng.uniform(1e5, 3e5), b, a, "UY")
        held = [(bench.relate([(1.0, u, n)]), u) for n in ground for u in ("UX", "UY")]
        if self.tied:  # the one not first in its row, coefficients unequal
            ends = [(1.0, "UY", above[2]), (-1.7, "UY", above[0]), (0.7, "UX", tops[2])]
            bench.relate(ends)
            bench.relate([(2.0, "UX", tops[0]), (-3.0, "UX", tops[1])])
        stops = []
        if self.unilateral:  # on a moving place, between two bodies, between unequal motions
            stops = [
                bench.relate([(1.0, "UY", tops[0])], 1),
                bench.relate([(1.0, "UX", tops[1]), (-1.0, "UX", above[0])], -1),
                bench.relate([(2.0, "UY", above[1]), (1.5, "UX", tops[2])], 1),
            ]
        times = np.cumsum([0.0, *np.where(np.arange(self.steps) // 17 % 2, 2.1e-3, 1.3e-3)])
        pushes = [(n, f, unit * rng.uniform(-900.0, 300.0)) for n in heavy for f in ("FX", "FY")]
        parts = [(bench.field(*pushes), 1.0 + 0.8 * np.sin(41.0 * times + 0.3))]
        if stops:
            gaps = [
                (m, "FLX", length * g) for m, g in zip(stops, (-1e-3, 2e-3, -1.5e-3), strict=True)
            ]
            parts.append((bench.field(*gaps), 1.0 + 0.2 * np.cos(57.0 * times)))
        if self.moving:
            drift = [(m, "FLX", length * rng.uniform(1e-4, 5e-4)) for m, _ in held[:5]]
            shake = [(m, "FLX", length * rng.uniform(-1e-3, 1e-3)) for m, _ in held[3:]]
            parts += [(bench.field(*drift), 20.0 * times),
                      (bench.field(*shake), np.sin(73.0 * times))]  # fmt: skip
        load = Load(tuple(
            LoadPart("MECA", field, Curve((CurvePart(times, factors),))) for field, factors in parts
        ))  # fmt: skip
        C = bench.damping
        if self.damping == "Rayleigh":
            blocks = bench.mass_matrix.scaled(3.0).blocks + bench.stiffness.scaled(2e-3).blocks
            C = Matrix(bench.table, blocks, kind="AMORTISSEMENT")
        start = [(n, u, length * rng.uniform(-3e-4, 3e-4)) for n in heavy for u in ("UX", "UY")]
        fast = [(n, u, length * rng.uniform(-0.05, 0.05)) for n in heavy for u in ("UX", "UY")]
        return bench.problem(
            times,
            damping=C,
            load=load,
            displacement=None if self.tied else bench.field(*start),
            velocity=None if self.tied else bench.field(*fast),
            scheme=SCHEMES[self.scheme],
        )


def problems(**fixed) -> st.SearchStrategy[Awkward]:
    """Problems of any kind, but for what is fixed."""
    free = {
        "seed": st.integers(0, 2**20), "scheme": st.integers(0, len(SCHEMES) - 1),
        "tied": st.booleans(), "moving": st.booleans(),
        "damping": st.sampled_from(["none", "dashpots", "Rayleigh"]),
        "units": st.integers(0, len(UNITS) - 1),
    }  # fmt: skip
    return st.builds(Awkward, **free | {name: st.just(value) for name, value in fixed.items()})
