"""Local axes and section constants of beams."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError, MeshError
from ssilang.kernel.elements.solids.kinematics import on_diagonal
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.materials.model import Mode, Zone

# local unknowns of a node: u v w, then rotations x y z; the plane keeps u v and the rotation z
SPACE_ROWS = (0, 1, 2, 3, 4, 5)
PLANE_ROWS = (0, 1, 5)


def kept_rows(zone: Zone) -> tuple[int, ...]:
    """Which of a node's six local unknowns (and section forces) the hypothesis keeps."""
    return SPACE_ROWS if zone.mode is Mode.THREE_DIMENSIONAL else PLANE_ROWS


@dataclass(frozen=True, eq=False)
class BeamFrame:
    """Lengths (n_cells,) and local axes (n_cells, 3, 3), unit vectors as rows."""

    lengths: FloatArray
    axes: FloatArray

    def rotation(self, zone: Zone) -> FloatArray:
        """Matrix (n_cells, m, m) from global to local unknowns of both nodes."""
        return on_diagonal(self.axes, 4 if zone.mode is Mode.THREE_DIMENSIONAL else 2)


def _default_side(along: FloatArray) -> FloatArray:
    """Second axis where the script gives none: horizontal, or OY along a vertical beam."""
    side = np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(along))])
    vertical = np.linalg.norm(side, axis=1) < 1e-6
    side[vertical] = (0.0, 1.0, 0.0)
    return side


def _given_side(zone: Zone, parameters: ZoneField) -> FloatArray | None:
    if zone.mode is not Mode.THREE_DIMENSIONAL:
        return None
    if "VECT" in parameters:
        values = parameters.raw("VECT")[0]
        flat = np.asarray(values, dtype=object).reshape(len(values), -1)[:, 0]
        rows = [point.coordinates for point in flat]
        return np.broadcast_to(np.array(rows, dtype=float), (len(zone.cells), 3))
    if "VX" in parameters:
        return np.stack([parameters.each(name, 0.0) for name in ("VX", "VY", "VZ")], axis=1)
    return None


def beam_frame(zone: Zone, parameters: ZoneField) -> BeamFrame:
    """Local axes: x from the first node to the second, y in the plane of x and VECT.

    Raises
    ------
    MeshError
        If a cell has no length.
    MaterialError
        If VECT is along the beam.
    """
    ends = zone.cells.coordinates
    delta = ends[:, -1] - ends[:, 0]
    if zone.mode is not Mode.THREE_DIMENSIONAL:
        delta = delta * [1.0, 1.0, 0.0]
    lengths = np.linalg.norm(delta, axis=1)
    if (lengths <= 0).any():
        raise MeshError("kernel.elements.beam-cell-zero-length")
    x = delta / lengths[:, None]
    given = _given_side(zone, parameters)
    side = _default_side(x) if given is None else given
    z = np.cross(x, side)
    norms = np.linalg.norm(z, axis=1, keepdims=True)
    if (norms <= 1e-9 * np.linalg.norm(side, axis=1, keepdims=True)).any():
        raise MaterialError("kernel.elements.vect-along-beam-must")
    z = z / norms
    return BeamFrame(lengths, np.stack([x, np.cross(z, x), z], axis=1))


@dataclass(frozen=True, eq=False)
class Section:
    """Rigidities of a beam's section, each (n_cells or 1,).

    `values` are E A, G Ay, G Az, G J, E Iy, E Iz; the shear ones are infinite where shear is
    neglected.
    """

    values: FloatArray

    def shear_ratio(self, lengths: FloatArray, bending: int, shear: int) -> FloatArray:
        """12 E I / (G A L^2), 0 where shear is neglected."""
        with np.errstate(divide="ignore"):
            ratio: FloatArray = 12 * self.values[:, bending] / (self.values[:, shear] * lengths**2)
        return np.nan_to_num(ratio, nan=0.0)


def _mean(parameters: ZoneField, name: str) -> FloatArray:
    return parameters.at(name, "GRAVITE")[:, 0]


def section_rigidities(zone: Zone, parameters: ZoneField, shear_default: str) -> Section:
    """Section constants from YOUN NU SECT INRY INRZ TORS (SECY SECZ).

    Parameters
    ----------
    shear_default : str
        'SECT': sheared sections default to SECT; 'rigid': shear is neglected by default.
    """
    space = zone.mode is Mode.THREE_DIMENSIONAL
    young = _mean(parameters, "YOUN")
    area = _mean(parameters, "SECT")
    inertia_z = _mean(parameters, "INRZ")
    zero = np.zeros(1)
    inertia_y = _mean(parameters, "INRY") if space else zero
    torsion = _mean(parameters, "TORS") if space else zero
    sheared = [n for n in ("SECY", "SECZ") if n in parameters]
    needs_shear = space or sheared or shear_default == "SECT"
    shear = young / (2 * (1 + _mean(parameters, "NU"))) if needs_shear else zero
    rigid = np.full(1, np.inf)
    fallback = shear * area if shear_default == "SECT" else rigid
    stiff = [
        shear * _mean(parameters, n) if n in parameters else fallback for n in ("SECY", "SECZ")
    ]
    rows = (young * area, *stiff, shear * torsion, young * inertia_y, young * inertia_z)
    return Section(np.stack(np.broadcast_arrays(*rows), axis=-1))
