"""Damages decks word by word and input files piece by piece: only messages, never a traceback.

    python benchmarks/fuzz_decks.py decks [COUNT] [SEED]
    python benchmarks/fuzz_decks.py files [COUNT] [SEED]

Decks are those of `cases/` (with fewer cells and steps), the scripts of `tests/diagnostics` and the
script texts that stand in the tests; those that take longer than a bound are left out. Words are
swapped, deleted, doubled; numbers become 0, -1, 1.E300, NaN and their like. Files are of every
format that is read: what the interpreter writes, damaged, then read and used.

A child process runs some hundred mutants, so that a crash of the interpreter itself is seen, named
and does not end the campaign. Prints the outcomes and each defect once, with the mutant that shows
it; exits 1 if there is any. A defect: something of Python that comes out, an internal error, more
than 20 s of processor outside of the script's own loops.
"""

from __future__ import annotations

import ast
import io
import json
import os
import random
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from ssilang.cli.run import RunOptions, run_source
from ssilang.cli.signals import interrupt
from ssilang.language.run.session import Limits
from ssilang.language.text.source import Source
from ssilang.operators.loader import load_operators

ROOT = Path(__file__).resolve().parents[1]
SECONDS = 20  # of processor for a mutant
_STATEMENTS = 2000
_MEMORY = 3 * 2**30
_A_CHILD = 400  # mutants
_DECK_SECONDS = 0.3  # of processor for a deck that is as it was
_DECKS = 250  # in a campaign

# ---- decks ---------------------------------------------------------------------------------------

_WORD = re.compile(
    r"'(?:[^']|'')*'|(?<![\w)])[-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?(?!\w)"
    r"|[@&!]?\w+|\*\*|[<>]EG|\S"
)
_NUMBER = re.compile(r"[-+]?\.?\d")
_NUMBERS = ("0", "-1", "1.E300", "XNAN", "0.", "1", "-1.E300", "2", "1.E-300", "XINF", "1000000000")
_PICTURE = re.compile(r"^[ \t]*(?:TRAC|DESS)\b[^;]*;", re.MULTILINE | re.IGNORECASE)


def decks() -> list[str]:
    """Texts of scripts, of cases and tests, each once."""
    cases = [p.read_text(encoding="utf-8") for p in sorted((ROOT / "cases").rglob("*.ssi"))]
    texts = [_small(t) for t in cases]
    scripts = sorted((ROOT / "tests" / "diagnostics" / "scripts").glob("*.ssi"))
    texts += [p.read_text(encoding="utf-8") for p in scripts]
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                text = node.value
                if text.count(" ;") + text.count(";\n") > 2 and "{" not in text:
                    texts.append(text)
    return list(dict.fromkeys(texts))


def _small(text: str) -> str:
    """A deck with fewer cells and steps: numbers of many cells and short lists of times."""
    text = re.sub(r"(?<=\s)(?:[1-9]\d|[1-9]\d\d+)(?=[\s;)])", "3", text)
    step = r"('PAS' +)(\S+)( +)([\d.]+(?:E[-+]?\d+)?)(?=[\s;)])"
    return re.sub(step, r"\g<1>\2 'NPAS' 4", text, flags=re.IGNORECASE)


def mutated(text: str, rng: random.Random) -> str:
    """A text with one to three of its words swapped, deleted, doubled, or numbers replaced."""
    if rng.random() < 0.9:
        text = _PICTURE.sub("", text)
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        words = [m.span() for m in _WORD.finditer(_without_comments(text))]
        if len(words) < 2:
            return text
        start, end = rng.choice(words)
        numbers = [w for w in words if _NUMBER.match(text[w[0] :])]
        match rng.randrange(6):
            case 0:
                text = text[:start] + text[end:]
            case 1:
                text = text[:end] + " " + text[start:end] + text[end:]
            case 2:
                one, two = sorted(rng.sample(words, 2))
                text = "".join(
                    (text[: one[0]], text[slice(*two)], text[one[1] : two[0]],
                     text[slice(*one)], text[two[1] :])
                )  # fmt: skip
            case _ if numbers:
                start, end = rng.choice(numbers)
                text = f"{text[:start]} {rng.choice(_NUMBERS)} {text[end:]}"
            case _:
                other = rng.choice(words)
                text = text[:start] + text[slice(*other)] + text[end:]
    return text


