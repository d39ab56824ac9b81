"""The tree that the Lark grammar makes of a sound text, rule by rule: it holds the reader."""

from lark import Token, Transformer, UnexpectedInput
from lark.exceptions import VisitError

from ssilang.language.text import reader, tree
from ssilang.language.text.by_grammar import _parser
from ssilang.language.text.source import Span


class _Builder(Transformer):
    """Turns grammar rules into tree nodes of a source."""

    def __init__(self, source):
        super().__init__()
        self.source = source

    def _span(self, first, last):
        start = first.start_pos if isinstance(first, Token) else first.span.start
        end = last.end_pos if isinstance(last, Token) else last.span.end
        return Span(self.source, start or 0, end or 0)

    def word(self, c):
        return reader.name_of(str(c[0]), self._span(c[0], c[0]))

    def string(self, c):
        return reader.quoted_of(str(c[0]), self._span(c[0], c[0]))

    def integer(self, c):
        return reader.integer_of(str(c[0]), self._span(c[0], c[0]))

    def real(self, c):
        return reader.real_of(str(c[0]), self._span(c[0], c[0]))

    def symbol(self, c):
        return reader.symbol_of(str(c[0]), self._span(c[0], c[0]))

    def items(self, c):
        return tuple(c)

    def paren(self, c):
        items = c[0]
        span = self._span(items[0], items[-1])
        text = self.source.code
        start = text.rfind("(", 0, span.start)
        end = text.find(")", span.end)
        return tree.Paren(items, Span(self.source, start, end + 1))

    def empty_paren(self, c):
        return tree.Paren((), self._span(c[0], c[1]))

    def path(self, c):
        return tree.Path(c[0], tuple(c[1:]), self._span(c[0], c[-1]))

    def attribute(self, c):
        return tree.Attribute(c[0], reader.attribute_name(c[2]), self._span(c[0], c[2]))

    def own_attribute(self, c):
        return tree.Attribute(None, reader.attribute_name(c[1]), self._span(c[0], c[1]))

    def empty(self, c):
        return None

    def plain(self, c):
        return reader.statement_of(None, c[0])

    def assignment(self, c):
        return reader.statement_of(c[0], c[1])

    def empty_assignment(self, c):
        return reader.statement_of(c[0], [])

    def start(self, c):
        return [s for s in c if s is not None]


def read_by_grammar(source):
    """The statements of a source; None where the grammar refuses it."""
    try:
        return _Builder(source).transform(_parser().parse(source.code))
    except UnexpectedInput:
        return None
    except VisitError as refused:  # a number too long to be kept
        raise refused.orig_exc from None
