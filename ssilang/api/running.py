"""Runs and checks scripts from Python."""

import io
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

from ssilang.api.errors import Error, Notice, refused
from ssilang.api.objects import held
from ssilang.api.result import Result
from ssilang.cli.check import check_source
from ssilang.cli.interrupts import listening
from ssilang.cli.run import RunOptions, RunResult, run_source
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source
from ssilang.language.text.source_files import read_source
from ssilang.language.values import type_of

Script = str | os.PathLike[str]
Allowed = Script | list[Script] | tuple[Script, ...]

_OF_A_RUN = frozenset({"POINT", "MAILLAGE", "CHPOINT", "MCHAML", "MMODEL", "RIGIDITE", "CHARGEME"})
"""Types that hold nodes, and are nothing without their run."""


def run(
    script: Script,
    /,
    *,
    out: Script | None = None,
    allow: Allowed = (),
    language: str = "en",
    quiet: bool = True,
    report: bool = False,
    **parameters: Any,
) -> Result:
    """Run a script.

    Parameters
    ----------
    script : str or path
        A file, or the text itself: what holds a semicolon is text.
    out : path, optional
        Folder for what the script writes, and its `summary.json`. Without it nothing stays: files
        and pictures are there as long as the result.
    allow : path or sequence of path
        Further folders that the script may read and write.
    language : 'en' or 'fr'
        Of messages.
    quiet : bool
        False: what the script prints, and warnings, appear while it runs.
    report : bool
        Whether the run takes down what its page shows; `Result.report` is that page. It can be
        copied, and stays where `out` is given.
    **parameters
        Values that names of the script get in place of their first assignment: numbers, words,
        logicals, lists of them, a pandas Series (an EVOLUTION over its index).

    Returns
    -------
    Result

    Raises
    ------
    Error
        What is wrong in the script, or a parameter that it does not have.

    Examples
    --------
    >>> import ssilang
    >>> r = ssilang.run("AG = 0.3 ; PGA = AG * 9.81 ;", AG=0.4)
    >>> round(r["PGA"], 3)
    3.924
    >>> ssilang.run("AG = 0.3 ; PGA = AG * 9.81 ;", AGG=0.4)
    Traceback (most recent call last):
        ...
    ssilang.api.errors.Error: error: a value is given to AGG, that the script does not have
      = did you mean AG?
    """
    source = source_of(script, language)
    options = RunOptions(
        output_directory=Path(tempfile.mkdtemp(prefix="ssilang-") if out is None else out),
        allowed=folders(allow),
        language=language,
        summary=out is not None or report,
        report=report,
        quiet=quiet,
        given={name.upper(): _given(name, value, language) for name, value in parameters.items()},
    )
    printed = _Printed(quiet)
    with listening(own=False):
        done = run_source(source, options, printed, io.StringIO() if quiet else sys.stderr)
    return _result(done, printed, out is not None, language)


def _result(done: RunResult, printed: io.StringIO, kept: bool, language: str) -> Result:
    """What the run left, or the error that it ended with.

    The result is a name in this frame alone: frames of `run` may live on in a library's traceback,
    and the files of a result go when nobody has it any more.
    """
    result = Result(done.session, done.seconds, printed, kept)
    if not done.errors:
        return result
    if any(e.code == "interrupted" for e in done.errors):
        raise KeyboardInterrupt
    names = done.session.frame.names() | done.session.library.standard_names
    raise Error([Notice.of(e, language, names) for e in done.errors], result)


def check(script: Script, /, *, language: str = "en") -> list[Notice]:
    """What `ssilang check` says of a script: errors and warnings, without running it.

    Parameters
    ----------
    script : str or path
        A file, or the text itself.

    Examples
    --------
    >>> import ssilang
    >>> for notice in ssilang.check("X = 1 ; MESS X ;\\nLIST (PRGO 1.) ;"):
    ...     print(notice.line, notice.code, notice.hint)
    2 unknown-operator did you mean PROG?
    """
    problems, names = check_source(source_of(script, language))
    return [Notice.of(p, language, names) for p in problems]


def source_of(script: Script, language: str) -> Source:
    """The text of a file, or a text itself.

    Raises
    ------
    Error
        If the file cannot be read.
    """
    if isinstance(script, str) and (";" in script or "\n" in script):
        return Source("script", script.replace("\r\n", "\n").replace("\r", "\n"))
    if not isinstance(script, (str, os.PathLike)):
        raise refused("api.no-script", language, kind=type(script).__name__)
    try:
        return read_source(Path(script))
    except SsiError as error:
        raise Error([Notice.of(error, language)]) from None


def folders(allow: Allowed) -> list[Path]:
    """Folders as they are, one or several."""
    several = allow if isinstance(allow, (list, tuple)) else [allow]
    return [Path(p).resolve() for p in several]


def _given(name: str, value: Any, language: str) -> Any:
    made = held(value, language)
    kind = type_of(made)
    if kind in _OF_A_RUN:
        raise refused("api.other-run", language, name=name.upper(), kind=kind)
    return made


class _Printed(io.StringIO):
    """What a script prints, kept, and shown as it comes if nobody asked for quiet."""

    def __init__(self, quiet: bool) -> None:
        super().__init__()
        self._quiet = quiet

    def write(self, text: str) -> int:
        if not self._quiet:
            sys.stdout.write(text)
        return super().write(text)
