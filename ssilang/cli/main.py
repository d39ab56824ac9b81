"""The command line: `ssilang FILE`, `run`, `check`, `help`, `sweep`, `view`, `repl` ..."""

import argparse
import errno
import gc
import io
import os
import sys
import warnings
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from ssilang import __version__
from ssilang.cli.interrupts import ENDED_BY_CLOSED_PIPE, listening
from ssilang.cli.usage import COMMANDS, parser
from ssilang.io.errors import InputError, OutputError
from ssilang.language.say.errors import SsiError, unprinted
from ssilang.language.text.source import Source
from ssilang.late_imports import lasting

if TYPE_CHECKING:
    from ssilang.cli.run import RunOptions

OK, FAILED, USAGE = 0, 1, 2
SELDOM = 10_000  # new objects between two searches for garbage: a start makes a hundred thousand
_LEADING = (*COMMANDS, "-h", "--help", "--version")


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code.

    0 fine, 1 the script failed or was interrupted, 2 wrong usage, 141 nobody reads the output.
    """
    gc.set_threshold(SELDOM)
    words = _command_first(list(sys.argv[1:] if arguments is None else arguments))
    named = bool(words) and words[0] in _LEADING
    reader = parser(words)
    options = reader.parse_args(words if named else ["run", *words])
    if options.command == "run" and options.file is None:
        if named:
            reader.refuse("cli.usage-no-file")
        options.command, options.file = ("repl" if sys.stdin.isatty() else "run"), "-"
    # streams that were closed before (`>&-`): printing to them is an error
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, _Closed())
    if (gone := _folder_gone(getattr(options, "lang", "en"))) is not None:
        return gone
    for stream in (sys.stdout, sys.stderr):  # a terminal without accents must not stop a run
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    if not getattr(options, "debug", False):
        warnings.simplefilter("ignore")  # of libraries; the language's own are messages
    if getattr(options, "allow_geo", False):
        from ssilang.io.mesh_files.geo import FREE

        os.environ[FREE] = "1"  # workers are to know it, too
    try:
        with listening():
            code = _ACTIONS[options.command or "repl"](options)
            return _flushed(code)
    except BrokenPipeError:  # the reader left (`ssilang case.ssi | head -1`)
        _silence()
        return ENDED_BY_CLOSED_PIPE
    except OSError as problem:  # of a stream: what concerns files is told where it happens
        _told(problem, getattr(options, "lang", "en"))
        return FAILED
    except MemoryError:
        _told(SsiError("memory", None, operator="ssilang"), getattr(options, "lang", "en"))
        return FAILED
    except KeyboardInterrupt:  # while the program starts, or a check or a sweep goes on
        from ssilang.language.say.diagnostics import render

        told = render(SsiError("interrupted", None), getattr(options, "lang", "en"))
        sys.stderr.write(told + "\n")
        return FAILED


def program() -> NoReturn:
    """The command: `main`, and the end of the process.

    Its end would look for garbage in all that is left, a sixth of a small run.
    """
    code = main()
    gc.freeze()
    sys.exit(code)


def _command_first(words: list[str]) -> list[str]:
    """The arguments with the command in front of a --lang that is written before it."""
    length = 1 if words[:1] and words[0].startswith("--lang=") else 2
    leads = bool(words) and words[0].partition("=")[0] == "--lang"
    if not leads or words[length : length + 1] == [] or words[length] not in _LEADING:
        return words
    return [words[length], *words[:length], *words[length + 1 :]]


class _Closed(io.TextIOBase):
    """A stream that was closed before the program began."""

    def write(self, text: str) -> int:
        raise OSError(errno.EBADF, os.strerror(errno.EBADF))


def _folder_gone(language: str) -> int | None:
    """The exit code if the working folder was removed: no name leads anywhere then."""
    try:
        Path.cwd()
    except OSError:
        _told(SsiError("cli.no-working-folder", None), language)
        return USAGE
    return None


def _flushed(code: int) -> int:
    """The exit code, when all that was printed has been written."""
    sys.stdout.flush()
    try:
        sys.stderr.flush()
    except OSError:  # a full one that takes no messages: Python would try again, and exit with 120
        _silence()
    return code


def _told(problem: Exception, language: str) -> None:
    """Tell what ended the program, where that can be; nothing more is written."""
    from ssilang.language.say.diagnostics import render

    said = unprinted(problem) if isinstance(problem, OSError) else problem
    assert isinstance(said, SsiError)
    with suppress(OSError):
        sys.stderr.write(render(said, language) + "\n")
        sys.stderr.flush()
    _silence()


def _silence() -> None:
    """Let what is left in the streams go nowhere when the process ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):  # one that was never open
            os.dup2(nowhere, stream.fileno())


def _run(options: argparse.Namespace) -> int:
    with lasting():
        from ssilang.cli.run import run_source
        from ssilang.kernel.base.compiled import ALLOWED
        from ssilang.language.say.diagnostics import render
        from ssilang.language.text.source_files import read_source

    try:
        if options.file == "-":
            source = Source.decode("standard input", sys.stdin.buffer.read())
        else:
            source = read_source(Path(options.file))
    except SsiError as error:
        sys.stderr.write(render(error, options.lang) + "\n")
        return USAGE
    ALLOWED.add("beside")
    _compile_ahead(source)
    run_options = _run_options(options)
    run_options.report = options.report
    run_options.summary = options.file != "-" or options.out is not None
    result = run_source(source, run_options, sys.stdout, sys.stderr)
    if options.interactive:
        from ssilang.cli.terminal.repl import interact

        return interact(result.session)
    return result.exit_code


