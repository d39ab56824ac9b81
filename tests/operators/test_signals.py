"""TFR, TFRI, FILT, HANN, COMT, TOTE against closed forms."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.signals import (
    fourier,
    inverse_fourier,
)


def test_transform_of_a_gaussian_is_a_gaussian():
    t = np.arange(1024) * 0.01
    f, values = fourier(np.exp(-np.pi * (t - 5) ** 2), 0.01, 1024)
    # the continuous transform: exp(-pi f^2), delayed by 5
    np.testing.assert_allclose(values, np.exp(-np.pi * f**2 - 10j * np.pi * f), atol=1e-12)


def test_inverse_needs_two_frequencies():
    code = "kernel.records.signal-needs-two-points"
    with pytest.raises(FieldError, check=lambda e: e.code == code):
        inverse_fourier(np.array([0.0]), np.array([1.0 + 0j]))
