"""Nodal forces of pressures, tractions, body forces, and of what is spread along beams and bars."""

from collections.abc import Iterable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.elements import boundary, catalog
from ssilang.kernel.elements.beams.beam_frame import beam_frame
from ssilang.kernel.elements.beams.pipe import pressure_forces
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import node_major_layout
from ssilang.kernel.elements.results.supports import nodal_of_cells
from ssilang.kernel.elements.shapes.geometry import SurfaceGeometry, chunks
from ssilang.kernel.elements.shells.meridian_shell import meridian_forces
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS, harmonic
from ssilang.kernel.elements.solids.solid import integration_weights, zone_geometry
from ssilang.kernel.elements.zone_fields import cell_rows, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import dual_of
from ssilang.kernel.mesh.boundary import contour, envelope
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable

# forces (v1 m1 v2 m2) of a linear density q1, q2 on the cubic deflection, times L and L^2
_CUBIC = np.array([[7 / 20, 3 / 20], [1 / 20, 1 / 30], [3 / 20, 7 / 20], [-1 / 30, -1 / 20]])
# forces of a moment density m1, m2 on the slope of the cubic deflection
_CUBIC_MOMENT = np.array([[-1 / 2, -1 / 2], [1 / 12, -1 / 12], [1 / 2, 1 / 2], [-1 / 12, 1 / 12]])
_LINEAR = np.array([[1 / 3, 1 / 6], [1 / 6, 1 / 3]])


def line_load(
    model: Model, value: FloatArray | NodeField, plane_normal: FloatArray | None = None
) -> NodeField:
    """Forces of a density along lines, linear between the nodes of each.

    Parameters
    ----------
    value : array (3,) or NodeField
        Force per length (FX FY FZ, with moments per length MX MY MZ in a field).
    plane_normal : array (3,), optional
        The density counts per length projected on the plane normal to this vector.

    Raises
    ------
    MeshError
        If the model holds other elements than beams and bars.
    """
    return total(model.mesh.nodes, [_on_zone(z, value, plane_normal) for z in model.zones])


def _densities(zone: Zone, names: tuple[str, ...], value: FloatArray | NodeField) -> FloatArray:
    """Values (n_cells, 2, 3) at both ends, zero where absent."""
    nodes = zone.cells.connectivity[:, [0, -1]]
    out = np.zeros((*nodes.shape, 3))
    for i, name in enumerate(names):
        axis = "XYZ".index(name[1]) if name[1] in "XYZ" else i
        if isinstance(value, NodeField):
            out[..., axis] = value.values_at(name, nodes)
        elif name[0] == "F":
            out[..., axis] = value[axis]
    return out


def _on_zone(
    zone: Zone, value: FloatArray | NodeField, plane_normal: FloatArray | None
) -> NodeField:
    family = catalog.family_name(zone)
    if family not in catalog.LINES or zone.cells.kind.n_nodes != 2:
        raise MeshError("kernel.elements.load-along-lines-beams", element=zone.element)
    frame = beam_frame(zone, zone_field(zone, None))
    translations = NODE_TRANSLATIONS[zone.mode]
    rotations = NODE_ROTATIONS[zone.mode] if family != "bar" else ()
    forces = _densities(zone, tuple(dual_of(u) for u in translations), value)
    moments = _densities(zone, tuple(dual_of(u) for u in rotations), value)
    if plane_normal is not None:
        unit = plane_normal / np.linalg.norm(plane_normal)
        ratio = np.linalg.norm(np.cross(frame.axes[:, 0], unit), axis=1)[:, None, None]
        forces, moments = forces * ratio, moments * ratio
    local = np.stack(
        [np.einsum("cij,caj->cai", frame.axes, v) for v in (forces, moments)], axis=2
    )  # (n, end, force or moment, axis)
    out = _equivalent(local, frame.lengths, family in catalog.CUBIC_BEAMS)
    turned = np.einsum("cij,cnti->cntj", frame.axes, out)
    columns = [(0, "XYZ".index(u[1])) for u in translations]
    columns += [(1, "XYZ".index(u[1])) for u in rotations]
    vectors = np.stack([turned[:, :, t, axis] for t, axis in columns], axis=2)
    layout = node_major_layout(zone.cells, translations + rotations)
    return layout.scatter(vectors.reshape(len(vectors), -1))


