"""The process that compiles beside a run: who compiles what, how it ends, what it is told ahead."""

from __future__ import annotations

import importlib
import inspect
import os
import pickle
import subprocess
import sys
import time
from pathlib import Path

import pytest
from numba.core import types
from together import together

from ssilang.kernel.base.compiled import PLAIN, beside, calls, compiler
from ssilang.kernel.base.compiled.apart import apart, later, seldom
from ssilang.kernel.base.compiled.beside import Beside, task_of, tasks_ahead, title
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.factors.kept import new_factors
from ssilang.kernel.stepping.run import integrate
from tests.references.soil_block import soil_block

ROOMS = [
    "interface",
    "inverse",
    "blocks",
    "solvers.cholesky",
]
CASES = Path(__file__).parents[4] / "cases"
pytestmark = pytest.mark.skipif(os.name != "posix", reason="starts no second process elsewhere")


class Living:
    """A process that runs until it is stopped."""

    def __init__(self, turns):
        self.turns = turns

    def poll(self):
        self.turns -= 1
        return None if self.turns > 0 else 0


def pair(folder, turns=10**9):
    """A run and the other process, that share a folder of names."""
    run, other = Beside(), Beside()
    run._claims = other._claims = folder
    run._process, other.found = Living(turns), []
    return run, other


@apart
@compiled
def half(x: float) -> float:
    return 0.5 * x


@seldom
@compiled
def twice(x: float) -> float:
    return 2.0 * x


@compiled
def chosen(x: float, often: bool) -> float:
    return half(x) if often else twice(x)


@pytest.mark.skipif(PLAIN, reason="plain numba compiles in one process")
def test_what_few_runs_enter_is_not_compiled_beside_them(monkeypatch):
    marks = [(f.expected, f.later) for f in (half, twice, third)]
    assert marks == [(True, False), (False, False), (True, True)]
    told = []
    monkeypatch.setattr(calls.BESIDE, "tell", lambda name, task: told.append(name))
    monkeypatch.setattr(chosen, "name", None)  # nothing is kept
    assert chosen(3.0, False) == 6.0
    assert [name for name in told if "half" in name]
    assert not [name for name in told if "twice" in name]


def test_alone_all_is_compiled_by_the_run():
    with Beside().taking("f(int)") as mine:
        assert mine


def test_each_function_is_compiled_by_one_of_the_two(tmp_path):
    run, other = pair(tmp_path)
    with other.taking("f(int)") as mine:
        assert mine
    with run.taking("f(int)") as mine:
        assert not mine
    with run.taking("f(float)") as mine:
        assert mine
    with run.taking("f(float)") as mine:  # once more, another of the same name: no waiting
        assert mine


@later
@compiled
def third(x: float) -> float:
    return x / 3.0


@pytest.mark.skipif(PLAIN, reason="plain numba compiles in one process")
def test_a_run_that_waits_compiles_what_it_needs_and_nobody_has_begun(tmp_path, monkeypatch):
    run, other = pair(tmp_path, turns=3)
    made = []
    monkeypatch.setattr(beside, "_make", lambda module, name, *kind: made.append(name))
    names = {f: title(f.__module__, f.name, "float64") for f in (half, twice, third)}
    for function, name in names.items():
        task = task_of(function.__module__, function.name, "float64", (), function.later)
        run._needed.append((name, task))
    with other.taking("f(int)"), other.taking(names[half]), run.taking("f(int)") as mine:
        assert not mine
    assert made == ["twice"]  # the other has begun with `half`, `third` can wait


def test_what_the_other_fails_to_compile_is_not_waited_for(tmp_path):
    run, other = pair(tmp_path)
    with pytest.raises(TypeError), other.taking("f(int)"):
        raise TypeError
    with run.taking("f(int)") as mine:
        assert not mine


def test_the_run_goes_on_where_the_other_has_ended(tmp_path):
    run, other = pair(tmp_path, turns=3)
    with other.taking("f(int)"), run.taking("f(int)") as mine:
        assert not mine


def test_nothing_is_started_where_it_is_not_allowed(monkeypatch):
    monkeypatch.setattr(beside, "ALLOWED", set())
    run = Beside()
    run.tell("f(int)", b"")
    assert run._process is None


def test_nothing_is_started_where_nothing_is_compiled(monkeypatch):
    monkeypatch.setattr(beside, "ALLOWED", {"beside"})
    monkeypatch.setattr(beside, "UNCOMPILED", True)
    monkeypatch.setattr(beside, "tasks_ahead", lambda room: pytest.fail("nobody is there to tell"))
    run = Beside()
    run.enter("ssilang.kernel.solvers.dense")
    assert run._process is None


