"""PETSc as a solver: starts the server with the command that it is given, and asks it.

The server (`server.py`) runs under another Python, on as many processes and machines as the
command says; its first process stands on this machine. Matrices and vectors go there in files
without a name (memfd), whose descriptors the server gets through the socket. The socket lies in a
folder of this user's alone for as long as the server takes to start.
"""

import hmac
import math
import mmap
import os
import secrets
import selectors
import shlex
import shutil
import socket
import subprocess
import tempfile
import time
import weakref
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError, LostSolverError, SingularFactorError
from ssilang.kernel.base.memory import fits, gigabytes
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.petsc.server import PROTOCOL, receive, send
from ssilang.system import end_group, is_of_user, local_socket, shared_memory

SERVER = Path(__file__).with_name("server.py")
START = 120.0  # seconds until the server must have answered
GRACE = 10.0  # seconds that it may take to end
COLUMNS = 64  # right-hand sides that lie in the shared memory at a time
TOLD_LINES, TOLD_BYTES, LONGEST_LINE = 8, 8000, 200  # of what a server printed before it ended
NEEDED = {"real": "kernel.solvers.petsc-not-real", "mumps": "kernel.solvers.petsc-not-mumps"}
"""What a server's PETSc must have, and how its lack is told."""

Arrays = Mapping[str, np.ndarray[Any, Any]]


class PetscServer:
    """PETSc behind a command; it starts when the first matrix comes, and ends by `close`.

    Parameters
    ----------
    command : str
        What starts a Python that has petsc4py, mpi4py and numpy, on some processes:
        `mpirun -n 4 /usr/bin/python3`. The server's file follows it.
    limit : float
        Seconds until the server must have answered.
    room : float or None
        Bytes that each process may take for a factor; None for what its machine has free.
    """

    def __init__(self, command: str, limit: float = START, room: float | None = None) -> None:
        self.command, self.limit, self.room = command, limit, room
        self._line: _Line | None = None
        self._report: dict[str, Any] = {}

    def __repr__(self) -> str:
        return f"PetscServer({self.command!r})"

    def factorise(
        self, A: sp.csr_array, positive: bool, rigid: FloatArray | None = None
    ) -> "PetscFactor":
        """Factorise A (n, n) by MUMPS; multigrid takes a positive one that memory does not hold.

        Parameters
        ----------
        rigid : array (n, k) or None
            Rigid motions of the unknowns, for multigrid.

        Raises
        ------
        SingularFactorError
            If A is singular, or not positive though it was said to be.
        KernelError
            If the server does not start or ends, or has no memory for a matrix.
        """
        line = self._started()
        n, A = A.shape[0], sp.csr_array(A)
        A.sum_duplicates()
        symmetric = positive or _is_symmetric(A)
        motions = np.zeros((0, n)) if rigid is None else np.ascontiguousarray(rigid.T)
        small = np.iinfo(np.int32).max
        arrays = {
            "indptr": A.indptr.astype(np.int64),
            "indices": A.indices.astype(np.int32 if n <= small else np.int64),
            "data": A.data.astype(float),
            "rigid": motions,
        }
        number = line.count = line.count + 1
        reply = line.ask(
            {
                "do": "factorise", "factor": number, "n": n, "positive": positive,
                "symmetric": symmetric, "rigid": len(motions), "room": self.room,
            },
            arrays,
        )  # fmt: skip
        self._report |= {k: reply[k] for k in ("hosts",) if k in reply}
        if "refused" in reply:
            raise _refusal(reply)
        return PetscFactor(line, number, n, str(reply["name"]), reply["bytes"])

    def report(self) -> dict[str, Any]:
        """What the summary tells: command, versions, machines with their ranks and memory."""
        if self._line is not None and not self._line.ended:
            with suppress(KernelError):
                self._report |= self._line.ask({"do": "hosts"})
        told = dict(self._report)
        hosts = told.pop("hosts", {})
        told["hosts"] = [
            {
                "host": name,
                "ranks": host["ranks"],
                "peak_memory_mb": round(host["most"] / 1e6, 1),
                "free_memory_mb": None if math.isinf(host["free"]) else round(host["free"] / 1e6),
            }
            for name, host in hosts.items()
        ]
        return told if self._report else {}

    def close(self) -> None:
        """End the server; its factors solve no more."""
        if self._line is not None:
            self._end()  # and lets go of the line, whose output is a file
            self._line = None

    def _started(self) -> "_Line":
        if self._line is None or self._line.ended:
            self.close()
            self._line, greeting = _start(self.command, self.limit)
            self._end = weakref.finalize(self, self._line.close)
            keys = ("petsc", "mpi", "ranks", "hosts")
            self._report = {"command": self.command, **{k: greeting[k] for k in keys}}
        return self._line