def _equivalent(local: FloatArray, lengths: FloatArray, cubic: bool) -> FloatArray:
    """Forces and moments (n, 2, 2, 3) at the ends from their densities, in local axes."""
    L = lengths[:, None, None, None]
    out: FloatArray = np.einsum("ab,cbti->cati", _LINEAR, local) * L
    if not cubic:
        return out
    of_forces = lengths[:, None] ** np.array([1, 2, 1, 2])
    of_moments = lengths[:, None] ** np.array([0, 1, 0, 1])
    # bending planes: deflection y with moment z, deflection z with moment -y
    for axis, turning, sign in ((1, 2, 1.0), (2, 1, -1.0)):
        q, m = local[:, :, 0, axis], local[:, :, 1, turning] * sign
        ends = q @ _CUBIC.T * of_forces + m @ _CUBIC_MOMENT.T * of_moments
        out[:, :, 0, axis] = ends[:, 0::2]
        out[:, :, 1, turning] = sign * ends[:, 1::2]
    return out


def total(table: NodeTable, fields: Iterable[NodeField]) -> NodeField:
    """Sum of force fields (DISCRET)."""
    parts: dict[str, list[tuple[IntArray, FloatArray]]] = {}
    for field in fields:
        for name, part in field.components.items():
            parts.setdefault(name, []).append((part.nodes, part.values))
    both = {n: map(np.concatenate, zip(*p, strict=True)) for n, p in parts.items()}
    return NodeField(table, {n: NodeValues.summed(*b) for n, b in both.items()}, "DISCRET")


def pressure(model: Model, faces: Mesh, value: float | NodeField | CellField) -> NodeField:
    """Forces of a pressure on sides of continuous elements, pushing into them.

    Parameters
    ----------
    value : number, field at nodes with one component, or field in cells over the faces
        Absent values count as zero.
    """
    out = []
    for zone, part, geometry, mine in boundary.sides_of_zones(faces, model):
        vectors = boundary.outward(part, geometry, model, mine)
        p = _face_values(part, geometry, value)
        forces = -np.einsum("cp,cpd,pk->ckd", p, vectors, geometry.shapes)
        out.append(_scatter(zone, part, forces))
    return total(faces.nodes, out)


def _face_values(
    part: CellBlock, geometry: SurfaceGeometry, value: float | NodeField | CellField
) -> FloatArray:
    """Values (n, points) of a scalar on faces."""
    shape = (len(part), len(geometry.shapes))
    if isinstance(value, NodeField):
        name = _only(tuple(value.components))
        return value.values_at(name, part.connectivity) @ geometry.shapes.T
    if isinstance(value, CellField):
        out = np.zeros(shape)
        for block in value.blocks:
            rows = cell_rows(block.cells, part)
            found = rows >= 0
            if not found.any():
                continue
            values = np.asarray(block.components[_only(tuple(block.components))], dtype=float)
            values = np.broadcast_to(values, (len(block.cells), values.shape[1]))[rows[found]]
            table = block.cells.connectivity[rows[found]]
            at_points = block.support not in ("NOEUD", "GRAVITE") and values.shape[1] == shape[1]
            if at_points and (table == part.connectivity[found]).all():
                out[found] = values
            else:
                out[found] = _to_face_points(part, table, values, found, geometry)
        return out
    return np.full(shape, float(value))


def _only(names: tuple[str, ...]) -> str:
    if len(names) != 1:
        raise FieldError("kernel.elements.pressure-component-field", names=names)
    return names[0]


def _to_face_points(
    part: CellBlock,
    table: IntArray,
    values: FloatArray,
    found: np.ndarray,
    geometry: SurfaceGeometry,
) -> FloatArray:
    """Values given at the nodes (n, k) of other cells, the same nodes perhaps in another order."""
    k = part.kind.n_nodes
    if values.shape[1] == 1:
        return np.broadcast_to(values, (len(values), len(geometry.shapes)))
    if values.shape[1] != k:
        raise FieldError("kernel.elements.pressure-cells-stands-nodes", n_values=values.shape[1])
    theirs = np.argsort(table, axis=1)
    mine = np.argsort(np.argsort(part.connectivity[found], axis=1), axis=1)
    sorted_values = np.take_along_axis(values, theirs, axis=1)
    return np.take_along_axis(sorted_values, mine, axis=1) @ geometry.shapes.T


def traction(
    model: Model,
    faces: Mesh,
    value: FloatArray | NodeField,
    material: CellField | None = None,
) -> NodeField:
    """Forces of a surface traction on sides of continuous elements.

    Parameters
    ----------
    value : array (3,) or NodeField
        Force per area; a field has components FX FY ... (or UX UY ...).
    material : CellField, optional
        Gives the thickness DIM3 in plane stress.
    """
    out = []
    for zone, part, geometry, mine in boundary.sides_of_zones(faces, model):
        w = geometry.measures * _thickness(zone, mine.cell, material)
        vectors = _vector_values(part, geometry, zone, value)
        forces = np.einsum("cp,cpd,pk->ckd", w, vectors, geometry.shapes)
        out.append(_scatter(zone, part, forces))
    return total(faces.nodes, out)


def _thickness(zone: Zone, cells: IntArray, material: CellField | None) -> FloatArray:
    if zone.mode is not Mode.PLANE_STRESS or material is None:
        return np.ones((1, 1))
    return zone_field(zone, material).each("DIM3", 1.0)[cells, None]


