"""Complex modes of damped or unsymmetric systems: `(K + i w C - w^2 M) x = 0`, w = 2 pi f.

With mu = i w the problem is linear in (x, mu x); frequencies f are complex, a positive imaginary
part means decay. Real matrices give pairs (f, - conj f), both modes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import vector_to_field
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.modal.modes import unit_translations
from ssilang.kernel.modal.reduced import ReducedProblem, reduced_problem

DENSE = 300  # unknowns up to which all eigenvalues are computed


@dataclass(frozen=True, eq=False)
class ComplexMode:
    """Frequency (Hz), generalised mass `x^T M x`, real and imaginary shapes, `x^T M d` (3,)."""

    frequency: complex
    mass: complex
    real: NodeField
    imaginary: NodeField
    along: tuple[complex, complex, complex]


def complex_modes(
    stiffness: Matrix, mass: Matrix, damping: Matrix | None, near: complex, count: int
) -> list[ComplexMode]:
    """The `count` modes whose complex frequencies are nearest to `near`, by real part.

    Near zero a mode and its mirror image (f, - conj f) both count.

    Raises
    ------
    KernelError
        If nothing can move or the search does not converge.
    """
    problem = _movable(stiffness, mass, damping)
    values, shapes = _eigenpairs(problem, 2j * np.pi * near, count)
    frequencies = values / (2j * np.pi)
    keep = np.argsort(np.abs(frequencies - near), kind="stable")[:count]
    keep = keep[np.argsort(frequencies[keep].real, kind="stable")]
    return [_mode(problem, complex(frequencies[k]), shapes[:, k]) for k in keep]


def _movable(stiffness: Matrix, mass: Matrix, damping: Matrix | None) -> ReducedProblem:
    """What the conditions leave, refused where that is nothing."""
    problem = reduced_problem(stiffness, mass, damping)
    if problem.size == 0:
        raise KernelError("kernel.modal.conditions-hold-every-unknown")
    return problem


def conjugate_modes(
    stiffness: Matrix, mass: Matrix, damping: Matrix | None, pairs: int | None = None
) -> list[ComplexMode]:
    """All complex modes, or the `pairs` couples of least modulus: each mode and its mirror image.

    Sorted by modulus, the positive real part of a couple first; shapes of Euclidean norm one.
    """
    problem = _movable(stiffness, mass, damping)
    values, shapes = _eigenpairs(problem, 0.0, problem.size)
    frequencies = values / (2j * np.pi)
    modulus = np.round(np.abs(frequencies) / np.abs(frequencies).max(initial=1e-300), 9)
    order = np.lexsort((-frequencies.real, modulus))
    keep = order if pairs is None else order[: 2 * pairs]
    return [_mode(problem, complex(frequencies[k]), shapes[:, k], True) for k in keep]


def _eigenpairs(
    problem: ReducedProblem, shift: complex, count: int
) -> tuple[ComplexArray, ComplexArray]:
    import scipy.linalg as la

    A, B = _linear(problem)
    r = problem.size
    wanted = 2 * count + 6
    if r <= DENSE or wanted >= A.shape[0] - 1:
        pairs = la.eig(A.toarray(), B.toarray(), homogeneous_eigvals=True)
        (top, bottom), vectors = pairs
        finite = np.abs(bottom) > 1e-13 * np.abs(top)
        return top[finite] / bottom[finite], vectors[:r, finite]
    from scipy.sparse.linalg import ArpackError, eigs

    moved = shift * (1.0 + 1e-6) + 1e-6j
    try:
        values, vectors = eigs(A.astype(complex), wanted, M=B.astype(complex), sigma=moved)
    except (ArpackError, RuntimeError) as problem_found:
        raise KernelError(
            "kernel.modal.search-modes-not-converge", problem_found=problem_found
        ) from None
    return values, vectors[:r]


def _linear(problem: ReducedProblem) -> tuple[sp.csc_array, sp.csc_array]:
    """A z = mu B z with z = (x, mu x, multipliers)."""
    r, m = problem.size, problem.S.shape[0]
    C = problem.C if problem.C is not None else sp.csr_array((r, r))
    identity = sp.eye_array(r, format="csr")
    if m == 0:
        A = sp.block_array([[None, identity], [-problem.K, -C]], format="csc")
        return sp.csc_array(A), sp.csc_array(sp.block_diag([identity, problem.M], format="csc"))
    A = sp.block_array(
        [
            [None, identity, None],
            [-problem.K, -C, -problem.S.T],
            [problem.S, None, sp.csr_array((m, m))],
        ],
        format="csc",
    )
    B = sp.block_diag([identity, problem.M, sp.csr_array((m, m))], format="csc")
    return sp.csc_array(A), sp.csc_array(B)


def _mode(
    problem: ReducedProblem, frequency: complex, q: ComplexArray, unit: bool = False
) -> ComplexMode:
    """A mode whose largest component is 1, or of Euclidean norm 1 with that component real."""
    x: ComplexArray = np.asarray(problem.T @ q)
    x = x / x[int(np.argmax(np.abs(x)))]
    if unit:
        x = x / np.linalg.norm(x)
    inertia: ComplexArray = np.asarray(problem.mass @ x)
    along = inertia @ unit_translations(problem.numbering)
    return ComplexMode(
        frequency,
        complex(x @ inertia),
        vector_to_field(x.real, problem.numbering),
        vector_to_field(x.imag, problem.numbering),
        (complex(along[0]), complex(along[1]), complex(along[2])),
    )
