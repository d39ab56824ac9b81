"""Objects of the language itself: words, texts, lists, tables, procedures; and the type words.

ENTIER, FLOTTANT and LOGIQUE are Python's int, float and bool. Classes of the kernel become
objects of the language by `name_types`, which needs their names alone.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Sized
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.language.text.tree import Definition, Item
from ssilang.messages.message import name_of_type


class Mot(str):
    """A word (MOT). Trailing blanks do not count in comparisons made by the language."""

    __slots__ = ()


class Texte:
    """A macro (TEXTE): items that are put where its name stands and evaluated there.

    `targets` are the names in front of its `=`: such a text is run where it stands alone.
    """

    __slots__ = ("items", "targets")

    def __init__(self, items: tuple[Item, ...], targets: tuple[Item, ...] = ()) -> None:
        self.items, self.targets = items, targets


class Annule:
    """What a missing optional argument is (ANNULE)."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "ANNULE"


ANNULE = Annule()


class _Items:
    """A list of the language: `values`, in their order."""

    __slots__ = ("values",)

    def __init__(self, values: Iterable[Any] = ()) -> None:
        self.values: Any = list(values)

    def __len__(self) -> int:
        return len(self.values)


class ListReel(_Items):
    """LISTREEL: `values`, array (n,) of float. REMP changes it in place."""

    __slots__ = ()

    def __init__(self, values: object = ()) -> None:
        self.values: NDArray[np.float64] = np.atleast_1d(np.array(values, dtype=float))

    @classmethod
    def of(cls, values: NDArray[np.float64]) -> "ListReel":
        """A list that is this array (n,), which nobody else holds."""
        made = cls.__new__(cls)
        made.values = values
        return made


class ListEnti(_Items):
    """LISTENTI: `values`, array (n,) of int."""

    __slots__ = ()

    def __init__(self, values: object = ()) -> None:
        self.values: NDArray[np.int64] = np.atleast_1d(np.array(values, dtype=np.int64))


class ListMots(_Items):
    """LISTMOTS: `values`, a list of words."""

    __slots__ = ()

    def __init__(self, values: Iterator[str] | list[str] | tuple[str, ...] = ()) -> None:
        self.values = [Mot(v) for v in values]

    def extended(self, words: list[Mot]) -> "ListMots":
        """A new list with `words` behind those of this one."""
        made = ListMots()
        made.values = [*self.values, *words]
        return made


class ListChpo(_Items):
    """LISTCHPO: a list of nodal fields."""

    __slots__ = ()


class ListObje(_Items):
    """LISTOBJE: a list of objects of one type (ENUM)."""

    __slots__ = ()


def key_of(index: object) -> tuple[object, ...]:
    """Dictionary key of a table index: type matters (1 and 1. differ), objects by identity."""
    if isinstance(index, str):
        return ("M", index.rstrip())
    if isinstance(index, bool):
        return ("L", index)
    if isinstance(index, int):
        return ("E", index)
    if isinstance(index, float):
        return ("F", index)
    identity = getattr(index, "identity", None)
    return ("O", id(index)) if identity is None else ("O", type(index).__name__, identity)


