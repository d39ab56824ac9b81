"""Mutates scripts byte by byte and parses them: no traceback, no hang, memory bounded.

    python benchmarks/fuzz_parser.py [COUNT] [SEED] [FILES ...]

Without files the decks of `cases/` and `stdlib/` are the seeds. Long seeds are cut to pieces of a
few statements. Prints how many inputs were parsed, refused, and the slowest; exits 1 on a failure.
"""

import random
import resource
import sys
import time
from pathlib import Path

from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse

_ROOT = Path(__file__).resolve().parents[1]
_WORDS = [
    "'",
    "(",
    ")",
    ";",
    "=",
    ".",
    "*",
    "%",
    "&",
    "!",
    "SI",
    "FINSI;",
    "REPE_B_2;",
    "FIN_B;",
    "DEBP_P;",
    "FINP;",
    "1.E",
]
_BYTES = [w.replace("_", " ").encode() for w in _WORDS] + [b"\n*", b" ", b"\xe9", b"\x00", b"\xff"]
_SECONDS = 5.0


def seeds(files: list[str]) -> list[bytes]:
    """Pieces of 1 to 8 statements of the files."""
    paths = [Path(f) for f in files] or sorted(_ROOT.glob("cases/*/*.ssi")) + sorted(
        _ROOT.glob("stdlib/*.ssi")
    )
    pieces: list[bytes] = []
    for path in paths:
        statements = path.read_bytes().split(b";")
        for start in range(0, len(statements), 5):
            pieces.append(b";".join(statements[start : start + 8]))
    return [p for p in pieces if p.strip()]


def mutated(piece: bytes, rng: random.Random) -> bytes:
    """A piece with one to six random changes."""
    data = bytearray(piece)
    for _ in range(rng.randint(1, 6)):
        at = rng.randint(0, len(data))
        match rng.randint(0, 3):
            case 0:
                data[at:at] = rng.choice(_BYTES)
            case 1:
                del data[at : at + rng.randint(1, 8)]
            case 2 if data:
                data[at % len(data)] = rng.randint(0, 255)
            case _:
                other = rng.randint(0, len(data))
                data[at:at] = data[other : other + rng.randint(1, 12)]
    return bytes(data)


def decoded(data: bytes) -> str:
    """As a script file is read."""
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def main() -> int:
    """Run the campaign."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    rng = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    pool = seeds(sys.argv[3:])
    parsed, slowest = 0, 0.0
    for number in range(count):
        text = decoded(mutated(rng.choice(pool), rng))
        start = time.perf_counter()
        try:
            parse(Source("mutant", text))
            parsed += 1
        except SeveralErrors as several:
            for error in several.errors:
                render(error, "en" if number % 2 else "fr")
        except Exception as problem:
            print(f"input {number}: {type(problem).__name__}: {problem}\n{text!r}")
            return 1
        slowest = max(slowest, time.perf_counter() - start)
        if slowest > _SECONDS:
            print(f"input {number} took {slowest:.1f} s\n{text!r}")
            return 1
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{count} inputs: {parsed} parsed, {count - parsed} refused with messages")
    print(f"slowest {slowest * 1e3:.0f} ms, memory {memory:.0f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
