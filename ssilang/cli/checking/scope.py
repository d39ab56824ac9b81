"""Names that a script has given values to, at a point of its text."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from ssilang.cli.checking.kinds import UNKNOWN, same
from ssilang.language.text import tree


@dataclass
class Scope:
    """Names and what is known of their values.

    Attributes
    ----------
    values : dict
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
