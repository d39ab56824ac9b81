"""Both interface iterations give the same answer."""

import numpy as np
import pytest
from references.assembled import Bench
from references.iterations import solve_cached, solve_interface

from ssilang.kernel.interface.interface import interface_of
from ssilang.kernel.interface.laws.columns import N_STATE
from ssilang.kernel.matrices.assembly import numbering_of


@pytest.mark.parametrize("extra", [{}, {"FROT": 0.5}, {"FU": 1e4, "GF": 5.0, "FC": -1e3}])
def test_both_iterations_agree(extra):
    bench, cells = Bench(), 12
    top = [bench.node(i / cells, 0.0) for i in range(cells + 1)]
    soil = [bench.node(i / cells, 0.0) for i in range(cells + 1)]
    quads = [[top[i], top[i + 1], soil[i], soil[i + 1]] for i in range(cells)]
    zone = bench.joint("RAC2", quads, "JOI2", KN=1e9, KS=5e8, **extra)
    for n in (*top, *soil):
        bench.spring(1.0, n, unknown="UX")
        bench.spring(1.0, n, unknown="UY")
    joints = interface_of((zone,), bench.characteristics, numbering_of(bench.stiffness))
    rng = np.random.default_rng(4)
    A = rng.standard_normal((joints.size, joints.size))
    S = (A @ A.T / joints.size + np.eye(joints.size)) * 1e-8
    y0 = rng.standard_normal(joints.size) * 1e-4
    found = []
    for solve in (solve_interface, solve_cached):
        n, d = joints.n_points, 2
        y, w, t = y0.copy(), np.zeros((n, d)), np.zeros((n, d))
        new, D, f, h = np.zeros((n, N_STATE)), np.zeros((n, d, d)), *np.zeros((2, joints.size))
        turns, _ = solve(
            joints.pairs, joints.B, joints.weights, joints.codes, joints.parameters, S,
            np.zeros_like(S), 1.0, 0 * y0, 0 * y0, np.zeros((n, N_STATE)), y0, y, w, t, new, D, f,
            h,
        )  # fmt: skip
        assert turns > 0
        assert np.abs(y - y0 + S @ h).max() < 1e-9 * np.abs(y0).max()
        found.append((y, t, new))
    assert (found[0][1][:, 1] < 0).any()
    assert (found[0][1][:, 1] >= 0).any()
    for one, two in zip(*found, strict=True):
        np.testing.assert_allclose(one, two, rtol=1e-7, atol=1e-9 * max(np.abs(one).max(), 1e-30))
