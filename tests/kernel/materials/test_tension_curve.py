"""Hardening from a tension test: plastic strain is what the elastic one leaves; refused curves."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.materials.plastic.backbone import hardening_of


def tension(strain, stress):
    return Curve((CurvePart(np.array(strain, float), np.array(stress, float)),))


def test_plastic_strain_is_total_less_elastic():
    """YOUN 200: at the strain 0.05 under 6 the elastic part is 0.03."""
    (found,) = hardening_of(tension([0, 0.02, 0.05, 0.1], [0, 4.0, 6.0, 6.0]), 200.0).parts
    np.testing.assert_allclose(found.abscissas, [0.0, 0.02, 0.07], atol=1e-15)
    np.testing.assert_allclose(found.ordinates, [4.0, 6.0, 6.0])


@together("slope", [198.1, 201.9])
def test_a_first_slope_within_a_hundredth_of_youn_is_taken(slope):
    (found,) = hardening_of(tension([0, 0.02, 0.05], [0, 0.02 * slope, 5.0]), 200.0).parts
    assert found.abscissas[0] == 0.0


@together(
    "strain, stress, code",
    [
        ([0.01, 0.02], [0.0, 4.0], "trac-begins-zero-stress"),
        ([0.0, 0.02], [1.0, 4.0], "trac-begins-zero-stress"),
        ([0.0], [0.0], "trac-begins-zero-stress"),
        ([0.0, 0.0], [0.0, 4.0], "trac-begins-zero-stress"),
        ([0.0, 0.02], [0.0, 0.02 * 197.0], "first-slope-trac-youn"),
        ([0.0, 0.02], [0.0, 0.02 * 203.0], "first-slope-trac-youn"),
        ([0.0, 0.02, 0.03], [0.0, 4.0, 6.1], "trac-rises-more-youn"),
    ],
)
def test_other_curves_are_refused(strain, stress, code):
    with pytest.raises(MaterialError, check=lambda e: e.code == f"kernel.materials.{code}"):
        hardening_of(tension(strain, stress), 200.0)
