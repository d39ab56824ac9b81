"""Runs a script from its file or text: the session, the outputs, the messages, the exit code."""

import io
import os
import re
import sys
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from numbers import Number
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from ssilang import __version__, private
from ssilang.cli.interrupts import ENDED_BY_CLOSED_PIPE, holding, take
from ssilang.cli.terminal.loop_progress import follow_loops
from ssilang.cli.terminal.screen import coloured
from ssilang.io.errors import InputError, OutputError
from ssilang.language.run.jumps import StopRun
from ssilang.language.run.session import Limits, Session
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import (
    ReaderLeft,
    SeveralErrors,
    SsiError,
    interruption,
    unprinted,
)
from ssilang.language.search import SHORT_LIKE, nearest
from ssilang.language.text import tree
from ssilang.language.text.source import Source, Span
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import first_assignments, given_again
from ssilang.language.values import Mot
from ssilang.messages.message import sentence
from ssilang.operators.files.outputs import run_output
from ssilang.operators.workspace import open_session, workspace

if TYPE_CHECKING:
    from ssilang.io.checkpoint import Deck

_FEW = 2  # times that a loop warns of the same with other figures
_NAMED = 20  # names of a script that a message lists


@dataclass
class RunResult:
    """How a run ended.

    Attributes
    ----------
    exit_code : int
        0 fine, 1 the script failed.
    output : str
        What MESS and LIST printed, when the run was told to keep it.
    message : str
        The rendered errors.
    session : Session
        With all objects of the script, in `session.root`.
    seconds : float
        What it took, without what it left to others.
    """

    exit_code: int
    session: Session
    output: str = ""
    seconds: float = 0.0
    errors: list[SsiError] = field(default_factory=list)
    message: str = ""


@dataclass
class RunOptions:
    """What the command line sets for a run."""

    output_directory: Path | None = None
    allowed: list[Path] = field(default_factory=list)
    language: str = "en"
    debug: bool = False
    quiet: bool = False
    verbose: bool = False  # say by which method each calculation is done
    summary: bool = False  # write summary.json into the output folder
    report: bool = False  # write report.html too, and the summary
    limits: Limits = field(default_factory=Limits)
    given: dict[str, Any] = field(default_factory=dict)  # name -> value, `--set`
    resume: bool = False  # go on from what an earlier run of the deck kept
    on_form: Callable[[Any, Any, Any], object] | None = None  # told of each form that runs
    petsc: str = field(default_factory=lambda: os.environ.get("SSILANG_PETSC", ""))
    """What starts PETSc, '' if there is none."""
    shared: Path | None = None  # what all runs of a sweep share


def make_session(source: Source, options: RunOptions, out: TextIO) -> Session:
    """A session with all operators, ready to run `source`."""
    folder = source.path.parent if source.path is not None else Path.cwd()
    case = source.path.stem if source.path is not None else "session"
    target = options.output_directory or Path("results") / case
    session = open_session(
        Session(
            script_directory=folder,
            output_directory=target,
            shared=options.shared,
            allowed=options.allowed,
            out=out,
            language=options.language,
            limits=options.limits,
            given={k: Mot(v) if isinstance(v, str) else v for k, v in options.given.items()},
            was_interrupted=take,
            hold=holding,
            on_form=options.on_form,
        )
    )
    if options.petsc:
        from ssilang.kernel.solvers.petsc.client import PetscServer

        workspace(session).petsc = PetscServer(options.petsc)
    return session


def allow_nesting(depth: int) -> None:
    """Let functions walk trees of blocks and parentheses nested some dozen times as deep."""
    sys.setrecursionlimit(max(sys.getrecursionlimit(), 60 * depth + 2000))


def execute(session: Session, source: Source) -> None:
    """Parse and run a source in a session.

    Raises
    ------
    SsiError, SeveralErrors
        What is wrong in the script.
    """
    allow_nesting(session.limits.recursion)  # before anything walks the tree
    script = session.evaluator.guarded(lambda: parse(source), None, source.name)
    try:
        session.assignments = first_assignments(script.body)
    except RecursionError:
        raise SsiError("nesting", None) from None
    for name in sorted(session.given.keys() - session.assignments.keys()):
        refuse_unknown(name, source, session.assignments)
        session.root.assign(name, session.given.pop(name))
    for again, told in values_lost(source, script.body, session.given):
        session.warn("cli.value-lost", again, **told)
    for left in (*script.warnings, *script.unclosed):
        session.report(left)
    try:
        session.evaluator.run_top(script.body)
        if script.unclosed:  # and no FIN was met in them
            raise SeveralErrors([SsiError(e.code, e.span, **e.data) for e in script.unclosed])
    except StopRun:
        return
    except SsiError as error:
        if error.span is None:
            error.span = session.evaluator.current_span
        raise


