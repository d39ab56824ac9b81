"""ORDOVIBC: complex modes in order, and followed from one basis to the next."""

import numpy as np
from script_runs import ran

SCRIPT = (
    "OPTI DIME 2 ; P1 = 0. 0. ; P2 = 1. 0. ; K1 = APPU 'UX' 4. P1 ; K2 = APPU 'UX' 9. P2 ; "
    "M = MASS 'UX' 1. (P1 ET P2) ; C = AMOR 'UX' 0.1 (P1 ET P2) ; "
    "B = VIBR 'SIMU' 0.1 2 (K1 ET K2) M ; MP = PJBA B M ; CP = PJBA B C ; "
    "T = VIBC MP (PJBA B (K1 ET K2)) CP ; ORDOVIBC T ; "
    "T2 = VIBC MP (PJBA B (K2 ET (4. * K1))) CP ; ORDOVIBC T2 T ; "
    "L1 = T . 'LISTE_FREQUENCES_REELLES' ; I1 = T . 'LISTE_FREQUENCES_IMAGINAIRES' ; "
    "L2 = T2 . 'LISTE_FREQUENCES_REELLES' ; F = T2 . 'MODES' . 3 . 'FREQUENCE_REELLE' ; "
)


def test_complex_modes_without_masses_are_told_and_drawn(tmp_path):
    shown = "RECOVIBC T B ; POSTVIBR T (MOTS 'TABL' 'LIST' 'DEFO') ; L = T . 'LISTE_FREQUENCES' ;"
    result = ran(SCRIPT + shown, output_directory=tmp_path)
    find = result.session.root.find
    np.testing.assert_array_equal(find("L").values, find("L1").values)
    assert f"{find('L1').values[0]:.5E}" in result.output