def _without_comments(text: str) -> str:
    """The text with blanks where comments stand."""
    return re.sub(r"^\*.*$", lambda m: " " * len(m[0]), text, flags=re.MULTILINE)


# ---- files ---------------------------------------------------------------------------------------

_MAKE = """
OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ;
P0 = 0. 0. ; P1 = 1. 0. ; L1 = DROI 2 P0 P1 ; S1 = L1 TRAN 2 (0. 1.) ;
MO1 = MODE S1 'MECANIQUE' 'ELASTIQUE' 'ISOTROPE' ; MA1 = MATE MO1 'YOUN' 2.E7 'NU' 0.3 'RHO' 2. ;
RI1 = RIGI MO1 MA1 ; BL1 = BLOQ 'DEPL' L1 ; F1 = FORC 'FX' 3. P1 ; U1 = RESO (RI1 ET BL1) F1 ;
SI1 = SIGM MO1 MA1 U1 ; T1 = PROG 0. 'PAS' 0.1 1. ; EV1 = EVOL 'MANU' 'T' T1 'A' (T1 * T1) ;
CH1 = CHAR 'MECA' F1 EV1 ; TB1 = TABL ; TB1 . 1 = 2. ; TB1 . 'M' = S1 ; TB1 . 'T' = T1 ;
DEBP PR1 X*'FLOTTANT' ; FINP (X * 2.) ; TX1 = TEXT '2 + 3' ; LM1 = MOTS 'UX' 'UY' ; LE1 = LECT 1 2 ;
OPTI SAUV 'all.sauv' ; SAUV ;
OPTI SORT 'all' ; SORT 'AVS ' S1 U1 ;
OPTI SORT 'all.csv' ; SORT 'EXCE' T1 (T1 * T1) ;
OPTI SORT 'mesh' ; SORT S1 ;
OPTI SORT 'acq.txt' ; SORT 'CHAI' '3 4.5 7 8' ; SORT 'CHAI' ' 1.5E-3 ''WORD'' 2' ;
OPTI SORT 'two.procedur' ; SORT 'CHAI' 'DEBP TWICE X*''FLOTTANT'' ; FINP (2. * X) ;' ;
OPTI SORT 'q.at2' ; SORT 'CHAI' 'PEER' ; SORT 'CHAI' 'event' ; SORT 'CHAI' 'UNITS OF G' ;
SORT 'CHAI' 'NPTS= 8, DT= .01 SEC' ; SORT 'CHAI' ' 0. 0.1 -0.2 0.05' ;
SORT 'CHAI' ' .12E-02-.34E-02 0. 1.' ;
OPTI SORT 'line.unv' ;
SORT 'CHAI' '    -1' ; SORT 'CHAI' '  2411' ; SORT 'CHAI' ' 1 1 1 11' ; SORT 'CHAI' ' 0. 0. 0.' ;
SORT 'CHAI' ' 2 1 1 11' ; SORT 'CHAI' ' 2. 0. 0.' ; SORT 'CHAI' ' 3 1 1 11' ;
SORT 'CHAI' ' 2. 1.D0 0.' ; SORT 'CHAI' '    -1' ;
SORT 'CHAI' '    -1' ; SORT 'CHAI' '  2412' ; SORT 'CHAI' ' 1 11 1 1 7 2' ;
SORT 'CHAI' ' 0 1 1' ; SORT 'CHAI' ' 1 2' ; SORT 'CHAI' ' 2 91 1 1 7 3' ; SORT 'CHAI' ' 1 2 3' ;
SORT 'CHAI' '    -1' ;
SORT 'CHAI' '    -1' ; SORT 'CHAI' '  2467' ; SORT 'CHAI' ' 1 0 0 0 0 0 0 2' ; SORT 'CHAI' 'GRP' ;
SORT 'CHAI' ' 8 1 0 0 7 2 0 0' ; SORT 'CHAI' '    -1' ;
OPTI DIME 3 ELEM TRI3 ; TR1 = MANU 'TRI3' (0 0 0) (1 0 0) (0 1 0) ;
OPTI SORT 'one' ; SORT 'STL ' TR1 ;
"""
_USE = {
    "all.sauv": "OPTI REST '{f}' ; REST ; LIST S1 ; LIST U1 ; LIST T1 ; LIST TB1 ; LIST MO1 ;"
    " LIST (MESU S1) ; LIST (MAXI (EXTR EV1 'ORDO')) ; U2 = RESO (RI1 ET BL1) F1 ; LIST U2 ;"
    " X = PR1 2. ; LIST SI1 ; LIST (TIRE CH1 0.5) ; LIST (MAXI (SIGM MO1 MA1 U1)) ; LIST LM1 ;"
    " LIST LE1 ; X = TX1 ; LIST X ; LIST RI1 ; LIST EV1 ; ELIM S1 0.01 ; Z = S1 ET L1 ; LIST Z ;"
    " OPTI SAUV 'again' ; SAUV ;",
    "all.inp": "OPTI LECT '{f}' ; T = LIRE 'AVS' ; LIST T ; LIST (T . 'LEMAILLA') ;"
    " LIST (MESU (T . 'LEMAILLA')) ; LIST (MAXI (T . 'LECHPOIN')) ;",
    "all.csv": "T = LIRE 'CSV' '{f}' ; LIST (T . 1) ; E = EVOL 'MANU' (T . 1) (T . 2) ;"
    " LIST (MAXI (INTG E)) ; T = LIRE 'CSV' '{f}' 'DEBU' 2 'LIGN' ; LIST T ;",
    "mesh": "OPTI LECT '{f}' ; LIRE S1 ; LIST S1 ; LIST (MESU S1) ;",
    "acq.txt": "OPTI ACQU '{f}' ; ACQU I*ENTIER X*FLOTTANT L*LISTENTI 2 ; LIST I ; LIST L ;"
    " ACQU X M*MOT N ; LIST X ; LIST M ; LIST N ;",
    "two.procedur": "LIRE 'PROC' '{f}' ; LIST (TWICE 4.) ;",
    "q.at2": "E = LIRE 'PEER' '{f}' 9.81 ; LIST (MAXI (EXTR E 'ORDO')) ; LIST (INTG E) ;"
    " LIST (MAXI (EXTR E 'ABSC')) ;",
    "line.unv": "OPTI DIME 3 ; T = LIRE 'UNV' '{f}' ; LIST T ; LIST (T . 'MAILLAGE') ;"
    " LIST (MESU (T . '@SEG2')) ; LIST (T . 'GRP') ; LIST (MESU (T . '@TRI3')) ;",
    "one.stl": "OPTI DIME 3 ; M = LIRE 'STL' '{f}' ; LIST M ; LIST (MESU M) ; ELIM M 1.E-3 ;"
    " LIST (NBEL (CONT M)) ;",
}
_PIECES = (b"0", b"-1", b"1.E300", b"NaN", b"inf", b"1000000000000", b"99999999999999999999999",
           b"", b"x", b"1e400", b"\x00", b"\xff", b"'", b"2.5", b"[]", b"null", b"\n")  # fmt: skip


