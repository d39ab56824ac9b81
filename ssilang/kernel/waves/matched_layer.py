"""A perfectly matched layer round a box in plane strain, and its histories of stress.

Coordinates beyond the box are stretched, `s_j = alpha_j + beta_j / (i omega)` along each axis, so
that waves fade on their way and none is reflected at the box before the mesh is made (Berenger
1994, Chew and Weedon 1994). In time, with the history of stress `S = int sigma dt` beside the
displacement (Kucukcoban and Kallivokas, A symmetric hybrid formulation for transient wave
simulations in PML-truncated heterogeneous media, Wave Motion 50, 2013: of second order in time,
nothing split),

    rho (a u'' + b u' + c u) = div (S' L_e + S L_p)
    D : (a S'' + b S' + c S) = sym (grad u' L_e + grad u L_p)

    a = alpha_1 alpha_2, b = alpha_1 beta_2 + alpha_2 beta_1, c = beta_1 beta_2,
    L_e = diag(alpha_2, alpha_1), L_p = diag(beta_2, beta_1), D the compliance.

Here alpha is 1, and S stands at the integration points of the displacement elements and jumps
between them: where beta = 0 the equations are then those of the elements inside, and nothing of
the mesh is seen at the box but the stretching. The second equation counts with its sign turned,
which makes matrices symmetric; the inertia of S is negative.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError, MaterialError, MeshError
from ssilang.kernel.elements.boundary import wave_speeds
from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.family import element_matrices, node_major_layout, per_cell
from ssilang.kernel.elements.solids.kinematics import SOLID_KINEMATICS
from ssilang.kernel.elements.solids.solid import zone_geometry
from ssilang.kernel.elements.solids.solid_moduli import solid_moduli, symmetry_of
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, dual_of
from ssilang.kernel.matrices.relations import blocked
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.plasticity.points import is_plastic
from ssilang.kernel.waves.resolution import longest_sides

HISTORIES = ("HXX", "HYY", "HXY")
"""Their inertia is negative."""


def has_histories(matrix: Matrix | None) -> bool:
    """Whether a matrix has such unknowns."""
    blocks = () if matrix is None else matrix.blocks
    return any(HISTORIES[0] in b.unknowns for b in blocks)


def refuse_parts_of_layer(
    stiffness: Matrix | None, mass: Matrix | None, damping: Matrix | None
) -> None:
    """Refuse a motion with some of a layer's matrices only."""
    given = {"RIGI": stiffness, "MASS": mass, "AMOR": damping}
    missing = [name for name, matrix in given.items() if not has_histories(matrix)]
    if 0 < len(missing) < len(given):
        raise KernelError("kernel.waves.part-of-matched-layer", missing=missing)


def refuse_layer_at_rest(matrix: Matrix) -> None:
    """Refuse to solve with a layer's stiffness alone (a sum with mass and damping is a step's)."""
    kinds = {b.kind for b in matrix.blocks if HISTORIES[0] in b.unknowns}
    if kinds == {"RIGIDITE"}:
        raise KernelError("kernel.waves.matched-layer-at-rest")


ORDER = 2
"""Of the stretching's growth with the depth in the layer."""
IN_PLANE = (0, 1, 3)
"""Rows of XX, YY, XY among the strains of plane strain."""
SLACK = 1e-6


@dataclass(frozen=True)
class Stretching:
    """How coordinates are stretched beyond a box."""

    low: FloatArray  # (2,) lower corner of the box
    high: FloatArray  # (2,) its upper corner
    below: FloatArray  # (2,) thickness of the layer before `low`, 0 without one
    above: FloatArray  # (2,) beyond `high`
    speed: float  # of the fastest wave (m/s)
    reflection: float  # what comes back of a wave that meets the layer at a right angle, in theory

    def rates(self, points: FloatArray) -> FloatArray:
        """Beta (..., 2) at points (..., 2), in 1/s.

        The wave that crosses the layer and comes back has lost exp(-2/c int beta dx), which is the
        reflection wanted.
        """
        under, over = self.low - points, points - self.high
        thick = np.where(under > 0, self.below, self.above)
        most = (ORDER + 1) * self.speed * np.log(1 / self.reflection) / 2
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.maximum(np.maximum(under, over), 0.0) / thick
            found: FloatArray = np.where(thick > 0, most / thick * share**ORDER, 0.0)
        return found


@dataclass(frozen=True)
class MatchedLayer:
    """Stiffness (its outer edges held), mass, damping; elements in the least thickness."""

    stiffness: Matrix
    mass: Matrix
    damping: Matrix
    cells: float


