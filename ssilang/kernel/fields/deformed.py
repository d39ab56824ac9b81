"""Deformed shapes and arrows: what DEFO and VECT make and TRAC draws."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.kernel.mesh.mesh import Mesh


@dataclass(frozen=True, eq=False)
class ArrowPart:
    """Arrows of one kind and colour.

    Parameters
    ----------
    origins : array (n, 3)
        Where they stand.
    vectors : array (n, 3)
        In the unit of the field.
    nodes : array (n,) of int, or None
        Nodes they stand at, so that they follow a deformed shape; None if they do not.
    scale : float or None
        Length drawn per unit; negative: the tip is at the origin. None: chosen by the picture.
    colour : int
    name : str
        What they show, such as 'FX FY'.
    heads : bool
        False for strokes without a head, centred on the origin (principal values).
    """

    origins: FloatArray
    vectors: FloatArray
    nodes: IntArray | None = None
    scale: float | None = None
    colour: int = 0
    name: str = ""
    heads: bool = True


@dataclass(frozen=True, eq=False)
class Arrows:
    """A set of arrows (VECTEUR)."""

    parts: tuple[ArrowPart, ...]


@dataclass(frozen=True, eq=False)
class DeformedPart:
    """A mesh moved by `scale` times a displacement.

    Parameters
    ----------
    scale : float or None
        None: chosen by the picture.
    colour : int or None
        None: the mesh's own colours.
    arrows : Arrows or None
        Drawn on the moved mesh.
    field : NodeField or CellField, or None
        Drawn as iso-values on the moved mesh; `model` says where a CellField stands.
    """

    mesh: Mesh
    displacement: NodeField
    scale: float | None = None
    colour: int | None = None
    arrows: Arrows | None = None
    field: NodeField | CellField | None = None
    model: Model | None = None


@dataclass(frozen=True, eq=False)
class Deformed:
    """Deformed shapes drawn together (DEFORME)."""

    parts: tuple[DeformedPart, ...]


def displacements(field: NodeField, ids: IntArray | None = None) -> FloatArray:
    """Displacements (n, 3) of nodes (n,), by default all of the field's table; 0 where not given.

    Their components are UX UY UZ, or UR UZ where there is UR: along the first two coordinates.
    """
    nodes = np.arange(len(field.table)) if ids is None else ids
    moved = np.zeros((len(nodes), 3))
    for axis, name in enumerate(moving_components(field)):
        moved[:, axis] = field.values_at(name, nodes)
    return moved


def moving_components(field: NodeField) -> tuple[str, ...]:
    """Names of the displacements along the coordinates."""
    return ("UR", "UZ") if "UR" in field.components else ("UX", "UY", "UZ")


def automatic_scale(mesh: Mesh, field: NodeField, share: float = 0.1) -> float:
    """Amplification that makes the largest displacement `share` of the mesh's size.

    Rounded to one of 1, 2, 5 times a power of ten; 1 for a zero displacement or mesh.
    """
    ids = mesh.sorted_node_ids
    if len(ids) == 0:
        return 1.0
    size = float(np.ptp(mesh.nodes.coordinates[ids], axis=0).max())
    largest = float(np.linalg.norm(displacements(field, ids), axis=1).max())
    return round_down(share * size / largest) if largest > 0.0 and size > 0.0 else 1.0


def round_down(x: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that does not exceed x > 0."""
    power = 10.0 ** np.floor(np.log10(x))
    return float(power * max(m for m in (1.0, 2.0, 5.0) if m * power <= x * (1 + 1e-12)))
