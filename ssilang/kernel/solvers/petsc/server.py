"""PETSc over MPI as a server of one run: it takes matrices, keeps their factors, solves.

    mpirun -n 4 /usr/bin/python3 server.py FOLDER

This file runs without ssilang, on Python 3.9 with numpy, mpi4py and petsc4py. `client.py` starts
it. FOLDER, which only its owner may enter, holds a socket and a random word that shows the client
whom it talks to. Rank 0, on the client's machine, connects; both names are gone from then on.
Commands and replies are JSON behind their length; arrays come as files without a name whose
descriptors go through the socket, so that no end of any process leaves memory behind.

Rank 0 hands rows out by MPI. The other ranks wait for it without taking a core. When the client
ends, so does the server, in the middle of a factorisation as well.
"""

import array
import glob
import json
import mmap
import os
import select
import signal
import socket
import struct
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

Message = dict[str, Any]
Array = Any  # of numpy
Arrays = dict[str, Array]

PROTOCOL = 1
LONGEST = 1 << 20  # bytes of a command
PIECE = 1 << 27  # numbers that one message of MPI takes
PATIENCE, IDLE = 1e-4, 0.01  # seconds of looking for a command all the time; between looks, at most
MEGABYTE = 1e6
SHARE = 0.8  # of the free memory, for factors
RESIDUAL = 1e-12  # of the second member, where a solution is iterated
MOST_TURNS = 500
NO_MEMORY = frozenset({-5, -7, -8, -9, -11, -13, -14, -15, -17, -18, -19, -20})  # of MUMPS
NOT_GIVEN = -13
SINGULAR = frozenset({-6, -10, -40})
NOWHERE = "PETSc is not asked on Windows"  # the client says so before


class Refused(Exception):
    """A matrix or second member that is not taken, the same on all ranks: a word and its data."""

    def __init__(self, word: str, **data: object) -> None:
        super().__init__(word)
        self.reply = {"refused": word, **data}


# --- the client's side: one socket, at rank 0


def connect(folder: str) -> tuple[socket.socket, str]:
    """The client's socket, and the word that it knows us by.

    Raises
    ------
    OSError
        If nobody listens: the client has ended. What it left is removed.
    """
    if sys.platform == "win32":
        raise OSError(NOWHERE)
    place, secret = os.path.join(folder, "socket"), os.path.join(folder, "word")
    line = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        with open(secret) as file:
            word = file.read()
        line.connect(place)
    except OSError:
        for name in (place, secret):
            if os.path.exists(name):
                os.unlink(name)
        if os.path.isdir(folder):
            os.rmdir(folder)
        raise
    return line, word


def receive(line: socket.socket) -> tuple[Message, list[int]]:
    """The next message and the descriptors that came with it; no message if the line ended."""
    if sys.platform == "win32":
        raise OSError(NOWHERE)
    head, descriptors = b"", []
    while len(head) < 4:
        got, new, _, _ = socket.recv_fds(line, 4 - len(head), 4)
        descriptors += new
        if not got:
            return {}, descriptors
        head += got
    (length,) = struct.unpack(">I", head)
    if length > LONGEST:
        raise ValueError(f"a message of {length} bytes")
    text = b""
    while len(text) < length:
        got = line.recv(length - len(text))
        if not got:
            return {}, descriptors
        text += got
    message = json.loads(text)
    if not isinstance(message, dict):
        raise ValueError("a message that is no record")
    return message, descriptors


