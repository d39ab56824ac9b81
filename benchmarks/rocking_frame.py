"""A frame that rocks on 50 no-tension springs, in ssilang and in OpenSeesPy.

    pip install '.[bench]'
    OMP_NUM_THREADS=1 python benchmarks/rocking_frame.py [steps]          default 20000

A footing beam of 49 elements on 50 springs, two columns and a girder (156 unknowns, 153 without
the ground), masses at the nodes, weight, mass-proportional damping, a ground acceleration of three
sines that lifts the footing's ends. Both step by average acceleration. The peer runs with each of
its solvers and the fastest counts. Displacements of the roof and uplift of both ends must agree
within 1e-6 of their largest at all steps saved before a speed is printed.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

SPRINGS, WIDTH, HEIGHT, DT, GRAVITY, ALPHA = 50, 10.0, 12.0, 1e-3, 9.81, 0.2
KN, YOUNG = 4e6, 3e10
FOOTING, COLUMN = (2.0, 0.6), (0.6, 0.05)  # area (m2), inertia (m4)
ROOF, NODE = 6e4, 2e3  # masses (kg): at each column's top, at each node of the footing
LEFT, RIGHT = 15, 34  # footing nodes under the columns
AGREEMENT = 1e-6
SOLVERS = ("BandGeneral", "UmfPack", "ProfileSPD", "SparseSYM")

SCRIPT = """
OPTI ECHO 0 ; OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
MOTION = '{motion}' ;
T0 = LIRE 'CSV' MOTION ; LTA = T0 . 1 ; LAC = T0 . 2 ;
P1 = 0. 0. ; P2 = {width} 0. ;
FOO = DROI {elements} P1 P2 ;
Q1 = FOO POIN 'PROC' ({left} 0.) ; Q2 = FOO POIN 'PROC' ({right} 0.) ;
R1 = {left} {height} ; R2 = {right} {height} ;
COL = (DROI 1 Q1 R1) ET (DROI 1 Q2 R2) ET (DROI 1 R1 R2) ;
GRO = FOO PLUS (0. -1.) ;
JOI = MANU 'SEG2' (POIN 1 GRO) (POIN 1 FOO) ;
REPE BJ ({elements}) ; I = &BJ + 1 ;
  JOI = JOI ET (MANU 'SEG2' (POIN I GRO) (POIN I FOO)) ;
FIN BJ ;
MOF = MODE FOO 'MECANIQUE' 'ELASTIQUE' 'POUT' ;
MOC = MODE COL 'MECANIQUE' 'ELASTIQUE' 'POUT' ;
MAF = MATE MOF 'YOUN' {young} 'NU' 0.2 'RHO' 0. 'SECT' {fa} 'INRY' {fi} 'INRZ' {fi} ;
MAC = MATE MOC 'YOUN' {young} 'NU' 0.2 'RHO' 0. 'SECT' {ca} 'INRY' {ci} 'INRZ' {ci} ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
MAJ = MATE MOJ 'KN' {kn} 'KS' 0. ;
MAS = (MASS 'DEPL' {node} FOO) ET (MASS 'DEPL' {roof} (R1 ET R2)) ;
RIG = (RIGI MOF MAF) ET (RIGI MOC MAC) ET (BLOQ 'UX' 'UY' GRO) ET (BLOQ 'UX' P1) ;
DOWN = MANU 'CHPO' (FOO ET COL) 1 'UY' -{gravity} ;
SIDE = MANU 'CHPO' (FOO ET COL) 1 'UX' -1. ;
T1 = TABL ;
T1 . 'RIGI' = RIG ; T1 . 'MASS' = MAS ; T1 . 'AMOR' = {alpha} * MAS ;
T1 . 'MODELE' = MOJ ; T1 . 'CARACTERISTIQUES' = MAJ ;
T1 . 'CHAR' = (CHAR 'MECA' (MAS * DOWN)) ET (CHAR 'MECA' (MAS * SIDE) (EVOL 'MANU' LTA LAC)) ;
T1 . 'DEPL' = RESO ((RIGI MOF MAF) ET (RIGI MOC MAC) ET (BLOQ 'UX' 'UY' GRO) ET (BLOQ 'UX' P1)
   ET (RIGI MOJ MAJ)) (MAS * DOWN) ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' {dt} 'NPAS' {steps} ;
T1 . 'PAS_SAUVES' = {every} ;
T2 = DYNAMIC T1 ;
E1 = EVOL 'TEMP' T2 'DEPL' 'UX' R1 ; E2 = EVOL 'TEMP' T2 'DEPL' 'UY' P1 ;
E3 = EVOL 'TEMP' T2 'DEPL' 'UY' P2 ;
LU = EXTR E1 'ORDO' ; LA = EXTR E2 'ORDO' ; LB = EXTR E3 'ORDO' ;
@VERIFIE T1 'roof' (MAXI (ABS LU)) 0. 100. ;
@VERIFIE T1 'uplift' (MAXI LA) -10. 100. ;
FIN ;
"""


def ground(steps: int, scale: float = 1.0) -> np.ndarray:
    """Ground acceleration (m/s2) at all times."""
    t = DT * np.arange(steps + 1)
    waves = np.sin(4.1 * t) + 0.7 * np.sin(9.7 * t + 1.0) + 0.4 * np.sin(17.3 * t)
    return scale * 1.3 * np.minimum(t, 1.0) * waves


def places() -> np.ndarray:
    """Abscissas of the footing's nodes."""
    return np.linspace(0.0, WIDTH, SPRINGS)


