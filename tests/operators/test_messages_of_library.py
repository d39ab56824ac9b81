"""What a procedure of the standard library refuses, in both languages, at the script's line."""

import pytest
from together import together

from ssilang.cli.run import RunOptions, run_text
from ssilang.language.say.diagnostics import render


@together(
    "language, told",
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


@together(
    "language, told",
    [
        ("en", "warning: IMPEDSOL: KAUSEL for DISQUE is static"),
        ("fr", "avertissement : IMPEDSOL : KAUSEL pour DISQUE est statique"),
    ],
)
def test_a_procedure_warns_at_the_line_of_the_script_and_goes_on(language, told, tmp_path):
    options = RunOptions(output_directory=tmp_path, language=language)
    text = (
        "OPTI DIME 2 ; T = TABL ; T . 'FORME' = 'DISQUE' ; T . 'RAYON' = 1. ; T . 'YOUNG' = 1. ;\n"
        "T . 'POISSON' = 0. ; T . 'MASSE_VOLUMIQUE' = 1. ; T . 'EPAISSEUR' = 3. ;\n"
        "R = IMPEDSOL T ; X = R . 'STATIQUE' . 'UX' ;"
    )
    result = run_text(text, options=options)
    (warning,) = result.session.warnings
    shown = render(warning, language)
    assert shown.startswith(told), shown
    assert "script:3:" in shown
    assert result.exit_code == 0
    assert result.session.root.find("X") == pytest.approx(8.0 * 0.5 / 2.0 * (1.0 + 1.0 / 6.0))
