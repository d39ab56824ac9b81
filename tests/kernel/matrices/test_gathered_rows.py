"""The compiled assembly against the triplet list, for any elements."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssilang.kernel.base.sparse import assemble_triplets
from ssilang.kernel.matrices.gathered_rows import assemble_rows


def compare(places: list[np.ndarray], values: list[np.ndarray], n: int) -> None:
    gathered = assemble_rows(places, values, n)
    triplets = assemble_triplets(places, values, n)
    assert gathered.has_sorted_indices
    assert (gathered.indptr == triplets.indptr).all()
    assert (gathered.indices == triplets.indices).all()
    assert gathered.data == pytest.approx(triplets.data, abs=1e-12)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.lists(st.integers(1, 6), max_size=3))
def test_rows_gathered_equal_triplets(seed: int, n: int, widths: list[int]) -> None:
    random = np.random.default_rng(seed)
    places = [random.integers(0, n, (random.integers(0, 12), m)).astype(np.int32) for m in widths]
    values = [random.standard_normal((len(p), p.shape[1], p.shape[1])) for p in places]
    compare(places, values, n)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([2, 3, 6]), st.integers(1, 4), st.booleans())
def test_unknowns_of_nodes_are_gathered_together(
    seed: int, run: int, nodes: int, by_unknown: bool
) -> None:
    """Some unknowns belong to no node of the block, so that runs start anywhere."""
    random = np.random.default_rng(seed)
    heads = np.cumsum(run + random.integers(0, 3, 9))
    cells = np.stack([random.permutation(heads)[:nodes] for _ in range(random.integers(1, 12))])
    cells = np.sort(cells, axis=1)[:, random.permutation(nodes)]
    rows = [cells + i for i in range(run)]
    places = (
        np.concatenate(rows, axis=1) if by_unknown else np.stack(rows, 2).reshape(len(cells), -1)
    )
    places = places.astype(np.int32)
    values = random.standard_normal((len(cells), run * nodes, run * nodes))
    compare([places], [values], int(heads[-1]) + run + 2)


def test_runs_that_overlap_are_gathered_row_by_row() -> None:
    places = np.array([[0, 1, 2, 3], [1, 2, 3, 4]], dtype=np.int32)
    values = np.arange(32.0).reshape(2, 4, 4)
    compare([places], [values], 5)
