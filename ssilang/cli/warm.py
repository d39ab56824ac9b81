"""`ssilang warm`: compiles what decks need, so that no later run on the machine has to.

The decks are run, one after the other in this process: what compiled code they call depends on what
they hold, and no list of it is kept. Their files go to a folder that is removed.
"""

import io
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

from ssilang.cli.run import RunOptions, run_source
from ssilang.kernel.base.compiled.cache import kept_code
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source_files import read_source
from ssilang.messages.message import Teller, teller
from ssilang.resources import resource

OK, FAILED, USAGE = 0, 1, 2


def warm(decks: Sequence[Path], allowed: Sequence[Path], language: str, out: TextIO) -> int:
    """Run decks (those of `cases` if none is named), say what was compiled; the exit code."""
    told, start = teller(language), time.perf_counter()
    before = kept_code()
    if before is None:
        sys.stderr.write(render(SsiError("cli.warm-nothing-kept", None), language) + "\n")
        return FAILED
    code, named = OK, list(decks) or sorted(resource("cases").rglob("*.ssi"))
    for deck in named:
        code = max(code, _run(deck, allowed, language, out, told))
    folder, count = kept_code() or before
    line = told(
        "cli.warmed", count=count - before[1], decks=len(named), kept=count, folder=folder,
        seconds=time.perf_counter() - start,
    )  # fmt: skip
    out.write(line + "\n")
    return code


def _run(deck: Path, allowed: Sequence[Path], language: str, out: TextIO, told: Teller) -> int:
    """Run a deck, say how many functions it had compiled; its exit code."""
    try:
        source = read_source(deck)
    except SsiError as error:
        sys.stderr.write(render(error, language) + "\n")
        return USAGE
    begun, start = kept_code(), time.perf_counter()
    with tempfile.TemporaryDirectory(prefix="ssilang-") as folder:
        options = RunOptions(Path(folder), list(allowed), language, quiet=True)
        said = io.StringIO()
        result = run_source(source, options, io.StringIO(), said)
    if any(error.code == "interrupted" for error in result.errors):
        raise KeyboardInterrupt
    if result.exit_code:
        sys.stderr.write(said.getvalue())
    ended = kept_code()
    count = ended[1] - begun[1] if begun and ended else 0
    seconds = time.perf_counter() - start
    out.write(told("cli.warm-deck", deck=Path(deck.name), count=count, seconds=seconds) + "\n")
    out.flush()
    return result.exit_code
