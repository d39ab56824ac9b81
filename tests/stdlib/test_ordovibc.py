"""ORDOVIBC: complex modes in order, and followed from one basis to the next."""

import numpy as np
from script_runs import finder, ran

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
