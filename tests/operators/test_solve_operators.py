"""RESO, REAC, DIAG and matrix algebra on small structures with closed solutions."""

import numpy as np
import pytest
from script_runs import failed, ran
from script_runs import found as objects

BAR = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
PA = 0. 0. ; PB = 10. 0. ; L1 = DROI 5 PA PB ;
MO = MODE L1 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
MA = MATE MO 'YOUN' 200. 'NU' 0. 'RHO' 3. 'SECT' 0.5 ;
K0 = RIGI MO MA ; BX = BLOQ 'UX' PA ; BY = BLOQ 'UY' L1 ;
K1 = K0 ET BX ET BY ; F1 = FORC 'FX' 4. PB ;
"""


def at(field, name, point):
    return float(field.values_at(name, [point.node])[0])


def test_bar_under_its_end_force_and_reaction():
    u, r, a, b = objects(BAR + "U = RESO K1 F1 ; R = REAC BX U ;", "U", "R", "PA", "PB")
    assert at(u, "UX", b) == pytest.approx(4.0 * 10.0 / (200.0 * 0.5))
    assert at(r, "FX", a) == pytest.approx(-4.0)
    assert list(r.components) == ["FX"]


def test_several_second_members_and_lists():
    script = BAR + "U1 U2 = RESO K1 F1 (2. * F1) ; LU = RESO K1 (SUIT F1 (3. * F1)) ;"
    u1, u2, listed, b = objects(script, "U1", "U2", "LU", "PB")
    assert at(u2, "UX", b) == pytest.approx(2.0 * at(u1, "UX", b))
    assert at(listed.values[1], "UX", b) == pytest.approx(3.0 * at(u1, "UX", b))


def test_order_of_operands_is_free():
    script = BAR + "U1 = RESO F1 K1 ;"
    u, b = objects(script, "U1", "PB")
    assert at(u, "UX", b) == pytest.approx(0.4)


def test_stop_is_reached_or_not():
    script = BAR + (
        "BM = BLOQ 'MAXI' 'UX' PB ; U1 = RESO (K1 ET BM) (F1 ET (DEPI BM 0.3)) ;"
        "U2 = RESO (K1 ET BM) (F1 ET (DEPI BM 0.5)) ; R1 = REAC BM U1 ; R2 = REAC BM U2 ;"
        "U3 = RESO (K1 ET BM) (F1 ET (DEPI BM 0.5)) 'NOUNIL' ;"
    )
    u1, u2, r1, r2, u3, b = objects(script, "U1", "U2", "R1", "R2", "U3", "PB")
    assert at(u1, "UX", b) == pytest.approx(0.3)
    assert at(r1, "FX", b) == pytest.approx(-1.0)
    assert at(u2, "UX", b) == pytest.approx(0.4)
    assert at(r2, "FX", b) == 0.0
    assert at(u3, "UX", b) == pytest.approx(0.5)


def test_free_body_is_named_and_may_be_asked_for():
    free = BAR + "K2 = K0 ET BY ;"
    result = failed(free + "U = RESO K2 F1 ;")
    assert "translation along X" in result.message
    assert "UX at node" in result.message
    u, count, pins = objects(free + "U N1 M1 = RESO K2 F1 'ENSE' ;", "U", "N1", "M1")
    assert count == 1
    assert pins.n_cells == 1
    ux = u.components["UX"].values
    np.testing.assert_allclose(ux, ux[0])
    balanced = free + "U = RESO K2 (F1 ET (FORC 'FX' -4. PA)) ;"
    u, a, b = objects(balanced, "U", "PA", "PB")
    assert at(u, "UX", b) - at(u, "UX", a) == pytest.approx(0.4)


def test_loads_on_free_motions_are_left_out_when_told():
    free = BAR + "K2 = K0 ET BY ; U = RESO K2 F1 'NOID' ; W = RESO K2 F1 'SOUC' ;"
    result = ran(free)
    assert len(result.session.warnings) == 1


def test_force_on_an_unknown_that_the_matrix_lacks_is_refused():
    result = failed(BAR + "U = RESO K1 (F1 ET (MOME 'MZ' 1. PB)) ;")
    assert "MZ at node" in result.message


def test_negative_eigenvalues_are_counted_on_admissible_motions():
    script = BAR + (
        "N0 = DIAG K1 ; K2 = K1 ET (APPU 'UX' -100. PB) ; N1 = DIAG K2 ;"
        "N2 = DIAG (K2 ET (BLOQ 'UX' PB)) ;"
    )
    assert objects(script, "N0", "N1", "N2") == (0, 1, 0)


def test_matrix_signs_and_forms():
    script = BAR + (
        "K2 = 2. * K0 ; K3 = K2 / 4. ; U = RESO K1 F1 ; W1 = XTMX U K0 ; W2 = XTMX U K2 ;"
        "W3 = YTMX U U K3 ; G = K0 * U ; K4 = K2 - K0 ; W4 = XTMX U K4 ;"
    )
    w1, w2, w3, w4, g, b = objects(script, "W1", "W2", "W3", "W4", "G", "PB")
    assert [w1, w2, w3, w4] == pytest.approx([1.6, 3.2, 0.8, 1.6])
    assert at(g, "FX", b) == pytest.approx(4.0)


def test_parts_of_a_matrix():
    script = BAR + (
        "BM = BLOQ 'MINI' 'UX' PB ; KT = K1 ET BM ; M0 = EXTR KT 'MAIL' 'NOMU' ;"
        "M1 = EXTR KT 'MAIL' 'MULT' ; M2 = EXTR KT 'MAIL' 'UNIL' ; M3 = EXTR KT 'MAIL' ;"
        "KN = EXTR KT 'RIGI' 'NOMU' ; KM = EXTR KT 'RIGI' 'MULT' ; C1 = EXTR KT 'COMP' ;"
        "C2 = EXTR KT 'COMP' 'DUAL' ; DI = EXTR K0 'DIAG' ; KX = EXTR KT 'UX' 'FX' ;"
    )
    names = ("M0", "M1", "M2", "M3", "KN", "KM", "C1", "C2", "DI", "KX", "PB")
    m0, m1, m2, m3, kn, km, c1, c2, di, kx, b = objects(script, *names)
    assert (len(m0.node_ids), len(m1.node_ids), len(m2.node_ids)) == (6, 8, 1)
    assert len(m3.node_ids) == 14
    assert not kn.relations
    assert kn.blocks
    assert not km.blocks
    assert len(km.relations) == 3
    assert [str(w) for w in c1.values] == ["UX", "UY", "LX"]
    assert [str(w) for w in c2.values] == ["FX", "FY", "FLX"]
    assert at(di, "UX", b) == pytest.approx(200.0 * 0.5 / 2.0)
    assert {u for block in kx.blocks for u in block.unknowns} == {"UX"}


def test_restricted_matrix_is_that_of_the_part():
    script = BAR + (
        "L2 = ELEM L1 (LECT 1 2) ; K2 = REDU K0 L2 ; U = RESO K1 F1 ;"
        "MO2 = MODE L2 'MECANIQUE' 'ELASTIQUE' 'BARR' ;"
        "MA2 = MATE MO2 'YOUN' 200. 'NU' 0. 'SECT' 0.5 ; K3 = RIGI MO2 MA2 ;"
        "W2 = XTMX U K2 ; W3 = XTMX U K3 ;"
    )
    w2, w3 = objects(script, "W2", "W3")
    assert w2 == pytest.approx(w3)
    assert w2 == pytest.approx(1.6 * 2 / 5)


def test_static_links_give_unit_shapes():
    script = BAR + (
        "TL = TABL 'LIAISONS_STATIQUES' ; TL . 1 = TABL ; TL . 1 . 'POINT_LIAISON' = PB ;"
        "TL . 1 . 'DDL_LIAISON' = 'UX' ; B2 = BLOQ TL ; DEPI TL ; RESO K1 TL ;"
        "S1 = TL . 1 . 'DEFORMEE' ; REAC B2 TL ; R1 = TL . 1 . 'REACTION' ;"
    )
    s, r, b = objects(script, "S1", "R1", "PB")
    assert at(s, "UX", b) == pytest.approx(1.0)
    assert at(r, "FX", b) == pytest.approx(10.0)


def test_a_spring_named_twice_is_one_spring():
    script = BAR + "R = APPU 'DEPL' 'UX' 4. PB ; U = MANU 'CHPO' PB 2 'UX' 1. 'UY' 1. ; F = R * U ;"
    f, b = objects(script, "F", "PB")
    assert at(f, "FX", b) == pytest.approx(4.0)
    assert at(f, "FY", b) == pytest.approx(4.0)
