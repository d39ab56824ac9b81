"""Whole messages of broken scripts, as their reader sees them.

Each script of `scripts/` has its message beside it, in English (`.en.txt`), some in French
(`.fr.txt`). After a deliberate change of wording, write them anew with
`SSILANG_UPDATE=1 python -m pytest tests/diagnostics` and read every line of the difference.
"""

from __future__ import annotations

import io
import os
from pathlib import Path

import pytest

from ssilang.cli.run import RunOptions, run_source
from ssilang.language.text.source import Source

_SCRIPTS = Path(__file__).with_name("scripts")
_UPDATE = bool(os.environ.get("SSILANG_UPDATE"))
FRENCH = frozenset(
    {
        "string_never_closed", "semicolon_forgotten", "si_without_finsi", "operator_misspelt",
        "variable_never_set", "minus_in_front_of_a_name", "operand_of_the_wrong_type",
        "table_index_misspelt", "table_never_made", "error_three_calls_deep",
        "operator_of_another_subject", "structure_without_supports", "more_names_than_results",
        "loop_closed_by_another_name", "comparison_before_a_sum", "joint_law_misspelt",
        "joint_without_its_stiffness", "dynamic_entry_misspelt", "dynamic_without_its_mass",
        "load_on_nodes_out_of_the_model", "four_errors_of_different_kinds_in_one_pass",
        "operator_hidden_by_a_variable", "error_in_a_procedure_of_a_table",
        "word_held_by_a_table_is_an_operator", "word_hidden_by_a_variable",
        "point_without_a_dimension", "else_if", "loop_of_another_language",
        "operands_in_parentheses", "item_in_brackets", "procedure_without_a_result",
        "joint_sides_swapped", "load_on_a_point_written_again", "meshes_not_joined",
        "properties_of_another_zone", "decimal_comma", "quote_forgotten_lines_before",
        "option_hidden_by_a_variable", "comment_with_a_star_behind_a_statement",
        "comment_with_a_hash_behind_a_statement",
        "comment_with_slashes_behind_a_statement", "semicolon_forgotten_before_a_message",
        "text_between_double_quotes", "operator_given_to_an_entry_that_takes_other_words",
    }
)  # fmt: skip
_CASES = [(p.stem, "en") for p in sorted(_SCRIPTS.glob("*.ssi"))] + [
    (n, "fr") for n in sorted(FRENCH)
]


def message_of(name: str, language: str, folder: Path) -> str:
    """What running the script writes as its error."""
    text = (_SCRIPTS / f"{name}.ssi").read_text(encoding="utf-8")
    path = folder / f"{name}.ssi"
    path.write_text(text, encoding="utf-8")
    options = RunOptions(output_directory=folder / "out", language=language)
    result = run_source(Source(f"{name}.ssi", text, path), options, io.StringIO(), io.StringIO())
    assert result.exit_code == 1
    return result.message.replace(str(folder), "FOLDER") + "\n"


@pytest.mark.parametrize(("name", "language"), _CASES, ids=lambda v: v)
def test_message(name, language, tmp_path):
    found = message_of(name, language, tmp_path)
    pinned = _SCRIPTS / f"{name}.{language}.txt"
    if _UPDATE:
        pinned.write_text(found, encoding="utf-8")
    assert found == pinned.read_text(encoding="utf-8")


def test_there_are_at_least_sixty_broken_scripts():
    assert len(list(_SCRIPTS.glob("*.ssi"))) >= 60


@pytest.mark.parametrize("name", sorted(p.stem for p in _SCRIPTS.glob("*.ssi")))
def test_no_message_shows_the_inside_of_the_program(name):
    text = (_SCRIPTS / f"{name}.en.txt").read_text(encoding="utf-8")
    for sign in ("Traceback", "defect of ssilang", "numpy", "{", "None"):
        assert sign not in text
