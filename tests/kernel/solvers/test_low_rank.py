"""Matrices in blocks of few vectors: what is left out is as said, and less is kept."""

import numpy as np
import pytest

from ssilang.kernel.solvers import low_rank as rooms
from ssilang.kernel.solvers.low_rank import NONE, add_low_rank_product, low_rank


def compliance(places, d, reach=1.0):
    """A smooth one (n d, n d) of places: directions differ, all act on each other."""
    away = np.linalg.norm(places[:, None] - places[None], axis=2)
    mixed = np.random.default_rng(2).standard_normal((d, d))
    return np.kron(np.exp(-away / reach) + np.eye(len(places)), mixed @ mixed.T + np.eye(d))


def product(A, few, x):
    y = -x
    add_low_rank_product(A, few, x, y)
    return y + x


@pytest.mark.parametrize(
    ("n", "dimension", "d", "cluster"),
    [(300, 2, 3, 96), (211, 3, 3, 40), (97, 1, 2, 10), (20, 2, 3, 96), (1, 2, 2, 4)],
)
def test_products_are_those_of_the_matrix_but_for_what_is_said(
    monkeypatch, n, dimension, d, cluster
):
    monkeypatch.setattr(rooms, "CLUSTER", cluster)
    random = np.random.default_rng(n)
    places = random.uniform(0.0, 10.0, (n, dimension))
    places[n // 2 : n // 2 + 3] = places[0]  # in one place
    S = compliance(places, d)
    size = np.linalg.norm(S, 2)
    A = low_rank(S, places, 1e-3 * size, 1e-7 * size)
    assert np.diff(A.first).max() < cluster + d
    assert np.array_equal(np.sort(A.order), np.arange(n * d))
    X, sides = np.eye(n * d), np.diff(A.first)
    assert 2 * len(A.values) <= (n * d) ** 2 + (sides**2).sum()  # no more than the blocks whole
    for few, least in ((True, 1e-3), (False, 1e-7)):
        found = np.array([product(A, few, x) for x in X])
        left = np.linalg.norm(found - S, 2) / size
        assert left < least
        np.testing.assert_allclose(found, found.T, atol=1e-15 * size)
        rows = X[: n // 2 + 1]
        together = product(A, few, rows.ravel()).reshape(rows.shape)
        np.testing.assert_allclose(together, found[: len(rows)], atol=1e-15 * size)
        if n > 200 and few:
            assert left > 0.03 * least
        for k in (1, n * d - 1):
            np.testing.assert_allclose(product(A, few, S[k]), found @ S[k], rtol=1e-6)


def test_little_is_kept_of_what_is_smooth_far_away(monkeypatch):
    monkeypatch.setattr(rooms, "CLUSTER", 48)
    x, y = np.meshgrid(np.linspace(0.0, 20.0, 21), np.linspace(0.0, 20.0, 19))
    places = np.column_stack([x.ravel(), y.ravel()])
    S = compliance(places, 3, reach=3.0)
    A = low_rank(S, places, *(x * np.linalg.norm(S, np.inf) for x in (1e-2, 1e-4)))
    few, all_of_them = A.ranks[A.ranks[:, 1] >= 0].mean(axis=0)
    assert few < 0.7 * all_of_them
    assert len(A.values) < 0.55 * (3 * len(places)) ** 2 / 2
    assert not len(NONE.values)
