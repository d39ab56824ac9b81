"""Lognormal fragilities against grids, probit sums, closed forms, repeated samples."""

import numpy as np
import pytest
from refusing import refusal
from scipy import optimize, stats
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.fragility import of_cloud, of_exceedances

LEVELS = np.array([0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0])
COUNTS = np.array([0.0, 0, 0, 4, 6, 13, 12, 16])
FORTY = np.full(8, 40.0)


def likelihood(p, x, exceeded, runs):
    """Log-likelihood as Baker writes it, of a median and a dispersion, or of arrays of them."""
    medians, dispersions = (np.asarray(q)[..., None] for q in p)
    share = stats.lognorm.cdf(x, dispersions, scale=medians)
    return stats.binom.logpmf(exceeded, runs, share).sum(axis=-1)


def test_the_maximum_is_that_of_a_search_without_slopes_and_of_a_grid():
    found = of_exceedances(LEVELS, COUNTS, FORTY)
    lost = lambda p: -likelihood(p, LEVELS, COUNTS, FORTY)  # noqa: E731
    best = optimize.minimize(
        lost, [0.8, 0.4], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}
    )
    assert (found.median, found.dispersion) == pytest.approx(tuple(best.x), rel=1e-6)
    grid = np.meshgrid(np.linspace(0.5, 3.0, 126), np.linspace(0.1, 1.5, 71))
    top = likelihood(grid, LEVELS, COUNTS, FORTY).argmax()
    at = tuple(values.ravel()[top] for values in grid)
    assert (found.median, found.dispersion) == pytest.approx(at, abs=0.02)
    assert (found.exceeded, found.runs) == (51, 320)
    assert found.probability(np.array([found.median])) == pytest.approx([0.5])


def test_standard_errors_are_those_of_the_curvature_of_that_likelihood():
    found = of_exceedances(LEVELS, COUNTS, FORTY)
    p, h = np.array([np.log(found.median), found.dispersion]), 1e-4
    value = lambda q: likelihood((np.exp(q[0]), q[1]), LEVELS, COUNTS, FORTY)  # noqa: E731
    e = h * np.eye(2)
    curvature = [
        [
            (
                value(p + e[i] + e[j])
                - value(p + e[i] - e[j])
                - value(p - e[i] + e[j])
                + value(p - e[i] - e[j])
            )
            / (4 * h * h)
            for j in (0, 1)
        ]
        for i in (0, 1)
    ]
    errors = np.sqrt(np.diag(np.linalg.inv(-np.array(curvature))))
    assert (found.median_error, found.dispersion_error) == pytest.approx(tuple(errors), rel=1e-4)
    low, high = found.bounds()
    assert np.log(high / low) == pytest.approx(2 * 1.959964 * found.median_error, rel=1e-6)


def test_order_ties_and_counts_do_not_matter():
    counted = of_exceedances(LEVELS, COUNTS, FORTY)
    x = np.repeat(LEVELS, 40)
    y = np.concatenate([np.arange(40) < c for c in COUNTS]).astype(float)
    shuffled = np.random.default_rng(3).permutation(len(x))
    one_by_one = of_exceedances(x[shuffled], y[shuffled], np.ones(len(x)))
    for name in ("median", "dispersion", "median_error", "dispersion_error", "exceeded", "runs"):
        assert getattr(one_by_one, name) == pytest.approx(getattr(counted, name), rel=1e-7)


def test_another_unit_scales_the_median_alone():
    a, b = of_exceedances(LEVELS, COUNTS, FORTY), of_exceedances(981.0 * LEVELS, COUNTS, FORTY)
    assert b.median == pytest.approx(981.0 * a.median, rel=1e-8)
    assert (b.dispersion, b.median_error) == pytest.approx((a.dispersion, a.median_error), rel=1e-7)


@together(
    "x, exceeded, code",
    [
        ([1, 2, 3], [0, 0, 0], "none"),
        ([1, 2, 3], [1, 1, 1], "all"),
        ([3, 1, 2, 4], [1, 0, 0, 1], "separated"),
        ([1, 2, 2, 3], [0, 0, 1, 1], "separated"),  # a tie alone does not overlap
        ([1, 2 + 4e-16, 2, 3], [0, 0, 1, 1], "separated"),  # one by rounding neither
        ([1, 2, 3, 4], [1, 1, 0, 0], "falls"),
        ([1, 2, 3, 4], [1, 0, 1, 0], "falls"),
        ([1, 2, 4], [1, 0, 1], "falls"),
        ([2, 2, 2], [1, 0, 1], "one-level"),
        ([6, 6, 6.000000000000001], [1, 0, 1], "one-level"),
        ([2.0], [1], "runs"),
        ([1, 2, 0], [0, 1, 0], "intensity"),
        ([1, 2, np.nan], [0, 1, 0], "intensity"),
        ([1, 2, 3], [0, 2, 0], "counts"),
        ([1, 2, 3], [0, 1], "sizes"),
    ],
)
def test_what_has_no_maximum_is_said(x, exceeded, code):
    with refusal(FieldError, f"kernel.records.fragility-{code}"):
        of_exceedances(np.array(x, float), np.array(exceeded, float), np.ones(len(exceeded)))


def test_the_least_overlap_has_a_maximum():
    x, y = np.array([1.0, 2.0, 3.0, 4.0]), np.array([0.0, 1.0, 0.0, 1.0])
    found = of_exceedances(x, y, np.ones(4))
    lost = lambda p: -likelihood(p, x, y, np.ones(4))  # noqa: E731
    best = optimize.minimize(
        lost, [2.0, 1.0], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}
    )
    assert (found.median, found.dispersion) == pytest.approx(tuple(best.x), rel=1e-5)


