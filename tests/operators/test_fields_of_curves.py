"""Fields in cells whose values are curves, with numbers; springs on a point."""

import numpy as np
import pytest
from script_runs import finder, ran
from together import together

FIELD = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = (DROI 2 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ;
M = MODE S 'MECANIQUE' 'ELASTIQUE' ;
E1 = EVOL 'MANU' 'T' (PROG 0. 1. 3.) 'YOUN' (PROG 2. 4. 5.) ; A = MATE M 'YOUN' E1 'NU' 0.3 ;
"""


@together(
    "said, run, plain",
    [
        ("A * 2.", lambda y: 2 * y, 0.6),
        ("3 - A", lambda y: 3 - y, 2.7),
        ("A / 4", lambda y: y / 4, 0.075),
        ("1. / A", lambda y: 1 / y, 1 / 0.3),
        ("A ** 2", lambda y: y**2, 0.09),
        ("A + 1.", lambda y: y + 1, 1.3),
        ("ASIH A", np.arcsinh, np.arcsinh(0.3)),
        ("ABS (-1. * A)", np.abs, 0.3),
    ],
)
def test_curves_in_cells_go_with_numbers(said, run, plain, tmp_path):
    script = FIELD + f"B = {said} ; C = EXTR B 'YOUN' 1 2 1 ; X = EXTR B 'NU' 1 1 1 ; "
    find = finder(script + "Y = EXTR C 'ORDO' ; Z = EXTR C 'ABSC' ;", tmp_path)
    np.testing.assert_allclose(find("Y").values, run(np.array([2.0, 4.0, 5.0])))
    np.testing.assert_allclose(find("Z").values, [0.0, 1.0, 3.0])
    assert find("X") == pytest.approx(plain)


@together("mode", ["PLAN DEFO", "PLAN GENE"])
def test_a_spring_stands_on_a_point_as_on_its_cell(mode, tmp_path):
    result = ran(
        f"OPTI DIME 2 MODE {mode} ; P = 0. 0. ; K = 0. ; "
        "M1 = MODE P 'MECANIQUE' 'ELASTIQUE' 'IMPEDANCE' (MOTS 'UX') ; "
        "M2 = MODE (MANU 'POI1' P) 'MECANIQUE' 'ELASTIQUE' 'IMPEDANCE' (MOTS 'UX') ; "
        "R = (RIGI M1 (MATE M1 'RAID' 4.)) - (RIGI M2 (MATE M2 'RAID' 3.)) ; "
        "X = EXTR (R * (MANU 'CHPO' P 'UX' 1.)) P 'FX' ;",
        output_directory=tmp_path,
    )
    assert result.session.root.find("X") == pytest.approx(1.0)


@together("cells, element", [("TRI3", "DKT"), ("TRI3", "COQ3"), ("QUA4", "COQ4")])
def test_least_squares_on_shells_keep_means_and_what_is_linear(cells, element, tmp_path):
    find = finder(
        f"""
        OPTI DIME 3 MODE TRID ELEM {cells} ; U = (2. 0. 1.) ; V = (0. 3. 0.) ; O = (0. 0. 0.) ;
        S = (DROI 6 O U) TRAN 6 V ; M = MODE S 'MECANIQUE' 'ELASTIQUE' '{element}' ;
        T = (DROI 2 O U) TRAN 3 V ; N = MODE T 'MECANIQUE' 'ELASTIQUE' '{element}' ;
        X Y Z = COOR S ; L = (2. * X) - (3. * Y) + (4. * Z) + 1. ;
        A = PROI 'MINI' N (CHAN 'CHAM' L M) ;
        XT YT ZT = COOR T ; LT = (2. * XT) - (3. * YT) + (4. * ZT) + 1. ;
        D = MAXI (A - (CHAN 'CHAM' LT N)) 'ABS' ;
        C = CHAN 'CHAM' (X * X) M ; B = PROI 'MINI' N C 4 ;
        I1 = INTG N B ; I2 = INTG M C ;
        """,
        tmp_path,
    )
    assert find("D") < 1e-9
    assert find("I1") == pytest.approx(find("I2"), rel=2e-2)
