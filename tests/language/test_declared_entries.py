"""What is declared of the entries of tables: whole, in both languages, and what the code reads."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest
from together import together

from ssilang.language.registry import find_operator
from ssilang.language.run.library import standard_procedures
from ssilang.language.text.source_files import read_source
from ssilang.language.values import known_types
from ssilang.language.vocabulary.entries import (
    ANYTHING,
    NUMBER,
    REFUSED,
    THEMES,
    UNUSED,
    WRITTEN,
    TableEntry,
    declared_names,
    read_declaration,
)
from ssilang.language.vocabulary.entries_table import entries_text
from ssilang.operators.loader import load_operators

load_operators()
OPERATORS = Path(__file__).parents[2] / "ssilang" / "operators"
NAMES = declared_names()
DECLARED = {name: read_declaration(name) for name in NAMES}
PROCEDURES = standard_procedures()
TYPES = {"bool": "LOGIQUE", "int": "ENTIER", "float": "FLOTTANT", "str": "MOT"}


def code_of(name: str) -> str:
    """The statements of a procedure, comments left out."""
    return read_source(PROCEDURES[name]).code


def all_code_of(name: str) -> str:
    """The statements of a procedure and of those that it calls."""
    code = code_of(name)
    called = [n for n in PROCEDURES if n != name and re.search(rf"(?<![\w'@]){n}(?!\w)", code)]
    return "\n".join([code, *map(code_of, called)])


def stands_in(index: str, quoted: set[str]) -> bool:
    """Whether an index is quoted, or put together (CHAI) of two that are, or of one and digits."""
    parts = [(index[:i], index[i:]) for i in range(2, len(index))]
    return index in quoted or any(a in quoted and (b in quoted or b.isdigit()) for a, b in parts)


@cache
def python_indices() -> dict[str, set[str]]:
    """Words that Python modules ask tables for, and all their words, by name of the check."""
    asked: set[str] = set()
    said: set[str] = set()
    for path in OPERATORS.rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                said.add(node.value)
            if isinstance(node, ast.Call) and _asks_entries(node):
                asked.update(a.value for a in node.args[:1] if isinstance(a, ast.Constant))
    return {"asked": {w for w in asked if isinstance(w, str)}, "said": said}


_READERS = ("get", "needed", "flag", "has", "times", "numbers", "at", "default", "about")
_HOLDERS = ("entries", "work", "own")


def _asks_entries(node: ast.Call) -> bool:
    """`entries.get("X")`, `self.entries.flag("X")` ..."""
    function = node.func
    if not isinstance(function, ast.Attribute) or function.attr not in _READERS:
        return False
    holder = function.value
    name = holder.attr if isinstance(holder, ast.Attribute) else getattr(holder, "id", "")
    return name in _HOLDERS


EVERY = {e.index for d in DECLARED.values() for e in d.entries}


@together("name", NAMES)
def test_each_entry_is_whole(name):
    for entry in DECLARED[name].entries:
        is_whole(entry)


def is_whole(entry: TableEntry) -> None:
    """Both languages, known types, a default and words that fit them."""
    assert entry.en.strip()
    assert entry.fr.strip()
    assert entry.role in {"written", "read", "both", "unused", "refused"}
    assert entry.theme in THEMES
    assert set(entry.types) <= known_types()
    if entry.fallback is not None:
        kind = TYPES[type(entry.fallback).__name__]
        assert kind in entry.types or (kind == "ENTIER" and "FLOTTANT" in entry.types)
    if isinstance(entry.default, tuple):
        assert all(text.strip() for text in entry.default)
    if entry.values:
        assert "MOT" in entry.types
        assert len({w[: entry.length or 99] for w in entry.values}) == len(entry.values)
    if isinstance(entry.fallback, str) and entry.values:
        assert entry.fallback in entry.values
    assert not entry.older or set(entry.older.values()) <= {*entry.values, "FAUX"}
    assert not (entry.needed and entry.default is not None)


@together("name", NAMES)
def test_it_belongs_to_a_procedure_or_an_operator(name):
    assert name in PROCEDURES or find_operator(name) is not None
    if name in PROCEDURES:
        heads = re.findall(r"DEBP\w*\s+" + re.escape(name) + r"\b([^;]*);", code_of(name))
        taken = set(re.findall(r"(\w+)[*/]TABLE", heads[0]))
        declared = {a.name for a in DECLARED[name].arguments}
        assert taken <= declared


def test_every_procedure_that_takes_a_table_declares_it():
    heads = {n: rf"DEBP\w*\s+{re.escape(n)}\b[^;]*[*/]TABLE" for n in PROCEDURES}
    takes = {n for n, head in heads.items() if re.search(head, code_of(n))}
    assert takes <= set(NAMES)


@together("name", [n for n in NAMES if n in PROCEDURES])
def test_procedures_read_what_is_declared_and_declare_what_they_read(name):
    code, declared = code_of(name), DECLARED[name]
    for argument in declared.arguments:
        read = re.findall(rf"(?<!\w){argument.name}\s*\.\s*'([^']+)'", code)
        read += re.findall(rf"EXIS\s+{argument.name}\s+'([^']+)'", code)
        known = {e.index for e in declared.of(argument.name)}
        lost = {w for w in read if w not in known and w != "SOUSTYPE"}
        assert not lost or ANYTHING in known
    quoted = set(re.findall(r"'([^']+)'", all_code_of(name))) | python_indices()["said"]
    own = [e for e in declared.entries if not e.taken_over and e.role not in (UNUSED, REFUSED)]
    for entry in own:
        if entry.index not in (NUMBER, ANYTHING) and len(entry.values) != 1:
            assert stands_in(entry.index, quoted), f"nothing reads {entry.index}"


def test_python_asks_only_for_what_is_declared():
    assert len(python_indices()["asked"]) > 50
    assert python_indices()["asked"] <= EVERY


@together("name", ["DYNE", "DYNC", "ZCOL", "PREC", "DESS", "BLOQ"])
def test_operators_read_what_is_declared(name):
    own = [e for e in DECLARED[name].entries if e.role not in (UNUSED, REFUSED, WRITTEN)]
    words = {e.index for e in own} - {NUMBER, ANYTHING}
    kernel = "\n".join(p.read_text() for p in (OPERATORS.parent / "kernel" / "modal").glob("*.py"))
    assert {
        w for w in words if w not in python_indices()["said"] and f'"{w}"' not in kernel
    } == set()


@together("name", NAMES)
def test_words_that_name_operators_are_shown_behind_mot(name):
    """A quoted word that names an operator runs it: such words are shown behind MOT."""
    shown = " ".join(" ".join(entries_text(DECLARED[name], "fr", 100)).split())
    for entry in DECLARED[name].entries:
        for word in entry.values:
            assert (f"MOT '{word}'" in shown) or find_operator(word[:4].rstrip()) is None


@pytest.mark.parametrize("language", ["en", "fr"])
def test_the_tables_of_the_manual_have_a_row_for_each_entry(language, build):
    text = "\n".join(build.entries_markdown(DECLARED["DYNAMIC"], language))
    for entry in DECLARED["DYNAMIC"].entries:
        if entry.index not in (NUMBER, ANYTHING):
            assert entry.index in text
        assert entry.said(language).replace("|", "\\|") in text


@together("name, index, given, wanted", [
        ("DYNAMIC", "VITEUNIL", "MASSIQUE", "INERTIE"), ("DYNAMIC", "VITEUNIL", "raid", "RAIDEUR"),
        ("DYNAMIC", "VITEUNIL", "RIGI ", "RAIDEUR"), ("DYNAMIC", "VITEUNIL", "VITESSE", None),
        ("PASAPAS", "LAGRANGIEN", "REACTUALISE", "MI_PAS"),
        ("PASAPAS", "LAGRANGIEN", "TOTAL ", "TOTAL"), ("PASAPAS", "LAGRANGIEN", "TOTA", None),
    ])  # fmt: skip
def test_a_word_is_taken_as_declared_or_as_it_was_called_before(name, index, given, wanted):
    (entry,) = (e for e in DECLARED[name].entries if e.index == index)
    assert entry.word(given) == wanted


def test_procedures_that_a_table_comes_from_declare_tables_of_their_own():
    coming = {(name, a.name): a.after for name in NAMES for a in DECLARED[name].arguments}
    assert coming["HBM_POST", "TAB1"] == ("HBM", "CONTINU")
    for place, before in coming.items():
        assert set(before) <= set(NAMES) - {place[0]}
