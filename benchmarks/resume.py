"""Are runs that were killed and gone on with equal to the undisturbed ones?

`python benchmarks/resume.py [COUNT] [SEED]`: decks with REPRISE run in processes of their own that
SIGKILL (one in five: SIGTERM) ends, one in six at any moment from its start on, the others at a
random moment of their march, some of these twice; `--resume` takes each to its end. Compared are
the series, the histories and all numbers of the saved tables, to the last bit. Printed are how many
are equal, and how long the undisturbed runs take.
"""

import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve()
sys.path.insert(0, str(HERE.parents[1]))
from tests.references import rocking_deck  # noqa: E402

ROCKING = (
    rocking_deck.ROCKING
    + """
T . 'TEMPS_CALCULES' = PROG 0. PAS 0.00005 8. ; T . 'PAS_SAUVES' = 8000 ;
T . 'PAS_SAUVES_VTK' = 5000 ; T . 'PAS_SAUVES_CSV' = 200 ;
T . 'REPRISE' = TABL ; T . 'REPRISE' . 'PAS' = 10000 ;
T2 = DYNAMIC T ; OPTI SAUV 'end.sauv' ; SAUV T2 ;
"""
)
SOIL = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; T = TABL ;
L1 = DROI 24 (-6. -6.) (6. -6.) ; S1 = L1 TRAN 12 (0. 6.) ; HAUT = COTE 3 S1 ;
L3 = DROI 8 (-2. 0.) (2. 0.) ; S2 = L3 TRAN 6 (0. 3.) ; P1 = S2 POIN PROC (2. 3.) ;
LB = HAUT ELEM COMP (HAUT POIN PROC (-2. 0.)) (HAUT POIN PROC (2. 0.)) ;
J1 = RACC 1.E-3 LB L3 ;
MS = MODE (S1 ET S2) 'MECANIQUE' 'ELASTIQUE' ; MJ = MODE J1 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
AS = MATE MS 'YOUN' 5.E7 'NU' 0.3 'RHO' 1900. ; AJ = MATE MJ 'KN' 1.E9 'KS' 1.E8 ;
MAS = MASS MS AS ; RIG = (RIGI MS AS) ET (BLOQ 'UX' 'UY' L1) ;
T . 'RIGI' = RIG ; T . 'MASS' = MAS ; T . 'AMOR' = (0.5 * MAS) ET (1.E-3 * (RIGI MS AS)) ;
T . 'MODELE' = MJ ET MS ; T . 'CARACTERISTIQUES' = AJ ET AS ;
POID = MAS * (MANU 'CHPO' (S1 ET S2) 1 'UY' -9.81) ;
PUSH = MAS * (MANU 'CHPO' (S1 ET S2) 1 'UX' 5.) ;
LT = PROG 0. PAS 0.005 2. ; LS = SIN (LT * 720.) ;
T . 'CHAR' = (CHAR 'MECA' POID) ET (CHAR 'MECA' PUSH (EVOL 'MANU' LT LS)) ;
T . 'TEMPS_CALCULES' = LT ; T . 'PAS_SAUVES' = 20 ; T . 'MAILLAGE_SAUVE' = P1 ;
T . 'PAS_SAUVES_VTK' = 40 ;
T . 'REPRISE' = TABL ; T . 'REPRISE' . 'PAS' = 50 ;
T2 = DYNAMIC T ; OPTI SAUV 'end.sauv' ; SAUV T2 ;
"""
PLATE = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; T = TABL ;
L1 = DROI 4 (0. 0.) (1. 0.) ; S1 = L1 TRAN 4 (0. 1.) ; L2 = COTE 3 S1 ;
M = MODE S1 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' ;
T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = MATE M 'YOUN' 2.E11 'NU' 0.3 'SIGY' 2.E8 ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' L1 ;
E = EVOL 'MANU' (PROG 0. 1. 2. 3.) (PROG 0. 0.5 -0.5 0.6) ;
T . 'CHARGEMENT' = CHAR 'MECA' (FORC (1.2E8 -1.E8) L2) E ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 0.04 3. ;
T . 'REPRISE' = TABL ; T . 'REPRISE' . 'PAS' = 5 ;
PASAPAS T ; OPTI SAUV 'end.sauv' ;
A = T . 'DEPLACEMENTS' ; B = T . 'CONTRAINTES' ; C = T . 'VARIABLES_INTERNES' ; SAUV A B C ;
"""
DECKS = {"rocking": ROCKING, "soil": SOIL, "plate": PLATE}
TRIES = 5  # a run that ended before its moment is run again


