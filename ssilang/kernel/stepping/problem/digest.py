"""What tells one problem from another: a digest of its numbers."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.problem.problem import Problem


def digest(matrices: Iterable[sp.csr_array], arrays: Iterable[NDArray[Any]]) -> str:
    """A digest of all numbers of matrices and arrays."""
    found = hashlib.sha256()
    parts = (part for A in matrices for part in (A.indptr, A.indices, A.data))
    for group in (parts, arrays):
        for array in group:
            found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


def digest_of(problem: Problem) -> str:
    """A digest of all that the steps of a problem depend on."""
    p = problem
    matrices = [p.K, p.M, p.C, p.constraints.C, p.constraints.T]
    arrays: list[NDArray[Any]] = [
        p.numbering.nodes, p.numbering.codes, p.loading.forces, p.loading.imposed,
        *(x for curve in p.loading.curves for x in curve), p.u, p.v, p.state, p.times,
    ]  # fmt: skip
    if p.interface is not None:
        matrices.append(p.interface.J)
        arrays += [p.interface.codes, p.interface.parameters, p.interface.weights, p.interface.B]
    if p.contact is not None:
        matrices += [p.contact.pushing, p.contact.seen]
        arrays.append(p.contact.imposed)
    words = f"{p.scheme} {p.contact_options}".encode()
    return digest(matrices, [*arrays, np.frombuffer(words, np.uint8)])
