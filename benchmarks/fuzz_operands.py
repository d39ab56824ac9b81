"""Gives every operator random operands of every type: only messages, never a traceback or a hang.

    python benchmarks/fuzz_operands.py [COUNT] [SEED]

One statement in a session that holds objects of all types; most are senseless, all must end with
a result or a message within the time limit and the memory limit. Prints the outcomes and each
defect once, with a statement that shows it; exits 1 if there is any.
"""

import faulthandler
import io
import random
import re
import resource
import signal
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from ssilang.cli.interrupts import interrupt
from ssilang.cli.run import RunOptions, execute, make_session
from ssilang.language.registry import OPERATORS, Operator, keywords_of
from ssilang.language.run.jumps import StopRun
from ssilang.language.run.session import Limits, Session
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.operators.loader import load_operators

_FLAT = """
OPTI 'DIME' 2 'ELEM' 'QUA4' 'MODE' 'PLAN' 'DEFO' ; DENS 0.5 ;
A = 0. 0. ; B = 1. 0. ; C0 = 1. 1. ; E = 0. 1. ; V = 0. 2. ;
L1 = DROI 2 A B ; L2 = DROI 2 B C0 ; L3 = DROI 2 C0 E ; L4 = DROI 2 E A ;
S1 = DALL L1 L2 L3 L4 'PLAN' ; S2 = S1 PLUS (2. 0.) ; W1 = L1 ET L2 ;
"""
_SOLID = """
OPTI 'DIME' 3 'ELEM' 'CUB8' 'MODE' 'TRID' ; DENS 0.5 ;
A = 0. 0. 0. ; B = 1. 0. 0. ; C0 = 1. 1. 0. ; E = 0. 1. 0. ; V = 0. 0. 2. ;
L1 = DROI 2 A B ; L2 = DROI 2 B C0 ; L3 = DROI 2 C0 E ; L4 = DROI 2 E A ;
W1 = DALL L1 L2 L3 L4 'PLAN' ; S1 = W1 VOLU 1 'TRAN' V ; S2 = S1 PLUS (2. 0. 0.) ;
"""
_OBJECTS = """
MO = MODE S1 'MECANIQUE' 'ELASTIQUE' 'ISOTROPE' ;
MA = MATE MO 'YOUN' 2.E7 'NU' 0.3 'RHO' 2000. ; MB = MODE L1 'MECANIQUE' 'BARR' ;
MC = MATE MB 'YOUN' 2.E7 'NU' 0.3 'RHO' 2000. 'SECT' 0.1 ;
R1 = RIGI MO MA ; M1 = MASS MO MA ; BL = BLOQ 'DEPL' L4 ; RB = R1 ET BL ;
F1 = FORC 'FX' 3. L2 ; U1 = RESO RB F1 ; SG = SIGM MO MA U1 ; EP = EPSI MO U1 ;
T1 = PROG 0. 'PAS' 0.1 1. ; P1 = PROG 3. -1. 2. ; N1 = LECT 1 2 3 ; K1 = MOTS 'UX' 'UY' ;
EV = EVOL 'MANU' 'T' T1 'A' (T1 * T1) ; CH = CHAR 'MECA' F1 EV ; LC = SUIT U1 F1 ;
TB = TABL ; TB . 1 = 2. ; TB . 'MAILLAGE' = S1 ; TB . 'TEMPS' = T1 ; TV = TABL 'VECTEUR' ;
TV . 1 = 1. ; TX = TEXT '2 + 3' ; CO = MANU 'CHPO' S1 1 'SCAL' 2. ; MZ = VIDE 'MAILLAGE' ;
DEBP PR1 X*'FLOTTANT' ; FINP (X * 2.) ;
NU1 = NUAG 'COMP' 'X' P1 'COMP' 'Y' P1 ; P0 = PROG ; NO = LECT ;
"""
_NAMES = [
    "A",
    "B",
    "C0",
    "E",
    "V",
    "L1",
    "L2",
    "L3",
    "S1",
    "S2",
    "W1",
    "MO",
    "MA",
    "MB",
    "MC",
    "R1",
    "M1",
    "BL",
    "RB",
    "F1",
    "U1",
    "SG",
    "EP",
    "T1",
    "P1",
    "N1",
    "K1",
    "EV",
    "CH",
    "LC",
    "TB",
    "TV",
    "TX",
    "CO",
    "MZ",
    "PR1",
    "NU1",
    "P0",
    "NO",
    "VRAI",
    "FAUX",
]
_VALUES = [
    "0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "0.",
    "1.",
    "-1.",
    "0.5",
    "1.E-12",
    "1.E30",
    "100000",
    "'UX'",
    "'UY'",
    "'FX'",
    "'SCAL'",
    "''",
    "'ABC'",
]
_PER_SESSION = 100
_SECONDS = 20
_FROZEN = 120  # seconds after which a statement that no signal stops ends the campaign
_MEMORY = 6 * 2**30
_LEFT_OUT = frozenset({"FIN", "INFO"})


def fresh(folder: Path, rng: random.Random) -> Session:
    """A session that holds objects of all types, flat or solid."""
    source = Source("fuzz", "", folder / "fuzz.ssi")
    session = make_session(source, RunOptions(folder, limits=Limits(30, 3000)), io.StringIO())
    execute(session, Source("prelude", rng.choice((_FLAT, _SOLID)) + _OBJECTS))
    return session