def start(deck: Path, out: Path, *words: str) -> subprocess.Popen[bytes]:
    """Run `ssilang DECK` in a process of its own."""
    command = [sys.executable, "-m", "ssilang.cli.main", str(deck), "--out", str(out), *words]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def to_end(deck: Path, out: Path, *words: str) -> str:
    """Run it to its end; what it says."""
    process = start(deck, out, *words)
    _, said = process.communicate()
    if process.returncode != 0:
        raise SystemExit(f"{deck.name} {words}: {said.decode()}")
    return said.decode()


def _written(state: Path) -> tuple[int, int] | None:
    """What tells one checkpoint from the next."""
    try:
        found = state.stat()
    except FileNotFoundError:
        return None
    return found.st_ino, found.st_mtime_ns


def states_seen(process: subprocess.Popen[bytes], state: Path, wanted: int) -> list[float]:
    """Wait until so many checkpoints were written, or the end; when each was seen (s)."""
    last, seen = _written(state), list[float]()
    while process.poll() is None and len(seen) < wanted:
        if (now := _written(state)) not in (None, last):
            last = now
            seen.append(time.perf_counter())
        time.sleep(0.001)
    return seen


def killed(deck: Path, out: Path, how: signal.Signals, moment: float, *words: str) -> bool:
    """End a run behind so many checkpoints, and a part of the time to the next one."""
    process, wanted = start(deck, out, *words), int(moment)
    seen = states_seen(process, out / "checkpoints" / "1.state", wanted)
    if len(seen) == wanted:
        time.sleep((moment - wanted) * (seen[-1] - seen[0]) / max(wanted - 1, 1))
    in_time = process.poll() is None
    process.send_signal(how)
    process.communicate()
    return in_time


def killed_once(deck: Path, out: Path, how: signal.Signals, whole: float) -> None:
    """End a run at any moment of the time that it takes."""
    process = start(deck, out)
    time.sleep(whole)
    process.send_signal(how)
    process.communicate()


def content(out: Path) -> dict[str, bytes]:
    """All that a run leaves but its summary; archives member by member."""
    found = {}
    for path in sorted(p for p in out.rglob("*") if p.is_file() and p.name != "summary.json"):
        name = path.relative_to(out).as_posix()
        if path.suffix != ".sauv":
            found[name] = path.read_bytes()
            continue
        with zipfile.ZipFile(path) as archive:
            found |= {f"{name}/{m}": archive.read(m) for m in archive.namelist()}
    return found


def main() -> None:
    """Kill and go on, again and again."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    draw = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    with tempfile.TemporaryDirectory() as made:
        folder, equal, resumed = Path(made), 0, 0
        truths, takes, states = {}, {}, {}
        for name, text in DECKS.items():
            deck, out = folder / f"{name}.ssi", folder / name
            deck.write_text(text)
            to_end(deck, folder / "first")  # compiles
            begun, process = time.perf_counter(), start(deck, out)
            seen = states_seen(process, out / "checkpoints" / "1.state", sys.maxsize)
            process.communicate()
            takes[name], truths[name] = time.perf_counter() - begun, content(out)
            states[name] = len(seen)
            print(
                f"{name}: {takes[name]:.1f} s, {len(seen)} checkpoints seen, the first after "
                f"{seen[0] - begun:.1f} s, {len(truths[name])} files and arrays",
                flush=True,
            )
        for i in range(count):
            name = list(DECKS)[i % len(DECKS)]
            deck, out = folder / f"{name}.ssi", folder / f"run{i}"
            how = signal.SIGTERM if i % 5 == 4 else signal.SIGKILL
            if i % 6 == 0:
                killed_once(deck, out, how, draw.uniform(0.0, takes[name]))
            else:  # in the time that it marches
                for _ in range(TRIES):
                    if killed(deck, out, how, draw.uniform(1, states[name])):
                        break
                    shutil.rmtree(out)
                if i % 3 == 2:  # what goes on is ended too
                    killed(deck, out, how, draw.uniform(1, 2), "--resume")
            kept = any((out / "checkpoints").glob("*.state"))
            said = to_end(deck, out, "--resume")
            same = content(out) == truths[name]
            equal, resumed = equal + same, resumed + kept
            how = "from a checkpoint" if kept else "from its start"
            print(f"{i + 1:3d} {name}: {'equal' if same else 'NOT EQUAL'}, {how}", flush=True)
            if kept and "goes on behind" not in said and "given back" not in said:
                raise SystemExit(f"the checkpoint was not used: {said}")
        print(f"{equal} of {count} equal, {resumed} of them from a checkpoint")


if __name__ == "__main__":
    main()
