"""Do the tests notice? Faults as people make them are put into the package, one at a time.

    python benchmarks/mutants.py COUNT SEED > report
    python benchmarks/mutants.py --again report

COUNT lines are drawn by SEED over all of `ssilang` that runs: bodies of functions, without what is
declared (signatures, decorators, annotations, tables of modules) and what is said (docstrings,
refusals, texts). Each gets one fault (`faults`). The tests near it are collected once, with those
of all others, in a copy of the project; a process split off from there gives the function its
faulty code and runs them, the nearest first, one case of each (and those that name its room) before
the next, until one fails or `--seconds` of processor time are used. Survivors (`--once`: not), and
faults in compiled functions, which get three times the limit, are tried in a process of their own
that imports the module with the fault. A mutant that all pass is a survivor and printed as a diff;
`--again` tries those of a report once more. Changes that change nothing stand with their reason in
`mutants_equivalent.toml`.

Near are the tests of the mirrored folder, and those that import the module or name what is changed,
what calls it, or the word of the operator or procedure that does; rare names count more. What the
data of a file of tests name (`.toml` of its name, a folder that it names) is named by that file; a
further form of an operator is found by the operator's word. Where nothing is near, the tests of the
room are taken; a mutant that no test tried is told as NONE and not counted. Faults of the language
server get a process of their own, since its tests speak to a server that imports the copy.

`--ran DATA` asks the suite itself. DATA is what coverage kept of a run of it, with a context a test
(`pytest --cov --cov-context=test`): of tests, those that ran the lines are tried (first those that
ran what fewest did, of an `if` what stands in it) and those near that DATA, being older, does not
know. Where `SHARED` or fewer ran them, others may use what these made and kept (caches, fixtures of
a session): behind them all tests of their files and the nearest are tried. Compiled functions are
not seen that way, nor what only an import or a child of a test runs: these stay with the nearest.
DATA of an earlier state of the project serve with `--of COMMIT`: lines are looked up where they
stood then, and what is newer stays with the nearest.

mutmut keeps all mutants of a function in one file behind a switch, where compiled code would keep
the first that ran and whatever it calls would be compiled anew; cosmic-ray changes tokens and has
one command of tests for all: neither draws by lines nor asks the room's tests first.
"""

import argparse
import ast
import compileall
import copy
import difflib
import gc
import inspect
import math
import os
import py_compile
import random
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[1]
EQUIVALENT = Path(__file__).with_name("mutants_equivalent.toml")
HANGS = 60.0  # s of processor time of one test beyond the limit: it is counted as noticed
FILES = 30  # of tests, at most, for a mutant
WORD = 1.6  # what naming the operator counts, of naming the function
OFTEN = 6  # operators that may share a word of theirs
COMPILES = 3.0  # times the limit: what a fault changes, and all that calls it, is compiled first
OF_LAYOUT = ("test_tool_finds_nothing[lint]", "test_tool_finds_nothing[format]")
"""Tests that notice how a fault is written, not what it does."""
DATA = (".forms", ".ssi", ".toml", ".txt")
WRITES = "_code.py"  # LLVM's code of functions that are `written`
SERVED = "ssilang/cli/editor/"  # its tests speak to a server, a process that imports the copy
SHARED = 3  # tests, below which others may use what they made
CASE = 4  # files whose tests go before one more case of a test
NONE = "none is near"
NOT_SO = "untried: it is in no function of a process"
WORDS = dict.fromkeys(("assertion", "crash", "time"), "noticed")
WORDS |= {word: word.upper() for word in ("equivalent", "gone", "none", "untried")}
LIBRARIES = ("hypothesis", "numba", "numpy", "scipy.linalg", "scipy.sparse.linalg", "xdist")
GOOD = """
import sys
from pathlib import Path
from ssilang.kernel.base.compiled.cache import PACKAGE, state_of
for path in sorted((PACKAGE / "kernel").rglob("*.py")):
    name = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
    print(f"{name}-{state_of(name)}")
"""

_OTHER: dict[type[ast.AST], Any] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq, ast.And: ast.Or, ast.Or: ast.And, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In,
}  # fmt: skip
_OPPOSITE = {"min": "max", "any": "all", "minimum": "maximum", "argmin": "argmax", "floor": "ceil"}
_OPPOSITE |= {b: a for a, b in _OPPOSITE.items()}
_LEFT_OUT = {"abs", "sorted", "reversed", "set", "unique", "cumsum", "sqrt", "ravel", "int", "sum"}
_SIMPLE = ast.Name | ast.Attribute | ast.Subscript
_REAL = re.compile("float|FloatArray")
Twins = dict[str, list[str]]  # names of a function that have its type
_WHOLE = _SIMPLE | ast.Constant | ast.Call
_SAID = ast.Raise | ast.Assert | ast.JoinedStr | ast.Import | ast.ImportFrom | ast.arguments


