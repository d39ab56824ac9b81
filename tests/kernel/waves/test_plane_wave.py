"""Histories of plane waves between the record's samples, and columns along heights."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.waves.free_field_forces import along_columns
from ssilang.kernel.waves.layered_half_space import HalfSpace, PlaneWave, plane_motion

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
