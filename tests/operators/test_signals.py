"""TFR, TFRI, FILT, HANN, COMT, TOTE against closed forms."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.signals import (
    constant_step,
    fourier,
    inverse_fourier,
    shocks,
    time_above,
)


def test_transform_of_a_gaussian_is_a_gaussian():
    t = np.arange(1024) * 0.01
    f, values = fourier(np.exp(-np.pi * (t - 5) ** 2), 0.01, 1024)
    # the continuous transform: exp(-pi f^2), delayed by 5
    np.testing.assert_allclose(values, np.exp(-np.pi * f**2 - 10j * np.pi * f), atol=1e-12)


def test_inverse_transform_gives_the_signal_back(found):
    back, original = found(
        "S = EVOL 'MANU' 'T' (PROG 0. PAS 0.02 NPAS 63) 'A' (BRUI 'BLAN' 'GAUS' 0. 1. 64) ; "
        "R1 = EXTR (TFRI (TFR 6 S 'REIM')) 'ORDO' ; R2 = EXTR (TFRI (TFR 6 S 'MOPH')) 'ORDO' ; "
        "B = MAXI ((R1 - R2) ET (R1 - (EXTR S 'ORDO'))) 'ABS' ; "
        "X = EXTR (TFRI (TFR 6 S 'REIM')) 'ABSC' ;",
        "B", "X",
    )  # fmt: skip
    assert back < 1e-12
    np.testing.assert_allclose(original.values, 0.02 * np.arange(64), atol=1e-12)


def test_frequencies_are_limited_on_demand(found):
    f = found(
        "S = EVOL 'MANU' (PROG 0. PAS 0.1 NPAS 15) (PROG 16 * 1.) ; "
        "F = EXTR (TFR 4 S 'MOPH' 'FMIN' 1. 'FMAX' 3.) 'ABSC' ;",
        "F",
    )
    np.testing.assert_allclose(f.values, [1.25, 1.875, 2.5])


def test_transform_of_a_list_of_fields_is_that_of_its_values(found):
    script = (
        "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'UX' 1. ; LT = PROG 0. PAS 0.1 NPAS 7 ; "
        "LC = VIDE 'LISTCHPO' ; REPE B 8 ; LC = LC ET (C * (SIN (40. * &B))) ; FIN B ; "
        "RE IM LF = TFR 3 LC LT 'REIM' ; A = EXTR RE 'VALE' 'UX' P ; B = EXTR IM 'VALE' 'UX' P ; "
    )
    re, im, f = found(script, "A", "B", "LF")
    expected = np.fft.rfft(np.sin(np.radians(40.0 * np.arange(1, 9)))) * 0.1
    np.testing.assert_allclose(re.values + 1j * im.values, expected, atol=1e-14)
    np.testing.assert_allclose(f.values, np.arange(5) / 0.8)


def test_uneven_times_are_refused(refused):
    with pytest.raises(FieldError, match="regularly"):
        constant_step(np.array([0.0, 1.0, 3.0]))
    assert "regularly" in refused(
        "F = «TFR» 2 (EVOL 'MANU' (PROG 0. 1. 3.) (PROG 1. 2. 3.)) 'REIM' ;"
    )


def test_low_pass_halves_the_power_at_its_cut_off(found):
    module, phase = found(
        "E = FILT 4 'TYPE' 'PBAS' 2. 'DFRQ' 0.5 ; M = EXTR (EXTR E 'ORDO' 1) 5 ; "
        "P = EXTR (EXTR E 'ORDO' 2) 5 ;",
        "M", "P",
    )  # fmt: skip
    assert module == pytest.approx(2**-0.5)
    assert phase == pytest.approx(-45)


def test_power_of_the_circular_frequency_differentiates(found):
    """Transform times i omega, back: the derivative of a periodic signal."""
    error = found(
        "N = 64 ; T = PROG 0. PAS 0.1 NPAS 63 ; "
        "S = EVOL 'MANU' 'T' T 'A' (SIN (T * (360. / 6.4 * 3.))) ; "
        "D = TFRI ((TFR 6 S 'REIM') * (FILT 6 'TYPE' 'OMEG' 1 'SORT' 'REIM' 'DFRQ' (1. / 6.4))) ; "
        "W = 2. * PI * 3. / 6.4 ; "
        "X = MAXI ((EXTR D 'ORDO') - (W * (COS (T * (360. / 6.4 * 3.))))) 'ABS' ;",
        "X",
    )
    assert error < 1e-12


def test_hanning_keeps_a_straight_line_inside(found):
    y = found(
        "Y = EXTR (HANN (EVOL 'MANU' (PROG 1. PAS 1. 6.) (PROG 2. PAS 2. 12.)) 1) 'ORDO' ;", "Y"
    )
    np.testing.assert_allclose(y.values[1:-1], [4, 6, 8, 10])


def test_shocks_are_counted_with_their_peaks_and_places():
    peaks, begins, ends = shocks(np.array([0, 0, 3, 5, 0, -2, 0, 0, 1.0]), 10)
    assert peaks.tolist() == [5, -2, 1]
    assert begins.tolist() == [2, 5, 8]
    assert ends.tolist() == [4, 6]


def test_time_above_a_level_counts_both_sides():
    shocks_up_and_down = np.array([0.0, 2, 0, -2, 0]), 0.5
    assert time_above(np.arange(5.0), *shocks_up_and_down) == pytest.approx(3.0)
    assert time_above(np.array([0.0, 1, 2]), np.array([0.0, -2, 0]), 0.5) == pytest.approx(1.5)


def test_time_above_a_level_of_a_triangle():
    assert time_above(np.array([0.0, 1, 2]), np.array([0.0, 2, 0]), 0.5) == pytest.approx(1.5)


def test_inverse_needs_two_frequencies():
    code = "kernel.records.signal-needs-two-points"
    with pytest.raises(FieldError, check=lambda e: e.code == code):
        inverse_fourier(np.array([0.0]), np.array([1.0 + 0j]))


def test_signal_of_times_in_every_way(found):
    curves = found(
        "A = FDT 'ACCE' 'NOCO' 'COUP' (PROG 0. 1. 0.5 2.) ; B = FDT (PROG 0. 0.5 1. 2.) 'NOCO' "
        "'ACCE' ; C = FDT 'ACCE' (PROG 0.5) (PROG 1. 2.) ; D = FDT 'ACCE' (PROG 0.) "
        "(PROG 0. 1. 0.5 2.) ; E = FDT 'CONS' 0.5 'ACCE' (PROG 1. 2.) ;",
        "A", "B", "C", "D", "E",
    )  # fmt: skip
    for curve in curves:
        assert curve.parts[0].abscissas.tolist() == [0.0, 0.5]
        assert curve.parts[0].ordinates.tolist() == [1.0, 2.0]


def test_filters_of_first_order_and_powers_of_the_frequency(found):
    high, power = found(
        "A = FILT 2 'TYPE' 'PHAU' 2. 'DFRQ' 2. ; B = FILT 'DFRQ' 1. 2 'TYPE' 'OMEG' 2 'REIM' ;",
        "A", "B",
    )  # fmt: skip
    # i r / (1 + i r) with r = f / cut-off: half the power and 45 degrees at the cut-off
    np.testing.assert_allclose(high.parts[0].ordinates, [0, 0.5**0.5, 2 / 5**0.5])
    np.testing.assert_allclose(high.parts[1].ordinates[1:], [45, np.degrees(np.arctan(0.5))])
    np.testing.assert_allclose(power.parts[0].ordinates, [0, -4 * np.pi**2, -16 * np.pi**2])
    np.testing.assert_allclose(power.parts[1].ordinates, 0)


def test_transform_of_constant_fields_is_their_value_times_the_length(found):
    real, imaginary, frequencies = found(
        "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'UX' 3. ; "
        "R I F = TFR 'REIM' 2 (SUIT C C C C) (PROG 0. 'PAS' 0.5 1.5) ; "
        "A = EXTR R 'VALE' 'UX' P ; B = EXTR I 'VALE' 'UX' P ;",
        "A", "B", "F",
    )  # fmt: skip
    assert frequencies.values.tolist() == [0.0, 0.5, 1.0]
    np.testing.assert_allclose(real.values, [6.0, 0, 0], atol=1e-12)  # 3 over 2 s
    np.testing.assert_allclose(imaginary.values, 0, atol=1e-12)
