"""Models of shapes: points that stand for modes and static shapes of a body (super-elements).

A zone MODAL has one unknown ALFA, its participation in a mode of vibration; a zone STATIQUE has
BETA, that in a static shape. All shapes of a model make one matrix: the stiffness and mass of the
body on the motions that they span, couplings included.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.families import register_family
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.springs import StrainlessFamily
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, dual_of
from ssilang.kernel.modal.basis import work
from ssilang.kernel.modal.modes import eigenvalue

UNKNOWN = {"MODAL": "ALFA", "STATIQUE": "BETA"}
"""Unknown of each kind of point."""
LINK = "LIAI"
"""Element of links (MODE 'LIAISON')."""


class _ShapeFamily(StrainlessFamily):
    """Points that stand for shapes, or for links (no unknown): they have no strains."""

    refusal = "kernel.modal.shapes-no-strains"

    def layout(self, zone: Zone) -> Layout:
        """ALFA or BETA."""
        unknowns = (UNKNOWN[zone.element],) if is_shape(zone) else ()
        return Layout(zone.cells.nodes, zone.cells.raw, np.arange(len(unknowns)), unknowns)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """Refused: `shape_matrix` makes the mass of all shapes together."""
        raise self.no_strains()


register_family("shape", _ShapeFamily())
register_family("link", _ShapeFamily())


def is_shape(zone: Zone) -> bool:
    """Whether a zone stands for a mode or a static shape."""
    return zone.element in UNKNOWN


@dataclass(frozen=True, eq=False)
class ShapePoint:
    """One shape of a model: its node, unknown, field, and what it was made with."""

    node: int
    unknown: str
    field: NodeField
    frequency: float  # of modes (0 for static shapes)
    mass: float
    damping: float  # over sqrt(k m): twice the reduced one of a mode
    push: NodeField | None  # stiffness of the body times the shape (RIDE)
    inertia: NodeField | None  # mass of the body times the shape (MADE)


def shape_points(zones: tuple[Zone, ...], material: CellField) -> list[ShapePoint]:
    """The shapes of the zones MODAL and STATIQUE among these, in order.

    Raises
    ------
    MaterialError
        For a missing parameter.
    """
    return [_shape_point(z, zone_field(z, material).own()) for z in zones if is_shape(z)]


def _shape_point(zone: Zone, given: ZoneField) -> ShapePoint:
    if len(zone.cells) != 1:
        told = {"behaviour": zone.behaviour[-1], "n_cells": len(zone.cells)}
        raise MaterialError("kernel.modal.model-stands-point-not", **told)
    modal = zone.element == "MODAL"
    needed = ("FREQ", "MASS", "DEFO") if modal else ("DEFO", "RIDE", "MADE")
    missing = [n for n in needed if n not in given]
    if missing:
        raise MaterialError(
            "kernel.modal.shape-needs", behaviour=zone.behaviour[-1], missing=missing
        )

    def number(name: str) -> float:
        return float(given.numbers(name)[0][0, 0]) if name in given else 0.0

    def of(name: str) -> NodeField | None:
        return given.raw(name)[0][0, 0] if name in given else None

    field = of("DEFO")
    assert field is not None
    node = int(zone.cells.connectivity[0, 0])
    return ShapePoint(
        node, UNKNOWN[zone.element], field, number("FREQ"), number("MASS"), number("AMOR"),
        of("RIDE"), of("MADE"),
    )  # fmt: skip


def _stiffness(a: ShapePoint, b: ShapePoint) -> float:
    """`a^T K b`: modes are orthogonal; a static shape has K b."""
    if b.push is not None:
        return work(b.push, a.field)
    return a.mass * eigenvalue(a.frequency) if a is b else 0.0


def _mass(a: ShapePoint, b: ShapePoint) -> float:
    if a.unknown == b.unknown == "ALFA":
        return a.mass if a is b else 0.0
    return 0.0 if b.inertia is None else work(b.inertia, a.field)


def _damping(a: ShapePoint, b: ShapePoint) -> float:
    """AMOR times `sqrt(k m)`: of a mode, twice its reduced damping."""
    return a.damping * np.sqrt(abs(_stiffness(a, a) * _mass(a, a))) if a is b else 0.0


_TERMS = {"RIGIDITE": _stiffness, "MASSE": _mass, "AMORTISSEMENT": _damping}


def shape_matrix(zones: tuple[Zone, ...], material: CellField, kind: str) -> ElementMatrices | None:
    """Matrix of all shapes among the zones; None if there is none.

    Parameters
    ----------
    kind : str
        'RIGIDITE', 'MASSE' or 'AMORTISSEMENT'.
    """
    shapes = shape_points(zones, material)
    if not shapes:
        return None
    m = len(shapes)
    values = np.zeros((m, m))
    for j, b in enumerate(shapes):
        # products with a mode's own K X are those of the other shape; of two static shapes the
        # first gives K X, which tells if its RIDE leaves reactions out
        for i, a in enumerate(shapes):
            if i == j or (b.unknown == "BETA" and (i > j or a.unknown == "ALFA")):
                values[i, j] = values[j, i] = _TERMS[kind](a, b)
    unknowns, nodes = [s.unknown for s in shapes], np.array([s.node for s in shapes])
    duals, table = [dual_of(u) for u in unknowns], zones[0].cells.nodes
    return ElementMatrices.of_one(table, nodes, unknowns, duals, values, kind)
