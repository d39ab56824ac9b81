"""Text to statements by the quick reader; what is wrong in others is found by the grammar."""

import re
from functools import lru_cache

from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text import tree
from ssilang.language.text.reader import Reader, Unsound
from ssilang.language.text.source import STATEMENT_END, STRING, Source, Span
from ssilang.remembered import remembered
from ssilang.resources import resource

Words = list[tuple[str, str]]


def grammar_words() -> Words:
    """Names and regular expressions of the grammar's terminals, in the order of trial."""
    grammar = resource("grammar", "ssi.lark").read_text(encoding="utf-8")
    return [(name, pattern) for name, pattern in remembered("words", grammar, _words)]


def _words() -> Words:
    from ssilang.language.text.by_grammar import words_of_grammar

    return words_of_grammar()


@lru_cache(maxsize=1)
def quick_reader() -> Reader:
    """The reader of sound scripts."""
    return Reader(grammar_words())


def parse_statements(source: Source, end: int | None = None) -> list[tree.Statement]:
    """Cut a source into statements, up to the offset `end` if it is given.

    Raises
    ------
    SeveralErrors
        All syntax errors found, at most `by_grammar.MAX_ERRORS`.
    """
    reader = quick_reader()
    text = source.code[:end]
    if not text.rstrip().endswith(";") and text.strip():
        last = 0
        for m in STATEMENT_END.finditer(text):
            if m.group() == ";":
                last = m.end()
        # `FIN` without semicolon at the end of the file is common; anything else is an error
        if re.fullmatch(r"\s*FIN\s*", text[last:], re.IGNORECASE):
            text += ";"
    try:
        return reader.read(source, text)
    except (Unsound, SsiError):
        from ssilang.language.text.by_grammar import errors_of  # Lark takes time to start

        raise SeveralErrors(errors_of(source, text, reader)) from None


_COMMA = re.compile(STRING + r"|(?<![\w.,+-])([+-]?\d+),(\d+(?:[ED][+-]?\d+)?)(?![\w.,])", re.I)

_BETWEEN_DIGITS = re.compile(r"\d,\d")


def decimal_commas(source: Source) -> list[SsiError]:
    """An error for each `2,5` of what is run, a warning where it is only printed.

    (0,0) and 1,2,3 are lists of numbers.
    """
    code = source.code
    if _BETWEEN_DIGITS.search(code) is None:
        return []
    errors = []
    for m in _COMMA.finditer(code, 0, end_of_run(source) or len(code)):
        in_parentheses = (
            code[m.start() - 1 : m.start()] == "(" and code[m.end() : m.end() + 1] == ")"
        )
        statement = code[: m.start()].rpartition(";")[2].split()
        word = statement[0].strip("'").upper()[:4] if statement else ""
        if m.group(1) and not in_parentheses and word != "COMM":
            first, second = m.groups()
            error = SsiError(
                "comma-in-print" if word == "MESS" else "decimal-comma",
                Span(source, m.start(), m.end()),
                text=m.group(),
                first=first,
                second=second,
            )
            error.warns = word == "MESS"  # a line printed wrong changes no result
            errors.append(error)
    return errors


_FIRST_WORD = re.compile(r"\s*'?(\w+)'?")
_LAST_STATEMENT = re.compile(r"\s*(?:FIN|'FIN')\s*(?:\(\s*\)\s*)?;", re.IGNORECASE)
_DEEPER = frozenset({"SI", "REPE", "DEBP", "DEBM"})
_HIGHER = frozenset({"FINS", "FIN", "FINP", "FINM"})


def end_of_run(source: Source) -> int | None:
    """Offset behind the first `FIN ;` outside of all blocks, None if there is none.

    What stands behind is never run: decks keep remarks there that are no statements.
    """
    text = source.code
    start = depth = 0
    for m in STATEMENT_END.finditer(text):
        if m.group() != ";":
            continue
        statement, start = text[start : m.end()], m.end()
        if _LAST_STATEMENT.fullmatch(statement):
            if depth == 0:
                return m.end()
            continue
        found = _FIRST_WORD.match(statement)
        word = found.group(1).upper()[:4] if found else ""
        depth += (word in _DEEPER) - (word in _HIGHER)
    return None
