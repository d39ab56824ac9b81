"""From the command to the written curve: a block on soil as a deck, and as an OpenSeesPy script.

    python benchmarks/command_to_curve.py [steps [unknowns [runs]]]      default 2 7500 5

The model is that of `uplift_openseespy.py`: plane-strain quads with lumped masses, springs that
only push between block and soil, the block's weight, a sine at the base, average acceleration with
5 ms. The displacement of the block's upper left corner is kept at every step and written as CSV.
Each run is a process of its own, from its start to its end: all that a user waits for, with
compiled code kept from an earlier run. The two run in turn; medians are printed, and the ratio
only if the curves agree within 1e-6 of the largest value. With many steps the peer runs once.
"""

import csv
import importlib.util
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve()
DT, SIZE, GRAVITY = 5e-3, 0.5, 9.81
SOIL, BLOCK = (5e7, 0.3, 1900.0), (2e9, 0.25, 1200.0)  # Young's modulus, Poisson's ratio, density
NORMAL, SHEAR = 1e8, 5e7  # N/m of a pair of nodes
PULSE, FREQUENCY = 6.0, 2.0  # m/s2, Hz
AGREEMENT = 1e-6
MANY = 100  # steps with which the peer runs once
SOLVER = "SparseSYM"  # the peer's fastest at 7 500 unknowns

DECK = """\
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
* soil of 4 b x 2 b cells under a block of b x b cells
B = {b} ; T = {size} ;
WIDE = 2. * B * T ; HALF = B * T / 2. ;
BASE = DROI (4 * B) ((-1. * WIDE) (-1. * WIDE)) (WIDE (-1. * WIDE)) ;
SOIL = BASE TRAN (2 * B) (0. WIDE) ; GROUND = COTE 3 SOIL ;
SOLE = DROI B ((-1. * HALF) 0.) (HALF 0.) ;
BLOCK = SOLE TRAN B (0. (B * T)) ;
* one joint of two points for each node of the block's lower side
P1 = POIN 1 SOLE ; PAIRS = MANU 'SEG2' (GROUND POIN 'PROC' P1) P1 ;
REPE EACH B ;
  P1 = POIN (&EACH + 1) SOLE ; PAIRS = PAIRS ET (MANU 'SEG2' (GROUND POIN 'PROC' P1) P1) ;
FIN EACH ;
* models, materials, matrices
MS = MODE SOIL 'MECANIQUE' 'ELASTIQUE' ; MB = MODE BLOCK 'MECANIQUE' 'ELASTIQUE' ;
AS = MATE MS 'YOUN' {soil[0]} 'NU' {soil[1]} 'RHO' {soil[2]} ;
AB = MATE MB 'YOUN' {block[0]} 'NU' {block[1]} 'RHO' {block[2]} ;
MJ = MODE PAIRS 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'CISAILLEMENT_ELASTIQUE' 'JOI1' ;
AJ = MATE MJ 'KN' {normal} 'KS' {shear} 'DIRECTION' (0. 1.) ;
RI = (RIGI MS AS) ET (RIGI MB AB) ET (BLOQ 'UX' 'UY' BASE) ;
MASB = LUMP (MASS MB AB) ; MA = (LUMP (MASS MS AS)) ET MASB ;
* the block's weight, the moving base
WEIGHT = MASB * (MANU 'CHPO' BLOCK 2 'UX' 0. 'UY' {minus_gravity}) ;
SHAKE = MA * (MANU 'CHPO' (SOIL ET BLOCK) 2 'UX' -1. 'UY' 0.) ;
TIMES = PROG 0. 'PAS' {dt} 'NPAS' {steps} ;
MOTION = EVOL 'MANU' TIMES ({pulse} * (SIN (360. * {frequency} * TIMES))) ;
T1 = TABL ; T1 . 'RIGI' = RI ; T1 . 'MASS' = MA ;
T1 . 'MODELE' = MJ ; T1 . 'CARACTERISTIQUES' = AJ ;
T1 . 'CHAR' = (CHAR 'MECA' WEIGHT) ET (CHAR 'MECA' SHAKE MOTION) ;
* the upper left corner at every step
CORNER = BLOCK POIN 'PROC' ((-1. * HALF) (B * T)) ;
T1 . 'TEMPS_CALCULES' = TIMES ; T1 . 'PAS_SAUVES' = 'TOUS' ; T1 . 'MAILLAGE_SAUVE' = CORNER ;
T2 = DYNAMIC T1 ;
OPTI SORT 'corner.csv' ; SORT 'EXCE' (EVOL 'TEMP' T2 'DEPL' 'UX' CORNER) ;
"""


