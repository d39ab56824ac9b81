"""The table of nodes: every node lives here once; meshes and fields refer to it by number."""

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError

FARTHEST = 1e100  # coordinates stay below: volumes are finite numbers


def told_coordinates(values: FloatArray) -> str:
    """Coordinates (n,) as messages write them, in six digits: '0. 4.'."""
    digits = (f"{x + 0.0:.6g}" for x in values)
    return " ".join(d if any(s in d for s in ".en") else f"{d}." for d in digits)


class NodeTable:
    """Append-only table of node coordinates and mesh densities.

    Node numbers are 0-based row numbers; the language shows them 1-based. Coordinates have
    always three columns, the missing ones being zero, so that the space dimension can change.
    Merging nodes (ELIM) keeps all rows and records an alias instead: whoever holds node numbers
    passes them through `resolve`, and may cache the result as long as `version` stays the same.
    """

    def __init__(self) -> None:
        self._coordinates: FloatArray = np.empty((64, 3))
        self._density: FloatArray = np.empty(64)
        self._alias: IntArray = np.arange(64, dtype=np.int64)
        self._count = 0
        self.version = 0

    def __len__(self) -> int:
        return self._count

    @property
    def coordinates(self) -> FloatArray:
        """Coordinates of all nodes, shape (n, 3), a writable view (moving nodes moves meshes)."""
        return self._coordinates[: self._count]

    @property
    def density(self) -> FloatArray:
        """Wanted mesh size at each node, shape (n,), 0 where none was given; a writable view."""
        return self._density[: self._count]

    def add(self, coordinates: NDArray[np.floating], density: float | FloatArray = 0.0) -> IntArray:
        """Append nodes and return their numbers.

        Parameters
        ----------
        coordinates : array (m, 1..3)
            Missing columns are set to zero.
        density : float or array (m,)

        Raises
        ------
        MeshError
            For a coordinate that is no finite number, or so large that its cube is none.
        """
        rows = np.atleast_2d(np.asarray(coordinates, dtype=float))
        if not (np.abs(rows) < FARTHEST).all():
            far = rows[~(np.abs(rows) < FARTHEST)][0]
            raise MeshError("kernel.mesh.node-out-of-range", value=far, limit=FARTHEST)
        m = len(rows)
        self._reserve(self._count + m)
        ids = np.arange(self._count, self._count + m, dtype=np.int64)
        self._coordinates[ids] = 0.0
        self._coordinates[ids, : rows.shape[1]] = rows
        self._density[ids] = density
        self._alias[ids] = ids
        self._count += m
        return ids

    def add_between(self, groups: IntArray) -> IntArray:
        """Append nodes in the middle of groups (m, k) of nodes, -1 standing for none."""
        there = (groups >= 0)[..., None]
        count = there.sum(axis=1)
        xyz = (self.coordinates[groups] * there).sum(axis=1) / count
        size = (self.density[groups][..., None] * there).sum(axis=1) / count
        return self.add(xyz, size[:, 0]) if len(groups) else np.empty(0, dtype=np.int64)

    def resolve(self, ids: IntArray) -> IntArray:
        """The surviving node numbers of `ids` after all merges (same shape)."""
        return self._alias[ids]

    def shown(self, coordinates: FloatArray) -> FloatArray:
        """The coordinates (3,) that messages write: two where no node of the table has a third."""
        return coordinates[: 3 if self.coordinates[:, 2].any() else 2]

    def told(self, node: int) -> str:
        """A node as messages name it: its number, from 1, and where it is: '12 (0. 4.)'."""
        return f"{int(node) + 1} ({told_coordinates(self.shown(self.coordinates[int(node)]))})"

    def merge(self, kept: IntArray, dropped: IntArray) -> None:
        """Make every `dropped[i]` an alias of `kept[i]` (arrays (m,), resolved on the way)."""
        if len(kept) == 0:
            return
        target = np.arange(self._count, dtype=np.int64)
        target[self._alias[dropped]] = self._alias[kept]
        while not np.array_equal(target, target[target]):
            target = target[target]
        self._alias[: self._count] = target[self._alias[: self._count]]
        self.version += 1

    def _reserve(self, size: int) -> None:
        capacity = len(self._density)
        if size <= capacity:
            return
        capacity = max(size, 2 * capacity)
        grown = np.empty((capacity, 3))
        grown[: self._count] = self._coordinates[: self._count]
        density = np.empty(capacity)
        density[: self._count] = self._density[: self._count]
        alias = np.arange(capacity, dtype=np.int64)
        alias[: self._count] = self._alias[: self._count]
        self._coordinates, self._density, self._alias = grown, density, alias
