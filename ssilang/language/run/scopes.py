"""Names and what they stand for, procedure by procedure."""

from typing import Any, Protocol

from ssilang.language.run.not_built import NotBuilt
from ssilang.language.text.source import Span
from ssilang.language.values import ANNULE, Mot, Objet, Procedure

PREDEFINED: dict[str, Any] = {
    "VRAI": True,
    "FAUX": False,
    "PI": 3.141592653589793,
    "D": Mot("DROI"),
    "C": Mot("CERC"),
}
"""Names that a run begins with."""

_MISSING = object()
_UNREADABLE = (NotBuilt, type(ANNULE))


class Unread(Protocol):
    """Operands of a running phrase that nothing has read yet (a `Call`)."""

    operands: list[Any]
    span: Span

    def read(self, *types: str, after: int = -1) -> Any:
        """Take the first operand of one of the types, None if there is none."""


class Frame:
    """Variables of a running procedure (or of the script), over those of its caller.

    Scope is dynamic: a procedure sees the caller's names as they are when it is called; what it
    assigns stays its own. Names that begin with `!` are never inherited. What procedures of the
    library (`library`) call their own is hidden from those of the script that they call, and of
    the script's names they read its procedures alone: other names are words and operators there.
    """

    __slots__ = (
        "caller", "depth", "leaves", "library", "object", "outer", "pending", "procedure",
        "results", "variables",
    )  # fmt: skip

    def __init__(
        self,
        caller: "Frame | None" = None,
        procedure: str = "",
        pending: Unread | None = None,
        library: bool = False,
    ) -> None:
        self.variables: dict[str, Any] = {}
        self.caller = caller
        self.library = library
        self.outer = caller
        while not library and self.outer is not None and self.outer.library:
            self.outer = self.outer.caller
        self.leaves = library and self.outer is not None and not self.outer.library
        self.procedure = procedure
        self.pending = pending  # operands of the caller not read yet (ARGU)
        self.results: list[Any] = []  # RESP
        self.object: Objet | None = caller.object if caller is not None else None
        self.depth: int = caller.depth + 1 if caller is not None else 0

    def find(self, name: str) -> Any:
        """Value of a name, None if it was never assigned."""
        frame: Frame | None = self
        hidden = False  # what the script calls so, but for its procedures
        while frame is not None:
            value = frame.variables.get(name, _MISSING)
            if value is not _MISSING:
                shown = not hidden or isinstance(value, Procedure)
                return value if shown else PREDEFINED.get(name)
            if name[:1] == "!":
                return None
            hidden = hidden or frame.leaves
            frame = frame.outer
        return PREDEFINED.get(name) if hidden else None

    def assign(self, name: str, value: Any) -> None:
        """Bind a name here."""
        self.variables[name] = value

    def forget(self, name: str, hiding: bool) -> None:
        """Make a name ANNULE here (OUBL), or, at the top, the word again that it was hiding."""
        if self.caller is None and name in PREDEFINED:
            self.variables[name] = PREDEFINED[name]
        elif hiding and self.caller is None:
            self.variables.pop(name, None)
        else:
            self.variables[name] = ANNULE

    def names(self) -> set[str]:
        """All names of what exists, here and at those who call."""
        return set(self.named())

    def named(self) -> dict[str, Any]:
        """What these names stand for, in their order."""
        found: dict[str, Any] = {}
        frame: Frame | None = self
        while frame is not None:
            found = {**frame.variables, **found}
            frame = frame.outer
        return {n: found[n] for n in sorted(found) if type(found[n]) not in _UNREADABLE}
