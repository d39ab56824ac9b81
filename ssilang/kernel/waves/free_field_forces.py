"""Forces that bring a given free field into a mesh, at a layer of elements or at its edges.

Both come from the discrete equations themselves: with the matrices of the elements concerned,
`A x` standing for `M a + C v + K u` of the free field x,

- at a layer of elements (domain reduction method, Bielak, Loukakis, Hisada and Yoshimura 2003) the
  forces are `A_eb x_b` on the outer nodes e and `-A_be x_e` on the inner ones b: inside, the motion
  is the total one, outside, what the structure sends back;
- at the edges they are what the ground beyond exerts, the residual `A x` of the elements inside,
  and what the dampers of the edges take of the free field, `C_edge v` (Zienkiewicz, Bicanic and
  Shen 1989).

A free field that obeys the discrete equations is brought in to rounding, whatever the mesh.

Cells whose forces no stiffness gives: those of a plastic law, or of a joint that opens.

And those of a free field that have yielded: no linear ground moves as they did.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements.zone_fields import rows_of
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.assembly import (
    Numbering,
    assemble_blocks,
    field_to_vector,
    numbering_of,
    vector_to_field,
)
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.plasticity.points import is_plastic

PLASTIC = "EPSE"
"""Cumulated plastic strain among internal variables."""
NOTHING = 1e-9
"""Plastic strain that changes no motion."""


@dataclass(frozen=True)
class Yielding:
    """Law, middle of the first cell, number of cells."""

    behaviour: tuple[str, ...]
    place: FloatArray
    count: int

    def told(self) -> dict[str, Any]:
        """What messages say of them."""
        return {"law": " ".join(self.behaviour), "place": self.place, "count": self.count}


def yielding_outside(model: Model, inside: Mesh) -> Yielding | None:
    """Cells of laws that are not linear among those that are not cells of a mesh."""
    kept = [block.connectivity for block in inside.blocks]
    return _yielding(model, lambda nodes: ~_among(nodes, kept))


def yielding_at(model: Model, edge: Mesh) -> Yielding | None:
    """Cells of laws that are not linear among those that touch a mesh."""
    nodes = edge.sorted_node_ids
    return _yielding(model, lambda of: np.asarray(np.isin(of, nodes).any(axis=1), bool))


def _yielding(model: Model, wanted: Callable[[IntArray], BoolArray]) -> Yielding | None:
    count, first = 0, None
    for zone in model.zones:
        if law_of(zone.behaviour).linear if is_joint(zone) else not is_plastic(zone):
            continue
        found = np.flatnonzero(wanted(zone.cells.connectivity))
        if len(found) and first is None:
            first = (zone.behaviour, zone.cells.shown_middle(int(found[0])))
        count += len(found)
    return None if first is None else Yielding(*first, count)


@dataclass(frozen=True)
class Yielded:
    """Largest cumulated plastic strain, middle of its cell, number of cells that have yielded."""

    strain: float
    place: FloatArray
    count: int


def yielded(variables: CellField, nodes: IntArray, axis: int | None = None) -> Yielded | None:
    """Cells of a free field that have yielded, of those whose motion some nodes take.

    Parameters
    ----------
    variables : CellField
        Internal variables at the end of the free field.
    nodes : array (n,)
        Nodes that take the motion.
    axis : int or None
        Upward axis, if they take that of a column at their height; None for that of their own.
    """
    count, worst, place = 0, 0.0, np.zeros(0)
    for block in variables.blocks:
        if PLASTIC not in block.components or not len(block.cells):
            continue
        strain = np.asarray(block.components[PLASTIC], dtype=float).max(axis=1)
        strain = np.broadcast_to(strain, (len(block.cells),))
        found = np.flatnonzero((strain > NOTHING) & _concerned(block.cells, nodes, axis))
        count += len(found)
        if len(found) and strain[found].max() > worst:
            cell = int(found[np.argmax(strain[found])])
            worst = float(strain[cell])
            place = block.cells.shown_middle(cell)
    return Yielded(worst, place, count) if count else None


def _concerned(cells: CellBlock, nodes: IntArray, axis: int | None) -> BoolArray:
    """Which cells have these nodes alone, or reach in between their heights."""
    if axis is None:
        return np.asarray(np.isin(cells.connectivity, nodes).all(axis=1), bool)
    heights = cells.nodes.coordinates[nodes, axis]
    own = cells.coordinates[..., axis]
    low, high = own.min(axis=1), own.max(axis=1)
    slack = 1e-6 * (high - low)
    return np.asarray((high > heights.min() + slack) & (low < heights.max() - slack), bool)


#: singular values below this share of the largest one are rounding
ROUNDING = 1e-15
STILL = 1e-6
"""Share of the largest velocity up to which an unknown does not move."""


@dataclass(frozen=True)
class Ground:
    """Stiffness, mass and damping (or none) of the ground on one numbering."""

    stiffness: Matrix
    mass: Matrix
    damping: Matrix | None

    @property
    def matrices(self) -> tuple[Matrix, ...]:
        """Those that there are, the stiffness first."""
        kept = (self.stiffness, self.mass, self.damping)
        return tuple(m for m in kept if m is not None)

    @property
    def numbering(self) -> Numbering:
        """Of all their unknowns."""
        return numbering_of(*self.matrices)


@dataclass(frozen=True)
class Share:
    """Matrices of some elements of the ground, and the unknowns whose motion they ask for."""

    numbering: Numbering
    stiffness: sp.csr_array
    mass: sp.csr_array
    damping: sp.csr_array
    touched: BoolArray

    def force(self, u: FloatArray, v: FloatArray, a: FloatArray) -> FloatArray:
        """`M a + C v + K u` for histories (n, n_times)."""
        return self.mass @ a + self.damping @ v + self.stiffness @ u


def elements_of(ground: Ground, cells: Mesh) -> Share:
    """The share of the elements that are the cells of a mesh.

    Raises
    ------
    FieldError
        If some cells have no element of the ground.
    """
    wanted = [block.connectivity for block in cells.blocks]
    known = [block.nodes for block in ground.stiffness.blocks]
    lost = sum(int((~_among(nodes, known)).sum()) for nodes in wanted)
    if lost:
        raise FieldError("kernel.waves.cells-without-elements", count=lost)
    return _share(ground, lambda nodes: _among(nodes, wanted))


def elements_at(ground: Ground, edge: Mesh) -> Share:
    """The share of the elements that touch a mesh."""
    return elements_with(ground, edge.sorted_node_ids)


def elements_with(ground: Ground, nodes: IntArray) -> Share:
    """The share of the elements that have one of some nodes (n,)."""
    return _share(ground, lambda of: np.asarray(np.isin(of, nodes).any(axis=1)))


def _among(nodes: IntArray, others: list[IntArray]) -> BoolArray:
    """Which rows (n, k) have the nodes of a row of the others, in any order."""
    own = [of for of in others if of.shape[1] == nodes.shape[1]]
    found = rows_of(np.concatenate([nodes[:0], *own]), nodes)
    return np.asarray(found >= 0, bool)


def _share(ground: Ground, kept: Callable[[IntArray], BoolArray]) -> Share:
    numbering = ground.numbering
    stiffness, mass, damping = (
        assemble_blocks(
            [b.some(kept(b.nodes)) for b in (matrix.blocks if matrix is not None else ())],
            numbering,
        )
        for matrix in (ground.stiffness, ground.mass, ground.damping)
    )
    touched = sum(np.diff(m.indptr) for m in (stiffness, mass, damping)) > 0
    return Share(numbering, stiffness, mass, damping, np.asarray(touched, dtype=bool))


@dataclass(frozen=True)
class Motion:
    """Free field on a numbering: histories (n, n_times); nan where it is not known."""

    times: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    acceleration: FloatArray

    def at(self, unknowns: BoolArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Displacement, velocity, acceleration of some unknowns, zero for the others."""
        kept = unknowns[:, None]
        u, v, a = (
            np.where(kept, of, 0.0) for of in (self.displacement, self.velocity, self.acceleration)
        )
        return u, v, a


