"""What starts PETSc may fail in any way: a message says how, and nothing stays behind."""

import gc
import os
import signal
import socket
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import petsc_there
import pytest
from petsc_there import COMMAND, environment, ranks
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.petsc import client, server
from ssilang.kernel.solvers.petsc.client import PetscServer
from ssilang.kernel.solvers.petsc.server import send

A = sp.csr_array(2.5 * sp.eye_array(5))
SOON = 30.0  # seconds, for processes to come and go on a busy machine

FAKE = """
import json, os, socket, struct, sys, time
mode, server, folder = sys.argv[1:]
GREETING = {"protocol": 1, "petsc": "3.18.5", "mpi": "none", "real": True, "mumps": True,
            "ranks": 1, "hosts": {}, "word": open(folder + "/word").read()}

def send(message):
    text = json.dumps(message).encode()
    line.sendall(struct.pack(">I", len(text)) + text)

if mode == "exits":
    print("libpetsc.so.3.18: cannot open shared object file")
    sys.exit(3)
if mode == "prints":
    while True:
        print("\\x1b[2J--- garbage \\x07", flush=True)
        time.sleep(0.01)
if mode == "looks":
    stats = [os.stat(p).st_mode & 0o777 for p in (folder, folder + "/word", folder + "/socket")]
    print(*(oct(s) for s in stats))
    sys.exit(0)
line = socket.socket(socket.AF_UNIX)
line.connect(folder + "/socket")
if mode == "waits":
    time.sleep(60)
if mode == "garbage":
    line.sendall(b"\\0\\0\\0\\5hello")
if mode == "endless":
    line.sendall(b"\\xff" * 1000)
    time.sleep(60)
if mode == "leaves":
    sys.exit(0)
send({**GREETING, **{"stranger": {"word": "0" * 64}, "older": {"protocol": 0},
      "complex": {"real": False}, "plain": {"mumps": False}}.get(mode, {})})
if mode == "dies":
    line.recv(1)
    print("out of memory", flush=True)
    os.kill(os.getpid(), 9)
if mode == "babbles":
    line.recv(1)
    line.sendall(b"\\0\\0\\0\\2[]")
time.sleep(60)
"""


@pytest.fixture
def fake(tmp_path, monkeypatch):
    """A command that behaves in a given way; what stays behind of files and descriptors."""
    script = tmp_path / "fake.py"
    script.write_text(FAKE)
    left = tmp_path / "tmp"
    left.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(left))
    gc.collect(1)  # what is young: a search through all that thousands of tests keep takes 0.4 s
    before = len(os.listdir("/dev/fd"))
    yield lambda mode: f"{sys.executable} {script} {mode}"
    assert list(left.iterdir()) == []
    gc.collect(1)
    if len(os.listdir("/dev/fd")) > before:
        gc.collect()
    assert len(os.listdir("/dev/fd")) <= before


def refusal(command, limit=SOON):
    with pytest.raises(KernelError) as caught:
        PetscServer(command, limit=limit).factorise(A, True)
    return caught.value.code.rpartition(".")[2], str(caught.value)


@together(
    "command, code",
    [
        ("", "petsc-command"),
        ("mpirun -n 'two", "petsc-command"),
        ("no-such-program -n 2 python3", "petsc-program"),
    ],
)
def test_a_command_that_names_no_program(command, code):
    assert refusal(command)[0] == code


def test_a_system_that_cannot_pass_files_is_told(monkeypatch):
    monkeypatch.delattr(client.socket, "send_fds")
    assert refusal("mpirun -n 2 python3")[0] == "petsc-system"


def test_a_program_that_is_none(tmp_path):
    path = tmp_path / "program"
    path.write_bytes(b"\x7fELF nothing")
    path.chmod(0o755)
    code, told = refusal(str(path))
    assert code == "petsc-not-started"
    assert "Exec format error" in told


def test_a_command_that_ends_tells_its_code_and_what_it_printed(fake):
    code, told = refusal(fake("exits"))
    assert code == "petsc-ended-at-start"
    assert "code 3" in told
    assert "libpetsc.so.3.18: cannot open shared object file" in told


def test_a_command_that_only_prints_is_ended_in_time(fake):
    for limit in (0.5, 4.0, 16.0):  # a busy machine may not have started it in half a second
        started = time.monotonic()
        code, told = refusal(fake("prints"), limit=limit)
        assert code == "petsc-late"
        assert time.monotonic() - started < SOON
        if "garbage" in told:
            break
    assert "garbage" in told
    assert "\x1b" not in told
    assert "\x07" not in told


