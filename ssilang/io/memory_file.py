"""The file of a ground's memory: a zip of arrays (NPY), whole or not at all."""

import glob
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.archive.container import DAMAGES
from ssilang.io.atomic import replacing
from ssilang.io.errors import InputError, OutputError
from ssilang.io.run_output import RunLock
from ssilang.kernel.base.arrays import SINGLE, FloatArray
from ssilang.kernel.solvers.low_rank import LowRank
from ssilang.kernel.stepping.rests.memory.ground import TOLD_BY
from ssilang.kernel.stepping.rests.memory.kernels import NEAR, Kernels, Stage
from ssilang.system import GUARDED, lock

_LOOK = 0.05  # s between two tries of a file that another process writes
LONG = 20.0  # s of steps that are left for another making, if this one is broken off


@dataclass(frozen=True)
class MemoryFile:
    """A memory on disk; runs of several processes may share it."""

    path: Path

    @property
    def name(self) -> str:
        """As messages call it."""
        return self.path.name

    @property
    def there(self) -> bool:
        """Whether there is one."""
        return self.path.is_file()

    def read(self) -> Kernels | None:
        """What the file holds, None if there is none.

        Raises
        ------
        InputError
            If it is no memory.
        """
        if not self.there:
            return None
        try:
            with np.load(self.path, allow_pickle=False) as f:
                if sum(i.file_size for i in f.zip.infolist()) > self.path.stat().st_size:
                    raise ValueError("packed")
                given = {name: f[name] for name in f.files}
                order, clusters = given.pop("order"), given.pop("clusters")
                sums = tuple(
                    LowRank(order, clusters, ranks, given.pop(f"values{i}"))
                    for i, ranks in enumerate(given.pop("ranks"))
                )
                stages = tuple(
                    Stage(int(first), given.pop(f"P{i}"), given.pop(f"sums{i}"))
                    for i, first in enumerate(given.pop("firsts").tolist())
                )
                if others := {f.name for f in fields(Kernels)} ^ {"sums", "stages", *given}:
                    raise ValueError(", ".join(sorted(others)))
                for name, kind in _NUMBERS.items():
                    given[name] = kind(given[name][()])
                kernels = Kernels(**given, sums=sums, stages=stages)
                _check(kernels)
                return kernels
        except DAMAGES as error:
            raise InputError("io.memory-damaged", name=self.name, error=str(error)) from error

    @contextmanager
    def held(self) -> Iterator[None]:
        """Keep other processes from writing it meanwhile, where files can be locked."""
        held = _hold(self.path.with_name(f".{self.path.name}.lock"))
        try:
            yield
        finally:
            if held is not None:
                held.release()

    def answered(
        self, name: str, shape: tuple[int, int], rows: Iterator[FloatArray]
    ) -> Iterator[FloatArray]:
        """Rows of a name, or those that a making which was broken off left under it.

        Rows that took long are left for the next one, until there is a memory.
        """
        path = self.path.with_name(f"{self.name}.{name}")
        with suppress(*DAMAGES):
            rows, path = iter(_part(path, shape)), None
        made, began = list[FloatArray](), time.monotonic()
        for row in rows:
            yield row
            made.append(row)
        if path is not None and time.monotonic() - began > LONG:
            with suppress(OutputError), replacing(path) as stream:
                np.save(stream, made)

    def write(self, kernels: Kernels) -> None:
        """Put a memory there."""
        k = kernels
        many = ("sums", "stages")
        parts = {f.name: getattr(k, f.name) for f in fields(k) if f.name not in many}
        parts |= {"order": k.sums[0].order, "clusters": k.sums[0].first}
        parts |= {"ranks": [A.ranks for A in k.sums]}
        parts |= {f"values{i}": A.values for i, A in enumerate(k.sums)}
        for i, stage in enumerate(k.stages):
            parts |= {f"P{i}": stage.P, f"sums{i}": stage.sums}
        with replacing(self.path) as stream:
            np.savez(stream, firsts=[s.first for s in k.stages], **parts)
        for path in self.path.parent.glob(f"{glob.escape(self.name)}.{'[0-9a-f]' * 16}"):
            path.unlink(missing_ok=True)


