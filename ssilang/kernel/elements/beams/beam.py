"""Beams: Euler-Bernoulli with optional shear flexibility (POUT) and Timoshenko (TIMO).

Section forces are those that the part of the beam beyond the section (along the local axis x)
applies on the part before it, in local axes: EFFX EFFY EFFZ MOMX MOMY MOMZ.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements import family
from ssilang.kernel.elements.beams.beam_frame import (
    BeamFrame,
    Section,
    beam_frame,
    kept_rows,
    section_rigidities,
)
from ssilang.kernel.elements.beams.fibre_section import section_of_beam
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone

STRAINS = ("EPS", "GXY", "GXZ", "CX", "CY", "CZ")
FORCES = ("EFFX", "EFFY", "EFFZ", "MOMX", "MOMY", "MOMZ")

# bending planes: (deflection row, rotation row, sign of the rotation, moment of inertia, shear)
_PLANES = ((1, 5, 1.0, 5, 1), (2, 4, -1.0, 4, 2))
# of what is linear between two nodes: products of slopes, and of shapes times 6, over the length
_DIFFERENCE, _LINEAR = np.array([[1.0, -1.0], [-1.0, 1.0]]), np.array([[2.0, 1.0], [1.0, 2.0]])
# coefficients of one bending plane, rows and columns v1 t1 v2 t2
_BENDING = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]], float)
_ROTARY_SHEAR = np.array([[0, 0, 0, 0], [0, 1, 0, -1], [0, 0, 0, 0], [0, -1, 0, 1]], float)
_LENGTH_POWERS = np.array([[3, 2, 3, 2], [2, 1, 2, 1], [3, 2, 3, 2], [2, 1, 2, 1]], float)
_HERMITE_MASS = np.array(
    [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]], float
)
_MASS_POWERS = np.array([[0, 1, 0, 1], [1, 2, 1, 2], [0, 1, 0, 1], [1, 2, 1, 2]], float)
# integral of the products of slopes of the cubic deflection, times 30 L
_SLOPES = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]], float)


def _signs(sign: float) -> FloatArray:
    """A rotation about y turns the other way round in its bending plane."""
    s = np.array([1.0, sign, 1.0, sign])
    return np.outer(s, s)


def _place(K: FloatArray, rows: list[int], block: FloatArray) -> None:
    K[:, np.array(rows)[:, None], np.array(rows)[None, :]] += block


def local_stiffness(section: Section, lengths: FloatArray) -> FloatArray:
    """Stiffness (n_cells, 12, 12) in local axes, exact for loads at the nodes."""
    n, L = len(lengths), lengths
    values = np.broadcast_to(section.values, (n, 6))
    K = np.zeros((n, 12, 12))
    for row in (0, 3):
        _place(K, [row, row + 6], (values[:, row] / L)[:, None, None] * _DIFFERENCE)
    for v, t, sign, bending, shear in _PLANES:
        phi = section.shear_ratio(L, bending, shear)[:, None, None]
        scale = values[:, bending, None, None] / L[:, None, None] ** _LENGTH_POWERS
        block = scale * (_BENDING + phi * _ROTARY_SHEAR) / (1 + phi) * _signs(sign)
        _place(K, [v, t, v + 6, t + 6], block)
    return K


def _plane_blocks(
    base: FloatArray, lengths: FloatArray, scale: FloatArray, other: FloatArray | None = None
) -> FloatArray:
    """Bending planes filled with scale * base * L^powers, (n_cells, 12, 12).

    `scale` (n_cells,) holds for x y, `other` for x z; the same in both planes without it.
    """
    K = np.zeros((len(lengths), 12, 12))
    powers = lengths[:, None, None] ** _MASS_POWERS
    scales = (scale, scale if other is None else other)
    for (v, t, sign, _, _), factor in zip(_PLANES, scales, strict=True):
        _place(K, [v, t, v + 6, t + 6], factor[:, None, None] * base * powers * _signs(sign))
    return K


def keep(matrix: FloatArray, zone: Zone) -> FloatArray:
    """The rows and columns of (n_cells, 12, 12) that the hypothesis keeps."""
    rows = np.array([r + 6 * node for node in (0, 1) for r in kept_rows(zone)])
    return matrix[:, rows[:, None], rows[None, :]]


def to_global(local: FloatArray, T: FloatArray) -> FloatArray:
    """T^T local T."""
    return np.swapaxes(T, 1, 2) @ local @ T


class _LineBeam(family.TurningFamily):
    """What both beams share."""

    shear_default = "rigid"

    def strain_names(self, zone: Zone) -> tuple[str, ...]:
        """Lengthening, shears, twist, curvatures."""
        return tuple(STRAINS[i] for i in kept_rows(zone))

    def stress_names(self, zone: Zone) -> tuple[str, ...]:
        """Section forces and moments."""
        return tuple(FORCES[i] for i in kept_rows(zone))

    def section(self, zone: Zone, parameters: ZoneField) -> Section:
        """Section rigidities."""
        return section_rigidities(zone, parameters, self.shear_default)

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Diagonal (n_cells or 1, 1, s, s): E A, G Ay, G Az, G J, E Iy, E Iz.

        Zero stands for a shear rigidity that is not taken into account.
        """
        values = self.section(zone, parameters).values[:, list(kept_rows(zone))]
        values = np.where(np.isinf(values), 0.0, values)
        return (values[:, None, :] * np.eye(values.shape[1]))[:, None]

    def weights(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Length shared by the points of a support."""
        rule = support_rule(zone.element, support)
        lengths = beam_frame(zone, parameters).lengths
        shares: FloatArray = rule.weights / rule.weights.sum()
        return lengths[:, None] * shares

    def linear_mass(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, FloatArray]:
        """Mass per length and mass moment per length (x, y, z), (n_cells, 1) and (n_cells, 3)."""
        rho, area = parameters.each("RHO"), parameters.each("SECT")
        iy, iz = parameters.each("INRY", 0.0), parameters.each("INRZ")
        return rho * area, rho[:, None] * np.stack([iy + iz, iy, iz], axis=1)


def paired(values: FloatArray, axis: int) -> FloatArray:
    """Two thirds of an end's values and one of the other end's, the ends along an axis.

    So count the values of what is linear between the ends in forces and work.
    """
    return (2 * values + np.flip(values, axis)) / 3


class Beam(_LineBeam):
    """POUT: cubic deflection; SECY, SECZ add shear flexibility; sections turn with the slope."""

    def stiffness_values(self, zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray:
        """Exact stiffness; `moduli` give the rigidities when they come from HOOK."""
        frame = beam_frame(zone, parameters)
        local = local_stiffness(section_of(moduli, zone), frame.lengths)
        return to_global(keep(local, zone), frame.rotation(zone))

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Strains at the two nodes of a beam without shear (weights: half the length)."""
        frame = beam_frame(zone, parameters)
        part = BeamFrame(frame.lengths[cells], frame.axes[cells])
        matrix = _end_forces(Section(np.array([[1.0, np.inf, np.inf, 1.0, 1.0, 1.0]])), part, zone)
        shear = [i for i, row in enumerate(kept_rows(zone)) if row in (1, 2)]
        matrix[:, shear] = 0.0
        weights = np.repeat(part.lengths[:, None] / 2, 2, axis=1)
        return family.StrainOperator(matrix, weights, paired(matrix, 2))

    def strain_values(
        self, zone: Zone, displacement: NodeField, parameters: ZoneField
    ) -> FloatArray:
        """Strains at the nodes; shear counts where the parameters say SECY or SECZ."""
        if not ("SECY" in parameters or "SECZ" in parameters) or "YOUN" not in parameters:
            return super().strain_values(zone, displacement, parameters)
        section = self.section(zone, parameters)
        forces = self._forces(zone, displacement, section, parameters)
        values = section.values[:, list(kept_rows(zone))][:, :, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.nan_to_num(forces / values)

    def _forces(
        self, zone: Zone, displacement: NodeField, section: Section, parameters: ZoneField
    ) -> FloatArray:
        matrix = _end_forces(section, beam_frame(zone, parameters), zone)
        vectors = self.layout(zone).gather(displacement)
        return np.einsum("cspm,cm->csp", matrix, vectors)

    def stress_values(
        self, zone: Zone, displacement: NodeField, moduli: FloatArray, parameters: ZoneField
    ) -> FloatArray:
        """Section forces at the two nodes."""
        return self._forces(zone, displacement, section_of(moduli, zone), parameters)

    def force_vectors(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Forces at the nodes that hold the section forces found there."""
        local = np.concatenate([-stress[:, :, 0], stress[:, :, 1]], axis=1)
        T = beam_frame(zone, parameters).rotation(zone)
        return np.einsum("cji,cj->ci", T, local)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """Consistent mass of the cubic deflection and its slope, linear lengthening and twist."""
        frame = beam_frame(zone, parameters)
        L = frame.lengths
        linear, moments = self.linear_mass(zone, parameters)
        local = _plane_blocks(_HERMITE_MASS, L, linear * L / 420)
        local += _plane_blocks(_SLOPES, L, moments[:, 2] / (30 * L), moments[:, 1] / (30 * L))
        for row, scale in ((0, linear), (3, moments[:, 0])):
            _place(local, [row, row + 6], (scale * L / 6)[:, None, None] * _LINEAR)
        return to_global(keep(local, zone), frame.rotation(zone)), self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Effect of the mean normal force on the cubic deflection and linear lengthening."""
        frame = beam_frame(zone, parameters)
        scale = stress[:, 0].mean(axis=1) / (30 * frame.lengths)
        local = _plane_blocks(_SLOPES, frame.lengths, scale)
        _place(local, [0, 6], 30 * scale[:, None, None] * _DIFFERENCE)
        return to_global(keep(local, zone), frame.rotation(zone))


class Timoshenko(_LineBeam):
    """TIMO: linear deflections and rotations, one integration point."""

    shear_default = "SECT"

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Strains in the middle of the cell."""
        frame = beam_frame(zone, parameters)
        part = BeamFrame(frame.lengths[cells], frame.axes[cells])
        n, L = len(part.lengths), part.lengths
        B = np.zeros((n, 6, 12))
        for i in range(6):
            B[:, i, i], B[:, i, i + 6] = -1 / L, 1 / L
        B[:, 1, (5, 11)] -= 0.5
        B[:, 2, (4, 10)] += 0.5
        rows = list(kept_rows(zone))
        columns = [r + 6 * node for node in (0, 1) for r in rows]
        local = B[:, np.array(rows)[:, None], np.array(columns)[None, :]]
        return family.StrainOperator((local @ part.rotation(zone))[:, :, None, :], L[:, None])

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """Linear interpolation of translations and rotations."""
        frame = beam_frame(zone, parameters)
        linear, moments = self.linear_mass(zone, parameters)
        scales = np.hstack([np.repeat(linear[:, None], 3, axis=1), moments])
        local = np.zeros((len(linear), 12, 12))
        for row in range(6):
            block = (scales[:, row] * frame.lengths / 6)[:, None, None] * _LINEAR
            _place(local, [row, row + 6], block)
        return to_global(keep(local, zone), frame.rotation(zone)), self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Effect of the normal force on the displacements and on the turning of sections."""
        frame = beam_frame(zone, parameters)
        scale = (stress[:, 0, 0] / frame.lengths)[:, None, None]
        local = np.zeros((len(scale), 12, 12))
        for v in (0, 1, 2):
            _place(local, [v, v + 6], scale * _DIFFERENCE)
        radii = self._squared_radii(zone, parameters)
        for column, r in enumerate((4, 5)):
            _place(local, [r, r + 6], scale * radii[:, column, None, None] * _DIFFERENCE)
        return to_global(keep(local, zone), frame.rotation(zone))

    def _squared_radii(self, zone: Zone, parameters: ZoneField) -> FloatArray:
        """Squared radii of gyration about y and z, (n_cells, 2); zero where no section is known."""
        if "SECT" not in parameters:
            return np.zeros((len(zone.cells), 2))
        inertia = [parameters.each(name, 0.0) for name in ("INRY", "INRZ")]
        return np.stack(inertia, axis=1) / parameters.each("SECT")[:, None]


def section_of(moduli: FloatArray, zone: Zone) -> Section:
    """Rigidities back from moduli (n_cells or 1, 1, s, s)."""
    values = np.zeros((len(moduli), 6))
    values[:, list(kept_rows(zone))] = np.einsum("css->cs", moduli[:, 0])
    shear = values[:, 1:3]
    shear[shear == 0] = np.inf
    return Section(values)


def _end_forces(section: Section, frame: BeamFrame, zone: Zone) -> FloatArray:
    """Operator (n_cells, n_forces, 2, n_rows) from displacements to section forces at the nodes."""
    K = keep(local_stiffness(section, frame.lengths), zone) @ frame.rotation(zone)
    m = len(kept_rows(zone))
    return np.stack([-K[:, :m], K[:, m:]], axis=2)


class FibreBeam(Timoshenko):
    """Timoshenko beam whose rigidities are those of its fibres, about its line."""

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Full matrix (1, 1, s, s)."""
        rows = np.array(kept_rows(zone))
        return section_of_beam(parameters).rigidity[rows[:, None], rows][None, None]

    def linear_mass(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, FloatArray]:
        """Mass per length (n_cells,) and mass moments per length (n_cells, 3) about the line."""
        mass, n = section_of_beam(parameters).mass, len(zone.cells)
        return np.full(n, mass[0, 0]), np.tile(np.diag(mass)[3:], (n, 1))

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """Linear interpolation; fibres off the line tie translations to rotations."""
        frame = beam_frame(zone, parameters)
        local = (
            np.kron(_LINEAR / 6, section_of_beam(parameters).mass) * frame.lengths[:, None, None]
        )
        return to_global(keep(local, zone), frame.rotation(zone)), self.layout(zone)

    def _squared_radii(self, zone: Zone, parameters: ZoneField) -> FloatArray:
        if "MODS" not in parameters:
            return np.zeros((len(zone.cells), 2))
        return np.tile(section_of_beam(parameters).squared_radii, (len(zone.cells), 1))
