"""What TRAC is given, turned into the layers of a picture."""

from dataclasses import dataclass, field, replace

import numpy as np

from ssilang.io.plots.labels import Annotation, Category
from ssilang.io.plots.layers import Layer
from ssilang.io.plots.values import component_names
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.deformed import (
    Arrows,
    Deformed,
    DeformedPart,
    automatic_scale,
)
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.boundary import contour, sharp_edges
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

_MOST_PANELS = 4
_GREY = 15


@dataclass
class Subjects:
    """Objects of one picture.

    Attributes
    ----------
    meshes : list of Mesh
        Without a field all are drawn; with a nodal field the first carries it and the others are
        outlines; with a field in cells all are outlines.
    """

    meshes: list[Mesh] = field(default_factory=list)
    deformed: Deformed | None = None
    arrows: Arrows | None = None
    values: NodeField | CellField | None = None


@dataclass
class Composition:
    """Layers, arrows that stand still, components (one panel each), notes under the picture.

    `legend` says what the colours of several deformed shapes stand for.
    """

    layers: list[Layer]
    arrows: Arrows | None = None
    components: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    legend: Annotation = field(default_factory=Annotation)


def compose(subjects: Subjects) -> Composition:
    """The layers that show the objects."""
    made = Composition([], subjects.arrows)
    if subjects.deformed is not None:
        parts = with_scales(subjects.deformed.parts)
        if subjects.values is not None:
            parts = parts[:1]
        made.legend = _legend(parts)
        made.notes = () if made.legend.categories else _amplifications(parts)
    else:
        parts = ()
    if subjects.values is not None:
        _add_field(made, subjects, parts[0] if parts else None)
    elif parts:
        for part in parts:
            _add_deformed(made, part)
        _add_initial(made, parts)
        made.layers += [Layer(m, outline=True) for m in subjects.meshes]
    else:
        # the first mesh is the object, those behind it are lines over it
        made.layers = [Layer(m, outline=i > 0) for i, m in enumerate(subjects.meshes)]
    return made


def with_scales(parts: tuple[DeformedPart, ...]) -> tuple[DeformedPart, ...]:
    """The parts with an amplification each: one for all those that have none."""
    open_parts = [p for p in parts if p.scale is None]
    if not open_parts:
        return parts
    usual = min(automatic_scale(p.mesh, p.displacement) for p in open_parts)
    return tuple(replace(p, scale=usual) if p.scale is None else p for p in parts)


def _amplifications(parts: tuple[DeformedPart, ...]) -> tuple[str, ...]:
    scales = sorted({p.scale for p in parts if p.scale})
    if not scales:
        return ()
    return ("amplification " + ", ".join(f"{s:.4g}" for s in scales),)


def _legend(parts: tuple[DeformedPart, ...]) -> Annotation:
    """The amplification of each colour, where several shapes are told apart by theirs."""
    seen = {p.colour: p.scale or 0.0 for p in parts}
    one_each = all(seen[p.colour] == (p.scale or 0.0) for p in parts)
    if len(seen) < 2 or None in seen or not one_each:
        return Annotation()
    return Annotation(tuple(Category(c or 0, f"amplification {s:.4g}") for c, s in seen.items()))


def _add_field(made: Composition, subjects: Subjects, moved: DeformedPart | None) -> None:
    values = subjects.values
    assert values is not None
    meshes = list(subjects.meshes)
    if isinstance(values, CellField):
        blocks: dict[int, CellBlock] = {id(b.cells): b.cells for b in values.blocks}
        first = next(iter(blocks.values()))
        mesh = Mesh(first.nodes, tuple(blocks.values()))
    elif moved is not None:
        mesh = moved.mesh
    else:
        mesh = meshes.pop(0) if meshes else poi1(values.table, values.node_ids)
    names = _present(values, mesh)
    displacement, scale = (moved.displacement, moved.scale or 0.0) if moved else (None, 0.0)
    if isinstance(values, NodeField) and 1 < len(names) <= _MOST_PANELS:
        made.components = names
    made.layers.append(
        Layer(
            mesh,
            displacement,
            scale,
            field=values,
            component=names[0] if names else "",
            arrows=moved.arrows if moved else None,
            edges=not meshes,
        )
    )
    made.layers += [Layer(m, displacement, scale, outline=True) for m in meshes]


def _present(values: NodeField | CellField, mesh: Mesh) -> tuple[str, ...]:
    """Components that have a value on the mesh (multipliers have none), or all if none has."""
    names = component_names(values)
    if isinstance(values, CellField):
        return names
    ids = mesh.sorted_node_ids
    found = tuple(n for n in names if np.isin(values.components[n].nodes, ids).any())
    return found or names


def _add_deformed(made: Composition, part: DeformedPart) -> None:
    names = component_names(part.field) if part.field is not None else ()
    made.layers.append(
        Layer(
            part.mesh,
            part.displacement,
            part.scale or 0.0,
            part.colour,
            part.field,
            names[0] if names else "",
            part.arrows,
        )
    )


def _add_initial(made: Composition, parts: tuple[DeformedPart, ...]) -> None:
    """The contour before deformation in grey, unless the script draws it itself."""
    if any(not p.scale for p in parts):
        return
    seen: dict[int, Mesh] = {id(p.mesh): p.mesh for p in parts}
    for mesh in seen.values():
        made.layers.insert(0, Layer(_outline(mesh), colour=_GREY, outline=True))


def _outline(mesh: Mesh) -> Mesh:
    """Lines that show a mesh without its cells."""
    if mesh.dimension < 2:
        return mesh
    return contour(mesh) if mesh.dimension == 2 else sharp_edges(mesh)
