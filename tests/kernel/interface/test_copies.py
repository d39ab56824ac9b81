"""Products in compiled code, of all numbers of rows beside the four that go together."""

import numpy as np
import pytest

from ssilang.kernel.interface.copies import add_product, add_symmetric_product


@pytest.mark.parametrize("rows", range(10))
def test_products_are_added(rows):
    random = np.random.default_rng(rows)
    A, x, y = random.normal(size=(rows, 7)), random.normal(size=7), random.normal(size=rows)
    for kind, error in ((np.float64, 1e-14), (np.float32, 1e-6)):
        found = y.copy()
        add_product(-0.5, A.astype(kind), x.astype(kind), found)
        np.testing.assert_allclose(found, y - 0.5 * A @ x, atol=error * 10)
    S, z, found = A @ A.T, random.normal(size=rows), y.copy()
    pair = np.arange(rows) // 2
    half = np.where(pair > pair[:, None], np.nan, S)
    add_symmetric_product(half, z, found)
    np.testing.assert_allclose(found, y + S @ z, atol=1e-13)