def made_files(folder: Path) -> dict[str, bytes]:
    """A file of each format, as the interpreter writes it."""
    source = Source("make", _MAKE, folder / "make.ssi")
    result = run_source(source, RunOptions(folder), io.StringIO(), io.StringIO())
    if result.errors:
        raise RuntimeError(result.message)
    return {p.name: p.read_bytes() for p in sorted(folder.iterdir()) if p.name in _USE}


def damaged(data: bytes, rng: random.Random) -> bytes:
    """A file cut, with bytes or words or lines changed; an archive is damaged inside too."""
    if data[:2] == b"PK" and rng.random() < 0.8:
        return _damaged_archive(data, rng)
    for _ in range(rng.choice((1, 1, 2, 4))):
        data = rng.choice(_DAMAGES)(data, rng)
    return data


def _cut(data: bytes, rng: random.Random) -> bytes:
    return data[: rng.randrange(len(data) + 1)]


def _flip(data: bytes, rng: random.Random) -> bytes:
    if not data:
        return data
    at = rng.randrange(len(data))
    return data[:at] + bytes((rng.randrange(256),)) + data[at + 1 :]


def _lines(data: bytes, rng: random.Random) -> bytes:
    lines = data.split(b"\n")
    at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(3):
        case 0:
            del lines[at]
        case 1:
            lines.insert(other, lines[at])
        case _:
            lines[at], lines[other] = lines[other], lines[at]
    return b"\n".join(lines)


def _words(data: bytes, rng: random.Random) -> bytes:
    found = [m.span() for m in re.finditer(rb"[-+\w.]+", data)]
    if not found:
        return data
    start, end = rng.choice(found)
    other = rng.choice(found)
    piece = data[slice(*other)] if rng.random() < 0.3 else rng.choice(_PIECES)
    return data[:start] + piece + data[end:]


