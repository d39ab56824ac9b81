"""Equivalent stress of a section, a quadratic form of its forces: VMIS, criterion of flow."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.beams.pipe import pipe_parameters
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.tensors import components_at_home
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.materials.model import Zone

SHELLS = ("plate", "meridian", "mindlin")
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
    names, family = family_of(zone).stress_names(zone), ELEMENTS[zone.element].family
    if family in SHELLS:
        h = given.at("EPAI", support)
        weights = (1 / h, 6 * given.at("CALF", support, 2 / 3) / h**2)
        half = sum(n[0] == "M" for n in names)
        P = np.zeros((*np.broadcast_shapes(*(w.shape for w in weights)), len(names), len(names)))
        for start, weight in zip((0, half), weights, strict=True):
            rows = slice(start, start + half)
            P[..., rows, rows] = (weight**2)[..., None, None] * _PLANE[:half, :half]
        return P
    if family not in ("bar", "beam", "timoshenko", "pipe"):
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
    if ELEMENTS[zone.element].family == "pipe" and "CFPR" in given and "PRES" in given:
        h, mean, _ = _ring(given)
        hoop = given.at("PRES", "GRAVITE") * given.at("CFPR", "GRAVITE") * mean / h
        squares = squares + hoop**2
    return np.sqrt(squares), support
