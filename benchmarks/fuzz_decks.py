"""Damages decks word by word and input files piece by piece: only messages, never a traceback.

    python benchmarks/fuzz_decks.py decks [COUNT] [SEED]
    python benchmarks/fuzz_decks.py files [COUNT] [SEED]

Decks are those of `cases/` (with fewer cells and steps), the scripts of `tests/diagnostics` and the
script texts that stand in the tests; quick ones, and those whose mutants go on for long, are taken
more often. Words are swapped, deleted, doubled; numbers become 0, -1, 1.E300, NaN and their like.
Files are of every format that is read: what the interpreter writes, damaged, then read and used.

A child process runs some hundred mutants, so that a crash of the interpreter itself is seen, named
and does not end the campaign. Mutants of a deck share what stands before their first damage: the
deck runs once, and where a mutant begins to differ a process is split off that goes on with it.
Prints the outcomes and each defect once, with the mutant that shows it; exits 1 if there is any.
A defect: something of Python that comes out, an internal error, more than 20 s of processor
outside of the script's own loops, a figure that is not finite without a word.
"""

import ast
import gc
import io
import json
import math
import os
import random
import re
import resource
import shutil
import signal
import sys
import tempfile
import traceback
import zipfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType

if __name__ == "__main__":  # threads do not follow into a child process
    os.environ |= dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")

import ssilang.cli.run as running
from ssilang.cli.interrupts import interrupt
from ssilang.cli.run import RunOptions, RunResult, run_source
from ssilang.language.run.session import Limits, Session
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.operators.loader import load_operators

ROOT = Path(__file__).resolve().parents[1]
SECONDS = 20  # of processor for a mutant
_STATEMENTS = 2000
_MEMORY = 3 * 2**30
_A_CHILD = 1600  # mutants
_LOOP_SECONDS = 4  # of processor, after which a run that turns in a loop of its own is stopped
_SUPPOSED_SECONDS = 0.05  # of processor for a mutant of a deck that was not drawn yet
_SPLIT_SECONDS = 0.012  # a deck that takes less is run whole: splitting a process costs as much
_OF_A_DECK = 16  # mutants of a deck that share their beginning

# ---- decks ---------------------------------------------------------------------------------------

_WORD = re.compile(
    r"'(?:[^']|'')*'|(?<![\w)])[-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?(?!\w)"
    r"|[@&!]?\w+|\*\*|[<>]EG|\S"
)
_NUMBER = re.compile(r"[-+]?\.?\d")
_NUMBERS = ("0", "-1", "1.E300", "XNAN", "0.", "1", "-1.E300", "2", "1.E-300", "XINF", "1000000000")
_GIVEN = re.compile(r"XNAN|XINF|\bNAN\b|\bINF\b", re.IGNORECASE)
_NOT_FINITE = re.compile(r"(?<![A-Za-z])(?:nan|-?inf(?:inity)?)(?![A-Za-z])", re.IGNORECASE)
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
OPTI SORT 'plate.msh' ; SORT 'MESH' S1 ; OPTI SORT 'plate.med' ; SORT 'MESH' S1 ;
OPTI SORT 'sets.inp' ; SORT 'MESH' S1 ; OPTI SORT 'plate.bdf' ; SORT 'NAS ' S1 ;
OPTI SORT 'plate.vtu' ; SORT 'VTK ' S1 ;
OPTI SORT 'plate.mesh' ;
SORT 'CHAI' 'MeshVersionFormatted 2' ; SORT 'CHAI' 'Dimension 2' ; SORT 'CHAI' 'Vertices' ;
SORT 'CHAI' '4' ; SORT 'CHAI' '0. 0. 1' ; SORT 'CHAI' '1. 0. 1' ; SORT 'CHAI' '1. 1. 1' ;
SORT 'CHAI' '0. 1. 1' ; SORT 'CHAI' 'Quadrilaterals' ; SORT 'CHAI' '1' ; SORT 'CHAI' '1 2 3 4 7' ;
SORT 'CHAI' 'End' ;
OPTI SORT 'plate.vtk' ; SORT 'CHAI' '# vtk DataFile Version 4.2' ; SORT 'CHAI' 'plate' ;
SORT 'CHAI' 'ASCII' ; SORT 'CHAI' 'DATASET UNSTRUCTURED_GRID' ; SORT 'CHAI' 'POINTS 4 double' ;
SORT 'CHAI' '0. 0. 0. 1. 0. 0. 1. 1. 0. 0. 1. 0.' ; SORT 'CHAI' 'CELLS 1 5' ;
SORT 'CHAI' '4 0 1 2 3' ; SORT 'CHAI' 'CELL_TYPES 1' ; SORT 'CHAI' '9' ;
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
    **dict.fromkeys(
        ("plate.msh", "plate.med", "sets.inp", "plate.bdf", "plate.vtu", "plate.mesh", "plate.vtk"),
        "OPTI DIME 2 ; T = LIRE '{f}' ; LIST T ; LIST (MESU (T . '@QUA4')) ; S = T . 'MAILLAGE' ;"
        " LIST (MESU (CONT (T . '@QUA4'))) ; LIST (NBNO (T . 'NOEUDS')) ; ELIM S 0.01 ; LIST S ;",
    ),
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