# what stands for an operand's name in the syntax lines, by the name's beginning
_KINDS = {
    "MOT": "'UX' 'UY' 'FX' 'SCAL' 'ABC' 'DEPL'", "NOM": "'UX' 'ABC' 'T'", "COUL": "ROUG VERT",
    "N": "0 1 2 3 -1", "GEO": "L1 L2 S1 S2 W1 MZ", "MAIL": "S1 L1 W1", "SURF": "S1 W1 S2",
    "LIG": "L1 L2", "COTE": "L1 L2 L3 L4", "POIN": "A B C0 E", "P": "A B C0 E", "VEC": "V A",
    "CHPO": "U1 F1 CO", "CHP": "U1 F1 CO", "MODL": "MO MB", "MODE": "MO MB", "EVOL": "EV",
    "FLOT": "0.5 2. -1. 1.E-12 1.E30 0.", "X": "0.5 0. 2.", "VAL": "1. 0.", "D": "0.5 1.",
    "F": "1. F1", "CHAM": "SG EP MA", "MCHA": "SG EP MA MC", "SIG": "SG", "CAR": "MA MC",
    "MAT": "MA R1", "RIG": "R1 RB BL M1", "MASS": "M1", "RELA": "BL", "TAB": "TB TV",
    "LREE": "T1 P1 P0", "LISTREEL": "T1 P1 P0", "LENT": "N1 NO", "LMOT": "K1", "LISTMOTS": "K1",
    "LCH": "LC", "CHAR": "CH", "NUAG": "NU1", "LOG": "VRAI FAUX", "DENS": "0.2", "OBJ": "S1 U1 P1",
    "I": "1 2", "DEPL": "U1", "CENTR": "A C0", "AXE": "A B", "T": "T1",
}  # fmt: skip
_PART = re.compile(r"'[^']*'|[A-Z]\w*|\d+\.?\d*|[()|]")


def by_syntax(found: Operator, rng: random.Random) -> str:
    """A call after one of the operator's syntax lines, with one or two parts made wrong."""
    line = rng.choice(found.help.syntax.split("\n")).rpartition("=")[2]
    words = []
    for part in _PART.findall(line):
        kind = next((k for k in (part[:n] for n in range(len(part), 0, -1)) if k in _KINDS), "")
        if part in "()|":
            continue
        if not words and not part.startswith("'"):
            words.append(part)  # the operator itself
        elif part.startswith("'") or not kind:
            words += [part] if rng.random() < 0.8 else []
        elif rng.random() < 0.9:
            words.append(rng.choice(_KINDS[kind].split()))
    for _ in range(rng.choice((0, 0, 1, 1, 2))):
        spare = rng.choice((rng.choice(_NAMES), rng.choice(_VALUES)))
        at = rng.randrange(len(words) + 1)
        words[at : at + rng.randint(0, 1)] = [spare]
    return f"X = {' '.join(words)} ;"


def statement(found: Operator, rng: random.Random) -> str:
    """A call of an operator with random keywords and operands, most near to its syntax."""
    if found.help.syntax and rng.random() < 0.7:
        return by_syntax(found, rng)
    words = keywords_of(found)
    parts: list[str] = []
    for _ in range(rng.choice((0, 1, 1, 2, 2, 3, 3, 4, 5, 7))):
        kind = rng.random()
        if words and kind < 0.4:
            parts.append(f"'{rng.choice(words)}'")
        elif kind < 0.75:
            parts.append(rng.choice(_NAMES))
        elif kind < 0.95:
            parts.append(rng.choice(_VALUES))
        else:
            parts.append(f"({rng.choice(_NAMES)} {rng.choice('+-*/')} {rng.choice(_VALUES)})")
    name = found.full_name if found.full_name[0].isalpha() else f"'{found.full_name}'"
    if rng.random() < 0.2 and parts:  # an operand before the operator
        name = f"{parts.pop()} {name}"
    left = rng.choice(("X = ", "X = ", "X Y = ", "TB . 3 = ", ""))
    return f"{left}{name} {' '.join(parts)} ;"


def outcome(session: Session, text: str) -> tuple[str, str]:
    """Run a statement: how it ended, and the defect if it shows one."""
    signal.alarm(_SECONDS)
    try:
        session.evaluator.run_top(parse(Source("mutant", text)).body)
    except SsiError as error:
        if error.code == "internal":
            return "defect", " ".join(str(error.data[k]) for k in ("operator", "kind", "reason"))
        return "message", ""
    except (StopRun, SeveralErrors):
        return "message", ""
    except KeyboardInterrupt:
        return "slow", f"slow: {text.split()[2:4]}"
    except Exception as problem:
        return "defect", f"crash {type(problem).__name__}: {problem}"
    finally:
        signal.alarm(0)
        session.frame = session.root
    return "result", ""


def main() -> int:
    """Run the campaign."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 5000
    rng = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    resource.setrlimit(resource.RLIMIT_DATA, (_MEMORY, _MEMORY))
    signal.signal(signal.SIGALRM, interrupt)
    load_operators()
    operators = [o for o in OPERATORS.values() if o.name.strip() not in _LEFT_OUT]
    outcomes: Counter[str] = Counter()
    defects: dict[str, str] = {}
    slowest = (0.0, "")
    with tempfile.TemporaryDirectory() as folder:
        for i in range(count):
            if i % _PER_SESSION == 0:
                session = fresh(Path(folder), rng)
            text = statement(rng.choice(operators), rng)
            faulthandler.dump_traceback_later(_FROZEN, exit=True)
            began = time.perf_counter()
            kind, defect = outcome(session, text)
            slowest = max(slowest, (time.perf_counter() - began, text))
            outcomes[kind] += 1
            if defect and defect[:90] not in defects:
                print(f"found: {defect[:200]}\n    {text}", flush=True)
                defects[defect[:90]] = text
    faulthandler.cancel_dump_traceback_later()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(dict(outcomes), f"slowest {slowest[0]:.1f} s: {slowest[1]}", f"peak {peak:.0f} MB")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
