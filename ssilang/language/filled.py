"""Tables that modules fill while they are imported: operators, what signs do, how types print.

An index tells which modules fill which key. Where there is one, these modules are imported when the
key is first looked for; without one a table holds what was imported, whoever did it.
"""

import sys
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from importlib import import_module
from typing import Any, ClassVar, TypeVar

from ssilang.late_imports import lasting

K = TypeVar("K")
V = TypeVar("V")

Index = Mapping[str, Mapping[Any, tuple[str, ...]]]
"""Modules by name of a table and key, in the order in which what they bring stands there."""


class Filled(MutableMapping[K, V]):
    """A table that modules fill.

    Attributes
    ----------
    fillers : dict
        Modules that have filled each key so far, in order.
    """

    tables: ClassVar[dict[str, "Filled[Any, Any]"]] = {}
    index: ClassVar[Index] = {}

    def __init__(self, name: str) -> None:
        self._items: dict[K, V] = {}
        self.fillers: dict[K, list[str]] = {}
        self._order: Mapping[K, tuple[str, ...]] = self.index.get(name, {})
        self._waiting = dict(self._order)
        self.tables[name] = self

    @classmethod
    def expect(cls, index: Index) -> None:
        """Import modules when a key of theirs is looked for, from now on."""
        cls.index = index
        for name, table in cls.tables.items():
            table._order = index.get(name, {})
            table._waiting = dict(table._order)

    def note(self, key: K) -> str:
        """Note that the module being imported fills a key; its name."""
        # The module that is being imported and asks for this, directly or through functions.
        frame = sys._getframe(1)
        while frame.f_back is not None and frame.f_code.co_name != "<module>":
            frame = frame.f_back
        module = str(frame.f_globals.get("__name__", ""))
        known = self.fillers.setdefault(key, [])
        if module not in known:
            known.append(module)
        return module

    def entry(self, *keys: K) -> Callable[[V], V]:
        """Decorator: what stands under some keys."""

        def add(value: V) -> V:
            for key in keys:
                self[key] = value
            return value

        return add

    def in_order(self, key: K) -> tuple[str, ...]:
        """Modules that have filled a key, in the order in which what they bring stands there."""
        return tuple(self.fillers[key])

    def rank(self, key: K, module: str) -> int:
        """Place among the modules that fill a key, behind those that the index knows if unknown."""
        order = self._order.get(key, ())
        return order.index(module) if module in order else len(order)

    def _fill(self, key: K) -> None:
        with lasting():
            for module in self._waiting[key]:
                import_module(module)
        self._waiting.pop(key, None)  # a module may itself have looked for it

    def _fill_all(self) -> None:
        for key in list(self._waiting):
            if key in self._waiting:
                self._fill(key)

    def get(self, key: K, default: V | None = None) -> V | None:  # type: ignore[override]
        """What stands under a key."""
        if key in self._waiting:
            self._fill(key)
        return self._items.get(key, default)

    def __getitem__(self, key: K) -> V:
        if key in self._waiting:
            self._fill(key)
        return self._items[key]

    def __setitem__(self, key: K, value: V) -> None:
        self.note(key)
        self._items[key] = value

    def __delitem__(self, key: K) -> None:
        del self._items[key]
        self.fillers.pop(key, None)

    def __contains__(self, key: object) -> bool:
        return key in self._items or key in self._waiting

    def __iter__(self) -> Iterator[K]:
        self._fill_all()
        return iter(self._items)

    def __len__(self) -> int:
        self._fill_all()
        return len(self._items)