def cells_across(unknowns: int) -> int:
    """Cells of the block's side: even, so that soil and block share their nodes."""
    return int(2 * round((unknowns / 18) ** 0.5 / 2))


def deck(unknowns: int, steps: int) -> str:
    """The model as a script."""
    return DECK.format(
        b=cells_across(unknowns), size=SIZE, soil=SOIL, block=BLOCK, normal=NORMAL, shear=SHEAR,
        minus_gravity=-GRAVITY, dt=DT, steps=steps, pulse=PULSE, frequency=FREQUENCY,
    )  # fmt: skip


# ---- the peer: this file run as a program with the word `peer` -----------------------------------


def grid(first: int, x0: float, y0: float, nx: int, ny: int) -> tuple[np.ndarray, np.ndarray]:
    """Node numbers (nx + 1, ny + 1) from `first` on and coordinates (n, 2) of a regular grid."""
    X, Y = np.meshgrid(x0 + SIZE * np.arange(nx + 1), y0 + SIZE * np.arange(ny + 1), indexing="ij")
    ids = first + np.arange(X.size).reshape(X.shape)
    return ids, np.column_stack([X.ravel(), Y.ravel()])


def quads(ids: np.ndarray) -> np.ndarray:
    """Cells (n, 4) of a grid."""
    return np.stack([ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]], -1).reshape(-1, 4)


def peer(unknowns: int, steps: int, path: str) -> None:
    """The model in OpenSees; writes the curve."""
    import openseespy.opensees as ops

    b = cells_across(unknowns)
    soil, below = grid(1, -2 * b * SIZE, -2 * b * SIZE, 4 * b, 2 * b)
    block, above = grid(1 + len(below), -b * SIZE / 2, 0.0, b, b)
    masses = np.zeros(1 + len(below) + len(above))
    for ids, (_, _, density) in ((soil, SOIL), (block, BLOCK)):
        np.add.at(masses, quads(ids), density * SIZE**2 / 4)
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    for number, (x, y) in enumerate(np.concatenate([below, above]).tolist(), 1):
        ops.node(number, x, y)
        ops.mass(number, float(masses[number]), float(masses[number]))
    for number in soil[:, 0].tolist():
        ops.fix(number, 1, 1)
    element = 0
    for tag, (ids, (young, nu, _)) in enumerate(((soil, SOIL), (block, BLOCK)), 1):
        ops.nDMaterial("ElasticIsotropic", tag, young, nu)
        for cell in quads(ids).tolist():
            element += 1
            ops.element("quad", element, *cell, 1.0, "PlaneStrain", tag)
    ops.uniaxialMaterial("ENT", 11, NORMAL)
    ops.uniaxialMaterial("Elastic", 12, SHEAR)
    start = (4 * b - b) // 2
    pairs = np.column_stack([soil[start : start + b + 1, -1], block[:, 0]])
    for low, up in pairs.tolist():
        element += 1
        ops.element("zeroLength", element, low, up, "-mat", 11, 12, "-dir", 2, 1)
    peer_loads(masses, soil, block, steps)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(SOLVER)
    ops.test("NormUnbalance", 1e-3, 30)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    corner, rows = int(block[0, -1]), [(0.0, 0.0)]
    for _ in range(steps):
        if ops.analyze(1, DT):
            raise SystemExit("OpenSees does not converge")
        rows.append((ops.getTime(), ops.nodeDisp(corner, 1)))
    Path(path).write_text("".join(f"{t:.16g};{u:.16g}\n" for t, u in rows))