@dataclass(frozen=True)
class Fault:
    """Lines of a module, from `line` on, and what stands in their place."""

    path: str
    line: int
    old: str
    new: str
    kind: str = ""

    def source(self, root: Path = ROOT) -> str | None:
        """The module's text with the fault; where lines have moved, at the nearest; None: gone."""
        lines = (root / self.path).read_text(encoding="utf-8").split("\n")
        old = self.old.split("\n")
        at = [i for i in range(len(lines)) if lines[i : i + len(old)] == old]
        if not at:
            return None
        i = min(at, key=lambda i: abs(i + 1 - self.line))
        return "\n".join([*lines[:i], *self.new.split("\n"), *lines[i + len(old) :]])

    def is_one(self) -> bool:
        """Whether it is Python, and another program."""
        source = self.source() or ""
        try:
            compile(source, self.path, "exec")
        except SyntaxError:
            return False
        was = (ROOT / self.path).read_text(encoding="utf-8")
        return ast.dump(ast.parse(source)) != ast.dump(ast.parse(was))

    def __str__(self) -> str:
        old, new = self.old.split("\n"), self.new.split("\n")
        diff = [d for d in difflib.ndiff(old, new) if d[0] != "?"]
        return "\n".join([f"{self.path}:{self.line} {self.kind}", *diff])


Asked = tuple[Fault | None, list[str], frozenset[str], frozenset[str], frozenset[str]]
"""A fault not yet in the text, files of tests, words whose cases of a test go first, tests that go
before all others (they ran its lines, of an `if` what stands in it), tests left out."""


def expressions(node: ast.AST, twins: Twins) -> Iterator[tuple[str, ast.AST]]:
    """Kinds of faults of an expression and what then stands there."""
    match node:
        case ast.BinOp(left, ast.Add() | ast.Sub() as op, right):
            yield "sign", ast.BinOp(left, _OTHER[type(op)](), right)
            yield "term left out", left
            yield "term left out", right
        case ast.BinOp(left, ast.Mult() | ast.Div() as op, right):
            yield "operator", ast.BinOp(left, _OTHER[type(op)](), right)
            yield "factor left out", left
            yield "factor 2", ast.BinOp(ast.BinOp(ast.Constant(2), ast.Mult(), left), op, right)
        case ast.BoolOp(op, [*values]):
            yield "operator", ast.BoolOp(_OTHER[type(op)](), values)
            for i in range(len(values)):
                rest = values[:i] + values[i + 1 :]
                yield "condition left out", ast.BoolOp(op, rest) if rest[1:] else rest[0]
        case ast.Compare(left, [op, *ops], values) if type(op) in _OTHER:
            yield "comparison", ast.Compare(left, [_OTHER[type(op)](), *ops], values)
        case ast.UnaryOp(ast.USub() | ast.Not(), operand):
            yield "sign", operand
        case ast.Constant(bool(value)):
            yield "flag", ast.Constant(not value)
        case ast.Constant(int(value)):
            yield "off by one", ast.Constant(value + 1)
        case ast.Constant(float(value)):
            yield "factor 2", ast.Constant(2.0 * value if value else 1.0)
        case ast.IfExp(test, body, orelse):
            yield "condition turned", ast.IfExp(test, orelse, body)
        case ast.Attribute(value, "T"):
            yield "not transposed", value
        case ast.Subscript(value, ast.Tuple([a, b])) if not isinstance(a, ast.Slice):
            yield "indices exchanged", ast.Subscript(value, ast.Tuple([b, a]))
        case ast.Subscript(value, ast.Slice(low, high, step)):
            for one in ({"lower": low}, {"upper": high}):
                ((side, bound),) = one.items()
                if bound is not None:
                    ends = {"lower": low, "upper": high, "step": step}
                    ends[side] = ast.BinOp(bound, ast.Add(), ast.Constant(1))
                    yield "off by one", ast.Subscript(value, ast.Slice(**ends))
        case ast.Call(ast.Attribute(value, "copy"), []):
            yield "no copy", value
        case ast.Call(func, args, keywords) if args:
            name = getattr(func, "attr", getattr(func, "id", ""))
            if name in _OPPOSITE:
                other = copy.copy(func)
                setattr(other, "id" if isinstance(func, ast.Name) else "attr", _OPPOSITE[name])
                yield "opposite", ast.Call(other, args, keywords)
            if name in _LEFT_OUT and len(args) == 1:
                yield "call left out", args[0]
            for i in range(len(args) - 1):
                if all(isinstance(a, _SIMPLE) for a in args[i : i + 2]) and name != "isinstance":
                    turned = [*args[:i], args[i + 1], args[i], *args[i + 2 :]]
                    yield "arguments exchanged", ast.Call(func, turned, keywords)
        case ast.ListComp(elt, [ast.comprehension(t, it, [_, *ifs], 0)]):
            yield "condition left out", ast.ListComp(elt, [ast.comprehension(t, it, ifs, 0)])
        case ast.Name(name, ast.Load()):
            for twin in twins.get(name, ()):
                yield "other name", ast.Name(twin, ast.Load())


