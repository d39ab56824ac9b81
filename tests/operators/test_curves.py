"""EVOL in its kinds, also of DYNAMIC and of modes: parts of curves, names, values at a time."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import run_text


@together(
    "names, kept",
    [
        (("F(T)", "G(T)"), ("F(T)", "G(T)")),
        (("'TIME'", "'FORCE'"), ("TIME", "FORCE")),
        (("TIME", ""), ("TIME", "")),
        (("'F (T)'", "X"), ("F (T)", "X")),
    ],
)
def test_one_name_stands_before_each_list(found, names, kept):
    text = "E = EVOL 'MANU' {} (PROG 0. 1.) {} (PROG 2. 3.) ;"
    part = found(text.format(*names), "E").parts[0]
    assert (part.abscissa_name, part.ordinate_name) == kept


@together(
    "place, legends",
    [
        ("P1", ["UX P1"]),
        ("(POIN 1 L)", ["UX P1"]),
        ("(POIN 2 L)", ["UX 3"]),
        ("L", ["UX P1", "UX 3", "UX TOP"]),
    ],
)
def test_legends_name_the_points_of_the_script(found, place, legends):
    e = found(
        "OPTI DIME 2 ; P1 = 0. 0. ; TOP = 2. 0. ; L = (P1 ET (1. 0.)) ET TOP ; "
        "C = MANU 'CHPO' L 1 'UX' 2. ; "
        f"E = EVOL 'TEMP' (SUIT C C) (PROG 0. 1.) 'UX' {place} ; ",
        "E",
    )
    assert [p.legend for p in e.parts] == legends


FREE_MASS = """OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; T1 = TABL ;
T1 . 'RIGI' = (APPU 'DEPL' 1.E-9 P) ; T1 . 'MASS' = MASS 'DEPL' 1. P ;
T1 . 'DEPL' = MANU 'CHPO' P 2 'UX' 0. 'UY' 0. ;
T1 . 'VITE' = MANU 'CHPO' P 2 'UX' 3. 'UY' 0. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; T1 . 'PAS_SAUVES' = 'TOUS' ;
T2 = DYNAMIC T1 ;"""


@together("word, last", [("'DEPL'", 3.0), ("'VITE'", 3.0), ("", 3.0)])
def test_quantity_of_the_steps_is_drawn_in_time(word, last):
    result = ran(
        f"{FREE_MASS} E = EVOL 'TEMP' T2 {word} 'UX' P ; LT = EXTR E 'ABSC' ; LU = EXTR E 'ORDO' ;"
    )
    t, u = (result.session.root.find(n).values for n in ("LT", "LU"))
    assert t == pytest.approx(np.linspace(0.0, 1.0, 11))
    assert u[-1] == pytest.approx(last, rel=1e-8)


HELD = """OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; L = DROI 1 P Q ; T1 = TABL ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; MA = MATE MO 'YOUN' 4. 'NU' 0. 'SECT' 1. 'RHO' 1. ;
BL = (BLOQ 'UX' P) ET (BLOQ 'UY' L) ;
T1 . 'RIGI' = (RIGI MO MA) ET BL ; T1 . 'MASS' = MASS 'DEPL' 1. L ;
T1 . 'VITE' = MANU 'CHPO' Q 1 'UX' 3. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; T1 . 'PAS_SAUVES' = 'TOUS' ;
T2 = DYNAMIC T1 ;
"""
MADE = "REPE B1 11 ; CH = T2 . &B1 . 'DEPL' ; X = MAXI CH ; FIN B1 ;"


@pytest.mark.parametrize("what", ["'UX' Q", "'UY' Q", "'UX' P", "(MOTS 'UX' 'UY') L"])
def test_curves_are_the_same_before_and_after_fields_are_made(found, what):
    curves = f"E = EVOL 'TEMP' T2 'DEPL' {what} ;"
    before = found(HELD + curves, "E")
    after = found(HELD + MADE + curves, "E")
    assert len(before.parts) == len(after.parts)
    for one, other in zip(before.parts, after.parts, strict=True):
        assert np.array_equal(one.ordinates, other.ordinates)
    if what == "'UX' Q":  # average acceleration of sqrt(4 N/m / 1 kg), cos of the step's angle
        angle = 2.0 * np.arctan(2.0 * 0.1 / 2.0)
        exact = 1.5 * np.sin(angle * np.arange(11))
        assert before.parts[0].ordinates == pytest.approx(exact, abs=1e-12)


def test_a_multiplier_in_time_is_the_force_of_its_support(found):
    table = found(HELD, "T2")
    nodes = [set(table.get(3).get("DEPL").components[name].nodes) for name in ("LX", "UX")]
    at = 1 + min(nodes[0] - nodes[1])
    one = found(HELD + f"E = EVOL 'TEMP' T2 'DEPL' 'LX' (NOEU {at}) ;", "E")
    assert np.abs(one.parts[0].ordinates).max() > 1.0


MODE = (
    "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 400. P1 ; M1 = MASS 'UX' 4. P1 ; "
    "T1 = VIBR 'SIMU' 1. 1 K1 M1 ; "
    "Q1 = MANU 'CHPO' (T1 . 'MODES' . 1 . 'POINT_REPERE') 1 'ALFA' 3. ; "
    "LT = PROG 0. 1. 5. ; LQ = SUIT Q1 (Q1 * 2.) (Q1 * -1.) ; "
    "SH = EXTR (T1 . 'MODES' . 1 . 'DEFORMEE_MODALE') 'UX' P1 ; "
)


def test_recombined_curve_is_the_shape_times_the_contributions(found):
    curve, shape = found(MODE + "E = EVOL 'RECO' LQ LT T1 'UX' P1 ;", "E", "SH")
    part = curve.parts[0]
    np.testing.assert_allclose(part.ordinates, np.array([3, 6, -3]) * shape)
    assert part.abscissas.tolist() == [0, 1, 5]


def test_projection_is_the_product_with_the_shape(found):
    plain, weighted, shape = found(
        MODE + "LU = RECO LQ T1 ; A = EVOL 'PJBA' LU LT T1 ; B = EVOL 'PJBA' LU LT T1 1 M1 ;",
        "A", "B", "SH",
    )  # fmt: skip
    u = np.array([3, 6, -3]) * shape
    np.testing.assert_allclose(plain.parts[0].ordinates, u * shape)
    np.testing.assert_allclose(weighted.parts[0].ordinates, 4 * u * shape)


def test_a_point_that_no_mode_has_is_still_and_told(tmp_path):
    text = MODE + "P2 = 1. 0. ; E = EVOL 'RECO' LQ LT T1 'UX' P2 ;"
    session = run_text(text, output_directory=tmp_path).session
    assert session.root.find("E").parts[0].ordinates.tolist() == [0.0, 0.0, 0.0]
    assert [w.code for w in session.warnings] == ["operators.curves.zero-at-node"]
