"""The state of a motion under way, and what is kept of its steps: the two containers of loops."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.response import InterfaceState

N_ENERGIES = 6
KINETIC, ELASTIC, STORED, LOST, DAMPED, EXTERNAL = range(N_ENERGIES)


class Motion(NamedTuple):
    """The state at the end of the last step, changed in place.

    Loops on coordinates hold these in place of the n unknowns.
    """

    u: FloatArray  # (n,)
    v: FloatArray
    a: FloatArray
    delta: FloatArray  # (q,) jumps at the interface's nodes
    f: FloatArray  # (q,) forces on them
    w: FloatArray  # (n_points, d) jumps at the joints' points
    t: FloatArray  # (n_points, d) tractions
    state: FloatArray  # (n_points, N_STATE) internal variables of the joints
    reaction: FloatArray  # (n,) M a + C v + K u + J^T f - F of the last step
    energies: FloatArray  # (N_ENERGIES,)
    contact: FloatArray  # (m,) reactions of unilateral relations

    @property
    def joints(self) -> InterfaceState:
        """The interface's part of the state, the same arrays."""
        return InterfaceState(self.delta, self.f, self.w, self.t, self.state)


class Tap(NamedTuple):
    """Rows of some steps that hold few entries of the fields, and the joints.

    `row` (n_steps,) is the row of each step, -1 for none; parts without rows are not kept.
    """

    row: IntArray
    at: IntArray  # (c,) entries of u, v, a and reaction
    u: FloatArray  # (n_rows, c)
    v: FloatArray
    a: FloatArray
    reaction: FloatArray
    f: FloatArray  # (n_rows, q)
    w: FloatArray  # (n_rows, n_points, d)
    t: FloatArray
    state: FloatArray
    contact: FloatArray  # (n_rows, m)


class Peaks(NamedTuple):
    """Values that are largest without their sign, over all steps so far, and their steps.

    Arrays without entries are not kept.
    """

    first: FloatArray  # (1,) step that ended before the first of those under way
    u: FloatArray  # (n,) displacement, with its sign
    when: FloatArray  # (n,)
    joints: FloatArray  # (3, n_points) opening, compression (negative), shear
    joints_when: FloatArray  # (3, n_points)


class Recorder(NamedTuple):
    """What some steps leave: a row of the state for steps that are kept, numbers for all.

    `row` (n_steps,) is the row of each step, -1 for none; parts without rows are not kept.
    """

    row: IntArray
    energies: FloatArray  # (n_steps, N_ENERGIES), or none
    u: FloatArray  # (n_rows, n)
    v: FloatArray
    a: FloatArray
    reaction: FloatArray
    f: FloatArray  # (n_rows, q)
    w: FloatArray  # (n_rows, n_points, d)
    t: FloatArray
    state: FloatArray
    contact: FloatArray  # (n_rows, m)
    jumps: FloatArray  # (n_steps, n_points, d) of all steps, or none
    work: FloatArray  # (2, n_steps, k) of loads, of the joints on `lift` (k = 0: none)
    tap: Tap
    peaks: Peaks


PARTS = ("u", "v", "a", "reaction", "f", "w", "t", "state", "contact")
WHOLE = ("u", "v", "a", "reaction", "w", "t", "state", "contact")
"""Parts of the state that an instant holds."""


def recorder_of(
    motion: Motion, row: IntArray, energies: FloatArray, kept: Sequence[str] = WHOLE, **more: Any
) -> Recorder:
    """Room for the rows, numbered without gaps, of steps of a motion; `more`: other fields."""
    rows = int(row.max(initial=-1)) + 1
    parts: dict[str, Any] = {
        name: np.zeros((rows if name in kept else 0, *getattr(motion, name).shape))
        for name in PARTS
    }
    parts |= {
        "jumps": np.zeros((0, *motion.w.shape)),
        "work": np.zeros((2, len(row), 0)),
        "tap": closed_tap(len(row)),
        "peaks": peaks_of(0, 0),
    }
    return Recorder(row, energies, **(parts | more))