def statements(node: ast.AST, returns: ast.expr | None, twice: bool) -> Iterator[tuple[str, str]]:
    """Kinds of faults of a statement; {} is its own text. `twice`: it ends the body of a loop."""
    match node:
        case ast.Assign([ast.Name(name)], value):
            if any(isinstance(n, ast.Name) and n.id == name for n in ast.walk(value)):
                yield "statement left out", "pass"
        case ast.Expr(ast.Call()) | ast.Assign([ast.Attribute() | ast.Subscript()]):
            yield "statement left out", "pass"
        case ast.AugAssign() | ast.Delete():
            yield "statement left out", "pass"
        case ast.If(orelse=[]):
            yield "statement left out", "pass"
        case ast.Continue():
            yield "break for continue", "break"
        case ast.Return(ast.expr() as value) if _REAL.match(ast.unparse(returns or value)):
            yield "factor 2", f"return 2 * ({ast.unparse(value)})"
        case _:
            return
    if isinstance(returns, ast.Constant) and returns.value is None and isinstance(node, ast.Expr):
        yield "early return", "return"
    if twice:
        yield "one turn alone", "{}\nbreak"


def faults(path: Path) -> list[Fault]:
    """All that may be put into a module."""
    text = path.read_bytes()
    starts = [0]
    for line in text.split(b"\n"):
        starts.append(starts[-1] + len(line) + 1)
    found: list[Fault] = []

    def own(node: Any) -> bytes:
        first, last = starts[node.lineno - 1], starts[node.end_lineno - 1]
        return text[first + node.col_offset : last + node.end_col_offset]

    def put(node: Any, kind: str, new: str) -> None:
        first, end = starts[node.lineno - 1], starts[node.end_lineno] - 1
        new = new.replace("\n", "\n" + " " * node.col_offset)
        begin = first + node.col_offset
        changed = text[first:begin] + new.encode() + text[begin + len(own(node)) : end]
        old = text[first:end].decode()
        found.append(Fault(str(path.relative_to(ROOT)), node.lineno, old, changed.decode(), kind))

    def walk(node: Any, returns: ast.expr | None, twins: Twins, inside: bool) -> None:
        if isinstance(node, _SAID) or getattr(node, "arg", "") == "strict":  # of zip: a guard
            return
        if isinstance(node, ast.FunctionDef):
            kinds = [(a.arg, ast.unparse(a.annotation)) for a in node.args.args if a.annotation]
            twins = {a: [b for b, other in kinds if b != a and other == k] for a, k in kinds}
            returns, inside = node.returns, True
            parts = node.body[1:] if ast.get_docstring(node) else node.body
        elif isinstance(node, ast.AnnAssign):
            parts = [node.value] if node.value else []
        elif isinstance(node, ast.Call) and re.search("(rror|warn)$", ast.unparse(node.func)):
            return  # the words of a refusal
        else:
            parts = list(ast.iter_child_nodes(node))
        if inside and isinstance(node, ast.expr):
            for kind, new in expressions(node, twins):
                written = ast.unparse(ast.fix_missing_locations(new))
                put(node, kind, written if isinstance(new, _WHOLE) else f"({written})")
        loops = isinstance(node, ast.For) and node.body[-1]
        for part in parts:
            if inside and isinstance(part, ast.stmt):
                for kind, new in statements(part, returns, part is loops):
                    put(part, kind, new.replace("{}", own(part).decode()))
            walk(part, returns, twins, inside)

    walk(ast.parse(text), None, {}, False)
    return found


