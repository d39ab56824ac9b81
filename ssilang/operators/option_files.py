"""Options of OPTI that name files; reading another script in the middle of one (OPTI DONN)."""

from __future__ import annotations

from pathlib import Path

from ssilang.language.call import Call
from ssilang.language.errors import SsiError
from ssilang.language.source import Source
from ssilang.language.structure import parse
from ssilang.language.values import Mot
from ssilang.operators.workspace import workspace

_FORMATS = ("FORMAT", "BINA", "XDR", "SUITE", "TAILLE", "FORMATTE")


def read_file_option(call: Call, word: str) -> None:
    """A file's name, or the number of a logical unit; words of format around it are kept."""
    options = workspace(call.session).options
    formats: list[str] = []
    _formats(call, formats)
    operand = call.read("ENTIER", "MOT")
    if operand is None:
        raise call.missing(("MOT", "ENTIER"))
    _formats(call, formats)
    value = operand.value
    options[word] = Mot(value) if isinstance(value, str) else value
    options[word + " FORMAT"] = tuple(formats)


def _formats(call: Call, formats: list[str]) -> None:
    while (said := call.keyword(_FORMATS)) is not None:
        formats.append(said)
        if said == "TAILLE":
            call.required("FLOTTANT", after=call.keyword_end)


def script_path(call: Call, name: str) -> Path:
    """Path of a script to read: below the deck's folder or an allowed one.

    Raises
    ------
    SsiError
        'bad-value' outside of these folders, 'missing-file' if there is no such file.
    """
    session = call.session
    base = Path(session.script_directory).resolve()
    path = (base / name).resolve()
    roots = [base, *(Path(a).resolve() for a in session.allowed)]
    if not any(path.is_relative_to(root) for root in roots):
        raise call.bad(f"'{name}' is outside of the script's folder", name, "allow it by --allow")
    if not path.is_file():
        raise SsiError("missing-file", call.span, path=str(path), reason="no such file")
    return path


def include(call: Call, name: str) -> None:
    """Run the statements of another file as if they stood here."""
    source = Source.read(script_path(call, name))
    call.session.evaluator.run(parse(source).body)
