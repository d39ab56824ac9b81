"""What DYNAMIC warns of damping proportional to stiffness and mass: ratios that nothing has.

`C = a M + b K` damps a motion of the pulsation w by `a / (2 w) + b w / 2` of the critical damping.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.elements.families import stiffness
from ssilang.kernel.interface.interface import joint_zones, without_zones
from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.assembly import assemble
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.plasticity.points import plastic_zones
from ssilang.kernel.stepping.problem.plausibility import Start, Swing, Told
from ssilang.kernel.stepping.problem.problem import Inputs, Problem
from ssilang.kernel.waves.shaken import is_record, matter, strong_frequency

MOST = 0.22  # of the critical damping: soil that shears by several thousandths has less
OVERDAMPED = 2.0  # of it: what creeps, and does not swing
FEWEST_LEVELS = 3  # of cells: fewer are no ground
COUNTS = 0.9  # of the energy of a record's velocities: what lies above moves little
SMALL, BELOW = 0.015, 0.3  # least ratio that is meant; its frequency over that which is moved
KINDS = ("RIGIDITE", "MASSE")


@dataclass(frozen=True)
class _Proportional:
    """Damping that is so many times stiffness (s) and mass (1/s)."""

    beta: float
    alpha: float

    def ratio(self, low: float, high: float) -> float:
        """Ratio to the critical damping; the mass damps the lower frequency (Hz), which swings."""
        return float(np.pi * self.beta * low + self.alpha / (4.0 * np.pi * high))


def damped_heavily(start: Start) -> Told:
    """Damping by stiffness or mass beyond that of any ground or structure, of what a record moves.

    At the frequency of the motion that its forces ask for, or of ground that nothing but dashpots
    holds, where the record reaches so high.
    """
    problem, inputs = start.problem, start.inputs
    if inputs.damping is None:
        return
    own = without_zones(inputs.damping, joint_zones(inputs.model or Model(())))
    parts = [Matrix(own.table, tuple(b for b in own.blocks if b.kind == k)) for k in KINDS]
    records = [k for k, (_, y) in enumerate(problem.loading.curves) if is_record(y)]
    if not records or not any(p.blocks for p in parts):
        return
    shaken, worst = start.accelerations != 0.0, (0.0, 0.0, _Proportional(0.0, 0.0))
    found = [] if plastic_zones(inputs.model) else start.swings
    found = [s for s in found if np.isfinite(s.period)]
    matrices = [assemble(p, problem.numbering) for p in parts]
    ground = None
    for k in records:
        power = -1 if shaken[:, k].any() else int(problem.loading.imposed[:, k].any())
        most = strong_frequency(*problem.loading.curves[k], power, COUNTS)
        moved = [_of_motion(s, problem, matrices) for s in found if s.load == k]
        ground = ground or (None if moved else _ground(inputs, parts))
        for natural, damping in moved or ([ground] if ground else []):
            low = min(natural, most or natural)
            worst = max(worst, (damping.ratio(low, natural), low, damping), key=lambda w: w[0])
    ratio, frequency, damping = worst
    if any(s.damping > OVERDAMPED for s in found):
        return
    if ratio > MOST:
        told = {"ratio": ratio, "frequency": frequency, "wanted": 0.1 / (2.0 * np.pi * frequency)}
        by_mass = np.pi * damping.beta * frequency < ratio / 2.0
        yield "operators.dynamics.damped-heavily", {**told, **vars(damping), "by_mass": by_mass}
        return
    low = float(np.sqrt(damping.alpha * damping.beta))
    least = float(np.sqrt(damping.alpha / (damping.beta or np.inf)) / (2.0 * np.pi))
    if low > SMALL and least < BELOW * frequency:
        told = {"ratio": ratio, "frequency": frequency, "least": least, "low": low}
        yield "operators.dynamics.damped-below", {**told, **vars(damping)}


def _of_motion(swing: Swing, problem: Problem, parts: list[Any]) -> tuple[float, _Proportional]:
    """Frequency (Hz) of a motion, and what damps it."""
    x, natural = swing.motion, 1.0 / swing.period
    shares = [float(x @ (part @ x)) / float(x @ (problem.M @ x)) for part in parts]
    return natural, _Proportional(shares[0] / (2.0 * np.pi * natural) ** 2, shares[1])


def _ground(inputs: Inputs, parts: list[Matrix]) -> tuple[float, _Proportional]:
    """First frequency (Hz) of cells of solids upon their base, the least of what damps them all."""
    solids = plastic_zones(inputs.model)
    own = [stiffness(z, inputs.characteristics) for z in solids if inputs.characteristics]
    whole = Matrix(inputs.stiffness.table, (*inputs.stiffness.blocks, *own))
    cells = matter(whole, inputs.mass) if inputs.mass is not None else np.zeros((0, 4))
    cells = cells[cells[:, 3] > 0.0]
    levels = np.unique(cells[:, 1].round(6))
    if len(levels) < FEWEST_LEVELS:
        return np.inf, _Proportional(0.0, 0.0)
    height = float(np.ptp(levels)) * len(levels) / (len(levels) - 1)
    times = []
    for damping, of in zip(parts, (whole, inputs.mass), strict=True):
        assert of is not None
        size = {id(b.raw_nodes): np.abs(b.values).max(initial=0.0) for b in of.blocks}
        some = [
            float(np.abs(b.values).max(initial=0.0) / size[id(b.raw_nodes)])
            for b in damping.blocks
            if size.get(id(b.raw_nodes)) and b.zone and b.zone.cells.kind.dimension > 1
        ]
        times.append(min(some, default=0.0))
    return float(1.0 / (1.0 / cells[:, 3]).mean()) / (4.0 * height), _Proportional(*times)
