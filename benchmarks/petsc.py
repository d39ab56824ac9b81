"""The block on a cube of soil: PETSc on 1 and 2 processes against the own sparse Cholesky solver.

    apt-get install python3-petsc4py python3-mpi4py mpi-default-bin libopenblas0-pthread
    OMP_NUM_THREADS=1 python benchmarks/petsc.py [cells of a side ...] [-- most processes]

The matrix is that of a step of `block_3d_openseespy.py`, scaled to a unit diagonal. For each
solver: the factorisation, one solve, one of 16 columns at a time (the interface's compliance is
made of them) and the memory. Seconds are those by the clock and, in brackets, of the processor
(of the busiest process). A process of MPI that waits for another uses its processor meanwhile.
What is said of multigrid counts MUMPS's analysis, which finds that its factor has no room. Memory:
what the own factor adds to this process, what all processes of PETSc hold at most, and what MUMPS
says of itself.
"""

import os
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import block_3d_openseespy as solid
import numpy as np
from multigrid import resident

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.backends import DISSECTION, PETSC, factorise
from ssilang.kernel.solvers.factor import Factor, Ordering, Solver
from ssilang.kernel.solvers.petsc.client import PetscServer
from ssilang.kernel.statics.linear_motion import rigid_motions
from ssilang.kernel.stepping.effective import effective_matrix
from ssilang.kernel.stepping.problem.problem import make_problem

CELLS = (12, 15, 20, 25, 30)
PYTHON = "/usr/bin/python3"
COLUMNS = 16


def system_of(cells: int) -> tuple[sp.csr_array, Ordering]:
    """The matrix of a step (n, n) with unit diagonal, and the places of its unknowns."""
    problem = make_problem(solid.inputs_of(solid.make_case(cells, 2))[0])
    T, joints = problem.constraints.T, problem.interface
    A = sp.csr_array(T.T @ effective_matrix(problem, problem.times[1] - problem.times[0]) @ T)
    scale = 1.0 / np.sqrt(A.diagonal())
    S = sp.diags_array(scale)
    own = np.asarray(abs(T).argmax(axis=0)).ravel()
    points = problem.numbering.table.coordinates[problem.numbering.nodes[own]]
    last = np.unique(sp.csc_array(T.T @ joints.J.T).indices).astype(np.int64)
    order = Ordering(points, last, rigid_motions(problem.numbering)[own])
    return sp.csr_array(S @ A @ S), order.scaled(scale)


def processor_seconds(processes: list[int]) -> np.ndarray:
    """What each process has used of a processor (Linux)."""
    ticks = []
    for process in processes:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        ticks.append(int(fields[11]) + int(fields[12]))
    return np.array(ticks) / os.sysconf("SC_CLK_TCK")


def timed(work: Callable[[], Any], processes: list[int], turns: int = 1) -> tuple[Any, str]:
    """What the work gives, the shortest of its times by the clock, the mean of the processor's."""
    clocks, used = [], processor_seconds(processes)
    for _ in range(turns):
        start = time.perf_counter()
        result = work()
        clocks.append(time.perf_counter() - start)
    used = (processor_seconds(processes) - used).max() / turns
    return result, f"{min(clocks):.3g} ({used:.2g})"


def row(
    name: str, make: Callable[[], Factor], processes: list[int], B: np.ndarray
) -> tuple[list[str], np.ndarray, Factor]:
    """The cells of a solver's row, its answer, its factor."""
    factor, made = timed(make, processes)
    _, one = timed(lambda: factor.solve(B[:, 0]), processes, 10)
    X, many = timed(lambda: factor.solve(B), processes)
    return [name, made, one, many], X, factor


def ranks_of(server: PetscServer) -> list[int]:
    """The processes of a server that run Python: they are of the session of its launcher."""
    assert server._line is not None
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            program = (entry / "cmdline").read_bytes().split(b"\0")[0]
            if os.getsid(int(entry.name)) == server._line.process.pid:
                found += [int(entry.name)] if program.endswith(b"python3") else []
        except OSError:
            continue
    return found


def main(sizes: list[int], most: int) -> None:
    """A table; sizes are cells along a side of the soil."""
    small, few = system_of(6)
    factorise(small, True, None, few).solve(np.ones((small.shape[0], 2)))  # compiles
    print("| unknowns | solver | factor, s | solve, s | 16 columns, s | memory, MB | difference |")
    print("| --- " * 7 + "|")
    for cells in sizes:
        A, order = system_of(cells)
        B = np.random.default_rng(0).standard_normal((A.shape[0], COLUMNS))
        before = resident()
        line, exact, factor = row(
            DISSECTION, partial(factorise, A, True, None, order), [os.getpid()], B
        )
        print_row(A, line, f"{resident() - before:.0f}", 0.0)
        del factor
        for processes in range(1, most + 1):
            for room in (None, 1e6):
                server = PetscServer(f"mpirun -n {processes} {PYTHON}", room=room)
                server.factorise(small, True)  # starts
                solver, ranks = Solver(PETSC, server), ranks_of(server)
                line, X, factor = row("", partial(factorise, A, True, solver, order), ranks, B)
                line[0] = f"{factor.name}, {processes}"
                held = f"{sum(h['peak_memory_mb'] for h in server.report()['hosts']):.0f}"
                if factor.n_bytes is not None:
                    held += f" ({factor.n_bytes / 1e6:.0f})"
                print_row(A, line, held, np.abs(X - exact).max() / np.abs(exact).max())
                server.close()


def print_row(A: sp.csr_array, line: list[str], memory: str, difference: float) -> None:
    """A row of the table."""
    unknowns = f"{A.shape[0]:,}".replace(",", " ")
    told = f"{difference:.0e}" if difference else ""
    print("| " + " | ".join([unknowns, *line, memory, told]) + " |", flush=True)


if __name__ == "__main__":
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    main([int(w) for w in words[:cut]] or list(CELLS), int((words[cut + 1 :] or ["2"])[0]))
