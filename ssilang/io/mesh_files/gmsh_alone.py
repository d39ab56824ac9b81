"""Meshes a .geo file in a process that can start no program and reach no file outside.

    python -P gmsh_alone.py SCRIPT FOLDER DIMENSION FREE

`FOLDER/made.msh` is the mesh, `FOLDER/told` says what failed. A script of Gmsh may start programs,
read and write files by some thirty words, and words are no guard: the kernel refuses (Landlock,
https://docs.kernel.org/userspace-api/landlock.html). Readable are Python, libraries of the system
and what stands below the script's folder, writable is FOLDER alone, and nothing is executable.
This file knows nothing of ssilang: it runs before anything else is imported.
"""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path

UNGUARDED = 3
"""Exit code where the system has no such guard, or where it does not hold."""

_CREATE, _ADD, _RESTRICT, _NO_NEW_PRIVILEGES = 444, 445, 446, 38
_WRITE, _READ, _LIST, _REMOVE, _MAKE, _TRUNCATE = (1 << n for n in (1, 2, 3, 5, 8, 14))
_RIGHTS_OF_ABI = (0, 13, 14, 15, 15)  # rights on files that a version knows; 16 from version 5 on
_LIBRARIES = ("/usr/lib", "/usr/lib64", "/usr/local/lib", "/lib", "/lib64", "/etc/ld.so.cache")


class _Rules(ctypes.Structure):
    _fields_ = [(name, ctypes.c_uint64) for name in ("files", "network", "scopes")]


class _Below(ctypes.Structure):
    _pack_ = 1
    _fields_ = [("rights", ctypes.c_uint64), ("folder", ctypes.c_int32)]


def confine(readable: list[str], writable: list[str]) -> bool:
    """Whether the process is held now: reads and writes below these folders, executes nothing."""
    if not sys.platform.startswith("linux") or len(os.listdir("/proc/self/task")) > 1:
        return False  # other threads would stay as they are
    system = ctypes.CDLL(None, use_errno=True).syscall
    abi = system(_CREATE, None, ctypes.c_size_t(0), 1)
    if abi < 1:
        return False
    known = (1 << (_RIGHTS_OF_ABI[abi] if abi < len(_RIGHTS_OF_ABI) else 16)) - 1
    rules = _Rules(known, 0b11 if abi >= 4 else 0, 0b11 if abi >= 6 else 0)
    ruleset = system(_CREATE, ctypes.byref(rules), ctypes.c_size_t(ctypes.sizeof(rules)), 0)
    read = _READ | _LIST
    write = read | _WRITE | _MAKE | _REMOVE | _TRUNCATE
    for path, rights in (*((p, read) for p in readable), *((p, write) for p in writable)):
        if not os.path.exists(path):
            continue
        folder = os.open(path, os.O_PATH | os.O_CLOEXEC)
        held = known & (rights if os.path.isdir(path) else _READ)
        system(_ADD, ruleset, 1, ctypes.byref(_Below(held, folder)), 0)
        os.close(folder)
    ctypes.CDLL(None).prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0)
    return ruleset >= 0 and system(_RESTRICT, ruleset, 0) == 0 and _holds(writable[0])


def _holds(folder: str) -> bool:
    """Whether what must be refused is refused: a file above the folder, and a program."""
    above = os.path.join(os.path.dirname(folder), "escaped")
    try:
        os.close(os.open(above, os.O_CREAT | os.O_EXCL))
    except PermissionError:
        pass
    else:
        return False
    try:  # where this is possible, it ends here
        os.execv(sys.executable, [sys.executable, "-c", f"raise SystemExit({UNGUARDED})"])
    except PermissionError:
        return True


def limit(seconds: int) -> None:
    """Bound the process: time of a processor, half of the memory, files of 2 GB."""
    import resource

    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
    for kind, most in (
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_AS, memory),
        (resource.RLIMIT_FSIZE, 2**31),
        (resource.RLIMIT_CORE, 0),
    ):
        least = resource.getrlimit(kind)[1]
        most = most if least == resource.RLIM_INFINITY else min(most, least)
        resource.setrlimit(kind, (most, most))


def mesh(script: str, made: str, dimension: int) -> str:
    """Mesh a script; what failed, '' if nothing did."""
    import gmsh

    gmsh.initialize([], readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.logger.start()
    try:
        gmsh.open(script)
        gmsh.model.mesh.generate(dimension)
        gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
        gmsh.write(made)
    except Exception as error:
        told = [t for t in gmsh.logger.get() if t.startswith("Error")]
        return str((told or [str(error) or "Gmsh"])[0]).removeprefix("Error: ")
    refused = [t for t in gmsh.logger.get() if t.startswith("Error")]
    return refused[0].removeprefix("Error: ") if refused else ""


def main(script: str, folder: str, dimension: str, free: str) -> int:
    """Mesh a script under guard; the exit code."""
    import encodings.utf_8  # noqa: F401  what is imported late must be readable
    import traceback  # noqa: F401

    if os.name == "posix":
        limit(3600)
    readable = [*filter(None, sys.path), sys.prefix, sys.base_prefix, *_LIBRARIES, "/dev/null"]
    if not free and not confine([os.path.dirname(script), *readable], [folder]):
        return UNGUARDED
    try:
        told = mesh(script, os.path.join(folder, "made.msh"), int(dimension))
    except ImportError as error:
        told = f"import: {error}"
    Path(folder, "told").write_text(told[:2000], encoding="utf-8", errors="replace")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
