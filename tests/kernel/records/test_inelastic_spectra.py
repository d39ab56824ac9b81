"""Yielding oscillators against energy balances, SciPy's integrator and the linear spectrum."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from script_runs import ran
from together import together

from ssilang.kernel.modal.oscillator import spectrum
from ssilang.kernel.records.inelastic import limits_for_ductility, yielding_peaks

TIMES = np.arange(0.0, 6.0, 0.01)
MOTION = 3.0 * np.sin(9.0 * TIMES) * np.exp(-0.4 * TIMES) + np.sin(31.0 * TIMES + 1.0)
F = np.array([0.7, 1.5, 3.0])


def pulse(dt: float) -> tuple[np.ndarray, np.ndarray]:
    """A unit impulse, far shorter than the periods."""
    times = np.arange(0.0, 1.5, dt)
    signal = np.zeros(len(times))
    signal[1] = 1.0 / dt
    return times, signal


@together("reduction", [1.5, 2.0, 3.0])
def test_an_impulse_on_a_perfectly_plastic_oscillator_spends_equal_energy(reduction: float) -> None:
    times, signal = pulse(1e-4)
    limit = 1.0 / (2 * np.pi) / reduction
    for law in ("CINE", "ISOT", "ELAS"):
        peak = yielding_peaks(times, signal, np.ones(1), 0.0, law, 0.0, np.array([limit]))
        assert peak[0] / limit == pytest.approx((reduction**2 + 1) / 2, rel=2e-3)


def test_strong_oscillators_are_the_linear_ones() -> None:
    fine = np.linspace(0.0, TIMES[-1], 20 * len(TIMES))
    exact = spectrum(fine, np.interp(fine, TIMES, MOTION), F, 0.05, "DEPL")
    for law in ("CINE", "ISOT", "ELAS"):
        found = yielding_peaks(TIMES, MOTION, F, 0.05, law, 0.1, np.full(3, 1e3))
        assert found == pytest.approx(exact, rel=1e-3)


def peer(f: float, law: str, hardening: float, limit: float) -> float:
    """Largest displacement by an adaptive integrator, laws in rates."""
    w = 2 * np.pi * f
    k, y = w * w, w * w * limit

    def slope(t: float, s: np.ndarray) -> list[float]:
        x, v, force, grown = s
        load = float(np.interp(t, TIMES, MOTION, right=0.0))
        if law == "CINE":  # force of the part that yields, beside a spring
            total = force + hardening * k * x
            rate = 0.0 if abs(force) >= (1 - hardening) * y and force * v > 0 else (1 - hardening)
            growth = 0.0
        else:
            total = force
            flows = abs(force) >= y + grown and force * v > 0
            rate = hardening if flows else 1.0
            growth = hardening * k * abs(v) if flows else 0.0
        return [v, load - 2 * 0.05 * w * v - total, k * rate * v, growth]

    run = solve_ivp(slope, (0.0, TIMES[-1] + 1 / f), [0.0] * 4, max_step=2e-3, rtol=1e-6)
    return float(np.abs(run.y[0]).max())


@pytest.mark.parametrize("law", ["CINE", "ISOT"])
def test_histories_with_reversals_agree_with_an_adaptive_integrator(law: str) -> None:
    limit = 0.35 * float(spectrum(TIMES, MOTION, F[1:2], 0.05, "DEPL")[0])
    found = yielding_peaks(TIMES, MOTION, F[1:2], 0.05, law, 0.2, np.array([limit]))
    assert found[0] == pytest.approx(peer(1.5, law, 0.2, limit), rel=3e-3)
    other = yielding_peaks(
        TIMES, MOTION, F[1:2], 0.05, "ISOT" if law == "CINE" else "CINE", 0.2, np.array([limit])
    )
    assert found[0] != pytest.approx(other[0], rel=1e-2)


@together("ductility", [1.0, 2.0, 4.0])
def test_the_limit_sought_has_the_ductility_asked_for(ductility: float) -> None:
    first = 5.0 * spectrum(TIMES, MOTION, F, 0.05, "DEPL")  # far too strong
    limits = limits_for_ductility(TIMES, MOTION, F, 0.05, "CINE", 0.05, ductility, first)
    peaks = yielding_peaks(TIMES, MOTION, F, 0.05, "CINE", 0.05, limits)
    assert peaks / limits == pytest.approx(np.full(3, ductility), rel=0.01)


SCRIPT = (
    "T1 = PROG 0. PAS 0.005 5. ; G1 = EVOL 'MANU' 'TEMP' T1 'ACCE' (SIN (720. * T1)) ;"
    "X1 = PROG 0.02 0.05 ; S1 = SPO G1 'AMOR' X1 'FREQ' (PROG 1. 2. 4.) 'ACCE' ;"
)


def curve(tail: str):
    result = ran(SCRIPT + f"R = SPON {tail} ;")
    return result.session.root.find("R"), result.session.root.find("S1")


def test_unit_ductility_gives_the_linear_spectrum_back() -> None:
    tail = "'SIGN' G1 'SPEL' S1 'ACCE' 'AMOR' X1 'CINE' (PROG 1. 0.) "
    for start in ("'DEMA' ", ""):
        found, linear = curve(start + tail + "'ACCE'")
        assert len(found.parts) == 2
        for a, b in zip(found.parts, linear.parts, strict=True):
            assert a.ordinates == pytest.approx(b.ordinates, rel=1e-2)
    length, _ = curve(tail + "'COUL' 'ROUG' 'DEPL'")
    w = 2 * np.pi * np.array([1.0, 2.0, 4.0])
    assert length.parts[0].ordinates * w**2 == pytest.approx(linear.parts[0].ordinates, rel=1e-2)