def values_lost(
    source: Source, body: tuple[tree.Node, ...], names: Iterable[str]
) -> Iterator[tuple[Span, dict[str, Any]]]:
    """Where a script gives names that are set from outside another value, and what tells it."""
    for name in names:
        if (again := given_again(body, name)) is not None:
            yield again, {"name": name, "line": source.position(again.start)[0]}


def refuse_unknown(name: str, source: Source, assigned: Iterable[str]) -> None:
    """Refuse a value given to a name that neither the script nor a procedure beside it has.

    Raises
    ------
    SsiError
        'cli.no-such-parameter'.
    """
    word = re.compile(rf"(?<![\w@!&]){re.escape(name)}(?!\w)", re.IGNORECASE)
    if word.search(source.code):
        return
    if source.path is not None:
        for path in source.path.parent.glob("@*"):
            if path.is_file() and word.search(read_source(path).code):
                return
    known = list(assigned)
    near = nearest(name, known, SHORT_LIKE)
    raise SsiError("cli.no-such-parameter", None, name=name, near=near, known=known[:_NAMED])


def phrase_values(session: Session, source: Source) -> list[Any]:
    """Run statements in a session; the values of the last one, if it assigns nothing.

    Raises
    ------
    SsiError, SeveralErrors
        What is wrong in them.
    """
    run = session.evaluator
    body = run.guarded(lambda: parse(source), None, source.name).body
    last = body[-1] if body else None
    shows = isinstance(last, tree.Statement) and not last.assigns
    try:
        run.run_top(body[:-1] if shows else body)
        if not isinstance(last, tree.Statement) or not shows:
            return []
        found: list[Any] = run.guarded(lambda: run.values_of(last), last.span, "")
    except StopRun:
        return []
    except SsiError as error:
        error.span = error.span or run.current_span
        raise
    return found


def run_source(source: Source, options: RunOptions, out: TextIO, err: TextIO) -> RunResult:
    """Run a source to its end, print what went wrong, write the summary."""
    session = make_session(source, options, out)
    shown: Counter[object] = Counter()  # a loop warns at each turn: what is the same shows once
    again: Counter[str] = Counter()

    def show(warning: SsiError) -> None:
        text, data = render(warning, session.language), warning.data.items()
        words = [f"{key} {value}" for key, value in data if not isinstance(value, Number)]
        same = warning.code, warning.span, *sorted(words)  # but for its figures: twice
        shown.update([text, same])
        if shown[text] > 1 or shown[same] > _FEW:
            again[warning.severity] += 1
            return
        err.write(coloured(text, err) + "\n")

    session.on_warning = show
    if options.verbose:
        session.on_note = lambda text: err.write(text + "\n")
    follow_loops(session, err)
    errors: list[SsiError] = []
    take()  # an interruption before this run is none of its own
    summary = options.summary or options.report
    link = None if options.output_directory else _link_to_results(session)
    try:
        if link is not None:
            raise SsiError("io.folder-is-link", None, path=link)
        if summary:  # it writes there in any case
            run_output(session).hold()
        keep_for(session, source, options)
        if options.report:
            _take_down(session, source)
        # no warnings of libraries, whoever runs the script: what matters to it is a message
        with warnings.catch_warnings(action=None if options.debug else "ignore"):
            execute(session, source)
    except SeveralErrors as several:
        errors = several.errors
    except SsiError as error:
        errors = [error]
    except (InputError, OutputError) as problem:  # of the folder
        errors = [SsiError.of(problem, None)]
    except KeyboardInterrupt as stop:
        errors = [interruption(stop, session.evaluator.current_span)]
        _tell_checkpoints(session)
    except ReaderLeft:
        errors = [SsiError("reader-left", session.evaluator.current_span)]
    _end_petsc(session)
    _tell_refused_folders(session)
    if options.verbose:
        _tell_plain_numba(session)

    refused = link is not None or any(e.code == "io.folder-in-use" for e in errors)
    if not refused:
        with session.hold():  # files end whole
            _end_recording(session, errors)
            _close_files(session, errors)
            if not errors:
                run_output(session).forget_checkpoints()  # the deck came to its end
    _flush(out, errors)
    left = any(e.code == "reader-left" for e in errors)
    names = session.frame.names() | session.library.standard_names
    message = "\n\n".join(render(e, session.language, names) for e in errors)
    if not left:
        _tell(errors, coloured(message, err), options.debug, err)
    code = ENDED_BY_CLOSED_PIPE if left else 1 if errors else 0
    seconds = time.perf_counter() - session.started
    result = RunResult(code, session, errors=errors, message=message, seconds=seconds)
    if not refused:
        _tell_imbalance(session)
    gone = any(e.code == "io.output-folder-gone" for e in errors)
    if summary and not refused and not gone:  # what stands there is another's
        _summarise(result, source, err, options.quiet, again["warning"])
        if options.report:
            _report(result, err, options.quiet)
    run_output(session).release()
    return result


