"""Which problems have all in common but their loads and initial states."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.interface import Interface
from ssilang.kernel.solvers.backends import goes_to_petsc
from ssilang.kernel.stepping.problem.problem import Problem


def share_model(a: Problem, b: Problem) -> bool:
    """Whether two problems have the same matrices, conditions, joints, scheme and times."""
    if a.numbering.size != b.numbering.size or a.scheme != b.scheme:
        return False
    if a.contact is not None or b.contact is not None:
        return False
    if a.solver != b.solver or goes_to_petsc(a.solver, a.constraints.T.shape[1]):
        return False  # a run's server is its own
    c, d = a.constraints, b.constraints
    if type(c) is not type(d) or c.associated != d.associated:
        return False
    matrices = ((a.K, b.K), (a.M, b.M), (a.C, b.C), (c.C, d.C), (c.D, d.D), (c.T, d.T))
    return (
        np.array_equal(a.times, b.times)
        and all(_same(x, y) for x, y in matrices)
        and _same_joints(a.interface, b.interface)
    )


def _same(a: sp.csr_array, b: sp.csr_array) -> bool:
    return a is b or (
        a.shape == b.shape
        and np.array_equal(a.indptr, b.indptr)
        and np.array_equal(a.indices, b.indices)
        and np.array_equal(a.data, b.data)
    )


def _same_joints(a: Interface | None, b: Interface | None) -> bool:
    if a is None or b is None:
        return a is b
    names = ("pairs", "B", "weights", "codes", "parameters")
    same = all(np.array_equal(getattr(a, n), getattr(b, n)) for n in names)
    return same and a.dimension == b.dimension and _same(a.J, b.J)


def grouped(problems: Sequence[Problem]) -> list[list[int]]:
    """Places of problems that share their model, in order."""
    groups: list[list[int]] = []
    for i, problem in enumerate(problems):
        group = next((g for g in groups if share_model(problems[g[0]], problem)), None)
        if group is None:
            groups.append([i])
        else:
            group.append(i)
    return groups


class LoadBasis:
    """The different load vectors of several problems.

    Attributes
    ----------
    forces : array (k, n)
    places : list of arrays
        Of each problem: which of them its own loads are.
    """

    def __init__(self, loads: Sequence[FloatArray]) -> None:
        found: dict[bytes, int] = {}
        rows: list[FloatArray] = []
        self.places: list[IntArray] = []
        for own in loads:
            at = []
            for row in own:
                key = row.tobytes()
                if key not in found:
                    found[key] = len(rows)
                    rows.append(row)
                at.append(found[key])
            self.places.append(np.array(at, dtype=np.int64))
        self.forces = np.array(rows).reshape(len(rows), loads[0].shape[1])

    def factors(self, own: Sequence[FloatArray], which: Sequence[int] = ()) -> FloatArray:
        """Factors (n, m, k) of all vectors from those (m, k_i) of problems: all, or `which`."""
        whole = np.zeros((len(own), len(own[0]), len(self.forces)))
        for i, given in enumerate(own):
            for column, place in enumerate(self.places[which[i] if which else i]):
                whole[i, :, place] += given[:, column]
        return whole
