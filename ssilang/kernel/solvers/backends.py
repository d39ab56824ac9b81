"""Direct solvers of sparse systems behind one interface, chosen by what is installed and fits.

A backend factorises once and solves many times. `factorise` picks the first backend of
`BACKENDS` that is installed and takes the matrix; whoever adds one writes a class and a line.
PETSc, on as many machines as its command says, takes what a run hands to it by name, and what is
too large for the others.
"""

from __future__ import annotations

import importlib.util
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.memory import fits
from ssilang.kernel.base.scientific import sp, spla
from ssilang.kernel.solvers.factor import Factor, Ordering, Solver

if TYPE_CHECKING:
    from ssilang.kernel.solvers.multigrid.multigrid import MultigridFactor

DISSECTION = "nested dissection"
MULTIGRID = "multigrid"
PETSC = "PETSC"
DISSECTED = 8_000  # unknowns of a static problem from which nested dissection pays
LARGE = 20_000  # unknowns from which a threaded solver pays for its start
ONCE = 8e8
"""Bytes of a factor by dissection from which multigrid has solved before it is made (some 80 000
unknowns of a solid)."""
FACTOR, ITERATED = 3e-13, 4.5e-6
"""Seconds of a factor, for its bytes to the power 1.5, and what a solve by multigrid takes
more than one by a factor, for each unknown. Measured on solids of 10^5 to 10^6 unknowns."""
DISTRIBUTED = 1_000_000  # unknowns from which several machines are used where a run has them


class SuperLUFactor:
    """SciPy's SuperLU: symmetric mode without pivoting if `positive`, else partial pivoting."""

    name = "SuperLU"

    def __init__(self, A: sp.csr_array, positive: bool) -> None:
        options: dict[str, Any] = {"permc_spec": "COLAMD"}
        if positive:
            options = {
                "permc_spec": "MMD_AT_PLUS_A",
                "diag_pivot_thresh": 0.0,
                "options": {"SymmetricMode": True},
            }
        try:
            self.lu = spla.splu(sp.csc_array(A), **options)
        except RuntimeError as error:
            raise SingularFactorError(str(error)) from None

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b."""
        return self.lu.solve(np.ascontiguousarray(b.T).T if b.ndim == 2 else b)

    def negative_pivots(self) -> int:
        """Number of negative eigenvalues of a symmetric A (Sylvester), if no row was swapped.

        Raises
        ------
        SingularFactorError
            If rows were swapped, so that the signs of the pivots say nothing.
        """
        if not np.array_equal(self.lu.perm_r, self.lu.perm_c):
            raise SingularFactorError("rows were swapped")
        return int(np.sum(self.lu.U.diagonal() < 0.0))


class PardisoFactor:
    """Intel MKL's PARDISO by pypardiso: LL^T if `positive`, else LU with scaling and matching."""

    name = "PARDISO"

    def __init__(self, A: sp.csr_array, positive: bool) -> None:
        from pypardiso import PyPardisoSolver

        self._solver = PyPardisoSolver(mtype=2 if positive else 11)
        self._matrix = sp.csr_matrix(sp.triu(A) if positive else A)
        self._matrix.sort_indices()
        try:
            self._solver.factorize(self._matrix)
        except Exception as error:
            raise SingularFactorError(str(error)) from None

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b."""
        self._solver.set_phase(33)
        return self._solver._call_pardiso(self._matrix, np.asfortranarray(b))


@dataclass(frozen=True)
class Backend:
    """A solver: what makes it, the package it needs, how to get that, when it is chosen."""

    make: Callable[[sp.csr_array, bool], Factor]
    package: str
    remedy: str
    least: int = 0  # unknowns from which it is chosen

    @property
    def installed(self) -> bool:
        """True if its package can be imported."""
        return importlib.util.find_spec(self.package) is not None


BACKENDS: dict[str, Backend] = {
    "PARDISO": Backend(PardisoFactor, "pypardiso", "pip install 'ssilang[pardiso]'", LARGE),
    "SuperLU": Backend(SuperLUFactor, "scipy", "pip install scipy"),
}


def dissection_pays(n: int) -> bool:
    """Whether a positive matrix of n unknowns with coordinates is best factorised by dissection.

    Below, loading its compiled code costs more than SuperLU; PARDISO's threads factorise large
    ones faster where it is installed.
    """
    return n >= DISSECTED and choose(n) != "PARDISO"


def goes_to_petsc(solver: Solver, n: int) -> bool:
    """Whether a system of n unknowns is PETSc's: by name, or by size where a run has a server."""
    return solver.name == PETSC or (
        solver.name is None and solver.petsc is not None and n >= DISTRIBUTED
    )


def choose(n: int) -> str:
    """Name of the backend for n unknowns."""
    return next(k for k, b in BACKENDS.items() if n >= b.least and b.installed)


