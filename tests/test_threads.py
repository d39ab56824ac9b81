"""BLAS runs one thread unless more are asked for, whichever way the package is entered."""

import os
import subprocess
import sys

import pytest

COUNT = """
import ctypes, pathlib, numpy
folder = pathlib.Path(numpy.__file__).parent.parent / "numpy.libs"
found = list(folder.glob("*openblas*"))
if not found:
    print("none"); raise SystemExit
library = ctypes.CDLL(str(found[0]))
names = ("scipy_openblas_get_num_threads64_", "openblas_get_num_threads64_",
         "openblas_get_num_threads")
print(getattr(library, next(n for n in names if hasattr(library, n)))())
"""
ENTRIES = {
    "library": "import ssilang.kernel.mesh.mesh",
    "numpy first": "import numpy; import ssilang.kernel.mesh.mesh",
    "command line": "import ssilang.cli.main",
    "run": "from ssilang.cli.run import run_text; run_text('X = 1 ;')",
    "operators": "import ssilang.operators",
}


def threads(entry, **environment):
    kept = {k: v for k, v in os.environ.items() if not k.endswith("_NUM_THREADS")}
    done = subprocess.run(
        [sys.executable, "-c", f"{entry}\n{COUNT}"],
        capture_output=True, text=True, check=True, env={**kept, **environment},
    )  # fmt: skip
    if done.stdout.strip() == "none":
        pytest.skip("numpy came without its own OpenBLAS")
    return int(done.stdout)


@pytest.mark.parametrize("entry", ENTRIES.values(), ids=ENTRIES)
def test_one_thread_unless_asked(entry):
    assert threads(entry) == 1


@pytest.mark.skipif((os.cpu_count() or 1) < 2, reason="one processor")
@pytest.mark.parametrize("name", ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"])
def test_as_many_as_asked(name):
    assert threads(ENTRIES["library"], **{name: "2"}) == 2
