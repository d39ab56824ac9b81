"""Options of OPTI that name files; reading another script in the middle of one (OPTI DONN)."""

import io
from pathlib import Path
from typing import TextIO

from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.operators.files.outputs import input_path, output_path, run_output
from ssilang.operators.prelude import *

# compared in full: a file may be called 'formes.txt'
_FORMATS = ("FORMAT", "FORM", "BINA", "BINAIRE", "XDR", "SUITE", "SUIT", "TAILLE", "FORMATTE")


UNIT = arg("unit", "ENTIER", "MOT", en="name of a file, or number of a unit", range=POSITIVE)
_SIZE = arg("TAILLE", "FLOTTANT", en="size of the file", range=POSITIVE)


def read_file_option(call: Call, word: str) -> None:
    """A file's name, or the number of a logical unit; words of format around it are kept."""
    options = workspace(call.session).options
    formats: list[str] = []
    _formats(call, formats)
    value = call.given(UNIT)
    _formats(call, formats)
    options[word] = Mot(value) if isinstance(value, str) else value
    if word == "FTRA" and isinstance(value, str) and len(Path(value.strip()).parts) > 1:
        call.warn("operators.session.folder-of-pictures", name=value, kept=Path(value.strip()).stem)
    options[word + " FORMAT"] = tuple(formats)
    run_output(call.session).reopen(word)
    if word == "IMPR":
        _keep_listing(call, value if isinstance(value, str) else "")


class Listing(io.TextIOBase):
    """Takes what the script prints away from its usual place, whole lines to `keep`."""

    def __init__(self, usual: TextIO, keep: Callable[[list[str]], None]) -> None:
        self.usual = usual
        self._keep = keep
        self._rest = ""

    def write(self, text: str) -> int:
        """Keep the lines that are complete."""
        *lines, self._rest = (self._rest + text).split("\n")
        if lines:
            self._keep(lines)
        return len(text)


def _keep_listing(call: Call, name: str) -> None:
    """OPTI IMPR: what is printed from now on goes to a file; a unit's number ends that."""
    session = call.session
    usual = session.out.usual if isinstance(session.out, Listing) else session.out
    session.out = usual
    if name:
        path, output = output_path(call, name), run_output(session)
        listing: Any = Listing(usual, lambda lines: output.add_lines("IMPR", path, lines))
        session.out = listing


def _formats(call: Call, formats: list[str]) -> None:
    while (said := call.keyword(_FORMATS, length=12)) is not None:
        formats.append(said)
        if said == "TAILLE":
            call.given(_SIZE, call.keyword_end)


def include(call: Call, name: str) -> None:
    """Run the statements of another file as if they stood here."""
    source = read_source(input_path(call, name))
    call.session.evaluator.run(parse(source).body)
