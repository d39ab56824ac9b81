"""Objects made again from a save file."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.archive.classes import NODE_FIELDS, class_named, packing_named, saved_fields
from ssilang.io.archive.container import DAMAGES, Archive, Record
from ssilang.io.archive.soundness import flaw_of
from ssilang.io.errors import InputError
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.mesh.nodes import NodeTable


class Decoder:
    """Makes the objects of a file over the nodes of a session.

    The nodes of the file are appended to those that the session has; node numbers shift by as
    many.

    Parameters
    ----------
    archive : Archive
    nodes : NodeTable
        Of the session.
    """

    def __init__(self, archive: Archive, nodes: NodeTable) -> None:
        self._archive = archive
        self._nodes = nodes
        self._shift = len(nodes)
        self._made: dict[int, Any] = {}
        self._added = 0
        self._named: list[NDArray[Any]] = []  # node numbers of objects

    def decode(self, code: Any) -> Any:
        """The value that a code stands for.

        Raises
        ------
        InputError
            If the file is damaged.
        """
        if not isinstance(code, list):
            return code
        try:
            return self._decoded(code)
        except KernelError:
            raise
        except DAMAGES as error:
            raise InputError("io.damaged", name=self._archive.path.name, error=error) from error

    def named(self, records: Iterable[Record]) -> list[tuple[str, Any]]:
        """Names of records with their objects, all of them read and all of their nodes there.

        Raises
        ------
        InputError
            If the file is damaged.
        """
        found = [(name, self.decode(c)) for r in records for name, c in r.names.items()]
        for numbers in self._named:
            if numbers.size and not 0 <= numbers.min() <= numbers.max() < len(self._nodes):
                raise self._unfit("nodes", "node numbers")
        return found

    def _decoded(self, code: list[Any]) -> Any:
        kind, what = code[0], code[1]
        if kind == "o":
            return self._object(what)
        if kind == "a":
            return self._archive.array(what)
        if kind == "l":
            return [self.decode(v) for v in what]
        if kind == "t":
            return tuple(self.decode(v) for v in what)
        if kind == "d":
            return {self.decode(k): self.decode(v) for k, v in what}
        if kind == "e":
            cls = class_named(what)
            if not issubclass(cls, Enum):
                raise self._unfit("class", what)
            return cls[code[2]]
        if kind == "ao":
            made = np.empty(int(np.prod(what)), dtype=object)
            made[:] = [self.decode(v) for v in code[2]]
            return made.reshape(what)
        raise InputError("io.holds-unknown-kind-data", name=self._archive.path.name, kind=kind)

    def _object(self, number: int) -> Any:
        if number in self._made:
            return self._made[number]
        name, parts = self._archive.objects[number]
        if name == "nodes":
            self._made[number] = self._table(parts)
        elif ":" in name:
            self._made[number] = self._instance(name, parts)
        else:
            packing = packing_named(name)
            if packing.fill is None:
                self._made[number] = packing.make(self.decode(parts))
            else:
                # known before its content is read: it may hold itself
                made = self._made[number] = packing.make(None)
                packing.fill(made, self.decode(parts))
        return self._made[number]

    def _instance(self, name: str, parts: dict[str, Any]) -> Any:
        cls = class_named(name)
        known = set(saved_fields(cls))
        values = {k: self.decode(v) for k, v in parts.items() if k in known}
        if (flaw := flaw_of(cls, values)) != "":
            raise self._unfit(cls.__name__, flaw)
        for field in NODE_FIELDS.get(cls.__name__, ()):
            if values.get(field) is not None:
                values[field] = values[field] + self._shift
                self._named.append(np.asarray(values[field]))
        return cls(**values)

    def _unfit(self, kind: str, part: str) -> InputError:
        name = self._archive.path.name
        return InputError("io.damaged-object", name=name, kind=kind, part=part)

    def _table(self, parts: list[Any]) -> NodeTable:
        """The session's table, with the nodes of the file that it has not yet."""
        coordinates, density, alias = (self.decode(p) for p in parts)
        count = len(density)
        sizes = coordinates.shape == (count, 3) and alias.shape == density.shape == (count,)
        if not sizes or alias.dtype.kind not in "iu" or not np.isfinite(coordinates).all():
            raise self._unfit("nodes", "coordinates")
        if not ((alias >= 0) & (alias < count)).all() or (alias[alias] != alias).any():
            raise self._unfit("nodes", "alias")
        fresh = slice(self._added, len(density))
        self._nodes.add(coordinates[fresh], density[fresh])
        self._added = max(self._added, len(density))
        dropped = np.flatnonzero(alias != np.arange(len(alias)))
        self._nodes.merge(alias[dropped] + self._shift, dropped + self._shift)
        return self._nodes
