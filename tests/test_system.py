"""Other systems: their types, and the program without what POSIX alone has.

A child process gets a Python from which these names are gone, and in which a file that is open can
be neither replaced nor removed, as on Windows. Windows' own locks are played by those of POSIX.
"""

import ast
import csv
import errno
import io
import os
import re
import signal
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import mypy
import pytest
from script_runs import HOPPING
from together import together

import ssilang
from ssilang import system
from ssilang.cli.main import main
from ssilang.io import atomic
from ssilang.io.atomic import fault_on_windows
from ssilang.io.errors import OutputError
from ssilang.io.run_output import RunOutput
from ssilang.io.vtk.growing import GrowingFile
from ssilang.messages.message import sentence

_ROOT = Path(ssilang.__file__).parent
_FREE = {
    _ROOT / "system.py",
    _ROOT / "kernel" / "solvers" / "petsc" / "server.py",  # runs alone, on clusters' own Python
    _ROOT / "io" / "mesh_files" / "gmsh_alone.py",  # runs alone, holds itself by Linux's means
}
MODULES = frozenset(["fcntl", "grp", "pty", "pwd", "resource", "termios", "tty", "posix", "syslog"])
NAMES = frozenset(
    """
    fork forkpty killpg pread pwrite getuid geteuid getgid getegid getpgid setpgid setsid
    setuid sched_getaffinity sched_setaffinity register_at_fork memfd_create fchmod fchown
    chown mkfifo openpty posix_fallocate sendfile getloadavg getrusage getrlimit setrlimit
    sysconf statvfs O_NOFOLLOW O_CLOEXEC O_NONBLOCK O_ASYNC O_DIRECTORY AF_UNIX SCM_RIGHTS
    SO_PEERCRED send_fds recv_fds sendmsg recvmsg SIGHUP SIGKILL SIGIO SIGALRM SIGUSR1 SIGUSR2
    SIGPIPE SIGQUIT SIGCHLD setitimer alarm PROT_READ MAP_SHARED MAP_PRIVATE
    """.split()  # noqa: SIM905  # a list would take a screen
)
WORDS = re.compile(rf"\b({'|'.join(MODULES | NAMES)})\b")  # most modules have none of them


def used(path: Path) -> set[str]:
    """The names of POSIX alone that a module uses."""
    text, found = path.read_text(encoding="utf-8"), set[str]()
    if not WORDS.search(text):
        return found
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Attribute):
            found.add(node.attr)
        elif isinstance(node, ast.ImportFrom):
            found |= {node.module or "", *(alias.name for alias in node.names)} - {""}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("getattr", "hasattr"):
            found |= {a.value for a in node.args if isinstance(a, ast.Constant)}
    # a function of ours is called as the module of resources is
    said = {"resource"} if re.search(r"^\s*import resource\b", text, re.MULTILINE) else set()
    return found & (MODULES - {"resource"} | NAMES) | said


def test_what_posix_alone_has_stands_in_one_module():
    found = {p: used(p) for p in _ROOT.rglob("*.py") if p not in _FREE}
    assert not {str(p): names for p, names in found.items() if names}
    assert {"geteuid", "sched_getaffinity", "memfd_create", "O_NOFOLLOW"} <= used(
        _ROOT / "system.py"
    )


@cache
def dependent_modules() -> frozenset[str]:
    """Modules of the standard library whose types are not the same on all systems."""
    stubs = Path(mypy.__file__).parent / "typeshed" / "stdlib"
    return frozenset(
        p.relative_to(stubs).parts[0].removesuffix(".pyi")
        for p in stubs.rglob("*.pyi")
        if "sys.platform" in p.read_text(encoding="utf-8")
    )


