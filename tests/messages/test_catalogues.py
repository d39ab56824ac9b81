"""Every code has its sentences in both languages, every sentence its code."""

import ast
import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from string import Formatter

import pytest
from together import together

import ssilang
from ssilang.language import vocabulary
from ssilang.language.cast3m import cast3m_words
from ssilang.language.registry import OPERATORS
from ssilang.language.vocabulary.entries import THEMES
from ssilang.language.vocabulary.terms import Word
from ssilang.messages.message import Message, Sentence, find, hint, sentence
from ssilang.operators.loader import load_operators
from ssilang.operators.vocabulary.pages import label_code

_ROOT = Path(ssilang.__file__).parent
_MESSAGES = _ROOT / "messages"
_ADDED = {"operator", "speaker"}
"""What calls add to the data by themselves."""
_RAISES = {"SsiError", "error", "warn", "Sentence", "NoReduction"}


@dataclass(frozen=True)
class Site:
    """A place of the program that names a code."""

    place: str
    code: str
    names: frozenset[str]
    open: bool  # further data come in as **data, or from the function that is called


@cache
def catalogue() -> dict[str, Message]:
    """All messages by their whole code."""
    found = {}
    for path in sorted(_MESSAGES.rglob("*.toml")):
        if path.parent.name in ("french", "examples", "pages"):
            continue
        room = ".".join(path.relative_to(_MESSAGES).with_suffix("").parts)
        for name in tomllib.loads(path.read_text(encoding="utf-8")):
            code = name if room == "language" else f"{room}.{name}"
            found[code] = find(code)
    return found


@cache
def program() -> tuple[tuple[Site, ...], frozenset[str]]:
    """Calls that hand a code on with its data, and all texts, of all but the catalogues."""
    rooms = {c.rpartition(".")[0] for c in catalogue()} - {""}
    sites: list[Site] = []
    texts: set[str] = set()
    for path in sorted(_ROOT.rglob("*.py")):
        if path.is_relative_to(_MESSAGES):
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                sites += _sites(node, path, rooms)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                texts.add(node.value)
    return tuple(sites), frozenset(texts)


def _sites(node: ast.Call, path: Path, rooms: set[str]) -> Iterator[Site]:
    called = node.func.attr if isinstance(node.func, ast.Attribute) else None
    called = node.func.id if isinstance(node.func, ast.Name) else called
    for first in node.args[:2]:
        code = first.value if isinstance(first, ast.Constant) else None
        if not isinstance(code, str) or " " in code:
            continue
        room, _, name = code.rpartition(".")
        if (room in rooms and name) or (first is node.args[0] and called in _RAISES):
            names = frozenset(k.arg for k in node.keywords if k.arg)
            raises = called in _RAISES or str(called).endswith("Error")
            more = not raises or any(k.arg is None for k in node.keywords)
            place = f"{path.relative_to(_ROOT)}:{node.lineno}"
            yield Site(place, code, names, more)


def names_of(template: str) -> set[str]:
    """Names of the data that a template tells, those inside of choices too."""
    found = set()
    for _, name, spec, _ in Formatter().parse(template):
        if name is not None:
            found |= {name} | names_of(spec or "")
    return found


def texts(code: str) -> tuple[str, ...]:
    """All templates that are filled with the data of a code."""
    m = catalogue()[code]
    return m.en, m.fr, m.hint_en, m.hint_fr, m.script_en, m.script_fr


def _own(code: str) -> bool:
    """Whether all its data come from the site: of the language's own, parts are computed."""
    return "." in code


@cache
def rooms() -> dict[str, list[str]]:
    """Codes by the module of the catalogue that has their sentences."""
    found: dict[str, list[str]] = {}
    for code in sorted(catalogue()):
        found.setdefault(code.rpartition(".")[0] or "language", []).append(code)
    return found


@together("room", sorted(rooms()))
def test_both_languages_tell_the_same_data(room):
    lost = [code for code in rooms()[room] if not both_languages_tell_the_same(code)]
    assert not lost


def both_languages_tell_the_same(code: str) -> bool:
    """Whether both have a sentence and, where the site gives all data, tell the same of them."""
    message = catalogue()[code]
    alike = not _own(code) or (
        names_of(message.en) == names_of(message.fr)
        and names_of(message.hint_en) == names_of(message.hint_fr)
        and bool(message.hint_en) == bool(message.hint_fr)
    )
    written = not any("À TRADUIRE" in t for t in texts(code))
    return bool(message.en) and bool(message.fr) and written and alike