PROGRAM = """
from __future__ import annotations

from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled


@apart
@compiled
def half(x: float) -> float:
    return 0.5 * x


@compiled
def quarter(x: float) -> float:
    return half(half(x))
"""
RUN = """
import os, time
from numba.core import types
from ssilang.kernel.base import compiled
from ssilang.kernel.base.compiled import beside
import program

beside.cores = lambda: 2
compiled.ALLOWED.add("beside")
task = "program", "half", "float64"
beside.BESIDE.tell(beside.title(*task), beside.task_of(*task, (types.float64,)))
claims, limit = beside.BESIDE._claims, time.monotonic() + 120
while not any(claims.glob("*.done")) and time.monotonic() < limit:
    time.sleep(0.01)
print(program.quarter(8.0), program.half.function.loaded)
print(beside.BESIDE._process.pid, flush=True)
if {killed}:
    os.kill(os.getpid(), 9)
"""


def gone(pid):
    """Whether a process ends within a time."""
    limit = time.monotonic() + 60
    while time.monotonic() < limit:
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    return False


@pytest.mark.skipif(PLAIN, reason="plain numba keeps no code for others")
def test_a_run_loads_what_the_other_has_compiled_and_leaves_nobody_behind(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    paths = os.pathsep.join([str(tmp_path), *sys.path])
    given |= {"XDG_CACHE_HOME": str(tmp_path), "PYTHONPATH": paths, "TMPDIR": str(tmp_path)}
    for killed in (False, True):
        (tmp_path / "run.py").write_text(RUN.format(killed=killed))
        made = subprocess.run(
            [sys.executable, "run.py"], capture_output=True, text=True, cwd=tmp_path,
            env=given, check=False,
        )  # fmt: skip
        assert made.returncode == (-9 if killed else 0), made.stderr
        values, pid = made.stdout.splitlines()
        assert values == "2.0 1"
        assert gone(int(pid))
    assert not list(tmp_path.glob("ssilang-compiling-*"))


@pytest.mark.skipif(PLAIN, reason="plain numba compiles in one process")
def test_types_that_are_told_ahead_are_those_of_a_run():
    """Else the other process compiles in vain: correct `ahead.toml`."""
    integrate(soil_block(steps=5))
    integrate(soil_block(steps=5, size=(6, 3, 2)))
    integrate(soil_block(steps=2, size=(36, 2, 34)))  # many jumps
    tasks = [pickle.loads(task) for room in ROOMS for _, task in tasks_ahead(room)]
    called = set()
    for module, name, words, args, _ in tasks:
        function = getattr(importlib.import_module(module), name)
        function = getattr(function, "function", function)
        assert len(pickle.loads(args)) == len(inspect.signature(function.py_func).parameters), name
        called |= {name} if function._ready else set()
        assert not function._ready or function.has(words), name
    statics = {"accept", "energies_of_points"}
    assert {task[1] for task in tasks} - called <= statics


def test_a_room_is_told_when_its_first_function_is_compiled(monkeypatch):
    told, run = [], Beside()
    monkeypatch.setattr(beside, "ALLOWED", set())
    run.enter("ssilang.kernel.solvers.dense")
    assert not told  # nobody helps
    run._process = Living(9)
    monkeypatch.setattr(run, "tell", lambda name, task: told.append(name))
    run.enter("ssilang.kernel.solvers.cholesky.dissection")
    assert told == [name for name, _ in tasks_ahead("solvers.cholesky")]
    run.enter("ssilang.kernel.solvers.dense")
    run.enter("ssilang.kernel.mesh.queries.select")  # of which nothing is known
    assert len(told) == len(tasks_ahead("solvers.cholesky"))


@together("jumps, rooms", [(60, ["inverse"]), (100, ["blocks"]), (200, ["blocks"])])
def test_the_solver_of_a_model_is_told_where_another_process_compiles(monkeypatch, jumps, rooms):
    entered = []
    monkeypatch.setattr(beside.BESIDE, "enter", entered.append)
    new_factors((jumps // 2, 2), jumps)
    assert not entered
    monkeypatch.setattr(beside.BESIDE, "_process", Living(9))
    new_factors((jumps // 2, 2), jumps)
    assert entered == rooms


@pytest.mark.skipif(PLAIN, reason="plain numba compiles in one process")
def test_the_other_process_leaves_what_the_run_has_begun(tmp_path, monkeypatch):
    run, other = pair(tmp_path)
    monkeypatch.setattr(half.function, "name", None)  # nothing is kept
    monkeypatch.setattr(half.function, "_ready", {})
    with run.taking(title(__name__, "half", "float64")):
        monkeypatch.setattr(compiler, "BESIDE", other)
        assert half.function.ready("int64", lambda: (types.int64,)) is not None
        assert half.function.ready("float64", lambda: (types.float64,)) is None


def test_what_first_steps_do_without_is_compiled_last():
    waiting = []
    for name, late in (("a", False), ("b", True), ("c", False), ("d", True), ("a", False)):
        beside._put((name, beside.task_of(__name__, name, "", (), late)), waiting)
    assert [name for name, _ in reversed(waiting)] == ["c", "a", "b", "d"]
