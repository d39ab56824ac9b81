"""`ssilang format`: the layout of a script; what it means and its comments stay as they are."""

import difflib
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TextIO

from ssilang.io.atomic import replacing
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text.parser import end_of_run, quick_reader
from ssilang.language.text.source import Source, encoding_of
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import BLOCKS
from ssilang.late_imports import without_collections
from ssilang.messages.message import teller, visible

OK, FAILED, USAGE = 0, 1, 2

_STEP = "  "  # of each block
_GOES_ON = "   "  # of the lines of a statement behind its first
_EMPTY_LINES = 2  # in a row, at most

_Token = tuple[str, int, int]
"""Kind, start and end."""


def formatted(source: Source) -> str:
    """The text of a script, laid out.

    Blocks are indented by two blanks; one blank stands between words, none inside of parentheses;
    lines are broken where they were. Comments, strings, and what stands behind the last `FIN ;`
    are not touched.

    Raises
    ------
    SeveralErrors, SsiError
        If the script is not sound: nothing can be laid out then.
    """
    parse(source)
    end = end_of_run(source) or len(source.text)
    with without_collections():
        tokens = list(quick_reader().tokens(source.code[:end]))
        text = _laid_out(source, end, tokens) + source.text[end:]
        text = text.rstrip("\n") + "\n" if text.strip() else ""
        # what no rule above foresees stays as it is written: a star that would begin a comment
        made = Source(source.name, text, source.path)
        again = quick_reader().tokens(made.code[: end_of_run(made) or len(text)])
        same = _said(source.code, tokens) == _said(made.code, again)
    return text if same else source.text


def _said(code: str, tokens: Iterable[_Token]) -> list[tuple[str, str]]:
    """Kinds and texts of tokens: they are all that a script means."""
    return [(kind, code[start:stop]) for kind, start, stop in tokens]


def _laid_out(source: Source, end: int, tokens: list[_Token]) -> str:
    """The statements up to `end`, one after the other, with what stands between them."""
    code, parts = source.code[:end], list[str]()
    depth = at = 0
    before = ""
    for statement in _statements(tokens):
        word = _first_word(code, statement)
        closes = word in BLOCKS.values() and (word != "FIN" or len(statement) > 2)
        outer = closes or word == "SINO"
        depth = max(0, depth - outer)
        for number, (kind, start, stop) in enumerate(statement):
            gap = source.text[at:start]
            if at and "\n" not in gap:
                parts += (_between(gap, before, kind), code[start:stop])
                before, at = kind, stop
                continue
            shift = _STEP * depth + (_GOES_ON if number else "")
            lines = gap.split("\n")
            if at == 0:  # the file begins with comments, or with the statement
                parts += [*(line[1:] + "\n" for line in _below(lines[:-1])), shift]
            else:
                rest = lines[-1].strip()  # commas
                parts += [lines[0].rstrip(), *_below(lines[1:-1]), "\n", shift]
                parts.append(f"{rest} " if rest else "")
            parts.append(code[start:stop])
            before, at = kind, stop
        depth += word in BLOCKS or word == "SINO"
    tail = [line.rstrip() for line in source.text[at:end].split("\n")]
    return "".join(parts) + "\n".join(tail)


def _statements(tokens: list[_Token]) -> Iterator[list[_Token]]:
    held: list[_Token] = []
    for token in tokens:
        held.append(token)
        if token[0] == "_SEMICOLON":
            yield held
            held = []
    if held:
        yield held


def _first_word(code: str, statement: list[_Token]) -> str:
    kind, start, end = statement[0]
    if kind not in ("WORD", "STRING") or any(k == "_EQUAL" for k, _, _ in statement):
        return ""
    return code[start:end].strip("'").upper()[:4].rstrip()


def _below(lines: list[str]) -> Iterator[str]:
    """Comments and empty lines, each with the line end before it."""
    empty = 0
    for line in lines:
        shown = line.rstrip()
        empty = 0 if shown else empty + 1
        if empty <= _EMPTY_LINES:
            yield f"\n{shown}"


def _between(gap: str, before: str, kind: str) -> str:
    """Blanks between two tokens of one line; commas and the like stay."""
    if gap.strip():
        return ", " if gap.strip() == "," else gap
    if kind in ("_SEMICOLON", "_EQUAL") or before in ("_EQUAL", "_SEMICOLON"):
        return " "
    if before == "LPAR" or kind == "RPAR":
        return ""
    return " " if gap else ""


# ---- the command ------------------------------------------------------------------------------


def format_files(
    files: list[str], check: bool, diff: bool, language: str, out: TextIO, err: TextIO
) -> int:
    """Lay out files (`-`: standard input to standard output); returns the exit code.

    With `check`, nothing is written and the exit code is 1 if a file would change; with `diff`,
    the changes are printed instead of being made.
    """
    told, code = teller(language), OK
    for name in files:
        try:
            source = _read(name)
            text = formatted(source)
        except SeveralErrors as several:
            for error in several.errors:
                err.write(render(error, language) + "\n")
            code = max(code, FAILED)
            continue
        except SsiError as error:
            err.write(render(error, language) + "\n")
            code = max(code, USAGE if error.span is None else FAILED)
            continue
        changes = text != source.text
        if name == "-" and not (check or diff):
            out.write(text)
        elif changes and diff:
            before, after = source.text.splitlines(True), text.splitlines(True)
            lines = difflib.unified_diff(before, after, source.name, source.name)
            out.writelines(map(visible, lines) if out.isatty() else lines)
        elif changes and not check:
            _write(source, text)
            out.write(told("cli.formatted", file=name) + "\n")
        if changes and (check or diff):
            code = max(code, FAILED)
            if check and not diff:
                out.write(told("cli.would-format", file=name) + "\n")
    return code


def _read(name: str) -> Source:
    if name == "-":
        return Source.decode("standard input", sys.stdin.buffer.read())
    return read_source(Path(name))


def _write(source: Source, text: str) -> None:
    """Write a file whole or not at all, with the letters and line ends that it had."""
    path = source.path
    assert path is not None
    data = path.read_bytes()
    encoding = encoding_of(data)
    if "\r\n" in data.decode(encoding):
        text = text.replace("\n", "\r\n")
    with replacing(path) as stream:
        stream.write(text.encode(encoding))
