"""How fast scripts are read and run.

    python benchmarks/language_speed.py

Prints seconds for: 1 000 lines of the decks of `cases/` parsed; 100 000 turns of a loop of three
scalar statements, of a loop with a condition, of writing and reading a table; 10 000 turns of
appending to a list by ET, of general operators, of calling a procedure, of MESS.

What bounds them: parsing, one regular expression and one object a token (about 2.5 microseconds);
scalar loops, one closure call a sign; ET, the copy of the list at each turn (quadratic: 10 000
items copy 400 MB); general operators, reading operands by type (about 7 microseconds a call).
"""

import time
from collections.abc import Callable
from pathlib import Path

from ssilang.cli.run import run_text
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse

_ROOT = Path(__file__).resolve().parents[1]
_SCRIPTS = {
    "100 000 turns, 3 scalar statements": "X = 0. ; Y = 1. ; REPE B 100000 ; X = X + 1. ; "
    "Y = Y * 0.5 + X ; Z = &B + 1 ; FIN B ;",
    "100 000 turns with SI": "X = 0. ; REPE B 100000 ; X = X + 1. ; SI (X > 5.) ; Y = X - 5. ; "
    "FINSI ; FIN B ;",
    "100 000 writes and reads of a table": "T = TABL ; REPE B 100000 ; T . &B = &B * 2 ; FIN B ; "
    "S = 0 ; REPE B 100000 ; S = S + T . &B ; FIN B ;",
    "10 000 appends by ET": "L = PROG ; REPE B 10000 ; L = L ET (FLOT &B) ; FIN B ;",
    "10 000 turns of EXTR, SIN, MOT": "L = PROG 1. 2. 3. ; REPE B 10000 ; X = EXTR L 2 ; "
    "Y = SIN X ; Z = MOT 'A' ; FIN B ;",
    "10 000 calls of a procedure": "DEBP P A*FLOTTANT ; R = A + 1. ; FINP R ; X = 0. ; "
    "REPE B 10000 ; X = P X ; FIN B ;",
    "10 000 MESS": "REPE B 10000 ; MESS 'a' &B 2.5 ; FIN B ;",
}


def seconds(action: Callable[[], object]) -> float:
    """Time of one call, the best of three."""
    best = float("inf")
    for _ in range(3):
        start = time.perf_counter()
        action()
        best = min(best, time.perf_counter() - start)
    return best


def main() -> None:
    """Print the table."""
    texts = [p.read_text(encoding="utf-8") for p in sorted(_ROOT.glob("cases/*/*.ssi"))]
    lines = sum(t.count("\n") for t in texts)
    parse(Source("warm", "X = 1 ;"))
    total = seconds(lambda: [parse(Source("deck", t)) for t in texts])
    print(f"{'1 000 lines of decks parsed':<40} {total / lines * 1000:8.3f} s")
    run_text("X = 1 ;")
    for name, text in _SCRIPTS.items():
        print(f"{name:<40} {seconds(lambda t=text: run_text(t)):8.3f} s")


if __name__ == "__main__":
    main()
