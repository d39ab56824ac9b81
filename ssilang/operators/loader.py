"""Loads operators: each when it is first looked for, or all of them.

Which module brings which operator, form, sign or way of printing is found out by a whole load and
kept for later starts, with the times of change of all modules.
"""

import importlib
import os
import pkgutil
from collections.abc import Iterator
from functools import cache

import ssilang.operators as package
from ssilang.language.filled import Filled, Index
from ssilang.language.values import name_types
from ssilang.remembered import remembered

name_types(
    {
        "ssilang.kernel.mesh.mesh:Point": "POINT",
        "ssilang.kernel.mesh.mesh:Mesh": "MAILLAGE",
        "ssilang.kernel.fields.node_field:NodeField": "CHPOINT",
        "ssilang.kernel.fields.cell_field:CellField": "MCHAML",
        "ssilang.kernel.materials.model:Model": "MMODEL",
        "ssilang.kernel.matrices.matrix:Matrix": "RIGIDITE",
        "ssilang.kernel.curves.curve:Curve": "EVOLUTIO",
        "ssilang.kernel.curves.curve:Load": "CHARGEME",
        "ssilang.kernel.curves.cloud:Cloud": "NUAGE",
        "ssilang.kernel.matrices.superelement:SuperElement": "SUPERELE",
        "ssilang.kernel.fields.deformed:Deformed": "DEFORME",
        "ssilang.kernel.fields.deformed:Arrows": "VECTEUR",
        "ssilang.io.plots.labels:Annotation": "ANNOTATI",
        "ssilang.operators.session.configurations:Configuration": "CONFIGUR",
    }
)


@cache
def load_operators() -> None:
    """Load all operators, once; modules import heavy libraries only inside their functions."""
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        importlib.import_module(module.name)


@cache
def prepare_operators() -> None:
    """Have each operator loaded when it is first looked for; without an index load them all.

    Only a load that begins with nothing shows in which order forms stand: a program that has
    imported operators before loads all and keeps nothing.
    """
    if any(index_of_all().values()):
        load_operators()
        return
    # names, times and sizes tell of a change of any module
    tables = remembered("operators", " ".join(_stamps(package.__path__[0])), _index)
    modules = [f"{package.__name__}.{name}" for name in tables.pop("modules")]
    Filled.expect(
        {
            name: {_key(key): tuple(modules[i] for i in fillers) for key, fillers in entries}
            for name, entries in tables.items()
        }
    )


def _key(key: str | list[str]) -> str | tuple[str, ...]:
    return key if isinstance(key, str) else tuple(key)


def _index() -> dict[str, object]:
    """The index, its modules as numbers."""
    load_operators()
    found = index_of_all()
    names = sorted({m for entries in found.values() for order in entries.values() for m in order})
    number = {name: i for i, name in enumerate(names)}
    tables: dict[str, object] = {
        name: [[key, [number[m] for m in order]] for key, order in entries.items()]
        for name, entries in found.items()
    }
    return tables | {"modules": [n.removeprefix(f"{package.__name__}.") for n in names]}


def index_of_all() -> Index:
    """Modules of this package that have filled each key of each table, in their order."""
    found: dict[str, dict[object, tuple[str, ...]]] = {}
    for name, table in Filled.tables.items():
        orders = {key: table.in_order(key) for key in table.fillers}
        ours = {k: tuple(m for m in v if m.startswith(package.__name__)) for k, v in orders.items()}
        found[name] = {key: order for key, order in ours.items() if order}
    return found


def _stamps(folder: str) -> Iterator[str]:
    for entry in sorted(os.scandir(folder), key=lambda e: e.name):
        if entry.is_dir():
            yield from _stamps(entry.path)
        elif entry.name.endswith(".py"):
            found = entry.stat()
            yield f"{entry.name} {found.st_mtime_ns} {found.st_size}"