def test_a_server_that_says_nothing_is_ended_in_time(fake):
    assert refusal(fake("waits"), limit=0.5)[0] in ("petsc-late", "petsc-strange")


@pytest.mark.parametrize(
    ("mode", "code"),
    [
        ("garbage", "petsc-strange"),
        ("endless", "petsc-strange"),
        ("leaves", "petsc-strange"),
        ("stranger", "petsc-strange"),
        ("older", "petsc-protocol"),
        ("complex", "petsc-not-real"),
        ("plain", "petsc-not-mumps"),
    ],
)
def test_what_is_no_server_of_this_run_is_refused(fake, mode, code):
    assert refusal(fake(mode))[0] == code


def test_a_server_that_dies_over_a_matrix_tells_what_it_printed(fake):
    code, told = refusal(fake("dies"))
    assert code == "petsc-ended"
    assert "out of memory" in told
    assert f"code {-signal.SIGKILL}" in told


def test_a_server_that_answers_nonsense_is_ended(fake):
    assert refusal(fake("babbles"))[0] == "petsc-ended"


def test_socket_and_word_are_for_this_user_alone(fake):
    assert "0o700 0o600 0o600" in refusal(fake("looks"))[1]


def test_another_user_is_not_heard(fake, monkeypatch):
    monkeypatch.setattr(client, "is_of_user", lambda connection: False)
    assert refusal(fake("greets"), limit=1.0)[0] in ("petsc-late", "petsc-ended-at-start")


@pytest.mark.skipif(not hasattr(socket, "MSG_NOSIGNAL"), reason="not on this system")
@pytest.mark.parametrize("descriptors", [(), (0,)])
def test_a_line_that_is_broken_does_not_end_a_program_that_lets_pipes_end_it(descriptors):
    ours, other = socket.socketpair()
    other.close()
    before = signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # as gmsh leaves it
    try:
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGPIPE])
        with pytest.raises(BrokenPipeError):
            send(ours, {"do": "quit"}, descriptors)
        assert signal.SIGPIPE not in signal.sigpending()
    finally:
        signal.signal(signal.SIGPIPE, before)  # what is pending is ignored
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGPIPE])
        ours.close()


def test_memory_has_no_name_and_is_for_this_user_alone():
    descriptor = client._memory(1 << 16)
    try:
        found = os.fstat(descriptor)
        assert (found.st_nlink, found.st_mode & 0o777, found.st_uid) == (0, 0o600, os.getuid())
    finally:
        os.close(descriptor)


def test_memory_that_is_not_there_is_not_taken(monkeypatch):
    monkeypatch.setattr(client, "fits", lambda size: False)
    with pytest.raises(MemoryError):
        client._memory(1 << 16)


def test_ranks_share_the_memory_of_their_machine(monkeypatch):
    files = {
        "/proc/meminfo": ["MemTotal: 9 kB", "MemAvailable: 5 kB"],
    }
    files |= {"/proc/self/cgroup": ["0::/job"], "/sys/fs/cgroup/job/memory.max": ["9000"]}
    files |= {"/sys/fs/cgroup/job/memory.current": ["10"]}
    monkeypatch.setattr(server, "lines_of", lambda path: files.get(path, []))
    assert server.free_bytes() == 5 * 1024
    files["/proc/meminfo"][1] = "MemAvailable: 9 kB"
    assert server.free_bytes() == 8990
    told = [("one", 6e9, 1e9), ("other", 4.5e9, 2e9), ("one", 5e9, 4e9)]
    comm = SimpleNamespace(
        gather=lambda mine, root: told, allgather=lambda mine: [row[:2] for row in told]
    )
    factors = server.Factors(None, SimpleNamespace(comm=comm), "one")
    assert factors.hosts() == {
        "hosts": {"one": {"ranks": 2, "free": 5e9, "most": 5e9},
                  "other": {"ranks": 1, "free": 4.5e9, "most": 2e9}},
        "factors": 0,
    }  # fmt: skip
    assert factors.room() == pytest.approx(server.SHARE * 2.5e9)
    told.clear()  # as other ranks are told
    assert factors.hosts()["hosts"] == {}


# --- the real server


there = pytest.mark.usefixtures("petsc_is_there")


