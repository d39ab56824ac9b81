"""Kept code is loaded without what only compiling needs, and goes together with new code."""

import os
import subprocess
import sys

from ssilang.kernel.base.compiled import cache
from ssilang.kernel.base.compiled.kept import KeptFiles

PROGRAM = """
from __future__ import annotations

import numpy as np

from ssilang.kernel.base.compiled.compiler import compiled


@compiled
def spread(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    made = np.zeros((len(x), len(y)))
    for i in range(len(x)):
        made[i] = x[i] * y
    return made @ y


@compiled
def total(x: np.ndarray, y: np.ndarray) -> float:
    return spread(x, y).sum()
"""

RUN = """
import sys
import numpy as np
import program

x, y = np.array([1.0, 2.0]), np.array([3.0, 4.0])
print(program.spread(x, y))
late = ("numba.np.arrayobj", "scipy.linalg")
print(*(name in sys.modules for name in late), len(program.spread.stats.cache_hits))
if sys.argv[1:]:  # code that is not kept yet, with kept code in it
    print(program.total(x, y))
"""


def test_kept_code_loads_without_compiler_and_rest_of_scipy_and_serves_new_code(tmp_path):
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
    assert shown == [["[25. 50.]", "True True 0"], ["[25. 50.]", "False False 1"],
                     ["[25. 50.]", "False False 1", "75.0"]]  # fmt: skip


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


def test_processes_that_fill_a_function_s_files_at_a_time_keep_their_code_apart(
    tmp_path, monkeypatch
):
    """One compiles for floats, one for integers; both have read an empty index before."""
    floats, integers = (KeptFiles(str(tmp_path), "spread-7.py311", (1.0, 9)) for _ in range(2))
    monkeypatch.setattr(integers, "_load_index", dict)
    write = floats._save_data

    def meanwhile(*arguments):
        integers.save("integers", "code for integers")
        write(*arguments)

    monkeypatch.setattr(floats, "_save_data", meanwhile)
    floats.save("floats", "code for floats")
    late = KeptFiles(str(tmp_path), "spread-7.py311", (1.0, 9))
    found = {late.load("floats"): "floats", late.load("integers"): "integers"}
    assert found.items() <= {
        ("code for floats", "floats"), ("code for integers", "integers"),
        (None, "floats"), (None, "integers"),  # not found: compiled again
    }  # fmt: skip
    assert set(found) - {None}
