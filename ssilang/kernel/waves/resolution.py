"""Whether a mesh carries the waves of a record, and which of its edges send them back."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.cells import CELL_TYPES, CellType
from ssilang.kernel.mesh.mesh import Mesh

#: elements a wavelength of shear, by the degree of the shape functions
ELEMENTS_A_WAVE = {1: 8, 2: 4}


def highest_frequency(times: FloatArray, acceleration: FloatArray) -> float:
    """Frequency above which the spectrum of velocity stays below 5 % of its peak (Hz).

    Parameters
    ----------
    acceleration : array (..., n_times)
    """
    step = float(times[-1] - times[0]) / (len(times) - 1)
    frequencies = np.fft.rfftfreq(len(times), step)[1:]
    rows = np.abs(np.fft.rfft(acceleration.reshape(-1, len(times)), axis=1))[:, 1:]
    spectrum = rows.max(axis=0) / frequencies
    above = np.flatnonzero(spectrum > 0.05 * spectrum.max(initial=0.0))
    return float(frequencies[above[-1]]) if len(above) else 0.0


def longest_sides(zone: Zone) -> FloatArray:
    """Longest side of each cell of a zone (n,), between corners."""
    nodes = zone.cells.coordinates
    sides = [
        np.linalg.norm(nodes[:, i] - nodes[:, j], axis=1)
        for i, j in _edges(CELL_TYPES[zone.cells.cell_type])
    ]
    return np.max(sides, axis=0)


def _edges(kind: CellType) -> set[tuple[int, int]]:
    """Pairs of corners of each face, of a line its ends."""
    contours = [
        tuple(local[c] for c in CELL_TYPES[name].corners) for name, local in kind.faces
    ]  # fmt: skip
    return {
        (min(i, j), max(i, j))
        for contour in contours or [kind.corners]
        for i, j in zip(contour, contour[1:] + contour[:1], strict=True)
        if i != j
    }


#: a face whose middle lies so far above its cell's, as a share of the way, is the surface's
UPWARDS = 0.5


@dataclass(frozen=True)
class Reflecting:
    """The nearest node of an edge without dampers, its way from a mesh, and how many there are."""

    place: FloatArray
    distance: float
    count: int


def reflecting_edges(model: Model, near: Mesh, dampers: Matrix | None) -> Reflecting | None:
    """Sides and bottom of a ground without dampers, None if all have some.

    Parameters
    ----------
    model : Model
        Of the ground alone.
    near : Mesh
        What the distance is taken from.
    """
    outline = _sides_and_bottom(model)
    blocks = () if dampers is None else dampers.blocks
    damped = [b.nodes.ravel() for b in blocks]
    bare = np.setdiff1d(outline, np.concatenate([np.empty(0, np.int64), *damped]))
    if not len(bare):
        return None
    xyz = model.zones[0].cells.nodes.coordinates
    of_near = xyz[near.sorted_node_ids]
    distances = np.array([np.linalg.norm(of_near - xyz[n], axis=1).min() for n in bare])
    i = int(np.argmin(distances))
    return Reflecting(xyz[bare[i]], float(distances[i]), len(bare))


def bare_sides(model: Model, known: IntArray) -> IntArray:
    """Nodes of a ground's base and outermost sides, but for some that are known."""
    zones = tuple(z for z in model.zones if not is_joint(z))
    if not zones:
        return known[:0]
    nodes, axis = np.setdiff1d(_sides_and_bottom(Model(zones)), known), zones[0].mode.dimension - 1
    places, whole = (zones[0].cells.nodes.coordinates[of, : axis + 1] for of in (nodes, known))
    both = np.append(whole, places, axis=0)
    slack = 1e-6 * float(np.ptp(both, axis=0).max(initial=0.0))
    least, most = places <= both.min(axis=0) + slack, places >= both.max(axis=0) - slack
    most[:, axis] = False  # the surface
    if zones[0].mode in (Mode.AXISYMMETRIC, Mode.FOURIER):
        least[:, 0] = False
    return nodes[(least | most).any(axis=1)]


def _sides_and_bottom(model: Model) -> IntArray:
    """Nodes of faces of one cell only that do not look up."""
    faces: dict[bytes, tuple[int, IntArray]] = {}
    axis = model.zones[0].mode.dimension - 1
    for cells in (zone.cells for zone in model.zones):
        xyz = cells.coordinates
        middles = xyz.mean(axis=1)
        for _, local in CELL_TYPES[cells.cell_type].faces:
            way = xyz[:, local].mean(axis=1) - middles
            up = way[:, axis] > UPWARDS * np.linalg.norm(way, axis=1)
            for nodes, rises in zip(cells.connectivity[:, local], up, strict=True):
                key = np.sort(nodes).tobytes()
                seen = faces.get(key, (0, nodes))[0]
                faces[key] = (seen + 1 + int(rises) * 2, nodes)
    outer = [nodes for count, nodes in faces.values() if count == 1]
    return np.unique(np.concatenate([np.empty(0, np.int64), *outer]))
