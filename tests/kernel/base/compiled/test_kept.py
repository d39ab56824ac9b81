"""Kept code is loaded without what only compiling needs, and goes together with new code."""

import os
import pickle
import subprocess
import sys
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from together import together

from ssilang.kernel.base.compiled import PLAIN, cache, kept, kinds, machine
from ssilang.kernel.base.compiled.machine import Code


class Law(NamedTuple):
    """A record of a number and something else."""

    stiffness: Any
    rest: Any


PROGRAM = """
from __future__ import annotations

import numpy as np

from ssilang.kernel.base.compiled.compiler import compiled


@compiled
def spread(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    made = np.zeros((len(x), len(y)))
    for i in range(len(x)):
        for j in range(len(y)):
            made[i, j] = x[i] * y[j]
    return made @ y  # by BLAS


@compiled
def total(x: np.ndarray, y: np.ndarray) -> float:
    made = spread(x, y)
    return made[0] + made[1]
"""

RUN = """
import sys
import numpy as np
import program

x, y = np.array([1.0, 2.0]), np.array([3.0, 4.0])
print(program.spread(x, y))
print("numba" in sys.modules, program.spread.loaded)
for call in program.spread._seen.values():  # kept code knows Python's errors
    try:
        call(x, 3)
    except TypeError as error:
        print("array" in str(error))
if sys.argv[1:]:  # code that is not kept yet, with kept code in it
    print(program.total(x, y))
"""


@pytest.mark.skipif(PLAIN, reason="plain numba keeps code as it does")
def test_kept_code_loads_without_the_compiler_and_serves_new_code(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    (tmp_path / "run.py").write_text(RUN)
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    given |= {"XDG_CACHE_HOME": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)}
    shown = []
    for more in ([], [], ["new"]):
        made = subprocess.run(
            [sys.executable, "run.py", *more], capture_output=True, text=True, cwd=tmp_path,
            env=given, check=False,
        )  # fmt: skip
        assert made.returncode == 0, made.stderr
        shown.append(made.stdout.splitlines())
    # y.y = 25: x times 25, in all 75
    assert shown == [["[25. 50.]", "True 0", "True"], ["[25. 50.]", "False 1", "True"],
                     ["[25. 50.]", "False 1", "True", "75.0"]]  # fmt: skip


def test_code_of_older_states_goes_when_nobody_has_used_it_for_long(tmp_path):
    module = "ssilang.kernel.base.arrays"
    names = [f"{module}-{cache.state_of(module)}", f"{module}-0123456789abcdef", "gone-0123"]
    for name in [*names, f"{module}-fedcba9876543210"]:
        (tmp_path / name).mkdir()
    for name in names:
        os.utime(tmp_path / name, (0.0, 0.0))
    cache._remove_old.__wrapped__(tmp_path)
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(
        [names[0], f"{module}-fedcba9876543210"]
    )


def test_kinds_of_values_are_those_of_numba_s_types():
    """Else a function would be kept twice, or the other process would compile in vain."""
    A = np.arange(12.0).reshape(3, 4)
    fixed = A.copy()
    fixed.flags.writeable = False
    values = [
        A, A.T, A[:, ::2], fixed, A[0], np.zeros((2, 2, 2), np.int32), np.zeros(1, bool),
        np.zeros(2, complex), 1.0, 2, True, 1j, None, np.float64(1.0), np.int32(3), np.bool_(True),
        (1.0, 2), (1.0, 2.0), (A, (A, 1)), Law(1.0, A), Law(2.0, Law(A, 1)),
    ]  # fmt: skip
    words = kinds.words_of(kinds.key_of((*values,)))
    assert words == kinds.words_of_types(tuple(numba.typeof(value) for value in values))
    assert kinds.words_of(kinds.key_of(([1.0],))) is None  # a list: numba tells
    assert kinds.words_of(kinds.key_of((np.zeros(2, "i4, f8"),))) is None


@given(hnp.arrays(np.float64, hnp.array_shapes(max_dims=3)), st.data())
def test_kinds_of_parts_of_arrays_are_those_of_numba_s_types(whole, data):
    part = whole[data.draw(hnp.basic_indices(whole.shape, allow_ellipsis=False))]
    if isinstance(part, np.ndarray) and part.ndim:
        assert kinds.words_of(kinds.key_of((part,))) == kinds.words_of_types((numba.typeof(part),))


@together("text", [b"", b"nonsense", pickle.dumps((1, 2)), pickle.dumps("x")])
def test_a_file_that_is_no_code_counts_as_none(tmp_path, monkeypatch, text):
    monkeypatch.setattr(kept, "folder_of", lambda module: tmp_path)
    code = Code(b"machine code", "native", "wrapper", ["sin"], [], "own", "float64")
    kept.save(__name__, "spread", "float64[1C]", code)
    assert kept.load(__name__, "spread", "float64[1C]") == code
    assert kept.load(__name__, "spread", "float64[2C]") is None
    (file,) = tmp_path.iterdir()
    file.write_bytes(text)
    assert kept.load(__name__, "spread", "float64[1C]") is None


def test_code_that_cannot_be_written_is_not_kept(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "folder_of", lambda module: tmp_path / "gone")
    kept.save(__name__, "spread", "none", Code(b"", "", "", [], [], "", ""))
    assert kept.load(__name__, "spread", "none") is None
    monkeypatch.setattr(kept, "folder_of", lambda module: None)
    kept.save(__name__, "spread", "none", Code(b"", "", "", [], [], "", ""))
    assert kept.load(__name__, "spread", "none") is None


def test_code_for_another_processor_is_kept_apart(monkeypatch):
    own = machine.processor.__wrapped__()
    monkeypatch.setenv("NUMBA_CPU_NAME", "generic")
    monkeypatch.setenv("NUMBA_CPU_FEATURES", "")
    other = machine.processor.__wrapped__()
    assert other != own
    assert other.split()[1:] == ["generic"]


def test_code_of_a_module_without_a_file_is_not_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    tmp_path.chmod(0o700)
    assert cache.folder_of.__wrapped__("typed_by_hand") is None
    folder = cache.folder_of.__wrapped__(__name__)
    os.utime(folder, (0.0, 0.0))
    assert cache.folder_of.__wrapped__(__name__) == folder
    assert folder.stat().st_mtime > 0.0  # it counts as used now