def test_intervals_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(1)
    levels, n = np.linspace(0.4, 2.5, 8), np.full(8, 40.0)
    p = stats.lognorm.cdf(levels, 0.5, scale=1.2)
    held = 0
    for _ in range(400):
        low, high = of_exceedances(levels, rng.binomial(40, p).astype(float), n).bounds()
        held += low < 1.2 < high
    assert 0.925 < held / 400 < 0.975  # two standard deviations of the count


def test_runs_of_one_record_count_as_one_record():
    """Incremental analysis: capacities of 30 records, each seen at 12 levels."""
    rng = np.random.default_rng(2)
    levels = np.linspace(0.3, 3.0, 12)
    x, which = np.tile(levels, 30), np.repeat(np.arange(30), 12)
    held = {"alone": 0, "records": 0}
    for _ in range(100):
        capacities = np.exp(0.4 * rng.standard_normal(30))
        y = (x > capacities[which]).astype(float)
        for name, records in (("alone", None), ("records", which)):
            low, high = of_exceedances(x, y, np.ones(len(x)), records).bounds()
            held[name] += low < 1.0 < high
    assert held["records"] / 100 > 0.91
    assert held["alone"] / 100 < 0.85  # what it is for


def test_few_records_give_no_errors():
    x, y = np.tile([1.0, 2.0, 3.0, 4.0], 2), np.array([0.0, 1, 0, 1, 0, 0, 1, 1])
    which = np.repeat([7, 3], 4)
    found, one = (of_exceedances(x, y, np.ones(8), r) for r in (which, None))
    assert (found.median, found.dispersion) == (one.median, one.dispersion)
    assert np.isnan([found.median_error, found.dispersion_error, *found.bounds()]).all()
    assert np.isnan(of_cloud(x, x * (1 + 0.1 * y), 2.0, records=which).median_error)


def test_a_cloud_of_a_known_law_has_its_fragility():
    """ln D = ln 2 + 1.5 ln x + e, with e made to have no mean, no trend and a variance of 0.3^2."""
    rng = np.random.default_rng(4)
    x = np.exp(rng.standard_normal(40))
    rows = np.column_stack([np.ones(40), np.log(x)])
    e = rng.standard_normal(40)
    e -= rows @ np.linalg.lstsq(rows, e, rcond=None)[0]
    e *= 0.3 / np.sqrt(e @ e / 38)
    d = 2.0 * x**1.5 * np.exp(e)
    found = of_cloud(x, d, 5.0)
    median = (5.0 / 2.0) ** (1 / 1.5)
    assert (found.median, found.dispersion) == pytest.approx((median, 0.3 / 1.5), rel=1e-9)
    assert found.exceeded == (d > 5.0).sum()
    wide = of_cloud(x, d, 5.0, capacity=0.4)
    assert wide.dispersion == pytest.approx(0.5 / 1.5, rel=1e-9)
    # factors of safety fall: their inverses are the same cloud
    falling = of_cloud(x, 1 / d, 0.2, below=True)
    for name in ("median", "dispersion", "median_error", "dispersion_error", "exceeded"):
        assert getattr(falling, name) == pytest.approx(getattr(found, name), rel=1e-9)


@pytest.mark.parametrize("repeated", [1, 4])
def test_errors_of_a_cloud_are_those_of_repeated_samples(repeated):
    """One run a record, and four whose scatter is the record's own."""
    rng = np.random.default_rng(5)
    x = np.exp(rng.uniform(-1.5, 1.5, 80))
    which = np.arange(80) // repeated
    medians, dispersions, errors = [], [], []
    for _ in range(600):
        e = 0.35 * rng.standard_normal(80 // repeated)[which]
        found = of_cloud(x, 2.0 * x * np.exp(e), 2.6, records=which)
        medians.append(np.log(found.median))
        dispersions.append(found.dispersion)
        errors.append((found.median_error, found.dispersion_error))
    seen = np.std(medians), np.std(dispersions)
    assert np.mean(errors, axis=0) == pytest.approx(seen, rel=0.2)


@together(
    "x, d, more, code",
    [
        ([1, 2, 3], [1, 2, 0], {}, "demand"),
        ([1, 2, 3], [1, 2, np.inf], {}, "demand"),
        ([1, 2, 3], [1, 2, 4], {"limit": -1.0}, "demand"),
        ([1, 2, 3], [3, 2, 1], {}, "cloud-falls"),
        ([1, 2, 3, 5], [2, 2 + 1e-15, 2 + 4e-16, 2 + 2e-15], {"limit": 9.0}, "cloud-falls"),
        ([5, 2, 3, 1], [1.998, 2.001, 2.0, 2.002], {"limit": 0.5, "below": True}, "cloud-falls"),
        ([1, 2, 3], [1, 2, 3.5], {"below": True}, "cloud-falls"),
        ([2, 2, 2], [1, 2, 3], {}, "one-level"),
        ([6, 6, 6.000000000000001], [1, 2, 3], {}, "one-level"),
        ([1, 2, 4], [2, 4, 8], {}, "no-scatter"),
        ([1, 2], [1, 2], {}, "runs"),
        ([1, 2, 3], [1, 2, 3.5], {"capacity": -0.1}, "capacity"),
    ],
)
def test_a_cloud_that_tells_nothing_is_refused(x, d, more, code):
    given = {"limit": 1.0, **more}
    with refusal(FieldError, f"kernel.records.fragility-{code}"):
        of_cloud(np.array(x, float), np.array(d, float), **given)


def test_a_cloud_without_scatter_has_that_of_the_capacity():
    found = of_cloud(np.array([1.0, 2.0, 4.0]), np.array([2.0, 4.0, 8.0]), 3.0, capacity=0.3)
    assert (found.median, found.dispersion) == pytest.approx((1.5, 0.3), rel=1e-9)
