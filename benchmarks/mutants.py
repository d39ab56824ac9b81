"""Do the tests notice? Small faults are put into the code, one at a time, and its tests run.

    python benchmarks/mutants.py [COUNT] [SEED] [ROOM ...]

Each mutant changes one operator, comparison, sign, number or condition of a module; the tests of
the mirrored folder run in a copy of the project, and a mutant that they pass is a survivor,
printed with its line. Rooms are the names of `ROOMS`; without any, all take part evenly.
"""

from __future__ import annotations

import ast
import copy
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIMIT = 900.0  # seconds for the tests of a mutant; longer counts as noticed

# modules below ssilang/, and the tests that answer for them
ROOMS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "schemes": (
        ("kernel/stepping/newmark.py", "kernel/stepping/times.py"),
        ("kernel/stepping/test_newmark.py", "kernel/stepping/test_times.py"),
    ),
    "stepping": (
        ("kernel/stepping/problem", "kernel/stepping/run.py",
         "kernel/stepping/rests/conserving.py"),
        ("kernel/stepping/test_newmark.py", "kernel/stepping/test_uplift_motion.py",
         "kernel/stepping/problem", "kernel/contact/test_conserving.py"),
    ),
    "joint laws": (("kernel/interface/laws",), ("kernel/interface/laws",)),
    "joints": (
        ("kernel/interface/kinematics.py", "kernel/interface/integration.py",
         "kernel/interface/point_state.py", "kernel/interface/family.py"),
        ("kernel/interface", "operators/test_joint_scripts.py"),
    ),
    "plastic laws": (
        ("kernel/materials/plastic",),
        ("kernel/materials", "kernel/plasticity/test_creep.py"),
    ),
    "shapes": (
        ("kernel/elements/shapes", "kernel/elements/solids"),
        ("kernel/elements/shapes", "kernel/elements/solids"),
    ),
    "beams": (("kernel/elements/beams",), ("kernel/elements/beams",)),
    "shells": (("kernel/elements/shells",), ("kernel/elements/shells",)),
    "matrices": (
        ("kernel/matrices/lumping.py", "kernel/matrices/relations.py",
         "kernel/matrices/assembly.py", "kernel/matrices/imposed.py"),
        ("kernel/matrices", "operators/test_lumping.py", "operators/test_matrix_making.py"),
    ),
    "contact": (("kernel/contact",), ("kernel/contact",)),
    "statics": (("kernel/statics/linear.py",), ("kernel/statics",)),
    "modes": (("kernel/modal/eigen.py", "kernel/modal/oscillator.py", "kernel/modal/explicit.py"),
              ("kernel/modal",)),
    "records": (("kernel/records",), ("kernel/records",)),
    "files": (("io/vtk", "io/csv_tables.py", "io/mesh_files"), ("io",)),
    "reader": (("language/text",), ("language/text",)),
    "statements": (
        ("language/run/evaluator.py", "language/run/scopes.py", "language/run/jumps.py",
         "language/run/procedures.py", "language/run/binding.py", "language/near.py"),
        ("language",),
    ),
    "numbers": (("operators/numbers", "operators/lists"),
                ("operators/test_numbers.py", "operators/test_lists.py")),
    "safety": (("io/run_output.py", "io/atomic.py", "language/run/session.py"),
               ("cli/test_safety.py", "io/test_run_output.py", "operators/test_reading.py",
                "operators/test_writing.py")),
}  # fmt: skip

_OTHER: dict[type[ast.AST], type[ast.AST]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq, ast.And: ast.Or, ast.Or: ast.And, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In,
}  # fmt: skip


def changes(node: ast.AST) -> Iterator[ast.AST]:
    """Nodes that may stand in the place of one."""
    if isinstance(node, ast.BinOp | ast.BoolOp | ast.AugAssign) and type(node.op) in _OTHER:
        other = copy.copy(node)
        other.op = _OTHER[type(node.op)]()
        yield other
    elif isinstance(node, ast.Compare) and type(node.ops[0]) in _OTHER:
        other = copy.copy(node)
        other.ops = [_OTHER[type(node.ops[0])](), *node.ops[1:]]
        yield other
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
        yield node.operand
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        whole = isinstance(node.value, int) or node.value == 0.0
        yield ast.Constant(node.value + 1 if whole else 2 * node.value)
    elif isinstance(node, ast.If | ast.IfExp):
        other = copy.copy(node)
        other.test = ast.UnaryOp(ast.Not(), node.test)
        yield other