def drawn(count: int, seed: int, under: list[str]) -> tuple[list[Fault], str]:
    """Faults at lines drawn over folders of the package, and what share of them has such lines."""
    places: dict[tuple[str, int], list[Fault]] = {}
    total = 0
    for path in sorted(path for folder in under for path in (ROOT / folder).rglob("*.py")):
        lines = path.read_text(encoding="utf-8").split("\n")
        total += sum(1 for line in lines if line.strip() and not line.strip().startswith("#"))
        for fault in faults(path):
            places.setdefault((fault.path, fault.line), []).append(fault)
    rng = random.Random(seed)
    chosen = []
    for place in rng.sample(sorted(places), min(count, len(places))):
        kinds = sorted({f.kind for f in places[place]})
        for kind in rng.sample(kinds, len(kinds)):  # what people do is not drowned by tokens
            fault = rng.choice([f for f in places[place] if f.kind == kind])
            if fault.is_one():
                chosen.append(fault)
                break
    share = (
        f"{len(places)} of {total} lines of {' '.join(under)} ({100 * len(places) / total:.0f} %)"
    )
    return chosen, share


def survivors(report: Path) -> list[Fault]:
    """Faults of an earlier report that were not noticed."""
    found = []
    text = report.read_text(encoding="utf-8")
    told = re.compile(r"^SURVIVED.*? s  (\S+):(\d+) (.*)\n((?:[-+ ] .*\n)+)", re.MULTILINE)
    for path, line, kind, body in told.findall(text):
        rows = body.rstrip("\n").split("\n")
        old, new = ("\n".join(r[2:] for r in rows if r[0] in s) for s in ("- ", "+ "))
        found.append(Fault(path, int(line), old, new, kind))
    return found


class Callers:
    """Who uses what in the package: functions and classes by module, names and words of each."""

    def __init__(self) -> None:
        self.uses: dict[tuple[str, str], set[str]] = {}  # 'module.name' for what is imported
        self.words: dict[tuple[str, str], set[str]] = {}
        self.spans: dict[str, list[tuple[int, int, str]]] = {}
        self.forms: list[tuple[str, str, str, dict[str, str]]] = []  # of which operator
        self.library = {
            path.stem.upper().lstrip("@"): set(re.findall(r"\w+", path.read_text(encoding="utf-8")))
            for path in (ROOT / "stdlib").glob("*.ssi")
        }  # procedures written in the language
        for path in sorted((ROOT / "ssilang").rglob("*.py")):
            module = ".".join(path.relative_to(ROOT).with_suffix("").parts)
            tree = ast.parse(path.read_text(encoding="utf-8"))
            imported = {
                alias.asname or alias.name: f"{node.module}.{alias.name}"
                for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)
                for alias in node.names
            }  # fmt: skip
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef | ast.ClassDef):
                    self._put(module, node, imported)
        often = Counter(word for words in self.words.values() for word in words)
        for words in self.words.values():  # a word of many operators is that of a type
            words -= {word for word in words if often[word] > OFTEN}
        for module, name, operator, imported in self.forms:
            own = (module, operator), tuple(imported.get(operator, ".").rsplit(".", 1))
            self.words[module, name] |= {w for key in own for w in self.words.get(key, ())}

    def _put(self, module: str, node: Any, imported: dict[str, str]) -> None:
        names = {getattr(n, "id", getattr(n, "attr", "")) for n in ast.walk(node)}
        key = (module, node.name)
        self.uses.setdefault(key, set()).update(imported.get(n, f"{module}.{n}") for n in names)
        said = " ".join(ast.unparse(d) for d in node.decorator_list)
        found = re.findall(r"'([A-Z][A-Z0-9_*]{2,})'|^([A-Z]{3,})\.form", said)
        self.words.setdefault(key, set()).update(a or b for a, b in found)
        for operator in re.findall(r"\b([a-z_]+)\.form\(", said):
            self.forms.append((module, node.name, operator, imported))
        self.spans.setdefault(module, []).append((node.lineno, node.end_lineno or 0, node.name))

    def names(self, fault: Fault) -> dict[str, float]:
        """What tests may name of a fault, and how much that counts: callers' callers count less."""
        module = fault.path[:-3].replace("/", ".")
        at = {(module, n) for a, b, n in self.spans.get(module, ()) if a <= fault.line <= b}
        found, known, weight = {module: 1.0}, set(at), 1.0
        for _ in range(6):
            for key in at:
                words = self.words[key]
                for name in key:
                    found.setdefault(name, weight)
                for name in words:  # an operator's word is nobody else's, however far it is
                    found[name] = WORD
                for name in (p for p, said in self.library.items() if said & words):
                    found.setdefault(name, 0.4 * WORD)
            ways = {f"{m}.{n}" for m, n in at}
            at = {key for key, used in self.uses.items() if key not in known and used & ways}
            known, weight = known | at, 0.4 * weight
        return found


