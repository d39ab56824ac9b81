"""Errors of scripts: a code and data; the catalogue turns them into sentences."""

from ssilang.language.text.source import Span
from ssilang.messages.message import Said, Severity, find
from ssilang.system import system_reason


class SsiError(Exception):
    """Something wrong in a script, at a place in it.

    Parameters
    ----------
    code : str
        Key of the catalogue of messages, such as 'unknown-operator'.
    span : Span or None
        Where; None is filled with the running statement.
    **data
        What the message needs: expected, found, name, near, ...
    """

    def __init__(self, code: str, span: Span | None, /, **data: object) -> None:
        super().__init__(code)
        self.code = code
        self.span = span
        self.data = data
        self.warns = False  # told as a warning where the catalogue has an error
        self.calls: list[tuple[str, Span]] = []  # procedures that led here, innermost first

    @classmethod
    def of(cls, problem: Said, span: Span | None, **more: object) -> "SsiError":
        """The error of a script for what something below it refused."""
        return cls(problem.code, span, **{**more, **problem.data})

    @property
    def severity(self) -> Severity:
        """'warning' if it only asks for attention, else 'error'."""
        own = find(self.code).severity
        return "warning" if self.warns and own == "error" else own

    def __str__(self) -> str:
        return f"{self.code}: {self.data}"


class Interrupted(KeyboardInterrupt):
    """Ctrl-C inside a procedure: `error` says where, with the chain of calls."""

    def __init__(self, error: SsiError) -> None:
        super().__init__()
        self.error = error


def interruption(stop: KeyboardInterrupt, span: Span | None) -> SsiError:
    """The error of a Ctrl-C: that of the innermost procedure, or a new one at `span`."""
    return stop.error if isinstance(stop, Interrupted) else SsiError("interrupted", span)


def unprinted(problem: OSError) -> SsiError:
    """The error of a stream that takes nothing more: a full disk, a stream that is closed."""
    return SsiError("cannot-print", None, reason=system_reason(problem))


class ReaderLeft(BrokenPipeError):
    """Nobody reads any more what the run prints: it ends, without a message."""


class SeveralErrors(Exception):
    """All syntax errors of one script."""

    def __init__(self, errors: list[SsiError]) -> None:
        super().__init__(f"{len(errors)} errors")
        self.errors = errors