class Table:
    """TABLE: indices of any type to values of any type; shared, never copied by assignment."""

    __slots__ = ("_items",)

    def __init__(self, subtype: str = "") -> None:
        self._items: dict[tuple[object, ...], tuple[object, object]] = {}
        if subtype:
            self.set(Mot("SOUSTYPE"), Mot(subtype))

    @classmethod
    def of(
        cls, entries: Mapping[Any, object] | Iterable[tuple[Any, object]], subtype: str = ""
    ) -> "Table":
        """A table of values by index (a mapping, or pairs), a string being a word."""
        table = cls(subtype)
        for index, value in entries.items() if isinstance(entries, Mapping) else entries:
            table.set(Mot(index) if isinstance(index, str) else index, value)
        return table

    @classmethod
    def numbered(cls, values: Iterable[object], subtype: str = "") -> "Table":
        """A table of values at 1, 2 ..."""
        return cls.of(enumerate(values, start=1), subtype)

    def _key(self, index: object) -> tuple[object, ...]:
        """Key of an index, or that by which an object went before it was merged with another."""
        key = key_of(index)
        if key[0] == "O" and key not in self._items:
            former = ((*key[:2], identity) for identity in getattr(index, "former", ()))
            return next((k for k in former if k in self._items), key)
        return key

    def get(self, index: object, default: object = None) -> object:
        """Value at an index, `default` if there is none."""
        pair = self._items.get(self._key(index))
        return default if pair is None else pair[1]

    def set(self, index: object, value: object) -> None:
        """Create or replace a value."""
        self._items[self._key(index)] = (index, value)

    def inner(self, word: str) -> "Table":
        """The table at a word, made where none stands there."""
        found = self.get(word)
        if not isinstance(found, Table):
            self.set(Mot(word), found := Table())
        return found

    def has(self, index: object) -> bool:
        """Whether the index exists."""
        return self._key(index) in self._items

    def remove(self, index: object) -> None:
        """Forget an index; nothing happens if it does not exist."""
        self._items.pop(self._key(index), None)

    def indices(self) -> list[object]:
        """Indices, in order of creation; no value is made for them."""
        return [index for index, _ in self._items.values()]

    def waiting(self, index: object) -> object:
        """Value at an index, None if there is none; PENDING where it waits to be made."""
        return self._items.get(key_of(index), (None, None))[1]

    def items(self) -> list[tuple[object, object]]:
        """Pairs (index, value), in order of creation."""
        return list(self._items.values())

    @property
    def subtype(self) -> str:
        """The word at index SOUSTYPE, '' if none."""
        value = self.get("SOUSTYPE")
        return str(value).rstrip() if isinstance(value, str) else ""

    def __len__(self) -> int:
        return len(self._items)


PENDING = object()


class LazyTable(Table):
    """TABLE some of whose values are found when they are first asked for, by index.

    `promised` are pairs (index, PENDING) by key, that many tables may share. `stand_in` gives
    what serves instead of a value that is not made yet, for readers that know it (None: nothing
    does).
    """

    __slots__ = ("_find", "_stand_in")

    def __init__(
        self,
        find: Callable[[str], object],
        promised: dict[tuple[object, ...], tuple[object, object]],
        stand_in: Callable[[str, Callable[[], object]], object] | None = None,
    ) -> None:
        self._items, self._find, self._stand_in = promised.copy(), find, stand_in

    def glance(self, index: object, default: object = None) -> object:
        """As `get`; of a value that is not made yet, its stand-in if it has one."""
        pair = self._items.get(key_of(index))
        if pair is None or pair[1] is not PENDING:
            return default if pair is None else pair[1]
        if self._stand_in is not None:
            found = self._stand_in(str(index).rstrip(), lambda: self.get(index))
            if found is not None:
                return found
        return self.get(index)

    def get(self, index: object, default: object = None) -> object:
        """Value at an index, `default` if there is none."""
        value = super().get(index, default)
        if value is PENDING:
            value = self._find(str(index).rstrip())
            self.set(index, value)
        return value

    def items(self) -> list[tuple[object, object]]:
        """Pairs (index, value), in order of creation."""
        return [(index, self.get(index)) for index, _ in self._items.values()]