def _part(path: Path, shape: tuple[int, int]) -> FloatArray:
    """Rows of a file; one of `DAMAGES` if it is not there, or holds others."""
    with path.open("rb") as stream:
        found: FloatArray = np.load(stream, allow_pickle=False)
    if found.shape[1:] != shape or found.dtype != SINGLE or not np.isfinite(found).all():
        raise ValueError(f"{found.shape} {found.dtype}")
    return found


_NUMBERS: dict[str, Callable[[Any], Any]] = {
    "dt": float, "tolerance": float, "estimate": float, "reach": int,
}  # fmt: skip


def _check(k: Kernels) -> None:
    """Refuse arrays of kinds and shapes that no run wrote."""
    q, loads, r = int(k.mark[0]), k.loads_mark.size // TOLD_BY, k.patterns.shape[-1]
    shapes = [(k.first, SINGLE, (q, q)), (k.loads, SINGLE, (len(k.loads), q, r))]
    shapes += [(k.patterns, float, (loads, r))]
    shapes += [(mark, float, (mark.size,)) for mark in (k.mark, k.loads_mark)]
    for stage in k.stages:
        r = stage.P.shape[-1]
        shapes += [(stage.P, SINGLE, (q, r)), (stage.sums, SINGLE, (len(stage.sums), r, r))]
    for A in k.sums:
        count = len(A.first)
        shapes += [(A.order, np.int64, (q,)), (A.first, np.int64, (count,))]
        shapes += [(A.ranks, np.int64, (count * (count - 1) // 2, 2))]
        shapes += [(A.values, SINGLE, (A.values.size,))]
    for part, kind, shape in shapes:
        if part.dtype != kind or part.shape != shape or not np.isfinite(part).all():
            raise ValueError(f"{part.shape} {part.dtype}")
    if not (k.dt > 0.0 and k.tolerance > 0.0):  # no number is not
        raise ValueError(f"{k.dt} s, to {k.tolerance}")
    ends = [len(k.sums) + 1, *(s.first + len(s.sums) for s in k.stages)]
    known = zip(k.stages, ends, strict=False)
    if ends[0] < NEAR or any(s.first < end or not len(s.sums) for s, end in known):
        raise ValueError(f"{ends[0]} kernels")
    if any(_numbers(A) != len(A.values) for A in k.sums):
        raise ValueError("blocks")


def _numbers(A: LowRank) -> int:
    """How many values the blocks of a matrix have, -1 if these are no blocks."""
    q, sides, (few, count) = len(A.order), np.diff(A.first), A.ranks.T
    within = (A.first, q - A.first, sides)  # sides alone could rise by more than 64 bits hold
    counts = (few, q - count, count + 1, np.maximum(count, 0) - few)
    least = min(x.min() for x in (*within, *counts))
    rows = np.array_equal(np.sort(A.order), np.arange(q))
    if least < 0 or not rows or [A.first[0], A.first[-1]] != [0, q]:
        return -1
    row, column = np.tril_indices(len(sides))
    n, m = sides[row], sides[column]
    return int(np.where(count < 0, n * m, count * (n + m)).sum())


def _hold(path: Path) -> RunLock | None:
    """Wait for a lock; None where there are none."""
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        while True:
            found = RunLock(path, os.open(path, os.O_RDWR | os.O_CREAT | GUARDED, 0o666))
            try:
                lock(found.handle)
                if found.is_held():  # else the one before removed it just now
                    return found
            except BlockingIOError:
                time.sleep(_LOOK)
            except OSError:
                os.close(found.handle)
                return None
            os.close(found.handle)
    return None