def _link_to_results(session: Session) -> Path | None:
    """A link where results go that the user has not named: nothing is written where it leads."""
    from ssilang.io.run_output import link_to

    named, used = Path.cwd() / session.output_directory, run_output(session).directory
    return None if used == named else link_to(Path(session.output_directory)) or used


def _take_down(session: Session, source: Source) -> None:
    """Let the run take down what its report shows."""
    from ssilang.io.recording import FOLDER, Recording

    output = run_output(session)
    if (output.directory / FOLDER).is_symlink():
        raise SsiError("io.folder-is-link", None, path=output.directory / FOLDER)
    told = {"name": source.name, "text": source.text, "language": session.language}
    output.recording = Recording(output.directory / FOLDER, told)


def _end_recording(session: Session, errors: list[SsiError]) -> None:
    """Write what was taken down, also of a run that failed; what cannot be written is an error."""
    output = run_output(session)
    if output.recording is None:
        return
    from ssilang.operators.dynamics.recorded_shapes import record_shapes

    try:
        record_shapes(session, output.recording)
        output.wrote(output.recording.write())
    except OutputError as problem:
        errors.append(SsiError.of(problem, None))


def _end_petsc(session: Session) -> None:
    """End PETSc's processes, if the run started some; what they were goes to the summary."""
    server = workspace(session).petsc
    if server is not None:
        report = server.report()
        server.close()
        if report:
            session.statistics["petsc"] = report


def keep_for(session: Session, source: Source, options: RunOptions) -> None:
    """Say whose calculations REPRISE keeps, and look at what there is to go on from.

    Raises
    ------
    InputError
        If another deck or version left it.
    """
    output = run_output(session)
    output.deck, output.resume = partial(deck_of, source, options.given), options.resume
    if not options.resume or output.checkpoints is None:
        return
    if output.checkpoints.found:
        output.checkpoints.check()
    else:
        session.warn("cli.nothing-to-resume", None, folder=output.checkpoints.folder)


def deck_of(source: Source, given: Mapping[str, Any]) -> "Deck":
    """What tells a run from others, but for the files that it reads."""
    from ssilang.io.checkpoint import Deck

    return Deck(__version__, source.digest, {k: repr(v) for k, v in given.items()})


def _tell_checkpoints(session: Session) -> None:
    """Say that calculations are kept, where the one that was ended has not said it."""
    kept = run_output(session).checkpoints
    told = session.warned("operators.dynamics.checkpoint-left")
    if kept is not None and kept.kept and not told:
        session.warn("cli.checkpoints-left", None, folder=kept.folder)


def _flush(out: TextIO, errors: list[SsiError]) -> None:
    """Hand what was printed to the system; what it does not take is an error."""
    try:
        out.flush()
    except BrokenPipeError:
        if all(e.code != "reader-left" for e in errors):
            errors.append(SsiError("reader-left", None))
    except OSError as problem:
        errors.append(unprinted(problem))


def _tell_refused_folders(session: Session) -> None:
    """Warn of folders of what is kept that others could have written to, once a process."""
    told_of = set()
    while private.REFUSED:
        folder, fault = private.REFUSED.pop(0)
        if fault in told_of:
            continue
        told_of.add(fault)
        told = {"folder": str(folder), "fault": str(fault)}
        warning = SsiError("cli.kept-folder-refused", None, **told)
        warning.warns = True
        with suppress(ReaderLeft):  # it is in the summary
            session.report(warning)


def _tell_plain_numba(session: Session) -> None:
    """Note that plain numba has compiled, and why."""
    kernel = sys.modules.get("ssilang.kernel.base.compiled")
    if kernel is not None and kernel.PLAIN and session.on_note is not None:
        told = {"untried": kernel.UNTRIED}
        session.on_note(sentence("cli.plain-numba", told, session.language))


def _tell(errors: list[SsiError], message: str, debug: bool, err: TextIO) -> None:
    """Print what went wrong; a reader who left does not keep the summary from being written."""
    if not errors:
        return
    with suppress(OSError):  # it is in the summary
        err.write(message + "\n")
        for error in errors if debug else ():
            traceback.print_exception(error, file=err)


def _close_files(session: Session, errors: list[SsiError]) -> None:
    """Finish the files of the run, also of one that failed; what cannot be written is an error."""
    try:
        run_output(session).close()
    except OutputError as problem:
        errors.append(SsiError.of(problem, None))