def near(fault: Fault, texts: dict[str, set[str]], callers: Callers) -> list[str]:
    """Files of tests that answer for a fault, the nearest first."""
    module = Path(fault.path).with_suffix("")
    mirror = Path("tests") / module.parent.relative_to("ssilang")
    rank = dict.fromkeys(texts, 0.0)
    for name, weight in callers.names(fault).items():
        have = [file for file, words in texts.items() if name in words]
        for file in have:  # a name that most have tells nothing
            rank[file] += weight * math.log(len(texts) / len(have))
    for file in texts:
        folder = Path(file).parent
        if folder == mirror:
            rank[file] += 6.0 + 12.0 * (module.name in Path(file).stem)
        elif folder in mirror.parents[:-2] or mirror in folder.parents:  # rooms around and within
            rank[file] += 1.0
    found = [f for f in sorted(rank, key=lambda f: (-rank[f], f)) if rank[f] > 0.0][:FILES]
    return found or [f for f in texts if Path(f).parts[1:2] == mirror.parts[1:2]]


def compiled(fault: Fault) -> bool:
    """Whether it is in a function that is compiled, or writes code: callers keep what it makes."""
    if fault.path.endswith(WRITES):
        return True
    tree = ast.parse((ROOT / fault.path).read_text(encoding="utf-8"))
    return any(
        re.match("compiled|apart|seldom", ast.unparse(decorator))
        for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)
        for decorator in node.decorator_list
        if node.lineno <= fault.line <= (node.end_lineno or 0)
    )  # fmt: skip


def codes(code: CodeType) -> Iterator[tuple[tuple[str, int], CodeType]]:
    """Functions of a module or class, not those within them, by name and first line."""
    for one in code.co_consts:
        if isinstance(one, CodeType):
            own = one.co_flags & inspect.CO_OPTIMIZED
            yield from [((one.co_qualname, one.co_firstlineno), one)] if own else codes(one)


def put_into(fault: Fault, functions: list[FunctionType]) -> bool:
    """Give a function of this process the code with a fault, wherever the function is kept."""
    module = import_module(fault.path[:-3].replace("/", ".").removesuffix(".__init__"))
    path, found = module.__file__ or "", False
    was = dict(codes(compile(Path(path).read_text(encoding="utf-8"), path, "exec")))
    now = dict(codes(compile(fault.source(Path()) or "", path, "exec")))
    now = {k: code for k, code in now.items() if code != was.get(k) and k[1] <= fault.line}
    for f in {id(f): f for f in functions + living()}.values():
        new = now.get((f.__code__.co_qualname, f.__code__.co_firstlineno))
        if new and f.__code__.co_filename == path and new.co_freevars == f.__code__.co_freevars:
            f.__code__, found = new, True
    return found


def living() -> list[FunctionType]:
    """Functions that a search for garbage would see."""
    return [f for f in gc.get_objects() if isinstance(f, FunctionType)]


