"""What goes wrong, for Python: one exception with code, place and message."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from ssilang.language.say.diagnostics import render, sentence
from ssilang.language.say.errors import SsiError


@dataclass(frozen=True)
class Notice:
    """One error, warning or note of a script.

    Attributes
    ----------
    code : str
        Which it is, the same in every language and version: 'unknown-operator'.
    severity : 'error', 'warning' or 'note'
    text, hint : str
        What is wrong, and what to change ('' if nothing is known).
    file : str
        The script, '' where the notice has no place.
    line, column : int
        From 1; 0 where it has no place.
    message : str
        All of it, with the line of the script, as the command line prints it.
    """

    code: str
    severity: str
    text: str
    hint: str
    file: str
    line: int
    column: int
    message: str

    @classmethod
    def of(cls, error: SsiError, language: str = "en", names: Iterable[str] = ()) -> "Notice":
        """The notice of a script's error; `names` are those that it may have meant."""
        text, hint = sentence(error, language, names)
        file, line, column = "", 0, 0
        if error.span is not None:
            file = error.span.source.name
            line, column = error.span.source.position(error.span.start)
        message = render(error, language, names)
        return cls(error.code, error.severity, text, hint, file, line, column, message)

    def __str__(self) -> str:
        return self.message


class Error(Exception):
    """A script, or what was asked of its results, is wrong.

    Its text is what the command line prints: the sentence, the place in the script, what to do.

    Attributes
    ----------
    notices : tuple of Notice
        All errors: a script that cannot be read may have several.
    code, hint, file, line, column
        Of the first of them, as `Notice` has them.
    result : Result or None
        What the run had when it ended: what it printed, the objects it made.

    Examples
    --------
    >>> import ssilang
    >>> try:
    ...     ssilang.run("X = PROG 1. 2. ;\\nY = MAXI (X + 'a') ;")
    ... except ssilang.Error as error:
    ...     print(error.code, error.line, error.column)
    ...     print(error.result["X"])
    no-rule 2 11
    [1. 2.]
    """

    def __init__(self, notices: Sequence[Notice], result: Any = None) -> None:
        super().__init__("\n\n".join(n.message for n in notices))
        self.notices, self.result = tuple(notices), result
        first = self.notices[0]
        self.code, self.hint = first.code, first.hint
        self.file, self.line, self.column = first.file, first.line, first.column

    def __reduce__(self) -> tuple[type["Error"], tuple[object, ...]]:
        return type(self), (self.notices,)  # from another process without what the run had

    def __str__(self) -> str:
        return str(self.args[0])


class MissingKey(Error, KeyError):
    """A name or an index that is not there; the message says which one is near."""


class MissingLibrary(Error, ImportError):
    """A library that is not installed; the message has the line that installs it."""


def refused(code: str, language: str = "en", kind: type[Error] = Error, /, **data: object) -> Error:
    """The error of a code and its data, which has no place in a script."""
    return kind([Notice.of(SsiError(code, None, **data), language)])
