"""`ssilang help`: the same pages as INFO and the manual."""

from typing import TextIO

from ssilang.cli.terminal.screen import show
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.diagnostics import elsewhere
from ssilang.language.say.reference import overview
from ssilang.messages.message import teller
from ssilang.operators.loader import load_operators

OK, UNKNOWN = 0, 1


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
    told, near = teller(language), near_name(word)
    hint = hint or (told("did-you-mean", near=near) if near else told("cli.list-of-help"))
    out.write(f"{told('cli.no-help', word=word)}\n  = {hint}\n")
    return UNKNOWN
