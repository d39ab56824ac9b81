"""Laws that operators obey for all operands: linearity, symmetry, inverses, idempotence."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from script_runs import session_after

from ssilang.cli.run import execute
from ssilang.language.text.source import Source

FEW = settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
number = st.floats(-50.0, 50.0).map(lambda x: round(x, 3))
positive = st.floats(0.1, 10.0).map(lambda x: round(x, 3))
count = st.integers(1, 7)

PRELUDE = """
OPTI 'DIME' 3 'ELEM' 'CUB8' 'MODE' 'TRID' ;
L1 = DROI 2 (0. 0. 0.) (1. 0. 0.2) ; W1 = L1 TRAN 1 (0. 1. 0.) ; S1 = W1 VOLU 2 'TRAN' (0.1 0. 1.) ;
MO = MODE S1 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 100. 'NU' 0.3 'RHO' 2. ;
U0 = (NOMC 'UX' ((COOR 1 S1) ** 2)) ET (NOMC 'UY' ((COOR 2 S1) * (COOR 3 S1)))
  ET (NOMC 'UZ' ((COOR 3 S1) ** 3)) ;
V0 = (NOMC 'UX' (COOR 3 S1)) ET (NOMC 'UY' ((COOR 1 S1) ** 2)) ET (NOMC 'UZ' (COOR 2 S1)) ;
PB = S1 POIN 'PROC' (1.1 1. 1.2) ; PC = S1 POIN 'PROC' (0.6 0. 1.1) ;
RB = (RIGI MO MA) ET (BLOQ 'DEPL' W1) ; MS = MASS MO MA ;
"""


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_after(PRELUDE, tmp_path_factory.mktemp("laws"))


def value(session, expression: str, before: str = "") -> float:
    """A number that an expression gives."""
    execute(session, Source("statement", f"{before} X = {expression} ;"))
    return float(session.root.find("X"))


def work(matrix: str, left: str, right: str) -> str:
    """u . (M v)"""
    components = "(MOTS 'UX' 'UY' 'UZ') (MOTS 'FX' 'FY' 'FZ')"
    return f"XTY {left} ({matrix} * {right}) {components}"


@FEW
@given(number, number, number, number)
def test_coriolis_forces_do_no_work_and_grow_with_the_rotation(session, a, b, c, k):
    made = f"C1 = CORI MO MA ({a:f} {b:f} {c:f}) ;"
    size = 1.0 + abs(a) + abs(b) + abs(c)
    assert value(session, work("C1", "U0", "U0"), made) == pytest.approx(0.0, abs=1e-9 * size)
    straight, back = (value(session, work("C1", *p), made) for p in (("U0", "V0"), ("V0", "U0")))
    assert straight == pytest.approx(-back, abs=1e-9 * size)
    more = f"C2 = CORI MO MA ({k * a:f} {k * b:f} {k * c:f}) ;"
    assert value(session, work("C2", "U0", "V0"), more) == pytest.approx(
        k * straight, rel=1e-4, abs=1e-4 * size * (1 + abs(k))
    )


@FEW
@given(number, number, number)
def test_centrifugal_stiffness_is_symmetric_negative_and_even_in_the_rotation(session, a, b, c):
    made = f"K1 = KENT 'CENTRIFUGE' MO MA ({a:f} {b:f} {c:f}) ;"
    opposite = f"K1 = KENT 'CENTRIFUGE' MO MA ({-a:f} {-b:f} {-c:f}) ;"
    straight, back = (value(session, work("K1", *p), made) for p in (("U0", "V0"), ("V0", "U0")))
    size = 1e-9 * (1.0 + a * a + b * b + c * c)
    assert straight == pytest.approx(back, abs=size)
    assert value(session, work("K1", "U0", "V0"), opposite) == pytest.approx(straight, abs=size)
    assert value(session, work("K1", "U0", "U0"), made) <= size


@FEW
@given(number, number, number)
def test_projection_in_cells_keeps_linear_fields_and_repeats_itself(session, a, b, c):
    made = (
        f"F1 = CHAN 'CHAM' (NOMC 'SCAL' (({a:f} * (COOR 1 S1)) + ({b:f} * (COOR 2 S1)) "
        f"+ ({c:f} * (COOR 3 S1)))) S1 ; F2 = PROI MO F1 'MINI' ; F3 = PROI MO F2 'MINI' ;"
    )
    size = 1e-8 * (1.0 + abs(a) + abs(b) + abs(c))
    assert value(session, "MAXI (F2 - F1) 'ABS'", made) <= size
    assert value(session, "MAXI (F3 - F2) 'ABS'") <= size


@FEW
@given(st.lists(st.floats(-9.0, 9.0), min_size=2, max_size=6), count, count)
def test_refinements_of_lists_follow_one_another(session, values, m, n):
    text = " ".join(f"{v:f}" for v in values)
    execute(
        session,
        Source(
            "statement",
            f"L0 = PROG {text} ; LA = RAFF (RAFF L0 {m}) {n} ; LB = RAFF L0 {m * n} ;"
            f" LC = RAFF L0 1 ;",
        ),
    )
    start, twice, once, same = (session.root.find(k).values for k in ("L0", "LA", "LB", "LC"))
    np.testing.assert_allclose(twice, once, atol=1e-12)
    np.testing.assert_allclose(once[:: m * n], start, atol=1e-12)
    np.testing.assert_array_equal(same, start)


@FEW
@given(positive, positive, number)
def test_responses_over_frequencies_are_reciprocal_and_grow_with_the_load(session, f, push, k):
    """u_C by a force at B is u_B by the same force at C; k times the force gives k times u."""

    def sweep(at: str, size: float) -> str:
        return (
            f"TT = TABL ; TT . 'MODELE' = MO ; TT . 'CARACTERISTIQUES' = MA ; "
            f"TT . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' W1 ; TT . 'AMORTISSEMENT' = 0.05 * RB ; "
            f"TT . 'CHARGEMENT' = CHAR 'MECA' (FORC 'FX' ({size:f}) {at}) "
            f"(EVOL 'MANU' (PROG 0. 20.) (PROG 1. 1.)) ; "
            f"TT . 'TEMPS_CALCULES' = PROG {f:f} ; OPTI 'MODE' 'FREQ' ; PASAPAS TT ; "
            f"OPTI 'MODE' 'TRID' ;"
        )

    def at(point: str, part: str) -> str:
        return f"EXTR (TT . 'DEPLACEMENTS' . 1) '{part}' {point}"

    for part in ("UX", "IUX"):
        there = value(session, at("PC", part), sweep("PB", push))
        back = value(session, at("PB", part), sweep("PC", push))
        scaled = value(session, at("PC", part), sweep("PB", k * push))
        tiny = 1e-9 * push * (1 + abs(k))
        assert there == pytest.approx(back, rel=1e-6, abs=tiny)
        assert scaled == pytest.approx(k * there, rel=1e-4, abs=1e-6 * push)


FLOOR = (
    "T1 = TABL ; TS = TABL ; T1 . 'STRUC' = TS ; TS . 'NMODE' = 1 ; TS . 'FREQU' = TABL ; "
    "TS . 'FREQU' . 1 = 3. ; TS . 'AMORT' = TABL ; TS . 'AMORT' . 1 = 0.05 ; TP = TABL ; "
    "T1 . 'PLANCH' = TP ; TP . 'COEFFPL' = TABL ; TP . 'COEFFPL' . 1 = {share:f} ; "
    "TP . 'AMORTPL' = 0.02 ; TP . 'TYPSPPL' = 'ACCE' ; TP . 'LISFREQ' = PROG 2. 5. ; "
    "TE = TABL ; T1 . 'EXCIT' = TE ; TE . 'DUREE' = 12. ; "
    "TE . 'DSP' = EVOL 'MANU' (PROG 0.2 25.) (PROG {power:f} {power:f}) ; T2 = SPPLANC T1 ;"
)


@settings(FEW, max_examples=4)
@given(positive, positive)
def test_floor_spectra_grow_with_the_root_of_the_power(session, power, factor):
    found = []
    for times in (1.0, factor):
        execute(session, Source("s", FLOOR.format(share=1.3, power=round(power * times, 6))))
        table = session.root.find("T2")
        found.append([table.get(k).parts[0].ordinates for k in ("SIGM", "FPIC")])
    (s1, p1), (s2, p2) = found
    np.testing.assert_allclose(s2, s1 * np.sqrt(factor), rtol=1e-4)
    np.testing.assert_allclose(p2, p1, rtol=1e-4)
