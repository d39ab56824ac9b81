"""Every English text of declarations has its French, every French text its English."""

import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import fields
from pathlib import Path

from ssilang.language.registry import OPERATORS, Argument, Operator
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


def operators() -> list[Operator]:
    load_operators()
    return [o for name, o in OPERATORS.items() if o.name == name]


def declared() -> set[str]:
    """All English lines that operators and their forms declare."""
    forms = [form for operator in operators() for form in operator.forms]
    found = {t for form in forms for t in texts_in((form.entries or (), form.when))}
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


def test_every_operator_and_no_other_has_help_in_both_languages():
    forms = {}
    for operator in operators():
        assert all(x.strip() for x in (operator.help.en, operator.help.fr, operator.help.syntax))
        functions = {form.page[-1] for form in operator.forms}
        forms[operator.family, operator.name] = functions | {"en", "fr", "syntax"}
    for path in (Path(message.__file__).parent / "pages").glob("*.toml"):
        for name, texts in tomllib.loads(path.read_text(encoding="utf-8")).items():
            assert set(texts) <= forms[path.stem, name]
            for said in (texts, *(t for t in texts.values() if isinstance(t, dict))):
                lines = [str(said.get(language, "")).split("\n") for language in ("en", "fr")]
                assert len(lines[0]) == len(lines[1]), name