class _Clock:
    """Ends a run that takes too long: its own loop soon, anything else at the limit."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self.in_own_loop = False

    def start(self) -> None:
        """Begin to count the processor time of this process."""
        self.in_own_loop = False
        self.left = max(self.seconds - _LOOP_SECONDS, 0.0)
        signal.signal(signal.SIGPROF, self._ring)
        signal.setitimer(signal.ITIMER_PROF, min(self.seconds, _LOOP_SECONDS))

    def _ring(self, number: int, frame: FrameType | None) -> None:
        self.in_own_loop = _turns_of_script(frame) > 2
        if self.left and not self.in_own_loop:
            signal.setitimer(signal.ITIMER_PROF, self.left)
            self.left = 0.0
            return
        interrupt(number, frame)


def _turns_of_script(frame: FrameType | None) -> int:
    """Turns that a REPE of the script itself, not of the library, has begun; 0 outside of one."""
    while frame is not None:
        if frame.f_code.co_name == "_turns":
            node = frame.f_locals.get("node")
            if isinstance(node, tree.Loop) and node.span.source.name == _NAME:
                return int(frame.f_locals.get("turn", 0))
        frame = frame.f_back
    return 0


_NAME = "mutant.ssi"
_SILENT = "not finite, in silence"


def outcome(text: str, folder: Path, seconds: float = SECONDS) -> tuple[str, str]:
    """Run a script in a folder: how it ended, and the defect that it shows or ''."""
    return _ran(text, folder, _Clock(seconds), summary=True)


def _ran(text: str, folder: Path, clock: _Clock, *, summary: bool) -> tuple[str, str]:
    options = RunOptions(
        folder / "out",
        limits=Limits(50, _STATEMENTS),
        given={n: float(n[1:]) for n in ("XNAN", "XINF") if n in text.upper()},
        summary=summary,
    )
    out, err = io.StringIO(), io.StringIO()
    clock.start()
    try:
        result = run_source(Source(_NAME, text, folder / _NAME), options, out, err)
    except KeyboardInterrupt:
        return "defect", "slow, outside of the run"
    except BaseException as problem:
        name = type(problem).__name__
        return "defect", f"crash {name} at {_place(problem)}: {_plain(str(problem))}"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    how, defect = _judged(result, err.getvalue(), clock)
    given = _GIVEN.search(text)  # who gives NaN gets NaN
    if how == "ran" and not given and (senseless := _senseless(result, out.getvalue())):
        return "defect", f"{_SILENT}: {senseless}"
    return how, defect


def _senseless(result: RunResult, printed: str) -> str:
    """A figure, or a line that the script prints, of a number that is none; '' after a warning."""
    if result.session.warnings:
        return ""
    names = [c.name for c in result.session.checks if not math.isfinite(c.value)]
    lines = [
        line
        for line in printed.splitlines()
        if _NOT_FINITE.search(line) and not _GIVEN.search(line.partition(" FLOTTANT ")[0])
    ]
    return _plain((names + lines + [""])[0])


def _judged(result: RunResult, messages: str, clock: _Clock) -> tuple[str, str]:
    for error in result.errors:
        if error.code == "interrupted":
            if clock.in_own_loop:
                return "stopped in its own loop", ""
            word = error.span.text[:60] if error.span else ""
            return "defect", f"slow: {word}"
        if error.code == "internal":
            kind, reason = error.data["kind"], _plain(str(error.data["reason"]))
            return "defect", f"internal {kind} at {_place(error)}: {reason}"
    if "Traceback" in messages:
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


Told = Callable[[object], None]
Batch = Callable[[random.Random, Path, Told], None]
Learn = Callable[[dict[str, float], int], None]


def campaign(
    batch: Batch, each: int, count: int, seed: int, learn: Learn = lambda told, ran: None
) -> Found:
    """Run `count` mutants in batches of `each`, in child processes, each batch of its own seed."""
    found = Found()
    began = _processor()
    batches = -(-count // each)
    in_a_child = -(-_A_CHILD // each)
    for start in range(0, batches, in_a_child):
        at, stop = start, min(start + in_a_child, batches)
        while at < stop:  # a child that crashes is followed by one that goes on behind
            at = _child(batch, range(at, stop), seed, found, learn)
        done, spent = found.outcomes.total(), _processor() - began
        print(f"{done} in {spent:.0f} s of processor, {dict(found.outcomes)}", flush=True)
    return found


def _processor() -> float:
    """Seconds of processor of this process and of those it has waited for."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def _child(batch: Batch, numbers: range, seed: int, found: Found, learn: Learn) -> int:
    """Run batches in a child process; the number behind the last one that was run."""
    reads, writes = os.pipe()
    pid = os.fork()
    if pid == 0:
        os.close(reads)
        with os.fdopen(writes, "w", encoding="utf-8") as told:
            _run_numbers(batch, numbers, seed, told)
        os._exit(0)
    os.close(writes)
    at = numbers.start
    text, ran = "", 0
    with os.fdopen(reads, encoding="utf-8") as told:
        for line in told:
            message = json.loads(line)
            match message:
                case int():
                    at, text, ran = message, "", 0
                case str():
                    text = message
                case dict():
                    learn(message, ran)
                case _:
                    found.add(*message, text)
                    text, ran = "", ran + (message[0] == "ran")
    _, status = os.waitpid(pid, 0)
    if status or text:
        found.add("defect", f"the interpreter ended with status {status}", text)
        return at + 1
    return numbers.stop


