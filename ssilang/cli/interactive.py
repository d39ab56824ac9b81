"""Statements that somebody gives one after the other to one session: the prompt, notebooks."""

from collections.abc import Callable, Sequence
from typing import Any

from ssilang.language.run.session import Session
from ssilang.language.say.reference import find_page, page_text
from ssilang.language.text import tree
from ssilang.language.values import type_of
from ssilang.operators.dispatch import LISTINGS

UNFINISHED = frozenset({"missing-semicolon", "unclosed-string", "unclosed-paren", "unclosed-block"})
"""Errors of a text that may go on."""


def run_shown(
    session: Session,
    nodes: Sequence[tree.Node],
    show: Callable[[Any], object],
    show_page: Callable[[str], object],
) -> None:
    """Run nodes; what statements without names on their left give is shown, and pages of INFO."""
    for node in nodes:
        if not isinstance(node, tree.Statement) or node.assigns:
            session.evaluator.run_top([node])
        elif not _page_shown(session, node, show_page):
            for value in session.evaluator.values_of(node):
                show(value)


def _page_shown(session: Session, node: tree.Statement, show_page: Callable[[str], object]) -> bool:
    if node.first_word[:4] != "INFO" or len(node.items) != 2:
        return False
    word = node.items[1]
    if not isinstance(word, tree.Name | tree.Quoted):
        return False
    page = find_page(word.text, session.library.standard_files)
    if page is None:
        return False
    show_page(page_text(page, session.language))
    return True


def listed(session: Session, value: Any) -> str:
    """A value as LIST shows it, in short."""
    kind = type_of(value)
    entry = LISTINGS.get(kind)
    text = entry(value, True, session.told) if entry else f"{kind} : {value}"
    return text.rstrip("\n")