_kept: OrderedDict[bytes, Factor] = OrderedDict()
_keeping = 0


def keep_factors(count: int) -> None:
    """Keep the last `count` factors of this process for matrices that come back (0: none).

    For processes that run one script after another on the same model; a factor is found by the
    content of its matrix.
    """
    global _keeping
    _keeping = count
    while len(_kept) > count:
        _kept.popitem(last=False)


def _content(
    A: sp.csr_array, name: str, positive: bool, ordering: Ordering | None, tolerance: object
) -> bytes:
    import hashlib

    once = ordering is not None and ordering.once
    digest = hashlib.blake2b(f"{name} {positive} {A.shape} {once} {tolerance}".encode())
    parts = (A.indptr, A.indices, A.data)
    for part in parts if ordering is None else (*parts, ordering.points, ordering.last):
        digest.update(np.ascontiguousarray(part).tobytes())
    return digest.digest()


def factorise(
    A: sp.csr_array,
    positive: bool,
    solver: Solver | str | None = None,
    ordering: Ordering | None = None,
) -> Factor:
    """Factorise A (n, n), symmetric positive if `positive` (else any).

    Parameters
    ----------
    solver : Solver, str or None
        The one asked for, by its name or with the server of PETSc that the run has.
    ordering : Ordering or None
        Given for a positive matrix, and if no solver is asked for, it is factorised by nested
        dissection.

    Raises
    ------
    SingularFactorError
        If a pivot is exactly zero, or not positive by nested dissection.
    KernelError
        If the solver asked for is not installed.
    """
    asked = Solver.of(solver)
    if goes_to_petsc(asked, A.shape[0]):
        return _by_petsc(A, positive, asked, ordering)
    dissected = ordering is not None and positive and asked.name in (None, DISSECTION)
    name = DISSECTION if dissected else asked.name or choose(A.shape[0])
    backend = BACKENDS.get(name)
    if backend is None and not dissected and name != MULTIGRID:
        known = (*BACKENDS, MULTIGRID)
        raise KernelError("kernel.solvers.no-solver-called", name=name, backends=known)
    if backend is not None and not backend.installed:
        raise KernelError(
            "kernel.solvers.not-installed",
            name=name,
            package=backend.package,
            remedy=backend.remedy,
        )

    def make() -> Factor:
        if dissected and ordering is not None:
            return _dissected(A, ordering, asked)
        if name == MULTIGRID:
            return _by_multigrid(A, positive, ordering, asked)
        return BACKENDS[name].make(A, positive)

    if not _keeping:
        return make()
    key = _content(A, name, positive, ordering, asked.tolerance)
    if key not in _kept:
        _kept[key] = make()
    _kept.move_to_end(key)
    keep_factors(_keeping)
    return _kept[key]


def _by_petsc(A: sp.csr_array, positive: bool, asked: Solver, ordering: Ordering | None) -> Factor:
    """A factor on the run's server, which ends with the run: no process keeps it."""
    if asked.petsc is None:
        raise KernelError("kernel.solvers.petsc-no-command")
    return asked.petsc.factorise(A, positive, None if ordering is None else ordering.rigid)


def _by_multigrid(
    A: sp.csr_array, positive: bool, ordering: Ordering | None, asked: Solver
) -> MultigridFactor:
    from ssilang.kernel.solvers.multigrid.multigrid import MultigridFactor

    if ordering is None:
        return MultigridFactor(A, positive, tolerance=asked.tolerance)
    return MultigridFactor(A, positive, ordering.rigid, ordering.nodes, asked.tolerance)


def factor_pays(A: sp.csr_array, ordering: Ordering, solves: int) -> bool:
    """Whether a positive A (n, n) that is solved so often is better factorised than iterated on."""
    if not dissection_pays(A.shape[0]):
        return True
    from ssilang.kernel.solvers.cholesky.dissection import dissection
    from ssilang.kernel.solvers.cholesky.multifrontal import factor_bytes

    needed = factor_bytes(A, dissection(A, ordering.points, ordering.last))
    return fits(needed) and FACTOR * needed**1.5 < ITERATED * A.shape[0] * solves


def _dissected(A: sp.csr_array, ordering: Ordering, asked: Solver) -> Factor:
    from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
    from ssilang.kernel.solvers.cholesky.multifrontal import NotPositiveError, TooLargeError

    limit = ONCE if ordering.once and asked.name is None else np.inf
    for most in (limit, np.inf):
        try:
            return DissectedFactor(A, ordering.points, ordering.last, most)
        except NotPositiveError as error:
            raise SingularFactorError(str(error)) from None
        except TooLargeError as error:
            chosen = error.fits
        if not chosen and asked.petsc is not None:
            return _by_petsc(A, True, asked, ordering)
        found = _by_multigrid(A, True, ordering, asked)
        if not chosen or found.converges():  # else the factor: memory holds it
            return found
    raise AssertionError