class _Swap(ast.NodeTransformer):
    """Puts one node in the place of another."""

    def __init__(self, old: ast.AST, new: ast.AST) -> None:
        self.old, self.new = old, new

    def visit(self, node: ast.AST) -> ast.AST:
        return ast.copy_location(self.new, node) if node is self.old else self.generic_visit(node)


def mutable(tree: ast.Module) -> list[ast.AST]:
    """Nodes inside functions, without annotations and messages."""
    found: list[ast.AST] = []

    def walk(node: ast.AST, inside: bool) -> None:
        if isinstance(node, ast.Raise | ast.Assert | ast.AnnAssign | ast.arguments | ast.JoinedStr):
            return
        inside = inside or isinstance(node, ast.FunctionDef)
        if inside and any(True for _ in changes(node)):
            found.append(node)
        for child in ast.iter_child_nodes(node):
            walk(child, inside)

    walk(tree, False)
    return found


def modules(room: str) -> list[Path]:
    """Python files of a room."""
    found: list[Path] = []
    for name in ROOMS[room][0]:
        path = ROOT / "ssilang" / name
        found += sorted(path.rglob("*.py")) if path.is_dir() else [path]
    return found


def mutants(room: str, count: int, rng: random.Random) -> Iterator[tuple[Path, str, str]]:
    """File, new source and a line of description, of `count` random mutants of a room."""
    places = []
    for path in modules(room):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        places += [(path, i) for i in range(len(mutable(tree)))]
    for path, i in rng.sample(places, min(count, len(places))):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        node = mutable(tree)[i]
        new = next(changes(node))
        line = getattr(node, "lineno", 0)
        said = f"{path.relative_to(ROOT)}:{line}: {_short(node)} -> "
        changed = ast.fix_missing_locations(_Swap(node, new).visit(tree))
        yield path, ast.unparse(changed), said + _short(new)


def _short(node: ast.AST) -> str:
    """The start of a node's text: the condition alone of an `if`."""
    return ast.unparse(getattr(node, "test", node))[:60]


def noticed(copy_of: Path, room: str) -> bool:
    """Whether the tests of a room fail in a copy of the project."""
    tests = [str(copy_of / "tests" / name) for name in ROOMS[room][1]]
    command = [sys.executable, "-m", "pytest", "-n", "0", "-q", "-x", *tests]
    environment = {**os.environ, "PYTHONPATH": str(copy_of), "PYTHONDONTWRITEBYTECODE": "1"}
    try:
        done = subprocess.run(
            command, cwd=copy_of, env=environment, capture_output=True, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return True
    return done.returncode != 0


def main(arguments: list[str]) -> int:
    """Run the mutants; the exit code is that of the command line, not of the tests."""
    count, seed = (int(a) for a in (arguments + ["200", "1"][len(arguments) :])[:2])
    rooms = arguments[2:] or list(ROOMS)
    with tempfile.TemporaryDirectory() as folder:
        copy_of = Path(folder) / "project"
        ignored = shutil.ignore_patterns("__pycache__")
        for name in ("ssilang", "stdlib", "grammar", "tests", "docs", "cases"):
            shutil.copytree(ROOT / name, copy_of / name, ignore=ignored)
        shutil.copy(ROOT / "pyproject.toml", copy_of)
        tried = survived = 0
        for k, room in enumerate(rooms):
            if noticed(copy_of, room):
                print(f"{room}: the tests fail without a mutant", flush=True)
                continue
            share = count * (k + 1) // len(rooms) - count * k // len(rooms)
            for path, source, said in mutants(room, share, random.Random(f"{seed} {room}")):
                target = copy_of / path.relative_to(ROOT)
                target.write_text(source, encoding="utf-8")
                started = time.perf_counter()
                killed = noticed(copy_of, room)
                shutil.copy(path, target)
                tried, survived = tried + 1, survived + (not killed)
                seconds = time.perf_counter() - started
                print(
                    f"{'noticed ' if killed else 'SURVIVED'} {seconds:5.0f} s  {said}", flush=True
                )
        print(f"{tried} mutants, {tried - survived} noticed, {survived} survived")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
