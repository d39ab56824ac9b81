"""Thin plastic shells with points across the thickness."""

import numpy as np
import pytest
from script_runs import ran

PLATE = """
OPTI DIME 3 ELEM TRI3 ;
L = DROI 3 (0. 0. 0.) (10. 0. 0.) ; S = L TRAN 1 (0. 1. 0.) ;
L1 = COTE S 4 ; L2 = COTE S 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' {law} DKT 'INTEGRE' {layers} ;
MA = MATE MO 'YOUN' 2.E11 'NU' {nu} {strength} 'EPAI' 0.5 'ALPH' 1.E-5 ;
TE = MANU 'CHPO' S 3 'TINF' 1. 'T' 3. 'TSUP' 8. ;
B1 = BLOQ 'UX' 'UZ' 'RY' L1 ; B2 = BLOQ '{what}' L2 ; B3 = BLOQ 'UY' (POIN L1 1) ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = B1 ET B2 ET B3 ;
T . 'CHARGEMENT' = (CHAR 'DIMP' (DEPI B2 {size}) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.))) {heat} ;
T . 'TEMPS_CALCULES' = PROG 0. 0.1 'PAS' 0.1 1. ;
PASAPAS T ;
R = T . 'REACTIONS' . 10 ; F = EXTR (RESU (REDU R L2)) '{dual}' (POIN L2 1) ;
"""
PERFECT = {"law": "PARFAIT", "strength": "'SIGY' 1.E8"}


def run(tmp_path, more="", **words):
    words = {"layers": 7, "nu": "0.", "heat": "", **PERFECT, **words}
    return ran(PLATE.format(**words) + more, output_directory=tmp_path).session.root.find


@pytest.mark.parametrize("layers", [2, 5])
def test_below_the_limit_the_shell_is_the_elastic_one(tmp_path, layers):
    """Bent, and heated on one side more than on the other."""
    elastic = (
        "MO = MODE S 'MECANIQUE' 'ELASTIQUE' DKT ; MA = MATE MO 'YOUN' 2.E11 'NU' 0.3 'EPAI' 0.5 "
        "'ALPH' 1.E-5 ; H = THET MO MA TE ; U = RESO ((RIGI MO MA) ET B1 ET B2 ET B3) "
        "((DEPI B2 1.E-3) ET (BSIG MO MA H)) ; A = (T . 'DEPLACEMENTS' . 10) - U ; "
        "D = MAXI 'ABS' (EXCO 'UX' A) ; A = MAXI 'ABS' (EXCO 'UZ' A) ; "
        "SI0 = (SIGM MO MA U) - H ; SI1 = T . 'CONTRAINTES' . 10 ; "
        "B = MAXI 'ABS' (SI1 - SI0) ; C = MAXI 'ABS' (EXCO 'M11' SI0) ;"
    )
    heat = "ET (CHAR 'T' TE (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)))"
    words = {"what": "UZ", "dual": "FZ", "size": "1.E-3", "nu": "0.3", "heat": heat}
    find = run(tmp_path, elastic, layers=layers, **words)
    assert find("A") < 1e-12
    assert find("D") < 1e-12
    assert find("B") < 1e-8 * find("C")


def test_a_pulled_strip_yields_at_once_across(tmp_path):
    find = run(tmp_path, what="UX", dual="FX", size="0.0054")  # yields at 0.005
    assert find("F") == pytest.approx(1e8 * 0.5, rel=1e-8)


def test_bending_moment_follows_the_elastic_core(tmp_path):
    # the end turns: the moment is the same everywhere
    find = run(tmp_path, what="RY", dual="MY", size="0.1", layers=15)
    kappa, h, yield_strain = 0.1 / 10, 0.5, 1e8 / 2e11
    core = 2 * yield_strain / kappa
    exact = 1e8 * h**2 / 4 * (1 - (core / h) ** 2 / 3)
    assert abs(find("F")) == pytest.approx(exact, rel=1e-2)
    inner = find("T").get("VARIABLES_INTERNES").get(10).blocks[0].components
    assert inner["EPSE"].shape[1] == 3 * 15
    s, t, st = (inner[k] for k in ("SMSS", "SMTT", "SMST"))
    assert np.sqrt(s**2 + t**2 - s * t + 3 * st**2).max() == pytest.approx(1e8, rel=1e-8)
    found = find("T").get("CONTRAINTES").get(10).blocks[0].components
    moments = found["M11"] + found["M22"]  # in the frame of each cell
    assert np.abs(moments) == pytest.approx(np.full(moments.shape, abs(find("F"))), rel=1e-6)


def test_a_calculation_goes_on_from_its_layers(tmp_path):
    again = (
        "T2 = COPI T ; T2 . 'REPRISE' = 0.5 ; PASAPAS T2 ; "
        "A = MAXI 'ABS' (EXCO 'EPSE' ((T . 'VARIABLES_INTERNES' . 10) - "
        "(T2 . 'VARIABLES_INTERNES' . 10))) ; R2 = T2 . 'REACTIONS' . 10 ; "
        "F2 = EXTR (RESU (REDU R2 L2)) 'MY' (POIN L2 1) ;"
    )
    hardening = {"law": "ISOTROPE", "strength": "'ECRO' (EVOL 'MANU' 'EPS' (PROG 0. 0.1) "
                 "'SIG' (PROG 1.E8 4.E8))"}  # fmt: skip
    find = run(tmp_path, again, what="RY", dual="MY", size="0.1", **hardening)
    assert find("F2") == pytest.approx(find("F"), rel=1e-8)
    assert find("A") < 1e-10
