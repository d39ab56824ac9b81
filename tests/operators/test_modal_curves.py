"""EVOL 'RECO' and 'PJBA' on a mass on a spring, whose mode is known."""

from ssilang.cli.run import run_text

MODE = (
    "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 400. P1 ; M1 = MASS 'UX' 4. P1 ; "
    "T1 = VIBR 'SIMU' 1. 1 K1 M1 ; "
    "Q1 = MANU 'CHPO' (T1 . 'MODES' . 1 . 'POINT_REPERE') 1 'ALFA' 3. ; "
    "LT = PROG 0. 1. 5. ; LQ = SUIT Q1 (Q1 * 2.) (Q1 * -1.) ; "
    "SH = EXTR (T1 . 'MODES' . 1 . 'DEFORMEE_MODALE') 'UX' P1 ; "
)


def test_a_point_that_no_mode_has_is_still_and_told(tmp_path):
    text = MODE + "P2 = 1. 0. ; E = EVOL 'RECO' LQ LT T1 'UX' P2 ;"
    session = run_text(text, output_directory=tmp_path).session
    assert session.root.find("E").parts[0].ordinates.tolist() == [0.0, 0.0, 0.0]
    assert [w.code for w in session.warnings] == ["operators.curves.zero-at-node"]
