"""@FRENET @LISSE @POMI ZIGZAG @DEDUIRE @SYSLIN against closed forms."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from script_runs import found
from together import together


def listed(values):
    return "PROG " + " ".join(repr(float(v)) for v in values)


@together(
    "left, right, ends",
    [
        (50.0, 50.0, "natural"),
        (30.0, 50.0, ((1, math.tan(math.pi / 6)), (2, 0.0))),
        (0.0, -45.0, ((1, 0.0), (1, -1.0))),
    ],
)
def test_smoothed_curve_is_the_cubic_spline(left, right, ends):
    x, y = [0.0, 0.7, 1.0, 2.5], [1.0, -1.0, 0.5, 0.2]
    curve = found(
        f"E = EVOL 'MANU' ({listed(x)}) ({listed(y)}) ; F = @LISSE E {left} {right} 41 1 ; "
        "LX = EXTR F 'ABSC' ; LY = EXTR F 'ORDO' ;",
        "LX", "LY",
    )  # fmt: skip
    at, value = (np.asarray(c.values) for c in curve)
    assert at == pytest.approx(np.linspace(0.0, 2.5, 41))
    assert value == pytest.approx(CubicSpline(x, y, bc_type=ends)(at), abs=1e-10)


def test_smoothing_along_the_ordinates_swaps_the_axes():
    x, y = [0.04, 0.4, 0.53, 0.67, 0.77, 0.75], [-0.2, -0.13, -0.08, 0.0, 0.23, 0.41]
    lx, ly = found(
        f"E = EVOL 'MANU' ({listed(x)}) ({listed(y)}) ; F = @LISSE E 50. 0. 40 2 ; "
        "LX = EXTR F 'ABSC' ; LY = EXTR F 'ORDO' ;",
        "LX", "LY",
    )  # fmt: skip
    spline = CubicSpline(y, x, bc_type=((2, 0.0), (1, 0.0)))
    assert np.asarray(lx.values) == pytest.approx(spline(np.asarray(ly.values)), abs=1e-10)


def test_nearest_polynomial_of_a_broken_line():
    """Against least squares by dense Gauss quadrature of the same broken line."""
    rng = np.random.default_rng(3)
    x, y = np.sort(rng.uniform(-2.0, 5.0, 9)), rng.normal(size=9)
    table, curve = found(
        f"E = EVOL 'MANU' ({listed(x)}) ({listed(y)}) ; T F = @POMI E 4 'IDEM' ; "
        "L = PROG (T . 0) (T . 1) (T . 2) (T . 3) (T . 4) ; V = EXTR F 'ORDO' ;",
        "L", "V",
    )  # fmt: skip
    gauss, weight = np.polynomial.legendre.leggauss(6)
    half = np.diff(x) / 2
    at = (x[:-1] + half)[:, None] + half[:, None] * gauss
    w = np.sqrt(half[:, None] * weight).ravel()
    powers = at.ravel()[:, None] ** np.arange(5)
    want = np.linalg.lstsq(w[:, None] * powers, w * np.interp(at.ravel(), x, y), rcond=None)[0]
    assert np.asarray(table.values) == pytest.approx(want, rel=1e-8, abs=1e-9)
    assert np.asarray(curve.values) == pytest.approx(x[:, None] ** np.arange(5) @ want, abs=1e-8)


def test_small_system_needs_no_order_of_rows():
    rng = np.random.default_rng(1)
    matrix, side = rng.normal(size=(5, 5)), rng.normal(size=5)
    matrix[0, 0] = 0.0
    script = "M = TABL ; X = TABL ; "
    for i in range(5):
        script += f"M . {i + 1} = TABL ; X . {i + 1} = {float(side[i])!r} ; "
        script += "".join(f"M . {i + 1} . {j + 1} = {float(matrix[i, j])!r} ; " for j in range(5))
    script += "U = @SYSLIN M X ; L = PROG (U . 1) (U . 2) (U . 3) (U . 4) (U . 5) ;"
    assert np.asarray(found(script, "L").values) == pytest.approx(np.linalg.solve(matrix, side))
