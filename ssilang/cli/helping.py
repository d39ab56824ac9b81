"""`ssilang help`: the same pages as INFO and the manual."""

from __future__ import annotations

from typing import TextIO

from ssilang.cli.paging import show
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.diagnostics import elsewhere
from ssilang.language.say.reference import overview
from ssilang.operators.loader import load_operators

OK, UNKNOWN = 0, 1

_TEXTS = {
    "unknown": {
        "en": "there is no help about {word}",
        "fr": "il n'y a pas d'aide sur {word}",
    },
    "near": {"en": "did you mean {near}?", "fr": "vouliez-vous dire {near} ?"},
    "list": {"en": "`ssilang help` lists all of them", "fr": "`ssilang help` en donne la liste"},
}


def show_help(word: str, language: str, out: TextIO) -> int:
    """Print what help knows of a word, or the list of all; returns the exit code."""
    load_operators()
    if not word:
        show(overview(standard_procedures().values(), language), out)
        return OK
    from ssilang.operators.vocabulary.pages import exact_pages, found_text, near_name

    hint = elsewhere(word, language)
    text = "\n\n".join(exact_pages(word, language)) or ("" if hint else found_text(word, language))
    if text:
        show(text, out)
        return OK
    near = near_name(word)
    hint = hint or _TEXTS["near" if near else "list"][language].format(near=near)
    out.write(f"{_TEXTS['unknown'][language].format(word=word)}\n  = {hint}\n")
    return UNKNOWN
