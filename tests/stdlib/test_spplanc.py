"""SPPLANC: floor spectra of a random earthquake, against integrals, PRNS and simulation."""

import numpy as np
import pytest
from scipy.linalg import expm
from script_runs import ran

from ssilang.kernel.records.floors import Storey, floor_spectrum
from ssilang.kernel.records.modulated import (
    ModulatedSignal,
    Resolution,
    modulated_response_spectrum,
)

POWER = (np.array([0.2, 1.0, 5.0, 25.0]), np.array([0.1, 1.0, 0.8, 0.05]))
ENVELOPE = (np.array([0.0, 2.0, 8.0, 10.0]), np.array([0.0, 1.0, 1.0, 0.0]))
TWO = Storey(np.array([2.0, 7.0]), np.array([0.05, 0.05]), np.array([1.3, -0.4]))


def test_a_stiff_building_moves_with_its_ground():
    stiff = Storey(np.array([400.0]), np.array([0.3]), np.array([1.3]))
    f = np.array([0.5, 2.0, 10.0])
    deviations, factors = floor_spectrum(stiff, POWER, ENVELOPE, f, 0.05)
    ground = ModulatedSignal(*POWER, np.array([0.2, 25.0]), (ENVELOPE[0],), (ENVELOPE[1],))
    expected = modulated_response_spectrum(ground, 1.0 / f, 0.05, "DEPL", Resolution(50, 10, 5.0))
    np.testing.assert_allclose(deviations * factors, expected, rtol=3e-3)


def test_deviation_under_a_long_plateau_is_the_integral_of_the_stationary_answer():
    f0, xi = 3.0, 0.04
    steady = (np.array([0.0, 60.0]), np.array([1.0, 1.0]))
    deviation = floor_spectrum(TWO, POWER, steady, np.array([f0]), xi)[0][0]
    f = np.linspace(0.2, 25.0, 400_001)
    w, w0 = 2.0 * np.pi * f, 2.0 * np.pi * f0
    floor = np.ones(len(f), complex)
    for fn, x, c in zip(TWO.frequencies, TWO.dampings, TWO.participations, strict=True):
        wn = 2.0 * np.pi * fn
        floor += c * w**2 / (wn**2 - w**2 + 2j * x * wn * w)
    gain = np.abs(floor / (w0**2 - w**2 + 2j * xi * w0 * w)) ** 2
    variance = np.trapezoid(gain * np.interp(f, *POWER), f)
    assert deviation == pytest.approx(np.sqrt(variance), rel=5e-3)


@pytest.mark.parametrize("natural", [1.0, 2.0, 5.0])
def test_mean_of_the_largest_values_of_simulated_floors(natural):
    random = np.random.default_rng(5)
    step, n, count, xi = 0.005, 2200, 250, 0.02
    f = np.fft.rfftfreq(4096, step)
    density = np.where((f >= 0.2) & (f <= 25.0), np.interp(f, *POWER), 0.0)
    noise = random.normal(size=(count, len(f))) + 1j * random.normal(size=(count, len(f)))
    ground = np.fft.irfft(noise * np.sqrt(density * f[1]) / 2.0 * 4096, 4096)[:, :n]
    ground = ground * np.interp(step * np.arange(n), *ENVELOPE, right=0.0)
    w = 2.0 * np.pi * np.append(TWO.frequencies, natural)
    damping = np.append(TWO.dampings, xi)
    K, C = np.diag(w**2), np.diag(2.0 * damping * w)
    # the oscillator moves with its floor: M holds the accelerations of the modes
    M = np.eye(3)
    M[2, :2] = TWO.participations
    A = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    b = np.concatenate([np.zeros(3), -np.linalg.solve(M, np.ones(3))])
    E = expm(A * step)
    push = np.linalg.solve(A, (E - np.eye(6)) @ b)
    state, largest = np.zeros((count, 6)), np.zeros(count)
    for i in range(n):
        state = state @ E.T + ground[:, i, None] * push
        largest = np.maximum(largest, np.abs(state[:, 2]))
    deviation, factor = floor_spectrum(TWO, POWER, ENVELOPE, np.array([natural]), xi)
    # an oscillator in tune with a mode (2 Hz) has one long wave train: crossings are no law for it
    assert deviation[0] * factor[0] == pytest.approx(largest.mean(), rel=0.13)


SCRIPT = """
T1 = TABL ; TS = TABL ; T1 . 'STRUC' = TS ; TS . 'NMODE' = 2 ;
TS . 'FREQU' = TABL ; TS . 'FREQU' . 1 = 2. ; TS . 'FREQU' . 2 = 7 ;
TS . 'AMORT' = TABL ; TS . 'AMORT' . 1 = 0.05 ; TS . 'AMORT' . 2 = 0.05 ;
TP = TABL ; T1 . 'PLANCH' = TP ; TP . 'COEFFPL' = TABL ;
TP . 'COEFFPL' . 1 = 1.3 ; TP . 'COEFFPL' . 2 = -0.4 ; TP . 'AMORTPL' = 0.02 ;
TP . 'TYPSPPL' = MOT '{kind}' ; TP . 'LISFREQ' = PROG 1. 4. ;
TE = TABL ; T1 . 'EXCIT' = TE ; TE . 'ENVE' = '{envelope}' ; TE . 'DUREE' = 10. ;
TE . 'TDEB' = {start} ; TE . 'TFIN' = 8. ;
TE . 'DSP' = EVOL 'MANU' 'FREQ' (PROG 0.2 1. 5. 25.) 'DSP' (PROG 0.1 1. 0.8 0.05) ;
T2 = SPPLANC T1 ; A = T2 . 'SIGM' ; B = T2 . 'FPIC' ; C = T2 . 'SPPL' ;
"""


@pytest.mark.parametrize(("kind", "power"), [("DEPL", 0), ("VITE", 1), ("ACCE", 2)])
def test_the_table_gives_the_spectrum(kind, power):
    result = ran(SCRIPT.format(kind=kind, envelope="PLATLIN", start=2.0))
    f = np.array([1.0, 4.0])
    deviations, factors = floor_spectrum(TWO, POWER, ENVELOPE, f, 0.02)
    scale = (2.0 * np.pi * f) ** power
    a, b, c = (result.session.root.find(n).parts[0] for n in "ABC")
    np.testing.assert_allclose(a.ordinates, deviations * scale, rtol=1e-12)
    np.testing.assert_allclose(b.ordinates, factors, rtol=1e-12)
    np.testing.assert_allclose(c.ordinates, deviations * factors * scale, rtol=1e-12)
    np.testing.assert_array_equal(c.abscissas, f)
