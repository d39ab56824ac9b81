"""`ssilang help`: the same pages as INFO and the manual."""

from __future__ import annotations

from typing import TextIO

from ssilang.cli.paging import show
from ssilang.language.diagnostics import elsewhere
from ssilang.language.library import standard_procedures
from ssilang.language.near import nearest
from ssilang.language.reference import find_page, overview, page_names, page_text
from ssilang.operators.loader import load_operators

OK, UNKNOWN = 0, 1

_TEXTS = {
    "unknown": {
        "en": "there is no operator or procedure called {word}",
        "fr": "il n'y a ni opérateur ni procédure de nom {word}",
    },
    "near": {"en": "did you mean {near}?", "fr": "vouliez-vous dire {near} ?"},
    "list": {"en": "`ssilang help` lists all of them", "fr": "`ssilang help` en donne la liste"},
}


def show_help(word: str, language: str, out: TextIO) -> int:
    """Print the page of an operator or procedure, or the list of all; returns the exit code."""
    load_operators()
    procedures = standard_procedures()
    if not word:
        show(overview(procedures.values(), language), out)
        return OK
    page = find_page(word, procedures)
    if page is not None:
        show(page_text(page, language), out)
        return OK
    near = nearest(word, page_names(procedures))
    hint = elsewhere(word, language)
    hint = hint or _TEXTS["near" if near else "list"][language].format(near=near)
    out.write(f"{_TEXTS['unknown'][language].format(word=word)}\n  = {hint}\n")
    return UNKNOWN
