"""Mutates the examples of the help word by word and runs them: only messages, never a traceback.

    python benchmarks/fuzz_interpreter.py [COUNT] [SEED] [NAME ...]

Examples are those of all operators and procedures, or of the names given.
Prints how many runs succeeded, failed with a message, and each defect (an operator that let
something of Python through) once, with the shortest script that shows it; exits 1 if any.
"""

import io
import random
import re
import signal
import sys
import tempfile
from collections import Counter
from pathlib import Path

from ssilang.cli.interrupts import interrupt
from ssilang.cli.run import RunOptions, run_source
from ssilang.language.registry import OPERATORS
from ssilang.language.run.library import standard_procedures
from ssilang.language.run.session import Limits
from ssilang.language.say.reference import procedure_page
from ssilang.language.text.source import Source
from ssilang.operators.loader import load_operators

_TOKEN = re.compile(
    r"'[^']*'|(?<![\w)])[-+]?(?:\d+\.?\d*|\.\d+)(?:[EDed][-+]?\d+)?(?!\w)"
    r"|[@&!]?\w+|\*\*|[<>]EG|[-+*/<>=();.%]"
)
_NUMBERS = ["1", "-1", "0", "2.5", "-3.", "1E9", "1000", "VRAI"]
_SPARE = [*_NUMBERS, "'ABC'", "''", "(0. 0.)", "(PROG 1. 2.)", "(PROG)", "(LECT 3)", "(TABL)"]
_FIXED = frozenset("();=.")  # changing these makes errors of syntax, which another script tries
_STATEMENTS = 2000
_SECONDS = 20


def examples(names: list[str]) -> list[list[str]]:
    """Examples of operators and procedures (all without names), cut to words."""
    load_operators()
    helps = {o.full_name: o.help for o in OPERATORS.values()}
    helps |= {n: procedure_page(p).help for n, p in standard_procedures().items()}
    wanted = [h for n, h in helps.items() if not names or n in names or n[:4] in names]
    texts = {e for h in wanted for e in h.examples}
    return [_TOKEN.findall(t) for t in sorted(texts) if "TRAC" not in t and "DESS" not in t]


def mutated(words: list[str], pool: list[list[str]], rng: random.Random) -> str:
    """A script with one to three words dropped, doubled, swapped or replaced by others."""
    words = list(words)
    numbers = [i for i, w in enumerate(words) if re.match(r"[-+]?\.?\d", w)]
    if numbers and rng.random() < 0.6:  # values alone: what operators must check for themselves
        for at in rng.sample(numbers, min(len(numbers), rng.randint(1, 2))):
            words[at] = rng.choice(_NUMBERS)
        return " ".join(words) + " ;"
    for _ in range(rng.randint(1, 3)):
        free = [i for i, w in enumerate(words) if w not in _FIXED]
        at = rng.choice(free)
        match rng.randint(0, 3):
            case 0 if len(free) > 1:
                del words[at]
            case 1:
                words.insert(at, rng.choice(_SPARE))
            case 2:
                words[at] = rng.choice([w for w in rng.choice(pool) if w not in _FIXED])
            case _:
                other = rng.choice(free)
                words[at], words[other] = words[other], words[at]
    return " ".join(words) + " ;"


def main() -> int:
    """Run the campaign."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
    rng = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    pool = examples([n.upper() for n in sys.argv[3:]])
    outcomes: Counter[str] = Counter()
    defects: dict[str, str] = {}
    signal.signal(signal.SIGALRM, interrupt)
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(count):
            text = mutated(rng.choice(pool), pool, rng)
            options = RunOptions(Path(folder), limits=Limits(50, _STATEMENTS))
            source = Source("mutant", text, Path(folder) / "mutant.ssi")
            signal.alarm(_SECONDS)
            try:
                result = run_source(source, options, io.StringIO(), io.StringIO())
            except Exception as problem:
                _keep(defects, f"crash {type(problem).__name__}: {problem}", text)
                continue
            finally:
                signal.alarm(0)
            outcomes["ran" if not result.errors else "failed with a message"] += 1
            for error in result.errors:
                if error.code == "interrupted":
                    _keep(defects, f"slow, line {error.span.text[:60] if error.span else ''}", text)
                if error.code == "internal":
                    name = f"{error.data['operator']} {error.data['kind']}: {error.data['reason']}"
                    _keep(defects, name[:120], text)
    print(dict(outcomes))
    for name, text in sorted(defects.items()):
        print(f"DEFECT {name}\n    {text}")
    return 1 if defects else 0


def _keep(defects: dict[str, str], name: str, text: str) -> None:
    if name not in defects:
        print(f"found: {name}", flush=True)
    if len(text) < len(defects.get(name, "x" * 10**6)):
        defects[name] = text


if __name__ == "__main__":
    sys.exit(main())
