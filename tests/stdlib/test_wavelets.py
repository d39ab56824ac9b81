"""MULTIDEC MULTIREC: known wavelets take a signal apart and give it back exactly.

LeGall's 5/3 filters, and Daubechies' four (low-pass sums to 1, as in Mallat 1989).
"""

import numpy as np
import pytest
from script_runs import found, prog
from together import together

_APART = "(PROG 0.75 0.25 -0.125) -1 (PROG -0.5 1. -0.5) 2"
_TOGETHER = "(PROG 0.5 0.25) -1 (PROG -0.0625 -0.125 0.375 -0.125 -0.0625) 1"


def signal(values):
    return f"E = EVOL 'MANU' (PROG 0. 'PAS' 0.5 'NPAS' {len(values) - 1}) (PROG " + " ".join(
        f"{v:.12f}" for v in values
    ) + ") ; "  # fmt: skip


def pulse():
    values = np.zeros(65)
    values[24:41] = np.random.default_rng(2).normal(size=17)
    return values


@together("levels", [1, 2, 3])
def test_signal_taken_apart_comes_back(levels):
    script = signal(pulse()) + (
        f"N D R = MULTIDEC E {_APART} {levels} 'PADD' ; M F = MULTIREC R D {_TOGETHER} 'PADD' ; "
        "L = EXTR F 'ORDO' ; X = EXTR F 'ABSC' ; C = DIME D ;"
    )
    n, m, back, x, count = found(script, "N", "M", "L", "X", "C")
    assert n == m == count == levels
    assert np.asarray(back.values) == pytest.approx(pulse(), abs=1e-11)
    assert np.asarray(x.values) == pytest.approx(0.5 * np.arange(65))


def test_straight_line_has_no_detail():
    """The detail filter has two vanishing moments; the smoothing filter keeps a line."""
    script = signal(np.arange(33.0)) + (
        f"N D R = MULTIDEC E {_APART} ; L = EXTR R 'ORDO' ; A = EXTR D 'ORDO' 1 ; "
        "X = EXTR R 'ABSC' ; B = EXTR D 'ORDO' N ;"
    )
    n, rest, x, high = found(script, "N", "L", "X", "B")
    assert n == 4  # 33 17 9 5 3 points
    assert len(rest.values) == 3
    assert list(x.values) == [0.0, 8.0, 16.0]
    assert np.asarray(high.values)[:-1] == pytest.approx(np.zeros(16), abs=1e-12)


def test_details_go_from_low_to_high_frequencies():
    """An alternating signal is all in the finest level, the last curve."""
    script = signal((-1.0) ** np.arange(33)) + (
        f"N D R = MULTIDEC E {_APART} 2 ; A = MAXI (ABS (EXTR D 'ORDO' 1)) ; "
        "B = MAXI (ABS (EXTR D 'ORDO' 2)) ; C = MAXI (ABS (EXTR R 'ORDO')) ;"
    )
    low, high, rest = found(script, "A", "B", "C")
    assert high == pytest.approx(2.0)
    assert low == pytest.approx(0.0, abs=1e-12)
    assert rest == pytest.approx(0.0, abs=1e-12)


def daubechies():
    """Filters h(0..3) and g(-2..1) = (-1)^(1-n) h(1-n), the sum of h being 1."""
    root = np.sqrt(3.0)
    h = np.array([1 + root, 3 + root, 3 - root, 1 - root]) / 8
    g = np.array([(-1.0) ** (1 - n) * h[1 - n] for n in range(-2, 2)])
    return h, g


@together("levels", [1, 2])
def test_daubechies_wavelet_keeps_the_energy_and_comes_back(levels):
    """Taken apart with the mirrored filters h(-n) g(-n), put together with h and g."""
    h, g = daubechies()
    values = np.zeros(129)
    values[48:80] = np.random.default_rng(5).normal(size=32)
    script = signal(values) + (
        f"N D R = MULTIDEC E {prog(h[::-1])} 3 {prog(g[::-1])} 1 {levels} 'PADD' ; "
        f"M F = MULTIREC R D {prog(h)} 0 {prog(g)} 2 'PADD' ; L = EXTR F 'ORDO' ; "
        "RY = EXTR R 'ORDO' ; D1 = EXTR D 'ORDO' 1 ; DN = EXTR D 'ORDO' N ;"
    )
    back, rest, low, high = found(script, "L", "RY", "D1", "DN")
    assert np.asarray(back.values) == pytest.approx(values, abs=1e-10)
    # by hand: the finest detail is the scalar product with g shifted by two
    by_hand = [2 * k - 2 + np.arange(4) for k in range(24, 40)]
    expected = [float(g @ values[i]) for i in by_hand]
    assert np.asarray(high.values)[24:40] == pytest.approx(expected, abs=1e-10)
    energy = 2.0**levels * (np.sum(rest.values**2) + np.sum(low.values**2))
    if levels == 2:
        energy += 2.0 * np.sum(high.values**2)
    assert energy == pytest.approx(np.sum(values**2))
