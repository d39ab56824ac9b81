"""KP of a pressure with a gradient: springs of a soil, and weights of water, by hand."""

import numpy as np
import pytest

SLOPE = (
    "OPTI DIME 3 MODE TRID ELEM {cell} ; A = 0. 0. 0. ; B = 3. 0. 4. ; "
    "S = (A DROI 2 B) TRAN 3 (0. 2. 0.) ; M = MODE S MECANIQUE {shell} ; "
)
AREA, NORMAL = 10.0, np.array([-0.8, 0.0, 0.6])


def _moved(vector):
    return f"(MANU 'CHPO' S 3 'UX' {vector[0]} 'UY' {vector[1]} 'UZ' {vector[2]})"


@pytest.mark.parametrize(("cell", "shell"), [("TRI3", "DKT"), ("TRI3", "DST"), ("QUA4", "COQ4")])
@pytest.mark.parametrize("vector", [(1.0, 0.0, 0.0), (0.2, -0.5, 0.9), (0.6, 0.0, 0.8)])
def test_without_a_direction_the_sides_stand_on_springs(found, cell, shell, vector):
    work = found(
        SLOPE.format(cell=cell, shell=shell) + f"U = {_moved(vector)} ; X = XTMX U (KP M 7.) ;", "X"
    )
    assert work == pytest.approx(7.0 * AREA * (NORMAL @ vector) ** 2, abs=1e-12)


def test_with_a_direction_forces_point_along_the_normal(found):
    """Forces RG (u . v) A n, of whatever length the direction is; symmetric unless asked."""
    u, v = np.array([0.2, -0.5, 0.9]), np.array([0.0, 0.6, 0.8])
    values = found(
        SLOPE.format(cell="TRI3", shell="DKT")
        + f"U = {_moved(u)} ; F = RESU ((KP M 7. 'ASYM' (0. 3. 4.)) * U) ; P = EXTR F 'MAIL' ; "
        "P = P POIN 1 ; X1 = EXTR F 'FX' P ; X2 = EXTR F 'FY' P ; X3 = EXTR F 'FZ' P ; "
        "G = RESU ((KP (0. 0.6 0.8) M 7.) * U) ; Q = (EXTR G 'MAIL') POIN 1 ; "
        "Y1 = EXTR G 'FX' Q ; Y2 = EXTR G 'FY' Q ; Y3 = EXTR G 'FZ' Q ;",
        "X1", "X2", "X3", "Y1", "Y2", "Y3",
    )  # fmt: skip
    K = 7.0 * AREA * np.outer(NORMAL, v)
    assert values[:3] == pytest.approx(K @ u, abs=1e-12)
    assert values[3:] == pytest.approx((K + K.T) / 2 @ u, abs=1e-12)