class PetscFactor:
    """A factor, or a hierarchy of grids, that the server holds."""

    def __init__(
        self, line: "_Line", number: int, n: int, name: str, n_bytes: float | None
    ) -> None:
        self.name, self.n_bytes = name, n_bytes
        self._line, self._number, self._n = line, number, n
        weakref.finalize(self, line.dropped.append, number)

    @property
    def lost(self) -> bool:
        """Whether the server has ended, and the factor with it."""
        return self._line.ended

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b, b (n,) or (n, k).

        Raises
        ------
        KernelError
            If the server has ended, or an iteration does not converge.
        """
        if b.ndim == 1:
            alone: FloatArray = self._solved(b[None, :])[0]
            return alone
        x = np.empty((b.shape[1], self._n))
        for start in range(0, b.shape[1], COLUMNS):
            x[start : start + COLUMNS] = self._solved(b.T[start : start + COLUMNS])
        return np.ascontiguousarray(x.T)

    def _solved(self, columns: FloatArray) -> FloatArray:
        desk, descriptors = self._line.desk(*columns.shape)
        desk[:] = columns
        reply = self._line.ask(
            {
                "do": "solve", "factor": self._number, "columns": len(columns),
                "arrays": [["columns", "f8", list(columns.shape), 0]],
            },
            descriptors=descriptors,
        )  # fmt: skip
        if "refused" in reply:
            raise _refusal(reply)
        return desk.copy()


def _is_symmetric(A: sp.csr_array) -> bool:
    difference = abs(A - A.T)
    return bool(difference.nnz == 0 or difference.max() <= 1e-14 * abs(A).max())


def _refusal(reply: Mapping[str, Any]) -> Exception:
    """The error of a matrix that the server does not take."""
    word = reply["refused"]
    if word == "singular":
        return SingularFactorError("a pivot is zero, or negative")
    if word == "memory":
        return KernelError(
            "kernel.solvers.petsc-memory",
            n_a=reply["n"],
            needed=gigabytes(reply["needed"]),
            room=gigabytes(reply["room"]),
        )
    if word == "turns":
        return KernelError("kernel.solvers.petsc-did-not-converge", most_turns=reply["turns"])
    if word == "indices":
        return KernelError("kernel.solvers.petsc-indices", n_a=reply["n"])
    return KernelError("kernel.solvers.petsc-mumps", said=reply["said"], second=reply["second"])


# --- the server's process and the line to it


class _Line:
    """A server that runs, and the socket to it."""

    def __init__(
        self, command: str, process: subprocess.Popen[bytes], output: IO[bytes],
        connection: socket.socket,
    ) -> None:  # fmt: skip
        self.command, self.process, self.output = command, process, output
        self.connection = connection
        self.ended = False
        self.dropped: list[int] = []
        self.count = 0
        self._desk: mmap.mmap | None = None

    def desk(self, count: int, n: int) -> tuple[FloatArray, tuple[int, ...]]:
        """Shared memory for columns (count, n), and its descriptor if the server lacks it."""
        size = max(8 * count * n, mmap.PAGESIZE)
        descriptors: tuple[int, ...] = ()
        if self._desk is None or len(self._desk) < size:
            descriptor = _memory(size)
            self._desk = mmap.mmap(descriptor, size)
            descriptors = (descriptor,)
        return np.ndarray((count, n), np.float64, buffer=self._desk), descriptors

    def ask(
        self, message: dict[str, Any], arrays: Arrays | None = None,
        descriptors: tuple[int, ...] = (),
    ) -> dict[str, Any]:  # fmt: skip
        """The server's reply to a command.

        Raises
        ------
        KernelError
            If the server has ended, or ends now.
        """
        if self.ended:
            raise self._death()
        try:
            if arrays is not None:
                descriptor, message["arrays"] = _written(arrays)
                descriptors = (descriptor,)
            message["drop"] = [self.dropped.pop() for _ in range(len(self.dropped))]
            send(self.connection, message, descriptors)
            reply = self._reply()
        except ValueError:  # no server's words
            self.end()
            raise self._death() from None
        except OSError:
            reply = {}
        except BaseException:  # an interruption: what comes next would not be the answer
            self.end()
            raise
        finally:
            for one in descriptors:
                os.close(one)
        if not reply:
            with suppress(subprocess.TimeoutExpired):  # what ended it may still be printed
                self.process.wait(GRACE)
            self.end()
            raise self._death()
        return reply

    def _reply(self) -> dict[str, Any]:
        """The next message; none if the server has ended."""
        gone = False
        with selectors.DefaultSelector() as line:
            line.register(self.connection, selectors.EVENT_READ)
            while not line.select(1.0):
                if gone:
                    return {}
                gone = self.process.poll() is not None
        return receive(self.connection)[0]

    def _death(self) -> LostSolverError:
        code = self.process.poll()
        return LostSolverError(
            "kernel.solvers.petsc-ended",
            command=self.command,
            code=0 if code is None else code,
            told=_told(self.output),
        )

    def close(self) -> None:
        """End the server in peace."""
        if self.ended:
            return
        with suppress(OSError):
            send(self.connection, {"do": "quit"})
            with suppress(subprocess.TimeoutExpired):
                self.process.wait(GRACE)
        self.end()

    def end(self) -> None:
        """End the server, whatever it does."""
        self.ended = True
        self.connection.close()
        _end(self.process)


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a process and those that it started."""
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(GRACE)
        except subprocess.TimeoutExpired:
            end_group(process)
            process.wait()


