"""SUPE: condensation against the whole body."""

import numpy as np
import pytest
from script_runs import failed, ran
from together import together

BODY = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; P1 = 0. 0. ; P2 = 2. 0. ; P3 = 5. 0. ; "
    "S1 = (DROI 4 P1 P2) TRAN 3 (0. 1.) ; L = COTE 2 S1 ; S2 = L TRAN 6 (3. 0.) ; "
    "M1 = MODE S1 MECANIQUE ELASTIQUE ; M2 = MODE S2 MECANIQUE ELASTIQUE ; "
    "A1 = MATE M1 YOUN 1.E3 NU 0.3 RHO 2. ; A2 = MATE M2 YOUN 3.E3 NU 0.2 RHO 1. ; "
    "R1 = (RIGI M1 A1) ET (BLOQ 'DEPL' (COTE 4 S1)) ; R2 = RIGI M2 A2 ; "
    "B2 = BLOQ 'UY' (S2 POIN 'PROC' P3) ; D2 = DEPI B2 -0.1 ; "
    "F1 = FORC (1. 0.) (S1 POIN 'PROC' (1. 1.)) ; F2 = FORC (0. -1.) (S2 POIN 'PROC' (4. 1.)) ; "
    "LU = MOTS 'UX' 'UY' ; "
)


def found(script, *names):
    result = ran(BODY + script)
    values = tuple(result.session.root.find(n) for n in names)
    return values[0] if len(names) == 1 else values


def refused(script):
    return failed(BODY + script).message


@together("nomu", ["", "'NOMU'"])
@together("masters", ["L", "(BLOQ 'DEPL' L)", "(FORC (1. 1.) L 'UX' 'UY')"])
def test_condensed_part_gives_the_whole_solution(nomu, masters):
    """Part 2, with an imposed displacement and loads inside, condensed onto the common line."""
    if masters.startswith("(FORC"):
        masters = "(MANU 'CHPO' L 2 'UX' 1. 'UY' 1.)"
    script = (
        f"SU = SUPE 'RIGI' {nomu} (R2 ET B2) {masters} ; F3 = SUPE 'CHAR' SU (F2 ET D2) ; "
        "U = RESO (R1 ET (EXTR SU 'RIGI')) (F1 ET F3) ; V = SUPE 'DEPL' SU U (F2 ET D2) ; "
        "W = RESO (R1 ET R2 ET B2) (F1 ET F2 ET D2) ; "
        "A = MAXI (ABS (U - (REDU W U))) 'AVEC' LU ; B = MAXI (ABS (V - (REDU W S2))) 'AVEC' LU ; "
        "C = MAXI (ABS ((REAC B2 V) - (REAC B2 W))) ; X = MAXI (ABS (REAC B2 W)) ;"
    )
    script = script.replace("(REDU W U)", "(REDU W S1)").replace("(U -", "((REDU U S1) -")
    at_masters, inside, reaction, size = found(script, "A", "B", "C", "X")
    assert at_masters == pytest.approx(0.0, abs=1e-11)
    assert inside == pytest.approx(0.0, abs=1e-11)
    assert size > 1e-3
    assert reaction == pytest.approx(0.0, abs=1e-9 * size + 1e-12)


def test_kept_conditions_can_be_loaded_afterwards():
    """Without NOMU the imposed value goes to RESO with the rest."""
    script = (
        "SU = SUPE 'RIGI' (R2 ET B2) L ; U = RESO (R1 ET (EXTR SU 'RIGI')) "
        "(F1 ET (SUPE 'CHAR' SU F2) ET D2) ; W = RESO (R1 ET R2 ET B2) (F1 ET F2 ET D2) ; "
        "A = MAXI (ABS ((REDU U S1) - (REDU W S1))) 'AVEC' LU ;"
    )
    assert found(script, "A") == pytest.approx(0.0, abs=1e-11)


def test_kept_conditions_may_be_unilateral():
    script = (
        "B3 = BLOQ 'MINI' 'UY' (COTE 1 S2) ; SU = SUPE 'RIGI' (R2 ET B3) L ; "
        "U = RESO (R1 ET (EXTR SU 'RIGI')) (F1 ET (SUPE 'CHAR' SU F2)) ; "
        "W = RESO (R1 ET R2 ET B3) (F1 ET F2) ; "
        "A = MAXI (ABS ((REDU U S1) - (REDU W S1))) 'AVEC' LU ; B = MINI (EXCO (REDU U L) 'UY') ;"
    )
    difference, _ = found(script, "A", "B")
    assert difference == pytest.approx(0.0, abs=1e-11)
    assert "unilateral" in refused(
        "B3 = BLOQ 'MINI' 'UY' L ; SU = SUPE 'RIGI' 'NOMU' (R2 ET B3) L ;"
    )