def peer_loads(masses: np.ndarray, soil: np.ndarray, block: np.ndarray, steps: int) -> None:
    """Weight, inertia of the moving base, initial acceleration in equilibrium with the weight."""
    import openseespy.opensees as ops

    times = DT * np.arange(steps + 2)  # beyond its last value a path gives nothing
    motion = PULSE * np.sin(2 * np.pi * FREQUENCY * times)
    ops.timeSeries("Constant", 1)
    ops.timeSeries("Path", 2, "-dt", DT, "-values", *motion.tolist())
    ops.pattern("Plain", 1, 1)
    for number in block.ravel().tolist():
        ops.load(number, 0.0, -GRAVITY * float(masses[number]))
        ops.setNodeAccel(number, 2, -GRAVITY, "-commit")
    ops.pattern("Plain", 2, 2)
    for number in np.concatenate([soil[:, 1:].ravel(), block.ravel()]).tolist():
        ops.load(number, -float(masses[number]), 0.0)


# ---- the two in turn -----------------------------------------------------------------------------


def timed(command: list[str], folder: str) -> tuple[float, float]:
    """Seconds by the clock and of the processor that a command takes; it must succeed."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    paths = os.pathsep.join([str(HERE.parents[1]), os.environ.get("PYTHONPATH", "")])
    given = os.environ | {"PYTHONPATH": paths, "OMP_NUM_THREADS": "1"}
    given.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed program has its modules' bytecode
    given.setdefault("PYTHONPYCACHEPREFIX", str(Path(folder, "bytecode")))
    done = subprocess.run(command, capture_output=True, text=True, env=given, cwd=folder)
    clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)
    return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def curve(path: Path) -> np.ndarray:
    """The ordinates of a written curve."""
    values = []
    for row in csv.reader(path.read_text().splitlines(), delimiter=";"):
        try:
            values.append([float(v) for v in row if v.strip()][1])
        except (ValueError, IndexError):  # titles
            continue
    return np.array(values)


def main(steps: int = 2, unknowns: int = 7500, runs: int = 5) -> None:
    """Print the medians of both and their ratio."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "deck.ssi").write_text(deck(unknowns, steps))
        ours = [sys.executable, "-m", "ssilang.cli.main", "deck.ssi", "--out", "out", "-q"]
        theirs = [sys.executable, str(HERE), "peer", str(unknowns), str(steps), "peer.csv"]
        there = importlib.util.find_spec("openseespy") is not None
        timed(ours, folder)  # compiles, and writes bytecode
        if there:
            timed([*theirs[:-2], "1", "peer.csv"], folder)
        mine, peers = [], []
        for turn in range(runs):
            mine.append(timed(ours, folder))
            if there and (turn == 0 or steps < MANY):
                peers.append(timed(theirs, folder))
        shown = {"ssilang": mine} | ({"OpenSeesPy": peers} if there else {})
        for name, times in shown.items():
            clock, used = (statistics.median(t) for t in zip(*times, strict=True))
            print(f"{name:10s} {clock:7.2f} s by the clock, {used:7.2f} s of the processor")
        if there:
            own, other = curve(Path(folder) / "out" / "corner.csv"), curve(Path(folder, "peer.csv"))
            difference = np.abs(own - other).max() / np.abs(own).max()
            if not difference <= AGREEMENT:
                raise SystemExit(f"the curves differ by {difference:.1e}: no ratio")
            ratios = [
                statistics.median(p) / statistics.median(m)
                for p, m in zip(zip(*peers, strict=True), zip(*mine, strict=True), strict=True)
            ]
            print(
                f"{steps} steps: {ratios[0]:.1f} times by the clock, {ratios[1]:.1f} of the "
                f"processor; the curves differ by {difference:.0e}"
            )


if __name__ == "__main__":
    if sys.argv[1:2] == ["peer"]:
        peer(int(sys.argv[2]), int(sys.argv[3]), sys.argv[4])
    else:
        main(*(int(a) for a in sys.argv[1:4]))