def _memory(size: int) -> int:
    """A descriptor of so many bytes of memory without a name, which this user alone may open."""
    if not fits(size):
        raise MemoryError
    return shared_memory(size)


def _written(arrays: Arrays) -> tuple[int, list[Any]]:
    """Arrays in memory without a name: its descriptor and where they lie."""
    layout, at = [], 0
    for name, array in arrays.items():
        layout.append([name, array.dtype.str, list(array.shape), at])
        at += -(-array.nbytes // 64) * 64
    descriptor = _memory(max(at, mmap.PAGESIZE))
    memory = mmap.mmap(descriptor, max(at, mmap.PAGESIZE))
    for (_, kind, shape, start), array in zip(layout, arrays.values(), strict=True):
        np.ndarray(shape, kind, buffer=memory, offset=start)[...] = array
    memory.close()
    return descriptor, layout


def _start(command: str, limit: float) -> tuple[_Line, dict[str, Any]]:
    """Start the server; the line to it and its greeting."""
    listener = local_socket()
    if listener is None:
        raise KernelError("kernel.solvers.petsc-system")
    words = _words(command)
    folder = Path(tempfile.mkdtemp(prefix="ssilang-petsc-"))  # its owner's alone
    output = tempfile.TemporaryFile()  # noqa: SIM115  # it lives as long as the line
    process: subprocess.Popen[bytes] | None = None
    try:
        word = secrets.token_hex(32)
        secret = os.open(folder / "word", os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
        with open(secret, "w") as file:
            file.write(word)
        listener.bind(str(folder / "socket"))
        os.chmod(folder / "socket", 0o600)
        listener.listen(1)
        process = subprocess.Popen(
            [*words, str(SERVER), str(folder)], stdin=subprocess.DEVNULL, stdout=output,
            stderr=output, start_new_session=True,
        )  # fmt: skip
        met = _met(listener, process, time.monotonic() + limit)
        if met is None:
            raise _not_met(command, process, output, limit)
        connection, greeting = met
        _check(command, greeting, word, output)
    except BaseException as error:
        if process is not None:
            _end(process)
        if isinstance(error, OSError):
            raise KernelError(
                "kernel.solvers.petsc-not-started", command=command, fault=str(error)
            ) from None
        raise
    finally:
        listener.close()
        shutil.rmtree(folder, ignore_errors=True)
    return _Line(command, process, output, connection), greeting


def _words(command: str) -> list[str]:
    """The command's words, the first of which is a program."""
    try:
        words = shlex.split(command)
    except ValueError:
        words = []
    if not words:
        raise KernelError("kernel.solvers.petsc-command", command=command)
    if shutil.which(words[0]) is None:
        raise KernelError("kernel.solvers.petsc-program", command=command, program=words[0])
    return words


def _met(
    listener: socket.socket, process: subprocess.Popen[bytes], deadline: float
) -> tuple[socket.socket, dict[str, Any]] | None:
    """The line to the server and what it says first; None if it ended or is late."""
    listener.settimeout(0.05)
    while time.monotonic() < deadline:
        try:
            connection, _ = listener.accept()
        except TimeoutError:
            if process.poll() is not None:
                return None
            continue
        if not is_of_user(connection):
            connection.close()
            continue
        connection.settimeout(max(0.1, deadline - time.monotonic()))
        try:
            greeting, descriptors = receive(connection)
        except (OSError, ValueError):
            greeting, descriptors = {}, []
        for one in descriptors:
            os.close(one)
        connection.settimeout(None)
        return connection, greeting
    return None


def _not_met(
    command: str, process: subprocess.Popen[bytes], output: IO[bytes], limit: float
) -> KernelError:
    code = process.poll()
    if code is not None:
        told = _told(output)
        return KernelError(
            "kernel.solvers.petsc-ended-at-start", command=command, code=code, told=told
        )
    told = _told(output)
    return KernelError("kernel.solvers.petsc-late", command=command, limit=limit, told=told)


def _check(command: str, greeting: Mapping[str, Any], word: str, output: IO[bytes]) -> None:
    """Refuse what is no server of this run, or one that cannot do what is asked of it."""
    known = hmac.compare_digest(str(greeting.get("word")).encode(), word.encode())
    if not known or not isinstance(greeting.get("hosts"), dict):
        raise KernelError("kernel.solvers.petsc-strange", command=command, told=_told(output))
    if greeting.get("protocol") != PROTOCOL:
        found = str(greeting.get("protocol"))
        raise KernelError(
            "kernel.solvers.petsc-protocol", command=command, found=found, wanted=PROTOCOL
        )
    lacking = next((code for key, code in NEEDED.items() if not greeting.get(key)), None)
    if lacking is not None:
        raise KernelError(lacking, command=command, version=greeting["petsc"])


def _told(output: IO[bytes]) -> str:
    """The last lines that a server printed, each on a line of its own."""
    size = output.seek(0, os.SEEK_END)
    output.seek(max(0, size - TOLD_BYTES))
    text = output.read().decode(errors="replace")
    lines = ["".join(c for c in line if c.isprintable()).rstrip() for line in text.splitlines()]
    kept = [line for line in lines if line.strip(" -=")]  # no rulers
    return "".join(f"\n    {line[:LONGEST_LINE]}" for line in kept[-TOLD_LINES:])