def matched_layer(
    model: Model, material: CellField, inside: Mesh, reflection: float | None = None
) -> MatchedLayer:
    """Matrices of a layer round a box.

    Parameters
    ----------
    model : Model
        Of the layer alone: linear isotropic solids in plane strain.
    material : CellField
        YOUN, NU, RHO.
    inside : Mesh
        What the layer stands around; the smallest box that holds it is the box.
    reflection : float or None
        In theory, at a right angle; None for one that suits the number of cells.

    Raises
    ------
    MeshError, MaterialError
        If a cell of the layer lies in the box, if nothing lies beyond it, if it does not touch the
        box, for other elements, other hypotheses and laws that are not linear and isotropic.
    """
    for zone in model.zones:
        _refuse_others(zone)
    table = inside.nodes
    box = table.coordinates[inside.sorted_node_ids, :2]
    nodes = model.mesh.sorted_node_ids
    own = table.coordinates[nodes, :2]
    low, high = box.min(axis=0), box.max(axis=0)
    size = SLACK * float(np.ptp(own, axis=0).max())
    below, above = low - own.min(axis=0), own.max(axis=0) - high
    below, above = (np.where(d > size, d, 0.0) for d in (below, above))
    thick = np.concatenate([below, above])
    if not (thick > 0).any():
        raise MeshError("kernel.waves.nothing-beyond-box")
    apart = float(np.linalg.norm(np.maximum(np.maximum(low - own, own - high), 0), axis=1).min())
    if apart > size:
        raise MeshError("kernel.waves.layer-apart", distance=apart)
    for zone in model.zones:
        middles = zone.cells.coordinates[..., :2].mean(axis=1)
        wrong = ((middles > low - size) & (middles < high + size)).all(axis=1)
        if wrong.any():
            place = zone.cells.shown_middle(int(np.argmax(wrong)))
            raise MeshError("kernel.waves.layer-in-box", place=place, count=int(wrong.sum()))
    longest = max(float(longest_sides(z).max()) for z in model.zones)
    cells = float(thick[thick > 0].min() / longest)
    wanted = suited_reflection(cells) if reflection is None else reflection
    speed = max(float(wave_speeds(z, material)[0].max()) for z in model.zones)
    stretching = Stretching(low, high, below, above, speed, wanted)
    parts = [_blocks(zone, zone_field(zone, material), stretching) for zone in model.zones]
    K, M, C = ([b for part in parts for b in part[kind]] for kind in range(3))
    # nodes where the layer ends, on those sides that have one
    at = np.concatenate([own < low - below + size, own > high + above - size], axis=1)
    edge = nodes[(at & (thick > 0)).any(axis=1)]
    held = blocked(table, edge, SOLID_KINEMATICS[Mode.PLANE_STRAIN].unknowns)
    return MatchedLayer(
        Matrix(table, tuple(K), (held,), "RIGIDITE"),
        Matrix(table, tuple(M), (), "MASSE"),
        Matrix(table, tuple(C), (), "AMORTISSEMENT"),
        cells,
    )


def suited_reflection(cells: float) -> float:
    """The reflection in theory for a layer of some cells: what the mesh sends back, or less.

    A stronger stretching makes waves fade faster and the mesh send more back. Measured for 4 to 16
    cells by `benchmarks/reflection.py`; the smaller one also serves waves that graze the edge.
    """
    return float(10.0 ** -min(3.0 + cells / 8, 6.0))


def _refuse_others(zone: Zone) -> None:
    if zone.mode is not Mode.PLANE_STRAIN:
        raise MeshError("kernel.waves.matched-layer-plane-strain")
    if family_name(zone) != "solid":
        raise MeshError("kernel.waves.matched-layer-elements", element=zone.element)
    if is_plastic(zone) or symmetry_of(zone) != "ISOTROPE":
        raise MaterialError(
            "kernel.waves.matched-layer-isotropic", behaviour=" ".join(zone.behaviour)
        )


def _blocks(
    zone: Zone, parameters: ZoneField, stretching: Stretching
) -> tuple[list[ElementMatrices], list[ElementMatrices], list[ElementMatrices]]:
    """Stiffness, mass and damping of a zone: displacements, histories, and what ties them."""
    inertia = _inertia(zone, parameters, stretching)
    histories = _Histories.of(zone, parameters, stretching)
    kinds = ("RIGIDITE", "MASSE", "AMORTISSEMENT")
    layout = node_major_layout(zone.cells, SOLID_KINEMATICS[zone.mode].unknowns)
    found: list[list[ElementMatrices]] = []
    for kind, of_nodes, of_histories in zip(kinds, inertia, histories.values(), strict=True):
        block = element_matrices(zone, layout, of_nodes, kind, keep_zone=False)
        found.append([block, histories.block(layout.raw_nodes, of_histories, kind)])
    return found[0], found[1], found[2]


