"""The house rules: lint, format, types, import directions, module sizes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[1]
_TOOLS = Path(sys.executable).parent
_SOURCES = ["ssilang", "tests", "benchmarks", "docs"]


@pytest.mark.parametrize(
    "command",
    [
        ["ruff", "check", *_SOURCES],
        ["ruff", "format", "--check", *_SOURCES],
        ["mypy", "ssilang"],
        ["lint-imports"],
    ],
    ids=["lint", "format", "types", "import directions"],
)
def test_tool_finds_nothing(command):
    tool = _TOOLS / command[0]
    if not tool.exists():
        pytest.skip(f"{command[0]} is not installed")
    folders = [a for a in command[1:] if a not in _SOURCES or (_ROOT / a).exists()]
    done = subprocess.run(
        [str(tool), *folders], cwd=_ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, (done.stdout + done.stderr)[-4000:]


def test_the_language_starts_without_what_only_calculations_need():
    code = (
        "import sys; from ssilang.cli.run import run_text; run_text('x = 1 ;');"
        "heavy = {'numba', 'matplotlib', 'meshio', 'pyvista', 'scipy'} & set(sys.modules);"
        "sys.exit(', '.join(heavy) or 0)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=_ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"loaded at the start: {done.stderr}"