class LazyRows(Table):
    """TABLE whose entries 1, 2 ... are tables made of their rows when they are first asked for.

    `make` turns a row into its table; `rows` holds those that nobody asked for, by index.
    `stand_ins` gives what serves instead of the values at an index of entries none of which is
    made yet, and their times, for readers that know it (None: nothing does). `source` holds rows
    by their places from 0, that stand before all others; they are listed when someone asks for one.
    """

    __slots__ = ("_make", "_source", "_words", "rows", "stand_ins")

    def __init__(
        self,
        make: Callable[[Any], Table],
        words: dict[tuple[object, ...], tuple[object, object]],
        stand_ins: Callable[[str], tuple[Sequence[Any], Any] | None],
        source: Sized = (),
    ) -> None:
        super().__init__()
        self._make, self._words, self.stand_ins = make, words, stand_ins
        self._source: Sized | None = source
        self.rows: dict[int, Any] = {}

    @property
    def untouched(self) -> bool:
        """Whether no entry was made or replaced yet, and nothing else was put in."""
        waits = self._source is not None and len(self._source) > 0
        return waits or 0 < len(self.rows) == len(self._items)

    def _list(self) -> None:
        """Rows of the source as entries."""
        if self._source is not None and len(self._source):
            source, self._source = self._source, None
            for place in range(len(source)):
                self.append(place)

    def append(self, row: Any) -> None:
        """One more entry."""
        index = len(self._items) + 1
        self._items["E", index] = (index, PENDING)
        self.rows[index] = row

    @property
    def words(self) -> list[str]:
        """Indices of its entries, none of which is made for that."""
        return [str(index).rstrip() for index, _ in self._words.values()]

    def promises(self, index: object) -> bool:
        """Whether there are entries not made yet, that will hold the index."""
        waits = self._source is not None and len(self._source) > 0
        return (waits or bool(self.rows)) and key_of(index) in self._words

    def get(self, index: object, default: object = None) -> object:
        """Value at an index, `default` if there is none."""
        if type(index) is int:
            self._list()
        value = super().get(index, default)
        return self._made(index) if value is PENDING else value

    def has(self, index: object) -> bool:
        """Whether the index exists."""
        self._list()
        return super().has(index)

    def __len__(self) -> int:
        self._list()
        return super().__len__()

    def indices(self) -> list[object]:
        """Indices, in order of creation; no value is made for them."""
        self._list()
        return super().indices()

    def set(self, index: object, value: object) -> None:
        """Create or replace a value."""
        self._list()
        self._forget(index)
        super().set(index, value)

    def remove(self, index: object) -> None:
        """Forget an index; nothing happens if it does not exist."""
        self._list()
        self._forget(index)
        super().remove(index)

    def items(self) -> list[tuple[object, object]]:
        """Pairs (index, value), in order of creation."""
        self._list()
        for index in list(self.rows):
            self._made(index)
        return super().items()

    def _forget(self, index: object) -> None:
        if type(index) is int:
            self.rows.pop(index, None)

    def _made(self, index: Any) -> Table:
        made = self._make(self.rows.pop(index))
        Table.set(self, index, made)
        return made


def promises(*words: str) -> dict[tuple[object, ...], tuple[object, object]]:
    """What a `LazyTable` is told to find."""
    return {key_of(Mot(word)): (Mot(word), PENDING) for word in words}


@dataclass(frozen=True, eq=False)
class Solution:
    """Modes, each a table as those of a table BASE_DE_MODES."""

    modes: tuple[Table, ...]

    @property
    def table(self) -> Table:
        """They as a table BASE_DE_MODES."""
        return Table.numbered(self.modes, "BASE_DE_MODES")


class Procedure:
    """PROCEDUR: a definition; `origin` says where it came from (script, stdlib)."""

    __slots__ = ("definition", "name", "origin")

    def __init__(self, name: str, definition: Definition, origin: str = "script") -> None:
        self.name = name
        self.definition = definition
        self.origin = origin


class Objet:
    """OBJET: attributes and methods (OBJE, DEBM)."""

    __slots__ = ("attributes", "class_name", "methods")

    def __init__(self, class_name: str = "") -> None:
        self.class_name = class_name
        self.attributes: dict[object, object] = {}
        self.methods: dict[str, Procedure] = {}


_TYPE_WORDS: dict[type, str] = {
    bool: "LOGIQUE",
    int: "ENTIER",
    float: "FLOTTANT",
    Mot: "MOT",
    str: "MOT",
    Texte: "TEXTE",
    Solution: "SOLUTION",
    Annule: "ANNULE",
    ListReel: "LISTREEL",
    ListEnti: "LISTENTI",
    ListMots: "LISTMOTS",
    ListChpo: "LISTCHPO",
    ListObje: "LISTOBJE",
    Table: "TABLE",
    Procedure: "PROCEDUR",
    Objet: "OBJET",
}


