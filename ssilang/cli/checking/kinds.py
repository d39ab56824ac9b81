"""What is known before a script runs: a value's type or content, names that have values."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from ssilang.language.registry import ANY
from ssilang.language.run.not_built import NotBuilt
from ssilang.language.text import tree
from ssilang.language.values import Mot, type_of


class Ambiguous(Exception):
    """What happens next depends on a value that is not known."""


UNKNOWN: Any = object()
"""Any object, perhaps none."""
SOMETHING: Any = object()
"""Results of an operator that says nothing of their types: none is taken for a word."""


class AnyWord(Mot):
    """A MOT whose content is not known."""

    __slots__ = ()


ANY_WORD = AnyWord("?")


@cache
def known_model(words: tuple[str, ...]) -> Any:
    """A stand-in for a model of which the words behind MODE are known."""
    return type("MMODEL", (), {"__slots__": (), "words": words})()


_ACTIVE = frozenset({"PROCEDUR", "TEXTE", "ANNULE"})  # what they do depends on which one it is


@cache
def typed(word: str) -> Any:
    """A stand-in for an object of which only the type is known.

    `type_of` gives the name of its class.
    """
    if word == "MOT":
        return ANY_WORD
    if word in _ACTIVE:
        return UNKNOWN
    return type(word, (), {"__slots__": ()})() if word else UNKNOWN


def same(a: Any, b: Any) -> Any:
    """What is known of a value that may be one or the other."""
    if a is b or (type(a) is type(b) and isinstance(a, int | float | Mot) and a == b):
        return a
    ta, tb = kind_word(a), kind_word(b)
    return typed(ta) if ta and ta == tb and ta != "PROCEDUR" else UNKNOWN


def kind_word(value: Any) -> str:
    """Type word of a stand-in or value, '' when unknown."""
    known = value is not UNKNOWN and value is not SOMETHING and type(value) is not NotBuilt
    return type_of(value) if known else ""


def one_of(word: str) -> Any:
    """A stand-in for a result of type `word`, unknown where it may be of several types."""
    return UNKNOWN if word == ANY or "|" in word else typed(word)


@dataclass
class Scope:
    """Names and what is known of their values.

    Attributes
    ----------
    open : bool
        Other names may exist: a file was read, a name was computed, or a caller has them.
    dimension : int or None
        OPTI DIME, 0 before it is set, None where it is not known.
    """

    values: dict[str, Any] = field(default_factory=dict)
    open: bool = False
    dimension: int | None = 0
    inside: tuple[str, ...] = ()  # open loops and procedures, for QUIT and ITER

    def copy(self) -> "Scope":
        """The same knowledge, to go on with in a branch."""
        return Scope(dict(self.values), self.open, self.dimension, self.inside)

    def join(self, other: "Scope") -> None:
        """Keep what holds whichever of two branches was taken."""
        for name, value in other.values.items():
            mine = self.values.setdefault(name, UNKNOWN)
            if mine is not value:
                self.values[name] = same(mine, value)
        self.forget(self.values.keys() - other.values.keys())
        self.open = self.open or other.open
        if self.dimension != other.dimension:
            self.dimension = None

    def forget(self, names: Iterable[str]) -> None:
        """The values of these names are not known any more."""
        for name in names:
            self.values[name] = UNKNOWN


def assigned_names(nodes: Iterable[tree.Node]) -> set[str]:
    """Names that nodes give values to, those of nested blocks and procedures included."""
    found: set[str] = set()
    for node in nodes:
        if isinstance(node, tree.Statement):
            found |= {i.text for i in node.targets if isinstance(i, tree.Name)}
            if node.first_word[:4] in ("ACQU", "ARGU", "LIRE", "NOMM", "OBTE"):
                found |= {i.text for i in node.items[1:] if isinstance(i, tree.Name)}
        elif isinstance(node, tree.If):
            found |= assigned_names(node.then) | assigned_names(node.otherwise)
        elif isinstance(node, tree.Loop):
            found |= {("&" + node.name)[:n] for n in (8, 24)} | assigned_names(node.body)
        else:
            found |= {node.name, *(p.name for p in node.parameters)}
            found |= assigned_names(node.body)
    return found
