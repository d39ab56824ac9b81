"""Calculations whose state is kept on their way, so that a later run goes on from there.

A state is a dictionary of numbers, words and arrays, and of lists and dictionaries of them: what a
file can hold. Going on leads to the last bit of an undisturbed run. The steps of a kept calculation
are cut at instants that depend on the calculation alone, never on the clock: loops that evaluate
something anew at the start of some steps do so at the same instants. What loops and solvers carry
from some steps to the next beside the motion (tangents that are factorised, closed rows,
coordinates) goes with the state: a class names these attributes in `remembered`.
"""

import hashlib
import time as clock
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import fields, is_dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.errors import KernelError, LostSolverError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.problem.problem import Problem

State = dict[str, Any]


class Keeper(Protocol):
    """Keeps the state of one calculation."""

    def stride(self, done: int, unknowns: int) -> int:
        """Steps after `done` up to the next instant at which the state may be kept."""

    def steady(self, done: int, state: Callable[[], State]) -> AbstractContextManager[None]:
        """While steps change the state an interruption waits."""

    def reached(self, done: int, state: Callable[[], State]) -> None:
        """Steps are done: keep their state if it is time to.

        Raises
        ------
        KeyboardInterrupt
            If the run was told to end.
        """

    def left(self, done: int, state: Callable[[], State]) -> None:
        """The calculation ends early, and whole: keep its state."""

    def lost(self, done: int, state: Callable[[], State]) -> None:
        """The solver's program has ended, if it did so within steps, these are not done."""

    def finished(self, done: int, state: Callable[[], State]) -> None:
        """All steps are done."""

    def last(self) -> State | None:
        """The state that an earlier run kept of this calculation, None without."""


class Cut:
    """Cuts steps where a keeper does, and keeps nothing: the same steps once more."""

    def __init__(self, every: int = 0) -> None:
        self.every = every

    def stride(self, done: int, unknowns: int) -> int:
        """Steps up to the next cut."""
        return stride_of(done, unknowns, self.every)

    def steady(self, done: int, state: Callable[[], State]) -> AbstractContextManager[None]:
        """Nothing waits."""
        return nullcontext()

    def reached(self, done: int, state: Callable[[], State]) -> None:
        """Nothing is kept."""

    left = lost = finished = reached

    def last(self) -> State | None:
        """Nothing was kept."""
        return None


def stride_of(done: int, unknowns: int, every: int = 0) -> int:
    """Steps up to the next multiple of `every` (0: none) or of the problem's own stride.

    That one is a power of two: a second of steps or so, 4096 with 1000 unknowns, 64 with 50 000,
    one with 300 000; as long as it lasts, progress and an interruption wait.
    """
    bits = unknowns.bit_length()
    own = 1 << max(min(12, 22 - bits, 38 - 2 * bits), 0)
    return min(n - done % n for n in (own, every) if n)


UNKEPT = Cut()
"""The keeper of calculations of which nothing is kept."""


@contextmanager
def told_to_leave(
    keeper: Keeper, done: Callable[[], int], state: Callable[[], State]
) -> Iterator[None]:
    """Steps that may be ended: the keeper gets the state in which they are."""
    try:
        yield
    except LostSolverError:
        keeper.lost(done(), state)
        raise
    except KeyboardInterrupt:
        keeper.left(done(), state)
        raise


# ---- records of arrays ------------------------------------------------------------------------


def leaves(value: Any) -> list[Any]:
    """Copies of the arrays, and the numbers, of nested tuples and data classes, in order."""
    return [x.copy() if isinstance(x, np.ndarray) else x for x in _leaves(value)]


def _leaves(value: Any) -> Iterator[Any]:
    if isinstance(value, tuple):
        for part in value:
            yield from _leaves(part)
    elif is_dataclass(value):
        for f in fields(value):
            yield from _leaves(getattr(value, f.name))
    else:
        yield value


def put_back(record: Any, values: Sequence[Any]) -> None:
    """The arrays of a record become those of `leaves`, in place."""
    for array, value in zip(_leaves(record), values, strict=True):
        if isinstance(array, np.ndarray):
            array[...] = _fitting(value, array)


def take_over(motion: Any, values: Sequence[Any]) -> None:
    """A motion becomes that of `leaves` of a file, whose numbers are all there."""
    put_back(motion, values)
    if any(np.isnan(array).any() for array in _leaves(motion) if isinstance(array, np.ndarray)):
        raise ValueError("NaN")


def rebuilt(like: Any, values: Sequence[Any]) -> Any:
    """A record of the shape of another one with the values of `leaves`."""
    source = iter(values)
    made = _rebuilt(like, source)
    assert next(source, None) is None
    return made


def _rebuilt(like: Any, values: Iterator[Any]) -> Any:
    if isinstance(like, tuple):
        parts = [_rebuilt(part, values) for part in like]
        return type(like)(*parts) if hasattr(like, "_fields") else tuple(parts)
    if is_dataclass(like) and not isinstance(like, type):
        return replace(
            like, **{f.name: _rebuilt(getattr(like, f.name), values) for f in fields(like)}
        )
    return next(values)


