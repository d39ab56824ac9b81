"""Every English text of declarations has its French, every French text its English."""

from __future__ import annotations

import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import fields
from pathlib import Path

from ssilang.language.registry import OPERATORS, Argument, Help
from ssilang.messages import message
from ssilang.messages.message import Translated, french
from ssilang.operators.loader import load_operators

_FILES = sorted((Path(message.__file__).parent / "french").glob("*.toml"))


def texts_in(declared: object) -> Iterator[str]:
    """English lines of a declaration, and of all that it holds."""
    if isinstance(declared, Translated):
        yield from declared.en.split("\n")
        for field in fields(declared):  # type: ignore[arg-type]
            yield from texts_in(getattr(declared, field.name))
    elif isinstance(declared, Mapping):
        yield from texts_in(tuple(declared.values()))
    elif isinstance(declared, tuple):
        for part in declared:
            yield from texts_in(part)


def declared() -> set[str]:
    """All English lines that operators and their forms declare."""
    load_operators()
    found: set[str] = set()
    for operator in OPERATORS.values():
        found |= set(texts_in(operator.about))
        for form in operator.forms:
            found |= set(texts_in((form.help, form.entries or (), form.when)))
    for name, module in list(sys.modules.items()):  # what operators read by hand
        if name.startswith("ssilang.operators"):
            held = (v for v in vars(module).values() if isinstance(v, Argument | dict))
            found |= {t for v in held for t in texts_in(v)}
    return found - {""}


def kept() -> Counter[str]:
    """English lines of the files of French texts, how often each."""
    return Counter(en for f in _FILES for en in tomllib.loads(f.read_text(encoding="utf-8")))


def test_every_text_has_its_french():
    assert not sorted(t for t in declared() if not french(t).strip())


def test_every_french_text_has_its_english():
    assert not set(kept()) - declared()


def test_a_text_stands_in_one_file():
    assert not [en for en, times in kept().items() if times > 1]


def test_a_help_of_several_lines_is_told_line_by_line():
    first, second = sorted(declared())[:2]
    assert Help(f"{first}\n{second}").fr == f"{french(first)}\n{french(second)}"
    assert Help("of a procedure", in_french="d'une procédure").told("fr") == "d'une procédure"
    assert french("what no declaration says") == ""
