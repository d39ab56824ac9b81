"""The file of a basis that whole runs train: a zip of arrays (NPY), whole or not at all."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ssilang.io.archive.container import DAMAGES
from ssilang.io.atomic import replacing
from ssilang.io.errors import InputError
from ssilang.kernel.stepping.rests.reduced.trained import Training


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
                model, dt, taught = str(f["model"]), float(f["dt"]), f["taught"].tolist()
                return Training(model, dt, tuple(map(str, taught)), f["vectors"])
        except DAMAGES as error:
            raise InputError("io.damaged", name=self.name, error=str(error)) from error

    def write(self, training: Training) -> None:
        """Put a training there."""
        t = training
        with replacing(self.path) as stream:
            np.savez(stream, model=t.model, dt=t.dt, taught=list(t.taught), vectors=t.vectors)
