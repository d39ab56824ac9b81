"""The words of the grammar as regular expressions, kept from start to start.

Making them takes Lark, which takes longer to start than most scripts take to read; the scripts
themselves are not kept, since they are read about as fast as their trees could be loaded.
"""

from __future__ import annotations

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
