"""Plane waves against closed forms of half-space and column, between the record's samples."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.records.soil_column import SoilColumn
from ssilang.kernel.records.soil_column import transfers as column_transfers
from ssilang.kernel.waves.free_field_forces import along_columns
from ssilang.kernel.waves.layered_half_space import HalfSpace, PlaneWave, plane_motion, transfers

GROUND = HalfSpace(
    np.array([4.0]), np.array([1800.0, 2100.0]), np.array([150.0, 300.0]),
    np.array([330.0, 620.0]), np.array([0.03, 0.0]),
)  # fmt: skip
STEP = 0.01
ALONG, DEPTHS = np.array([0.0, 7.0, 2.5, 0.0]), np.array([0.0, 1.3, 9.0, 1.3])


def rough(n=60):
    """A record in which every frequency up to the highest takes part."""
    record = np.random.default_rng(2).standard_normal(n)
    return np.concatenate([np.zeros(5), record - record.mean(), np.zeros(5)])


@together("kind, given", [("SH", "SURFACE"), ("SV", "INCIDENTE"), ("P", "SURFACE")])
def test_finer_steps_pass_through_the_coarse_ones(kind, given):
    wave = PlaneWave(kind, 0.3, given, 0.4, STEP, rough(), 2.0)
    coarse = plane_motion(GROUND, wave, ALONG, DEPTHS)
    fine = plane_motion(GROUND, wave, ALONG, DEPTHS, STEP / 2.5)
    np.testing.assert_allclose(fine.times[::3], coarse.times)
    for name in ("displacement", "velocity", "acceleration"):
        a, b = getattr(coarse, name), getattr(fine, name)[..., ::3]
        assert a.shape[0] == 4
        np.testing.assert_allclose(b, a, atol=1e-9 * np.abs(a).max())


def test_the_surface_moves_as_recorded_there_and_later_further_on():
    record = rough()
    wave = PlaneWave("SH", 0.3, "SURFACE", 0.0, STEP, record)
    found = plane_motion(GROUND, wave, ALONG, DEPTHS).acceleration
    at_rest = record.sum() / 256  # the series is without its mean
    np.testing.assert_allclose(found[0, 0], record - at_rest, atol=1e-9)
    slowness = np.sin(0.3) / 300.0
    far = plane_motion(GROUND, wave, np.array([2 * STEP / slowness]), np.zeros(1)).acceleration
    np.testing.assert_allclose(far[0, 0, 2:], found[0, 0, :-2], atol=1e-9)


def test_points_between_those_of_a_column_move_between_them():
    column = np.array([2.0, 7.5, 0.0, 4.0])  # in no order
    heights = np.array([0.0, 7.5, 4.0, 1.0, 5.4, 2.0, 7.4999999])
    motion = np.random.default_rng(1).standard_normal((4, 3))
    order = np.argsort(column)
    wanted = [np.interp(heights, column[order], v) for v in motion[order].T]
    np.testing.assert_allclose(
        along_columns(heights, column) @ motion, np.transpose(wanted), atol=1e-6
    )


@together("kind, speed", [("SH", 300.0), ("P", 620.0)])
def test_an_incident_wave_passes_its_point_then_comes_back_from_the_surface(kind, speed):
    """In a ground without contrast: two waves, one up and one down, each by its own delay."""
    ground = HalfSpace(
        np.array([4.0]), np.array([1800.0] * 2), np.array([300.0] * 2), np.array([620.0] * 2),
        np.zeros(2),
    )  # fmt: skip
    angle = 0.4 if kind == "SH" else 0.0
    record = rough()
    record -= record.mean()  # the series is without it
    lead = STEP * speed / np.cos(angle)  # a step up
    wave = PlaneWave(kind, angle, "INCIDENTE", 0.0, STEP, record, 7 * lead)
    ahead = 3 * STEP * speed / np.sin(angle) if angle else 0.0
    points = [(0.0, 0.0), (0.0, 2 * lead), (ahead, 5 * lead)]
    along, depths = np.array(points).T
    found = plane_motion(ground, wave, along, depths).acceleration
    component = 1 if kind == "P" else 0
    padded = np.concatenate([record, np.zeros(128 - len(record))])
    for i, (x, z) in enumerate(points):
        later = round((x * np.sin(angle) / speed) / STEP)
        up, down = (later + round((7 * lead + s * z) / lead) for s in (-1, 1))
        expected = np.roll(padded, up) + np.roll(padded, down)
        expected = expected[: len(record)]
        np.testing.assert_allclose(found[i, component], expected, atol=1e-8)
    assert wave.delay(ground) == pytest.approx(7 * STEP)
    assert PlaneWave(kind, angle, "SURFACE", 0.0, STEP, record, 9.0).delay(ground) == 0.0


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
