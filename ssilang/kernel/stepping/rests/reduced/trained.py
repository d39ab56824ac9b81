"""Bases trained by whole runs: proper orthogonal decomposition of the displacements of records.

What whole runs of some records displaced spans what other records displace, on the same model and
step. Vectors are those of the snapshots that hold most of the energy of the stiffness with closed
joints (Sirovich 1987, method of snapshots); those of earlier records go into the next
decomposition with their weights, so that a basis learns from every record that was run whole.
"""

import math
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.cholesky.inverse import invert
from ssilang.kernel.stepping.effective import effective_matrix, ordering_of
from ssilang.kernel.stepping.keeping import digest
from ssilang.kernel.stepping.problem.problem import Problem, closed_stiffness
from ssilang.kernel.stepping.rests.reduced.basis import (
    HIGHEST_SHIFT,
    Basis,
    NoReduction,
    on_motions,
)
from ssilang.kernel.stepping.snapshot import Receiver, Snapshot
from ssilang.kernel.stepping.times import SAME

FEWEST = 2  # records that train a basis
VECTORS = 400
EVERY, MOST_SNAPSHOTS = 2, 512  # steps to the next displacement of a record, how many
ROUNDING = 1e-12  # energy of a vector, of the largest
ANSWERS = 64  # of a round
ROUNDS = 10  # of answers that a basis may hold
START = 3  # vectors of the start of a motion


@dataclass(frozen=True, eq=False)
class Training:
    """What whole runs have taught."""

    model: str  # digest of mesh, matrices and joints
    dt: float
    taught: tuple[str, ...]  # digests of the records that trained it
    # (r, n_y) on the motions y that the supports leave; the square of their length is their energy
    vectors: FloatArray
    answers: FloatArray  # (s, n_y) what reduced runs missed


class Shelf(Protocol):
    """Where a training stands."""

    @property
    def name(self) -> str:
        """As messages call it."""

    def stamp(self) -> str:
        """Another one for each state of what stands there."""

    def read(self) -> Training | None:
        """What stands there, None for nothing."""

    def held(self) -> AbstractContextManager[None]:
        """Nobody else writes meanwhile."""

    def write(self, training: Training) -> None:
        """Put it in the place of what stands there."""


class TrainedBasis(Basis):
    """The vectors of a training, and what a motion needs beside them."""

    trained = True

    def __init__(self, problem: Problem, training: Training) -> None:
        own, known = len(training.vectors), len(training.answers)
        largest = own + max(known, ROUNDS * ANSWERS) + ANSWERS + START
        self._project(problem, largest)
        self._make_room(largest, HIGHEST_SHIFT * 2.0 / training.dt)
        self._add(np.vstack([training.vectors, training.answers]).T)
        self._fixed, self.records = self.size, len(training.taught)
        A = sp.csr_array(self.T.T @ effective_matrix(problem, training.dt) @ self.T)
        order = ordering_of(problem, sp.csc_array((A.shape[0], 0)))
        self._step = invert(A, True, problem.solver, order)

    def meet(self, problem: Problem) -> None:
        """Take the loads and the start of a motion, nothing of the one before."""
        super().meet(problem)
        self.size = self._fixed
        self._add(self._start[:, self._start.any(axis=0)])

    @property
    def room(self) -> int:
        """Vectors that there may be besides."""
        return len(self._store) - self.size

    def answers(self, left: FloatArray) -> FloatArray:
        """The step's answers (n_y, k) to what is out of balance (n, k)."""
        return self._step.solve(self.T.T @ left)

    def take(self, answers: FloatArray) -> None:
        """Add answers to the vectors.

        Raises
        ------
        NoReduction
            If there is no room for them.
        """
        if answers.shape[1] > self.room:
            raise self.inexact()
        self._add(answers)

    def inexact(self) -> NoReduction:
        """Why a record has to run whole."""
        return NoReduction("kernel.stepping.training-inexact", records=self.records)

    def learn(self, model: str, shelf: Shelf) -> None:
        """Keep the answers, here and on the shelf, for the records to come."""
        new = self.vectors[self._fixed :]
        with shelf.held():
            found = shelf.read()
            if (
                found is None
                or found.model != model
                or len(new) + len(found.answers) > ROUNDS * ANSWERS
            ):
                return
            shelf.write(replace(found, answers=np.vstack([found.answers, new])))
            self._fixed = self.size
            _LAST.clear()
            _LAST[f"{model} {shelf.stamp()}"] = self


_LAST: dict[str, TrainedBasis] = {}


def trained_basis(problem: Problem, model: str, shelf: Shelf) -> TrainedBasis:
    """The basis that stands on a shelf, ready for a motion; kept for the next one.

    Raises
    ------
    NoReduction
        If too few records have trained it.
    KernelError
        If it belongs to another model or step.
    """
    key = f"{model} {shelf.stamp()}"
    if key not in _LAST:
        found = read_for(problem, model, shelf)
        records = 0 if found is None else len(found.taught)
        if found is None or records < FEWEST:
            raise NoReduction("kernel.stepping.in-training", records=records, fewest=FEWEST)
        _LAST.clear()
        _LAST[key] = TrainedBasis(problem, found)
    _LAST[key].meet(problem)
    return _LAST[key]


def read_for(problem: Problem, model: str, shelf: Shelf) -> Training | None:
    """What a shelf holds for a model."""
    found, steps = shelf.read(), np.diff(problem.times)
    if found is not None and found.model != model:
        raise KernelError("kernel.stepping.trained-on-another-model", name=shelf.name)
    dt = float(steps[0]) if found is None else found.dt
    if np.abs(steps - dt).max() > SAME * dt * len(steps):
        code = "kernel.stepping.trained-on-another-step"
        raise KernelError(code, name=shelf.name, dt=dt, step=float(steps[-1]))
    for part in () if found is None else (found.vectors, found.answers):
        if part.shape[1] != problem.constraints.T.shape[1]:
            raise KernelError("io.damaged", name=shelf.name, error=f"vectors {part.shape}")
    return found


class Learner(Receiver):
    """An observer of a whole run, whose displacements train."""

    def __init__(self, problem: Problem) -> None:
        n = len(problem.times)
        self.wanted = np.zeros(n, bool)
        self.wanted[:: max(EVERY, math.ceil(n / MOST_SNAPSHOTS))] = True
        self.problem, self.columns = problem, list[FloatArray]()

    def receive(self, snapshot: Snapshot) -> None:
        """Take a displacement."""
        self.columns.append(snapshot.u.copy())

    def teach(self, model: str, shelf: Shelf) -> None:
        """Train what stands on the shelf by the run."""
        with shelf.held():
            self._teach(model, shelf)

    def _teach(self, model: str, shelf: Shelf) -> None:
        p, old = self.problem, read_for(self.problem, model, shelf)
        record = digest([], [p.loading.forces, p.loading.at(p.times), p.u, p.v])
        Y = on_motions(p.constraints.T, np.array(self.columns).T).T
        taught = () if old is None else old.taught
        if record in taught:
            return
        Y = Y if old is None else np.vstack([old.vectors, Y])
        gram = Y @ (closed_stiffness(p) @ Y.T)
        values, mixed = np.linalg.eigh(0.5 * (gram + gram.T))
        kept = np.flatnonzero(values > ROUNDING * values[-1])[-VECTORS:]
        dt = float(p.times[1] - p.times[0])
        answers = np.zeros((0, Y.shape[1])) if old is None else old.answers
        shelf.write(Training(model, dt, (*taught, record), mixed[:, kept].T @ Y, answers))