@pytest.mark.parametrize("language", ["en", "fr"])
@together("room", sorted(rooms()))
def test_every_message_is_told(room, language):
    for code in rooms()[room]:
        if _own(code):
            every_value_is_told(code, language)


def every_value_is_told(code: str, language: str) -> None:
    """Fill a message with numbers, words, collections, nothing, and a sentence."""
    for value in (1, 2, "name", ("a", "b"), (), Sentence("interrupted")):
        data = {n: _fitting(n, value, "".join(texts(code))) for t in texts(code)
                for n in names_of(t)}  # fmt: skip
        assert sentence(code, data, language) or not value, code
        hint(code, data, language)
        hint(code, data, language, script=True)


def _fitting(name: str, value: object, template: str) -> object:
    """A value that the formats of a name take."""
    specs = re.findall(rf"{{{name}(?:!\w)?:([^?|{{}}]*)}}", template)
    several = any(s.split(" ")[0] in ("and", "or", "words", ";") for s in specs)
    figures = [s for s in specs if re.search(r"[deEfgG%]$", s) and s not in ("and", "words")]
    if figures:
        number = value if isinstance(value, int) else 3
        value = number if any(s.endswith("d") for s in figures) else float(number)
    return (value,) if several and not isinstance(value, tuple) else value


def test_every_code_that_is_raised_has_a_sentence():
    lost = [f"{s.place} {s.code}" for s in program()[0] if s.code not in catalogue()]
    assert not lost


def test_every_site_gives_what_its_sentence_tells():
    lost = []
    for site in program()[0]:
        if not _own(site.code) or site.code not in catalogue():
            continue
        told = set().union(*map(names_of, texts(site.code))) - _ADDED
        missing, idle = told - site.names, site.names - told - _ADDED - {"number"}
        if (missing and not site.open) or idle:
            lost.append(f"{site.place} {site.code}: lacks {missing}, tells nothing of {idle}")
    assert not lost


def test_every_sentence_has_a_site():
    of_library = set(re.findall(r"'(stdlib\.[a-z0-9-]+)'", _library_text()))
    assert {c for c in catalogue() if c.startswith("stdlib.")} == of_library
    names = "cli/usage.toml", "language/say/foreign.toml", "report/page.toml"
    text = "".join((_ROOT / name).read_text("utf-8") for name in names)
    of_tables = {*re.findall(r"[a-z.]+(?:-[a-z]+)+", text), *re.findall(r'"([a-z.-]+)"', text)}
    assert not set(catalogue()) - program()[1] - of_library - of_tables - named_words()


def named_words() -> set[str]:
    """Codes of what the words of the program are called in help, which are put together."""
    load_operators()
    names = {f"subject-{word.subject}" for word in cast3m_words().values()}
    names |= {f"reason-{word.reason}" for word in cast3m_words().values() if word.reason}
    names |= {f"theme-{theme}" for theme in THEMES}
    names |= {f"family-{o.family}" for o in OPERATORS.values()} | {"family-procedures"}
    names |= {"operator", "procedure"}
    every = [(kind, word) for kind in vocabulary.KINDS for word in vocabulary.words(kind)]
    every += [("value", Word("", "", ""))]
    return {f"help.{name}" for name in names} | {label_code(*word) for word in every}


def test_every_word_of_the_program_is_called_something():
    assert named_words() <= set(catalogue())


def _library_text() -> str:
    files = sorted((_ROOT.parent / "stdlib").glob("*.ssi"))
    assert files
    return "\n".join(f.read_text(encoding="utf-8") for f in files)


def test_procedures_of_the_library_refuse_by_code():
    """A sentence in the procedure itself would be told in one language only."""
    assert not re.findall(
        r"^[^*\n]*\bERRE +(?:\(CHAI|'(?!stdlib\.)).*", _library_text(), re.MULTILINE
    )


def test_only_the_kernel_has_other_hints_for_scripts():
    """The others' own are in the words of scripts already."""
    with_both = {c: m for c, m in catalogue().items() if m.script_en or m.script_fr}
    assert len(with_both) > 50
    assert {c.partition(".")[0] for c in with_both} == {"kernel"}
    assert all(names_of(m.script_en) == names_of(m.script_fr) for m in with_both.values())


def test_codes_say_the_thing():
    """No code is another one with a number behind it."""
    assert not [c for c in catalogue() if re.search(r"-\d$", c)]


@together("code", ["..messages.x", "kernel/mesh.x", "../language.x", "x.y", "kernel.x"])
def test_a_code_without_a_message_is_a_defect(code):
    with pytest.raises(LookupError, match="no message has the code"):
        find(code)
