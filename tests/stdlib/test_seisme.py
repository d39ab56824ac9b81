"""@SEISME: figures of accelerograms against closed forms and quadrature on a fine grid."""

import numpy as np
import pytest
from script_runs import ran

from ssilang.cli.run import run_text

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
