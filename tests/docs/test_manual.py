"""The manual is built from the registry and speaks of every word of Cast3M."""

import re
from pathlib import Path

import pytest

from ssilang.cli.check import check_source
from ssilang.cli.run import RunOptions, run_text
from ssilang.language.cast3m import IN_SCOPE, cast3m_words, find_cast3m_word
from ssilang.language.registry import OPERATORS
from ssilang.language.run.library import standard_procedures
from ssilang.language.text.source import Source
from ssilang.messages.message import teller

_DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_a_page_shows_syntax_help_and_what_the_example_printed(build, tmp_path):
    page = next(p for p in build.all_pages() if p.name == "DIME")
    text = build.page_markdown(page, [build.run_example("MESS (DIME (PROG 1. 2.)) ;", tmp_path)])
    assert "# DIME (DIMENSION)" in text
    assert "## Syntax" in text
    assert "MESS (DIME (PROG 1. 2.)) ;" in text
    assert "\nprints\n\n```\n2\n```" in text


def test_every_page_can_be_made(build):
    for page in build.all_pages():
        text = build.page_markdown(page, [build.Ran(e) for e in page.help.examples])
        assert text.startswith(f"# {page.name}")
        assert all(line.strip() in text for line in page.help.syntax.split("\n"))
        assert text.count("## Example") == len(page.help.examples)


def test_every_operator_is_in_the_index_and_has_a_file_name_of_its_own(build):
    pages = build.all_pages()
    names = [build.file_name(p.name) for p in pages]
    assert len(names) == len(set(names))
    index = build.index_markdown(pages)
    assert all(f"]({name})" in index for name in names)


def test_coverage_speaks_of_every_operator_of_cast3m(build):
    text = build.coverage_markdown()
    rows = dict(re.findall(r"^\| `(\S+)` \| ([a-z ]+) \|", text, re.MULTILINE))
    operators = {w.name for w in cast3m_words().values() if w.kind == "operator"}
    assert operators <= set(rows)
    assert rows["DROI"] in ("built", "partly")
    assert rows["CAPA"] == "out of scope"
    built = {n for n, state in rows.items() if state in ("built", "partly")}
    assert {n for n in built if len(n) <= 4 and n in OPERATORS} >= operators & set(OPERATORS)


def test_partly_built_operators_exist(build):
    for name, text in build.partly_built().items():
        assert name in OPERATORS or name in cast3m_words(), name
        assert text


@pytest.mark.parametrize("language", ["en", "fr"])
def test_words_that_belong_here_exist_or_say_why_not(build, language):
    built = {*OPERATORS, *standard_procedures(), *build.CONTROL}
    there = {w.name: w.reason for w in cast3m_words().values() if w.subject == IN_SCOPE}
    missing = {n: r for n, r in there.items() if n not in built}
    assert missing == {n: r for n, r in there.items() if r}
    table = build.coverage_markdown()
    for name, key in missing.items():
        reason = teller(language)(f"help.reason-{key}")
        message = run_text(
            f"X = {name} 1 ; MESS X ;", options=RunOptions(language=language)
        ).message
        assert reason in message
        assert language == "fr" or f"| `{name}` | not built | {reason} |" in table


def test_words_of_cast3m_are_found_by_four_letters_or_in_full():
    assert find_cast3m_word("CAPACITE").name == "CAPA"
    assert find_cast3m_word("capa").subject == "heat"
    assert find_cast3m_word("PASAPAS").kind == "procedure"
    assert find_cast3m_word("NOWORDATALL") is None


@pytest.mark.parametrize("name", ["language.md", "differences.md", "laws.md"])
def test_scripts_in_the_guides_run(name, tmp_path):
    text = (_DOCS / name).read_text(encoding="utf-8")
    scripts = re.findall(r"```ssi\n(.*?)```", text, re.DOTALL)
    assert scripts
    for script in scripts:
        result = run_text(script, output_directory=tmp_path)
        assert result.exit_code == 0, script + result.message
        problems, _ = check_source(Source(name, script))
        assert not [p for p in problems if p.severity == "error"], script


def test_outputs_in_the_guides_are_those_of_their_scripts(tmp_path):
    text = (_DOCS / "language.md").read_text(encoding="utf-8")
    pairs = re.findall(r"```ssi\n(.*?)```\n+prints\n+```\n(.*?)```", text, re.DOTALL)
    assert pairs
    for script, printed in pairs:
        assert run_text(script, output_directory=tmp_path).output == printed