class Room:
    """Memory for rows of taps that follow each other, taken in pieces that the system maps fast.

    Parts of the same rows lie side by side: few places are new at a time.

    Parameters
    ----------
    rows : int
        How many there will be in all.
    """

    def __init__(self, rows: int) -> None:
        self._left, self._free = rows, np.empty(0)

    def tap(self, row: IntArray, at: IntArray, shapes: dict[str, tuple[int, ...]]) -> Tap:
        """Room for the rows, numbered without gaps, not set; `shapes` of the parts kept."""
        rows = int(row.max(initial=-1)) + 1
        sizes = {name: math.prod(shape) for name, shape in shapes.items()}
        each, first = sum(sizes.values()), 0
        if len(self._free) < rows * each:
            self._free = numbers(max(rows, min(self._left, PIECE // (8 * each))) * each)
        parts = {name: np.empty(NO_ROWS[name]) for name in PARTS if name not in shapes}
        for name, size in sizes.items():
            last = first + rows * size
            parts[name] = self._free[first:last].reshape(rows, *shapes[name])
            first = last
        self._free = self._free[first:]
        self._left -= rows
        return Tap(row, at, **parts)


def numbers(n: int) -> FloatArray:
    """So many numbers, not set; where they are many, they begin with a large page.

    numpy asks for large pages above 4 MB, but the system gives them only where they lie whole in
    the memory: the parts before the first and behind the last would be mapped by 4 kB.
    """
    if 8 * n < 2 * PAGE:
        return np.empty(n)
    memory = np.empty(n + 2 * PAGE // 8)
    first = -memory.__array_interface__["data"][0] % PAGE // 8
    return memory[first : first + n]


PAGE = 1 << 21
"""Bytes of a large page."""
PIECE = 27 << 20
"""Bytes of a piece of memory: the C library keeps what is let go for others, up to 32 MB."""
NO_ROWS = dict.fromkeys(PARTS, (0, 0)) | dict.fromkeys(("w", "t", "state"), (0, 0, 0))


def tap_of(row: IntArray, at: IntArray, shapes: dict[str, tuple[int, ...]]) -> Tap:
    """Room for the rows of steps alone."""
    return Room(0).tap(row, at, shapes)


def closed_tap(n_steps: int) -> Tap:
    """A tap that takes nothing of some steps."""
    return tap_of(none_kept(n_steps), np.zeros(0, np.int64), {})


def peaks_of(n: int, n_points: int) -> Peaks:
    """No motion yet of n displacements and of joints; 0 keeps nothing."""
    joints = np.zeros((3, n_points))
    return Peaks(np.zeros(1), np.zeros(n), np.zeros(n), joints, joints.copy())


LONGEST_CHUNK = 1 << 16  # steps at a time at most: their arrays stay in the second cache
NONE_KEPT, ALL_KEPT = np.full(LONGEST_CHUNK, -1, np.int64), np.arange(LONGEST_CHUNK)
"""Rows of steps none or all of which are kept, never written: memory that is new costs more than
steps."""


def none_kept(n_steps: int) -> IntArray:
    """Rows (n_steps,) of steps none of which is kept; not to be written."""
    return NONE_KEPT[:n_steps] if n_steps <= LONGEST_CHUNK else np.full(n_steps, -1, np.int64)


def rows_of(chosen: np.ndarray) -> IntArray:
    """Row of each step (n_steps,) when the chosen ones are kept, -1 for the others.

    The rows are not to be written.
    """
    if chosen.all():
        return ALL_KEPT[: len(chosen)] if len(chosen) <= LONGEST_CHUNK else np.arange(len(chosen))
    found, places = none_kept(len(chosen)), np.flatnonzero(chosen)
    if not len(places):
        return found
    found = found.copy()
    found[places] = np.arange(len(places))
    return found


Outcome = tuple[int, int, float]
"""Of some steps: how many were done, most interface iterations in one (<= 0: the step after them
did not converge), residual of a step that did not."""