def force_names(zone: Zone) -> tuple[str, ...]:
    """Names of the forces at a node of a zone: FX FY ..., FR FZ in axisymmetry."""
    return tuple("F" + u[1:] for u in NODE_TRANSLATIONS[zone.mode])


def _vector_values(
    part: CellBlock, geometry: SurfaceGeometry, zone: Zone, value: FloatArray | NodeField
) -> FloatArray:
    """Vectors (n, points, d)."""
    names = force_names(zone)
    shape = (len(part), len(geometry.shapes), len(names))
    if not isinstance(value, NodeField):
        return np.broadcast_to(value[: len(names)], shape)
    columns = []
    for name, unknown in zip(names, NODE_TRANSLATIONS[zone.mode], strict=True):
        given = name if name in value.components else unknown
        columns.append(value.values_at(given, part.connectivity) @ geometry.shapes.T)
    return np.stack(columns, axis=-1)


def _scatter(zone: Zone, part: CellBlock, forces: FloatArray) -> NodeField:
    """Sum element vectors (n, k, d) at nodes."""
    layout = node_major_layout(part, NODE_TRANSLATIONS[zone.mode][: forces.shape[2]])
    return layout.scatter(forces.reshape(len(forces), -1))


def loaded_faces(model: Model, field: NodeField | CellField) -> Mesh:
    """Outer sides of a model whose nodes all have a value, or the cells of a field in cells."""
    table = model.mesh.nodes
    if isinstance(field, CellField):
        return Mesh(table, tuple({id(b.cells): b.cells for b in field.blocks}.values()))
    solid = Mesh(table, tuple(z.cells for z in model.zones if boundary.is_solid(z)))
    skin = envelope(solid) if solid.dimension == 3 else contour(solid)
    blocks = []
    for block in skin.blocks:
        inside = np.isin(block.connectivity, field.node_ids).all(axis=1)
        if inside.any():
            blocks.append(CellBlock.make(table, block.cell_type, block.raw[inside]))
    if not blocks:
        raise MeshError("kernel.elements.field-values-no-outer")
    return Mesh(table, tuple(blocks))


def pipe_pressure(model: Model, material: CellField) -> NodeField:
    """Forces of the inner pressure PRES of pipes on their closed ends."""
    out = []
    for zone in model.zones:
        if catalog.family_name(zone) != "pipe":
            raise MeshError("kernel.elements.pressure-pipes-not-element", element=zone.element)
        layout = family_of(zone).layout(zone)
        out.append(layout.scatter(pressure_forces(zone, zone_field(zone, material))))
    return total(model.mesh.nodes, out)


def shell_load(
    model: Model,
    value: float | FloatArray | NodeField | CellField,
    along: FloatArray | None = None,
    towards: FloatArray | None = None,
    material: CellField | None = None,
) -> NodeField:
    """Forces on shells: a pressure or a force per area (on COQ2 with moments).

    Parameters
    ----------
    value : number or field with one component (pressure), array (3,) or field FX FY FZ (force)
    along : array (3,), optional
        The side to which a pressure pushes; the shells' own normals without.
    towards : array (3,), optional
        A point on the side to which a pressure pushes [m].
    material : CellField, optional
        Gives the width DIM3 of COQ2 in plane stress.

    Raises
    ------
    MeshError
        On other elements; if a cell lies along the vector, or in line with the point.
    """
    out = []
    for zone in model.zones:
        if catalog.family_name(zone) not in catalog.SHELLS:
            raise MeshError("kernel.elements.load-shells-not-element", element=zone.element)
        aim = along
        if towards is not None:
            corners = zone.cells.coordinates
            aim = towards[: corners.shape[-1]] - corners.mean(axis=1)
        out.append(_on_shell(zone, value, aim, material))
    return total(model.mesh.nodes, out)


def _on_shell(
    zone: Zone,
    value: float | FloatArray | NodeField | CellField,
    along: FloatArray | None,
    material: CellField | None,
) -> NodeField:
    """Forces of one zone, whose area vectors are those of its faces."""
    meridian = catalog.family_name(zone) == "meridian"
    rule = catalog.support_rule(zone.element, "MASSE") if meridian else None
    geometry = boundary.face_geometry(zone.cells, zone.mode, harmonic(zone), rule)
    if isinstance(value, np.ndarray) or (
        isinstance(value, NodeField) and any(n in value.components for n in force_names(zone))
    ):
        density = _vector_values(zone.cells, geometry, zone, value)
        pushed = density * geometry.measures[..., None]
    else:
        normals = geometry.normals
        if normals.shape[-1] == 2:  # a quarter turn from the line, not the other way
            normals = -normals
        if along is not None:
            normals = normals * _side(normals, along)[:, None, None]
        pushed = normals * _face_values(zone.cells, geometry, value)[..., None]
    if meridian:
        return meridian_forces(zone, pushed, zone_field(zone, material))
    return _scatter(zone, zone.cells, np.einsum("cpd,pk->ckd", pushed, geometry.shapes))


