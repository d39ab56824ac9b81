"""Numbers past what a calculation can hold are told, wherever they come in; results go on."""

import tomllib
from pathlib import Path

from script_runs import failed, ran
from together import together

from ssilang.cli.run import run_text
from ssilang.messages.message import sentence

INFINITE = "operators.numbers.past-reals"
TABLE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
NAN = TABLE["nan"]
ROWS = [(text.format(**TABLE), code) for text, code in TABLE["numbers"].items()]
ROWS += [(TABLE["large"] + text, code) for text, code in TABLE["results"].items()]


def code_of(text, folder):
    result = run_text(text, folder)
    assert [e.code for e in result.errors] != [] or result.exit_code == 0
    told = [*result.errors, *(w for w in result.session.warnings if w.code == INFINITE)]
    return told[0].code if told else ""


@together("text, code", ROWS)
def test_a_number_that_is_too_large_or_none_is_told_wherever_it_stands(text, code, tmp_path):
    assert code_of(text, tmp_path) == code


@together(
    "text, told",
    [
        ("Z = (PROG 1. 2. 0.) / (PROG 1. 0. 0.) ;", {"count": 2, "item": 2, "sign": "/"}),
        ("Z = (PROG 2. 0.) ** -1 ;", {"count": 1, "item": 2, "sign": "**"}),
        ("Z = (PROG 1. 2.) / 0. ;", {"count": 2, "item": 1, "sign": "/"}),
        ("Z = (PROG 1. 0.) / (PROG 2. 3.) ;", None),
    ],
)
def test_a_list_divided_by_zero_is_told(text, told, tmp_path):
    result = ran(text, tmp_path)
    found = [w.data for w in result.session.warnings]
    if told is None:
        assert found == []
    else:
        assert [w.code for w in result.session.warnings] == ["operators.numbers.list-not-finite"]
        assert {k: found[0][k] for k in told} == told


def test_an_operator_that_fails_over_nan_names_the_operand(tmp_path):
    text = "R = RACP -1. {} 2. ;"
    result = run_text(NAN + text.format("X"), tmp_path)
    assert [e.code for e in result.errors] == ["not-finite"]
    assert result.errors[0].span.text == "X"
    assert result.message.startswith("error: RACPOL: numbers is nan, ")
    assert run_text(NAN + text.format("5"), tmp_path).exit_code == 0


def test_an_operator_that_fails_over_a_field_names_it(tmp_path):
    text = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; S = (DROI 1 (1 0) (2 0)) TRAN 1 (0. 1.) ;"
        "M = MODE S 'MECANIQUE' 'ELASTIQUE' ; X2 Y2 = COOR S ;"
        "U = (NOMC 'UX' (X2 * {})) ET (NOMC 'UY' (Y2 * 0.1)) ; G = GRAD M U ; R V = POLA M G ;"
    )
    result = failed(NAN + text.format("Y"), tmp_path)
    assert "internal" not in [e.code for e in result.errors]
    assert run_text(NAN + text.format("0.1"), tmp_path).exit_code == 0


def test_a_message_shows_an_integer_that_is_no_real():
    data = {"start": 10**400, "step": 1, "end": 2}
    assert "1000000000" in sentence("operators.lists.steps-not-finite", data, "en")
    assert "steps of 1 from 3 to 2" in sentence(
        "operators.lists.steps-not-finite", {**data, "start": 3}, "en"
    )


def test_an_operator_that_fails_over_a_matrix_names_it(tmp_path):
    text = (
        "OPTI DIME 2 ; P1 = 0. 0. ; P2 = 1. 0. ; K = (APPU 'UX' 4. P1) ET (APPU 'UX' 9. P2) ;"
        "M = MASS 'UX' 1. (P1 ET P2) ; B = VIBR 'SIMU' 0.1 2 K M ; MP = PJBA B M ;"
        "T = VIBC MP (PJBA B K) (PJBA B (X * (AMOR 'UX' 1. (P1 ET P2)))) ;"
    )
    result = run_text(NAN + text, tmp_path)
    assert [e.code for e in result.errors] == ["operand-not-finite"]
    assert result.errors[0].span.text.startswith("(PJBA B (X * (AMOR 'UX' ")


def test_stresses_of_a_shell_without_thickness_have_no_principal_values(tmp_path):
    text = (
        "OPTI DIME 2 MODE AXIS ELEM SEG2 ; L = DROI 1 (3. 0.) (3. 1.) ;"
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'COQ2' ; A = MATE M 'YOUN' 1. 'NU' 0. 'EPAI' {} ;"
        "S = MANU 'CHML' M 'N11' 0.1 'N22' 0.3 'M11' 0. 'M22' 0. 'TYPE' 'CONTRAINTES' 'STRESSES' ;"
        "P = PRIN M S A ;"
    )
    assert code_of(text.format("0."), tmp_path) == "kernel.elements.principal-of-no-number"
    assert code_of(text.format("0.1"), tmp_path) == ""


def test_a_mesh_that_would_be_refined_without_end_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr("ssilang.kernel.mesh.changes.local_refinement._MOST_CELLS", 20_000)
    text = (
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 ({} 1.) ;"
        "T = RAFF S (0.6 + (COOR 1 S)) ; MESS (NBEL T) ;"
    )
    assert code_of(text.format("1.E9"), tmp_path) == "kernel.mesh.about-cells-needed"
    assert code_of(text.format("0."), tmp_path) == ""


def test_flat_faces_are_no_partners_of_a_joint(tmp_path):
    text = (
        "OPTI DIME 3 ELEM QUA4 ; A = (DROI 4 (0. 0. 0.) (2. 0. 0.)) TRAN 2 (0. 1. 0.) ;"
        "B = (DROI 4 (0. 0. 0.) (2. 0. 0.)) TRAN 2 (0. {}. 0.) ; J = LIAI 1.E-3 A B ;"
    )
    assert code_of(text.format(1), tmp_path) == ""
    assert code_of(text.format(0), tmp_path) not in ("", "internal")


@together("second, code", [("C * C", ""), ("2.", "operators.curves.fields-of-one-kind")])
def test_a_table_is_interpolated_between_fields_of_one_kind(second, code, tmp_path):
    text = (
        "OPTI DIME 2 ; P = -1. 0. ; C = MANU 'CHPO' P 'T' 3. ; T = TABL 'RESULTAT' ;"
        f"T . 1.5 = {second} ; T . 3. = C ; X = EXTR (IPOL T 2.) 'T' P ;"
    )
    assert code_of(text, tmp_path) == code
