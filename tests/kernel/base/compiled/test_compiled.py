"""Kept code is good for the text that it came from, and functions apart behave as any other."""

import os
import subprocess
import sys

import numpy as np
import pytest

from ssilang.kernel.base.compiled import PLAIN as NUMBA_ALONE
from ssilang.kernel.base.compiled.cache import state_of

PROGRAM = """
from __future__ import annotations

import sys

import numpy as np

from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled


@apart
@compiled
def halve(x: np.ndarray, times: int) -> tuple[int, float]:
    if times < 0:
        raise ValueError("times")
    for i in range(len(x)):
        x[i] *= 0.5**times
    return times, x[0]


@apart
@compiled
def never(x: np.ndarray) -> None:
    x.of_no_use()


@apart
@compiled
def wrong(x: np.ndarray) -> int:
    return 0.5 * x[0]


@apart
@compiled
def late(x: np.ndarray) -> float:
    return 7.0


@compiled
def caller(x: np.ndarray, times: int) -> float:
    if times > 6:
        return late(x)
    if times > 5:
        never(x)
    if times > 4:
        return float(wrong(x))
    done, first = halve(x, times)
    return done + first + halve(x, 1)[1]
"""

RUN = """
import os
import signal
import time

import numpy as np
import program

signal.signal(signal.SIGINT, signal.default_int_handler)  # a run in the background ignores it
x = np.array([8.0, 16.0])
print(program.caller(x, 1), x.copy(), program.halve(x, 1), x)
for times in (-1, 5, 6):
    try:
        program.caller(x, times)
    except Exception as error:
        print(type(error).__name__, error)


def interrupted(words, types):
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(10.0)


program.late.address, address = interrupted, program.late.address
try:
    program.caller(x, 7)
except KeyboardInterrupt:
    print("stopped")
program.late.address = address
print(program.caller(x, 7))
print(program.caller.loaded)
"""


@pytest.fixture
def tree(tmp_path):
    """`loop` imports `law`, that imports `columns` and names who writes its code; `other` none."""
    kernel = tmp_path / "ssilang" / "kernel"
    (kernel / "joints").mkdir(parents=True)
    texts = {
        "loop": "from ssilang.kernel.joints import law\n",
        "joints/law": "from ssilang.kernel.joints.columns import (\n    KN,\n)\n"
        'CODE = "ssilang.kernel.joints.code"\n',
        "joints/code": "B = 1\n",
        "joints/columns": "KN = 0\n",
        "joints/other": "A = 1\n",
    }
    for name, text in texts.items():
        (kernel / f"{name}.py").write_text(text)
    return tmp_path / "ssilang"


@pytest.mark.parametrize(
    "edited", ["loop", "joints/law", "joints/columns", "joints/code", "joints/other"]
)
def test_state_changes_with_what_a_module_imports_and_nothing_else(tree, edited):
    before = state_of("ssilang.kernel.loop", tree)
    copy = tree.parent / "edited" / "ssilang"
    copy.parent.mkdir()
    tree.rename(copy)
    assert state_of("ssilang.kernel.loop", copy) == before
    with open(copy / "kernel" / f"{edited}.py", "a") as file:
        file.write("NEW = 2\n")
    again = copy.parent / "again"
    copy.rename(again)
    assert (state_of("ssilang.kernel.loop", again) != before) == (edited != "joints/other")


@pytest.mark.skipif(NUMBA_ALONE, reason="plain numba compiles whole functions")
def test_functions_apart_are_kept_compiled_when_called_and_can_fail_or_stop(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    (tmp_path / "run.py").write_text(RUN)
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    given |= {"XDG_CACHE_HOME": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)}
    shown = []
    for _ in range(2):
        made = subprocess.run(
            [sys.executable, "run.py"], capture_output=True, text=True, cwd=tmp_path, env=given
        )
        assert made.returncode == 0, made.stderr
        assert "wrong returns float64, not int64" in made.stderr
        assert "of_no_use" in made.stderr
        shown.append(made.stdout.splitlines())
    # 8 and 16, halved once: 1 + 4; then again: 2
    x = np.array([8.0, 16.0])
    assert shown[0][0] == f"7.0 {x / 4} (1, 1.0) {x / 8}"
    assert shown[0][1:-1] == [
        "ValueError times",
        "RuntimeError program.wrong could not be compiled",
        "RuntimeError program.never could not be compiled",
        "stopped",
        "7.0",
    ]
    assert shown[1][:-1] == shown[0][:-1]
    assert (shown[0][-1], shown[1][-1]) == ("0", "1")


