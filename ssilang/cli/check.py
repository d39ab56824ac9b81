"""`ssilang check`: what can be said about a script without running it."""

from __future__ import annotations

from pathlib import Path
from typing import TextIO

from ssilang.cli.colour import coloured
from ssilang.language.diagnostics import render
from ssilang.language.errors import SeveralErrors, SsiError
from ssilang.language.source import Source
from ssilang.language.structure import parse


def check_file(path: Path, syntax_only: bool, language: str, out: TextIO) -> bool:
    """Check one script and print what is wrong with it; True if there are errors.

    Parameters
    ----------
    syntax_only : bool
        Look at the structure alone: statements, parentheses, quotes, blocks.
    """
    try:
        source = Source.read(path)
        parse(source)
    except SeveralErrors as several:
        problems, names = several.errors, set[str]()
    except SsiError as error:
        problems, names = [error], set[str]()
    else:
        problems = []
    for problem in problems:
        out.write(coloured(render(problem, language, names), out) + "\n\n")
    return bool(problems)
