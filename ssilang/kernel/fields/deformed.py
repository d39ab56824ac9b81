"""Deformed shapes and arrows: what DEFO and VECT make and TRAC draws.

Arrows made from fields: at nodes, in cells, principal values.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
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


def automatic_scale(mesh: Mesh, field: NodeField) -> float:
    """Amplification that makes the largest displacement a tenth of the mesh's size.

    Rounded to one of 1, 2, 5 times a power of ten; 1 for a zero displacement or mesh.
    """
    ids = mesh.sorted_node_ids
    if len(ids) == 0:
        return 1.0
    size = float(np.ptp(mesh.nodes.coordinates[ids], axis=0).max())
    largest = float(np.linalg.norm(displacements(field, ids), axis=1).max())
    return round_down(0.1 * size / largest) if largest > 0.0 and size > 0.0 else 1.0


def round_down(x: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that does not exceed x > 0."""
    power = 10.0 ** np.floor(np.log10(x))
    return float(power * max(m for m in (1.0, 2.0, 5.0) if m * power <= x * (1 + 1e-12)))


Columns = tuple[str, str, str]
_PRINCIPAL = ("SI11", "SI22", "SI33")
_USUAL = (2, 4, 1)  # red, green, blue


def arrows_at_nodes(
    field: NodeField, columns: Columns, scale: float | None = None, colour: int = 0
) -> Arrows:
    """Arrows of the components `columns` along x, y, z ('' for none) at their nodes."""
    present = [field.components[c].nodes for c in columns if c in field.components]
    ids = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *present]))
    vectors = np.column_stack([field.values_at(c, ids) for c in columns])
    name = " ".join(c for c in columns if c in field.components)
    where = field.table.coordinates[ids]
    return Arrows((ArrowPart(where, vectors, ids, scale, colour, name),))


def arrows_in_cells(
    field: CellField, columns: Columns, scale: float | None = None, colour: int = 0
) -> Arrows:
    """Arrows of the mean of `columns` along x, y, z in the middle of each cell.

    Raises
    ------
    FieldError
        If no block has one of the components.
    """
    parts = []
    for block in field.blocks:
        if not any(c in block.components for c in columns):
            continue
        vectors = np.column_stack([_mean(block, c) for c in columns])
        name = " ".join(c for c in columns if c)
        parts.append(ArrowPart(_centres(block), vectors, None, scale, colour, name))
    if not parts:
        raise FieldError("kernel.fields.field-none-components", columns=columns)
    return Arrows(tuple(parts))


def principal_strokes(
    field: CellField,
    scale: float | None = None,
    chosen: tuple[str, ...] = (),
    colours: tuple[int, ...] = (),
) -> Arrows:
    """Strokes along the principal directions in the middle of each cell.

    Parameters
    ----------
    field : CellField
        Principal stresses as PRIN gives them: values SI11 SI22 SI33, directions COX1 COY1 COZ1,
        COX2 ..., or stresses SMXX ... themselves.
    chosen : tuple of str
        Of SI11, SI22, SI33; all when empty. SI11 is the largest.
    colours : tuple of int
        Of the strokes of SI11, SI22, SI33; red, green and blue when empty.

    Raises
    ------
    FieldError
        If the field holds neither.
    """
    names = chosen or _PRINCIPAL
    shade = dict(zip(names, (*colours, *_USUAL[len(colours) :]), strict=False))
    tensors = [(b, t) for b in field.blocks if (t := _tensor(b)) is not None]
    if not tensors:
        raise FieldError("kernel.fields.field-holds-no-principal")
    parts = []
    for block, tensor in tensors:
        values, directions = np.linalg.eigh(tensor)
        for rank, name in enumerate(_PRINCIPAL):
            if name not in shade:
                continue
            column = 2 - rank  # eigh sorts upwards
            vectors = directions[:, :, column] * values[:, column, None]
            if np.any(vectors):
                parts.append(
                    ArrowPart(_centres(block), vectors, None, scale, shade[name], name, False)
                )
    return Arrows(tuple(parts))


def _tensor(block: CellFieldBlock) -> FloatArray | None:
    """Mean stress tensor of each cell, shape (n, 3, 3); None if the block has none."""
    parts = block.components
    if "SI11" in parts:
        total: Any = 0.0
        for i in (1, 2, 3):
            value = _values(block, f"SI{i}{i}")
            d = np.stack([_values(block, f"CO{axis}{i}") for axis in "XYZ"], axis=-1)
            total = total + value[..., None, None] * d[..., :, None] * d[..., None, :]
        return np.asarray(total.mean(axis=1))
    for names in (
        ("SMXX", "SMYY", "SMZZ", "SMXY", "SMXZ", "SMYZ"),
        ("SMRR", "SMZZ", "SMTT", "SMRZ", "SMRT", "SMZT"),
    ):
        if names[0] in parts:
            a, b, c, ab, ac, bc = (_mean(block, n) for n in names)
            rows = [np.stack(r, axis=-1) for r in ((a, ab, ac), (ab, b, bc), (ac, bc, c))]
            return np.stack(rows, axis=-2)
    return None


def _values(block: CellFieldBlock, name: str) -> FloatArray:
    """Values of a component (n, p), zero if it is absent."""
    found = block.components.get(name)
    if found is None:
        return np.zeros((len(block.cells), 1))
    return np.asarray(found, dtype=float)


def _mean(block: CellFieldBlock, name: str) -> FloatArray:
    mean: FloatArray = _values(block, name).mean(axis=1)
    return np.broadcast_to(mean, (len(block.cells),))


def _centres(block: CellFieldBlock) -> FloatArray:
    return block.cells.coordinates.mean(axis=1)