def script(steps: int, every: int, motion: Path) -> str:
    """The deck."""
    x = places()
    return SCRIPT.format(
        motion=motion, width=WIDTH, elements=SPRINGS - 1, left=x[LEFT], right=x[RIGHT],
        height=HEIGHT, young=YOUNG, fa=FOOTING[0], fi=FOOTING[1], ca=COLUMN[0], ci=COLUMN[1],
        kn=KN, node=NODE, roof=ROOF, gravity=GRAVITY, alpha=ALPHA, dt=DT, steps=steps, every=every,
    )  # fmt: skip


def write_motion(path: Path, steps: int, scale: float = 1.0) -> None:
    """A motion as a file of times and accelerations."""
    rows = np.column_stack([DT * np.arange(steps + 1), ground(steps, scale)])
    np.savetxt(path, rows, delimiter=";", fmt="%.17g")


def ours(steps: int, every: int, folder: Path) -> tuple[np.ndarray, float]:
    """Displacements (3, n) of roof and both ends at saved steps, seconds of DYNAMIC."""
    from ssilang.cli.run import RunOptions, run_text

    motion = folder / "motion.csv"
    write_motion(motion, steps)
    options = RunOptions(output_directory=folder, allowed=[folder])
    result = run_text(script(steps, every, motion), options=options)
    if result.exit_code:
        raise SystemExit(result.message)
    found = [result.session.root.find(n).values for n in ("LU", "LA", "LB")]
    return np.array(found), result.session.statistics["calculations"][0]["seconds"]


def peer_model(steps: int, system: str, scale: float = 1.0) -> None:
    """The frame in static equilibrium under its weight, ready to shake."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for i, x in enumerate(places()):
        ops.node(1 + i, float(x), 0.0)
        ops.node(1001 + i, float(x), 0.0)
        ops.fix(1001 + i, 1, 1, 1)
        ops.mass(1 + i, NODE, NODE, 0.0)
    ops.fix(1, 1, 0, 0)
    tops = (201, 202)
    for top, foot in zip(tops, (LEFT, RIGHT), strict=True):
        ops.node(top, float(places()[foot]), HEIGHT)
        ops.mass(top, ROOF, ROOF, 0.0)
    ops.geomTransf("Linear", 1)
    ops.uniaxialMaterial("ENT", 1, KN)
    for i in range(SPRINGS - 1):
        ops.element("elasticBeamColumn", 1 + i, 1 + i, 2 + i, FOOTING[0], YOUNG, FOOTING[1], 1)
    for tag, a, b in ((301, 1 + LEFT, 201), (302, 1 + RIGHT, 202), (303, 201, 202)):
        ops.element("elasticBeamColumn", tag, a, b, COLUMN[0], YOUNG, COLUMN[1], 1)
    for i in range(SPRINGS):
        ops.element("zeroLength", 401 + i, 1001 + i, 1 + i, "-mat", 1, "-dir", 2)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    for node, mass in [(1 + i, NODE) for i in range(SPRINGS)] + [(t, ROOF) for t in tops]:
        ops.load(node, 0.0, -mass * GRAVITY, 0.0)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(system)
    ops.test("NormDispIncr", 1e-11, 30)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    if ops.analyze(1):
        raise SystemExit("OpenSees: no equilibrium")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    ops.rayleigh(ALPHA, 0.0, 0.0, 0.0)
    ops.timeSeries("Path", 2, "-dt", DT, "-values", *ground(steps + 1, scale).tolist())
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(system)
    ops.test("NormDispIncr", 1e-11, 30)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def peer(steps: int, every: int, system: str) -> np.ndarray:
    """Displacements (3, n) of the peer."""
    import openseespy.opensees as ops

    peer_model(steps, system)
    rows = [[ops.nodeDisp(201, 1), ops.nodeDisp(1, 2), ops.nodeDisp(SPRINGS, 2)]]
    for _ in range(steps // every):
        if ops.analyze(every, DT):
            raise SystemExit("OpenSees did not converge")
        rows.append([ops.nodeDisp(201, 1), ops.nodeDisp(1, 2), ops.nodeDisp(SPRINGS, 2)])
    return np.array(rows).T


def peer_seconds(steps: int, system: str) -> float:
    """Wall time of the peer's loop, in one call."""
    import openseespy.opensees as ops

    peer_model(steps, system)
    start = time.perf_counter()
    if ops.analyze(steps, DT):
        return float("inf")
    return time.perf_counter() - start


def best_system() -> str:
    """The peer's fastest solver over 500 steps."""
    return min(SOLVERS, key=lambda name: peer_seconds(500, name))


def main(steps: int = 20_000) -> None:
    """Compare the motions, then the speeds."""
    every, system = 10, best_system()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        found, _ = ours(steps, every, folder)
        exact = peer(steps, every, system)
        size = np.abs(exact - exact[:, :1]).max(axis=1)
        gap = float((np.abs(found - exact).max(axis=1) / size).max())
        print(f"roof {size[0]:.3f} m, ends {size[1]:.4f} and {size[2]:.4f} m; difference {gap:.1e}")
        if not gap <= AGREEMENT:
            raise SystemExit(f"the two do not agree within {AGREEMENT:.0e}: no ratio")
        mine, theirs = [], []
        for _ in range(3):
            mine.append(ours(steps, steps, folder)[1])
            theirs.append(peer_seconds(steps, system))
    a, b = steps / np.median(mine), steps / np.median(theirs)
    print(f"ssilang     {a:10,.0f} steps/s")
    print(f"OpenSeesPy  {b:10,.0f} steps/s ({system})")
    print(f"ratio       {a / b:10.1f}")


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]))
