"""What is told of tests that were not run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

_TESTS = """
import pytest
@pytest.mark.skipif(True, reason="no browser")
@pytest.mark.parametrize("n", range(3))
def test_marked(n): pass
def test_asked(): pytest.skip("no Gmsh")
def test_imported(): pytest.importorskip("nothing_of_this_name")
def test_run(): pass
@pytest.mark.xfail
def test_known(): assert 0
"""
_FILE = 'import pytest\npytest.skip("{}", allow_module_level=True)\n'


@pytest.mark.parametrize("processes", ["0", "2"])
def test_each_reason_stands_above_the_closing_line_with_its_tests(processes: str, tmp_path: Path):
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    (tmp_path / "test_tests.py").write_text(_TESTS)
    for name, reason in (("a", "no PETSc"), ("b", "no PETSc"), ("c", "no browser")):
        (tmp_path / f"test_{name}.py").write_text(_FILE.format(reason))
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-rs", "-p", "xdist", "-n", processes,
         "-p", "not_tested", "-p", "no:cacheprovider"],
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_ADDOPTS": "",
             "PYTHONPATH": str(Path(__file__).parent)},
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    *told, closing = done.stdout.splitlines()[-5:]
    assert told == [
        "not tested: 3 tests and 1 file: no browser",
        "not tested: 1 test: no Gmsh",
        "not tested: 1 test: no module nothing_of_this_name",
        "not tested: 2 files: no PETSc",
    ]
    assert closing.startswith("1 passed, 8 skipped, 1 xfailed")
    assert done.returncode == 0
