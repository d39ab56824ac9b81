"""Rigid footings under a motion that differs below them: against closed forms and double sums."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import erf, ive, jv

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.waves.incoherence import Disc, Rectangle, Strip, factors, filtered

HALF = 17.0
Z = np.array([0.3, 1.0, 2.5, 5.0, 11.0])
NONE = np.zeros((5, 2))
SHAPES = [Strip(HALF), Disc(HALF), Rectangle(HALF, 0.6 * HALF)]


def along_x(z):
    return np.stack([z / HALF, 0 * z], axis=1)


def test_wave_that_passes():
    # a strip's plain mean of exp(-ikx) and of x exp(-ikx); a disc's (Bessel)
    strip = factors(Strip(HALF), 0 * Z, along_x(Z))
    assert strip.mean == pytest.approx(np.sin(Z) / Z, abs=1e-12)
    assert strip.slopes[:, 0] * HALF == pytest.approx(
        3 * (np.sin(Z) - Z * np.cos(Z)) / Z**2, abs=1e-12
    )
    disc = factors(Disc(HALF), 0 * Z, along_x(Z))
    assert disc.mean == pytest.approx(2 * jv(1, Z) / Z, abs=1e-12)
    assert disc.slopes[:, 0] * HALF == pytest.approx(8 * jv(2, Z) / Z, abs=1e-12)
    assert np.all(disc.slopes[:, 1] == 0)


def line(q):
    """Double mean over a line of exp(-(q s)^2), s from 0 to 1."""
    return np.sqrt(np.pi) * erf(q) / q + (np.exp(-q * q) - 1) / q**2


def test_incoherence_without_a_wave():
    strip = factors(Strip(HALF), Z / HALF, NONE)
    assert strip.mean**2 == pytest.approx(line(2 * Z), rel=1e-8)
    square = factors(Rectangle(HALF, 0.6 * HALF), Z / HALF, NONE)
    assert square.mean**2 == pytest.approx(line(2 * Z) * line(1.2 * Z), rel=1e-8)
    # Luco and Wong's form of a disc
    disc = factors(Disc(HALF), Z / HALF, NONE)
    a = 2 * Z**2
    assert disc.mean**2 == pytest.approx((1 - ive(0, a) - ive(1, a)) / Z**2, rel=1e-8)
    for one in (strip, square, disc):
        assert np.all(one.coherence == 0)


def test_disc_lies_above_the_solution_with_tractions():
    # Mita and Luco 1987: covariances at gamma = 0.5, a0 = 1, 2, 3, the two columns of
    # Code_Aster V2.03.118
    rigorous = np.array([[0.732, 0.402, 0.251], [0.730, 0.416, 0.270]])
    found = factors(Disc(HALF), 0.5 * np.arange(1.0, 4.0) / HALF, NONE[:3]).mean
    over = found / np.sqrt(rigorous) - 1
    assert np.all(over > 0)
    assert np.all(over < 0.09)


def disc_points():
    """Positions (n, 2) on a disc of radius 1 and weights, by rings of Gauss and Legendre."""
    x, w = np.polynomial.legendre.leggauss(20)
    r, turned = (x + 1) / 2, 2 * np.pi * np.arange(32) / 32
    xy = np.stack([np.outer(np.cos(turned), r), np.outer(np.sin(turned), r)], axis=-1)
    return xy.reshape(-1, 2), np.tile(w / 2 * r, 32) * 2 * np.pi / 32


def rectangle_points(half_y):
    x, w = np.polynomial.legendre.leggauss(18)
    xy = np.stack(np.meshgrid(x, half_y * x, indexing="ij"), axis=-1)
    return xy.reshape(-1, 2), np.outer(w, half_y * w).ravel()


@pytest.mark.parametrize(
    ("decay", "k"), [(0.7, (1.1, 0.6)), (1.5, (0.0, 0.0)), (1e-3, (3e-3, 1e-3))]
)
@pytest.mark.parametrize("shape", ["disc", "rectangle"])
def test_double_sums_over_the_area(shape, decay, k):
    xy, weight = disc_points() if shape == "disc" else rectangle_points(0.6)
    footing = Disc(HALF) if shape == "disc" else Rectangle(HALF, 0.6 * HALF)
    apart = xy[:, None] - xy[None]
    spectrum = np.exp(-(decay**2) * (apart**2).sum(-1) - 1j * (apart @ np.array(k)))
    found = factors(footing, np.array([decay]) / HALF, np.array([k]) / HALF)
    mean = weight / weight.sum()
    translation = np.sqrt((mean @ spectrum @ mean).real)
    assert found.mean[0] == pytest.approx(translation, rel=1e-9)
    for way in (0, 1):
        slope = weight * xy[:, way] / (weight @ xy[:, way] ** 2)
        turned = np.sqrt((slope @ spectrum @ slope).real)
        assert found.slopes[0, way] * HALF == pytest.approx(turned, rel=1e-8)
        both = abs(slope @ spectrum @ mean) / translation / turned
        assert found.coherence[0, way] == pytest.approx(both, abs=1e-8)


@pytest.mark.parametrize("footing", SHAPES)
def test_slow_motion(footing):
    still = factors(footing, np.zeros(1), np.zeros((1, 2)))
    assert still.mean[0] == pytest.approx(1, abs=1e-14)
    assert np.all(still.slopes == 0)
    # the slope of a slow wave is its wave number, however small
    slow = np.array([1e-9, 1e-6, 1e-3])
    found = factors(footing, 1e-6 * slow / HALF, along_x(slow))
    assert found.slopes[:, 0] * HALF == pytest.approx(slow, rel=1e-6)
    assert found.coherence[:, 0] == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("footing", SHAPES)
def test_little_incoherence_is_none(footing):
    k = along_x(Z) + 0.3 * along_x(Z)[:, ::-1]
    none, little = factors(footing, 0 * Z, k), factors(footing, 1e-7 / HALF + 0 * Z, k)
    assert little.mean == pytest.approx(none.mean, abs=1e-6)
    assert little.slopes * HALF == pytest.approx(none.slopes * HALF, abs=1e-6)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(
    st.sampled_from(SHAPES),
    st.floats(1e-3, 3.0),
    st.floats(1.01, 3.0),
    st.floats(0.0, 6.0),
)
def test_more_incoherence_moves_the_footing_less(footing, decay, times, wave):
    # a mean of plane waves' factors that spread: monotone where no wave passes
    decays = np.array([decay, decay * times]) / HALF
    one, more = factors(footing, decays, np.zeros((2, 2))).mean
    assert 0 < more < one <= 1
    passing = factors(footing, decays, np.repeat(along_x(np.array([wave])), 2, axis=0))
    assert np.all(np.abs(passing.mean) <= 1)
    assert np.all(passing.coherence <= 1)


def test_a_record_becomes_the_mean_of_what_passes():
    step, late, frequency = 0.005, 0.07, 3.0  # half the width over the speed, s
    times = step * np.arange(400)

    def ricker(t):
        y = (np.pi * frequency * t) ** 2
        return (1 - 2 * y) * np.exp(-y)

    nodes, weights = np.polynomial.legendre.leggauss(40)
    ground = ricker(times[:, None] - 1.0 - late * nodes)  # at x = nodes * half
    made = filtered(
        ricker(times - 1.0),
        step,
        lambda f: factors(Strip(HALF), 0 * f, along_x(2 * np.pi * f * late)),
    )
    assert made.mean == pytest.approx(ground @ weights / 2, abs=1e-9)
    assert made.slopes[:, 0] * HALF == pytest.approx(ground @ (weights * nodes) * 1.5, abs=1e-9)
    assert made.lost < 1e-6


def test_what_comes_before_the_record_is_told():
    record = np.zeros(200)
    record[:40] = 1.0
    made = filtered(
        record, 0.01, lambda f: factors(Strip(HALF), 0 * f, along_x(2 * np.pi * f * 0.1))
    )
    assert made.lost == pytest.approx(0.5, abs=0.1)
    assert made.early == pytest.approx(0.1, abs=0.03)


def test_refusals():
    with pytest.raises(MaterialError, match="sizes of a footing"):
        Rectangle(1.0, 0.0)
    with pytest.raises(MaterialError, match="differs too fast"):
        factors(Strip(1.0), np.array([1.0]), np.array([[1e9, 0.0]]))
