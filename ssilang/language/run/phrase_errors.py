"""Errors of phrases that run and give the wrong thing: held words, names without a result."""

from __future__ import annotations

from collections.abc import Sequence

from ssilang.language.near import nearest
from ssilang.language.registry import Operator, keywords_of
from ssilang.language.run.call import Operand
from ssilang.language.run.scopes import PREDEFINED
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Span
from ssilang.language.values import Mot
from ssilang.messages.message import Sentence


def tell_held_word(error: SsiError, operand: Operand) -> None:
    """Add the word to an error of its operator if the script holds it and does not write it."""
    written = operand.span.text
    if PREDEFINED.get(written.upper()) == operand.value:
        return
    if not operand.result and written.strip("'").upper()[:4] != str(operand.value).upper()[:4]:
        note = Sentence("held-word", word=str(operand.value), holder=written)
        error.data.setdefault("held_word", note)


def tell_unread_word(error: SsiError, left: Sequence[Operand], found: Operator) -> None:
    """Add that a word which the operator left unread looks like a keyword of its own."""
    if "." not in error.code:  # of the language itself: it looks at words already
        return
    written = next((o for o in left if o.span.text[:1] == "'" and isinstance(o.value, Mot)), None)
    if written is None:
        return
    word = str(written.value)
    near = nearest(word, keywords_of(found))
    if near and near != word.rstrip().upper():
        error.data.setdefault("unread_word", Sentence("unread-word", word=word, near=near))


def tell_quoted_operator(error: SsiError, items: Sequence[tree.Item]) -> None:
    """Add that a quoted word ran as the operator of that name, if it is all that stands there."""
    if len(items) == 1 and isinstance(items[0], tree.Quoted):
        note = Sentence("quoted-operator", word=items[0].text)
        error.data.setdefault("quoted_operator", note)


def name_as_word(code: str, words: Sequence[Operand], held: object) -> SsiError | None:
    """The error `code` for a word that is also the name of an object, `SI 'VRAI'`; else None."""
    if len(words) != 1 or held is None or isinstance(held, Mot):
        return None
    return SsiError(code, words[0].span, found="MOT", word=str(words[0].value))


def tell_line_begun(error: SsiError, operand: Operand) -> None:
    """Add that the operator begins a line if what stands on the lines before it is in its way."""
    span, wrong = operand.span, error.span
    if error.code not in _IN_THE_WAY or wrong is None or wrong.source is not span.source:
        return
    line, column = span.source.position(span.start)
    if operand.result or span.source.line(line)[: column - 1].strip() or wrong.start >= span.start:
        return
    first = span.source.position(wrong.start)[0]
    if first < line:
        word = span.text.strip("'")
        note = Sentence("statement-goes-on", word=word, line=line, first=first)
        error.data.setdefault("begins_line", note)


_IN_THE_WAY = frozenset({"wrong-argument", "excess", "no-result"})


def unended(targets: Sequence[tree.Item]) -> Span | None:
    """The statement that lost its `;` before an assignment, None if there is none.

    It is what stands left of =, where the last name alone is on a later line than the rest.
    """
    if len(targets) < 2:
        return None
    *before, last = (t.span for t in targets)
    line = last.source.position(last.start)[0]
    if last.source.position(before[-1].start)[0] == line:
        return None
    return before[0].to(before[-1])


def no_result(
    targets: Sequence[tree.Item], target: tree.Item, count: int, wanted: str = ""
) -> SsiError:
    """The error of a name on the left of = that gets nothing."""
    statement = unended(targets)
    if statement is not None:
        last = targets[-1].span
        line = last.source.position(last.start)[0]
        return SsiError("unended-statement", statement, name=last.text, line=line)
    return SsiError("no-result", target.span, count=count, wanted=wanted, name=target.span.text)
