"""The house rules: lint, format, types, import directions, circles, rooms, names, global state."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pytest

_ROOT = Path(__file__).resolve().parents[1]
_PACKAGE = _ROOT / "ssilang"
_TOOLS = Path(sys.executable).parent
_SOURCES = ["ssilang", "tests", "benchmarks", "docs"]

TYPED_NUMPY = "2.4."  # its stubs change with each version
DOORS = 20  # files and rooms in a room
CAPS = {"": 55_408, "kernel/stepping": 3_698, "kernel/solvers": 2_506, "kernel/interface": 2_346}
"""Lines of code in bodies that the package and some rooms may have: what comes pays with what goes.

To aim at: 45 000 and 3 500 for stepping.
"""
SAYS_NOTHING = frozenset({"making", "parts", "more", "items", "derived"})
GLOBAL_STATE = {"kernel/solvers/backends.py"}  # the factors kept between runs; see `session.py`


@pytest.mark.long
@pytest.mark.parametrize(
    "command",
    [
        ["pyrefly", "check", "--python-interpreter-path", sys.executable],
        ["ruff", "check", *_SOURCES],
        ["ruff", "format", "--check", *_SOURCES],
        ["lint-imports"],
    ],
    ids=["types", "lint", "format", "import directions"],
)
def test_tool_finds_nothing(command):
    tool = _TOOLS / command[0]
    if not tool.exists():
        pytest.skip(f"{command[0]} is not installed")
    if command[0] == "pyrefly" and not np.__version__.startswith(TYPED_NUMPY):
        pytest.skip(f"types are held to numpy {TYPED_NUMPY}, which is not installed")
    folders = [a for a in command[1:] if a not in _SOURCES or (_ROOT / a).exists()]
    done = subprocess.run([tool, *folders], cwd=_ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, (done.stdout + done.stderr)[-4000:]


def test_the_language_starts_without_what_only_calculations_need():
    code = (
        "import sys; from ssilang.cli.run import run_text; run_text('x = 1 ;');"
        "heavy = {'numba', 'matplotlib', 'meshio', 'pyvista', 'scipy'} & set(sys.modules);"
        "sys.exit(', '.join(heavy) or 0)"
    )
    for _ in range(2):  # the first start after a change looks where operators stand, in all of them
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=_ROOT, capture_output=True, text=True, check=False
        )
    assert done.returncode == 0, f"loaded at the start: {done.stderr}"


@cache
def _files() -> dict[str, Path]:
    """File of each module, by its dotted name."""
    found = {}
    for path in _PACKAGE.rglob("*.py"):
        parts = path.relative_to(_ROOT).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """All statements in one, and itself: most of a tree are the expressions in them."""
    waiting = [node]
    while waiting:
        node = waiting.pop()
        yield node
        for name in ("body", "orelse", "finalbody", "handlers", "cases"):
            inner = getattr(node, name, None)
            waiting += inner if isinstance(inner, list) else []


def _imports(text: str, known: frozenset[str]) -> set[str]:
    """Modules that a text imports anywhere: at the top, in functions, for types alone."""
    found = set()
    for node in _statements(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {a.name for a in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            for a in node.names:
                inside = f"{node.module}.{a.name}"
                found.add(inside if inside in known else node.module)
    return found & known


@cache
def _arrows() -> dict[str, set[str]]:
    known = frozenset(_files())
    return {name: _imports(p.read_text(encoding="utf-8"), known) for name, p in _files().items()}


def _in_circles(arrows: dict[str, set[str]]) -> set[str]:
    """Modules on a circle, and those between two: what stays when ends are taken away."""
    left = {name: set(to) for name, to in arrows.items()}
    while True:
        reached = set().union(*left.values()) if left else set()
        ends = {name for name, to in left.items() if not to or name not in reached}
        if not ends:
            return set(left)
        left = {name: to - ends for name, to in left.items() if name not in ends}


def test_circles_are_found_where_there_are_some():
    assert _in_circles({"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set()}) == {"b", "c"}
    assert _in_circles({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == set()
    known = frozenset({"ssilang.a", "ssilang.b", "ssilang.b.c"})
    text = "if TYPE_CHECKING:\n    import ssilang.a\ndef f():\n    from ssilang.b import c, d\n"
    assert _imports(text, known) == {"ssilang.a", "ssilang.b.c", "ssilang.b"}


def test_files_import_each_other_in_no_circle():
    assert len(_arrows()) > 500
    assert not _in_circles(_arrows())


def test_the_base_of_the_kernel_imports_nothing_of_ours_but_itself():
    base = {n: to for n, to in _arrows().items() if n.startswith("ssilang.kernel.base")}
    assert len(base) > 5
    assert (
        not {to for arrows in base.values() for to in arrows}
        - set(base)
        - {
            "ssilang.late_imports",  # what keeps searches for garbage away; imports nothing of ours
            "ssilang.messages.message",  # how a refusal is said
            "ssilang.private",  # folders that others cannot have written to
            "ssilang.system",  # what systems do each in their own way
        }
    )


def _rooms() -> dict[str, set[str]]:
    """Doors of each room by its path: files and rooms in it."""
    folders = {p.parent for p in _PACKAGE.rglob("*.py")}
    return {
        f.relative_to(_PACKAGE).as_posix(): {
            p.stem for p in f.iterdir() if p in folders or p.suffix == ".py"
        }
        - {"__init__"}
        for f in folders
    }


def test_rooms_have_at_most_twenty_doors():
    counts = {room: len(doors) for room, doors in _rooms().items()}
    assert {r: n for r, n in counts.items() if n > DOORS} == {}


def _lines_in_bodies(path: Path) -> int:
    """Lines of statements in functions, of compound ones the first; no docstrings, no comments."""
    rows: set[int] = set()
    for function in _statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(function, ast.FunctionDef):
            for node in _statements(function):
                said = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
                if isinstance(node, ast.stmt) and node is not function and not said:
                    inner = hasattr(node, "body") or hasattr(node, "cases")
                    last = node.lineno if inner else node.end_lineno or node.lineno
                    rows |= set(range(node.lineno, last + 1))
    return len(rows)


def test_rooms_stay_below_their_caps():
    found = dict.fromkeys(CAPS, 0)
    for path in _PACKAGE.rglob("*.py"):
        place, lines = f"{path.relative_to(_PACKAGE).as_posix()}", _lines_in_bodies(path)
        for room in CAPS:
            found[room] += lines * (not room or place.startswith(f"{room}/"))
    assert found[""] > 10_000
    assert {r: n for r, n in found.items() if n > CAPS[r]} == {}


def test_files_are_named_after_what_they_hold():
    vague = {f"{room}/{name}" for room, doors in _rooms().items() for name in doors & SAYS_NOTHING}
    assert not vague


def test_tests_stand_where_their_rooms_do():
    rooms = set(_rooms())
    top = [p for p in (_ROOT / "tests").iterdir() if (_PACKAGE / p.name).is_dir()]
    assert len(top) >= 5
    lost = {
        path.parent.relative_to(_ROOT / "tests").as_posix()
        for folder in top
        for path in folder.rglob("test_*.py")
    } - rooms
    assert not lost


def test_no_module_rebinds_its_names_while_it_runs():
    word = re.compile(r"^\s+global ", re.MULTILINE)
    found = {
        path.relative_to(_PACKAGE).as_posix()
        for path in _files().values()
        if word.search(path.read_text(encoding="utf-8"))
    }
    assert found == GLOBAL_STATE


def test_no_file_of_the_package_is_ignored_and_so_left_out_of_the_wheel():
    files = [str(p.relative_to(_ROOT)) for p in _PACKAGE.rglob("*.py")]
    asked = subprocess.run(
        ["git", "check-ignore", "--no-index", "--stdin"],
        input="\n".join(files), cwd=_ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if asked.returncode > 1:
        pytest.skip("no git checkout")
    assert asked.stdout == ""
