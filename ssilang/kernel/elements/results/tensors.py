"""Stress and strain fields of continuous elements as tensors: principal values, invariants.

Largest shear strain of solid cells over a motion (equivalent-linear soil).

Equivalent stress of a section, a quadratic form of its forces: VMIS, criterion of flow.
"""

from collections.abc import Iterable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.beams.pipe import pipe_parameters
from ssilang.kernel.elements.catalog import BARS, BEAMS, THIN_SHELLS, family_name
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.solids.kinematics import as_tensor
from ssilang.kernel.elements.zone_fields import ZoneField, carry, none_of, zone_field
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


LEVERS = {"MOMX": ("DX", "TORS"), "MOMY": ("DZ", "INRY"), "MOMZ": ("DY", "INRZ")}
"""Moments of beams: the distance that makes a stress of them, the constant of the section."""
_PLANE = np.array([[1.0, -0.5, 0.0], [-0.5, 1.0, 0.0], [0.0, 0.0, 3.0]])


def section_form(zone: Zone, given: ZoneField, support: Support) -> FloatArray:
    """Matrix (n or 1, p or 1, s, s): the square of the equivalent stress as a form of forces.

    Shells: von Mises of the membrane forces over the thickness and, weighed by CALF (2/3: the
    moment of a section that yields throughout), of the moments. Beams and pipes: the stresses of
    each force, moments of beams where their distance DX, DY, DZ is given.

    Raises
    ------
    FieldError
        For elements that are not shells, beams, pipes or bars.
    """
    names, family = family_of(zone).stress_names(zone), family_name(zone)
    if family in THIN_SHELLS:
        h = given.at("EPAI", support)
        weights = (1 / h, 6 * given.at("CALF", support, 2 / 3) / h**2)
        half = sum(n[0] == "M" for n in names)
        P = np.zeros((*np.broadcast_shapes(*(w.shape for w in weights)), len(names), len(names)))
        for start, weight in zip((0, half), weights, strict=True):
            rows = slice(start, start + half)
            P[..., rows, rows] = (weight**2)[..., None, None] * _PLANE[:half, :half]
        return P
    if family not in (*BEAMS, *BARS):
        raise FieldError("kernel.elements.element-no-equivalent-stress", element=zone.element)
    per_force = (_of_pipe if family == "pipe" else _of_beam)(zone, given)
    factors = np.broadcast_arrays(*(per_force.get(n, np.zeros((1, 1))) for n in names))
    return np.stack(factors, axis=-1)[..., None] ** 2 * np.eye(len(names))


def _of_beam(zone: Zone, given: ZoneField) -> dict[str, FloatArray]:
    found = {"EFFX": 1 / given.at("SECT", "GRAVITE")}
    for name, (distance, constant) in LEVERS.items():
        if name in family_of(zone).stress_names(zone) and distance in given:
            found[name] = given.at(distance, "GRAVITE") / given.at(constant, "GRAVITE")
    return found


def _of_pipe(zone: Zone, given: ZoneField) -> dict[str, FloatArray]:
    """Stresses of membrane, torsion and bending of a ring, with their intensity factors."""
    ring = pipe_parameters(zone, given, bends=False)
    h, mean, bend = _ring(ring)
    ratio = np.where(bend > 0, h * bend / mean**2, 1.0)
    bending = np.pi / 4 * np.where(bend > 0, np.maximum(1.0, 8 / 9 / ratio ** (2 / 3)), 1.0)
    found = {}
    for force, factor, usual, lever in (
        ("EFFX", "CFFX", np.ones((1, 1)), 1 / ring.at("SECT", "GRAVITE")),
        ("MOMX", "CFMX", np.full((1, 1), np.sqrt(3.0)), mean / ring.at("TORS", "GRAVITE")),
        ("MOMY", "CFMY", bending, mean / ring.at("INRY", "GRAVITE")),
        ("MOMZ", "CFMZ", bending, mean / ring.at("INRZ", "GRAVITE")),
    ):
        found[force] = lever * (ring.at(factor, "GRAVITE") if factor in ring else usual)
    return found


def _ring(ring: ZoneField) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Thickness, mean radius, radius of the bend."""
    h = ring.at("EPAI", "GRAVITE")
    return h, ring.at("RAYO", "GRAVITE") - h / 2, ring.at("RACO", "GRAVITE", 0.0)


def section_equivalent(
    zone: Zone, field: CellField, material: CellField | None
) -> tuple[FloatArray, Support]:
    """Equivalent stress (n_cells, n_points) of a section's forces, and where it stands.

    The hoop stress of a pipe's pressure counts here (CFPR), and not in the criterion of flow.
    """
    names, given = family_of(zone).stress_names(zone), zone_field(zone, material)
    forces, support = components_at_home(zone, field, names)
    P = section_form(zone, given, support)
    P = np.broadcast_to(P, (len(forces), forces.shape[2], *P.shape[2:]))
    squares = np.einsum("cip,cpij,cjp->cp", forces, P, forces)
    if family_name(zone) == "pipe" and "CFPR" in given and "PRES" in given:
        h, mean, _ = _ring(given)
        hoop = given.at("PRES", "GRAVITE") * given.at("CFPR", "GRAVITE") * mean / h
        squares = squares + hoop**2
    return np.sqrt(squares), support