_DAMAGES: tuple[Callable[[bytes, random.Random], bytes], ...] = (
    _cut, _flip, _lines, _words, _words, _words, _words,
)  # fmt: skip


def _damaged_archive(data: bytes, rng: random.Random) -> bytes:
    """Members of the archive damaged, packed again without a fault of the packing."""
    with zipfile.ZipFile(io.BytesIO(data)) as z:
        members = {n: z.read(n) for n in z.namelist()}
    for _ in range(rng.choice((1, 1, 2))):
        name = "objects.json" if rng.random() < 0.7 else rng.choice(sorted(members))
        if name == "objects.json" and rng.random() < 0.7:
            members[name] = _damaged_json(members[name], rng)
        elif rng.random() < 0.1:
            other = rng.choice(sorted(members))
            members[name] = members[other]
        else:
            members[name] = rng.choice((_flip, _flip, _cut, _words))(members[name], rng)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as z:
        for name, content in members.items():
            if rng.random() > 0.01:
                z.writestr(name, content)
    return packed.getvalue()


def _damaged_json(data: bytes, rng: random.Random) -> bytes:
    """A tree of JSON with one of its leaves or branches replaced by another."""
    try:
        tree = json.loads(data)
    except ValueError:
        return data
    places = list(_places(tree))
    if not places:
        return data
    holder, key = rng.choice(places)
    other_holder, other_key = rng.choice(places)
    spare = [0, -1, 1, 1e300, float("nan"), "", "x", None, [], {}, 10**30, True, ["o", 0], ["a", 0]]
    match rng.randrange(4):
        case 0:
            del holder[key]
        case 1:
            holder[key] = json.loads(json.dumps(other_holder[other_key]))
        case _:
            holder[key] = rng.choice(spare)
    return json.dumps(tree).encode()


def _places(tree: object) -> Iterator[tuple[object, object]]:
    """All holders and keys in a tree of JSON."""
    inside = enumerate(tree) if isinstance(tree, list) else tree.items()  # type: ignore[attr-defined]
    for key, value in list(inside):
        yield tree, key
        if isinstance(value, list | dict):
            yield from _places(value)


# ---- running -------------------------------------------------------------------------------------


@dataclass
class Found:
    """What a campaign has found.

    Attributes
    ----------
    outcomes : Counter
        Number of mutants by how they ended.
    defects : dict of str to str
        A defect and the shortest mutant that shows it.
    """

    outcomes: Counter[str] = field(default_factory=Counter)
    defects: dict[str, str] = field(default_factory=dict)

    def add(self, outcome: str, defect: str, mutant: str) -> None:
        """Count a mutant; a new defect is printed."""
        self.outcomes[outcome] += 1
        if not defect:
            return
        if defect not in self.defects:
            print(f"found: {defect}\n{mutant}", flush=True)
        if len(mutant) < len(self.defects.get(defect, "x" * 10**6)):
            self.defects[defect] = mutant


def outcome(text: str, folder: Path, seconds: float = SECONDS) -> tuple[str, str]:
    """Run a script in a folder: how it ended, and the defect that it shows or ''."""
    options = RunOptions(
        folder / "out",
        limits=Limits(50, _STATEMENTS),
        given={"XNAN": float("nan"), "XINF": float("inf")},
        summary=True,
    )
    err = io.StringIO()
    signal.signal(signal.SIGPROF, interrupt)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        result = run_source(
            Source("mutant.ssi", text, folder / "mutant.ssi"), options, io.StringIO(), err
        )
    except KeyboardInterrupt:
        return "defect", "slow, outside of the run"
    except BaseException as problem:
        name = type(problem).__name__
        return "defect", f"crash {name} at {_place(problem)}: {_plain(str(problem))}"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    for error in result.errors:
        if error.code == "interrupted":
            word = error.span.text[:60] if error.span else ""
            return "defect", f"slow: {word}"
        if error.code == "internal":
            kind, reason = error.data["kind"], _plain(str(error.data["reason"]))
            return "defect", f"internal {kind} at {_place(error)}: {reason}"
    if "Traceback" in err.getvalue():
        return "defect", "traceback in the messages"
    return ("failed with a message" if result.errors else "ran"), ""