def _run_numbers(batch: Batch, numbers: range, seed: int, told: io.TextIOBase) -> None:
    """Run batches, saying the number of each, each mutant and its outcome."""
    gc.collect()
    gc.freeze()
    resource.setrlimit(resource.RLIMIT_DATA, (_MEMORY, _MEMORY))
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)

    def tell(message: object) -> None:
        told.write(json.dumps(message) + "\n")
        told.flush()

    for number in numbers:
        tell(number)
        with tempfile.TemporaryDirectory(prefix="fuzz_decks_") as folder:
            batch(random.Random(f"{seed} {number}"), Path(folder), tell)


# ---- mutants that share their beginning ----------------------------------------------------------


_OPENED, _READ = running.make_session, running.parse


class _Split(tuple[tree.Node, ...]):
    """Nodes of a deck that are run in order, other processes being split off on the way.

    Attributes
    ----------
    mutants : dict of int to list of str
        Texts of mutants by the number of the node that is the first to differ.
    session : Session
        Of the run.
    tell : function
        Is told of each mutant and its outcome.
    child : bool
        Whether this process runs a mutant by now, whose text is `text`.
    """

    mutants: dict[int, list[str]]
    session: Session
    folder: Path
    clock: _Clock
    tell: Told
    text = ""
    named = False
    child = False

    def __iter__(self) -> Iterator[tree.Node]:
        if not self.named:  # the names that are assigned are gathered first
            self.named = True
            return super().__iter__()
        return self._run()

    def _run(self) -> Iterator[tree.Node]:
        for at, node in enumerate(super().__iter__()):
            for text in self.mutants.pop(at, ()):
                if self._become(text):
                    yield from self._others(text)[at:]
                    return
            if not self.mutants:
                return
            yield node

    def _become(self, text: str) -> bool:
        """Run a mutant from here in a process of its own; True in that process."""
        out = self.folder / "out"
        if out.exists():  # files that the beginning has written are those of one run
            with tempfile.TemporaryDirectory(prefix="fuzz_decks_") as folder:
                self.tell(text)
                self.tell(_in_a_process(text, Path(folder), self.clock))
            return False
        self.tell(text)
        pid = os.fork()
        if pid == 0:
            self.child, self.text = True, text
            self.clock.start()
            return True
        _, status = os.waitpid(pid, 0)
        if status:
            self.tell(("defect", f"the interpreter ended with status {status}"))
        shutil.rmtree(out, ignore_errors=True)
        return False

    def _others(self, text: str) -> tuple[tree.Node, ...]:
        script = parse(Source(_NAME, text, self.folder / _NAME))
        self.session.assignments = tree.first_assignments(script.body)
        return script.body


def _in_a_process(text: str, folder: Path, clock: _Clock) -> tuple[str, str]:
    """Run a mutant whole in a process of its own."""
    reads, writes = os.pipe()
    pid = os.fork()
    if pid == 0:
        running.make_session, running.parse = _OPENED, _READ
        os.write(writes, json.dumps(_ran(text, folder, clock, summary=True)).encode())
        os._exit(0)
    os.close(writes)
    with os.fdopen(reads, "rb") as answer:
        told = answer.read()
    _, status = os.waitpid(pid, 0)
    if status or not told:
        return "defect", f"the interpreter ended with status {status}"
    how, defect = json.loads(told)
    return how, defect


