"""@STAT FZERO QUADRATU against closed forms."""

import numpy as np
import pytest
from script_runs import found


def test_regression_line_is_that_of_least_squares():
    x, y = np.array([0, 1.85, 4.65, 7, 10, 11]), np.array([2.25, 2.0, 1.75, 1.4, 1.0, 0.8])
    lists = [" ".join(repr(float(v)) for v in values) for values in (x, y)]
    values = found(
        f"XM EX YM EY A B R = @STAT (PROG {lists[0]}) (PROG {lists[1]}) ;",
        "XM", "EX", "YM", "EY", "A", "B", "R",
    )  # fmt: skip
    slope, level = np.polyfit(x, y, 1)
    expected = (x.mean(), x.std(), y.mean(), y.std(), slope, level, np.corrcoef(x, y)[0, 1])
    assert values == pytest.approx(expected, rel=1e-10)