def layer_forces(layer: Share, inside: Mesh, motion: Motion) -> FloatArray:
    """Forces (n, n_times) of the domain reduction on the nodes of a layer of elements.

    Parameters
    ----------
    inside : Mesh
        The ground inside; its nodes in the layer are the inner ones.

    Raises
    ------
    FieldError
        If the layer does not touch what is inside, or has no outer nodes, or the motion of some
        node of the layer is not known.
    """
    numbering = layer.numbering
    of_inside = np.isin(numbering.nodes, inside.sorted_node_ids)
    inner, outer = layer.touched & of_inside, layer.touched & ~of_inside
    if not inner.any() or not outer.any():
        raise FieldError("kernel.waves.layer-not-around")
    _known(numbering, layer.touched, motion)
    on_outer = layer.force(*motion.at(inner))
    on_inner = layer.force(*motion.at(outer))
    made: FloatArray = np.where(outer[:, None], on_outer, 0.0)
    return made - np.where(inner[:, None], on_inner, 0.0)


def edge_forces(row: Share, edge: Mesh, dampers: Matrix, motion: Motion) -> FloatArray:
    """Forces (n, n_times) of the ground beyond the edges on the nodes of the edges.

    Raises
    ------
    FieldError
        If the motion of some node of the elements at the edges is not known.
    """
    numbering = row.numbering
    at_edge = np.isin(numbering.nodes, edge.sorted_node_ids)
    damping = assemble_blocks(dampers.blocks, numbering)
    damped = np.diff(damping.indptr) > 0
    _known(numbering, row.touched | damped, motion)
    residual = np.where(at_edge[:, None], row.force(*motion.at(row.touched)), 0.0)
    taken: FloatArray = damping @ motion.at(damped)[1]
    return residual + taken