def run_each(mutants: Iterable[str], folder: Path, tell: Told) -> None:
    """Run mutants whole, one after the other."""
    for mutant in mutants:
        tell(mutant)
        tell(outcome(mutant, folder))
        shutil.rmtree(folder / "out", ignore_errors=True)


def run_together(text: str, mutants: list[str], folder: Path, tell: Told) -> list[str]:
    """Run mutants of a deck, each from where it begins to differ.

    Returns
    -------
    list of str
        Those that differ only where the deck does not come.
    """
    source = Source(_NAME, text, folder / _NAME)
    try:
        whole = parse(source)
    except (SsiError, SeveralErrors):
        return mutants
    ends = [source.code.find(";", node.span.end - 1) for node in whole.body]
    nodes = _Split(whole.body)
    nodes.mutants = {}
    for mutant in mutants:
        pairs = enumerate(zip(text, mutant, strict=False))
        same = next((i for i, (old, new) in pairs if old != new), min(len(text), len(mutant)))
        at = sum(0 <= end < same for end in ends)
        nodes.mutants.setdefault(min(at, len(ends) - 1), []).append(mutant)
    clock = _Clock(SECONDS)
    nodes.folder, nodes.clock, nodes.tell = folder, clock, tell

    def make_session(*given: object) -> Session:
        nodes.session = _OPENED(*given)  # type: ignore[arg-type]
        return nodes.session

    running.make_session = make_session
    running.parse = lambda source: tree.Script(nodes, whole.span)
    try:
        ended = _ran(text, folder, clock, summary=False)
    finally:
        running.make_session, running.parse = _OPENED, _READ
    if nodes.child:
        silent = ended[1].startswith(_SILENT) and _GIVEN.search(nodes.text)
        tell(("ran", "") if silent else ended)
        os._exit(0)
    shutil.rmtree(folder / "out", ignore_errors=True)
    return [mutant for left in nodes.mutants.values() for mutant in left]


class Decks:
    """Draws decks, the more often the quicker they are, and learns on the way how quick.

    Attributes
    ----------
    texts : list of str
    seconds : dict of int to float
        Processor time of a mutant by the number of its deck, of those that were drawn.
    ran : dict of int to float
        The part of its mutants that ran to their end.
    """

    def __init__(self, texts: list[str]) -> None:
        self.texts = texts
        self.seconds: dict[int, float] = {}
        self.ran: dict[int, float] = {}

    def draw(self, rng: random.Random) -> int:
        """The number of a deck."""
        numbers = range(len(self.texts))
        weights = [
            (0.1 + self.ran.get(i, 0.2)) / (0.02 + self.seconds.get(i, _SUPPOSED_SECONDS))
            for i in numbers
        ]
        return rng.choices(numbers, weights)[0]

    def batch(self, rng: random.Random, folder: Path, tell: Told) -> None:
        """Run mutants of one deck."""
        number = self.draw(rng)
        text = self.texts[number]
        text = _PICTURE.sub("", text) if rng.random() < 0.9 else text
        mutants = [mutated(text, rng) for _ in range(_OF_A_DECK)]
        began = _processor()
        left = mutants
        if self.seconds.get(number, 1.0) > _SPLIT_SECONDS:
            left = run_together(text, mutants, folder, tell)
        run_each(left, folder, tell)
        self.seconds[number] = (_processor() - began) / _OF_A_DECK
        tell({number: self.seconds[number]})

    def learn(self, told: dict[str, float], ran: int) -> None:
        """Take over what a child process has learnt, and how many mutants of the batch ran."""
        for number, spent in told.items():
            self.seconds[int(number)] = spent
            self.ran[int(number)] = ran / _OF_A_DECK


def of_files(files: dict[str, bytes]) -> Batch:
    """Batches of damaged files with scripts that read them."""

    def batch(rng: random.Random, folder: Path, tell: Told) -> None:
        run_each([damaged_input(files, rng, folder)], folder, tell)

    return batch


def main() -> int:
    """Run a campaign."""
    what = sys.argv[1] if len(sys.argv) > 1 else "decks"
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    load_operators()
    if what == "decks":
        drawn = Decks(decks())
        found = campaign(drawn.batch, _OF_A_DECK, count, seed, drawn.learn)
        print(f"{len(drawn.seconds)} decks of {len(drawn.texts)}", flush=True)
    else:
        with tempfile.TemporaryDirectory() as folder:
            files = made_files(Path(folder))
        found = campaign(of_files(files), 1, count, seed)
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
