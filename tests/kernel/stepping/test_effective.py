"""The linear system of a step: which unknown stands for a motion in its ordering."""

import numpy as np

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.effective import _heaviest_rows


def test_each_motion_stands_where_its_largest_entry_is():
    draw = np.random.default_rng(4)
    T = np.where(draw.uniform(size=(40, 25)) < 0.2, draw.integers(-3, 4, (40, 25)), 0)
    T[:, 7] = 0
    exact = np.abs(T).argmax(axis=0)
    assert _heaviest_rows(sp.csr_array(T.astype(float))).tolist() == exact.tolist()