def _known(numbering: Numbering, wanted: BoolArray, motion: Motion) -> None:
    for of in (motion.displacement, motion.velocity, motion.acceleration):
        lost = np.flatnonzero(wanted & np.isnan(of).any(axis=1))
        if len(lost):
            unknown = numbering.label(int(lost[0]))
            raise FieldError("kernel.waves.motion-not-known", unknown=unknown, count=len(lost))


def load_of(share: Share, dampers: Matrix | None, motion: Motion, forces: FloatArray) -> Load:
    """Histories of forces (n, n_times) as few constant fields times curves.

    The fields are left singular vectors; what is left out is rounding. The masses of the share, and
    the dampers where the motion is not nought (or not known), stand beside them.
    """
    numbering, speed = share.numbering, np.abs(motion.velocity).max(axis=1)
    damping = np.zeros(numbering.size)
    if dampers:  # a matched layer has unknowns of its own
        own = numbering_of(dampers)
        found = vector_to_field(assemble_blocks(dampers.blocks, own).diagonal(), own)
        damping = field_to_vector(found, numbering, dual=False)
    damping[speed <= STILL * np.nan_to_num(speed).max()] = 0.0
    beside = tuple(vector_to_field(of, numbering) for of in (share.mass.diagonal(), damping))
    rows = np.flatnonzero(np.abs(forces).max(axis=1, initial=0.0) > 0)
    if not len(rows):
        return Load(())
    left, size, right = np.linalg.svd(forces[rows], full_matrices=False)
    parts = []
    for k in range(int((size > ROUNDING * size[0]).sum())):
        vector = np.zeros(numbering.size)
        vector[rows] = left[:, k]
        whole = vector_to_field(vector, numbering, dual=True)
        nodes = np.unique(numbering.nodes[rows])
        values = {name: whole.values_at(name, nodes) for name in whole.components}
        field = NodeField.of(whole.table, nodes, values, "DISCRET")
        curve = Curve((CurvePart(motion.times, size[k] * right[k], "TEMP", "FORC"),), "")
        parts.append(LoadPart("MECA", field, curve, beside=beside))
    return Load(tuple(parts))


def along_columns(heights: FloatArray, column: FloatArray) -> sp.csr_array:
    """Weights (n, m) of a column's points, by height, in the motion of points at heights.

    Linear between the two nearest; points of a height that the column has get its motion as it is.

    Raises
    ------
    FieldError
        For a height that the column does not reach.
    """
    order = np.argsort(column, kind="stable")
    sorted_ = column[order]
    slack = 1e-6 * max(float(np.ptp(column)), 1e-12)
    wrong = (heights < sorted_[0] - slack) | (heights > sorted_[-1] + slack)
    if len(column) < 2 or wrong.any():
        height = float(heights[wrong][0]) if wrong.any() else 0.0
        raise FieldError(
            "kernel.waves.outside-column", height=height, low=sorted_[0], high=sorted_[-1]
        )
    above = np.clip(np.searchsorted(sorted_, heights - slack), 1, len(column) - 1)
    share = (heights - sorted_[above - 1]) / (sorted_[above] - sorted_[above - 1])
    share = np.clip(share, 0.0, 1.0)
    share[np.abs(heights - sorted_[above]) < slack] = 1.0
    share[np.abs(heights - sorted_[above - 1]) < slack] = 0.0
    n = np.arange(len(heights))
    places = (np.concatenate([n, n]), np.concatenate([order[above - 1], order[above]]))
    weights = np.concatenate([1 - share, share])
    return sp.coo_array((weights, places), (len(n), len(column))).tocsr()
