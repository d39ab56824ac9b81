"""Every example of the help of every operator and procedure runs."""

from __future__ import annotations

import pytest

from ssilang.cli.run import run_text
from ssilang.language.registry import OPERATORS
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.reference import operator_page, procedure_page
from ssilang.operators.loader import load_operators

load_operators()
_PAGES = [operator_page(o) for n, o in sorted(OPERATORS.items()) if n == o.name]
_PAGES += [procedure_page(p) for p in standard_procedures().values()]
_EXAMPLES = [
    pytest.param(text, id=f"{page.name}-{number}")
    for page in _PAGES
    for number, text in enumerate(page.help.examples, 1)
]


@pytest.mark.parametrize("text", _EXAMPLES)
def test_example_runs(text, tmp_path):
    result = run_text(text, output_directory=tmp_path)
    assert result.exit_code == 0, result.message
