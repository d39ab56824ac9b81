"""The references of cyclic soil: rules against springs, a column against its closed form."""

import numpy as np
import pytest

from references.masing import Masing, polygon
from references.soil_column import Column, bundle

STRAINS, RATIOS = np.array([1e-5, 1e-4, 1e-3]), np.array([1.0, 0.7, 0.2])


def test_masings_rules_are_those_of_a_bundle_of_springs():
    strains, shares = bundle(STRAINS, RATIOS)
    rules, springs, last = Masing(polygon(1.0, STRAINS, RATIOS)), np.zeros(3), 0.0
    for strain in np.random.default_rng(1).normal(scale=4e-4, size=200):
        springs = np.clip(springs + shares * (strain - last), -shares * strains, shares * strains)
        last = strain
        assert rules.go(strain) == pytest.approx(springs.sum(), abs=1e-15)


def test_an_elastic_column_swings_at_a_quarter_of_its_height():
    """First frequency Vs / (4 H) of a uniform layer on rock, released by a short push."""
    n, H, G, rho = 10, 20.0, 8e7, 2000.0
    far = np.full((n, 1), 1e3)
    column = Column(np.full(n, H / n), np.full(n, rho), np.full(n, G), far, np.ones((n, 1)))
    f = np.sqrt(G / rho) / (4 * H)
    step = 2e-4
    t = np.arange(0, 6 / f, step)
    push = np.where(t < 1 / f, 0.1 * np.sin(2 * np.pi * f * t), 0.0)
    top = column.shaken(push, step)[0][:, -1]
    free = t > 2 / f
    # twelve elements a wave more than resolve it: 0.1 %
    crossings = t[free][1:][np.diff(np.sign(top[free])) != 0]
    assert 0.5 / np.diff(crossings).mean() == pytest.approx(f, rel=3e-3)
