"""Ways into numba's insides are used with versions that were tried, and with no others."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.metadata import version

import pytest
from together import together

from ssilang.kernel.base.compiled import tried
from ssilang.kernel.base.compiled.tried import TRIED, untried, version_of

# as in a run, of a Python or library that says it is another one
PROGRAM = """
import sys
{said}
import ssilang.kernel.base.compiled as compiled
from ssilang.kernel.solvers.dense import multiply
import numpy as np

a, b, c = np.arange(6.0).reshape(2, 3), np.ones((3, 2)), np.zeros((2, 2))
multiply(a, b, c)
own = type(multiply).__module__.startswith("ssilang")
print(compiled.UNTRIED, compiled.PLAIN, own, c.tolist(), sep="|")
print("ssilang.kernel.base.compiled.linked" in sys.modules)
"""


def ran(said: str, caches: object, **environment: str) -> list[str]:
    """What the program prints; its code is kept in a folder of its own."""
    given = {k: v for k, v in os.environ.items() if k not in ("NUMBA_CACHE_DIR",)}
    given |= {"PYTHONPATH": os.pathsep.join(sys.path), "XDG_CACHE_HOME": str(caches)}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(said=said)], capture_output=True, text=True,
        env=given | {"SSILANG_PLAIN_NUMBA": ""} | environment, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_versions_are_those_that_the_libraries_say():
    for name in ("numba", "llvmlite", "numpy"):
        assert version_of(name) == version(name)
    assert version_of("Python") == sys.version.split()[0]
    assert version_of("no_such_library") == ""


NUMPY = 'import numpy; numpy.__version__ = "2.5.0"'


@pytest.mark.skipif(bool(untried()), reason=f"{untried()} was not tried")
def test_builds_of_python_that_were_not_tried_are_named(monkeypatch):
    with monkeypatch.context() as patched:
        patched.setattr(sys, "abiflags", "t")
        assert untried() == "a free-threaded Python"
    monkeypatch.setattr(sys, "gettotalrefcount", int, raising=False)
    assert untried() == "a debug build of Python"


@pytest.mark.skipif(bool(untried()), reason=f"{untried()} was not tried")
def test_what_was_not_tried_is_compiled_by_plain_numba_alone(tmp_path):
    first, inside = ran(NUMPY, tmp_path)
    assert first == "numpy 2.5.0|True|False|[[3.0, 3.0], [12.0, 12.0]]"
    assert inside == "False"
    kept = list(tmp_path.rglob("*.nbc"))
    assert kept  # numba's own way to keep code, in our private folder
    assert all("plain" in p.parts for p in kept)
    assert not list(tmp_path.rglob("*.code"))


@pytest.mark.skipif(bool(untried()), reason=f"{untried()} was not tried")
def test_what_was_tried_takes_our_own_ways(tmp_path):
    first, inside = ran("", tmp_path)
    assert first == "|False|True|[[3.0, 3.0], [12.0, 12.0]]"
    assert inside == "True"


@together("name, version, known", [
        ("numba", "0.68.1", True), ("numba", "0.68", True), ("numba", "0.680.0", False),
        ("numba", "0.69.0", False), ("numba", "", False), ("llvmlite", "0.51.0rc1", False),
        ("Python", "3.11.9", True), ("Python", "3.15.0", False), ("Python", "3.1.1", False),
        ("numpy", "2.4.6", True), ("numpy", "3.0.0", False),
    ])  # fmt: skip
def test_first_parts_of_versions_tell(name, version, known, monkeypatch):
    said = {n: f"{v[0]}.0" for n, v in TRIED.items()} | {name: version}
    monkeypatch.setattr(tried, "version_of", said.__getitem__)
    monkeypatch.setattr(tried, "is_free_threaded", lambda: False)
    assert bool(untried()) != known


def test_a_run_tells_in_its_notes_that_plain_numba_compiles(tmp_path):
    (tmp_path / "case.ssi").write_text(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (1. 0.) ; M = MODE L 'MECANIQUE' 'BARR' ;\n"
        "A = MATE M 'YOUN' 1. 'NU' 0. 'SECT' 1. ; K = RIGI M A ; MESS (TYPE K) ;\n"
    )
    for said, plain in (("1", True), ("", bool(untried()))):
        done = subprocess.run(
            [sys.executable, "-m", "ssilang.cli.main", "-v", "case.ssi"], cwd=tmp_path,
            env=os.environ | {"SSILANG_PLAIN_NUMBA": said, "PYTHONPATH": os.pathsep.join(sys.path)},
            capture_output=True, text=True, check=True,
        )  # fmt: skip
        assert ("compiled code is made by plain numba" in done.stderr) == plain
