"""Local axes among the parameters of beams, pipes and joints of two points, turned by a motion.

The axes of a beam or pipe turn by the mean of the rotations of its nodes: a rotation vector of any
size. What lies along the line needs none of this, since it follows the nodes themselves. Those of a
joint turn with the segment between its nodes: about it by the part along it of that mean, then the
shortest way to where the segment goes; where both nodes are at one place, by the mean.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.deformed import displacements
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.mesh import Point

FOLLOWING = "LIE"
"""Of the option FRAME of JOI1: its axes follow."""
_VECTORS = (("VX", "VY", "VZ"), ("V1X", "V1Y", "V1Z"), ("V2X", "V2Y", "V2Z"))
_LINES = ("beam", "timoshenko", "pipe")


def following_axes(model: Model, material: CellField, motion: NodeField) -> CellField:
    """The parameters with the axes of the model's beams, pipes and bound joints turned.

    Parameters
    ----------
    motion : NodeField
        Its rotations RX RY RZ [rad] count; those that it lacks are zero.
    """
    blocks = list(material.blocks)
    for zone in model.zones:
        if not _turns(zone):
            continue
        for i, block in enumerate(blocks):
            if block.cells is zone.cells and block.element in ("", zone.element):
                blocks[i] = _turned(block, _turns_of(zone, motion))
    return CellField(tuple(blocks), material.title)


def _turns(zone: Zone) -> bool:
    if zone.element == "JOI1":
        return zone.options.get("FRAME") == FOLLOWING
    kind = ELEMENTS.get(zone.element)
    return kind is not None and kind.family in _LINES


def _turns_of(zone: Zone, motion: NodeField) -> FloatArray:
    """Turns of the cells' axes, (n, 3, 3); the nodes stand where the motion has taken them."""
    from scipy.spatial.transform import Rotation

    nodes, ends = zone.cells.connectivity, zone.cells.coordinates
    mean = np.zeros((len(nodes), 3))
    for i, name in enumerate(("RX", "RY", "RZ")):
        if name in motion.components:
            mean[:, i] = motion.values_at(name, nodes.ravel()).reshape(nodes.shape).mean(axis=1)
    plain = Rotation.from_rotvec(mean)
    if zone.element != "JOI1":
        return plain.as_matrix()
    starts = ends - displacements(motion)[nodes]
    before, after = starts[:, 1] - starts[:, 0], ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    apart = lengths > 0.0
    axis = before / np.where(apart, np.linalg.norm(before, axis=1), 1.0)[:, None]
    about = Rotation.from_rotvec(np.vecdot(mean, axis)[:, None] * axis)
    across = np.cross(before, after)
    sine = np.linalg.norm(across, axis=1)
    back = (sine == 0.0) & (np.vecdot(before, after) < 0.0)  # any axis across the segment does
    across[back] = np.cross(before[back], np.eye(3)[np.abs(before[back]).argmin(axis=1)])
    size = np.linalg.norm(across, axis=1)
    angle = np.arctan2(sine, np.vecdot(before, after))
    swing = Rotation.from_rotvec(across * (angle / np.where(size > 0.0, size, 1.0))[:, None])
    return np.where(apart[:, None, None], (swing * about).as_matrix(), plain.as_matrix())


def _turned(block: CellFieldBlock, turn: FloatArray) -> CellFieldBlock:
    made = dict(block.components)
    for names in _VECTORS:
        if any(n in made for n in names):
            made.update(_turned_columns(made, names, turn))
    if "VECT" in made:
        made["VECT"] = _turned_points(block, made["VECT"], turn)
    return replace(block, components=made)


def _turned_columns(
    components: dict[str, NDArray[Any]], names: tuple[str, ...], turn: FloatArray
) -> dict[str, FloatArray]:
    """Three columns of cosines, turned; absent ones count as zero and are added."""
    given = [
        np.asarray(components[n], float) if n in components else np.zeros((1, 1)) for n in names
    ]
    shape = np.broadcast_shapes(*(g.shape for g in given), (len(turn), 1))
    v = np.stack([np.broadcast_to(g, shape) for g in given], axis=-1)
    moved = np.einsum("cij,cpj->cpi", turn, v)
    return {n: moved[..., i] for i, n in enumerate(names)}


def _turned_points(block: CellFieldBlock, values: NDArray[Any], turn: FloatArray) -> NDArray[Any]:
    """Vectors kept as points: new points, one for cells that turn alike."""
    flat = np.asarray(values, dtype=object).reshape(len(values), -1)[:, 0]
    rows = [v.coordinates if isinstance(v, Point) else np.asarray(v, float) for v in flat]
    moved = np.einsum("cij,cj->ci", turn, np.broadcast_to(np.array(rows), (len(turn), 3)))
    different, place = np.unique(moved.round(14), axis=0, return_inverse=True)
    table = block.cells.nodes
    points = [Point(table, int(n)) for n in table.add(different)]
    made = np.empty((len(turn), 1), dtype=object)
    made[:, 0] = [points[k] for k in place.ravel()]
    return made