class Ran:
    """Which tests ran a line, from the data of a run with a context a test."""

    def __init__(self, path: Path, commit: str = "") -> None:
        from coverage import CoverageData

        self.commit = commit  # whose lines it has

        self.data = CoverageData(str(path))
        self.data.read()
        trees = {path.rpartition("/ssilang/")[0] for path in self.data.measured_files()}
        self.tree = min(trees, key=len)  # copies that tests made lie deeper
        self.known = self._named(self.data.measured_contexts())

    @staticmethod
    def _named(contexts: Iterable[str]) -> frozenset[str]:
        found = (c[c.index("tests/") :] for c in contexts if "tests/" in c)
        return frozenset(re.sub(r"\|\w+$", "", c) for c in found)

    def _lines(self, fault: Fault) -> set[int]:
        """Numbers that the lines of a fault had; none where they are newer."""
        own = set(range(fault.line, fault.line + fault.old.count("\n") + 1))
        if not self.commit:
            return own
        was = subprocess.run(
            ["git", "show", f"{self.commit}:{fault.path}"], cwd=ROOT, capture_output=True, text=True
        ).stdout.split("\n")
        now = (ROOT / fault.path).read_text(encoding="utf-8").split("\n")
        same = difflib.SequenceMatcher(None, was, now, autojunk=False).get_matching_blocks()
        moved = {b + i + 1: a + i + 1 for a, b, size in same for i in range(size)}
        return {moved[line] for line in own & moved.keys()}

    def tests(self, fault: Fault) -> tuple[frozenset[str], frozenset[str]] | None:
        """Tests that ran lines of a fault, that of its lines that fewest ran; None: no test's."""
        if compiled(fault):
            return None
        lines = self._lines(fault)
        by_line = self.data.contexts_by_lineno(f"{self.tree}/{fault.path}")
        found = [c for line in lines for c in by_line.get(line, ())]
        ran = self._named(found)
        every = (self._named(by_line.get(line, ())) for line in lines)
        seldom = min((one for one in every if one), key=len, default=ran)
        return None if not lines or (found and not ran) else (ran, seldom)


def in_turn(
    items: list[pytest.Item], files: list[str], words: frozenset[str], ran: frozenset[str],
    idle: frozenset[str],
) -> list[pytest.Item]:  # fmt: skip
    """Tests of files, the nearest first; more cases of one test come behind other files' tests."""
    rank, cases = {file.split("::")[0]: i for i, file in enumerate(files)}, Counter[str]()
    order: list[tuple[bool, bool, int, int, pytest.Item]] = []
    for item in items:
        file, test = item.nodeid.split("::")[0], item.nodeid.split("[")[0]
        if file in rank and item.nodeid not in idle and not item.nodeid.endswith(OF_LAYOUT):
            own = words & set(re.findall(r"[a-z]+", item.nodeid.partition("[")[2].lower()))
            place = rank[file] + (0 if own else CASE * cases[test])
            last, long = item.nodeid not in ran, bool(item.get_closest_marker("long"))
            order.append((last, long, place, rank[file], item))
            cases[test] += 1
    return [item for *_, item in sorted(order, key=lambda one: one[:4])]


class _Judge:
    """A plugin of pytest: each fault is tried in a process split off when tests are collected."""

    def __init__(self, asked: list[Asked], seconds: float, told: int) -> None:
        self.asked, self.seconds, self.told, self.said = asked, seconds, told, ""
        self.good: set[str] = set()

    def pytest_exception_interact(self, node: Any, call: Any) -> None:
        if isinstance(node, pytest.Collector) and self.asked[0][0]:
            return  # it misses something here, without a fault
        name = call.excinfo.typename
        word = "assertion" if name in ("AssertionError", "Failed") else "crash"
        self.said = self.said or f"{word} {node.nodeid} ({name})"

    def tell(self, said: str) -> None:
        os.write(self.told, (said.replace("\n", " ") + "\n").encode())

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool | None:
        if self.said:
            return None
        gc.unfreeze()
        functions = living()
        gc.freeze()
        items = {item.nodeid: item for item in session.items}
        for fault, *asked in self.asked:
            near = in_turn(session.items, *asked)
            said = self.split_off(near, fault, functions)
            test = re.match(r"\w+ (tests/.*) \(", said)
            if fault and test and test[1] in items and test[1] not in self.good:
                alone = self.split_off([items[test[1]]], None, [])
                said = said if alone.startswith("passed") else f"passes not without it: {alone}"
                self.good |= {test[1]} if alone.startswith("passed") else set()
            self.tell(said)
        return True

    def split_off(
        self, items: list[pytest.Item], fault: Fault | None, functions: list[FunctionType]
    ) -> str:
        """How tests end that run one after the other up to the first that fails."""
        reads, writes = os.pipe()
        pid = os.fork()
        if pid == 0:
            os.setpgid(0, 0)
            most = int(self.seconds + HANGS)
            resource.setrlimit(resource.RLIMIT_CPU, (most, most + 5))
            try:
                said = self.run(items) if not fault or put_into(fault, functions) else NOT_SO
            except BaseException as problem:
                said = f"crash of pytest ({type(problem).__name__})"
            os.write(writes, said.encode())
            os._exit(0)
        os.close(writes)
        with os.fdopen(reads) as told:
            late = not select.select([told], [], [], 4.0 * (self.seconds + HANGS))[0]
            said = "" if late else told.read()
        if not said:
            os.killpg(pid, signal.SIGKILL)
        status = os.waitpid(pid, 0)[1]
        if late or os.WTERMSIG(status) == signal.SIGXCPU:
            return "time limit"
        return said or f"crash of the process ({os.WTERMSIG(status)})"

    def run(self, items: list[pytest.Item]) -> str:
        """Run them here, up to the first that fails or the limit."""
        for i, item in enumerate(items):
            after = items[i + 1] if i + 1 < len(items) else None
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=after)
            if self.said or time.process_time() > self.seconds:
                return self.said or f"passed {i + 1} tests, the limit"
        return f"passed {len(items)} tests" if items else NONE


