"""What to do where a slip shows the habit of another language, or a usual misunderstanding."""

import re
from collections.abc import Mapping
from pathlib import Path

from ssilang.language.registry import find_operator
from ssilang.language.text.source import Span
from ssilang.messages.message import Sentence
from ssilang.remembered import tables_of

Hint = Sentence | str
"""A hint, or '' where nothing is known."""

_FOREIGN = Path(__file__).with_name("foreign.toml")


def foreign_hint(word: str) -> Hint:
    """What to write for a word of another language."""
    if re.search(r"[\[\]{}]", word):
        return Sentence("write-item")
    if word[:1] == "#" or word[:2] == "//":
        return Sentence("write-comment")
    found = (c for c, words in tables_of(_FOREIGN).items() if word.upper() in words)
    return Sentence(code) if (code := next(found, "")) else ""


def comment_hint(span: Span | None) -> Hint:
    """For a statement that begins as comments of other languages do."""
    text = span.source.text[span.start : span.start + 80] if span else ""
    begins = re.match(r"\s*(#|//|!|%|\"\"\"|--|/|\*)", text)
    return Sentence("write-comment") if begins else ""


def caller_hint(span: Span | None, operator: str) -> Hint:
    """For an operator that a longer word of another language begins like: PRINT is PRIN.

    `span` is what the operator has found.
    """
    before = span.source.code[: span.start] if span else ""
    words = re.findall(r"[A-Za-z]\w*", before.rpartition(";")[2])
    named = find_operator(words[-1].upper()) if words else None
    if named is None or named.full_name != operator or words[-1].upper() in (named.name, operator):
        return ""
    found = foreign_hint(words[-1])
    return Sentence("longer-word", word=words[-1].upper(), problem=found) if found else ""


_EXCESS = {
    "numbers": "excess-numbers", "parentheses": "excess-parentheses", "join": "excess-join",
}  # fmt: skip


def excess_hint(data: Mapping[str, object]) -> Hint:
    """What to do about an operand that nothing reads."""
    code = _EXCESS.get(str(data.get("kind")), "excess-order")
    begins = foreign_hint(str(data.get("begins", "")))
    return begins or Sentence(code, caller=data.get("caller", ""))


def no_result_hint(data: Mapping[str, object]) -> Hint:
    """What to do about a name on the left of = that gets nothing."""
    count = int(str(data.get("count", 1)))
    return Sentence("no-result-at-all") if count == 1 else Sentence("fewer-results", count=count)


def not_a_table_hint(data: Mapping[str, object]) -> Hint:
    """What to do about an index of something that has none."""
    a_list = str(data.get("found")).startswith("LIST")
    code = "item-of-list" if a_list else "only-tables-have-indices"
    return Sentence(code, name=data.get("name"))