def send(line: socket.socket, message: Message, descriptors: tuple[int, ...] = ()) -> None:
    """Send a message with descriptors.

    Raises
    ------
    OSError
        If nobody is at the other end, also in programs that let a broken pipe end them (gmsh does).
    """
    if sys.platform == "win32":
        raise OSError(NOWHERE)
    text, quiet = json.dumps(message).encode(), getattr(socket, "MSG_NOSIGNAL", 0)
    whole = struct.pack(">I", len(text)) + text
    # not `send_fds`, which leaves out the flags
    beside = [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", descriptors))]
    sent = line.sendmsg([whole], beside if descriptors else [], quiet)
    line.sendall(whole[sent:], quiet)


def end_with(line: socket.socket, on: bool) -> None:
    """Let the system end this process, and by it all ranks, when the client ends (SIGIO)."""
    if sys.platform == "win32":
        raise OSError(NOWHERE)
    import fcntl  # the client imports this file, on any system

    flags = fcntl.fcntl(line, fcntl.F_GETFL)
    fcntl.fcntl(line, fcntl.F_SETOWN, os.getpid())
    fcntl.fcntl(line, fcntl.F_SETFL, flags | os.O_ASYNC if on else flags & ~os.O_ASYNC)
    if on and select.select([line], [], [], 0.0)[0]:  # it ended before
        os.kill(os.getpid(), signal.SIGIO)


# --- what all ranks know


class Ranks:
    """The processes: rows of each, what they tell each other."""

    def __init__(self, comm: Any) -> None:
        self.comm = comm
        self.rank, self.size = comm.Get_rank(), comm.Get_size()

    def told(self, text: bytes | None) -> bytes:
        """What rank 0 says, at all ranks; the others look for it ever less often."""
        length = np.array([0 if text is None else len(text)], np.int64)
        request, start = self.comm.Ibcast(length, root=0), time.monotonic()
        while not request.Test():
            waited = time.monotonic() - start
            if waited > PATIENCE:
                time.sleep(min(IDLE, 0.1 * waited))
        buffer = np.empty(length[0], np.uint8)
        if text is not None:
            buffer[:] = np.frombuffer(text, np.uint8)
        self.comm.Bcast(buffer, root=0)
        return buffer.tobytes()

    def bounds(self, n: int) -> Array:
        """First row of each rank, and n."""
        return np.array([n * r // self.size for r in range(self.size + 1)], np.int64)

    def part(self, whole: Array, bounds: Array, dtype: type) -> Array:
        """This rank's stretch, between its bounds, of an array (n,) that rank 0 has."""
        return self.columns(None if whole is None else whole[None, :], 1, bounds, dtype)[0]

    def columns(self, whole: Array, count: int, bounds: Array, dtype: type) -> Array:
        """This rank's stretches (count, m) of columns (count, n) that rank 0 has."""
        if self.rank == 0:
            for r in range(1, self.size):
                stretch: Array = np.ascontiguousarray(whole[:, bounds[r] : bounds[r + 1]], dtype)
                for piece in pieces(stretch):
                    self.comm.Send(piece, dest=r)
            return np.array(whole[:, : bounds[1]], dtype, order="C")
        mine = np.empty((count, bounds[self.rank + 1] - bounds[self.rank]), dtype)
        for piece in pieces(mine):
            self.comm.Recv(piece, source=0)
        return mine

    def gather(self, mine: Array, bounds: Array, into: Array) -> None:
        """Write the stretches of all ranks into columns of rank 0."""
        if self.rank != 0:
            for piece in pieces(mine):
                self.comm.Send(piece, dest=0)
            return
        into[:, : bounds[1]] = mine
        for r in range(1, self.size):
            stretch = np.empty((len(mine), bounds[r + 1] - bounds[r]))
            for piece in pieces(stretch):
                self.comm.Recv(piece, source=r)
            into[:, bounds[r] : bounds[r + 1]] = stretch


def pieces(array: Array) -> list[Array]:
    """An array in pieces that fit a message of MPI, in order; writing to them writes to it."""
    flat = array.reshape(-1)
    return [flat[at : at + PIECE] for at in range(0, len(flat), PIECE)]


def free_bytes() -> float:
    """Memory that the processes of this machine may still take; infinity if unknown."""
    found = [float("inf")]
    for line in lines_of("/proc/meminfo"):
        if line.startswith("MemAvailable:"):
            found.append(1024.0 * float(line.split()[1]))
    for line in lines_of("/proc/self/cgroup"):  # a batch system gives a job a group of its own
        group = "/sys/fs/cgroup" + line.strip().partition("::")[2]
        limits = [*lines_of(group + "/memory.max"), *lines_of(group + "/memory.current")]
        if len(limits) == 2 and limits[0].strip() != "max":
            found.append(float(limits[0]) - float(limits[1]))
    return min(found)


def lines_of(path: str) -> list[str]:
    """The lines of a file, none if it cannot be read."""
    try:
        with open(path) as file:
            return file.readlines()
    except OSError:
        return []


def most_bytes() -> float:
    """The most memory that this process has held."""
    if sys.platform == "win32":
        raise OSError(NOWHERE)
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)


class Factors:
    """Matrices that are factorised, on all ranks."""

    def __init__(self, petsc: Any, ranks: Ranks, host: str) -> None:
        self.petsc, self.ranks, self.host = petsc, ranks, host
        self.kept: dict[int, tuple[Any, bool, tuple[int, int]]] = {}

    def hosts(self) -> Message:
        """The machines with their ranks and memory, at rank 0."""
        told = self.ranks.comm.gather((self.host, free_bytes(), most_bytes()), root=0)
        found: dict[str, Message] = {}
        for host, free, most in told or ():
            one = found.setdefault(host, {"ranks": 0, "free": free, "most": 0.0})
            one["ranks"] += 1
            one["free"] = min(free, one["free"])
            one["most"] += most
        return {"hosts": found, "factors": len(self.kept)}

    def room(self) -> float:
        """Bytes that each rank may take: what is free on the tightest machine, shared."""
        told = self.ranks.comm.allgather((self.host, free_bytes()))
        names = [host for host, _ in told]
        return SHARE * float(min(free / names.count(host) for host, free in told))

    def factorise(self, command: Message, arrays: Arrays | None) -> Message:
        """Take a matrix and make its factor, or multigrid where memory would not hold one."""
        n, bounds = command["n"], self.ranks.bounds(command["n"])
        A = self.matrix(command, bounds, arrays)
        try:
            reply = self.direct(command, A)
            if "needed" in reply:
                if not command["positive"]:
                    raise Refused("memory", n=n, **reply)
                reply = self.multigrid(command, A, bounds, arrays)
            return {**reply, **self.hosts()}
        finally:
            A.destroy()  # what is kept holds its own reference

    def matrix(self, command: Message, bounds: Array, arrays: Arrays | None) -> Any:
        """The matrix, its rows on their ranks."""
        PETSc, n, ranks = self.petsc, command["n"], self.ranks
        most = np.iinfo(PETSc.IntType).max
        pointers = None if arrays is None else arrays["indptr"]
        ends = ranks.comm.bcast(None if pointers is None else pointers[bounds].copy(), root=0)
        if n > most or np.diff(ends).max(initial=0) > most:
            raise Refused("indices", n=n)
        first = ranks.part(pointers, bounds, np.int64)
        indptr = np.append(first, ends[ranks.rank + 1]) - ends[ranks.rank]
        indices = ranks.part(None if arrays is None else arrays["indices"], ends, PETSc.IntType)
        data = ranks.part(None if arrays is None else arrays["data"], ends, np.float64)
        rows = int(bounds[ranks.rank + 1] - bounds[ranks.rank])
        A = PETSc.Mat().createAIJ(
            ((rows, n), (rows, n)), csr=(indptr.astype(PETSc.IntType), indices, data),
            comm=ranks.comm,
        )  # fmt: skip
        if command["symmetric"]:
            A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        if command["positive"]:
            A.setOption(PETSc.Mat.Option.SPD, True)
        return A

    def mumps(self, command: Message, A: Any, room: float) -> Any:
        """What MUMPS makes of a matrix, with so many bytes a rank at most; its INFOG says more."""
        pc = self.petsc.PC().create(self.ranks.comm)
        pc.setOperators(A)
        pc.setType("cholesky" if command["symmetric"] else "lu")
        pc.setFactorSolverType("mumps")
        pc.setFactorSetUpSolverType()
        factor = pc.getFactorMatrix()
        if np.isfinite(room):
            factor.setMumpsIcntl(23, max(1, int(room / MEGABYTE)))
        pc.setUp()
        pc.destroy()  # the factor stays
        return factor

    def direct(self, command: Message, A: Any) -> Message:
        """LL^T, LDL^T or LU by MUMPS; the memory it wants, if that is not there."""
        room = self.room()
        room = min(room, command["room"] or room)
        factor = self.mumps(command, A, room)
        if factor.getMumpsInfog(1) == NOT_GIVEN and MEGABYTE * factor.getMumpsInfog(16) <= room:
            # told its room, MUMPS asks for all of it, which some systems do not promise
            factor.destroy()
            factor = self.mumps(command, A, np.inf)
        said, second = factor.getMumpsInfog(1), factor.getMumpsInfog(2)
        negative = command["positive"] and factor.getMumpsInfog(12) > 0
        if said >= 0 and not negative:
            self.kept[command["factor"]] = (factor, True, A.getSizes()[0])
            return {"name": "PETSc MUMPS", "bytes": MEGABYTE * factor.getMumpsInfog(22)}
        needed = MEGABYTE * factor.getMumpsInfog(17)
        factor.destroy()
        if said in NO_MEMORY:
            return {"needed": needed, "room": room * self.ranks.size}
        if said in SINGULAR or negative:
            raise Refused("singular")
        raise Refused("mumps", said=said, second=second)

    def multigrid(self, command: Message, A: Any, bounds: Array, arrays: Arrays | None) -> Message:
        """Conjugate gradients with smoothed aggregation (GAMG)."""
        PETSc, ranks = self.petsc, self.ranks
        diagonal = A.getDiagonal()
        least = diagonal.min()[1]
        diagonal.destroy()
        if least <= 0.0:
            raise Refused("singular")
        vectors = []
        for k in range(command["rigid"]):
            vector = A.createVecRight()
            column = None if arrays is None else arrays["rigid"][k]
            vector.setArray(ranks.part(column, bounds, np.float64))
            vectors.append(vector)
        if vectors:
            motions = PETSc.NullSpace().create(vectors=vectors, comm=ranks.comm)
            A.setNearNullSpace(motions)
            for one in (motions, *vectors):
                one.destroy()
        ksp = PETSc.KSP().create(ranks.comm)
        ksp.setOperators(A)
        ksp.setType("cg")
        ksp.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
        ksp.setTolerances(RESIDUAL, 0.0, 1e10, MOST_TURNS)
        ksp.getPC().setType("gamg")
        ksp.setUp()
        self.kept[command["factor"]] = (ksp, False, A.getSizes()[0])
        return {"name": "PETSc GAMG", "bytes": None}

    def solve(self, command: Message, arrays: Arrays | None) -> Message:
        """Solve for the columns that stand in the shared memory, in place."""
        how, direct, (rows, n) = self.kept[command["factor"]]
        count, bounds = command["columns"], self.ranks.bounds(n)
        shared = None if arrays is None else arrays["columns"]
        mine = self.ranks.columns(shared, count, bounds, np.float64)
        if direct:
            self.substituted(how, mine, rows, n)
        else:
            for column in mine:
                self.iterate(how, column)
        self.ranks.gather(mine, bounds, shared)
        return {"solved": count}

    def substituted(self, factor: Any, columns: Array, rows: int, n: int) -> None:
        """Solve for columns (k, rows) with a factor, in place."""
        PETSc, comm, count = self.petsc, self.ranks.comm, len(columns)
        if count == 1:
            b = PETSc.Vec().createWithArray(columns[0].copy(), size=(rows, n), comm=comm)
            x = PETSc.Vec().createWithArray(columns[0], size=(rows, n), comm=comm)
            factor.solve(b, x)
        else:
            size = ((rows, n), (PETSc.DECIDE, count))
            b = PETSc.Mat().createDense(size, array=columns.copy().T, comm=comm)
            x = PETSc.Mat().createDense(size, array=columns.T, comm=comm)
            for one in (b, x):
                one.assemble()
            factor.matSolve(b, x)
        for one in (b, x):
            one.destroy()

    def iterate(self, ksp: Any, column: Array) -> None:
        """Solve for a column (rows,) by conjugate gradients, in place."""
        x, b = ksp.getOperators()[0].createVecs()
        b.setArray(column)
        ksp.solve(b, x)
        column[:], reason = x.getArray(), ksp.getConvergedReason()
        for one in (b, x):
            one.destroy()
        if reason < 0:
            raise Refused("turns", turns=MOST_TURNS)

    def drop(self, numbers: list[int]) -> None:
        """Forget factors."""
        for number in numbers:
            if number in self.kept:
                self.kept.pop(number)[0].destroy()


# --- the shared memory, at rank 0


def mapping(descriptor: int) -> mmap.mmap:
    """The memory behind a descriptor, which is closed."""
    try:
        return mmap.mmap(descriptor, os.fstat(descriptor).st_size)
    finally:
        os.close(descriptor)


def arrays_of(memory: mmap.mmap, layout: list[Any]) -> Arrays:
    """The arrays that a command says to lie there: name, type, shape, first byte."""
    return {
        name: np.ndarray(shape, np.dtype(kind), buffer=memory, offset=at)
        for name, kind, shape, at in layout
    }


class Desk:
    """Rank 0's end of the line: the next command with its arrays."""

    def __init__(self, line: socket.socket) -> None:
        self.line = line
        self.columns: mmap.mmap | None = None  # of vectors, kept from solve to solve

    def next(self) -> tuple[Message, Arrays | None]:
        """A command; one to quit where the client has ended."""
        command, descriptors = receive(self.line)
        if not command:
            return {"do": "quit"}, None
        memory = mapping(descriptors[0]) if descriptors else None
        if command["do"] == "solve":
            self.columns = memory or self.columns
            memory = self.columns
        return command, None if memory is None else arrays_of(memory, command["arrays"])


def import_petsc() -> Any:
    """The package petsc4py; Debian keeps it apart unless the headers are installed too."""
    try:
        import petsc4py
    except ImportError:
        places = glob.glob("/usr/lib/petscdir/petsc*/*-real/lib/python3/dist-packages")
        if not places:
            raise
        sys.path.append(sorted(places)[-1])
        import petsc4py
    # options come by PETSC_OPTIONS: a .petscrc of the folder could be anybody's, and writes files
    petsc4py.init(["ssilang", "-skip_petscrc"])
    from petsc4py import PETSc

    return PETSc


def greeting(PETSc: Any, ranks: Ranks, word: str) -> Message:
    """What the client is told first."""
    from mpi4py import MPI

    return {
        "protocol": PROTOCOL,
        "word": word,
        "petsc": ".".join(str(n) for n in PETSc.Sys.getVersion()),
        "mpi": MPI.Get_library_version().split(",")[0].strip("\0\n "),
        "real": np.dtype(PETSc.ScalarType) == np.dtype(np.float64),
        "mumps": bool(PETSc.Sys.hasExternalPackage("mumps")),
        "index_bits": 8 * np.dtype(PETSc.IntType).itemsize,
        "ranks": ranks.size,
    }


COMMANDS: dict[str, Callable[[Factors, Message, Arrays | None], Message]] = {
    "factorise": Factors.factorise,
    "solve": Factors.solve,
    "hosts": lambda factors, command, arrays: factors.hosts(),
}


def serve(desk: Desk | None, ranks: Ranks, factors: Factors) -> None:
    """Do what comes until the client has enough."""
    while True:
        command: Message = {}
        arrays, text = None, None
        if desk is not None:
            command, arrays = desk.next()
            text = json.dumps(command).encode()
        command = json.loads(ranks.told(text))
        factors.drop(command.get("drop", []))
        if command["do"] == "quit":
            return
        if desk is not None:
            end_with(desk.line, True)
        try:
            reply = COMMANDS[command["do"]](factors, command, arrays)
        except Refused as refusal:
            reply = refusal.reply
        arrays = None  # its memory goes back
        if desk is not None:
            end_with(desk.line, False)
            send(desk.line, reply)


def main(folder: str) -> None:
    """Greet the client and serve it; whatever fails on one rank ends all."""
    if sys.platform == "win32":
        raise OSError(NOWHERE)
    import resource

    from mpi4py import MPI

    comm = MPI.COMM_WORLD
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)  # a limit of the client's is its own
    resource.setrlimit(resource.RLIMIT_DATA, (hard, hard))
    try:
        ranks = Ranks(comm)
        PETSc = import_petsc()
        signal.signal(signal.SIGIO, signal.SIG_DFL)
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_DFL)
        desk, factors = None, Factors(PETSc, ranks, MPI.Get_processor_name())
        hosts = factors.hosts()
        if ranks.rank == 0:
            line, word = connect(folder)
            send(line, {**greeting(PETSc, ranks, word), **hosts})
            desk = Desk(line)
        serve(desk, ranks, factors)
    except BaseException:
        import traceback

        traceback.print_exc()
        sys.stderr.flush()
        comm.Abort(1)


if __name__ == "__main__":
    main(sys.argv[1])
