"""The compiled assembly against the triplet list, for any elements."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssilang.kernel.matrices.assembly import assemble_triplets
from ssilang.kernel.matrices.gathered_rows import assemble_rows


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.lists(st.integers(1, 6), max_size=3))
def test_rows_gathered_equal_triplets(seed: int, n: int, widths: list[int]) -> None:
    random = np.random.default_rng(seed)
    places = [random.integers(0, n, (random.integers(0, 12), m)).astype(np.int32) for m in widths]
    values = [random.standard_normal((len(p), p.shape[1], p.shape[1])) for p in places]
    gathered = assemble_rows(places, values, n)
    triplets = assemble_triplets(places, values, n)
    assert gathered.has_sorted_indices
    assert (gathered.indptr == triplets.indptr).all()
    assert (gathered.indices == triplets.indices).all()
    assert gathered.data == pytest.approx(triplets.data, abs=1e-12)