@pytest.fixture
def mpi(monkeypatch):
    for name, value in environment().items():
        monkeypatch.setenv(name, value)
    before = left_behind()
    yield
    gone(lambda: not ranks())
    gone(lambda: left_behind() <= before)


def left_behind():
    """Shared memory with a name that no process has mapped, and our folders of temporary files."""
    mapped = set()
    for maps in Path("/proc").glob("[0-9]*/maps"):
        with suppress(OSError):
            mapped |= {line.split()[-1] for line in maps.read_text().splitlines() if line}
    ours = Path(tempfile.gettempdir()).glob("ssilang-petsc-*")
    return {str(path) for path in Path("/dev/shm").glob("*")} - mapped | {*map(str, ours)}


def gone(condition):
    end = time.monotonic() + SOON
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def other_rank(server):
    """A process of the server that is not the one we talk to."""
    first = server._line.connection.getsockopt(1, 17, 4)  # SO_PEERCRED names who connected
    return next(pid for pid in ranks() if pid != int.from_bytes(first, sys.byteorder))


@there
def test_a_python_without_petsc_says_what_it_lacks(mpi):
    python = f"{sys.executable} -S"
    code, told = refusal(f"mpirun -n 2 {python}")
    assert code == "petsc-ended-at-start"
    assert "ModuleNotFoundError" in told


@there
def test_a_rank_killed_between_two_solves_ends_the_server(mpi):
    server = PetscServer(COMMAND)
    factor = server.factorise(A, True)
    os.kill(other_rank(server), signal.SIGKILL)
    with pytest.raises(KernelError, match="a process or a machine was lost") as caught:
        factor.solve(np.ones(5))
    assert "signal 9" in str(caught.value)
    assert factor.lost


@there
def test_a_rank_killed_during_a_solve_ends_the_server(mpi):
    server = PetscServer(COMMAND)
    factor = server.factorise(A, True)
    victim = other_rank(server)
    os.kill(victim, signal.SIGSTOP)  # the solve waits for it
    killer = threading.Timer(0.2, os.kill, (victim, signal.SIGKILL))
    killer.start()
    with pytest.raises(KernelError, match="a process or a machine was lost"):
        factor.solve(np.ones(5))
    killer.join()


@pytest.fixture
def heeded():
    """Ctrl-C interrupts, also where whoever started the tests had it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@there
def test_an_interruption_during_a_solve_ends_the_server(mpi, heeded):
    server = PetscServer(COMMAND)
    factor = server.factorise(A, True)
    os.kill(other_rank(server), signal.SIGSTOP)
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        factor.solve(np.ones(5))
    assert factor.lost


CLIENT = """
import os, signal, sys
import numpy as np
sys.path[:0] = sys.argv[2:]
import petsc_there
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.petsc.client import PetscServer
from ssilang.kernel.solvers.petsc.server import send
server = PetscServer(petsc_there.COMMAND)
factor = server.factorise(sp.csr_array(2.0 * sp.eye_array(4)), True)
if sys.argv[1] == "busy":
    first = int.from_bytes(server._line.connection.getsockopt(1, 17, 4), sys.byteorder)
    os.kill(next(p for p in petsc_there.ranks() if p != first), signal.SIGSTOP)
print(*petsc_there.ranks(), flush=True)
factor.solve(np.ones(4)) if sys.argv[1] == "busy" else signal.pause()
"""


@there
@pytest.mark.parametrize("doing", ["idle", "busy"])
def test_a_client_that_is_killed_leaves_no_rank_and_no_memory(mpi, doing, tmp_path):
    script = tmp_path / "client.py"
    script.write_text(textwrap.dedent(CLIENT))
    # not by PYTHONPATH, which PETSc's Python would read too
    here = [str(Path(petsc_there.__file__).parent), str(Path(client.__file__).parents[4])]
    process = subprocess.Popen(
        [sys.executable, str(script), doing, *here], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    started = [int(pid) for pid in process.stdout.readline().split()]
    assert len(started) == 2
    time.sleep(0.2)  # it asks for a solution
    process.kill()
    process.wait()
    gone(lambda: not any(Path(f"/proc/{pid}").exists() for pid in started))


@there
def test_a_server_whose_client_is_gone_removes_what_it_left(mpi, tmp_path):
    folder = tmp_path / "left"
    folder.mkdir()
    (folder / "word").write_text("a" * 64)
    (folder / "socket").touch()
    words = [*COMMAND.split(), str(client.SERVER), str(folder)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=4 * SOON)
    assert done.returncode != 0
    assert not folder.exists()