def _products(beta: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """c, a, b of the equations: what stands with a motion, its second and its first rate."""
    b1, b2 = np.moveaxis(beta, -1, 0)
    return b1 * b2, np.ones_like(b1), b1 + b2


def _points_of(zone: Zone, support: Support) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Shapes, gradients (n_cells, n_points, 2, k), volumes, of all cells."""
    geometry = zone_geometry(zone, support, slice(0, len(zone.cells)))
    return geometry.shapes, geometry.gradients, geometry.volumes


def _inertia(zone: Zone, parameters: ZoneField, stretching: Stretching) -> list[FloatArray]:
    """rho c, rho a, rho b between displacements, each (n_cells, 2 k, 2 k)."""
    shapes, _, volumes = _points_of(zone, "MASSE")
    every = slice(0, len(zone.cells))
    beta = stretching.rates(np.einsum("pa,cad->cpd", shapes, zone.cells.coordinates[..., :2]))
    heavy = volumes * per_cell(parameters.at("RHO", "MASSE"), every)
    k = shapes.shape[1]
    found = []
    for share in _products(beta):
        scalar = np.einsum("cp,pa,pb->cab", heavy * share, shapes, shapes)
        values = np.zeros((len(zone.cells), 2 * k, 2 * k))
        values[:, 0::2, 0::2] = values[:, 1::2, 1::2] = scalar
        found.append(values)
    return found


@dataclass(frozen=True, eq=False)
class _Histories:
    """Unknown stress histories of a zone, at nodes of their own: one at each integration point."""

    zone: Zone
    nodes: IntArray  # (n_cells, p)
    compliances: FloatArray  # (n_cells, p, 3, 3) times volumes
    ties: tuple[FloatArray, FloatArray]  # (n_cells, 3 p, 2 k) `volume sym(grad u L)`, L_p then L_e
    factors: tuple[FloatArray, FloatArray, FloatArray]  # (n_cells, p) c, a, b

    @classmethod
    def of(cls, zone: Zone, parameters: ZoneField, stretching: Stretching) -> "_Histories":
        """Of a zone, with new nodes."""
        shapes, gradients, volumes = _points_of(zone, "RIGIDITE")
        xyz = np.einsum("pa,cad->cpd", shapes, zone.cells.coordinates)
        beta = stretching.rates(xyz[..., :2])
        moduli = solid_moduli(zone, parameters, "RIGIDITE")[..., IN_PLANE, :][..., IN_PLANE]
        if not moduli.any(axis=(-1, -2)).all():
            raise MaterialError("kernel.waves.layer-without-stiffness")
        compliances = np.linalg.inv(moduli) * volumes[..., None, None]
        nodes = zone.cells.nodes.add(xyz.reshape(-1, xyz.shape[-1])).reshape(volumes.shape)
        by_p = _tie(gradients, volumes, beta[..., ::-1])
        by_e = _tie(gradients, volumes, np.ones_like(beta))
        return cls(zone, nodes, compliances, (by_p, by_e), _products(beta))

    def values(self) -> list[FloatArray]:
        """Stiffness, mass, damping (n_cells, 2 k + 3 p, 2 k + 3 p)."""
        by_p, by_e = self.ties
        n, rows, columns = by_p.shape
        found = []
        for tie, factor in zip((by_p, None, by_e), self.factors, strict=True):
            values = np.zeros((n, columns + rows, columns + rows))
            for p in range(factor.shape[1]):
                at = slice(columns + 3 * p, columns + 3 * p + 3)
                values[:, at, at] = -factor[:, p, None, None] * self.compliances[:, p]
            if tie is not None:
                values[:, columns:, :columns] = tie
                values[:, :columns, columns:] = tie.transpose(0, 2, 1)
            found.append(values)
        return found

    def block(self, nodes: IntArray, values: FloatArray, kind: str) -> ElementMatrices:
        """Element matrices on the nodes of the cells, then on those of the histories."""
        k, p = nodes.shape[1], self.nodes.shape[1]
        unknowns = (*SOLID_KINEMATICS[self.zone.mode].unknowns * k, *HISTORIES * p)
        local = np.concatenate([np.repeat(np.arange(k), 2), np.repeat(np.arange(k, k + p), 3)])
        both = np.hstack([nodes, self.nodes])
        duals = tuple(dual_of(u) for u in unknowns)
        table = self.zone.cells.nodes
        return ElementMatrices(table, both, local, unknowns, duals, values, kind)


def _tie(gradients: FloatArray, volumes: FloatArray, factors: FloatArray) -> FloatArray:
    """`volume sym(grad u L)` as XX, YY, XY of each point, for L = diag(factors), (n, 3 p, 2 k)."""
    n, p, _, k = gradients.shape
    x, y = (gradients[:, :, i] * (factors[..., i] * volumes)[..., None] for i in range(2))
    found = np.zeros((n, p, 3, 2 * k))
    found[:, :, 0, 0::2], found[:, :, 1, 1::2] = x, y
    found[:, :, 2, 0::2], found[:, :, 2, 1::2] = y, x
    return found.reshape(n, 3 * p, 2 * k)