def _summarise(result: RunResult, source: Source, err: TextIO, quiet: bool, again: int) -> None:
    """Write summary.json; one line says what the run leaves: files, warnings, energy."""
    from ssilang.cli.summary import deck_name, deck_of, write_summary

    output = run_output(result.session)
    try:
        # by its name: a deck is run from one folder or another
        if Path(other := deck_of(output.directory)).name not in ("", Path(deck_name(source)).name):
            told = {"folder": output.directory, "other": other}
            warned = SsiError("cli.folder-of-another", None, **told)
            err.write(render(warned, result.session.language) + "\n")
        write_summary(result.session, source, output, result.errors, result.exit_code)
    except OutputError as problem:
        with suppress(OSError):
            err.write(render(SsiError.of(problem, None), result.session.language) + "\n")
        result.exit_code = 1
        return
    session = result.session
    calculations: list[dict[str, Any]] = session.statistics.get("calculations", [])
    quiet = quiet or result.exit_code == ENDED_BY_CLOSED_PIPE
    if quiet or not (output.files or session.warnings or calculations):
        return
    told = {
        "count": len(output.files),
        "folder": output.directory,
        "warnings": sum(w.severity == "warning" for w in session.warnings),
        "again": again or None,
        **_energy(session, calculations),
    }
    with suppress(OSError):
        err.write(sentence("cli.files-written", told, session.language) + "\n")


def _report(result: RunResult, err: TextIO, quiet: bool) -> None:
    """Write report.html of what stands in the output folder; where that fails, the run fails."""
    session = result.session
    try:
        text = write_report(run_output(session).directory, session.language)
    except (InputError, OutputError) as problem:
        text = coloured(render(SsiError.of(problem, None), session.language), err)
        result.exit_code, quiet = result.exit_code or 1, False
    with suppress(OSError):
        err.write("" if quiet else text + "\n")


def write_report(folder: Path, language: str) -> str:
    """Write report.html of a folder of results; a line that says so.

    Raises
    ------
    InputError, OutputError
        If no run has left anything there, or it cannot be written.
    """
    from ssilang.cli.editor.document import Document
    from ssilang.cli.editor.outline import colours
    from ssilang.report.page import make_report

    path = make_report(folder, language, lambda text: colours(Document.of(text)))
    told = {"path": path, "size": path.stat().st_size / 1e6}
    return sentence("report.written", told, language)


def _tell_imbalance(session: Session) -> None:
    """Warn of the motion whose energies are out of balance most, if any is beyond the limit."""
    calculations: list[dict[str, Any]] = session.statistics.get("calculations", [])
    off = [c for c in calculations if "energy_imbalance_from" in c]
    found = [c for c in off if not c["static"] and not c["energy_imbalance_told"]]
    if not found:
        return
    worst = max(found, key=_imbalance)
    told = {
        "procedure": worst["procedure"],
        "number": calculations.index(worst) + 1 if len(calculations) > 1 else "",
        "causes": worst["energy_imbalance_from"],
        **_energy(session, [worst]),
    }
    warning = SsiError("operators.dynamics.energies-out-of-balance", None, **told)
    with suppress(ReaderLeft):  # it is in the summary
        session.report(warning)


def _imbalance(calculation: dict[str, Any]) -> float:
    return float(calculation["energy_imbalance"] or 0.0)


def _energy(session: Session, calculations: list[dict[str, Any]]) -> dict[str, str]:
    """The worst imbalance: per cent, where OPTI 'UNIT' names units an energy, what makes it.

    Load steps of statics have none: the work of loads is taken along straight lines between them.
    """
    found = [c for c in calculations if c.get("energy_imbalance") and not c["static"]]
    if not found:
        return {"energy": "", "amount": "", "off": ""}
    worst = max(found, key=_imbalance)
    units = workspace(session).units
    share = 100.0 * worst["energy_imbalance"]
    told = {
        "energy": f"{share:.0f}" if 10.0 <= share < 1e6 else f"{share:.2g}",
        "amount": "",
        "off": "off" if "energy_imbalance_from" in worst else "",
    }
    if units is not None:
        amount = worst["energy_imbalance_joules"] / units.factor("J")
        told["amount"] = f"{amount:.2g} {units.written('J')}"
    return told


def run_file(path: Path | str, options: RunOptions | None = None) -> RunResult:
    """Run a script file, keeping what it prints in the result."""
    out = io.StringIO()
    try:
        source = read_source(Path(path))
    except SsiError as error:
        text = render(error)
        return RunResult(1, Session(), errors=[error], message=text)
    result = run_source(source, options or RunOptions(), out, io.StringIO())
    result.output = out.getvalue()
    return result


def run_text(
    text: str, output_directory: Path | None = None, options: RunOptions | None = None
) -> RunResult:
    """Run a script given as text, keeping what it prints in the result."""
    options = options or RunOptions(output_directory=output_directory)
    out = io.StringIO()
    result = run_source(Source("script", text), options, out, io.StringIO())
    result.output = out.getvalue()
    return result