def _compile_ahead(source: Source) -> None:
    """Let the other process begin with joints, if the script steps some and there is no code yet.

    It compiles while this one reads and meshes.
    """
    code = source.code.upper()
    if "JOINT" not in code or not ("DYNAMIC" in code or "PASAPAS" in code):
        return
    from ssilang.kernel.base.compiled.beside import tell_ahead
    from ssilang.kernel.base.compiled.cache import is_compiled

    if not is_compiled("interface"):
        tell_ahead("interface")


def _run_options(options: argparse.Namespace) -> "RunOptions":
    from ssilang.cli.run import RunOptions
    from ssilang.io.atomic import resolved
    from ssilang.language.run.session import Limits
    from ssilang.system import limit_memory

    if options.max_memory is not None and not limit_memory(options.max_memory * 2**20):
        _told(SsiError("cli.no-bound-on-memory", None), options.lang)
        raise SystemExit(USAGE)
    made = RunOptions(
        output_directory=options.out,
        allowed=[resolved(p) for p in options.allow],
        language=options.lang,
        debug=options.debug,
        quiet=options.quiet,
        verbose=options.verbose,
        limits=Limits(options.max_recursion, options.max_statements),
        given=_given(getattr(options, "set", []), options.lang),
        resume=getattr(options, "resume", False),
    )
    if options.petsc is not None:
        made.petsc = options.petsc
    return made


def _given(settings: list[str], language: str) -> dict[str, object]:
    """Values of `--set`, one each."""
    if not settings:
        return {}
    from ssilang.cli.sweeping.given import GivenError, axes_of

    try:
        axes = axes_of(settings)
        if several := [name for name, values in axes.items() if len(values) > 1]:
            raise GivenError("cli.several-values", name=several[0])
    except GivenError as problem:
        _told(SsiError.of(problem, None), language)
        raise SystemExit(USAGE) from None
    return {name: values[0] for name, values in axes.items()}


def _report(options: argparse.Namespace) -> int:
    from ssilang.cli.run import write_report
    from ssilang.language.say.diagnostics import render

    try:
        sys.stdout.write(write_report(options.folder, options.lang) + "\n")
    except (InputError, OutputError) as problem:
        sys.stderr.write(render(SsiError.of(problem, None), options.lang) + "\n")
        return USAGE if isinstance(problem, InputError) else FAILED
    return OK


def _sweep(options: argparse.Namespace) -> int:
    from ssilang.cli.sweeping.sweep import SweepOptions, sweep

    return sweep(
        SweepOptions(
            options.file,
            options.set,
            options.motions,
            options.out,
            options.jobs,
            options.scheduler,
            options.allow,
            options.lang,
            options.report,
            options.fragility,
            options.intensity,
        ),
        sys.stdout,
        sys.stderr,
    )


def _warm(options: argparse.Namespace) -> int:
    from ssilang.cli.warm import warm
    from ssilang.io.atomic import resolved

    return warm(options.files, [resolved(p) for p in options.allow], options.lang, sys.stdout)


def _check(options: argparse.Namespace) -> int:
    from ssilang.cli.check import check_file
    from ssilang.language.say.diagnostics import render
    from ssilang.language.text.source_files import read_source

    code, sources = OK, []
    for file in options.files:
        try:
            source = read_source(Path(file))
        except SsiError as error:
            sys.stderr.write(render(error, options.lang) + "\n")
            code = USAGE
            continue
        sources.append(source)
        if options.format == "text":
            failed = check_file(source, options.syntax_only, options.lang, sys.stdout)
            code = max(code, FAILED) if failed else code
    if options.format != "text":
        from ssilang.cli.checking.reports import report

        failed = report(sources, options.format, options.syntax_only, options.lang, sys.stdout)
        code = max(code, FAILED) if failed else code
    return code


def _format(options: argparse.Namespace) -> int:
    from ssilang.cli.editor.formatting import format_files

    return format_files(
        options.files, options.check, options.diff, options.lang, sys.stdout, sys.stderr
    )


def _new(options: argparse.Namespace) -> int:
    from ssilang.cli.starters import write_starter

    return write_starter(options.name, options.file, options.lang, sys.stdout, sys.stderr)


def _completion(options: argparse.Namespace) -> int:
    from ssilang.cli.shells import write_completion

    write_completion(options.shell, parser([]), sys.stdout)
    return OK


def _view(options: argparse.Namespace) -> int:
    from ssilang.io.viewer import Wish, looked_at

    wish = Wish(options.field, options.step, options.scale)
    try:
        looked_at(options.file, options.output, wish)
    except (InputError, OutputError) as problem:
        _told(SsiError.of(problem, None), options.lang)
        return USAGE
    return OK


def _lsp(options: argparse.Namespace) -> int:
    try:
        from ssilang.cli.editor.server import start
    except ModuleNotFoundError as missing:
        if missing.name not in ("pygls", "lsprotocol"):
            raise
        _told(SsiError("cli.lsp-extra", None), options.lang)
        return USAGE
    start(options.lang)
    return OK


def _help(options: argparse.Namespace) -> int:
    from ssilang.cli.helping import show_help

    return show_help(" ".join(options.word), options.lang, sys.stdout)


def _repl(options: argparse.Namespace) -> int:
    from ssilang.cli.terminal.repl import start

    return start(_run_options(options))


def _version(options: argparse.Namespace) -> int:
    sys.stdout.write(f"ssilang {__version__}\n")
    return OK


_ACTIONS: dict[str, Callable[[argparse.Namespace], int]] = {
    "run": _run,
    "report": _report,
    "new": _new,
    "check": _check,
    "format": _format,
    "help": _help,
    "sweep": _sweep,
    "warm": _warm,
    "repl": _repl,
    "view": _view,
    "lsp": _lsp,
    "completion": _completion,
    "version": _version,
}

if __name__ == "__main__":
    program()
