"""PETSc for tests: two processes of the system's Python, where it and MPI are installed."""

import glob
import os
import shutil
import subprocess
from functools import cache
from pathlib import Path

COMMAND = os.environ.get("SSILANG_TEST_PETSC", "mpirun -n 2 /usr/bin/python3")
DEBIAN = "/usr/lib/petscdir/petsc*/*-real/lib/python3/dist-packages"
# a machine for tests may have one core, and be used by its root alone; Open MPI leaves the others a
# second to end when a rank is lost
MPI = {
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_odls_base_sigkill_timeout": "0",
}
ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def environment() -> dict[str, str]:
    """What Open MPI needs besides, here."""
    return {**MPI, **(ROOT if os.geteuid() == 0 else {})}


@cache
def lacking() -> str:
    """Why PETSc cannot be tested here, '' if it can."""
    launcher, python = COMMAND.split()[0], COMMAND.split()[-1]
    for program in (launcher, python):
        if shutil.which(program) is None:
            return f"{program} is not installed (Debian: mpi-default-bin)"
    try:
        wanted = "import numpy, mpi4py.MPI" if glob.glob(DEBIAN) else "import mpi4py, petsc4py"
        tried = subprocess.run(
            [python, "-c", wanted], capture_output=True, text=True, timeout=60, cwd="/"
        )
    except subprocess.TimeoutExpired:
        return f"{python} does not answer"
    lines = tried.stderr.strip().splitlines()
    return f"{python}: {lines[-1]}" if tried.returncode else ""


def ranks() -> list[int]:
    """Processes of servers that this process, or a child of it, has started."""
    found, parents = [], {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
                parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            except OSError:
                continue
            parents[int(entry.name)] = parent
            is_server = len(words) > 1 and words[1].endswith(b"/petsc/server.py")
            if is_server and b"python" in words[0]:
                found.append(int(entry.name))
    return [pid for pid in found if _descends(pid, parents)]


def _descends(pid: int, parents: dict[int, int]) -> bool:
    while pid > 1:
        if pid == os.getpid():
            return True
        pid = parents.get(pid, 0)
    return False
