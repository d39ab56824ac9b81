"""Plane waves against closed forms of the homogeneous half-space and the vertical column."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.records.soil_column import SoilColumn
from ssilang.kernel.records.soil_column import transfers as column_transfers
from ssilang.kernel.waves.layered_half_space import HalfSpace, transfers

OMEGA = 2 * np.pi * np.array([1.0, 5.0, 20.0])
VS, K = 200.0, 1.8708286933869707  # speed of shear waves, ratio of the speeds at nu = 0.3
ANGLES = np.radians([0.0, 20.0, 40.0, 70.0])


def half_space(*thickness):
    ones = np.ones(len(thickness) + 1)
    return HalfSpace(np.array(thickness), 2000 * ones, VS * ones, K * VS * ones, 0 * ones)


@together("angle", ANGLES)
def test_shear_across_the_plane_stands(angle):
    moved, _ = transfers(half_space(), "SH", angle, OMEGA, np.array([0.0, 3.0]))
    assert moved[0, 0] == pytest.approx(2.0)
    assert moved[1, 0] == pytest.approx(2 * np.cos(OMEGA * np.cos(angle) / VS * 3.0))


@together("angle", ANGLES)
def test_surface_under_pressure_waves(angle):
    # Achenbach 1973, section 5.5: coefficients of a free surface
    turned = np.arcsin(np.sin(angle) / K)
    d = np.sin(2 * angle) * np.sin(2 * turned) + K**2 * np.cos(2 * turned) ** 2
    moved, slowness = transfers(half_space(), "P", angle, OMEGA, np.zeros(1))
    assert slowness == pytest.approx(np.sin(angle) / (K * VS))
    assert moved[0, 0] == pytest.approx(
        np.full(3, 2 * K**2 * np.sin(2 * turned) * np.cos(angle) / d)
    )
    assert moved[0, 1] == pytest.approx(
        np.full(3, 2 * K**2 * np.cos(2 * turned) * np.cos(angle) / d)
    )


@together("angle", ANGLES)
def test_surface_under_shear_waves_beyond_the_critical_angle_too(angle):
    sine = K * np.sin(angle)
    cosine = np.sqrt(complex(1 - sine**2))
    cosine = -cosine if cosine.imag > 0 else cosine
    d = 2 * sine * cosine * np.sin(2 * angle) + K**2 * np.cos(2 * angle) ** 2
    moved, _ = transfers(half_space(), "SV", angle, OMEGA, np.zeros(1))
    along = 2 * K**2 * np.cos(2 * angle) * np.cos(angle) / d
    assert np.abs(moved[0, 0] - along).max() < 1e-12
    assert np.abs(moved[0, 1] + 2 * K * np.sin(2 * angle) * cosine / d).max() < 1e-12


@together("kind", ["SH", "SV", "P"])
def test_cuts_without_contrast_change_nothing(kind):
    depths = np.array([0.0, 2.0, 4.0, 9.0, 30.0])
    whole, _ = transfers(half_space(), kind, 0.9, OMEGA, depths)
    cut, _ = transfers(half_space(4.0, 7.0), kind, 0.9, OMEGA, depths)
    assert np.abs(whole - cut).max() < 1e-13


def test_vertical_shear_is_that_of_the_column():
    # the column's transfers go by sines and cosines from the surface down
    damping = np.array([0.05, 0.02, 0.0])
    density, shear = np.array([1800.0, 2000.0, 2300.0]), np.array([150.0, 300.0, 900.0])
    ground = HalfSpace(np.array([5.0, 9.0]), density, shear, 2 * shear, damping, 2.0, 12.0)
    column = SoilColumn(
        np.array([5.0, 9.0, 1.0]), density, density * shear**2, damping, 2.0, 12.0
    )  # fmt: skip
    depths = np.array([0.0, 2.0, 5.0, 14.0])
    expected = column_transfers(column, OMEGA, depths)[0]
    for kind in ("SH", "SV"):
        moved = transfers(ground, kind, 0.0, OMEGA, depths)[0][:, 0]
        assert np.abs(moved / moved[0] - expected).max() < 1e-12
