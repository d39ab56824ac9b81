"""A block of bricks held at its foot: multigrid against the own sparse Cholesky solver.

    OMP_NUM_THREADS=1 python benchmarks/multigrid.py [cells of a side]

Prints stiffness and assembly, then for each solver its preparation (checks for free motions
included), one solve and the memory that it holds, and how far their answers are from each other.
Seconds are those of the processor, all threads together.
"""

import resource
import sys
import time
from pathlib import Path

import numpy as np

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.solvers.backends import DISSECTION, MULTIGRID
from ssilang.kernel.solvers.cholesky.inverse import invert
from ssilang.kernel.solvers.factor import Ordering
from ssilang.kernel.statics.linear_motion import rigid_motions


def block_of_bricks(n: int) -> tuple[sp.csr_array, Ordering, tuple[float, float]]:
    """Stiffness of n^3 bricks on a held foot, its ordering, seconds of stiffness and assembly."""
    table, x = NodeTable(), np.linspace(0.0, 1.0, n + 1)
    points = np.stack(np.meshgrid(x, x, x, indexing="ij"), -1).reshape(-1, 3)
    ids = table.add(points).reshape(n + 1, n + 1, n + 1)

    def corner(i: int, j: int, k: int) -> np.ndarray:
        return ids[i : n + i, j : n + j, k : n + k].ravel()

    bottom = [corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)]
    top = [corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)]
    cells = CellBlock.make(table, "CUB8", np.stack(bottom + top, axis=-1))
    one = np.ones((len(cells), 1))
    field = CellField((CellFieldBlock(cells, {"YOUN": 1e9 * one, "NU": 0.3 * one}, "STRESSES"),))
    zone = Zone(cells, "MECANIQUE", ("ELASTIQUE", "ISOTROPE"), "CUB8", Mode.THREE_DIMENSIONAL)
    start = time.process_time()
    bricks = families.stiffness(zone, field)
    made = time.process_time()
    matrix = Matrix(table, (bricks,))
    numbering = numbering_of(matrix)
    K = assemble(matrix, numbering)
    done = time.process_time()
    at = table.coordinates[numbering.nodes]
    kept = np.flatnonzero(at[:, 2] > 0.0)
    order = Ordering(at[kept], np.zeros(0, np.int64), rigid_motions(numbering)[kept])
    return sp.csr_array(K[kept][:, kept]), order, (made - start, done - made)


def resident() -> float:
    """Memory that this process holds now, MB (Linux)."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def main(n: int = 30) -> None:
    """Both solvers on one matrix."""
    small, few, _ = block_of_bricks(16)
    for _ in range(3):  # the first one compiles, the second one touches memory first
        K, order, spent = block_of_bricks(n)
        print(f"{n}^3 bricks: stiffness {spent[0]:.2f} s, assembly {spent[1]:.2f} s")
    b = np.random.default_rng(0).standard_normal(K.shape[0])
    found: list[np.ndarray] = []
    for name in (MULTIGRID, DISSECTION):
        invert(small, True, name, few)  # compiles
        before, start = resident(), time.process_time()
        inverse = invert(K, True, name, order)
        ready, held = time.process_time(), resident()
        found.append(inverse.solve(b))
        end = time.process_time()
        print(
            f"{name:18s} {K.shape[0]} unknowns, ready in {ready - start:.1f} s, "
            f"a solve {end - ready:.2f} s, {held - before:.0f} MB held"
        )
    print(f"difference {np.abs(found[0] - found[1]).max() / np.abs(found[1]).max():.1e}")


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]))
