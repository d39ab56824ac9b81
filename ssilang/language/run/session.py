"""A session: everything that one run of scripts shares.

There is no other global state that a run changes, but for factors of matrices that a process may
keep from run to run (`kernel.solvers.backends.keep_factors`) and that change no answer.
"""

import sys
import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, TextIO

from ssilang.language.run.library import Library
from ssilang.language.run.scopes import PREDEFINED, Frame
from ssilang.language.say.errors import ReaderLeft, SsiError, unprinted
from ssilang.language.text import tree
from ssilang.language.text.source import Span
from ssilang.language.vocabulary.unit_systems import UnitSystem
from ssilang.messages.message import sentence, visible


@dataclass
class Limits:
    """What a run may use up; None means no limit."""

    recursion: int = 200
    statements: int | None = None


class LoopObserver(Protocol):
    """Is told of the REPE loops of a run."""

    def enter(self, name: str, limit: int | None) -> None:
        """A loop begins; `limit` is its number of turns, if it has one."""

    def turn(self, number: int) -> None:
        """The innermost loop begins a turn."""

    def leave(self) -> None:
        """The innermost loop ends."""


class Runner(Protocol):
    """What runs the statements of a session: its `Evaluator`."""

    current_span: Span | None
    statement_count: int

    def run(self, nodes: Sequence[tree.Node]) -> None:
        """Run nodes in order."""

    def run_top(self, nodes: Sequence[tree.Node]) -> None:
        """Run nodes that stand outside of any procedure."""

    def values_of(self, statement: tree.Statement) -> list[Any]:
        """Results of a statement without names on its left, or the object it names."""

    def word_of_entry(self, statement: tree.Statement, error: SsiError) -> Any:
        """The word that a declared entry takes where an operator of that name found nothing."""

    def operands_of(self, items: Sequence[tree.Item]) -> list[Any]:
        """Operands of items: names replaced by their objects, parentheses run."""

    def refuse_leftovers(self, left: Sequence[Any], taken: Sequence[Any] = ()) -> None:
        """Raise the error for operands that nothing read, if there are any."""

    def unread(self, statement: tree.Statement, left: Sequence[Any]) -> Any:
        """The error or warning for what nothing reads in a statement without names."""

    def reduced(self, operands: Sequence[Any], span: Span) -> list[Any]:
        """Values that a phrase of these operands leaves."""

    def guarded(self, action: Callable[[], Any], span: Span | None, name: str) -> Any:
        """Run what an operator does; whatever it raises becomes an error of the script."""


@dataclass(frozen=True)
class Check:
    """A figure that a script reports (SORT 'BILA', @VERIFIE).

    Attributes
    ----------
    expected, tolerance : float or None
        None where nothing was expected.
    ok : bool or None
        Whether it is within its tolerance.
    """

    name: str
    value: float
    expected: float | None = None
    tolerance: float | None = None
    ok: bool | None = field(init=False)

    def __post_init__(self) -> None:
        wanted, most = self.expected, self.tolerance
        ok = None if wanted is None or most is None else abs(self.value - wanted) <= most
        object.__setattr__(self, "ok", ok)


