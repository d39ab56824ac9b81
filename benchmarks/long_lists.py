"""Pasted data: seconds of processor against length.

    python benchmarks/long_lists.py [kind ...]

Lists, messages, sums, unions, tables and strings written out in a script, 10 000 and 100 000 long
(strings 1 and 10 million letters), each script parsed and run in this process, the start of the
program left out. Beside the seconds, the exponent of growth between the two lengths: 1 is linear.
"""

import math
import sys
import time
from collections.abc import Callable

from ssilang.cli.run import run_text

LENGTH = 10_000
KINDS: dict[str, Callable[[int], str]] = {
    "PROG": lambda n: "L = PROG " + " ".join(f"{0.37 * i:.4f}" for i in range(n)) + " ;",
    "PROG, repetitions": lambda n: "L = PROG " + "2 * 1.5 " * n + ";",
    "PROG, steps": lambda n: "L = PROG 0. " + "".join(f"PAS 1. {i}. " for i in range(1, n)) + ";",
    "PROG, names": lambda n: "A = 1.5 ; L = PROG " + "A " * n + ";",
    "LECT": lambda n: "L = LECT " + " ".join(map(str, range(n))) + " ;",
    "MOTS": lambda n: "L = MOTS " + "'UX' " * n + ";",
    "EVOL MANU": lambda n: f"E = EVOL 'MANU' (PROG {'1. ' * n}) (PROG {'2. ' * n}) ;",
    "LIST": lambda n: f"L = PROG 1. PAS 1. NPAS {n} ; LIST L ;",
    "MESS": lambda n: "MESS " + "1.5 " * n + ";",
    "a + b + ...": lambda n: "A = 1.5 ; X = A" + " + A" * n + " ;",
    "lists: a + b + ...": lambda n: "A = PROG 1. ; X = A" + " + A" * n + " ;",
    "a ET b ET ...": lambda n: "A = VRAI ; X = A" + " ET A" * n + " ;",
    "a table": lambda n: "T = TABL ;" + "".join(f"T . {i} = {i}. ;\n" for i in range(n)),
    "a string": lambda n: "A = '" + "x" * (100 * n) + "' ;",
}


def seconds(script: str) -> float:
    """Processor time of a script, the shorter of two runs."""
    times = []
    for _ in range(2):
        started = time.process_time()
        result = run_text(script)
        times.append(time.process_time() - started)
        if result.exit_code:
            raise SystemExit(result.message)
    return min(times)


def main() -> None:
    """One line a kind."""
    start = seconds("X = 1 ;")
    print("| | 10 000 | 100 000 | growth |\n| --- | --- | --- | --- |")
    for kind in sys.argv[1:] or KINDS:
        some, many = (seconds(KINDS[kind](n)) - start for n in (LENGTH, 10 * LENGTH))
        print(f"| {kind} | {some:.3f} | {many:.2f} | n^{math.log10(many / some):.1f} |", flush=True)


if __name__ == "__main__":
    main()