_NAMED: dict[str, str] = {}
"""Further classes by module and name, 'ssilang.kernel.mesh.mesh:Mesh', so that none is imported."""


def name_types(words: Mapping[str, str]) -> None:
    """Make classes objects of the language: by 'module:Class' their type, 8 characters at most."""
    _NAMED.update(words)


def _word_of(cls: type) -> str | None:
    """Type word of a class itself."""
    word = _TYPE_WORDS.get(cls)
    if word is None:
        word = _NAMED.get(f"{cls.__module__}:{cls.__qualname__}")
        if word is not None:
            _TYPE_WORDS[cls] = word
    return word


def type_of(value: object) -> str:
    """Type word of a value, such as 'MAILLAGE' (not blank-padded)."""
    word = _TYPE_WORDS.get(type(value))
    if word is not None:
        return word
    for cls in type(value).__mro__:
        word = _word_of(cls)
        if word is not None:
            return word
    return type(value).__name__.upper()[:8]


name_of_type.append(type_of)


def known_types() -> frozenset[str]:
    """All type words."""
    return frozenset({*_TYPE_WORDS.values(), *_NAMED.values()})


def words_of_classes() -> dict[str, str]:
    """Type words by the name of a class."""
    named = {name.partition(":")[2]: word for name, word in _NAMED.items()}
    return {cls.__name__: word for cls, word in _TYPE_WORDS.items()} | named


def normalised(value: object) -> object:
    """The language's form of what an operator returned (numpy scalars, plain strings)."""
    if isinstance(value, np.generic):
        value = value.item()
    if type(value) is str:
        return Mot(value)
    return value


MAY_BE_EMPTY = frozenset(
    ("MAILLAGE", "CHPOINT", "MCHAML", "MMODEL", "RIGIDITE", "EVOLUTIO", "CHARGEME", "LISTREEL",
     "LISTENTI", "LISTMOTS", "LISTCHPO", "LISTOBJE", "TABLE")
)  # fmt: skip
"""Types of objects that scripts build up from nothing."""
_HOLDERS = ("blocks", "relations", "components", "zones", "parts", "categories", "tags")


_PI_BY_HAND = {round(part * np.pi, digits) for part in (0.5, 1, 2) for digits in range(2, 7)}


def like_radians(value: Any) -> float:
    """The largest of numbers in degrees that are all multiples of pi/1000, 0 if they are not.

    Of a number alone, half of pi, pi and twice pi count as one writes them too: 1.57, 3.1416.

    Degrees are never such numbers by chance: they were meant in radians.
    """
    if not isinstance(value, float | ListReel):
        return 0.0
    if isinstance(value, float) and abs(value) in _PI_BY_HAND:
        return abs(value)
    numbers = value.values if isinstance(value, ListReel) else np.array([value])
    turns = np.abs(numbers) * (1000.0 / np.pi)
    whole = turns.size and np.all(np.abs(turns - np.round(turns)) < 1e-7)
    return float(turns.max()) * np.pi / 1000.0 if whole and 0.5 < turns.max() < 1e6 else 0.0


def is_of_noughts(value: Any) -> bool:
    """Whether it is a curve that is zero all along."""
    parts = getattr(value, "parts", ()) if type_of(value) == "EVOLUTIO" else ()
    return bool(parts) and not any(p.words or p.ordinates.any() for p in parts)


def is_empty(value: Any) -> bool:
    """Whether an object holds nothing: a mesh no cell, a field no component, a list no item."""
    if hasattr(value, "n_cells"):
        return bool(value.n_cells == 0)
    held = [getattr(value, name) for name in _HOLDERS if hasattr(value, name)]
    return not any(map(len, held)) if held else len(value) == 0
