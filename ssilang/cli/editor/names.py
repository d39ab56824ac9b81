"""Names of a script: where they get values, where they are read, what is defined in what."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from ssilang.cli.editor.tokens import BEGINS, Kind, Name, Phrase


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A name at a place of the text.

    Attributes
    ----------
    scope : int
        Which procedure of the script it stands in, counted from 1; 0 outside of all.
    whole : Phrase
        The statement around it.
    """

    name: str
    start: int
    end: int
    scope: int
    kind: Kind
    defines: bool
    whole: Phrase


@dataclass(frozen=True)
class Names:
    """The names of a script: those that get a value somewhere, procedures, loops."""

    phrases: Sequence[Phrase]

    @cached_property
    def found(self) -> tuple[Occurrence, ...]:
        """All occurrences, in the order of the text."""
        defined = self.defined
        return tuple(
            _occurrence(name, scope, phrase)
            for phrase, scope in self._scopes
            for name in phrase.cut.names
            if name.name in defined
        )

    @cached_property
    def defined(self) -> frozenset[str]:
        """What gets a value anywhere."""
        return frozenset(name for _, name in self._first)

    def at(self, offset: int) -> Occurrence | None:
        """The name under the cursor."""
        if (standing := self._standing(offset)) is None:
            return None
        phrase, scope = standing
        for name in phrase.cut.names:
            if name.start <= offset - phrase.start <= name.end and name.name in self.defined:
                return _occurrence(name, scope, phrase)
        return None

    def scope_at(self, offset: int) -> int:
        """Which procedure of the script an offset stands in, 0 if none."""
        if (standing := self._standing(offset)) is None:
            return 0
        phrase, scope = standing
        return 0 if phrase.cut.first_word in BEGINS.values() and phrase.end <= offset else scope

    def _standing(self, offset: int) -> tuple[Phrase, int] | None:
        """The last statement that begins at an offset or before it, and its procedure."""
        i = bisect_right(self._scopes, offset, key=lambda place: place[0].start)
        return self._scopes[i - 1] if i else None

    def alike(self, of: Occurrence) -> list[Occurrence]:
        """All occurrences of what a name means: of a procedure's own name within it only."""
        owner = self._owner(of)
        return [o for o in self.found if o.name == of.name and self._owner(o) == owner]

    def definitions(self, of: Occurrence) -> list[Occurrence]:
        """Where the thing gets values."""
        return [o for o in self.alike(of) if o.defines]

    def visible(self, scope: int) -> dict[str, Occurrence]:
        """First definitions of the names that can be read in a scope, its own before others."""
        seen: dict[str, Occurrence] = {}
        for own in (True, False):
            for (owner, name), place in self._first.items():
                if name not in seen and (owner == scope if own else owner == 0):
                    seen[name] = _occurrence(*place)
        return seen

    @cached_property
    def _first(self) -> dict[tuple[int, str], tuple[Name, int, Phrase]]:
        """Where each name that something owns gets its first value."""
        first: dict[tuple[int, str], tuple[Name, int, Phrase]] = {}
        for phrase, scope in self._scopes:
            for name in phrase.cut.defined:
                owner = 0 if name.heading else scope
                if (owner, name.name) not in first:
                    first[owner, name.name] = name, scope, phrase
        return first

    def _owner(self, o: Occurrence) -> int:
        """The procedure that a name belongs to, 0 for the script's own."""
        return o.scope if (o.scope, o.name) in self._first and o.kind != "procedure" else 0

    @cached_property
    def _scopes(self) -> list[tuple[Phrase, int]]:
        """Each statement, and the procedure that it stands in."""
        found, scope, count = [], 0, 0
        for phrase in self.phrases:
            word = phrase.cut.first_word
            if word in BEGINS:
                scope = count = count + 1
            found.append((phrase, scope))
            if word in BEGINS.values():
                scope = 0
        return found


def _occurrence(name: Name, scope: int, phrase: Phrase) -> Occurrence:
    at, scope = phrase.start, 0 if name.heading else scope
    start, end = at + name.start, at + name.end
    return Occurrence(name.name, start, end, scope, name.kind, name.defines, phrase)
