"""Stress and strain fields of continuous elements as tensors: principal values, invariants.

Largest shear strain of solid cells over a motion (equivalent-linear soil).
"""

from collections.abc import Iterable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.solids.gradients import PAIRS
from ssilang.kernel.elements.zone_fields import carry, none_of, zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Mode, Zone

PRINCIPAL = tuple(f"SI{i}{i}" for i in (1, 2, 3)) + tuple(
    f"CO{axis}{i}" for i in (1, 2, 3) for axis in "XYZ"
)


def components_at_home(
    zone: Zone, field: CellField, names: tuple[str, ...]
) -> tuple[FloatArray, Support]:
    """Components (n_cells, n_names, n_points), zero where absent, at the points they stand on."""
    seen = zone_field(zone, field)
    present = [n for n in names if n in seen]
    if not present:
        raise none_of(names, zone, seen)
    raws = {n: seen.raw(n) for n in present}
    support = next((s for v, s in raws.values() if v.shape[1] > 1), raws[present[0]][1])
    moved = {n: carry(v.astype(float), zone.element, s, support) for n, (v, s) in raws.items()}
    shape = (len(zone.cells), max(v.shape[1] for v in moved.values()))
    columns = [np.broadcast_to(moved.get(n, np.zeros((1, 1))), shape) for n in names]
    return np.stack(columns, axis=1), support


def names_seen(zone: Zone, field: CellField) -> tuple[tuple[str, ...], bool]:
    """Names of the strains, total or plastic, or else of the stresses; whether it has strains."""
    seen, family = zone_field(zone, field), families.family_of(zone)
    for names in (family.strain_names(zone), families.plastic_strain_names(zone)):
        if any(n in seen for n in names):
            return names, True
    return family.stress_names(zone), False


def tensor(zone: Zone, field: CellField) -> tuple[FloatArray, Support, bool]:
    """Tensors (n_cells, n_points, 3, 3), their support, and whether they are strains."""
    names, strains = names_seen(zone, field)
    values, support = components_at_home(zone, field, names)
    return as_tensor(values, strains), support, strains


def as_tensor(values: FloatArray, strains: bool) -> FloatArray:
    """Tensors (n, p, 3, 3) from components (n, 4 or 6, p); shear strains are halved."""
    n, m, p = values.shape
    T = np.zeros((n, p, 3, 3))
    for row, (i, j) in enumerate(PAIRS[:m]):
        factor = 0.5 if strains and i != j else 1.0
        T[..., i, j] = T[..., j, i] = factor * values[:, row]
    return T


def as_components(T: FloatArray, n_components: int, strains: bool) -> FloatArray:
    """Components (n, n_components, p) of tensors (n, p, 3, 3)."""
    rows = [T[..., i, j] * (2.0 if strains and i != j else 1.0) for i, j in PAIRS[:n_components]]
    return np.stack(rows, axis=1)


def principal(zone: Zone, T: FloatArray, ordered: bool) -> FloatArray:
    """Principal values then directions, (n, 12, p) in the order of `PRINCIPAL`.

    In space and with `ordered` values decrease; else the third is the one out of the plane.

    Raises
    ------
    FieldError
        For tensors with values that are not finite: a shell without thickness or without length.
    """
    if not np.isfinite(T).all():
        raise FieldError("kernel.elements.principal-of-no-number", element=zone.element)
    values, vectors = np.linalg.eigh(T)
    values, vectors = values[..., ::-1], vectors[..., ::-1]
    space = zone.mode in (Mode.THREE_DIMENSIONAL, Mode.FOURIER)
    if not (ordered or space):
        normal = np.argmax(np.abs(vectors[..., 2, :]), axis=-1)
        order = np.stack(
            [np.where(normal == 0, 1, 0), np.where(normal == 2, 1, 2), normal], axis=-1
        )
        values = np.take_along_axis(values, order, axis=-1)
        vectors = np.take_along_axis(vectors, order[..., None, :], axis=-1)
    directions = np.moveaxis(vectors, -1, -2).reshape(*values.shape[:2], 9)
    return np.moveaxis(np.concatenate([values, directions], axis=-1), 2, 1)


def von_mises(T: FloatArray) -> FloatArray:
    """Square root of 3/2 s:s, (n, p)."""
    deviator = T - np.trace(T, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * np.einsum("npij,npij->np", deviator, deviator))


def tresca(T: FloatArray) -> FloatArray:
    """Largest difference of principal values, (n, p)."""
    values = np.linalg.eigvalsh(T)
    return values[..., 2] - values[..., 0]


def invariants(T: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Trace, sum of the principal minors of order two, determinant, each (n, p)."""
    first = np.trace(T, axis1=-2, axis2=-1)
    second = 0.5 * (first**2 - np.einsum("npij,npji->np", T, T))
    return first, second, np.linalg.det(T)


def largest_shear_strain(zone: Zone, motion: Iterable[FloatArray]) -> CellFieldBlock:
    """Largest over a motion of sqrt(2 e:e) at the centres of cells, e being the strain deviator.

    In simple shear this is the shear strain (gamma) itself.

    Parameters
    ----------
    motion : iterable of arrays (n_instants, n_cells, n_rows)
        Element vectors of displacements, in the layout of the zone.

    Returns
    -------
    CellFieldBlock
        SCAL at 'GRAVITE', no unit.

    Raises
    ------
    MeshError
        If the zone is not of continuous elements.
    """
    family = families.family_of(zone)
    names = family.strain_names(zone)
    if names[:3] not in (("EPXX", "EPYY", "EPZZ"), ("EPRR", "EPZZ", "EPTT")):
        raise MeshError("kernel.elements.elements-no-shear-strain", element=zone.element)
    everything = slice(0, len(zone.cells))
    operator = family.strain_operator(zone, zone_field(zone, None), "GRAVITE", everything)
    matrix = operator.matrix[:, :, 0, :]
    largest = np.zeros(len(zone.cells))
    for vectors in motion:
        strain = np.matmul(matrix, vectors.transpose(1, 2, 0))
        normal, shear = strain[:, :3], strain[:, 3:]
        deviator = normal - normal.mean(axis=1, keepdims=True)
        square = 2 * (deviator**2).sum(axis=1) + (shear**2).sum(axis=1)
        np.maximum(largest, square.max(axis=1, initial=0.0), out=largest)
    return cell_block(zone, ("SCAL",), np.sqrt(largest)[:, None, None], "GRAVITE")
