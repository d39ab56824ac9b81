"""Fields in cells interpolated on other meshes and models."""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.results.frames import points_of
from ssilang.kernel.elements.shapes import reference
from ssilang.kernel.elements.shapes.quadrature import Rule, quadrature
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Mode, Model
from ssilang.kernel.matrices.location import locate
from ssilang.kernel.mesh.mesh import Mesh

Lost = list[FloatArray]
"""Where a field was asked for and has no value."""


def _interpolated(
    field: CellField, x: FloatArray, tolerance: float, lost: Lost
) -> dict[str, tuple[BoolArray, FloatArray]]:
    """For each component which points (n,) lie inside the field's cells, and its values (n,).

    Values are zero elsewhere; points (n, 3) that no component has are added to `lost`.
    """
    out: dict[str, tuple[BoolArray, FloatArray]] = {}
    for block in field.blocks:
        cells, shapes = locate(Mesh(block.cells.nodes, (block.cells,)), x, tolerance)[0]
        for name, values in block.components.items():
            if values.shape[1] not in (1, block.cells.kind.n_nodes):
                raise FieldError("kernel.elements.field-project-must-stand")
            inside, found = out.get(name, (np.zeros(len(x), bool), np.zeros(len(x))))
            found = found.astype(np.result_type(found, values))
            rows = np.flatnonzero((cells >= 0) & ~inside)
            full = np.broadcast_to(values, (len(block.cells), values.shape[1]))[cells[rows]]
            one = values.shape[1] == 1
            found[rows] = full[:, 0] if one else np.einsum("nk,nk->n", full, shapes[rows])
            inside[rows] = True
            out[name] = inside, found
    if out:
        lost.append(x[~np.logical_or.reduce([inside for inside, _ in out.values()])])
    return out


def on_mesh(field: CellField, mesh: Mesh, tolerance: float, lost: Lost) -> NodeField:
    """Values of a field, given at nodes of its cells, at the nodes of a mesh inside them."""
    nodes = mesh.sorted_node_ids
    found = _interpolated(field, mesh.nodes.coordinates[nodes], tolerance, lost)
    parts = {name: NodeValues(nodes[at], values[at]) for name, (at, values) in found.items()}
    return NodeField(mesh.nodes, parts, "DIFFUS")


def on_model(
    field: CellField, model: Model, support: Support, tolerance: float, lost: Lost
) -> CellField:
    """Values of a field at the points of a support of a model, zero outside the field's cells."""
    blocks = []
    for zone in model.zones:
        x = points_of(zone, support)
        found = _interpolated(field, x.reshape(-1, 3), tolerance, lost)
        components = {
            name: values.astype(float).reshape(x.shape[:2]) for name, (_, values) in found.items()
        }
        if components:
            blocks.append(zone.block(components, support))
    return CellField(tuple(blocks), field.title)


_SIMPLEX_POINTS = {"triangle": (1, 3, 7), "tetrahedron": (1, 4, 27), "prism": (1, 6, 21)}


def _points_per_direction(shape: str, n: int) -> Rule:
    """The rule with n points in each direction, or the one nearest to it that exists."""
    if shape in _SIMPLEX_POINTS:
        return quadrature(shape, _SIMPLEX_POINTS[shape][min(n, 3) - 1])
    power = {"line": 1, "quadrangle": 2}.get(shape, 3)
    return quadrature(shape, n**power)


def by_least_squares(
    field: CellField, model: Model, n: int, tolerance: float, lost: Lost
) -> CellField:
    """Nodal values in each cell of a model whose integrated squared distance to a field is least.

    Parameters
    ----------
    field : CellField
        At the nodes of its cells; zero outside them.
    n : int
        Integration points in each direction of a cell; at least one for each node is needed.

    Raises
    ------
    FieldError
        For points and joints, or too few points.
    """
    blocks = []
    for zone in model.zones:
        kind = zone.cells.kind
        if kind.joint or not kind.dimension:
            raise FieldError("kernel.elements.element-not-fill-space", element=zone.element)
        rule = _points_per_direction(reference.REFERENCE_CELLS[kind.name].shape, n)
        if len(rule) < kind.n_nodes:
            told = {"n_rule": len(rule), "n_nodes": kind.n_nodes, "name": kind.name}
            raise FieldError("kernel.elements.integration-points-not-fix", **told)
        at = zone.cells.coordinates
        shapes = reference.shape_functions(kind.name, rule.points)
        along = np.einsum("pka,ckd->cpad", reference.shape_gradients(kind.name, rule.points), at)
        # area of a shell's cell as well as volume of a body's
        weights = np.sqrt(np.linalg.det(along @ np.swapaxes(along, 2, 3))) * rule.weights
        x = np.einsum("pk,ckd->cpd", shapes, at)
        if zone.mode in (Mode.AXISYMMETRIC, Mode.FOURIER):
            weights = weights * x[..., 0]
        weighted = weights[:, :, None] * shapes
        squares = np.einsum("cpk,pl->ckl", weighted, shapes)
        components = {}
        for name, (_, values) in _interpolated(field, x.reshape(-1, 3), tolerance, lost).items():
            right = np.einsum("cpk,cp->ck", weighted, values.astype(float).reshape(x.shape[:2]))
            components[name] = np.linalg.solve(squares, right[..., None])[..., 0]
        if components:
            blocks.append(zone.block(components, "NOEUD"))
    return CellField(tuple(blocks), field.title)
