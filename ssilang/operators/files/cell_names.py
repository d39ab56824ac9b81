"""What a script calls the cells that go to a VTK file: meshes and models by their names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ssilang.io.vtk.labels import Labels, labels_of
from ssilang.kernel.materials.model import Model
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.language.run.session import Session
from ssilang.language.values import Table

_PARTS = (Mesh, Model, Point, str)


def cell_labels(session: Session, parts: Mapping[str, Mesh]) -> dict[str, Labels]:
    """Labels of the cells of named parts.

    `group` is the smallest mesh with a name in the script that has the cell, `material` the
    smallest such model, `part` which of several parts.
    """
    groups: dict[str, tuple[CellBlock, ...]] = {}
    materials: dict[str, tuple[CellBlock, ...]] = {}
    for name, value in _named(session):
        if isinstance(value, Mesh):
            groups.setdefault(name, value.blocks)
        elif isinstance(value, Model):
            materials.setdefault(name, tuple(zone.cells for zone in value.zones))
    told = {"group": groups, "material": materials}
    return {
        name: labels_of(mesh, told, (i, name) if len(parts) > 1 else None)
        for i, (name, mesh) in enumerate(parts.items(), start=1)
    }


def _named(session: Session) -> Iterator[tuple[str, Any]]:
    """Objects by their names, then those of tables by theirs."""
    frame = session.frame
    found = [(name, frame.find(name)) for name in sorted(frame.names())]
    yield from found
    for _, value in found:
        # those that are made as they are asked for hold none, nor do those of other entries
        if type(value) is Table and all(isinstance(v, _PARTS) for _, v in value.items()):
            for index, held in value.items():
                if isinstance(index, str):
                    yield index.strip(), held
