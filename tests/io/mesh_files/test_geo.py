"""Scripts of Gmsh: what they may do, and what the guard around them holds."""

import json
import os
import re
import subprocess
import sys
import textwrap
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

from ssilang.cli.main import main
from ssilang.io.errors import InputError
from ssilang.io.mesh_files import geo, gmsh_alone
from ssilang.io.mesh_files.geo import read_geo

SQUARE = """
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5};
Point(4) = {0, 1, 0, 0.5}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1}; Physical Surface("Save") = {1};
"""
GUARD = Path(gmsh_alone.__file__)


def guarded(code: str, folder: Path, readable: tuple[str, ...] = ()) -> dict[str, str]:
    """What a process says that confines itself to a folder and then runs `code`."""
    inside = folder / "inside"
    inside.mkdir(exist_ok=True)
    text = f"""
        import errno, importlib.util, json, os, resource, socket, subprocess, sys
        import threading
        found = importlib.util.spec_from_file_location("alone", {str(GUARD)!r})
        alone = importlib.util.module_from_spec(found)
        found.loader.exec_module(alone)
        said = {{}}
        held = alone.confine({[str(folder / "read"), *readable]!r}, [{str(inside)!r}])
        def attempt(name, action):
            try:
                said[name] = str(action() or "done")
            except OSError as error:
                said[name] = errno.errorcode[error.errno]
    """
    end = "print(json.dumps({'held': str(held), **said}))"
    whole = "\n".join((textwrap.dedent(text), textwrap.dedent(code), end))
    done = subprocess.run(
        [sys.executable, "-c", whole], capture_output=True, text=True, cwd=folder, check=False
    )
    if done.returncode == gmsh_alone.UNGUARDED or '"held": "False"' in done.stdout:
        pytest.skip("this system has no Landlock")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_guarded_process_reaches_its_folders_alone(tmp_path):
    read, outside = tmp_path / "read", tmp_path / "outside"
    read.mkdir()
    outside.mkdir()
    (read / "given").write_text("given")
    (outside / "secret").write_text("secret")
    (read / "link").symlink_to(outside / "secret")
    code = f"""
        outside, read, inside = {str(outside)!r}, {str(read)!r}, {str(tmp_path / "inside")!r}
        attempt("read given", lambda: open(read + "/given").read())
        attempt("write inside", lambda: open(inside + "/made", "w").write("x"))
        attempt("remove inside", lambda: os.remove(inside + "/made"))
        attempt("read secret", lambda: open(outside + "/secret").read())
        attempt("read by a link", lambda: open(read + "/link").read())
        attempt("list", lambda: os.listdir(outside))
        attempt("write given", lambda: open(read + "/given", "a").write("x"))
        attempt("create", lambda: open(outside + "/new", "w").write("x"))
        attempt("make a folder", lambda: os.mkdir(outside + "/new"))
        attempt("remove", lambda: os.remove(outside + "/secret"))
        attempt("move out", lambda: os.rename(read + "/given", outside + "/given"))
        attempt("make a link", lambda: os.link(outside + "/secret", inside + "/secret"))
        attempt("start a program", lambda: subprocess.run([sys.executable, "-c", "1"]).returncode)
        attempt("start a shell", lambda: os.system("true") == 0 and "ran")
        attempt("another process", lambda: os.fork() or os._exit(0))
        attempt("a network", lambda: socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        attempt("a socket", lambda: socket.socket(socket.AF_UNIX))
        attempt("a signal", lambda: os.kill(os.getppid(), 0))
        attempt("rights", lambda: os.chmod(outside + "/secret", 0o777))
        attempt("times", lambda: os.utime(outside + "/secret"))
        attempt("limits of another", lambda: resource.prlimit(os.getppid(), resource.RLIMIT_CORE))
        alone.limit(600)
        largest = open(inside + "/large", "w")
        attempt("two gigabytes", lambda: largest.truncate(2 * 1024**3))
        attempt("a byte more", lambda: largest.truncate(2 * 1024**3 + 1))
        read_secret = lambda: open(outside + "/secret").read()
        worker = threading.Thread(target=attempt, args=("from a thread", read_secret))
        worker.start()
        worker.join()
    """
    said = guarded(code, tmp_path, (sys.prefix, sys.base_prefix, "/usr/lib", "/lib"))
    fine = {"read given": "given", "write inside": "1", "two gigabytes": str(2 * 1024**3)}
    assert {k: said[k] for k in fine} == fine
    assert said.pop("start a shell") == "done"  # the shell is not there, and nothing ran
    assert said.pop("a byte more") == "EFBIG"
    refused = {k: v for k, v in said.items() if k not in (*fine, "held")}
    assert set(refused.values()) <= {"EACCES", "EPERM", "EXDEV"}, refused
    assert len(refused) == 19
    assert sorted(p.name for p in outside.iterdir()) == ["secret"]
    assert (read / "given").read_text() == "given"


