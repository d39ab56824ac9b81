"""Do the tests notice? Small faults are put into the code, one at a time, and its tests run.

    python benchmarks/mutants.py [COUNT] [SEED] [ROOM ...]
    python benchmarks/mutants.py again REPORT

Each mutant changes one operator, comparison, sign, number or condition of a module; the tests of
the mirrored folder run in a copy of the project, and a mutant that they pass is a survivor,
printed with its line. Rooms are the names of `ROOMS`; without any, all take part evenly. `again`
runs the survivors of a report (what an earlier run printed) against the tests of today.

Tests run in a process that is split off from this one, whose libraries are imported already; the
files that name the changed function come first, and the first test that fails ends it.
"""

from __future__ import annotations

import ast
import compileall
import copy
import os
import py_compile
import random
import re
import select
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
LIMIT = 900.0  # seconds for the tests of a mutant at most; longer counts as noticed
NOTHING = "none"  # what is said when no test fails

# what the tests import, but for the project: done once
LIBRARIES = ("hypothesis", "numba", "numpy", "scipy.linalg", "scipy.sparse.linalg", "xdist")

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
         "kernel/stepping/problem", "kernel/contact/test_conserving.py",
         "kernel/stepping/rests/sparse/test_interleaved.py", "operators/test_friction.py"),
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
        ("kernel/elements/shapes", "kernel/elements/solids", "operators/test_finite_motion.py"),
    ),
    "beams": (
        ("kernel/elements/beams",),
        ("kernel/elements/beams", "kernel/elements/test_hoop.py", "operators/test_rotating.py",
         "operators/test_fibre_sections.py"),
    ),
    "shells": (("kernel/elements/shells",), ("kernel/elements/shells",)),
    "matrices": (
        ("kernel/matrices/build.py", "kernel/matrices/relations.py",
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
                tuple(f"operators/test_{name}.py" for name in (
                    "numbers", "lists", "records", "optimum", "fitting", "huge_numbers",
                    "limits_and_senses", "operand_orders", "hostile_operands"))),
    "safety": (("io/run_output.py", "io/atomic.py", "language/run/session.py"),
               ("cli/test_safety.py", "io/test_run_output.py", "language/run/test_session.py",
                "operators/test_reading.py",
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


@dataclass(frozen=True)
class Mutant:
    """A changed module.

    Attributes
    ----------
    path : Path
        The module.
    source : str
        Its text with the change.
    function : str
        The outermost function or class around the change.
    said : str
        The change in a line.
    """

    path: Path
    source: str
    function: str
    said: str


def mutants(room: str, count: int, rng: random.Random) -> Iterator[Mutant]:
    """`count` random mutants of a room."""
    places = []
    for path in modules(room):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        places += [(path, i) for i in range(len(mutable(tree)))]
    for path, i in rng.sample(places, min(count, len(places))):
        yield mutant(path, i)


def mutant(path: Path, number: int) -> Mutant:
    """The change of one of a module's nodes."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    node = mutable(tree)[number]
    new = next(changes(node))
    line = getattr(node, "lineno", 0)
    around = next((n for n in tree.body if n.lineno <= line <= (n.end_lineno or line)), None)
    said = f"{path.relative_to(ROOT)}:{line}: {_short(node)} -> {_short(new)}"
    changed = ast.fix_missing_locations(_Swap(node, new).visit(tree))
    return Mutant(path, ast.unparse(changed), getattr(around, "name", "-"), said)


def survivors(report: Path) -> dict[str, list[Mutant]]:
    """Mutants of a report that survived, by room; a module that has changed since may miss some."""
    lines = re.findall(r"^SURVIVED +\d+ s  (.*)$", report.read_text(encoding="utf-8"), re.MULTILINE)
    found: dict[str, list[Mutant]] = {}
    for line in lines:
        path = ROOT / line.partition(":")[0]
        room = next(r for r in ROOMS if path in modules(r))
        tree = ast.parse(path.read_text(encoding="utf-8"))
        was = int(line.split(":")[1])
        said = line.partition(": ")[2]
        same = [  # by its text; the nearest one, since lines move
            (abs(getattr(node, "lineno", 0) - was), i)
            for i, node in enumerate(mutable(tree))
            if said == f"{_short(node)} -> {_short(next(changes(node)))}"
        ]
        found.setdefault(room, []).extend(mutant(path, i) for _, i in sorted(same)[:1])
        if not same:
            print(f"is no more: {line}", flush=True)
    return found


def _short(node: ast.AST) -> str:
    """The start of a node's text: the condition alone of an `if`."""
    return ast.unparse(getattr(node, "test", node))[:60]


def ordered(copy_of: Path, room: str, path: Path, function: str) -> list[str]:
    """Test files of a room: first those that name the changed function, then the module."""
    files: list[Path] = []
    for name in ROOMS[room][1]:
        place = copy_of / "tests" / name
        files += sorted(place.rglob("test_*.py")) if place.is_dir() else [place]
    texts = {f: f.read_text(encoding="utf-8") for f in dict.fromkeys(files)}

    def rank(file: Path) -> tuple[bool, bool, bool]:
        named = re.search(rf"\b{function}\b", texts[file]) is not None
        same = path.stem in file.stem
        return not (named and same), not (named or same), path.stem not in texts[file]

    return [str(f) for f in sorted(texts, key=rank)]


def noticed(copy_of: Path, tests: list[str], limit: float) -> str:
    """How the tests fail in a copy of the project: the first test that does, '' if none."""
    reads, writes = os.pipe()
    pid = os.fork()  # the libraries are imported, the copy is not
    if pid == 0:
        os.close(reads)
        os.setpgid(0, 0)
        _run_tests(copy_of, tests, writes)
    os.close(writes)
    end = time.monotonic() + limit
    with os.fdopen(reads) as told:
        late = not select.select([told], [], [], limit)[0]
        said = "" if late else told.read()
    while not late and os.waitpid(pid, os.WNOHANG) == (0, 0):
        late = time.monotonic() > end + 10.0
        time.sleep(0.01)
    if late:
        os.killpg(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        return "longer than the limit"
    return said.strip() or "pytest itself ended"


class _First:
    """A plugin of pytest: the first test, or file, that fails."""

    name = ""

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed and not self.name:
            self.name = report.nodeid

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed and not self.name:
            self.name = f"{report.nodeid} (collecting)"


def _run_tests(copy_of: Path, tests: list[str], told: int) -> None:
    """Run tests in this process, say what fails and end it."""
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, 1)
    os.dup2(silence, 2)
    os.chdir(copy_of)
    os.environ |= {"PYTHONPATH": str(copy_of)}
    sys.path.insert(0, str(copy_of))
    first = _First()
    code = 1
    try:
        code = int(pytest.main(["-n", "0", "-q", "-x", "-p", "no:cacheprovider", *tests], [first]))
    except BaseException as problem:
        first.name = first.name or f"pytest: {type(problem).__name__}"
    os.write(told, (first.name if code else NOTHING).encode() or b"?")
    os._exit(0)


def chosen(arguments: list[str]) -> dict[str, list[Mutant]]:
    """The mutants that the command line asks for, by room."""
    if arguments[:1] == ["again"]:
        return survivors(Path(arguments[1]))
    count, seed = (int(a) for a in (arguments + ["200", "1"][len(arguments) :])[:2])
    rooms = arguments[2:] or list(ROOMS)
    shares = (count * (k + 1) // len(rooms) - count * k // len(rooms) for k in range(len(rooms)))
    return {
        room: list(mutants(room, share, random.Random(f"{seed} {room}")))
        for room, share in zip(rooms, shares, strict=True)
    }


def main(arguments: list[str]) -> int:
    """Run the mutants; the exit code is that of the command line, not of the tests."""
    sys.dont_write_bytecode = True  # what is compiled once is kept, no mutant's
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    for library in LIBRARIES:
        import_module(library)
    with tempfile.TemporaryDirectory() as folder:
        copy_of = Path(folder) / "project"
        ignored = shutil.ignore_patterns("__pycache__")
        for name in ("ssilang", "stdlib", "grammar", "tests", "docs", "cases", "benchmarks"):
            shutil.copytree(ROOT / name, copy_of / name, ignore=ignored)
        shutil.copy(ROOT / "pyproject.toml", copy_of)
        # bytecode that is told from its text, not its date: mutants come and go within a second
        by_text = py_compile.PycInvalidationMode.CHECKED_HASH
        compileall.compile_dir(copy_of / "ssilang", quiet=2, invalidation_mode=by_text)
        tried = survived = 0
        for room, mutants_of_it in chosen(arguments).items():
            for died in run_room(copy_of, room, mutants_of_it):
                tried, survived = tried + 1, survived + (not died)
        print(f"{tried} mutants, {tried - survived} noticed, {survived} survived")
    return 0


def run_room(copy_of: Path, room: str, all_of_it: list[Mutant]) -> Iterator[bool]:
    """Whether the tests of a room notice each of its mutants, told on the way."""
    started = time.monotonic()
    failed = noticed(copy_of, ordered(copy_of, room, Path(), "-"), LIMIT)
    if failed != NOTHING:
        print(f"{room}: the tests fail without a mutant: {failed}", flush=True)
        return
    limit = min(LIMIT, 60.0 + 5.0 * (time.monotonic() - started))
    print(f"{room}: {time.monotonic() - started:.0f} s without a mutant", flush=True)
    for mutant in all_of_it:
        target = copy_of / mutant.path.relative_to(ROOT)
        kept = target.read_bytes()
        target.write_text(mutant.source, encoding="utf-8")
        started = time.monotonic()
        failed = noticed(copy_of, ordered(copy_of, room, mutant.path, mutant.function), limit)
        target.write_bytes(kept)
        word = "SURVIVED" if failed == NOTHING else "noticed "
        by = "" if failed == NOTHING else f"  by {failed}"
        print(f"{word} {time.monotonic() - started:5.0f} s  {mutant.said}{by}", flush=True)
        yield failed != NOTHING


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