def verdicts(copy_of: Path, asked: list[Asked], seconds: float) -> Iterator[str]:
    """How tests end in a copy of the project for each fault, from one process that has them all."""
    if not asked:
        return
    reads, writes = os.pipe()
    pid = os.fork()  # the libraries are imported, the copy is not
    if pid == 0:
        os.setpgid(0, 0)
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        os.chdir(copy_of)
        os.environ["PYTHONPATH"] = str(copy_of)
        sys.path.insert(0, str(copy_of))
        judge = _Judge(asked, seconds, writes)
        options = ["-n", "0", "-q", "-p", "no:cacheprovider", "--hypothesis-seed=1"]
        files = sorted({file for _, files, *_ in asked for file in files})
        try:
            pytest.main([*options, *files], [judge])
        except BaseException as problem:
            judge.said = judge.said or f"crash of pytest ({type(problem).__name__})"
        judge.tell(judge.said)
        os._exit(0)
    os.close(writes)
    with os.fdopen(reads) as told:
        for _ in asked:
            yield told.readline().strip() or "crash of the process"
    os.killpg(pid, signal.SIGKILL)
    os.waitpid(pid, 0)


def project(folder: Path) -> Path:
    """A copy of the project whose byte code is told from its text: mutants come within a second."""
    left = shutil.ignore_patterns("__pycache__", ".*_cache", ".git", ".venv")
    shutil.copytree(ROOT, folder, ignore=left, dirs_exist_ok=True)
    by_text = py_compile.PycInvalidationMode.CHECKED_HASH
    compileall.compile_dir(folder / "ssilang", quiet=2, invalidation_mode=by_text)
    return folder