# ---- what loops and solvers remember -----------------------------------------------------------


def memory(owner: Any) -> Any:
    """What an object goes on with, by its class: the attributes of `remembered`."""
    if hasattr(owner, "memory"):
        return owner.memory()
    return {name: _memory(getattr(owner, name)) for name in getattr(owner, "remembered", ())}


def _memory(value: Any) -> Any:
    if value is None or isinstance(value, np.ndarray):
        return None if value is None else value.copy()
    return leaves(value) if isinstance(value, tuple) else memory(value)


def recall(owner: Any, kept: Any) -> None:
    """Give an object back what it remembered."""
    if hasattr(owner, "recall"):
        owner.recall(kept)
        return
    for name in getattr(owner, "remembered", ()):  # and no other name that a file may hold
        now, value = getattr(owner, name), kept[name]
        if isinstance(now, tuple):
            put_back(now, value)
        elif isinstance(value, dict):
            recall(now, value)
        else:
            setattr(owner, name, None if value is None else _fitting(value, now).copy())


def _fitting(value: Any, like: Any) -> NDArray[Any]:
    """An array of a file that stands for another one: of its shape and kind of numbers.

    One that begins with no rows (cells that have yielded, past steps) has any number of them.

    Raises
    ------
    ValueError
        If it is none: compiled loops look at no sizes.
    """
    sizes = np.shape(like if like is not None else value)
    if sizes[:1] == (0,):
        sizes = (*np.shape(value)[:1], *sizes[1:])
    if not isinstance(value, np.ndarray) or value.dtype.kind not in "biuf" or value.shape != sizes:
        raise ValueError(f"{np.shape(value)}, {sizes}")
    return value


@contextmanager
def fitting() -> Iterator[None]:
    """What an earlier run kept is taken over meanwhile.

    Raises
    ------
    KernelError
        If it is not what this calculation keeps.
    """
    try:
        yield
    except (LookupError, ValueError, TypeError, AttributeError, OverflowError) as error:
        raise KernelError("kernel.stepping.kept-does-not-fit", error=str(error)) from error


# ---- calculations that step in Python ------------------------------------------------------------


class KeptSteps:
    """Steps of a calculation whose state is its motion, what its solver remembers, and `more`.

    Attributes
    ----------
    done : int
        Steps that are done.
    """

    def __init__(
        self, keeper: Keeper | None, history: Any, motion: Any, solver: Any, more: Any = None
    ) -> None:
        self.keeper = UNKEPT if keeper is None else keeper
        self.history, self.motion = history, motion
        self.solver, self.more, self.done = solver, more, 0
        self._started = clock.perf_counter()

    def go_on(self) -> bool:
        """Take over the state that an earlier run kept; False if there is none."""
        if (kept := self.keeper.last()) is None:
            return False
        with fitting():
            self.done, h = len(kept["energies"]) - 1, self.history
            take_over(self.motion, kept["motion"])
            h.energies[: self.done + 1] = kept["energies"]
            h.iterations, h.seconds = kept["iterations"], kept["seconds"]
            if self.more is not None:
                recall(self.more, kept["more"])
            recall(self.solver, kept["remembers"])
        return True

    def state(self) -> State:
        """What the steps to come depend on."""
        return {
            "motion": leaves(self.motion),
            "energies": self.history.energies[: self.done + 1],
            "iterations": self.history.iterations,
            "seconds": self.history.seconds + clock.perf_counter() - self._started,
            "remembers": memory(self.solver),
            "more": None if self.more is None else memory(self.more),
        }

    @contextmanager
    def going(self) -> Iterator[None]:
        """All steps that are left."""
        with told_to_leave(self.keeper, lambda: self.done, self.state):
            yield
        self.keeper.finished(self.done, self.state)

    @contextmanager
    def step(self, k: int) -> Iterator[None]:
        """The step that ends at time k."""
        with self.keeper.steady(self.done, self.state):
            yield
            self.done = k

    def reached(self) -> None:
        """A step is done and told of: the state may be kept."""
        if self.done < len(self.history.times) - 1:
            self.keeper.reached(self.done, self.state)


# What tells one problem from another: a digest of its numbers.


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
    stops = list(_leaves(p.contact)) if p.contact else []
    matrices = [p.K, p.M, p.C, p.constraints.C, p.constraints.D, p.constraints.T]
    matrices += [x for x in stops if isinstance(x, sp.csr_array)]
    arrays: list[NDArray[Any]] = [
        p.numbering.nodes, p.numbering.codes, p.loading.forces, p.loading.imposed,
        *(x for curve in p.loading.curves for x in curve), p.u, p.v, p.state, p.times,
        *(x for x in stops if isinstance(x, np.ndarray)),
    ]  # fmt: skip
    if p.interface:
        matrices.append(p.interface.J)
        arrays += [p.interface.codes, p.interface.parameters, p.interface.weights, p.interface.B]
    words = f"{p.scheme} {p.contact_options}".encode()
    return digest(matrices, [*arrays, np.frombuffer(words, np.uint8)])
