"""Conditions eliminated in three ways: motions, forces and multipliers against dense algebra."""

import numpy as np
import pytest
import scipy.linalg as la
from scipy import sparse as sp
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.stepping.problem.constraints import (
    EliminatedConstraints,
    NonAssociatedConstraints,
    OrthogonalConstraints,
)

N = 7
C = np.zeros((3, N))
C[0, [1, 4]] = 2.0, -1.0
C[1, 5] = 3.0
C[2, [4, 0, 6]] = 1.0, 0.5, -2.0
D = C.copy()
D[0], D[2] = 0.0, 0.0
D[0, [1, 2]] = 1.0, -0.4
D[2, [6, 0]] = -1.0, 0.3
WAYS = {
    "eliminated": lambda: (EliminatedConstraints(sp.csr_array(C)), C),
    "orthogonal": lambda: (OrthogonalConstraints(sp.csr_array(C)), C),
    "not associated": lambda: (
        NonAssociatedConstraints(sp.csr_array(C), sp.csr_array(D)), D
    ),
}  # fmt: skip


@together("way", WAYS)
def test_motions_forces_and_multipliers_are_those_of_the_rows(way):
    made, push = WAYS[way]()
    rng = np.random.default_rng(1)
    T, V = made.T.toarray(), made.V.toarray()
    np.testing.assert_allclose(C @ T, 0.0, atol=1e-12)
    np.testing.assert_allclose(push @ V, 0.0, atol=1e-12)
    assert np.linalg.matrix_rank(T) == np.linalg.matrix_rank(V) == T.shape[1] == N - 3
    assert made.associated is (push is C)
    d = rng.standard_normal(3)
    np.testing.assert_allclose(C @ made.particular(d), d, atol=1e-12)
    pull = rng.standard_normal(3)
    np.testing.assert_allclose(made.multipliers(push.T @ pull), pull, atol=1e-12)
    rows = np.array([2, 0])
    columns = made.pushers(rows)
    assert columns.shape == (N, 2)
    np.testing.assert_allclose((push.T @ pull) @ columns, pull[rows], atol=1e-12)


def test_rows_that_repeat_share_and_rows_that_leave_unlike_motions_are_refused():
    twice = OrthogonalConstraints(sp.csr_array(np.vstack([C, C[:1]])))
    assert twice.T.shape[1] == N - 3
    found = twice.multipliers(6.0 * C[0])
    np.testing.assert_allclose(found, [3.0, 0.0, 0.0, 3.0], atol=1e-12)
    np.testing.assert_allclose(twice.particular(np.array([1.0, 0, 0, 1.0])) @ C.T, [1, 0, 0],
                               atol=1e-12)  # fmt: skip
    with pytest.raises(KernelError, match="motions"):
        NonAssociatedConstraints(sp.csr_array(C), sp.csr_array(D[:2]))
    none = OrthogonalConstraints(sp.csr_array((0, 4)))
    np.testing.assert_allclose(none.T.toarray(), np.eye(4))
    assert none.multipliers(np.ones(4)).shape == (0,)
    assert none.particular(np.zeros(0)).tolist() == [0.0] * 4
    everywhere = OrthogonalConstraints(sp.csr_array(C[[0]][:, [1, 4]]))
    assert la.norm(everywhere.T.toarray()[:, 0]) == pytest.approx(1.0)
