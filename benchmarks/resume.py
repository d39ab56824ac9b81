"""Are runs that were killed and gone on with equal to the undisturbed ones?

`python benchmarks/resume.py [COUNT] [SEED]`: decks with REPRISE run in processes of their own that
SIGKILL (one in five: SIGTERM) ends at a random moment, a third of them twice; `--resume` takes each
to its end. Compared are the series, the histories and all numbers of the saved tables, to the last
bit. Printed are how many are equal, and how long the undisturbed runs take.
"""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

ROCKING = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; T = TABL ;
PC = 0. 0. ; PG = 0. 3. ; PL = -1. 0. ; PR = 1. 0. ; PSL = -1. -1. ; PSR = 1. -1. ;
JOI = (MANU 'SEG2' PSL PL) ET (MANU 'SEG2' PSR PR) ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
BLO = (BLOQ 'UX' 'UY' (PSL ET PSR)) ET (BLOQ 'UX' (PL ET PR ET PC)) ;
BLO = BLO ET (RELA 'UY' PL - 'UY' PC + 1. 'RZ' PC) ET (RELA 'UY' PR - 'UY' PC - 1. 'RZ' PC) ;
BLO = BLO ET (RELA 'UY' PG - 'UY' PC) ET (RELA 'UX' PG + 3. 'RZ' PC) ;
T . 'MASS' = (MASS 'DEPL' 1.E5 PG) ET (MASS 'ROTA' 1.E5 PC) ;
T . 'RIGI' = BLO ; T . 'MODELE' = MOJ ; T . 'CARACTERISTIQUES' = MATE MOJ 'KN' 1.E8 'KS' 0. ;
T . 'CHAR' = (CHAR 'MECA' (FORC (0. -1.E6) PG)) ET
  (CHAR 'MECA' (FORC (2.E5 0.) PG) (EVOL 'MANU' (PROG 0. .3 .6 99.) (PROG 0. 1. -1. 0.5))) ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 0.0005 8. ; T . 'PAS_SAUVES' = 800 ;
T . 'PAS_SAUVES_VTK' = 500 ; T . 'MAILLAGE_VTK' = JOI ;
T . 'PAS_SAUVES_CSV' = 20 ; T . 'MAILLAGE_CSV' = PG ET PC ;
T . 'REPRISE' = TABL ; T . 'REPRISE' . 'PAS' = 2000 ;
T2 = DYNAMIC T ; OPTI SAUV 'end.sauv' ; SAUV T2 ;
"""
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


def steps_begin(process: subprocess.Popen[bytes], out: Path) -> float:
    """Wait for the first checkpoint, or the end; the time since the call (s)."""
    begun = time.perf_counter()
    while process.poll() is None and not (out / "checkpoints" / "1.state").is_file():
        time.sleep(0.005)
    return time.perf_counter() - begun


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
        truths, lasts = {}, {}
        for name, text in DECKS.items():
            deck = folder / f"{name}.ssi"
            deck.write_text(text)
            to_end(deck, folder / "first")  # compiles
            begun, process = time.perf_counter(), start(deck, folder / name)
            before = steps_begin(process, folder / name)
            process.communicate()
            whole, truths[name] = time.perf_counter() - begun, content(folder / name)
            lasts[name] = before, whole - before
            print(
                f"{name}: {whole:.1f} s, the first checkpoint after {before:.1f} s, "
                f"{len(truths[name])} files and arrays",
                flush=True,
            )
        for i in range(count):
            name = list(DECKS)[i % len(DECKS)]
            deck, out, kills = folder / f"{name}.ssi", folder / f"run{i}", 1 + (i % 3 == 2)
            for k in range(kills):
                process = start(deck, out, *["--resume"][:k])
                before, after = lasts[name]
                if i % 6 == 0:  # at any moment, else between the first checkpoint and the end
                    time.sleep(draw.uniform(0.0, 1.0) * (before + after))
                else:
                    steps_begin(process, out)
                    time.sleep(draw.uniform(0.0, 1.0) * after)
                process.send_signal(signal.SIGTERM if i % 5 == 4 else signal.SIGKILL)
                process.communicate()
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