def imported(path: Path) -> set[str]:
    """The first parts of what a module imports."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {a.name.partition(".")[0] for a in node.names}
        elif isinstance(node, ast.ImportFrom):
            found.add((node.module or "").partition(".")[0])
    return found


@cache
def dependent() -> tuple[str, ...]:
    """Files of the package that use a module whose types are not the same on all systems."""
    said = re.compile(rf"^\s*(from|import)\s.*\b({'|'.join(dependent_modules())})\b", re.MULTILINE)
    near = [p for p in sorted(_ROOT.rglob("*.py")) if said.search(p.read_text(encoding="utf-8"))]
    return tuple(str(p) for p in near if imported(p) & dependent_modules())


def type_errors(platform: str, bad: Path) -> list[str]:
    """What mypy finds on a system in modules that use what differs, each by itself alone.

    What Linux has and Windows lacks is told there: of a third system those modules are looked at
    which ask for the name of theirs, and so have lines that are never Windows'.
    """
    files = dependent()
    if platform == "darwin":
        files = tuple(f for f in files if "sys.platform" in Path(f).read_text(encoding="utf-8"))
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", str(bad.with_name("mypy.ini")),
         "--platform", platform, "--follow-imports", "skip", "--ignore-missing-imports",
         "--check-untyped-defs", "--python-version", "3.11", "--cache-dir", os.devnull,
         "--no-error-summary", *files, str(bad)],
        cwd=_ROOT.parent, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    return [line for line in done.stdout.splitlines() if ": error:" in line]


@pytest.fixture(scope="module")
def bad(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A module that has a fault on other systems."""
    path = tmp_path_factory.mktemp("types") / "bad.py"
    path.write_text("import os\nos.sched_getaffinity(0)\n")
    # what arrays and windows are is the same everywhere, and their types take most of the time
    path.with_name("mypy.ini").write_text(
        "[mypy]\n[mypy-numpy.*,scipy.*,matplotlib.*,vtkmodules.*,PIL.*,lsprotocol.*,pygls.*,dask.*,pandas.*]\n"
        "follow_imports = skip\nfollow_imports_for_stubs = true\n"
    )
    return path


@pytest.fixture(scope="module")
def here(bad: Path) -> list[str]:
    """What is found on Linux: what another module says is not known, so that some is."""
    return type_errors("linux", bad)


@pytest.mark.long
@pytest.mark.parametrize("platform", ["win32", "darwin"])
def test_types_hold_on_other_systems(platform, bad, here):
    """A whole look at the types takes ten times as long; machines of other systems have it."""
    found = [e for e in type_errors(platform, bad) if e not in here]
    assert len(found) == 1, "\n".join(found)
    assert f"{bad}:2" in found[0]


# ---- the program without these names ------------------------------------------------------------

