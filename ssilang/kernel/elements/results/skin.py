"""Stresses in the section of beams and shells, from their section forces."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.beams.beam_frame import kept_rows
from ssilang.kernel.elements.catalog import STRAIGHT_BEAMS, family_name
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.frames import shell_frames, strains_or_stresses
from ssilang.kernel.elements.results.tensors import components_at_home
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Zone

SIDES = {"SUPE": 1.0, "MOYE": 0.0, "INFE": -1.0}
"""Side of a shell: towards its normal, in the middle, away from it."""
_SKIN_NAMES = {
    "N11": "SMXX", "N22": "SMYY", "N12": "SMXY", "NZZ": "SMZZ",
    "EPSS": "EPXX", "EPTT": "EPYY", "GAST": "GAXY",
}  # fmt: skip
"""Components of a solid, x and y being the axes of the shell's own frame."""


def shell_skin(
    zone: Zone, field: CellField, material: CellField, side: str
) -> tuple[dict[str, FloatArray], Support]:
    """Stresses N / h + 6 M / h^2 or strains e + k h / 2 at one side, in the shell's own frame.

    Returns
    -------
    components : SMXX SMYY SMXY, or EPXX EPYY GAXY
    support : where they stand
    """
    parameters = zone_field(zone, material)
    names, values, support, strains = strains_or_stresses(zone, field)
    half = sum(n[0] == ("R" if strains else "M") for n in names)
    membrane, bending = values[:, :half], values[:, half : 2 * half]
    h = parameters.at("EPAI", support)[:, None]
    lever = SIDES[side] * (h / 2 if strains else 6 / h**2)
    skin = (membrane if strains else membrane / h) + lever * bending
    return {_SKIN_NAMES.get(n, n): skin[:, i] for i, n in enumerate(names[:half])}, support


def shell_tensor(
    zone: Zone, field: CellField, material: CellField, side: str
) -> tuple[FloatArray, Support]:
    """Stress or strain tensors (n_cells, n_points, 3, 3) at one side of a shell."""
    parts, support = shell_skin(zone, field, material, side)
    rows = list(parts.values())
    T = np.zeros((*rows[0].shape, 3, 3))
    T[..., 0, 0], T[..., 1, 1] = rows[0], rows[1]
    if len(rows) > 2:
        shear = rows[2] / 2 if "GAXY" in parts else rows[2]
        T[..., 0, 1] = T[..., 1, 0] = shear
    return T, support


def in_global_axes(zone: Zone, T: FloatArray) -> FloatArray:
    """Tensors (n_cells, n_points, 3, 3) of a thin shell's own frame, in the axes of the mesh."""
    frames = shell_frames(zone)
    return np.einsum("cki,cpkl,clj->cpij", frames, T, frames)


def is_thick_shell(zone: Zone) -> bool:
    """True for shells with stresses at points across the thickness."""
    return family_name(zone) == "thick"


def thick_tensor(zone: Zone, field: CellField) -> tuple[FloatArray, Support]:
    """Stress or strain tensors (n_cells, n_points, 3, 3) of a thick shell, in its own frames."""
    _, values, support, strains = strains_or_stresses(zone, field)
    T = np.zeros((len(values), values.shape[2], 3, 3))
    for row, (i, j) in enumerate(((0, 0), (1, 1), (0, 1), (0, 2), (1, 2))):
        T[..., i, j] = T[..., j, i] = values[:, row] / (2 if strains and i != j else 1)
    return T, support


def skin_stress(zone: Zone, field: CellField, material: CellField) -> CellFieldBlock:
    """Normal stress SMXX at the point (DY, DZ) of the section, local axes.

    EFFX / SECT + MOMY DZ / INRY - MOMZ DY / INRZ.

    Raises
    ------
    FieldError
        For elements that are not beams.
    """
    if family_name(zone) not in STRAIGHT_BEAMS:
        raise FieldError("kernel.elements.element-no-skin", element=zone.element)
    names = family_of(zone).stress_names(zone)
    forces, support = components_at_home(zone, field, names)
    parameters = zone_field(zone, material)

    def term(force: str, lever: str, constant: str) -> FloatArray:
        ratio = parameters.at(lever, support, 0.0) / parameters.at(constant, support)
        return np.asarray(forces[:, names.index(force)] * ratio)

    stress = forces[:, 0] / parameters.at("SECT", support)
    stress = stress - term("MOMZ", "DY", "INRZ")
    if len(kept_rows(zone)) == 6:
        stress = stress + term("MOMY", "DZ", "INRY")
    return zone.block({"SMXX": stress}, support)
