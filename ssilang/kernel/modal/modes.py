"""Natural modes of a system: frequencies, shapes, generalised masses and displacements.

Complex modes of damped or unsymmetric systems: `(K + i w C - w^2 M) x = 0`, w = 2 pi f.

With mu = i w the problem is linear in (x, mu x); frequencies f are complex, a positive imaginary
part means decay. Real matrices give pairs (f, - conj f), both modes.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.scientific import la, sp, spla
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import Numbering, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.modal.basis import ReducedProblem, reduced_problem
from ssilang.kernel.modal.eigen import Pairs, between, nearest
from ssilang.kernel.solvers.factor import FIRST_FIT, Solver

ROUNDING = 1e-9
TRANSLATIONS = ({"UX", "UR"}, {"UY"}, {"UZ"})
FREE = 1e-14
"""Share of the terms of u K u, added as errors are, under which their sum is a free motion's."""


@dataclass(frozen=True, eq=False)
class Mode:
    """One real mode.

    Attributes
    ----------
    frequency : float
        In Hz; negative (sign of lambda) for an unstable system.
    mass : float
        Generalised mass `x^T M x`.
    shape : NodeField
        Largest displacement component 1, real or imaginary; with the multipliers LX.
    along : tuple of 3 floats
        Generalised displacements `x^T M d` for a unit translation d along X, Y, Z.
    moving : tuple of 3 floats
        Mass of the whole model along X, Y, Z that no support holds.
    """

    frequency: float
    mass: float
    shape: NodeField
    along: tuple[float, float, float]
    moving: tuple[float, ...] = (0.0, 0.0, 0.0)


def eigenvalue(frequency: float) -> float:
    """`lambda = (2 pi f)^2` with the sign of f."""
    return float(np.sign(frequency) * (2.0 * np.pi * frequency) ** 2)


def modes_near(
    stiffness: Matrix,
    mass: Matrix,
    wanted: Sequence[tuple[float, int]],
    solver: Solver = FIRST_FIT,
) -> list[Mode]:
    """For each (frequency, number): the modes nearest by the square of frequency; increasing.

    That is the order in which iterations on the inverse at the frequency find them.

    Raises
    ------
    KernelError
        If nothing can move, no mass moves, or the matrices are not symmetric.
    """
    problem = reduced_problem(stiffness, mass, solver=solver)
    found: list[Mode] = []
    for frequency, count in wanted:
        # a few more, so that none is missed
        pairs = nearest(problem, eigenvalue(frequency), count + 3)
        found += _modes(problem, Pairs(pairs.values[:count], pairs.shapes[:, :count]))
    return sorted(found, key=lambda m: m.frequency)


def modes_between(
    stiffness: Matrix,
    mass: Matrix,
    low: float,
    high: float,
    solver: Solver = FIRST_FIT,
) -> list[Mode]:
    """All modes of frequencies in [low, high] Hz, increasing; 0 is a free motion's."""
    problem = reduced_problem(stiffness, mass, solver=solver)
    found = _modes(problem, between(problem, eigenvalue(low), eigenvalue(high)))
    edge = ROUNDING * max(abs(low), abs(high))
    return [m for m in found if low - edge <= m.frequency <= high + edge]


def _modes(problem: ReducedProblem, pairs: Pairs) -> list[Mode]:
    directions = unit_translations(problem.numbering)
    squares, found = problem.stiffness.multiply(problem.stiffness), []
    free = directions * (abs(problem.T).sum(axis=1) > 0.0)[:, None]
    moving = tuple((free * (problem.mass @ free)).sum(axis=0).tolist())
    for value, q in zip(pairs.values, pairs.shapes.T, strict=True):
        u = problem.T @ q
        sizes = np.abs(u)
        u = u / float(u[np.argmax(sizes > (1.0 - 1e-9) * sizes.max())])
        inertia = problem.mass @ u
        multipliers = (problem.multipliers, problem.reactions(u, float(value)))
        shape = vector_to_field(u, problem.numbering, multipliers=multipliers)
        x, y, z = (float(inertia @ d) for d in directions.T)
        mass = float(inertia @ u)
        rounding = FREE * float(np.sqrt(u**2 @ (squares @ u**2))) / abs(mass or 1.0)
        frequency = float(np.sign(value) * np.sqrt(abs(value)) / (2.0 * np.pi))  # with its sign
        frequency = frequency if abs(value) > rounding else 0.0
        found.append(Mode(frequency, mass, shape, (x, y, z), moving))
    return found


def unit_translations(numbering: Numbering) -> FloatArray:
    """Unit translations (n, 3) along X, Y, Z (UR counts as X)."""
    directions = np.zeros((numbering.size, 3))
    for axis, names in enumerate(TRANSLATIONS):
        for name in names & set(numbering.unknowns):
            directions[numbering.where(name), axis] = 1.0
    return directions


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
    A, B = _linear(problem)
    r = problem.size
    wanted = 2 * count + 6
    if r <= DENSE or wanted >= A.shape[0] - 1:
        pairs = la.eig(A.toarray(), B.toarray(), homogeneous_eigvals=True)
        (top, bottom), vectors = pairs
        finite = np.abs(bottom) > 1e-13 * np.abs(top)
        return top[finite] / bottom[finite], vectors[:r, finite]

    moved = shift * (1.0 + 1e-6) + 1e-6j
    try:
        values, vectors = spla.eigs(A.astype(complex), wanted, M=B.astype(complex), sigma=moved)
    except (spla.ArpackError, RuntimeError) as problem_found:
        raise KernelError(
            "kernel.modal.search-modes-not-converge", problem_found=problem_found
        ) from None
    return values, vectors[:r]


def _linear(problem: ReducedProblem) -> tuple[sp.csc_array, sp.csc_array]:
    """A z = mu B z with z = (x, mu x, multipliers)."""
    r, m = problem.size, problem.S.shape[0]
    C = problem.C if problem.C is not None else sp.csr_array((r, r))
    identity = sp.eye_array(r, format="csr")
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