def test_condensed_mass_keeps_rigid_motions_and_bounds_the_frequency():
    """Guyan: the total mass is kept; the first frequency comes from above, within 2 %."""
    script = (
        "SU = SUPE 'RIGI' R2 (L ET (COTE 3 S2)) ; MS = MASS M2 A2 ; LC MC = SUPE 'MASS' SU MS "
        "'LCHP' ; "
        "Q = MANU 'CHPO' (L ET (COTE 3 S2)) 1 'UX' 1. ; A = XTX Q ; A = XTMX Q MC ; "
        "N = DIME LC ; E = 1.E9 ; "
        "K = R1 ET (EXTR SU 'RIGI') ; MM = (MASS M1 A1) ET MC ; "
        "T = VIBR 'PROC' (PROG 0.) K MM ; F = T . 'MODES' . 1 . 'FREQUENCE' ; "
        "T2 = VIBR 'PROC' (PROG 0.) (R1 ET R2) ((MASS M1 A1) ET MS) ; "
        "G = T2 . 'MODES' . 1 . 'FREQUENCE' ;"
    )
    mass, count, condensed, whole = found(script, "A", "N", "F", "G")
    assert mass == pytest.approx(3.0, rel=1e-9)
    assert count == 16
    assert whole <= condensed <= 1.02 * whole


CHAIN = (
    "OPTI ELEM SEG2 ; PA = 0. 0. ; PB = 1. 0. ; PC = 1. 0. ; PD = 2. 0. ; "
    "K1 = MANU 'RIGI' (PA DROI 1 PB) (MOTS 'UX') (PROG 2. -2. 2.) ; "
    "K2 = MANU 'RIGI' (PC DROI 1 PD) (MOTS 'UX') (PROG 3. -3. 3.) ; "
    "G = APPU 'UX' 1. PA ; T = RELA 'UX' PB - 'UX' PC ; M = MASS 'UX' 6. PC ; "
)


@together("nomu", ["", "'NOMU'"])
def test_condensed_mass_where_a_relation_ties_two_parts(nomu):
    """Springs 1, 2, 3 in series, PD moved by one: the tied middle by (1 + 1/2) / (1 + 1/2 + 1/3).

    The mass of 6 there counts by the square of that motion, whether or not the relation is kept.
    """
    script = (
        f"SU = SUPE 'RIGI' {nomu} (K1 ET K2 ET G ET T) PD ; LC MC = SUPE 'MASS' SU M 'LCHP' ; "
        "N = DIME LC ; U = EXTR LC 1 ; A = EXTR U 'UX' PC ; B = EXTR U 'UX' PA ; "
        "C = EXTR U 'UX' PB ; X = EXTR (MC * (MANU 'CHPO' PD 1 'UX' 1.)) 'FX' PD ; "
    )
    n, c, a, b, x = found(CHAIN + script, "N", "A", "B", "C", "X")
    assert n == 1
    assert (c, b) == pytest.approx((9 / 11, 9 / 11), rel=1e-12)
    assert a == pytest.approx(6 / 11, rel=1e-12)
    assert x == pytest.approx(6 * (9 / 11) ** 2, rel=1e-12)


def test_inner_mechanisms_are_refused():
    """A single master point leaves the body free to turn."""
    assert "rot" in refused("SU = SUPE 'RIGI' R2 P2 ;").lower()


def test_unsymmetric_stiffness_is_condensed_exactly():
    rng = np.random.default_rng(5)
    full = rng.normal(size=(3, 3)) + 4.0 * np.eye(3)
    terms = " ".join(repr(float(v)) for v in full.ravel())
    script = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM SEG3 ; L3 = DROI 1 (0. 0.) (2. 0.) ; PA = L3 POIN "
        "'INIT' ; "
        f"K = MANU 'RIGI' L3 (MOTS 'UX') 'QUEL' (PROG {terms}) ; SU = SUPE 'RIGI' K PA ; "
        "X = EXTR ((EXTR SU 'RIGI') * (MANU 'CHPO' PA 1 'UX' 1.)) 'FX' PA ;"
    )
    inner = full[1:, 1:]
    schur = full[0, 0] - full[0, 1:] @ np.linalg.solve(inner, full[1:, 0])
    assert found(script, "X") == pytest.approx(schur, rel=1e-12)
