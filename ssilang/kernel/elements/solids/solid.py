"""Continuous elements: plane, axisymmetric, Fourier, three-dimensional."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements import family
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.shapes.geometry import (
    CellGeometry,
    cell_geometry,
    cell_volumes,
    chunks,
)
from ssilang.kernel.elements.shapes.polygons import SIDES
from ssilang.kernel.elements.shapes.reference import shape_functions
from ssilang.kernel.elements.solids.kinematics import (
    SECTION_UNKNOWNS,
    SOLID_KINEMATICS,
    SolidKinematics,
    as_tensor,
    harmonic,
    section_point,
    term_factor,
)
from ssilang.kernel.elements.solids.solid_moduli import solid_moduli
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Mode, Zone

MANY_TERMS = 2_000_000
"""Terms of element matrices from which a compiled sum pays for loading the compiler."""
REVOLUTION = (Mode.AXISYMMETRIC, Mode.FOURIER)


def kinematics(zone: Zone) -> SolidKinematics:
    """Names and strain table of a zone's hypothesis."""
    return SOLID_KINEMATICS[zone.mode]


def coordinates(zone: Zone, cells: slice = slice(None)) -> FloatArray:
    """Node coordinates (n_cells, n_nodes, dim), as many as the hypothesis uses."""
    table = zone.cells.nodes.coordinates
    return table[zone.cells.connectivity[cells]][..., : kinematics(zone).dimension]


def zone_geometry(zone: Zone, support: Support, cells: slice) -> CellGeometry:
    """Geometry of some cells at the points of a support."""
    rule = support_rule(zone.element, support)
    return cell_geometry(zone.cells.cell_type, coordinates(zone, cells), rule)


def radius(zone: Zone, shapes: FloatArray, cells: slice) -> FloatArray:
    """Distance to the axis (n_cells, n_points).

    Raises
    ------
    MeshError
        If a cell lies on the wrong side of the axis.
    """
    r = coordinates(zone, cells)[..., 0] @ shapes.T
    if (r <= 0).any():
        raise MeshError("kernel.elements.cell-axisymmetric-model-reaches")
    return r


def circumference(zone: Zone) -> float:
    """Angle that the hypothesis integrates over: 2 pi, or pi for a Fourier harmonic > 0."""
    return np.pi if harmonic(zone) else 2 * np.pi


def integration_weights(
    zone: Zone, geometry: CellGeometry, parameters: ZoneField, support: Support, cells: slice
) -> FloatArray:
    """Volumes times thickness (plane stress, DIM3) or times the circumference."""
    return _thickened(zone, geometry.volumes, geometry.shapes, parameters, support, cells)


def _thickened(
    zone: Zone,
    volumes: FloatArray,
    shapes: FloatArray,
    parameters: ZoneField,
    support: Support,
    cells: slice,
) -> FloatArray:
    if zone.mode in REVOLUTION:
        return volumes * circumference(zone) * radius(zone, shapes, cells)
    if zone.mode is Mode.PLANE_STRESS and "DIM3" in parameters:
        return volumes * family.per_cell(parameters.at("DIM3", support), cells)
    return volumes


def with_section(zone: Zone, own: family.Layout) -> family.Layout:
    """A layout; in generalised plane strain the rows of the section's node come last."""
    if zone.mode is not Mode.GENERALISED_PLANE_STRAIN:
        return own
    n, k = own.raw_nodes.shape
    section = np.full((n, 1), section_point(zone).number, dtype=np.int64)
    nodes: IntArray = np.hstack([own.raw_nodes, section])
    local = np.concatenate([own.local, [k, k, k]])
    return family.Layout(own.table, nodes, local, (*own.unknowns, *SECTION_UNKNOWNS))


def section_strain(zone: Zone, x: FloatArray, y: FloatArray) -> FloatArray:
    """EPZZ = UZ + (y - y0) RX - (x - x0) RY at places, the section's node being at (x0, y0)."""
    origin = section_point(zone).coordinates
    return np.stack([np.ones_like(x), y - origin[1], origin[0] - x], axis=-1)