_LEAST_ANGLE = float(np.sin(np.radians(1.0)))
"""Of a vector with a face, below which it shows no side."""


def _side(normals: FloatArray, along: FloatArray) -> FloatArray:
    """1 where vectors (3,) or (n_cells, 3) are on the side of normals, else -1, (n_cells,)."""
    vectors, faces = np.atleast_2d(along)[:, : normals.shape[-1]], normals.sum(axis=1)
    share = (faces * vectors).sum(axis=-1)
    lengths = np.linalg.norm(vectors, axis=-1) * np.linalg.norm(faces, axis=-1)
    along_face = np.abs(share) <= _LEAST_ANGLE * lengths
    if along_face.any():
        raise MeshError("kernel.elements.pressure-along-face", count=int(along_face.sum()))
    return np.sign(share)


def on_sides(model: Model, field: CellField) -> NodeField | CellField:
    """A pressure in cells as it serves sides: as it is when it stands on sides, else its nodes.

    A field in the cells of the model itself loads the sides where it is not zero.
    """
    inside = {z.cells.kind.dimension for z in model.zones}
    if not any(b.cells.kind.dimension in inside for b in field.blocks):
        return field
    nodal = nodal_of_cells(model, field)
    kept = {}
    for name, part in nodal.components.items():
        loaded = part.values != 0
        kept[name] = NodeValues(part.nodes[loaded], part.values[loaded])
    return NodeField(nodal.table, kept, "DIFFUS")


def pressure_vectors(zone: Zone, field: CellField, material: CellField | None = None) -> NodeField:
    """Forces of the pressure field on a zone of pressure loads, along the sides' own normals."""
    return _on_shell(zone, field, None, material)


def body_force(
    model: Model, density: NodeField | CellField, material: CellField | None = None
) -> NodeField:
    """Forces of a volume density with components FX FY ... (CNEQ).

    Raises
    ------
    MeshError
        If the model holds elements that are neither continuous nor plates (DKT, DST, COQ3, COQ4).
    """
    wanted = {n for zone in model.zones for n in force_names(zone)}
    blocks = [density] if isinstance(density, NodeField) else density.blocks
    given = [n for block in blocks for n in block.components]
    if not wanted.intersection(given):
        told = {"wanted": sorted(wanted), "given": tuple(dict.fromkeys(given))}
        raise FieldError("kernel.elements.volume-force-components-field", **told)
    out = [_body_force(zone, density, material) for zone in model.zones]
    return total(model.mesh.nodes, out)


def _body_force(
    zone: Zone, density: NodeField | CellField, material: CellField | None
) -> NodeField:
    names = force_names(zone)
    forces = np.zeros((len(zone.cells), zone.cells.kind.n_nodes, len(names)))
    parameters = zone_field(zone, material)
    if catalog.family_name(zone) in catalog.FLAT_SHELLS:
        shapes = catalog.support_shapes(zone.element, "MASSE")
        h = parameters.each("EPAI")[:, None]
        w = family_of(zone).weights(zone, parameters, "MASSE") * h
        values = _density_values(zone, density, names, shapes, slice(0, len(zone.cells)))
        return _scatter(zone, zone.cells, np.einsum("cp,cpd,pk->ckd", w, values, shapes))
    if not boundary.is_solid(zone):
        raise MeshError("kernel.elements.volume-forces-continuous-elements", element=zone.element)
    for cells in chunks(len(zone.cells)):
        geometry = zone_geometry(zone, "MASSE", cells)
        w = integration_weights(zone, geometry, parameters, "MASSE", cells)
        values = _density_values(zone, density, names, geometry.shapes, cells)
        forces[cells] = np.einsum("cp,cpd,pk->ckd", w, values, geometry.shapes)
    return _scatter(zone, zone.cells, forces)


def _density_values(
    zone: Zone,
    density: NodeField | CellField,
    names: tuple[str, ...],
    shapes: FloatArray,
    cells: slice,
) -> FloatArray:
    """Volume forces (n, points, d) at the points of 'MASSE'."""
    if isinstance(density, NodeField):
        nodes = zone.cells.connectivity[cells]
        columns = [density.values_at(n, nodes) @ shapes.T for n in names]
        return np.stack(columns, axis=-1)
    seen = zone_field(zone, density)
    if not any(n in seen for n in names):
        return np.zeros((cells.stop - cells.start, len(shapes), len(names)))
    return np.moveaxis(seen.matrix(names, "MASSE")[cells], 1, 2)