def test_a_process_with_other_threads_is_not_taken_for_guarded(tmp_path):
    code = f"""
        import importlib.util, sys, threading
        found = importlib.util.spec_from_file_location("alone", {str(GUARD)!r})
        alone = importlib.util.module_from_spec(found)
        found.loader.exec_module(alone)
        ends = threading.Event()
        threading.Thread(target=ends.wait).start()
        print(alone.confine([], [{str(tmp_path)!r}]))
        ends.set()
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=True
    )
    assert done.stdout == "False\n"


with_gmsh = pytest.mark.skipif(find_spec("gmsh") is None, reason="gmsh is not installed")


def refusal(folder: Path, text: str, name: str = "box.geo") -> str:
    """The code by which a script is refused, 'made' if it is meshed."""
    (folder / name).write_text(text)
    try:
        assert len(read_geo(folder / name, 2).points) > 4
    except InputError as error:
        return error.code
    return "made"


OUTWARD = {
    "comment in a string": 'x = "//"; SystemCall "touch {out}";',
    "comment over strings": 'a = "/*"; SystemCall "touch {out}"; b = "*/";',
    "macro": 'Macro M\nSystemCall "touch {out}";\nReturn\nCall M;',
    "process of a field": 'Field[1] = ExternalProcess; Field[1].CommandLine = "touch {out}; '
    'sleep 99"; Background Field = 1;',
    "printf": 'Printf("a") > "{out}";',
    "printf over lines": 'x = "//"; Printf("a")\n  >> "{out}";',
    "log": 'General.LogFileName = "{out}";',
    "save": 'Mesh 2; Save "{out}.msh";',
    "save by a sum": 'Mesh 2; Save StrCat("{out}", ".msh");',
    "folder": 'CreateDir "{out}";',
    "client": 'OnelabRun("a", "touch {out}");',
    "merge": 'Merge "{secret}";',
    "include": 'Include "{secret}";',
    "include by a link": 'Include "link.geo";',
    "file of a field": 'Field[1] = Structured; Field[1].FileName = "{secret}"; '
    "Field[1].TextFormat = 1; Background Field = 1;",
    "the end": "Exit;",
    "quotes within quotes": "x = '\"'; SystemCall 'touch {out}'; y = '\"';",
    "call without waiting": 'x = "//"; NonBlockingSystemCall "touch {out}";',
    "call by a macro's name": 'Macro SystemCal\nReturn\nSystemCall StrCat("tou", "ch {out}");',
    "picture": 'x = "//"; Print "{out}.geo_unrolled";',
    "cad": 'SetFactory("OpenCASCADE"); v() = ShapeFromFile("{secret}");',
    "many files": 'For i In {{0:200}}\n  Printf("a") > Sprintf("{out}%g", i);\nEndFor',
}
SAID = {"io.geo-reaches-out", "io.no-readable-mesh-file"}
TOLD = ("macro", "process of a field", "printf", "save by a sum", "merge", "include by a link")


@with_gmsh
@pytest.mark.parametrize(
    ("name", "words"), [*((n, False) for n in OUTWARD), *((n, True) for n in TOLD)]
)
def test_a_script_does_nothing_outside(name, words, tmp_path, monkeypatch):
    """By the guard alone; and refused, where the words are known or the guard makes Gmsh fail."""
    if not words:
        monkeypatch.setattr(geo, "_OUTWARD", re.compile(r"(?!)"))
    folder, elsewhere = tmp_path / "deck", tmp_path / "elsewhere"
    folder.mkdir()
    elsewhere.mkdir()
    monkeypatch.setenv("PYTHONPATH", str(elsewhere))  # is no library of Gmsh
    secret, out = elsewhere / "secret.geo", elsewhere / "out"
    secret.write_text(SQUARE.replace("0.5", "0.1"))  # another mesh if it is read
    (folder / "link.geo").symlink_to(secret)
    plain = SQUARE if name not in ("merge", "include", "include by a link") else ""
    text = plain + OUTWARD[name].format(out=out, secret=secret) + "\n"  # else the last waits
    said = refusal(folder, text)
    if said == "io.geo-unguarded":
        pytest.skip("this system has no Landlock")
    assert sorted(p.name for p in elsewhere.iterdir()) == ["secret.geo"]
    assert sorted(p.name for p in folder.iterdir()) == ["box.geo", "link.geo"]
    if words:
        assert said in SAID


@with_gmsh
def test_a_script_reads_what_stands_below_its_folder(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "square.geo").write_text(SQUARE)
    said = refusal(tmp_path, 'Include "parts/square.geo"; // Save "x"\n/* SystemCall "x"; */')
    assert said in ("made", "io.geo-unguarded")


@with_gmsh
def test_without_a_guard_only_what_is_allowed_runs(tmp_path, monkeypatch, capsys):
    """Where the system has none: the guard's file in which it never holds."""
    bare = tmp_path / "bare.py"
    bare.write_text(GUARD.read_text().replace('startswith("linux")', 'startswith("none")'))
    monkeypatch.setattr(gmsh_alone, "__file__", str(bare))
    assert refusal(tmp_path, SQUARE) == "io.geo-unguarded"
    case = tmp_path / "case.ssi"
    case.write_text("OPTI DIME 2 ; T = MAILLER 'box.geo' ; MESS (DIME T) ;")
    monkeypatch.setenv(geo.FREE, "")
    assert main([str(case)]) == 1
    assert "--allow-geo" in capsys.readouterr().err
    assert main([str(case), "--allow-geo"]) == 0
    assert os.environ[geo.FREE]


