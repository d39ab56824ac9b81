"""`ssilang new`: a commented deck to begin with."""

import re
from pathlib import Path
from typing import TextIO

from ssilang.io.atomic import replacing
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SsiError
from ssilang.language.search import nearest
from ssilang.messages.message import teller
from ssilang.resources import resource

OK, FAILED, USAGE = 0, 1, 2


def starters() -> dict[str, Path]:
    """The decks to begin with, by name."""
    return {p.stem: p for p in sorted(resource("cases", "starters").glob("*.ssi"))}


def summary(path: Path) -> str:
    """What the first line of a deck says it is."""
    with path.open(encoding="utf-8") as stream:
        return re.sub(r"^\*\s*", "", stream.readline()).strip()


def write_starter(name: str, target: Path | None, language: str, out: TextIO, err: TextIO) -> int:
    """Write the starter `name` to `target` (by default NAME.ssi here); returns the exit code.

    Without a name the starters are listed. A file that is there is not replaced.
    """
    known, told = starters(), teller(language)
    if not name:
        out.writelines(f"  {n:<12} {summary(path)}\n" for n, path in known.items())
        return OK
    if name not in known:
        problem = SsiError("cli.no-starter", None, word=name, known=list(known),
                           near=nearest(name, known))  # fmt: skip
        err.write(render(problem, language) + "\n")
        return USAGE
    path = target if target is not None else Path(f"{name}.ssi")
    if path.exists():
        err.write(render(SsiError("cli.starter-there", None, path=path), language) + "\n")
        return FAILED
    with replacing(path) as stream:
        stream.write(known[name].read_bytes())
    out.write(told("cli.starter-written", path=path) + "\n")
    return OK
