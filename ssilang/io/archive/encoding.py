"""Objects turned into JSON and arrays."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.archive.classes import class_name, packing_of, saved_fields
from ssilang.kernel.mesh.nodes import NodeTable


class Encoder:
    """Collects objects; each is stored once, however many refer to it.

    What `encode` returns stands for the value: a JSON scalar for itself, a list whose first item
    says what it is for the others: ["o", n] object number n, ["a", n] array, ["l" | "t", items]
    list and tuple, ["d", pairs] mapping, ["e", class, name] enumeration, ["m", text] text of a
    class of words.
    """

    def __init__(self) -> None:
        self.objects: list[Any] = []
        self.arrays: list[NDArray[Any]] = []
        self._kept: dict[int, tuple[Any, list[Any]]] = {}  # the value is held so that its id is
        self._changing: list[int] = []

    def begin_record(self) -> None:
        """Forget objects that can change, so that the next record holds their present state."""
        for key in self._changing:
            self._kept.pop(key, None)
        self._changing = []

    def held(self) -> set[int]:
        """Identities of the objects that are stored."""
        return set(self._kept)

    def encode(self, value: Any) -> Any:
        """The code of a value.

        Raises
        ------
        OutputError
            For an object that cannot be saved.
        """
        if value is None or type(value) in (bool, int, float, str):
            return value
        if isinstance(value, np.generic):
            return value.item()
        if id(value) in self._kept:
            return self._kept[id(value)][1]
        if isinstance(value, Enum):
            return ["e", class_name(type(value)), value.name]
        if isinstance(value, np.ndarray):
            return self._array(value)
        if isinstance(value, list | tuple):
            kind = "t" if isinstance(value, tuple) else "l"
            return [kind, [self.encode(v) for v in value]]
        if isinstance(value, Mapping):
            return ["d", [[self.encode(k), self.encode(v)] for k, v in value.items()]]
        return self._object(value)

    def _array(self, value: NDArray[Any]) -> list[Any]:
        if value.dtype == object:
            items = [self.encode(v) for v in value.ravel()]
            return ["ao", list(value.shape), items]
        self.arrays.append(value.copy())
        return ["a", len(self.arrays) - 1]

    def _object(self, value: Any) -> list[Any]:
        number = len(self.objects)
        self.objects.append(None)
        reference = ["o", number]
        self._kept[id(value)] = (value, reference)
        packing = packing_of(type(value))
        if packing is not None:
            tag, how = packing
            if how.mutable:
                self._changing.append(id(value))
            self.objects[number] = [tag, self.encode(how.pack(value))]
        elif isinstance(value, NodeTable):
            self._changing.append(id(value))
            self.objects[number] = ["nodes", self._nodes(value)]
        else:
            name = class_name(type(value))
            parts = {f: self.encode(getattr(value, f)) for f in saved_fields(type(value))}
            self.objects[number] = [name, parts]
        return reference

    def _nodes(self, table: NodeTable) -> list[Any]:
        ids = np.arange(len(table), dtype=np.int64)
        return [self._array(a) for a in (table.coordinates, table.density, table.resolve(ids))]
