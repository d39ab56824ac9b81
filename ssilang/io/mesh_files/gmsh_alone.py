"""Meshes a .geo file in a process that can start no program and reach no file outside.

    python -P gmsh_alone.py SCRIPT FOLDER DIMENSION LIBRARY FREE

`FOLDER/made.msh` is the mesh, `FOLDER/told` says what failed. A script of Gmsh may start programs,
read and write files by some thirty words, and words are no guard: the kernel refuses. Landlock
(https://docs.kernel.org/userspace-api/landlock.html) holds files: readable are Python, libraries of
the system, the folder LIBRARY of Gmsh and what stands below the script's folder, writable are the
two files in FOLDER, and nothing is executable. A filter
(https://docs.kernel.org/userspace-api/seccomp_filter.html) lets in the calls of a program that
computes: none that starts a process, reaches a network or another one, or the rights of files.
This file knows nothing of ssilang: it runs before anything else is imported.
"""

import ctypes
import os
import sys
from pathlib import Path

UNGUARDED = 3
"""Exit code where the system has no such guard, or where it does not hold."""
MADE, TOLD = "made.msh", "told"
"""What the process leaves in its folder."""

_CREATE, _ADD, _RESTRICT = 444, 445, 446
_ENDS_WITH_PARENT, _FILTER, _NO_NEW_PRIVILEGES = 1, 22, 38  # of prctl
_WRITE, _READ, _LIST, _REMOVE, _MAKE, _TRUNCATE = (1 << n for n in (1, 2, 3, 5, 8, 14))
_RIGHTS_OF_ABI = (0, 13, 14, 15, 15)  # rights on files that a version knows; 16 from version 5 on
_LIBRARIES = ("/usr/lib", "/usr/lib64", "/usr/local/lib", "/lib", "/lib64", "/etc/ld.so.cache")


_MACHINES = {"x86_64": (0, 0xC000003E), "aarch64": (1, 0xC00000B7)}
"""Column of the calls, and what a filter sees of a machine."""
CALLS = {
    "access": (21, -1), "brk": (12, 214), "clock_getres": (229, 114), "clock_gettime": (228, 113),
    "clock_nanosleep": (230, 115), "close": (3, 57), "dup": (32, 23), "epoll_create1": (291, 20),
    "exit": (60, 93), "exit_group": (231, 94), "faccessat": (269, 48), "faccessat2": (439, 439),
    "fcntl": (72, 25), "fstat": (5, 80), "ftruncate": (77, 46), "futex": (202, 98),
    "get_mempolicy": (239, 236), "getcpu": (309, 168), "getcwd": (79, 17), "getdents64": (217, 61),
    "getegid": (108, 177), "geteuid": (107, 175), "getgid": (104, 176), "getpid": (39, 172),
    "getrandom": (318, 278), "getrusage": (98, 165), "gettid": (186, 178),
    "gettimeofday": (96, 169), "getuid": (102, 174), "lseek": (8, 62), "lstat": (6, -1),
    "madvise": (28, 233), "mbind": (237, 235), "membarrier": (324, 283), "mmap": (9, 222),
    "mprotect": (10, 226), "mremap": (25, 216), "munmap": (11, 215), "nanosleep": (35, 101),
    "newfstatat": (262, 79), "open": (2, -1), "openat": (257, 56), "pread64": (17, 67),
    "pwrite64": (18, 68), "read": (0, 63), "readlink": (89, -1), "readlinkat": (267, 78),
    "readv": (19, 65), "rseq": (334, 293), "rt_sigaction": (13, 134), "rt_sigprocmask": (14, 135),
    "rt_sigreturn": (15, 139), "sched_getaffinity": (204, 123), "sched_yield": (24, 124),
    "set_mempolicy": (238, 237), "set_robust_list": (273, 99), "set_tid_address": (218, 96),
    "sigaltstack": (131, 132), "stat": (4, -1), "statx": (332, 291), "sysinfo": (99, 179),
    "time": (201, -1), "times": (100, 153), "uname": (63, 160), "write": (1, 64),
    "writev": (20, 66),
}  # fmt: skip
"""Calls that are let in, by machine; -1 where a machine has none."""
ONLY = {
    "clone": ((56, 220), 0, 0x10000, 0x10000),  # a thread, no process
    "ioctl": ((16, 29), 1, 0xFFFFFFFF, 0x5401),  # whether a file is a terminal
    "prlimit64": ((302, 261), 0, 0xFFFFFFFF, 0),  # its own limits
}
"""Calls that are let in where this argument, after this mask, is this."""
_CLONE3, _NOT_THERE = 435, 38  # libraries take clone then, whose flags a filter can read
_LET, _REFUSE, _KILL = 0x7FFF0000, 0x00050001, 0x80000000


