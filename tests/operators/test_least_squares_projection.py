"""PROI 'MINI': fields moved between meshes by least squares in each cell."""

import numpy as np
from script_runs import ran
from together import together

PLANE = (
    "OPTI DIME 2 MODE {mode} ELEM {kind} ; L = DROI {n} (0. 0.) (2. 0.) ; S = L TRAN {m} (0. 1.) ; "
    "OPTI ELEM QUA4 ; R = (DROI 1 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
    "M1 = MODE S 'MECANIQUE' 'ELASTIQUE' ; M2 = MODE R 'MECANIQUE' 'ELASTIQUE' ; "
    "X Y = COOR S ; "
)


def projected(text, kind="QUA4", mode="PLAN DEFO", n=8, m=4):
    result = ran(PLANE.format(kind=kind, mode=mode, n=n, m=m) + text)
    (block,) = result.session.root.find("P").blocks
    return block.cells.coordinates[0], block.components["SCAL"][0]


@together("kind", ["QUA4", "TRI3", "QUA8"])
@together("mode", ["PLAN DEFO", "AXIS"])
def test_what_the_coarse_cell_can_hold_is_found_again(kind, mode):
    x, values = projected(
        "C = CHAN 'CHAM' (NOMC 'SCAL' (1. + (2. * X) - Y)) M1 ; P = PROI M2 C 'MINI' ;", kind, mode
    )
    np.testing.assert_allclose(values, 1 + 2 * x[:, 0] - x[:, 1], atol=1e-10)


@together("points, n", [("", 16), (" 8", 64)])
def test_a_parabola_becomes_its_best_line(points, n):
    """Least squares of x^2 on [0, 2]: 2 x - 2/3; in axisymmetry the weight x makes 2.4 x - 1.2."""
    text = f"C = CHAN 'CHAM' (NOMC 'SCAL' (X * X)) M1 ; P = PROI M2 C 'MINI'{points} ;"
    x, values = projected(text, "QUA8", n=n)
    np.testing.assert_allclose(values, 2 * x[:, 0] - 2 / 3, atol=1e-9)
    x, values = projected(text, "QUA8", "AXIS", n=n)
    np.testing.assert_allclose(values, 2.4 * x[:, 0] - 1.2, atol=1e-9)


def test_the_integral_of_a_rough_field_is_kept_as_points_grow():
    """A step at x = 1: its mean 0.5 and its first moment are those of the projection."""
    text = (
        "OPTI ELEM QUA4 ; A = (DROI 1 (1. 0.) (2. 0.)) TRAN 1 (0. 1.) ; MA = MODE A 'MECANIQUE' "
        "'ELASTIQUE' ; C = MANU 'CHML' MA 'SCAL' 1. 'NOEUD' ; P = PROI M2 C 'MINI' 60 ;"
    )
    x, values = projected(text)
    # best line of the step on [0, 2]: 0.5 + 0.75 (x - 1)
    np.testing.assert_allclose(values, 0.5 + 0.75 * (x[:, 0] - 1), atol=2e-3)


@together("place, count, code", [
        ("(MANU 'POI1' (0.5 0.5)) ET (MANU 'POI1' (2.5 0.5)) ET (MANU 'POI1' (3. 0.))", 2,
         "projected-nowhere-outside"),
        ("M2", 2, "projected-zero-outside"),
        ("M2 'MINI'", 3, "projected-zero-outside"),
    ])  # fmt: skip
@together("tolerance, told", [("1.E-5", True), ("9.", False)])
def test_points_outside_are_told_and_raise_the_flag(place, count, code, tolerance, told):
    """M2 is twice as long as the field's mesh."""
    text = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; S = (DROI 4 (0. 0.) (2. 0.)) TRAN 2 (0. 1.) ; "
        "R = (DROI 1 (0. 0.) (4. 0.)) TRAN 1 (0. 1.) ; M2 = MODE R 'MECANIQUE' 'ELASTIQUE' ; "
        "C = CHAN 'CHAM' (NOMC 'SCAL' (1. + (0. * (COOR 1 S)))) S ; "
    )
    words = place.replace("M2 'MINI'", "M2 C 'MINI'")
    call = f"PROI {words} {tolerance}" if "MINI" in words else f"PROI ({words}) C {tolerance}"
    result = ran(text + f"P = {call} ; Z = SOUC ;")
    assert result.session.root.find("Z") is told
    found = [(w.code.rpartition(".")[2], w.data["count"]) for w in result.session.warnings]
    assert found == ([(code, count)] if told else [])
