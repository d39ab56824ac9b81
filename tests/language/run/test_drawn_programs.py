"""Drawn programs against Python: conditions, loops, procedures, tables; `check` is content."""

import math
import random
from functools import partial
from typing import Any

from together import together

from ssilang.cli.check import check_source
from ssilang.cli.run import run_text
from ssilang.language.text.source import Source

OPERATIONS = {
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b,
}  # fmt: skip
COMPARISONS = {
    "<": lambda a, b: a < b, ">": lambda a, b: a > b, "<EG": lambda a, b: a <= b,
    ">EG": lambda a, b: a >= b, "EGA": lambda a, b: a == b, "NEG": lambda a, b: a != b,
}  # fmt: skip


MODU = "DEBP MODU N*ENTIER ; N1 = N / 1000 * 1000 ; N2 = N - N1 ; FINP N2 ;"


def modulus(number: int) -> int:
    """As MODU: whole numbers are divided towards zero."""
    return int(math.fmod(number, 1000))


def _both(operation: Any, left: Any, right: Any, values: dict[str, Any]) -> Any:
    return operation(left(values), right(values))


class Leave(Exception):
    """A loop is left, or its turn."""


class Program:
    """Lines of a program, and the functions that do the same to a dictionary of values.

    Names: A to E hold whole numbers, X to Z numbers, S and R texts, T a table; what begins with P
    is local to a procedure.
    """

    def __init__(self, seed: int) -> None:
        self.rng, self.lines, self.loops = random.Random(seed), [], []
        self.numbers = [*"ABCDE"]
        self.procedures: list[tuple[str, Any]] = []

    def write(self, line: str, depth: int) -> None:
        self.lines.append("  " * depth + line)

    def whole(self, depth: int = 0) -> tuple[str, Any]:
        """A phrase for a whole number: read from left to right, whatever the signs."""
        said, run = self._term(depth)
        for _ in range(self.rng.choice((0, 1, 1, 2))):
            sign = self.rng.choice([*OPERATIONS])
            other, get = self._term(depth)
            said = f"{said} {sign} {other}"
            run = partial(_both, OPERATIONS[sign], run, get)
        return f"MODU ({said})", lambda v: modulus(run(v))

    def _term(self, depth: int) -> tuple[str, Any]:
        kind = self.rng.randrange(6)
        if kind == 0 and depth < 2:
            said, run = self.whole(depth + 1)
            return f"({said})", run
        if kind == 1:
            key = self.rng.choice(("1", "7", "'KEY'", "'Other'"))
            return f"(T . {key})", lambda v: v["T"][key]
        if kind == 2 and self.loops:
            name = self.rng.choice(self.loops)
            return f"&{name}", lambda v: v["&" + name]
        if kind == 3 and self.procedures:
            name, run = self.rng.choice(self.procedures)
            first, a = self._plain()
            if self.rng.random() < 0.5:
                return f"({name} {first})", lambda v: run(v, a(v), None)
            second, b = self._plain()
            return f"({name} {first} {second})", lambda v: run(v, a(v), b(v))
        return self._plain()

    def _plain(self) -> tuple[str, Any]:
        if self.rng.random() < 0.4:
            number = self.rng.randrange(1, 60)
            return str(number), lambda v: number
        name = self.rng.choice(self.numbers)
        return name, lambda v: v[name]

    def condition(self) -> tuple[str, Any]:
        sign = self.rng.choice([*COMPARISONS])
        (left, a), (right, b) = self.whole(1), self.whole(1)
        said, run = f"(({left}) {sign} ({right}))", lambda v: COMPARISONS[sign](a(v), b(v))
        kind = self.rng.randrange(4)
        if kind == 0:
            return f"(NON {said})", lambda v: not run(v)
        if kind < 3:
            other, get = f"(({left}) > 20)", lambda v: a(v) > 20
            if kind == 1:
                return f"({said} ET {other})", lambda v: run(v) and get(v)
            return f"({said} OU {other})", lambda v: run(v) or get(v)
        return said, run

    def block(self, depth: int, length: int) -> Any:
        """Some statements; what runs them."""
        steps = [self.statement(depth) for _ in range(length)]

        def run(v: dict[str, Any]) -> None:
            for step in steps:
                step(v)

        return run

    def statement(self, depth: int) -> Any:
        kind = self.rng.randrange(10)
        if kind == 0 and depth < 3:
            return self._branch(depth)
        if kind == 1 and depth < 3:
            return self._loop(depth)
        if kind == 2 and self.loops and depth:
            return self._leave(depth)
        said, run = self.whole()
        if kind == 3:
            key = self.rng.choice(("1", "7", "'KEY'", "'Other'"))
            self.write(f"T . {key} = {said} ;", depth)
            return lambda v: v["T"].__setitem__(key, run(v))
        if kind == 4:
            self.write(f"S = CHAI S '-' ({said}) ;", depth)
            return lambda v: v.__setitem__("S", f"{v['S']}-{run(v)}")
        if kind == 5:
            self.write(f"X = X + (FLOT ({said}) / 8.) ;", depth)
            return lambda v: v.__setitem__("X", v["X"] + run(v) / 8.0)
        if kind == 6:
            other, get = self.whole()
            a, b = self.rng.sample(self.numbers, 2)
            self.write(f"{a} {b} = ({said}) ({other}) ;", depth)
            return lambda v: v.update(zip((a, b), (run(v), get(v)), strict=True))
        name = self.rng.choice(self.numbers)
        self.write(f"{name} = {said} ;", depth)
        return lambda v: v.__setitem__(name, run(v))

    def _branch(self, depth: int) -> Any:
        said, holds = self.condition()
        self.write(f"SI {said} ;", depth)
        then, otherwise = self.block(depth + 1, self.rng.randrange(1, 4)), lambda v: None
        if self.rng.random() < 0.6:
            self.write("SINON ;", depth)
            otherwise = self.block(depth + 1, self.rng.randrange(1, 3))
        self.write("FINS ;", depth)
        return lambda v: (then if holds(v) else otherwise)(v)

    def _loop(self, depth: int) -> Any:
        name, count = f"LO{len(self.lines)}", self.rng.randrange(0, 4)
        self.write(f"REPE {name} {count} ;", depth)
        self.loops.append(name)
        body = self.block(depth + 1, self.rng.randrange(1, 4))
        self.loops.pop()
        self.write(f"FIN {name} ;", depth)

        def run(v: dict[str, Any]) -> None:
            for turn in range(1, count + 1):
                v["&" + name] = turn
                try:
                    body(v)
                except Leave as left:
                    if left.args[1] != name:
                        raise
                    if left.args[0] == "QUIT":
                        break

        return run

    def _leave(self, depth: int) -> Any:
        word, name = self.rng.choice(("QUIT", "ITER")), self.rng.choice(self.loops)
        said, holds = self.condition()
        self.write(f"SI {said} ; {word} {name} ; FINS ;", depth)

        def run(v: dict[str, Any]) -> None:
            if holds(v):
                raise Leave(word, name)

        return run

    def procedure(self) -> None:
        """Of a number and one more that may be left out; it sees the caller's names."""
        name = f"PRO{len(self.procedures)}"
        self.write(f"DEBP {name} PA*ENTIER PB/ENTIER ;", 0)
        self.write("SI (EXIS PB) ; PC = PA + PB ; SINON ; PC = PA - 3 ; FINS ;", 1)
        outer, self.numbers = self.numbers, ["PA", "PC"]
        loops, self.loops = self.loops, []
        said, run = self.whole()
        self.numbers, self.loops = outer, loops
        self.write(f"PC = {said} ;", 1)
        self.write("FINP (MODU PC) ;", 0)

        def call(v: dict[str, Any], a: int, b: int | None) -> int:
            own = {**v, "PA": a, "PC": a + b if b is not None else a - 3}
            return modulus(run(own))

        self.procedures.append((name, call))


@together("seed", range(40))
def test_drawn_programs_do_what_python_does(seed):
    program = Program(seed)
    values = {name: 3 * i + 1 for i, name in enumerate("ABCDE")}
    values |= {"X": 0.5, "S": "s", "T": {"1": 4, "7": -2, "'KEY'": 11, "'Other'": 5}}
    for name in "ABCDE":
        program.write(f"{name} = {values[name]} ;", 0)
    program.write("X = 0.5 ; S = 's' ; T = TABL ;", 0)
    for key, value in values["T"].items():
        program.write(f"T . {key} = {value} ;", 0)
    program.write(MODU, 0)
    for _ in range(2):
        program.procedure()
    program.block(0, 22)(values)
    text = "\n".join(program.lines) + "\n"
    result = run_text(text)
    assert result.exit_code == 0, result.message + text
    found = {name: result.session.root.find(name) for name in "ABCDEXST"}
    table = found.pop("T")
    found["T"] = {k: table.get(int(k) if k.isdigit() else k.strip("'")) for k in values["T"]}
    assert found == {name: values[name] for name in "ABCDEXST"}, text
    problems, _ = check_source(Source("script", text))
    assert [p.code for p in problems if p.severity == "error"] == [], text