PLAIN = """
import numpy as np
import program

from ssilang.kernel.base.compiled import PLAIN
from ssilang.kernel.base.compiled.apart import Apart
from ssilang.kernel.solvers.dense import factorise_dense

assert isinstance(factorise_dense, Apart) is not PLAIN
assert isinstance(program.halve, Apart) is not PLAIN

# elimination of 40 unknowns: it calls a function apart
A, rows = np.random.default_rng(5).normal(size=(40, 40)), np.arange(40)
assert factorise_dense(made := A.copy(), pivots := np.zeros(40, np.int64))
for i, j in enumerate(pivots):
    rows[[i, j]] = rows[[j, i]]
assert np.allclose((np.tril(made, -1) + np.eye(40)) @ np.triu(made), A[rows])
print([float(x).hex() for x in made.ravel()])
print(program.halve(np.array([8.0, 16.0]), 2))
"""


def test_plain_numba_gives_the_same_without_functions_apart_and_kept_code(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    (tmp_path / "run.py").write_text(PLAIN)
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    given |= {"PYTHONPATH": os.pathsep.join(sys.path)}
    shown = []
    for more in (
        {"SSILANG_PLAIN_NUMBA": "0"},
        {"SSILANG_PLAIN_NUMBA": "1", "XDG_CACHE_HOME": str(tmp_path / "1")},
    ):
        made = subprocess.run(
            [sys.executable, "run.py"], capture_output=True, text=True, cwd=tmp_path,
            env=given | more, check=False,
        )  # fmt: skip
        assert made.returncode == 0, made.stderr
        shown.append(made.stdout.splitlines())
    assert shown[0] == shown[1]
    assert not (tmp_path / "1").exists()


ROCKING = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
T = MAILLER 'SOL' 12. 4. 'SEMELLE' 4. 1. 'TAILLE' 1. 2. ;
MO = MODE (T . 'TOTAL') 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 5.E8 'NU' 0.3 'RHO' 2000. ;
MJ = MODE (T . 'JOINT') 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
AJ = MATE MJ 'KN' 2.E8 'KS' 2.E8 'FROT' 0.7 ;
RI = (RIGI MO MA) ET (RIGI MJ AJ) ET (BLOQ 'DEPL' (T . 'BASE')) ; MS = MASS MO MA ;
FG = MS * (MANU 'CHPO' (T . 'SEMELLE') 1 'UY' -9.81) ;
T1 = TABL ; T1 . 'MODELE' = MO ET MJ ; T1 . 'CARACTERISTIQUES' = MA ET AJ ;
T1 . 'RIGI' = RI ; T1 . 'MASS' = MS ; T1 . 'CHAR' = CHAR 'MECA' FG ;
T1 . 'DEPL' = RESO RI FG ; T1 . 'VITE' = MANU 'CHPO' (T . 'SEMELLE') 1 'UX' 1. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 3.E-4 0.012 ;
T2 = DYNAMIC T1 ; LIST (MAXI (EXTR (EVOL 'TEMP' T2 'DEPL' 'UX' (T . 'BORD_GAUCHE')) 'ORDO')) ;
"""


def test_a_run_without_compilation_gives_the_same(tmp_path):
    (tmp_path / "rocking.ssi").write_text(ROCKING)
    command = [sys.executable, "-m", "ssilang.cli.main", "rocking.ssi", "--out", "out"]
    found = []
    for extra in ({}, {"NUMBA_DISABLE_JIT": "1"}):
        run = subprocess.run(
            command, cwd=tmp_path, env=os.environ | extra, capture_output=True, text=True,
            check=False,
        )  # fmt: skip
        assert run.returncode == 0, run.stderr
        found.append(float(run.stdout.split()[-1]))
    assert found[0] == pytest.approx(found[1], rel=1e-10)
