"""Help pages: every operator and procedure has one, in two languages."""

import tomllib
from pathlib import Path

from together import together

from ssilang.language.registry import OPERATORS, operators_by_family
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.reference import example_lines, find_page, overview, page_text
from ssilang.messages import message
from ssilang.operators.loader import load_operators

load_operators()
# what procedures of the library call; not for users
_WORKERS = ("ZBIL", "ZCON", "ZDYN", "ZFRE", "ZHBM", "ZHPO", "ZPAS", "ZPIL", "ZSPP")
_NAMES = sorted({o.name for o in OPERATORS.values()}) + sorted(standard_procedures())


@together("name", _NAMES)
def test_page(name):
    page = find_page(name, standard_procedures())
    assert page is not None
    assert page.help.en
    assert page.help.fr
    assert page.help.syntax, "a syntax line"
    assert page.help.examples or name in _WORKERS, "an example"
    for language in ("en", "fr"):
        assert name in page_text(page, language)


def test_overview_names_them_all():
    text = overview(standard_procedures().values(), "en")
    assert all(name in text for name in _NAMES)


@together("name", _NAMES)
def test_examples_are_shown_as_they_run(name):
    for example in find_page(name, standard_procedures()).help.examples:
        shown = example_lines(example)
        assert " ".join(" ".join(shown).split()) == " ".join(example.split())


@together("family", sorted(operators_by_family()))
def test_examples_stand_by_operators_of_their_family(family):
    names = {found.name for found in operators_by_family()[family]}
    path = Path(message.__file__).parent / "examples" / f"{family}.toml"
    assert set(tomllib.loads(path.read_text(encoding="utf-8"))) <= names
