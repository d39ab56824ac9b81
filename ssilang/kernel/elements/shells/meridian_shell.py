"""COQ2: thin shell whose meridian is a line in the plane (plane, axisymmetric, Fourier).

The own frame has s along the line from node 1 to node 2 and z along its normal, a quarter turn
further. Lengthening is linear, deflection cubic (Kirchhoff).
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError, MeshError
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.family import Layout, StrainOperator, TurningFamily
from ssilang.kernel.elements.shells.shell_section import offset, section_moduli
from ssilang.kernel.elements.solids import solid
from ssilang.kernel.elements.solids.kinematics import harmonic
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Zone


def _kept(zone: Zone) -> tuple[int, ...]:
    return tuple(range(6)) if zone.mode is Mode.FOURIER else (0, 1, 3, 4)


class _Meridian:
    """Interpolation of u (along), w (normal), v (circumference) and slopes at points.

    Each is an operator (n, p, rows) on the element's unknowns, in global components.
    """

    def __init__(self, zone: Zone, support: Support, cells: slice = slice(None)) -> None:
        rule = support_rule(zone.element, support)
        x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]][..., :2]
        side = x[:, 1] - x[:, 0]
        self.length = np.linalg.norm(side, axis=1)
        if (self.length <= 0).any():
            raise MeshError("kernel.elements.shell-cell-zero-length")
        self.t = side / self.length[:, None]
        self.n = np.stack([-self.t[:, 1], self.t[:, 0]], axis=1)
        self.xi = (1 + rule.points[:, 0]) / 2
        self.weights = self.length[:, None] * rule.weights / 2
        self.r, self.y = (x[:, :1, k] + self.xi * side[:, k : k + 1] for k in (0, 1))
        self.rows = 4 if zone.mode is Mode.FOURIER else 3
        n, p, m = len(side), len(self.xi), 2 * self.rows
        self.shape = (n, p, m)
        L, z = self.length[:, None], self.xi[None]
        linear, slope = ((1 - z, z), (-1 / L + 0 * z, 1 / L + 0 * z))
        self.u, self.du = (self._along(values, self.t) for values in (linear, slope))
        cubic = (
            (1 - 3 * z**2 + 2 * z**3, 3 * z**2 - 2 * z**3),
            ((z - 2 * z**2 + z**3) * L, (z**3 - z**2) * L),
        )
        first = (
            ((6 * z**2 - 6 * z) / L, (6 * z - 6 * z**2) / L),
            (1 - 4 * z + 3 * z**2 + 0 * L, 3 * z**2 - 2 * z + 0 * L),
        )
        second = (((12 * z - 6) / L**2, (6 - 12 * z) / L**2), ((6 * z - 4) / L, (6 * z - 2) / L))
        self.w, self.dw, self.ddw = (
            self._along(deflections, self.n) + self._single(turns, self.rows - 1)
            for deflections, turns in (cubic, first, second)
        )
        self.v = self._single(linear, 2) if self.rows == 4 else np.zeros(self.shape)
        self.dv = self._single(slope, 2) if self.rows == 4 else np.zeros(self.shape)

    def _single(self, values: tuple[FloatArray, FloatArray], row: int) -> FloatArray:
        out = np.zeros(self.shape)
        for node, value in enumerate(values):
            out[:, :, node * self.rows + row] = value
        return out

    def _along(self, values: tuple[FloatArray, FloatArray], axis: FloatArray) -> FloatArray:
        out = np.zeros(self.shape)
        for node, value in enumerate(values):
            for k in range(2):
                out[:, :, node * self.rows + k] = value * axis[:, None, k]
        return out

    def slope_around(self, harmonic_number: int) -> FloatArray:
        """Rotation of the normal towards the circumference."""
        r, nr = self.r[..., None], self.n[:, 0, None, None]
        return (harmonic_number * self.w + nr * self.v) / r


class MeridianShell(TurningFamily):
    """COQ2; in generalised plane strain it follows the section's motion."""

    def layout(self, zone: Zone) -> Layout:
        """Translations then rotations, node by node, then the section's."""
        return solid.with_section(zone, super().layout(zone))

    def strain_names(self, zone: Zone) -> tuple[str, ...]:
        """Membrane strains and curvatures."""
        if zone.mode not in solid.REVOLUTION:
            return ("EPSS", "EPZZ", "RTSS", "RTZZ")
        names = ("EPSS", "EPTT", "GAST", "RTSS", "RTTT", "RTST")
        return tuple(names[i] for i in _kept(zone))

    def stress_names(self, zone: Zone) -> tuple[str, ...]:
        """Forces and moments per length."""
        if zone.mode not in solid.REVOLUTION:
            return ("N11", "NZZ", "M11", "MZZ")
        names = ("N11", "N22", "N12", "M11", "M22", "M12")
        return tuple(names[i] for i in _kept(zone))

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Membrane and bending moduli; free of forces across in plane stress.

        Raises
        ------
        MaterialError
            If the middle surface is off the mesh (EXCE).
        """
        if offset(zone, parameters) is not None:
            raise MaterialError("kernel.elements.shells-off-mesh-exce")
        D = section_moduli(zone, parameters, support)
        kept = list(_kept(zone))
        D = D[..., kept, :][..., kept].copy()
        if zone.mode is Mode.PLANE_STRESS:
            for along, across in ((0, 1), (2, 3)):
                free = D[..., along, across] ** 2 / D[..., across, across]
                D[..., along, along] -= free
                D[..., across, :] = D[..., :, across] = 0.0
        return D

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Strains and curvatures of the hypothesis."""
        m = _Meridian(zone, support, cells)
        n, p, rows = m.shape
        B = np.zeros((n, 6, p, rows))
        B[:, 0], B[:, 3] = m.du, -m.ddw
        if zone.mode in solid.REVOLUTION:
            self._around(B, m, harmonic(zone))
        if zone.mode is Mode.GENERALISED_PLANE_STRAIN:
            B = np.pad(B, ((0, 0), (0, 0), (0, 0), (0, 3)))
            B[:, 1, :, rows:] = solid.section_strain(zone, m.r, m.y)
            B[:, 4, :, rows + 1 :] = (m.n[:, ::-1] * (1.0, -1.0))[:, None]
        return StrainOperator(B[:, list(_kept(zone))], self._measure(zone, m, parameters, cells))

    @staticmethod
    def _around(B: FloatArray, m: _Meridian, k: int) -> None:
        """Rows of the circumference, for harmonic k.

        The twist counts the turning about the normal (Sanders, NASA TR R-24, 1959; Koiter, 1960),
        without which a body's own turning would twist a shell.
        """
        if (m.r <= 0).any():
            raise MeshError("kernel.elements.shell-cell-reaches-across")
        r, tr, nr = m.r[..., None], m.t[:, 0, None, None], m.n[:, 0, None, None]
        turn = m.slope_around(k)
        B[:, 1] = (tr * m.u + nr * m.w + k * m.v) / r
        B[:, 2] = m.dv - (k * m.u + tr * m.v) / r
        B[:, 4] = (k * turn - tr * m.dw) / r
        about_normal = 0.5 * (m.dv + (tr * m.v + k * m.u) / r)
        B[:, 5] = (2 * k * m.dw + nr * m.dv - 2 * tr * turn + nr * about_normal) / r

    @staticmethod
    def _measure(
        zone: Zone, m: _Meridian, parameters: ZoneField, cells: slice = slice(None)
    ) -> FloatArray:
        if zone.mode in solid.REVOLUTION:
            return m.weights * m.r * solid.circumference(zone)
        return m.weights * parameters.each("DIM3", 1.0)[cells, None]

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """RHO EPAI of the three displacements."""
        m = _Meridian(zone, "MASSE")
        density = parameters.at("RHO", "MASSE") * parameters.at("EPAI", "MASSE")
        w = self._measure(zone, m, parameters) * density
        values = sum(np.einsum("cp,cpi,cpj->cij", w, N, N, optimize=True) for N in (m.u, m.w, m.v))
        return np.asarray(values), super().layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Effect of the membrane forces on the rotations of the normal."""
        m = _Meridian(zone, "STRESSES")
        w = self._measure(zone, m, parameters)
        values: FloatArray = np.einsum(
            "cp,cpi,cpj->cij", w * stress[:, 0], m.dw, m.dw, optimize=True
        )
        if zone.mode in solid.REVOLUTION:
            turn = m.slope_around(harmonic(zone))
            values += np.einsum("cp,cpi,cpj->cij", w * stress[:, 1], turn, turn, optimize=True)
        beyond = len(self.layout(zone).unknowns) - values.shape[-1]  # the section's motion
        return np.pad(values, ((0, 0), (0, beyond), (0, beyond)))


def meridian_forces(zone: Zone, pushed: FloatArray, parameters: ZoneField) -> NodeField:
    """Forces and moments that do the work of a load on the cubic deflection.

    Parameters
    ----------
    pushed : array (n_cells, points of 'MASSE', 2 or 3)
        The load times the area that a point stands for, UR UZ (UT).
    parameters : ZoneField
        DIM3 is the width in plane stress.
    """
    m = _Meridian(zone, "MASSE")
    along, across = (np.einsum("cpd,cd->cp", pushed[..., :2], axis) for axis in (m.t, m.n))
    work = np.einsum("cp,cpi->ci", along, m.u) + np.einsum("cp,cpi->ci", across, m.w)
    if pushed.shape[-1] == 3:
        work += np.einsum("cp,cpi->ci", pushed[..., 2], m.v)
    if zone.mode is Mode.PLANE_STRESS:
        work *= parameters.each("DIM3", 1.0)[:, None]
    return TurningFamily.layout(MeridianShell(), zone).scatter(work)
