"""Products of panels by written code: as NumPy has them, and nothing beside is read or changed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled import UNCOMPILED
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.solvers.cholesky import panel_products as products


@compiled
def lower(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.times_lower(values, pos, w, x, at)


@compiled
def upper(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.times_upper(values, pos, w, x, at)


@compiled
def rows(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.subtract(values, pos, w, m, x, at, to)


@compiled
def columns(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.subtract_transposed(values, pos, w, m, x, at, to)


EXPECTED = {
    lower: lambda L, P, b, y: (L @ b, y),
    upper: lambda L, P, b, y: (L.T @ b, y),
    rows: lambda L, P, b, y: (b, y - P.T @ b),
    columns: lambda L, P, b, y: (b - P @ y, y),
}


@pytest.mark.parametrize("product", EXPECTED)
@given(
    w=st.integers(1, 33), m=st.integers(0, 70), pos=st.integers(0, 9), at=st.integers(0, 9),
    between=st.integers(0, 9), seed=st.integers(0, 2**32 - 1),
)  # fmt: skip
def test_products_are_numpy_s_and_leave_the_rest(product, w, m, pos, at, between, seed):
    random = np.random.default_rng(seed)
    square, P = np.tril(random.normal(size=(w, w))), random.normal(size=(w, m))
    held = P if product in (rows, columns) else square
    # what is not a number would spread if it were read
    values = np.full(pos + held.size + 9, np.nan)
    values[pos : pos + held.size] = held.ravel()
    b, y, to = random.normal(size=w), random.normal(size=m), at + w + between
    x = np.full(to + m + 9, np.nan)
    x[at : at + w], x[to : to + m] = b, y
    product(values, pos, w, m, x, at, to)
    new_b, new_y = EXPECTED[product](square, P, b, y)
    np.testing.assert_allclose(x[at : at + w], new_b, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(x[to : to + m], new_y, rtol=1e-12, atol=1e-12)
    assert np.isnan(np.delete(x, [*range(at, at + w), *range(to, to + m)])).all()


@pytest.mark.skipif(UNCOMPILED, reason="without compilation they are plain functions")
def test_called_from_python_they_are_their_text():
    x = np.array([1.0, 2.0, 5.0])
    products.subtract(np.array([3.0, 4.0]), 0, 2, 1, x, 0, 2)
    np.testing.assert_array_equal(x, [1.0, 2.0, 5.0 - 3.0 - 8.0])
