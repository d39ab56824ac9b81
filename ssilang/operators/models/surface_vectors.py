"""VSUR: normals of shells and tangents of beams at their integration points."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.catalog import ELEMENTS, support_rule
from ssilang.kernel.elements.shapes.reference import shape_gradients
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.language.registry import Help, arg, flag, operator

_SHELLS = ("plate", "mindlin", "thick", "meridian")
_BEAMS = ("beam", "timoshenko", "pipe")


@operator(
    "VSUR",
    arg("model", "MMODEL", en="model"),
    flag("unit", "NORM", en="of length 1"),
    family="models",
    help=Help(
        en="At the integration points of a model, the normal of its shells and the tangent of its "
        "beams, components VX VY (VZ), or VR VZ about an axis; as long as the Jacobian there, or "
        "of length 1 with 'NORM'. Other elements give nothing.",
        syntax="CHAM1 = VSUR MODL1 ('NORM') ;",
        examples=(
            "OPTI DIME 3 ELEM QUA4 ; S = (DROI 1 (0. 0. 0.) (2. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
            "V = VSUR (MODE S MECANIQUE ELASTIQUE COQ4) 'NORM' ; MESS (MAXI (EXCO 'VZ' V)) ;",
        ),
    ),
)
def vsur(model: Model, unit: bool) -> CellField:
    """Vectors of shells and beams."""
    blocks = [b for z in model.zones if (b := _block(z, unit)) is not None]
    return CellField(tuple(blocks), "NORMALES" if unit else "VECTEURS SURFACE")


def _block(zone: Zone, unit: bool) -> CellFieldBlock | None:
    family = ELEMENTS[zone.element].family if zone.element in ELEMENTS else ""
    if family not in (*_SHELLS, *_BEAMS):
        return None
    vectors = _vectors(zone, family in _SHELLS)
    if unit:
        vectors = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    if zone.mode is Mode.THREE_DIMENSIONAL:
        names: tuple[str, ...] = ("VX", "VY", "VZ")
    else:
        round_axis = zone.mode in (Mode.AXISYMMETRIC, Mode.FOURIER)
        names = ("VR", "VZ") if round_axis else ("VX", "VY")
    components = {name: vectors[..., i].copy() for i, name in enumerate(names)}
    return CellFieldBlock(zone.cells, components, "RIGIDITE", zone.element, zone.constituent)


def _vectors(zone: Zone, normal: bool) -> FloatArray:
    """Vectors (n_cells, n_points, 3) of the length of the Jacobian."""
    points = support_rule(zone.element, "RIGIDITE").points
    gradients = shape_gradients(zone.cells.cell_type, points)
    tangents = np.einsum("pki,ckd->cpid", gradients, zone.cells.coordinates)
    if not normal:
        return np.asarray(tangents[:, :, 0])
    if tangents.shape[2] == 1:  # a meridian: a quarter turn from the line
        t = tangents[:, :, 0]
        return np.stack([-t[..., 1], t[..., 0], 0.0 * t[..., 0]], axis=-1)
    return np.asarray(np.cross(tangents[:, :, 0], tangents[:, :, 1]))
