"""Which loads shake a problem, and which of its cells are too long for what they bring.

A load shakes where it is the mass times an acceleration of the whole: what moves is relative to
the ground then.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.queries.measure import cell_measures
from ssilang.kernel.statics.cells_amiss import bordered_solids
from ssilang.kernel.statics.doubled import face_keys
from ssilang.kernel.waves.resolution import ELEMENTS_A_WAVE, longest_sides

if TYPE_CHECKING:
    from ssilang.kernel.stepping.problem.problem import Problem

AXES = ("UX", "UY", "UZ")
SAME = 1e-6  # of a force, that is rounding
LARGE = 30_000_000  # numbers of loads beyond which copies of them are not made for a look
STRONG = 0.9  # of the energy of the ground's velocity: what lies below carries the motion
FEWER = 0.625  # of the usual cells of a wavelength: five linear ones, where each costs a tenth
LOOKED_AT = 2000  # cells of a block
FEWEST, BOTH_WAYS = 10, 0.1  # points of a record; its values of the lesser sign over the largest
GRAVITIES = (9.81, 9810.0)  # in metres or millimetres
NORMALS = ((0, "UX"), (0, "UR"), (1, "UY"), (1, "UZ"), (2, "UZ"))
ALIKE = ((0.75, 6.0), (0.75, np.inf))
"""Impedances of sides, and of a base, over that of their cells; rock beside soil has some."""


def axes_of(problem: "Problem") -> list[str]:
    """Displacements that the problem knows."""
    return [a for a in AXES if a in problem.numbering.unknowns]


def translations(problem: "Problem") -> FloatArray:
    """Motions (n, d) of the whole along its axes."""
    numbering = problem.numbering
    rows = [numbering.codes == numbering.code(a) for a in axes_of(problem)]
    return np.array(rows, dtype=float).reshape(-1, numbering.size).T


def shares(parts: FloatArray, wholes: FloatArray) -> FloatArray:
    """What makes each of `wholes` (n, k) of `parts` (n, d): (d, k), nought where nothing does."""
    found = np.linalg.lstsq(parts, wholes, rcond=None)[0]
    off = np.abs(parts @ found - wholes).max(axis=0, initial=0.0)
    return np.where(off > SAME * np.abs(wholes).max(axis=0, initial=0.0), 0.0, found)


def changing(problem: "Problem") -> BoolArray:
    """Which loads (k,) change."""
    return np.asarray(np.ptp(problem.loading.at(problem.times), axis=0) > 0.0)


def accelerations(problem: "Problem") -> FloatArray:
    """Accelerations (d, k) of the whole of which the mass makes the loads, nought for others.

    Where one node has all the mass, any force on it is some: one of -1 alone, or of -g, is meant.
    """
    forces, T, along = problem.loading.forces, problem.constraints.T, translations(problem)
    if forces.size >= LARGE or not along.size:
        return np.zeros((along.shape[1], forces.shape[1]))
    found = shares(T.T @ (problem.M @ along), T.T @ forces)
    if len(np.unique(problem.numbering.nodes[problem.M.diagonal() > 0.0])) == 1:
        meant = np.isclose(-found.min(axis=0)[:, None], (1.0, *GRAVITIES), SAME).any(axis=1)
        found = found * (meant | ~changing(problem))
    return found


def largest_motions(problem: "Problem") -> FloatArray:
    """Largest acceleration (k,) of each load that changes and shakes, largest factor of others."""
    loading, sizes = problem.loading, np.linalg.norm(accelerations(problem), axis=0)
    sizes = np.where(sizes > 0.0, sizes, np.abs(loading.imposed).max(axis=0, initial=0.0))
    most = np.abs(loading.at(problem.times)).max(axis=0, initial=0.0)
    return np.asarray((np.where(sizes > 0.0, sizes, 1.0) * most)[changing(problem)])


def ground_along(problem: "Problem", name: str) -> FloatArray:
    """Accelerations (t,) of the ground along an axis, that loads -M a stand for; else nought."""
    axes, factors = axes_of(problem), problem.loading.at(problem.times)
    shaking = accelerations(problem) * changing(problem)
    return -factors @ (shaking[axes.index(name)] if name in axes else np.zeros(shaking.shape[1]))


def is_record(values: FloatArray) -> bool:
    """Whether the values (n,) of a curve swing to both sides."""
    ends = float(values.max(initial=0.0)), -float(values.min(initial=0.0))
    return len(values) >= FEWEST and min(ends) > BOTH_WAYS * max(ends)


def strong_frequency(
    times: FloatArray, values: FloatArray, power: int = -1, share: float = STRONG
) -> float:
    """Frequency (Hz) below which a share of the energy of a motion's velocities lies.

    Parameters
    ----------
    values : array (n,)
        Accelerations at `times` (n,), which need not be evenly apart.
    power : int
        Of the frequency that makes velocities of them: 1 for displacements.
    """
    even = np.linspace(times[0], times[-1], len(times))
    frequencies = np.fft.rfftfreq(len(even), even[1] - even[0])[1:]
    spectrum = np.abs(np.fft.rfft(np.interp(even, times, values)))[1:]
    energy = np.cumsum((spectrum * frequencies**power) ** 2)
    return float(frequencies[np.searchsorted(energy, share * energy[-1])]) if energy[-1] else 0.0


@dataclass(frozen=True)
class Long:
    """The cell with the fewest of its size in a wavelength of shear.

    Attributes
    ----------
    length, speed : float
        Of the cell, of shear waves in it.
    wanted, cells, usual : float
        Length of a cell of which a wavelength has the usual number; numbers that it has, is usual.
    """

    node: int
    length: float
    speed: float
    wanted: float
    cells: float
    usual: int


def unlike_sides(
    stiffness: Matrix, mass: Matrix, damping: Matrix
) -> tuple[int, float, bool] | None:
    """A node of upright sides whose dashpots are not those of the cells beside, and how many times.

    The last says that it is one of a base, whose dashpots are softer than the cells above.

    A uniform strain s across a face of area A and a translation t tell the impedance of cells of
    length l: `rho V_p A = sqrt(s K s t M t) / l`.
    """
    heavy = {id(b.raw_nodes): b for b in mass.blocks}
    edges = [(b, face_keys(b.nodes)) for b in _of_sides(damping)]
    solids = bordered_solids(stiffness) if edges else []
    for (block, zone, border), (axis, name) in product(solids, NORMALS):
        x, base = block.table.coordinates[block.nodes, axis], axis == zone.cells.kind.dimension - 1
        if name not in block.unknowns or block.unknowns.index(name) != axis:
            continue
        for (_, local), own in zip(zone.cells.kind.faces, border, strict=True):
            side = own & (np.ptp(x[:, local], axis=1) < SAME * np.ptp(x, axis=1))
            side &= (not base) | (x[:, local].mean(axis=1) < x.mean(axis=1))
            keys = face_keys(block.nodes[:, local])
            for edge, beside in edges if side.any() and id(block.raw_nodes) in heavy else ():
                if not (met := side & np.isin(keys, beside)).any():
                    continue
                own_mass, sizes = heavy[id(block.raw_nodes)], np.ptp(x[met], axis=1)
                squares = _strained(block, own_mass, np.flatnonzero(met), x[met], name)
                wanted = (np.sqrt(np.maximum(np.prod(squares, axis=0), 0.0)) / sizes).sum()
                on = np.array([u == name for u in edge.unknowns]) * 1.0
                given = np.einsum("i,nij,j->", on, edge.values[np.isin(beside, keys[met])], on)
                times = given / (wanted or np.inf)
                if times and not ALIKE[base][0] < times < ALIKE[base][1]:
                    return int(block.nodes[met][0, local[0]]), float(times), base
    return None


def _of_sides(damping: Matrix) -> list[ElementMatrices]:
    """Dashpots on sides of cells."""
    return [b for b in damping.blocks if b.kind == "AMORTISSEMENT" and b.raw_nodes.shape[1] > 1]


def absorbing_ends(stiffness: Matrix, damping: Matrix) -> tuple[IntArray, IntArray]:
    """Nodes of the highest sides of cells if some have dashpots, of the lowest if none has."""
    braked = [face_keys(b.nodes) for b in _of_sides(damping)]
    solids = bordered_solids(stiffness) if braked else []
    heights = [b.table.coordinates[b.nodes, z.cells.kind.dimension - 1] for b, z, _ in solids]
    none = np.zeros(0, np.int64)
    if not solids:
        return none, none

    def sides_at(level: float) -> list[IntArray]:
        return [
            block.nodes[own & (np.abs(x[:, at] - level).max(axis=1) < SAME * np.ptp(x))][:, at]
            for (block, zone, border), x in zip(solids, heights, strict=True)
            for (_, at), own in zip(zone.cells.kind.faces, border, strict=True)
        ]

    levels = max(x.max() for x in heights), min(x.min() for x in heights)
    ends = [sides_at(level) for level in levels]
    above, below = (
        any(np.isin(face_keys(s), np.concatenate(braked)).any() for s in sides) for sides in ends
    )
    nodes = [np.concatenate([none, *(s.ravel() for s in sides)]) for sides in ends]
    return nodes[0] if above else none, none if below else nodes[1]


def _strained(
    block: ElementMatrices,
    mass: ElementMatrices,
    some: slice | IntArray,
    x: FloatArray,
    name: str,
) -> tuple[FloatArray, FloatArray]:
    """`s K s` and `t M t` of cells, s growing with coordinates x by one and t a translation."""
    moved = np.array([u == name for u in block.unknowns]) * 1.0
    strain = (x - x.mean(axis=1, keepdims=True))[:, block.local] * moved
    stiff = np.einsum("ni,nij,nj->n", strain, block.values[some], strain)
    return stiff, np.einsum("i,nij,j->n", moved, mass.values[some], moved)


def longest_cell(
    stiffness: Matrix, mass: Matrix, axis: str, frequency: float, upwards: bool = True
) -> Long | None:
    """The cell that is longest for shear waves of a frequency (Hz), None without cells.

    Their speed is that of the cell's matrices: `s K s / t M t` of a shear s of one and a
    translation t. The length is that of waves that go `upwards`, else the longest side.
    """
    found: list[Long] = []
    for block, zone, some, stiff, whole in _sheared(stiffness, mass, axis):
        speed = np.sqrt(np.maximum(stiff, 0.0) / np.where(whole > 0.0, whole, np.inf))
        up = block.table.coordinates[block.nodes[some], zone.cells.kind.dimension - 1]
        length = np.ptp(up, axis=1) if upwards else longest_sides(zone)[some]
        times = length / np.where(speed > 0.0, speed, np.inf)
        i, usual = int(times.argmax()), ELEMENTS_A_WAVE[zone.cells.kind.degree]
        if cells := 1.0 / (times[i] * frequency or np.inf):
            told = float(length[i]), float(speed[i]), float(speed[i] / frequency / usual)
            found.append(Long(int(block.nodes[some][i, 0]), *told, float(cells), usual))
    return min(found, key=lambda c: c.cells / c.usual, default=None)


def _sheared(
    stiffness: Matrix, mass: Matrix, axis: str
) -> Iterator[tuple[ElementMatrices, Zone, slice, FloatArray, FloatArray]]:
    """Some cells of solids with mass: `s K s` and `t M t` of a shear of one and a translation."""
    heavy = {id(b.raw_nodes): b for b in mass.blocks if b.raw_nodes.shape[1] > 1}
    for block in stiffness.blocks:
        zone = block.zone
        if zone is None or is_joint(zone) or id(block.raw_nodes) not in heavy:
            continue
        d = zone.cells.kind.dimension
        if axis in block.unknowns and len({*block.unknowns}) == d > 1:
            some = slice(None, None, 1 + len(block.values) // LOOKED_AT)
            up = block.table.coordinates[block.nodes[some], d - 1]
            yield block, zone, some, *_strained(block, heavy[id(block.raw_nodes)], some, up, axis)


def matter(stiffness: Matrix, mass: Matrix) -> FloatArray:
    """Node, height, density, speed of shear waves (n, 4) of some cells of solids that have mass."""
    found = [np.zeros((0, 4))]
    for block, zone, some, stiff, whole in _sheared(stiffness, mass, "UX"):
        up = block.table.coordinates[block.nodes[some], zone.cells.kind.dimension - 1].mean(axis=1)
        speed = np.sqrt(np.maximum(stiff, 0.0) / np.where(whole > 0.0, whole, np.inf))
        rows = [block.nodes[some, 0], up, whole / cell_measures(zone.cells.some(some)), speed]
        found.append(np.stack(rows, axis=1)[whole > 0.0])
    return np.concatenate(found)
