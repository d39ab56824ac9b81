"""What RESO refuses or leaves out; parts of a matrix."""

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


def test_free_body_is_named_or_its_load_left_out_when_told():
    free = BAR + "K2 = K0 ET BY ;"
    result = failed(free + "U = RESO K2 F1 ;")
    assert "translation along X" in result.message
    assert "UX at node" in result.message
    told = ran(free + "U = RESO K2 F1 'NOID' ; W X = RESO K2 F1 ((-3.) * F1) 'SOUC' ;").session
    assert len(told.warnings) == 1
    u, w, x = (at(told.root.find(name), "UX", told.root.find("PB")) for name in "UWX")
    assert (w, x) == pytest.approx((u, -3.0 * u), rel=1e-12)


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
