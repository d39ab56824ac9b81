"""What sound statements give, remembered from one check of a text to the next.

An editor checks a text after each key, and all of it but a statement or two is what it was. What a
statement gives depends on its own text and on what is known of the names in it, and on nothing
else: where both are the same, it is not read again. Only statements without a problem are
remembered, so that no place and no sentence of an older text can come back; and only those that the
last check met, so that what is remembered never grows beyond a text.
"""

from collections.abc import Hashable, Iterable
from typing import Any

from ssilang.cli.checking.kinds import Scope
from ssilang.language.run.library import Library
from ssilang.language.run.session import Session
from ssilang.language.text import tree
from ssilang.language.values import Mot, Procedure, Texte

Values = list[Any] | None
"""What the names of a statement get, None where that is not known."""

_Words = tuple[tuple[str, ...], tuple[str, ...]]


class SoundStatements:
    """Statements of one script, by their text and what is known where they stand.

    Attributes
    ----------
    library : Library or None
        Procedures that the last check has read.
    """

    def __init__(self) -> None:
        self.library: Library | None = None
        self._before: dict[Hashable, Values] = {}
        self._now: dict[Hashable, Values] = {}
        self._words: dict[str, _Words] = {}

    def begin(self, session: Session) -> None:
        """Another check begins: what the last one did not meet is forgotten."""
        if self.library is not None:
            self.library.look_again()
            session.library = self.library
        self.library = session.library
        self._before, self._now = self._now, {}
        texts = {key[0] for key in self._before if isinstance(key, tuple)}
        self._words = {text: words for text, words in self._words.items() if text in texts}

    def key(self, statement: tree.Statement, scope: Scope, library: Library) -> Hashable:
        """All that decides what a statement gives.

        Raises
        ------
        SsiError
            A procedure that it names stands in a file which cannot be read.
        """
        span = statement.span
        text = span.source.code[span.start : span.end]
        words = self._words.get(text)
        if words is None:
            paths = (t for t in statement.targets if not isinstance(t, tree.Name))
            words = self._words[text] = _words_of((*paths, *statement.items))
        values = scope.values
        known = [
            _known(values[name] if name in values else library.find(name)) for name in words[0]
        ]
        held = [word in values for word in words[1]]
        return text, *known, *held, scope.open, scope.dimension

    def find(self, key: Hashable) -> tuple[Values] | None:
        """What a statement was found to give, in a tuple; None if it is to be read."""
        values = self._before.get(key, _MISSING)
        if values is _MISSING:
            values = self._now.get(key, _MISSING)
        if values is _MISSING:
            return None
        self._now[key] = values
        return (values,)

    def keep(self, key: Hashable, values: Values) -> None:
        """Remember a statement without a problem."""
        if not any(isinstance(v, Procedure | Texte) for v in values or ()):
            self._now[key] = values


_MISSING: Any = object()


def _known(value: Any) -> Any:
    """What a check can know of a value, so that the same knowledge compares equal."""
    if isinstance(value, Procedure):  # made anew with each text
        asked = value.definition.parameters
        return value.name, *((p.name, p.type, p.optional, p.subtype) for p in asked)
    if isinstance(value, int | float | Mot):
        return type(value), value
    return value if type(value).__hash__ is not None else object()


def _words_of(items: Iterable[tree.Item]) -> _Words:
    """Names in a statement, and the quoted words, which may be names too."""
    leaves = list(tree.leaves(items))
    names = {item.text for item in leaves if isinstance(item, tree.Name)}
    quoted = {item.text.upper() for item in leaves if isinstance(item, tree.Quoted)}
    return tuple(sorted(names)), tuple(sorted(quoted))
