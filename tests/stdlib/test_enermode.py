"""ENERMODE's works against closed forms and quadrature; ORDOVIBC: complex modes in order."""

import numpy as np
import pytest
from script_runs import finder, ran

from ssilang.operators.drawing import curves as drawing

MASS = """
OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 39.478417604357434 P1 ;
B1 = VIBR 'SIMU' 1. 1 K1 (MASS 'UX' 1. P1) ; P2 = B1 . 'MODES' . 1 . 'POINT_REPERE' ;
"""
BAR = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; A = 0. 0. ; B = 8. 0. ; L = DROI 8 A B ;
MO = MODE L MECANIQUE ELASTIQUE BARR ; MA = MATE MO 'YOUN' 64. 'NU' 0. 'SECT' 1. 'RHO' 1. ;
K = (RIGI MO MA) ET (BLOQ 'UX' A) ET (BLOQ 'UY' L) ; M = MASS MO MA ;
B1 = VIBR 'SIMU' 0.1 2 K M ; P1 = B1 . 'MODES' . 1 . 'POINT_REPERE' ;
P2 = B1 . 'MODES' . 2 . 'POINT_REPERE' ;
C = CHAR (FORC 'FX' 4. B) (EVOL 'MANU' (PROG 0. 1. 40.) (PROG 0. 1. 1.)) ;
TC = TABL 'CHARGEMENT' ; TC . 'BASE_A' = PJBA B1 C ; TI = TABL 'INITIAL' ;
TI . 'VITESSE' = (MANU 'CHPO' P1 1 'ALFA' 0.3) ET (MANU 'CHPO' P2 1 'ALFA' -0.2) ;
"""
OUTPUT = """
TV = TABL 'VARIABLE' ; TV . 'VITESSE' = VRAI ; TV . 'TRAVAIL_INTERIEUR' = VRAI ;
TV . 'TRAVAIL_EXTERIEUR' = VRAI ; TS = TABL 'SORTIE' ; TS . 'VARIABLE' = TV ;
"""
RUN = BAR + OUTPUT + "R = DYNE 'DE_VOGELAERE' B1 TC TI TS 400 0.01 ;"


@pytest.fixture
def drawn(monkeypatch):
    """Run a script; the times and the (external, internal, inertia, balance) of each picture."""
    pictures = []
    draw = drawing.draw_curves
    monkeypatch.setattr(
        drawing,
        "draw_curves",
        lambda curve, options: (pictures.append(curve), draw(curve, options))[1],
    )

    def run(script, folder):
        pictures.clear()
        result = ran(script, output_directory=folder)
        found = [(c.parts[0].abscissas, np.array([p.ordinates for p in c.parts])) for c in pictures]
        return result.session.root, found

    return run


def test_free_vibration_trades_motion_for_strain(drawn, tmp_path):
    _, [(t, works)] = drawn(
        MASS + OUTPUT + "TI = TABL 'INITIAL' ; TI . 'VITESSE' = MANU 'CHPO' P2 1 'ALFA' 2. ;"
        "R1 = DYNE 'DE_VOGELAERE' B1 TI TS 100 0.01 ; ENERMODE B1 R1 TI ;",
        tmp_path,
    )  # fmt: skip
    lost = 2.0 * np.sin(2 * np.pi * t) ** 2
    np.testing.assert_allclose(works[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(works[1], -lost, atol=2e-3)
    np.testing.assert_allclose(works[2], lost, atol=2e-3)
    np.testing.assert_allclose(works[3], works[:3].sum(axis=0), atol=1e-12)


def test_works_of_loaded_modes_are_the_integrals_of_their_powers(drawn, tmp_path):
    root, pictures = drawn(RUN + "ENERMODE B1 R TI VRAI ; ENERMODE B1 R TI ;", tmp_path)
    one, two, total = (works for _, works in pictures)
    np.testing.assert_allclose(one + two, total, atol=1e-12)
    assert np.abs(total[3]).max() < 1e-3 * np.abs(total[0]).max()
    t, shapes = pictures[0][0], root.find("B1").get("MODES")
    history = np.minimum(t, 1.0)
    for number, works in ((1, one), (2, two)):
        entry = shapes.get(number)
        mark, tip = entry.get("POINT_REPERE").node, root.find("B").node
        force = 4.0 * history * entry.get("DEFORMEE_MODALE").values_at("UX", np.array([tip]))[0]
        speed = np.array(
            [
                root.find("R").get(i + 1).get("VITESSE").values_at("ALFA", np.array([mark]))[0]
                for i in range(len(t))
            ]
        )
        power = force * speed
        exact = np.append(0.0, np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(t)))
        np.testing.assert_allclose(works[0], exact, atol=2e-3 * np.abs(exact).max())


def test_runs_one_after_the_other_are_one_run(drawn, tmp_path):
    _, [(_, whole), (t, pieces)] = drawn(
        RUN + "S1 = DYNE 'DE_VOGELAERE' B1 TC TI TS 250 0.01 ; T2 = TABL 'INITIAL' ;"
        "T2 . 'REPRISE' = S1 . 'REPRISE' ; TR = TABL ; TR . 1 = S1 ;"
        "TR . 2 = DYNE 'DE_VOGELAERE' B1 TC T2 TS 150 0.01 ;"
        "TE = TABL 'ENSEMBLE_DE_BASES' ; TE . 1 = B1 ;"
        "ENERMODE B1 R ; ENERMODE TE TR ;",
        tmp_path,
    )  # fmt: skip
    assert t[250] == t[251]
    np.testing.assert_allclose(np.delete(pieces, 251, axis=1), whole, atol=1e-9)


SCRIPT = (
    "OPTI DIME 2 ; P1 = 0. 0. ; P2 = 1. 0. ; K1 = APPU 'UX' 4. P1 ; K2 = APPU 'UX' 9. P2 ; "
    "M = MASS 'UX' 1. (P1 ET P2) ; C = AMOR 'UX' 0.1 (P1 ET P2) ; "
    "B = VIBR 'SIMU' 0.1 2 (K1 ET K2) M ; MP = PJBA B M ; CP = PJBA B C ; "
    "T = VIBC MP (PJBA B (K1 ET K2)) CP ; ORDOVIBC T ; "
    "T2 = VIBC MP (PJBA B (K2 ET (4. * K1))) CP ; ORDOVIBC T2 T ; "
    "L1 = T . 'LISTE_FREQUENCES_REELLES' ; I1 = T . 'LISTE_FREQUENCES_IMAGINAIRES' ; "
    "L2 = T2 . 'LISTE_FREQUENCES_REELLES' ; F = T2 . 'MODES' . 3 . 'FREQUENCE_REELLE' ; "
)


def test_modes_increase_then_keep_their_shape():
    find = finder(SCRIPT)
    w = np.sqrt(np.array([4.0, 9.0]) - 0.05**2) / (2 * np.pi)
    np.testing.assert_allclose(find("L1").values, [-w[1], -w[0], w[0], w[1]], rtol=1e-9)
    np.testing.assert_allclose(find("I1").values, 0.05 / (2 * np.pi), rtol=1e-9)
    # the soft oscillator has become the stiff one (16 > 9): its modes keep their places
    moved = np.sqrt(np.array([16.0, 9.0]) - 0.05**2) / (2 * np.pi)
    np.testing.assert_allclose(find("L2").values, [-moved[1], -moved[0], moved[0], moved[1]])
    assert find("F") == find("L2").values[2]


def test_modes_of_a_projected_problem_stand_on_the_body():
    """As VIBC gives them itself where the real modes stand behind the matrices."""
    script = SCRIPT + (
        "RECOVIBC T B ; S = VIBC MP (PJBA B (K1 ET K2)) CP B ; ORDOVIBC S ; E = 0. ; "
        "REPE L 4 ; A1 = T . 'MODES' . &L ; A2 = S . 'MODES' . &L ; "
        "D1 = (A1 . 'DEFORMEE_MODALE_REELLE') - (A2 . 'DEFORMEE_MODALE_REELLE') ; "
        "D2 = (A1 . 'DEFORMEE_MODALE_IMAGINAIRE') - (A2 . 'DEFORMEE_MODALE_IMAGINAIRE') ; "
        "E = E + (MAXI 'ABS' D1) + (MAXI 'ABS' D2) ; FIN L ; "
        "X = XTX (T . 'MODES' . 1 . 'DEFORMEE_MODALE_REELLE') ; "
        "N1 = NBNO (T . 'MODES' . 'MAILLAGE') ; C = EXTR (A1 . 'DEFORMEE_MODALE_REELLE_P') 'COMP' ;"
        "RECOVIBC T B ; X2 = XTX (T . 'MODES' . 1 . 'DEFORMEE_MODALE_REELLE') ;"
    )
    find = finder(script)
    assert find("E") <= 1e-12
    assert find("X") > 0.1
    assert find("X2") == find("X")  # again: nothing changes
    assert list(find("C").values) == ["ALFA"]


def test_complex_modes_without_masses_are_told_and_drawn(tmp_path):
    shown = "RECOVIBC T B ; POSTVIBR T (MOTS 'TABL' 'LIST' 'DEFO') ; L = T . 'LISTE_FREQUENCES' ;"
    result = ran(SCRIPT + shown, output_directory=tmp_path)
    find = result.session.root.find
    np.testing.assert_array_equal(find("L").values, find("L1").values)
    assert f"{find('L1').values[0]:.5E}" in result.output