class _Instruction(ctypes.Structure):
    _fields_ = [("code", ctypes.c_uint16), ("yes", ctypes.c_uint8), ("no", ctypes.c_uint8),
                ("value", ctypes.c_uint32)]  # fmt: skip


class _Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_uint16), ("first", ctypes.POINTER(_Instruction))]


class _Rules(ctypes.Structure):
    _fields_ = [(name, ctypes.c_uint64) for name in ("files", "network", "scopes")]


class _Below(ctypes.Structure):
    _layout_, _pack_ = "ms", 1
    _fields_ = [("rights", ctypes.c_uint64), ("folder", ctypes.c_int32)]


def confine(readable: list[str], writable: list[str]) -> bool:
    """Whether the process is held now: it reads and writes these files and folders, no others.

    It executes nothing, and makes none but the calls of a program that computes.
    """
    if not sys.platform.startswith("linux") or len(os.listdir("/proc/self/task")) > 1:
        return False  # other threads would stay as they are
    ctypes.CDLL(None).prctl(_ENDS_WITH_PARENT, 9, 0, 0, 0)
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
        held = known & (rights if os.path.isdir(path) else rights & (_READ | _WRITE | _TRUNCATE))
        system(_ADD, ruleset, 1, ctypes.byref(_Below(held, folder)), 0)
        os.close(folder)
    ctypes.CDLL(None).prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0)
    held = ruleset >= 0 and system(_RESTRICT, ruleset, 0) == 0
    return held and _holds(writable[0]) and _filtered()


def _filtered() -> bool:
    """Whether none but the calls of a program that computes are let in from now on."""
    if sys.platform == "win32":
        return False
    column, machine = _MACHINES.get(os.uname().machine, (-1, 0))
    if column < 0 or sys.maxsize < 2**32:
        return False
    load, masked, same, end = 0x20, 0x54, 0x15, 0x06
    made = [(load, 0, 0, 4), (same, 1, 0, machine), (end, 0, 0, _KILL), (load, 0, 0, 0)]
    for numbers in CALLS.values():
        if numbers[column] >= 0:
            made += [(same, 0, 1, numbers[column]), (end, 0, 0, _LET)]
    made += [(same, 0, 1, _CLONE3), (end, 0, 0, 0x00050000 | _NOT_THERE)]
    for numbers, argument, mask, value in ONLY.values():
        made += [
            (same, 0, 5, numbers[column]), (load, 0, 0, 16 + 8 * argument), (masked, 0, 0, mask),
            (same, 0, 1, value), (end, 0, 0, _LET), (end, 0, 0, _REFUSE),
        ]  # fmt: skip
    made.append((end, 0, 0, _REFUSE))
    rows = (_Instruction * len(made))(*(_Instruction(*row) for row in made))
    program = _Program(len(made), rows)
    return bool(ctypes.CDLL(None).prctl(_FILTER, 2, ctypes.byref(program), 0, 0) == 0)


def _holds(folder: str) -> bool:
    """Whether what must be refused is refused: a file beside what is writable, and a program."""
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
    if sys.platform == "win32":  # has no such bounds
        return
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


def main(script: str, folder: str, dimension: str, library: str, free: str) -> int:
    """Mesh a script under guard; the exit code."""
    import encodings.utf_8  # noqa: F401  what is imported late must be readable
    import traceback  # noqa: F401

    if os.name == "posix":
        limit(3600)
    written = [os.path.join(folder, name) for name in (MADE, TOLD)]
    for name in written:
        os.close(os.open(name, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600))
    sys.path.append(library)  # may be known by PYTHONPATH, whose other folders are not read
    readable = [library, sys.prefix, sys.base_prefix, *_LIBRARIES, "/dev/null"]
    if os.path.basename(library) == "site-packages":  # of one user: its code stands beside Python
        readable.append(os.path.dirname(os.path.dirname(library)))
    if not confine([os.path.dirname(script), *readable], written) and not free:
        return UNGUARDED
    try:
        told = mesh(script, written[0], int(dimension))
    except (ImportError, OSError) as error:  # of a library of the system
        told = f"import: {error}"
    Path(written[1]).write_text(told[:2000], encoding="utf-8", errors="replace")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
