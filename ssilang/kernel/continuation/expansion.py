"""Matrices of motions made matrices of Fourier coefficients, with names of their own.

Unknown i of a node (of c) becomes U i for the mean, U (k c + i) for cos k and V (k c + i) for
sin k; forces F and G. `Z(w) = K + w C + w^2 M` of the expanded matrices.

The problem of harmonic balance on expanded matrices, nonlinear forces given by samples.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.continuation.harmonics import Basis, derivative_matrix
from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations
from ssilang.kernel.stepping.problem.loading import Loading

MOST = 6
ORDER = ("UX", "UY", "UZ", "UR", "UT", "RX", "RY", "RZ", "RT")


@dataclass(frozen=True)
class Names:
    """Unknowns of the motion, their duals, and the number of harmonics."""

    unknowns: tuple[str, ...]
    duals: tuple[str, ...]
    harmonics: int

    @property
    def places(self) -> int:
        """Coefficients of an unknown."""
        return 2 * self.harmonics + 1

    def coefficient(self, unknown: str, place: int, dual: bool = False) -> str:
        """Name of a coefficient; place 0 is the mean, 2 k - 1 cos k, 2 k sin k.

        Raises
        ------
        KernelError
            For an unknown that no matrix has.
        """
        if unknown not in self.unknowns:
            told = {"unknown": unknown, "unknowns": self.unknowns}
            raise KernelError("kernel.continuation.support-of-no-unknown", **told)
        own = self.unknowns.index(unknown) + 1
        letters = "FG" if dual else "UV"
        sine = place > 0 and place % 2 == 0
        return f"{letters[sine]}{(place + 1) // 2 * len(self.unknowns) + own}"


def names_of(matrices: Sequence[Matrix], harmonics: int) -> Names:
    """Unknowns of matrices: displacements, rotations, then others by name.

    Raises
    ------
    KernelError
        For more than six unknowns a node.
    """
    pairs: dict[str, str] = {}
    for matrix in matrices:
        for block in matrix.blocks:
            pairs |= dict(zip(block.unknowns, block.duals, strict=True))
    if not pairs:
        raise KernelError("kernel.continuation.matrices-no-unknowns")
    if len(pairs) > MOST:
        raise KernelError(
            "kernel.continuation.harmonic-balance-takes-unknowns", most=MOST, pairs=pairs
        )
    order = sorted(pairs, key=lambda u: (ORDER.index(u) if u in ORDER else len(ORDER), u))
    return Names(tuple(order), tuple(pairs[u] for u in order), harmonics)


def expanded(matrix: Matrix, names: Names, terms: FloatArray) -> Matrix:
    """The matrix whose coefficients i and j are coupled by `terms[i, j]` times the given one.

    Where one of two coefficients acts on the other, so does the other on it.
    """
    blocks = []
    for block in matrix.blocks:
        for i, j in zip(*np.nonzero(np.triu(terms)), strict=True):
            blocks.append(_coupled(block, names, int(i), int(j), terms))
    relations = tuple(
        _renamed(r, names, place) for r in matrix.relations for place in range(names.places)
    )
    return Matrix(matrix.table, tuple(blocks), relations, matrix.kind)


def _coupled(
    block: ElementMatrices, names: Names, i: int, j: int, terms: FloatArray
) -> ElementMatrices:
    primal, dual = (
        [tuple(names.coefficient(u, place, d) for u in block.unknowns) for place in (i, j)]
        for d in (False, True)
    )
    if i == j:
        values = terms[i, i] * block.values
        return replace(block, unknowns=primal[0], duals=dual[0], values=values, zone=None)
    zero = np.zeros_like(block.values)
    values = np.block([[zero, terms[i, j] * block.values], [terms[j, i] * block.values, zero]])
    return replace(
        block,
        local=np.concatenate([block.local, block.local]),
        unknowns=(*primal[0], *primal[1]),
        duals=(*dual[0], *dual[1]),
        values=values,
        zone=None,
        symmetric=bool(terms[i, j] == terms[j, i]) and block.symmetric,
    )


def _renamed(rows: Relations, names: Names, place: int) -> Relations:
    if rows.sense.any() or rows.dual is not None:
        raise KernelError("kernel.continuation.harmonic-balance-takes-plain")
    nodes: IntArray = rows.table.add(rows.table.coordinates[rows.multipliers].copy())
    unknowns = tuple(names.coefficient(u, place) for u in rows.unknowns)
    return replace(rows, unknowns=unknowns, raw_multipliers=nodes)


def stiffness_terms(harmonics: int) -> FloatArray:
    """K on each coefficient."""
    return np.eye(2 * harmonics + 1)


def damping_terms(harmonics: int) -> FloatArray:
    """C on cosine and sine, for w = 1."""
    return derivative_matrix(harmonics)


def mass_terms(harmonics: int) -> FloatArray:
    """- k^2 M, for w = 1."""
    D = derivative_matrix(harmonics)
    return np.asarray(D @ D)


Samples = Callable[[FloatArray, float], tuple[FloatArray, FloatArray]]
"""Forces (N, m) and the derivatives of -f (N, m, m) at motions (N, m) of a few unknowns, and t."""
CURVE_STEP = 1e-6


@dataclass(eq=False)
class FrequencyProblem:
    """`Z(w(t)) U - F_nl(U) - F(t) = 0` on the coefficients U = T q that supports leave."""

    numbering: Numbering
    K: sp.csr_array  # (n, n) `Z = K + w C + w^2 M`
    C: sp.csr_array
    M: sp.csr_array
    T: sp.csr_array  # (n, r)
    loading: Loading  # F in pseudo-time
    frequency: Callable[[float], float]  # w of t
    basis: Basis
    # (2 H + 1, m) where the coefficients of the unknowns with nonlinear forces stand in U
    places: IntArray
    samples: Samples | None = None
    timed: bool = False  # the samples change with t
    size: float = 0.0
    parts: tuple[FloatArray, FloatArray, FloatArray] = field(init=False)

    def __post_init__(self) -> None:
        T = self.T
        K, C, M = (np.asarray((T.T @ A @ T).toarray()) for A in (self.K, self.C, self.M))
        self.parts = (K, C, M)

    def load(self, t: float) -> FloatArray:
        """F at t on the motions that supports leave (r,)."""
        return self.T.T @ (self.loading.forces @ self.loading.at(np.array([t]))[0])

    def at(self, u: FloatArray, t: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residual and derivatives in q (r,) and t."""
        K, C, M = self.parts
        w = self.frequency(t)
        Z = K + w * C + w * w * M
        h = CURVE_STEP * max(abs(t), 1e-3)
        load, load_rate = self.load(t), (self.load(t + h) - self.load(t - h)) / (2 * h)
        rate = (self.frequency(t + h) - self.frequency(t - h)) / (2 * h)
        linear = Z @ u
        R, J = linear - load, Z
        if self.samples is not None:
            force, tangent = self._nonlinear(u, t)
            R, J = R - force, Z + tangent
            if self.timed:
                load_rate = load_rate + (self._nonlinear(u, t + h)[0] - force) / h
        self.size = max(float(np.linalg.norm(load)), float(np.linalg.norm(linear)))
        return R, J, rate * ((C + 2 * w * M) @ u) - load_rate

    def coefficients(self, u: FloatArray) -> FloatArray:
        """Coefficients (2 H + 1, m) of the unknowns with nonlinear forces."""
        return np.asarray((self.T @ u)[self.places])

    def sampled(self, u: FloatArray, t: float) -> tuple[FloatArray, FloatArray]:
        """Forces and stiffnesses at the instants of the basis."""
        assert self.samples is not None
        return self.samples(self.basis.values @ self.coefficients(u), t)

    def _nonlinear(self, u: FloatArray, t: float) -> tuple[FloatArray, FloatArray]:
        f, k = self.sampled(u, t)
        b, n = self.basis, self.T.shape[0]
        force = np.zeros(n)
        np.add.at(force, self.places, b.back @ f)
        block = np.einsum("at,tij,tb->aibj", b.back, k, b.values, optimize=True)
        at = self.places.ravel()
        rows, columns = np.repeat(at, len(at)), np.tile(at, len(at))
        tangent = sp.csr_array((block.ravel(), (rows, columns)), shape=(n, n))
        return self.T.T @ force, np.asarray((self.T.T @ tangent @ self.T).toarray())

    def force(self, t: float) -> float:
        """Size of the forces of the last residual."""
        return self.size
