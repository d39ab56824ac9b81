"""The file of a basis that whole runs train: a zip of arrays (NPY), whole or not at all."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssilang.io.archive.container import DAMAGES
from ssilang.io.atomic import replacing
from ssilang.io.errors import InputError
from ssilang.io.run_output import RunLock
from ssilang.kernel.stepping.rests.reduced.trained import Training
from ssilang.system import GUARDED, lock

_LOOK = 0.05  # s between two tries of a file that another process trains


@dataclass(frozen=True)
class TrainingFile:
    """A training on disk; runs of several processes may share it."""

    path: Path

    @property
    def name(self) -> str:
        """As messages call it."""
        return self.path.name

    def stamp(self) -> str:
        """Another one for each file that is put there."""
        return f"{self.path} {self.path.stat().st_mtime_ns}" if self.path.is_file() else ""

    def read(self) -> Training | None:
        """What the file holds, None if there is none.

        Raises
        ------
        InputError
            If it is no training.
        """
        if not self.path.is_file():
            return None
        try:
            with np.load(self.path, allow_pickle=False) as f:
                if sum(i.file_size for i in f.zip.infolist()) > self.path.stat().st_size:
                    raise ValueError("packed")
                model, dt, taught = str(f["model"]), float(f["dt"]), f["taught"]
                vectors, answers = f["vectors"], f["answers"]
                for part in (vectors, answers):
                    sound = (taught.ndim, part.ndim, part.dtype) == (1, 2, float)
                    if not (sound and np.isfinite(part).all()):
                        kind, shape = part.dtype, part.shape
                        raise ValueError(f"taught {taught.shape}, vectors {shape} {kind}")
                return Training(model, dt, tuple(map(str, taught.tolist())), vectors, answers)
        except DAMAGES as error:
            raise InputError("io.damaged", name=self.name, error=str(error)) from error

    @contextmanager
    def held(self) -> Iterator[None]:
        """Keep other processes from training it meanwhile, where files can be locked."""
        held = _hold(self.path.with_name(f".{self.path.name}.lock"))
        try:
            yield
        finally:
            if held is not None:
                held.release()

    def write(self, training: Training) -> None:
        """Put a training there."""
        t = training
        with replacing(self.path) as stream:
            np.savez(
                stream,
                model=t.model,
                dt=t.dt,
                taught=list(t.taught),
                vectors=t.vectors,
                answers=t.answers,
            )


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