@with_gmsh
def test_what_is_allowed_runs_under_a_guard_where_there_is_one(tmp_path, monkeypatch):
    folder, elsewhere = tmp_path / "deck", tmp_path / "elsewhere"
    folder.mkdir()
    elsewhere.mkdir()
    if refusal(folder, SQUARE) == "io.geo-unguarded":
        pytest.skip("this system has no Landlock")
    monkeypatch.setenv(geo.FREE, "1")
    monkeypatch.setattr(geo, "_OUTWARD", re.compile(r"(?!)"))
    assert refusal(folder, f'{SQUARE} SystemCall "touch {elsewhere}/out";') in ("made", *SAID)
    assert list(elsewhere.iterdir()) == []


@with_gmsh
@pytest.mark.parametrize(
    "text",
    [
        "x = 1;\nFor i In {0:1}\n  i = 0;\n  x = x + 1;\nEndFor\n",
        SQUARE.replace("0.5}", "0.00002}"),
        "a() = {0:3e9};" + SQUARE,
        "Macro again\n  Call again;\nReturn\nCall again;\n",
    ],
    ids=["a loop", "a huge mesh", "a huge list", "a macro that calls itself"],
)
def test_what_takes_all_is_ended(text, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("SSILANG_GEO_SECONDS", "1")
    (tmp_path / "box.geo").write_text(text)
    (tmp_path / "case.ssi").write_text("OPTI DIME 2 ; T = MAILLER 'box.geo' ;")
    begun = time.monotonic()
    assert main([str(tmp_path / "case.ssi")]) == 1
    assert time.monotonic() - begun < 20.0
    said = capsys.readouterr().err
    assert "box.geo" in said
    assert "Traceback" not in said


def test_calls_have_the_numbers_of_the_system():
    """Each table of numbers that the system's headers have."""
    tables = {
        0: Path("/usr/include/x86_64-linux-gnu/asm/unistd_64.h"),
        1: Path("/usr/include/asm-generic/unistd.h"),
    }
    there = {i: p for i, p in tables.items() if p.is_file()}
    if not there:
        pytest.skip("this system has no headers")
    calls = gmsh_alone.CALLS | {name: rule[0] for name, rule in gmsh_alone.ONLY.items()}
    for column, path in there.items():
        pairs = re.findall(r"#define __NR(?:3264)?_(\w+)\s+(\d+)", path.read_text())
        known = {"newfstatat" if n == "fstatat" else n: int(v) for n, v in pairs}
        assert {n: known.get(n, -1) for n in calls} == {n: v[column] for n, v in calls.items()}