_AWAY = f"""
import os, signal, socket, sys
import fcntl, types

locks = types.ModuleType("msvcrt")
locks.LK_NBLCK = 2
def locking(handle, mode, count, lockf=fcntl.lockf, flags=fcntl.LOCK_EX | fcntl.LOCK_NB):
    try:
        lockf(handle, flags, count, os.lseek(handle, 0, os.SEEK_CUR))
    except BlockingIOError as error:
        raise PermissionError(13, "Permission denied") from error
locks.locking = locking
for name in {sorted(MODULES - {"posix"})}:
    sys.modules[name] = None
for name in {sorted(NAMES)}:
    for module in (os, signal, socket):
        if hasattr(module, name):
            delattr(module, name)

def is_open(path):
    try:
        there = os.stat(path)
    except OSError:
        return False
    for number in os.listdir("/proc/self/fd"):
        try:
            if os.path.samestat(os.stat("/proc/self/fd/" + number), there):
                return True
        except OSError:
            pass
    return False

def shut(name, count):
    own = getattr(os, name)
    def refusing(*paths, **more):
        for path in paths[:count]:
            if is_open(path):
                raise PermissionError(13, "The process cannot access the file", str(path))
        return own(*paths, **more)
    setattr(os, name, refusing)
for name, count in (("replace", 2), ("rename", 2), ("unlink", 1), ("remove", 1)):
    shut(name, count)
import ssilang.system
sys.modules["msvcrt"] = locks  # not before: subprocess would take the system for Windows
"""


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment of a Python without the names of POSIX."""
    folder = tmp_path_factory.mktemp("bare")
    (folder / "sitecustomize.py").write_text("import subprocess\n" + _AWAY)
    paths = os.pathsep.join([str(folder), str(_ROOT.parent)])
    return os.environ | {"PYTHONPATH": paths}


def started(bare: dict[str, str], folder: Path, *arguments: str) -> subprocess.Popen[str]:
    """The program on its way in such a Python."""
    return subprocess.Popen(
        [sys.executable, "-m", "ssilang.cli.main", *arguments],
        cwd=folder, env=bare, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def ran(bare: dict[str, str], folder: Path, *arguments: str, code: int = 0) -> str:
    """What the program tells there."""
    process = started(bare, folder, *arguments)
    out, err = process.communicate(timeout=240)
    assert process.returncode == code, out + err
    assert "Traceback" not in out + err
    return out + err


LONG = HOPPING.format(dt=1e-3, end=10.0, every=100, steps=200)


def state(folder: Path) -> dict[str, bytes]:
    """Results that do not name the time or place of a run."""
    found = {p.name: p.read_bytes() for p in folder.iterdir() if p.suffix in (".csv", ".vtkhdf")}
    assert {Path(n).suffix for n in found} == {".csv", ".vtkhdf"}
    return found


def test_a_killed_run_goes_on_without_posix(bare, tmp_path):
    """To the files of a run that has all; its folder is held as long as it lives."""
    (tmp_path / "case.ssi").write_text(LONG)
    process = started(bare, tmp_path, "case.ssi")
    there = tmp_path / "results" / "case"
    limit = time.monotonic() + 240
    while not (there / "checkpoints" / "1.state").exists() and time.monotonic() < limit:
        assert process.poll() is None, process.communicate()
        time.sleep(0.005)
    process.send_signal(signal.SIGSTOP)
    told = ran(bare, tmp_path, "case.ssi", code=1)
    assert "another run" in told
    assert str(process.pid) in told
    process.kill()
    process.communicate()
    assert (there / ".running").exists()
    assert "goes on behind step" in ran(bare, tmp_path, "case.ssi", "--resume")
    assert not (there / ".running").exists()
    ran(dict(os.environ), tmp_path, "case.ssi", "--out", "truth")
    assert state(there) == state(tmp_path / "truth")
    names = [sorted(p.name for p in f.iterdir()) for f in (there, tmp_path / "truth")]
    assert names[0] == names[1]
    assert '"peak_memory_mb": null' in (there / "summary.json").read_text()


def test_a_sweep_needs_no_forks(bare, tmp_path):
    (tmp_path / "case.ssi").write_text(
        "AG = 0.3 ; T = TABL ; @VERIFIE T 'square' (AG * AG) 0. 100. ;"
    )
    values = ",".join(f"{n}.5" for n in range(9))  # enough that forks would be made
    ran(bare, tmp_path, "sweep", "case.ssi", "--set", f"AG={values}", "--jobs", "2")
    table = next((tmp_path / "results").rglob("*.csv"))
    rows = list(csv.DictReader(table.open(newline="", encoding="utf-8"), delimiter=";"))
    assert [float(r["square"]) for r in rows] == [(n + 0.5) ** 2 for n in range(9)]


def test_a_bound_on_memory_that_cannot_be_is_refused(bare, tmp_path):
    (tmp_path / "case.ssi").write_text("X = 1 ;")
    told = ran(bare, tmp_path, "case.ssi", "--max-memory", "500", code=2)
    assert "leave --max-memory out" in told


@pytest.mark.parametrize("page", ["cp1252", "cp437", "ascii"])
def test_any_console_takes_what_is_printed(page, tmp_path, monkeypatch):
    (tmp_path / "case.ssi").write_text(
        "MESS 'déplacement µ² → ≤ œ' ; X = 'été' + 1 ;", encoding="utf-8"
    )
    monkeypatch.chdir(tmp_path)
    for words, code in (
        (["case.ssi", "--lang", "fr"], 1),
        (["help", "DYNAMIC", "--lang", "fr"], 0),
        (["help", "KN", "--lang", "fr"], 0),
        (["check", "case.ssi"], 1),
    ):
        console = io.TextIOWrapper(io.BytesIO(), encoding=page)  # as Python opens it there
        with monkeypatch.context() as patched:
            patched.setattr(sys, "stdout", console)
            patched.setattr(sys, "stderr", console)
            assert main(words) == code
        console.flush()
        told = console.buffer.getvalue().decode(page)
        assert "Error" not in told
        if words[0] == "case.ssi":
            assert ("déplacement µ²" in told) == (page != "ascii")


def test_a_console_of_its_own_page_takes_what_a_process_prints(tmp_path):
    (tmp_path / "case.ssi").write_text("MESS 'déplacement µ² → ≤ œ' ;", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "ssilang.cli.main", "case.ssi", "--out", "there"], cwd=tmp_path,
        env=os.environ | {"PYTHONIOENCODING": "cp437", "PYTHONUTF8": "0"},
        capture_output=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "déplacement µ²" in done.stdout.decode("cp437")


@pytest.mark.parametrize(
    "data",
    [
        "\ufeffMESS 'été' ;\r\nMESS 'fin' ;\r\n".encode(),
        "MESS 'été' ;\r\nMESS 'fin' ;".encode("latin-1"),
        "MESS 'été' ;\r\nMESS 'fin' ;\r\n".encode("utf-16"),
    ],
    ids=["mark and CRLF", "latin-1", "PowerShell's"],
)
def test_scripts_of_other_editors_are_read(data, tmp_path):
    from ssilang.cli.run import RunOptions, run_file

    (tmp_path / "case.ssi").write_bytes(data)
    result = run_file(tmp_path / "case.ssi", RunOptions(output_directory=tmp_path / "out"))
    assert (result.exit_code, result.output) == (0, "été\nfin\n")
    assert main(["format", str(tmp_path / "case.ssi")]) == 0
    assert (tmp_path / "case.ssi").read_bytes().rstrip(b"\r\n\0") == data.rstrip(b"\r\n\0")


# ---- names of files and files that others hold ---------------------------------------------------

STRANGE = {
    "AUX": "device", "nul.txt": "device", "a/Com1.csv": "device", "lpt9": "device",
    "con .x": "device", "a:b": "sign", "a<b": "sign", "x|y?.csv": "sign", "*": "sign",
    'a"b': "sign", "end.": "end", "a /b": "end", "a./b.csv": "end",
}  # fmt: skip
PLAIN = ("a", "auxiliary.csv", "com.csv", "com10", "x.aux", "../a", "./b", "fort.8", "a b", "é²")


def test_a_file_whose_name_says_null_is_no_name_with_a_nought():
    fault = OSError(errno.ENOTEMPTY, "Directory not empty", "null")
    assert system.system_reason(fault) == "Directory not empty"


def test_names_that_windows_refuses_are_told():
    found = {name: fault_on_windows(name) for name in (*STRANGE, *PLAIN)}
    kinds = {n: s.code.rpartition("-")[2] for n, s in found.items() if s is not None}
    assert kinds == STRANGE


@together("name", STRANGE)
def test_windows_writes_no_such_file(name, tmp_path, monkeypatch):
    output = RunOutput(tmp_path / "out", tmp_path)
    assert output.target(name) is not None
    monkeypatch.setattr("ssilang.io.run_output.POSIX", False)
    with pytest.raises(OutputError, match="no file can be called"):
        output.target(name)


def test_a_name_that_stays_here_is_told_once(tmp_path):
    from ssilang.cli.run import run_text

    script = "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0 0) (1 0) ; OPTI SORT '{}' ; SORT 'VTK' L ;"
    for name, count in (("a:b", 1), ("plain", 0)):
        result = run_text(script.format(name), output_directory=tmp_path)
        codes = [w.code for w in result.session.warnings]
        assert codes == ["io.name-stays-here"] * count


def test_a_drive_is_a_place_on_windows_alone(tmp_path, monkeypatch):
    output = RunOutput(tmp_path / "out", tmp_path)
    for ask in (output.target, output.source):
        for name in (r"C:\x\y.vtu", "c:/x/y.vtu"):
            with pytest.raises(OutputError) as refused:
                ask(name)
            assert "a drive of Windows" in sentence(refused.value.code, refused.value.data)
    monkeypatch.setattr("ssilang.io.atomic.POSIX", False)
    output.target("c:/x/y.vtu")


def test_backslashes_part_folders(tmp_path):
    output = RunOutput(tmp_path / "out", tmp_path)
    assert output.target(r"a\b.csv") == tmp_path / "out" / "a" / "b.csv"
    assert output.source(r".\a\b.csv") == tmp_path / "a" / "b.csv"
    assert output.target(r"..\b.csv") is None  # they lead nowhere else, either


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch):
    """A function that lets a file be held for so many tries to replace it."""
    own, left = os.replace, dict[Path, int]()

    def replace(made: Path, path: Path) -> None:
        if left.get(path, 0) > 0:
            left[path] -= 1
            raise PermissionError(13, "in use", str(path))
        own(made, path)

    monkeypatch.setattr(os, "replace", replace)
    monkeypatch.setattr(system, "_PATIENCE", 0.2)
    return left.update


def test_a_file_that_is_held_for_a_short_time_is_replaced(held, tmp_path):
    path = tmp_path / "x.csv"
    path.write_text("old")
    held({path: 2})
    atomic.write_text(path, "new")
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


def test_what_cannot_replace_a_file_is_kept_under_another_name(held, tmp_path):
    path, taken = tmp_path / "x.csv", tmp_path / "x.new1.csv"
    path.write_text("old")
    taken.write_text("mine")
    held({path: 10**9})
    with pytest.raises(OutputError) as refused:
        atomic.write_text(path, "new")
    assert (path.read_text(), taken.read_text()) == ("old", "mine")
    assert (tmp_path / "x.new2.csv").read_text() == "new"
    told = sentence(refused.value.code, refused.value.data)
    assert "is held by another program" in told
    assert "x.new2.csv" in told
    assert len(list(tmp_path.iterdir())) == 3


def test_a_growing_series_that_is_held_leaves_nothing(held, tmp_path):
    path = tmp_path / "x.vtkhdf"
    path.write_text("old")
    held({path: 10**9})
    file = GrowingFile(path)
    for _ in range(2):  # the calculation may be told to try again
        with pytest.raises(OutputError, match="held by another program"):
            file.commit(file.add(b"root"))
    file.close()
    assert [p.read_text() for p in tmp_path.iterdir()] == ["old"]
