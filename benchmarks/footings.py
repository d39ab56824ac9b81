"""A strip that rocks, lifts off and settles: one macro-element against OpenSeesPy's fibres.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas: apt install libblas3)
    OMP_NUM_THREADS=1 python benchmarks/footings.py [steps]

A footing under its weight is turned to and fro by a moment, the same steps of average
acceleration in both programs. The peer has a zeroLengthSection of 64 fibres of ElasticPPGap (no
tension, yield, the gap keeps what was pressed in). Here it is MACRO_SEMELLE with COHE at one node
pair, whose places are 64 too; where the ground is elastic it is the closed form.

Told twice: with all that the 64 places are at every step kept, as DYNAMIC does for results at every
step, and with few steps kept, as the peer does, that keeps two numbers.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

WIDTH, KN, COHESION, PLACES = 4.0, 8e7, 5e4, 64
BEARS = (2 + np.pi) * COHESION
WEIGHT = 0.3 * BEARS * WIDTH
MASS, INERTIA = WEIGHT / 9.81, 5e5
DT, PUSH, TURNS = 5e-4, 2.5e5, 1.4
FEW = 1000  # steps between two that are kept


def peer(steps: int) -> tuple[np.ndarray, float]:
    """Rotation and settlement (steps + 1, 2), and processor seconds of the steps."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 0.0)
    ops.fix(1, 1, 0, 0)
    ops.fix(2, 1, 1, 1)
    ops.mass(1, 0.0, MASS, INERTIA)
    ops.uniaxialMaterial("ElasticPPGap", 1, KN / WIDTH, -BEARS, 0.0, 0.0, "damage")
    ops.section("Fiber", 1)
    for i in range(PLACES):
        ops.fiber(WIDTH * ((i + 0.5) / PLACES - 0.5), 0.0, WIDTH / PLACES, 1)
    ops.element("zeroLengthSection", 1, 2, 1, 1, "-orient", 0.0, 1.0, 0.0, -1.0, 0.0, 0.0)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(1, 0.0, -WEIGHT, 0.0)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-3, 50)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    ops.analyze(1)
    ops.loadConst("-time", 0.0)
    ops.timeSeries("Trig", 2, 0.0, 1e9, 1 / TURNS)
    ops.pattern("Plain", 2, 2)
    ops.load(1, 0.0, 0.0, PUSH)
    ops.wipeAnalysis()
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-3, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    found, began = [(0.0, ops.nodeDisp(1, 2))], time.process_time()
    for _ in range(steps):
        if ops.analyze(1, DT):
            raise SystemExit("OpenSees did not converge")
        found.append((ops.nodeDisp(1, 3), ops.nodeDisp(1, 2)))
    return np.array(found), time.process_time() - began


def own(steps: int, kept: str = "'TOUS'") -> tuple[np.ndarray, float]:
    """The same at the steps that are kept, and processor seconds of a script's whole run."""
    from ssilang.cli.run import run_text

    text = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; PS = 0. -1. ; P = 0. 0. ; L = MANU 'SEG2' PS P ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'MACRO_SEMELLE' 'JOI1' ; "
        f"A = MATE M 'KN' {KN} 'KS' {KN} 'LARG' {WIDTH} 'COHE' {COHESION} ; T = TABL ; "
        "T . 'RIGI' = (BLOQ PS 'UX' 'UY' 'RZ') ET (BLOQ P 'UX') ; "
        f"T . 'MASS' = (MASS 'DEPL' {MASS} P) ET (MASS 'ROTA' {INERTIA} P) ; "
        f"T . 'DEPL' = MANU 'CHPO' P 1 'UY' {-WEIGHT / KN!r} ; "
        "T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "
        f"LI = PROG 0. 'PAS' {DT} {steps * DT!r} ; V = SIN (LI * {360.0 * TURNS!r}) ; "
        f"T . 'CHAR' = (CHAR 'MECA' (FORC (0. {-WEIGHT!r}) P) (EVOL 'MANU' (PROG 0. 1.E9) "
        f"(PROG 1. 1.))) ET (CHAR 'MECA' (MANU 'CHPO' P 1 'MZ' {PUSH}) (EVOL 'MANU' LI V)) ; "
        f"T . 'TEMPS_CALCULES' = LI ; T . 'PAS_SAUVES' = {kept} ; T . 'MAILLAGE_SAUVE' = P ; "
        "R = DYNAMIC T ; TH = EXTR (EVOL 'TEMP' R 'DEPL' 'RZ' P) 'ORDO' ; "
        "UY = EXTR (EVOL 'TEMP' R 'DEPL' 'UY' P) 'ORDO' ; "
    )
    with tempfile.TemporaryDirectory() as folder:
        began = time.process_time()
        result = run_text(text, output_directory=Path(folder))
        seconds = time.process_time() - began
    if result.exit_code:
        raise SystemExit(result.message)
    lists = [result.session.root.find(name).values for name in ("TH", "UY")]
    return np.stack(lists, axis=1), seconds


def main() -> None:
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else 20_000
    other, theirs = peer(steps)
    own(10)  # compiles
    _, few = own(100)
    mine, whole = own(steps)
    ours = whole - few
    for name, column in (("rotation", 0), ("vertical motion", 1)):
        size = np.abs(other[:, column]).max()
        apart = np.abs(mine[:, column] - other[:, column])
        print(f"{name}: largest {size:.3g}, differ by {apart.max() / size:.1e} of it, "
              f"{apart[: steps // 4].max() / size:.1e} in the first quarter")  # fmt: skip
    alone = min(own(steps, str(FEW))[1] - own(FEW, str(FEW))[1] for _ in range(3))
    theirs = min(theirs, *(peer(steps)[1] for _ in range(2)))
    for said, seconds, count in (("all", ours, steps), ("few", alone, steps - FEW)):
        each = seconds / count
        print(f"{steps} steps, {said} kept: {1 / each:.0f} a second against {steps / theirs:.0f}, "
              f"{theirs / steps / each:.2f} times")  # fmt: skip


if __name__ == "__main__":
    main()
