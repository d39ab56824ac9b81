"""MULTIDEC MULTIREC: known wavelets give a signal back; @SEISME: figures of accelerograms."""

import numpy as np
import pytest
from script_runs import found, prog, ran
from together import together

from ssilang.cli.run import run_text

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


G = 9.81


def figures(times, values, more=""):
    listed = [" ".join(f"{x:.17e}" for x in v) for v in (times, values)]
    result = ran(f"T = @SEISME (EVOL 'MANU' (PROG {listed[0]}) (PROG {listed[1]})) {more};")
    return result.session.root.find("T"), [w.code for w in result.session.warnings]


def test_a_constant_acceleration_and_its_opposite():
    # +a for 1 s, -a for 1 s: back to rest at a displacement of a
    a, h = 2.0, 1e-3
    t = np.array([0.0, 1.0, 2.0])
    fine = np.arange(2001) * h
    table, warnings = figures(fine, np.where(fine < 1.0 - h / 2, a, -a))
    assert table.get("PGA") == a
    assert table.get("PGV") == pytest.approx(a * t[1], abs=a * h)
    assert table.get("PGD") == pytest.approx(a, abs=2 * a * h)
    # one step goes from a to -a: its squares count a third, its sizes a half
    assert table.get("ARIAS") == pytest.approx(np.pi / (2 * G) * a**2 * (2 - h * 2 / 3), rel=1e-12)
    assert table.get("CAV") == pytest.approx(a * (2 - h / 2), rel=1e-12)
    assert table.get("D5_95") == pytest.approx(0.9 * 2, abs=h)
    assert table.get("T5") == pytest.approx(0.1, abs=h)
    assert warnings == []


def test_a_random_record_against_a_fine_quadrature():
    random = np.random.default_rng(3)
    t = 0.02 * np.arange(120)
    a = random.normal(size=120) * np.sin(np.pi * t / t[-1])
    a -= a.mean()
    table, _ = figures(t, a, "9.80665")
    fine = np.linspace(0.0, t[-1], 119 * 400 + 1)
    x = np.interp(fine, t, a)
    h = fine[1]
    squares = h * np.concatenate([[0.0], np.cumsum((x[1:] ** 2 + x[:-1] ** 2) / 2)])
    assert table.get("ARIAS") == pytest.approx(np.pi / (2 * 9.80665) * squares[-1], rel=1e-5)
    assert table.get("CAV") == pytest.approx(np.trapezoid(np.abs(x), fine), rel=1e-5)
    share = squares / squares[-1]
    for name, part in (("T5", 0.05), ("T75", 0.75), ("T95", 0.95)):
        assert table.get(name) == pytest.approx(np.interp(part, share, fine), abs=0.02)
    for name, ends in (("D5_75", (0.05, 0.75)), ("D5_95", (0.05, 0.95))):
        assert table.get(name) == pytest.approx(np.diff(np.interp(ends, share, fine))[0], abs=0.02)
    v = h * np.concatenate([[0.0], np.cumsum((x[1:] + x[:-1]) / 2)])
    d = h * np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2)])
    for name, curve in (("PGA", x), ("PGV", v), ("PGD", d)):
        assert table.get("TEMPS").get(name) == t[np.abs(curve[::400]).argmax()]
    assert table.get("PGV") == pytest.approx(np.abs(v[::400]).max(), rel=1e-6)
    assert table.get("HUSID").parts[0].ordinates[-1] == 1.0


def test_drift_and_units_are_told_and_nothing_is_refused():
    t = 0.01 * np.arange(100)
    assert figures(t, np.ones(100))[1] == ["stdlib.seisme-drifts"]
    assert figures(t, 0.3 + np.sin(2 * np.pi * t / t[-1] * 12))[1] == ["stdlib.seisme-drifts"]
    swing = 300.0 * np.cos(2 * np.pi * t)
    assert figures(t, swing)[1] == ["stdlib.seisme-large"]
    result = run_text("T = @SEISME (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 0.)) ;")
    assert result.errors[0].code == "stdlib.seisme-zero"
