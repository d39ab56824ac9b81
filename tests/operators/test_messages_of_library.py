"""What a procedure of the standard library refuses, in both languages, at the script's line."""

import pytest

from ssilang.cli.run import RunOptions, run_text


@pytest.mark.parametrize(
    ("language", "told"),
    [
        ("en", "error 308: CONVT: ZUT is no unit of time"),
        ("fr", "erreur 308 : CONVT : ZUT n'est pas une unité de temps"),
    ],
)
def test_a_procedure_refuses_in_the_language_of_the_run(language, told, tmp_path):
    options = RunOptions(output_directory=tmp_path, language=language)
    result = run_text("A = 1 ;\nX = CONVT 1. 'ZUT' ;\n", options=options)
    assert result.exit_code == 1
    assert result.message.startswith(told), result.message
    assert "script:2:" in result.message
    assert result.errors[0].code == "stdlib.convt-no-unit-time-fs"