@dataclass
class Session:
    """State of a run.

    Parameters
    ----------
    script_directory : Path
        Folder of the script: files are read below it.
    output_directory : Path
        Files are written below it.
    shared : Path, optional
        Folder of what runs of a sweep leave for each other.
    allowed : list of Path
        Further folders that may be read and written (`--allow`).
    out : text stream
        Where MESS and LIST print.
    workspace : object
        State of the operators (nodes, OPTI's options); made by the operators' package.
    make_point : function
        Turns numbers into a POINT, set by the operators' package.
    dimension : function
        Number of coordinates a point has (OPTI DIME), 0 before it is set.
    units : function
        The deck's units, OPTI 'UNIT'; None if it says nothing of them.
    flaw_of : function
        Code of the refusal of a value that no calculation can use, '' if there is none; set by
        the operators' package.
    apart : function
        The fields among operands that have no node of the model beside them; set likewise.
    follow : function
        Looks at each call of an operator, by its name, and at what it gave; set likewise.
    """

    script_directory: Path = field(default_factory=Path.cwd)
    output_directory: Path = field(default_factory=lambda: Path("results"))
    shared: Path | None = None
    allowed: list[Path] = field(default_factory=list)
    out: TextIO = field(default_factory=lambda: sys.stdout)
    language: str = "en"
    options: dict[str, Any] = field(default_factory=dict)
    limits: Limits = field(default_factory=Limits)
    workspace: Any = None
    make_point: Callable[[list[float]], Any] | None = None
    dimension: Callable[[], int] = lambda: 0
    units: Callable[[], UnitSystem | None] = lambda: None
    flaw_of: Callable[[Any], str] = lambda value: ""
    apart: Callable[[Sequence[Any]], list[Any]] = lambda values: []
    follow: Callable[[Any, str, Any], None] = lambda call, name, results: None
    warnings: list[Any] = field(default_factory=list)
    assignments: dict[str, Any] = field(default_factory=dict)  # name -> span of its first target
    checks: list[Check] = field(default_factory=list)
    statistics: dict[str, Any] = field(default_factory=dict)
    given: dict[str, Any] = field(default_factory=dict)  # replaces a name's first assignment
    started: float = field(default_factory=time.perf_counter)
    calls: dict[str, int] = field(
        default_factory=dict
    )  # how often operators ran, since TEMP 'ZERO'
    evaluator: Runner = field(init=False)  # puts itself here

    def __post_init__(self) -> None:
        self.root = Frame()
        for name, value in PREDEFINED.items():
            self.root.assign(name, value)
        self.frame = self.root
        self.library = Library(self.script_directory, self.allowed)

    def print(self, text: str = "") -> None:
        """Print a line of results."""
        try:
            self.out.write(visible(text) + "\n")
        except BrokenPipeError as closed:
            raise ReaderLeft from closed
        except OSError as problem:
            raise unprinted(problem) from problem

    def told(self, code: str, /, **data: object) -> str:
        """A text of the catalogue in the language of the run."""
        return sentence(code, data, self.language)

    def warn(self, code: str, span: Any = None, /, **data: object) -> None:
        """Report a warning: kept for the summary, shown by the renderer that listens."""
        warning = SsiError(code, span or self.evaluator.current_span, **data)
        warning.warns = True
        self.report(warning)

    def warned(self, code: str, /, **data: object) -> bool:
        """Whether a warning with these data, among others, has been told."""
        return any(w.code == code and data.items() <= w.data.items() for w in self.warnings)

    def report(self, warning: Any) -> None:
        """Keep a warning, or an error that does not stop the run, and show it.

        One of inside a procedure of the library stands where the script calls it.
        """
        if warning.span is not None:
            warning.span = self.own_place(warning.span)
        self.warnings.append(warning)
        if self.on_warning is not None and not _heard(self.on_warning, warning):
            self.on_warning = None  # nobody can be told; it is in the summary

    @property
    def in_library(self) -> bool:
        """Whether a procedure of the library runs: its numbers are not the script's own."""
        return self.frame.procedure in self.library.standard_names

    def own_place(self, place: Span) -> Span:
        """A place in what runs, as the script's own line: not one of the library."""
        frame = self.frame
        while frame.pending is not None and frame.procedure in self.library.standard_names:
            place = frame.pending.span
            assert frame.caller is not None
            frame = frame.caller
        return place

    def doubt(self, level: int = 1) -> None:
        """Raise the flag that SOUC reads: it only grows."""
        self.options["SOUC"] = max(int(self.options.get("SOUC", 0)), level)

    def note(self, text: str) -> None:
        """Say what a calculation does, to who asked to hear it."""
        if self.on_note is not None and not _heard(self.on_note, text):
            self.on_note = None

    on_warning: Callable[[Any], object] | None = None
    on_note: Callable[[str], object] | None = None
    was_interrupted: Callable[[], bool] = lambda: False  # a signal came that nobody has seen
    hold: Callable[[], AbstractContextManager[None]] = nullcontext  # keeps a signal out meanwhile
    loops: LoopObserver | None = None
    on_form: Callable[[Any, Any, Any], object] | None = None  # told of each form that runs


def _heard(listener: Callable[[Any], object], said: object) -> bool:
    """Tell a listener; whether its stream took it."""
    try:
        listener(said)
    except BrokenPipeError as closed:
        raise ReaderLeft from closed
    except OSError:
        return False
    return True
