"""Natural modes of a system: frequencies, shapes, generalised masses and displacements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import Numbering, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.modal.eigen import Pairs, between, nearest
from ssilang.kernel.modal.reduced import ReducedProblem, reduced_problem
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
        Largest displacement component 1; with the multipliers LX of the conditions.
    along : tuple of 3 floats
        Generalised displacements `x^T M d` for a unit translation d along X, Y, Z.
    """

    frequency: float
    mass: float
    shape: NodeField
    along: tuple[float, float, float]


def eigenvalue(frequency: float) -> float:
    """`lambda = (2 pi f)^2` with the sign of f."""
    return float(np.sign(frequency) * (2.0 * np.pi * frequency) ** 2)


def frequency_of(value: float) -> float:
    """Frequency of an eigenvalue, with its sign."""
    return float(np.sign(value) * np.sqrt(abs(value)) / (2.0 * np.pi))


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
    """All modes of frequencies in [low, high] Hz, increasing."""
    problem = reduced_problem(stiffness, mass, solver=solver)
    return _modes(problem, between(problem, eigenvalue(low), eigenvalue(high)))


def _modes(problem: ReducedProblem, pairs: Pairs) -> list[Mode]:
    directions = unit_translations(problem.numbering)
    squares, found = problem.stiffness.multiply(problem.stiffness), []
    for value, q in zip(pairs.values, pairs.shapes.T, strict=True):
        u = problem.T @ q
        u = u / largest_displacement(problem.numbering, u)
        inertia = problem.mass @ u
        multipliers = (problem.multipliers, problem.reactions(u, float(value)))
        shape = vector_to_field(u, problem.numbering, multipliers=multipliers)
        x, y, z = (float(inertia @ d) for d in directions.T)
        mass = float(inertia @ u)
        rounding = FREE * float(np.sqrt(u**2 @ (squares @ u**2))) / abs(mass or 1.0)
        frequency = frequency_of(value) if abs(value) > rounding else 0.0
        found.append(Mode(frequency, mass, shape, (x, y, z)))
    return found


def largest_displacement(numbering: Numbering, u: FloatArray) -> float:
    """The translation component of largest size, with its sign; any unknown's if none moves.

    Translations that are rounding beside the rotations (a shaft in torsion) do not count.
    """
    named = set().union(*TRANSLATIONS)
    codes = [c for c, name in enumerate(numbering.unknowns) if name in named]
    moved = np.where(np.isin(numbering.codes, codes), u, 0.0)
    if np.abs(moved).max(initial=0.0) <= ROUNDING * np.abs(u).max(initial=0.0):
        moved = u
    top = np.abs(moved).max()
    first = int(np.argmax(np.abs(moved) > (1.0 - 1e-9) * top))
    return float(moved[first])


def unit_translations(numbering: Numbering) -> FloatArray:
    """Unit translations (n, 3) along X, Y, Z (UR counts as X)."""
    directions = np.zeros((numbering.size, 3))
    for axis, names in enumerate(TRANSLATIONS):
        for name in names & set(numbering.unknowns):
            directions[numbering.where(name), axis] = 1.0
    return directions