def unchanged(copy_of: Path) -> set[str]:
    """Folders of compiled code of the modules as they are: others are left by mutants."""
    told = subprocess.run(
        [sys.executable, "-c", GOOD], cwd=copy_of, env=os.environ | {"PYTHONPATH": str(copy_of)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return set(told.stdout.split())


def written(test: Path) -> str:
    """A file of tests, the data beside it that have its name, and folders of data that it names."""
    own = test.read_text(encoding="utf-8")
    beside = [path for path in (test.with_suffix(".toml"),) if path.is_file()]
    for folder in test.parent.iterdir():
        if folder.is_dir() and f'"{folder.name}"' in own:
            beside += [path for path in folder.iterdir() if path.suffix in DATA]
    return "\n".join([own, *(path.read_text(encoding="utf-8") for path in beside)])


def warm_up(kept: Path) -> None:
    """Take over what the user's runs have compiled: code is named after its text."""
    own = Path.home() / ".cache/ssilang/compiled"
    if own.is_dir():
        shutil.copytree(own, kept / "ssilang/compiled", dirs_exist_ok=True)
        for folder in (kept, kept / "ssilang", kept / "ssilang/compiled"):
            folder.chmod(0o700)


def try_all(
    asked: list[Fault], seconds: float, folder: Path, kept: Path, once: bool, data: Ran | None
) -> Counter[str]:
    """Judge faults one after the other, telling each; how many ended how."""
    copy_of = project(folder)
    files = [str(f.relative_to(ROOT)) for f in sorted((ROOT / "tests").rglob("test_*.py"))]
    texts = {f: set(re.findall(r"[\w.*]+", written(ROOT / f))) for f in files}
    equivalent = tomllib.loads(EQUIVALENT.read_text(encoding="utf-8"))["equivalent"]
    same = {(e["path"], e["old"].strip(), e["new"].strip()): e["reason"] for e in equivalent}
    good, callers, clock = unchanged(copy_of), Callers(), [time.monotonic()]
    count: Counter[str] = Counter()

    def tell(fault: Fault, said: str) -> None:
        first = said.split()[0]
        word = WORDS.get(first, "SURVIVED")
        count[first if word == "noticed" else word] += 1
        clock.append(time.monotonic())
        print(f"{word} {clock[-1] - clock[-2]:.0f} s  {fault}\n-> {said}", flush=True)

    warm_up(kept)
    warm: list[Asked] = []
    cold: list[Asked] = []
    none: frozenset[str] = frozenset()
    for fault in asked:
        tests = near(fault, texts, callers)
        looked = data.tests(fault) if data else None
        ran, seldom = looked or (None, none)
        own = {test.split("::")[0] for test in ran or ()} & set(files)
        if own:
            others = [f for f in tests if f not in own]
            tests = [*(f for f in tests if f in own), *sorted(own - set(tests)), *others]
        idle = none
        if data and ran and len(ran) > SHARED:
            idle = data.known - ran
        reason = same.get((fault.path, fault.old.strip(), fault.new.strip()))
        if reason or not fault.source() or not tests:
            tell(fault, f"equivalent: {reason}" if reason else "gone" if tests else NONE)
        else:
            words = frozenset(re.findall("[a-z]+", fault.path[len("ssilang/") : -len(".py")]))
            words |= {name.lower() for name in callers.names(fault) if name.isupper()}
            apart = compiled(fault) or fault.path.startswith(SERVED)
            (cold if apart else warm).append((fault, tests, words, seldom, idle))
    for one, said in zip(warm, verdicts(copy_of, warm, seconds), strict=True):
        if (once and said != NOT_SO) or WORDS.get(said.split()[0]) == "noticed":
            tell(one[0], said)
        else:
            cold.append(one)
    for fault, *rest in cold:
        limit = COMPILES * seconds if compiled(fault) else seconds
        target = copy_of / fault.path
        was = target.read_bytes()
        target.write_text(fault.source() or "", encoding="utf-8")
        (said,) = verdicts(copy_of, [(None, *rest)], limit)
        target.write_bytes(was)
        if test := re.match(r"\w+ (tests/.*) \(", said):
            (alone,) = verdicts(copy_of, [(None, [test[1]], none, none, none)], limit)
            said = said if alone.startswith("passed") else f"passes not without it: {alone}"
        tell(fault, said)
        for made in set(kept.glob("ssilang/compiled/*")):
            if made.name not in good:
                shutil.rmtree(made)
    return count


def main() -> None:
    """Read the command line, try what it asks for, and tell the share and the score."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("count", nargs="?", type=int, default=100, help="mutants")
    parser.add_argument("seed", nargs="?", type=int, default=1, help="of the draw of lines")
    parser.add_argument("--seconds", type=float, default=60.0, help="of tests for a mutant")
    parser.add_argument("--under", nargs="+", default=["ssilang"], help="folders to draw from")
    parser.add_argument("--once", action="store_true", help="survivors get no process of their own")
    parser.add_argument("--again", type=Path, metavar="REPORT", help="survivors of a report")
    parser.add_argument("--ran", type=Path, metavar="DATA", help="coverage's, a context a test")
    parser.add_argument("--of", default="", metavar="COMMIT", help="whose lines DATA has")
    parser.add_argument("--list", action="store_true", help="print the faults and try none")
    asked = parser.parse_args()
    if asked.again:
        chosen, share = survivors(asked.again), f"the survivors of {asked.again.name}"
    else:
        chosen, share = drawn(asked.count, asked.seed, asked.under)
    if asked.list:
        print("\n".join(map(str, chosen)))
        return
    sys.dont_write_bytecode = True  # what is compiled once is kept, no mutant's
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    kept = Path(tempfile.gettempdir()) / f"mutants-{os.getuid()}"  # compiled code, for later runs
    os.environ["XDG_CACHE_HOME"] = str(kept)
    for library in LIBRARIES:
        import_module(library)
    with tempfile.TemporaryDirectory() as folder:
        data = Ran(asked.ran, asked.of) if asked.ran else None
        count = try_all(chosen, asked.seconds, Path(folder), kept, asked.once, data)
    ended = ", ".join(f"{n} {word}" for word, n in sorted(count.items()))
    noticed = count["assertion"] + count["crash"] + count["time"]
    tried = noticed + count["SURVIVED"]
    print(f"drawn from {share}; {ended}: {noticed} of {tried} noticed", end="")
    print(f" ({100 * noticed / tried:.0f} %)" if tried else "")


if __name__ == "__main__":
    main()
