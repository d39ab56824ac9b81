"""Matrices on real and imaginary parts of harmonic motions (IMPE): unknowns UX and IUX ..."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations, imaginary

Factors = tuple[float, float, float, float]


def factors(kind: str, pulsation: float) -> Factors:
    """Factors of the blocks (real-real, real-imaginary, imaginary-real, imaginary-imaginary).

    For a motion `u exp(i w t)`: a stiffness counts as it is, a mass as `- w^2 M`, a damping as
    `i w C`.
    """
    w = pulsation
    table: dict[str, Factors] = {
        "RAIDEUR": (1.0, 0.0, 0.0, 1.0),
        "MASSE": (-w * w, 0.0, 0.0, -w * w),
        "AMORTISSEMENT": (0.0, -w, w, 0.0),
    }
    return table[kind]


def impedance(
    matrix: Matrix, by: Factors, kind: str, other: Matrix | None = None, turned: bool = False
) -> Matrix:
    """`[a A, b A; c B, d B]` on real and imaginary unknowns, B = A if `other` is not given.

    Conditions are said of both parts, each with multipliers of its own. The columns of UT change
    their sign where `turned`, as those of two dampings do, of the symmetric and the antisymmetric
    unknowns of a Fourier harmonic.

    Raises
    ------
    KernelError
        If the matrix holds conditions and the blocks are not those of a stiffness.
    """
    second = other or matrix
    a, b, c, d = by
    if (matrix.relations or second.relations) and by != (1.0, 0.0, 0.0, 1.0):
        raise KernelError("kernel.matrices.conditions-only-doubled-raideur")
    blocks = [_doubled(e, ((a, b), (0.0, 0.0)), turned) for e in matrix.blocks if a or b]
    blocks += [_doubled(e, ((0.0, 0.0), (c, d)), turned) for e in second.blocks if c or d]
    relations = [*matrix.relations, *(_imaginary_rows(r) for r in second.relations)]
    return Matrix(matrix.table, tuple(blocks), tuple(relations), kind)


def _doubled(
    block: ElementMatrices, by: Sequence[Sequence[float]], turned: bool
) -> ElementMatrices:
    """Kronecker product of a 2 x 2 pattern and the element matrices, on doubled unknowns.

    The columns of UT change their sign first where `turned`.
    """
    pattern = np.array(by)
    single = block.values
    if turned:
        single = single * np.where(np.array(block.unknowns) == "UT", -1.0, 1.0)
    values = np.concatenate(
        [np.concatenate([f * single for f in row], axis=2) for row in pattern], axis=1
    )
    return replace(
        block,
        local=np.concatenate([block.local, block.local]),
        unknowns=(*block.unknowns, *(imaginary(u) for u in block.unknowns)),
        duals=(*block.duals, *(imaginary(d) for d in block.duals)),
        values=values,
        zone=None,
        symmetric=block.symmetric and pattern[0, 1] == pattern[1, 0],
    )


def _imaginary_rows(part: Relations) -> Relations:
    nodes = part.table.add(part.table.coordinates[part.multipliers].copy())
    return replace(
        part,
        unknowns=tuple(imaginary(u) for u in part.unknowns),
        raw_multipliers=nodes,
        dual=None
        if part.dual is None
        else replace(_imaginary_rows(part.dual), raw_multipliers=nodes),
    )