class Solid(family.ElementFamily):
    """Displacement elements, integrated numerically."""

    def layout(self, zone: Zone) -> family.Layout:
        """Node by node; in generalised plane strain the section's node comes last."""
        return with_section(zone, family.node_major_layout(zone.cells, kinematics(zone).unknowns))

    def strain_names(self, zone: Zone) -> tuple[str, ...]:
        """EPXX ... or EPRR ..."""
        return kinematics(zone).strains

    def stress_names(self, zone: Zone) -> tuple[str, ...]:
        """SMXX ... or SMRR ..."""
        return kinematics(zone).stresses

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Isotropic or orthotropic elasticity."""
        return solid_moduli(zone, parameters, support)

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Symmetric gradient in the hypothesis' components."""
        geometry = zone_geometry(zone, support, cells)
        matrix = strain_matrix(zone, geometry, cells)
        weights = integration_weights(zone, geometry, parameters, support, cells)
        return family.StrainOperator(matrix, weights)

    def weights(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Integration weights (n_cells, n_points) of a support (INTG)."""
        if type(self) is not Solid:
            return super().weights(zone, parameters, support)
        rule = support_rule(zone.element, support)
        every = slice(0, len(zone.cells))
        volumes = cell_volumes(zone.cells.cell_type, coordinates(zone, every), rule)
        shapes = shape_functions(zone.cells.cell_type, rule.points)
        return _thickened(zone, volumes, shapes, parameters, support, every)

    def stiffness_values(self, zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray:
        """Stiffness matrices (n_cells, n_rows, n_rows)."""
        found = uniform_stiffness(zone, moduli, parameters) if type(self) is Solid else None
        return super().stiffness_values(zone, moduli, parameters) if found is None else found

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """Integral of RHO N N^T, the same for each unknown of a node."""
        names, density = kinematics(zone).unknowns, parameters.at("RHO", "MASSE")
        nu, k = len(names), zone.cells.kind.n_nodes
        values = np.zeros((len(zone.cells), k * nu, k * nu))
        for cells in chunks(len(zone.cells)):
            geometry = zone_geometry(zone, "MASSE", cells)
            w = integration_weights(zone, geometry, parameters, "MASSE", cells)
            w = w * family.per_cell(density, cells)
            products = np.einsum("pi,pj->pij", geometry.shapes, geometry.shapes)
            scalar = (w @ products.reshape(len(products), k * k)).reshape(-1, k, k)
            values[cells] = family.spread(scalar, nu)
        return values, family.node_major_layout(zone.cells, names)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Integral of grad(N)^T sigma grad(N); hoop stress acts through `hoop_weights`."""
        nu, k = len(kinematics(zone).unknowns), zone.cells.kind.n_nodes
        m = len(self.layout(zone).unknowns)
        values = np.zeros((len(zone.cells), m, m))
        for cells in chunks(len(zone.cells)):
            geometry = zone_geometry(zone, "STRESSES", cells)
            w = integration_weights(zone, geometry, parameters, "STRESSES", cells)
            scalar, hoop = geometric_scalar(zone, geometry, stress[cells], w, cells)
            factors = hoop_weights(zone, nu)
            for i in range(nu):
                for j in np.flatnonzero(factors[i] + np.eye(nu)[i]):
                    block = factors[i, j] * hoop + (scalar if i == j else 0.0)
                    values[cells, i : k * nu : nu, j : k * nu : nu] = block
        return values


def hoop_weights(zone: Zone, n_unknowns: int) -> FloatArray:
    """How pairs of unknowns of a node enter the work of the hoop stress, (nu, nu).

    It works on ((u_r,t - u_t)^2 + (u_t,t + u_r)^2 + u_z,t^2) / r^2, `,t` being the derivative along
    the angle; with u_r, u_z as cos(n t) and u_t as sin(n t), the mean over the turn makes it
    (n^2 + 1) (u_r^2 + u_t^2) + 4 n u_r u_t + n^2 u_z^2, over r^2.
    """
    factors = np.zeros((n_unknowns, n_unknowns))
    factors[0, 0] = 1.0
    if zone.mode is Mode.FOURIER:
        n = harmonic(zone)
        factors[0, 0] = factors[2, 2] = n * n + 1.0
        factors[1, 1] = n * n
        factors[0, 2] = factors[2, 0] = 2.0 * n
    return factors


def geometric_scalar(
    zone: Zone, geometry: CellGeometry, stress: FloatArray, weights: FloatArray, cells: slice
) -> tuple[FloatArray, FloatArray]:
    """Geometric stiffness (n_cells, n_nodes, n_nodes) of one unknown, and the hoop stress' part."""
    d = geometry.gradients.shape[2]
    G, tensor = geometry.gradients, as_tensor(stress, strains=False)[..., :d, :d]
    flux = np.einsum("cpij,cpjn->cpin", tensor, G) * weights[..., None, None]
    scalar = np.einsum("cpim,cpin->cmn", G, flux)
    if zone.mode not in REVOLUTION:
        return scalar, np.zeros_like(scalar)
    over = weights * stress[:, 2] / radius(zone, geometry.shapes, cells) ** 2
    return scalar, np.einsum("cp,pm,pn->cmn", over, geometry.shapes, geometry.shapes)


def strain_matrix(zone: Zone, geometry: CellGeometry, cells: slice) -> FloatArray:
    """Strain operator (n_cells, n_strains, n_points, n_rows) of a hypothesis."""
    table = kinematics(zone)
    nu = len(table.unknowns)
    n, p, _, k = geometry.gradients.shape
    extra = 3 if zone.mode is Mode.GENERALISED_PLANE_STRAIN else 0
    matrix = np.zeros((n, len(table.strains), p, k * nu + extra))
    over_radius: FloatArray | None = None
    if zone.mode in REVOLUTION:
        over_radius = geometry.shapes[None] / radius(zone, geometry.shapes, cells)[..., None]
    for row, unknown, axis, word in table.terms:
        factor = term_factor(word, harmonic(zone))
        source = over_radius if isinstance(axis, str) else geometry.gradients[:, :, axis]
        if factor and source is not None:
            matrix[:, row, :, unknown : k * nu : nu] += factor * source
    if extra:
        x, y = np.moveaxis(coordinates(zone, cells), 2, 0) @ geometry.shapes.T
        matrix[:, 2, :, k * nu :] = section_strain(zone, x, y)
    return matrix


def uniform_stiffness(zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray | None:
    """Stiffness matrices of many cells whose moduli are the same at all points of a cell.

    None for few cells, for other cells and hypotheses, and for folded cells.
    """
    table, cells = kinematics(zone), zone.cells
    size = len(cells) * (cells.kind.n_nodes * len(table.unknowns)) ** 2
    if size < MANY_TERMS or moduli.shape[1] > 1 or cells.cell_type in SIDES:
        return None
    if zone.mode in REVOLUTION or zone.mode is Mode.GENERALISED_PLANE_STRAIN:
        return None
    if zone.mode is Mode.PLANE_STRESS and "DIM3" in parameters:
        thickness = parameters.at("DIM3", "RIGIDITE")
        if thickness.shape[1] > 1:
            return None
        moduli = moduli * thickness[..., None, None]
    from ssilang.kernel.elements.solids.solid_products import gradient_moduli, stiffness_of

    return stiffness_of(
        cells.cell_type, support_rule(zone.element, "RIGIDITE"), cells.nodes.coordinates,
        cells.connectivity, gradient_moduli(table, moduli),
    )  # fmt: skip


class Incompressible(Solid):
    """The same with the volumetric strain averaged over the cell (B-bar, Hughes 1980).

    Keeps nearly incompressible media from locking.
    """

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Deviatoric part of the usual operator plus the mean volumetric part."""
        usual = super().strain_operator(zone, parameters, support, cells)
        trace = usual.matrix[:, :3].sum(axis=1)
        at_points = super().strain_operator(zone, parameters, "RIGIDITE", cells)
        w = at_points.weights / at_points.weights.sum(axis=1, keepdims=True)
        mean = np.einsum("cspm,cp->cm", at_points.matrix[:, :3], w)
        matrix = usual.matrix.copy()
        matrix[:, :3] += ((mean[:, None] - trace) / 3)[:, None]
        return family.StrainOperator(matrix, usual.weights)


HOURGLASS = 0.05
"""Share of the usual stiffness that hourglass motions keep."""
_PATTERN = np.array([1.0, -1.0, 1.0, -1.0])


class OnePoint(Solid):
    """Quadrangle with one integration point."""

    def stiffness_values(self, zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray:
        """The usual stiffness and a small one against hourglass motions."""
        values = super().stiffness_values(zone, moduli, parameters)
        nu = len(kinematics(zone).unknowns)
        for cells in chunks(len(zone.cells)):
            gradients = zone_geometry(zone, "RIGIDITE", cells).gradients[:, 0]
            weights = self.strain_operator(zone, parameters, "RIGIDITE", cells).weights[:, 0]
            linear = np.einsum("b,cbi->ci", _PATTERN, coordinates(zone, cells))
            left = _PATTERN - np.einsum("ci,cia->ca", linear, gradients)
            modulus = family.per_cell(moduli, cells)[:, 0, 0, 0]
            size = np.einsum("cia,cia->c", gradients, gradients)
            held = (HOURGLASS * modulus * weights * size)[:, None, None]
            stiffness = held * left[:, :, None] * left[:, None, :] / 4
            for i in range(nu):
                values[cells, i : 4 * nu : nu, i : 4 * nu : nu] += stiffness
        return values
