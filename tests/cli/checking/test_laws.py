"""`check` says of the constants of MATE what a run would say, at the same place."""

from together import together

from ssilang.cli.check import check_source
from ssilang.cli.run import run_text
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source

BODY = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; S = TRAN 1 (DROI 1 (0. 0.) (1. 0.)) (0. 1.) ;\n"
    "M = MODE S 'MECANIQUE' 'ELASTIQUE' {law} ;\n"
)
JOINT = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = DROI 2 (0. 0.) (1. 0.) ;\n"
    "J = RACC 1.E-3 L (L PLUS (0. 0.)) ; M = MODE J 'MECANIQUE' 'ELASTIQUE' {law} 'JOI2' ;\n"
)
POINT = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = MANU 'SEG2' (0. 0.) (0. 1.) ;\n"
    "M = MODE L 'MECANIQUE' 'ELASTIQUE' {law} 'JOI1' ;\n"
)
FULL = "A = MATE M {given} ; LIST (TYPE A) ;"
ELASTIC = "'YOUN' 2.E7 'NU' 0.3 "
CLAY = ELASTIC + "'E0' 1. 'M' 1. 'P0' 1.E5 'LAMD' 0.2 'G1' 8.E6 'KAPA' "
REFUSED = {
    "NU beyond 1/2": (BODY, "", "'YOUN' 2.E7 'NU' 0.6"),
    "NU by a name": (BODY, "", "'YOUN' 2.E7 'NU' NU0"),
    "density of a sign": (BODY, "", ELASTIC + "'RHO' (-1. * 2500.)"),
    "sinking J2": (BODY, "'PLASTIQUE' 'J2'",
                   ELASTIC + "'SIG0' 3.E8 'SIGI' 2.E8 'KISO' 0. 'VELO' 10."),
    "clay that unloads softer": (BODY, "'PLASTIQUE' 'CAM_CLAY'", CLAY + "0.3"),
    "angle in degrees": (BODY, "'PLASTIQUE' 'RH_COULOMB'", ELASTIC + "'COHE' 1.E4 'PHI' 30."),
    "softening joint": (JOINT, "'JOINT_SDM'", "'KN' 1.E6 'KS' 1.E6 'FU' 1.E5 'GF' 10."),
    "negative joint": (JOINT, "'JOINT_SDM'", "'KN' -1.E6 'KS' 1.E6"),
    "misspelt parameter": (POINT, "'JOINT_SDM'", "'KM' 1.E6 'KS' 1.E6"),
    "bearing that stiffens": (POINT, "'APPUI_PLOMB'",
                              "'KN' 1.E9 'KS' 1.E6 'QD' 1.E5 'KPOS' 2.E6"),
}  # fmt: skip
"""Model, words of the law, parameters."""


def deck(model: str, law: str, given: str, before: str = "NU0 = 0.3 + 0.3 ;\n") -> str:
    return before + model.replace("{law}", law) + FULL.replace("{given}", given)


def found(text: str) -> list[SsiError]:
    problems, _ = check_source(Source("script", text))
    return [p for p in problems if p.code != "unused-name"]


@together("name", REFUSED)
def test_check_refuses_as_the_run_does(name):
    text = deck(*REFUSED[name])
    (ran,), (checked,) = run_text(text).errors, found(text)
    assert checked.severity == "error"
    for language in ("en", "fr"):
        assert render(checked, language) == render(ran, language)


@together(
    "model, law, given",
    [
        (BODY, "", ELASTIC + "'RHO' 2500."),
        (BODY, "'PLASTIQUE' 'CAM_CLAY'", CLAY + "0.05"),
        # what a loop or a condition gives is no constant
        (BODY, "", "'YOUN' 2.E7 'NU' X0"),
        (BODY, "'PLASTIQUE' 'CAM_CLAY'", CLAY + "X0"),
        (BODY, "'PLASTIQUE' 'ISOTROPE'", ELASTIC + "'TRAC' T0"),
        (BODY, "'PLASTIQUE' 'IWAN'", ELASTIC + "'GAMR' 1.E-4"),
        (JOINT, "'JOINT_SDM'", "'KN' 1.E6 'KS' 1.E6 'FU' 1.E5 'GF' (X0 * 1.E6)"),
        (POINT, "'APPUI_PLOMB'", "'KN' 1.E9 'KS' 1.E6 'QD' 1.E5 'KPOS' X0"),
    ],
)
def test_what_is_sound_or_known_in_a_run_alone_is_not_refused(model, law, given):
    before = (
        "X0 = 0.9 ; REPE BX 1 ; X0 = X0 / 10. ; FIN BX ;\n"
        "T0 = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 2.E7 2.1E7) ;\n"
    )
    text = deck(model, law, given, before)
    assert run_text(text).exit_code == 0
    assert [p for p in found(text) if p.severity == "error"] == []


def test_a_friction_that_is_an_angle_is_a_warning_before_the_run():
    text = deck(JOINT, "'JOINT_SDM'", "'KN' 1.E8 'KS' 1.E6 'FROT' 35.")
    (warned,) = found(text)
    assert (warned.code, warned.severity) == ("operators.models.friction-as-angle", "warning")
    assert warned.span is not None
    assert warned.span.text == "35."


def test_a_mesh_and_values_that_only_the_run_knows_leave_the_rest_to_be_looked_at():
    text = (
        "T = TABL ; T . 'S' = 1 ; M = MODE (T . 'S') 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;\n"
        "A = MATE M 'KN' (T . 'KN') 'KS' -1. ; LIST A ;\n"
        "B = MATE M 'KM' (T . 'KN') 'KS' 1. ; LIST B ;"
    )
    first, second = (p for p in found(text) if p.severity == "error")
    assert (first.code, first.data["name"]) == ("operators.models.parameter-range", "KS")
    assert (second.code, second.data["near"]) == ("operators.models.parameter-unknown", "KN")


def test_a_law_that_is_not_built_is_found_beside_operands_that_only_the_run_knows():
    text = deck(BODY, "'ISOTROPE' 'NON_LINEAIRE' 'NUME_LOI' 31 'C_MATERIAU' (T . 'W')", "")
    (error,) = (
        p for p in found("T = TABL ; T . 'W' = MOTS 'A' ;\n" + text) if p.severity == "error"
    )
    assert (error.code, error.data["said"]) == (
        "operators.models.behaviour-not-available",
        "NON_LINEAIRE",
    )
    assert error.span is not None
    assert error.span.text == "'NON_LINEAIRE'"