def _place(problem: BaseException) -> str:
    """Where the innermost exception left a file of ssilang."""
    while problem.__cause__ is not None:
        problem = problem.__cause__
    frames = traceback.extract_tb(problem.__traceback__)
    inside = [f for f in frames if "/ssilang/" in f.filename]
    if not inside:
        return "?"
    return f"{inside[-1].filename.rpartition('/ssilang/')[2]}:{inside[-1].lineno}"


def _plain(text: str) -> str:
    """A reason without its numbers: one defect has one name."""
    return re.sub(r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?", "#", text.split("\n")[0])[:100]


Mutant = Callable[[random.Random, Path], str]


def campaign(make: Mutant, count: int, seed: int) -> Found:
    """Run so many mutants in child processes, each of its own seed."""
    found = Found()
    began = time.monotonic()
    for start in range(0, count, _A_CHILD):
        numbers = range(start, min(start + _A_CHILD, count))
        at = numbers.start
        while at < numbers.stop:  # a child that crashes is followed by one that goes on behind
            at = _child(make, range(at, numbers.stop), seed, found)
        if start % (10 * _A_CHILD) == 0:
            done, spent = numbers.stop, time.monotonic() - began
            print(f"{done} in {spent:.0f} s, {dict(found.outcomes)}", flush=True)
    return found


def _child(make: Mutant, numbers: range, seed: int, found: Found) -> int:
    """Run mutants in a child process; the number behind the last one that was run."""
    reads, writes = os.pipe()
    pid = os.fork()
    if pid == 0:
        os.close(reads)
        with os.fdopen(writes, "w", encoding="utf-8") as told:
            _run_numbers(make, numbers, seed, told)
        os._exit(0)
    os.close(writes)
    at = numbers.start
    text = ""
    with os.fdopen(reads, encoding="utf-8") as told:
        for line in told:
            message = json.loads(line)
            if len(message) == 1:
                text = message[0]
            else:
                found.add(*message, text)
                at, text = at + 1, ""
    _, status = os.waitpid(pid, 0)
    if status or text:
        found.add("defect", f"the interpreter ended with status {status}", text)
        return at + 1
    return numbers.stop


def _run_numbers(make: Mutant, numbers: range, seed: int, told: io.TextIOBase) -> None:
    resource.setrlimit(resource.RLIMIT_DATA, (_MEMORY, _MEMORY))
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    for number in numbers:
        with tempfile.TemporaryDirectory(prefix="fuzz_decks_") as folder:
            text = f"* mutant {number} of {seed}\n"
            text += make(random.Random(f"{seed} {number}"), Path(folder))
            told.write(json.dumps([text]) + "\n")
            told.flush()
            told.write(json.dumps(outcome(text, Path(folder))) + "\n")


def quick(texts: list[str], rng: random.Random) -> list[str]:
    """Some of the decks, of those that take little time as they are."""
    kept: list[str] = []
    for text in rng.sample(texts, len(texts)):
        with tempfile.TemporaryDirectory(prefix="fuzz_decks_") as folder:
            spent = 10.0
            for _ in range(2):  # the first time may compile
                if spent > _DECK_SECONDS and len(kept) < _DECKS:
                    began = time.process_time()
                    outcome(_PICTURE.sub("", text), Path(folder), 5 * _DECK_SECONDS)
                    spent = time.process_time() - began
        if spent < _DECK_SECONDS:
            kept.append(text)
    return kept


def main() -> int:
    """Run a campaign."""
    what = sys.argv[1] if len(sys.argv) > 1 else "decks"
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    load_operators()
    if what == "decks":
        all_texts = decks()
        texts = quick(all_texts, random.Random(seed))
        print(f"{len(texts)} decks of {len(all_texts)}", flush=True)
        found = campaign(lambda rng, _: mutated(rng.choice(texts), rng), count, seed)
    else:
        with tempfile.TemporaryDirectory() as folder:
            files = made_files(Path(folder))
        found = campaign(lambda rng, base: damaged_input(files, rng, base), count, seed)
    print(dict(found.outcomes))
    for name, text in sorted(found.defects.items()):
        print(f"DEFECT {name}\n{text}\n")
    return 1 if found.defects else 0


def damaged_input(files: dict[str, bytes], rng: random.Random, folder: Path) -> str:
    """Write a damaged file into a folder; the script that reads it."""
    name = rng.choice(sorted(files))
    (folder / name).write_bytes(damaged(files[name], rng))
    return _USE[name].format(f=name)


if __name__ == "__main__":
    sys.exit(main())
