"""Shaken soil that yields by nested surfaces, in ssilang and in OpenSeesPy.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas3 and liblapack3)
    OMP_NUM_THREADS=1 python benchmarks/cyclic_soil.py [cells wide ...]          default 1 40

Twenty metres of soil in four layers on rigid rock, cells of 1 m, the motion of
`cases/seismic/soil_column.ssi`: 2 s at 5 ms, lumped masses, Rayleigh's damping on the first
stiffness, average acceleration. The peer has PressureIndependMultiYield in elements quad with the
same 20 points of G/Gmax: Mroz and Prevost's surfaces that push each other, where ours are parts
side by side. In simple shear both are Masing's loops of one polygon; on paths that turn in space
they differ. First one cell is led along a path of shear, then the soil is shaken. Stresses and the
motion of the surface must agree within 1e-6 of the largest before a ratio is printed.

The peer goes by Newton's method, stops at corrections of 1e-9 m, and takes of its solvers the one
that makes 10 steps first; ours has Newton's method too, or a kept factor (40 cells wide), and stops
at a residual of 1e-10 of the forces. Processor time of the steps alone, two runs each in turn, the
faster counts.
"""

import sys
import time

import numpy as np
import openseespy.opensees as ops

from ssilang.cli.run import run_text
from ssilang.kernel.materials.plastic.backbone import break_points, hyperbola
from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS, law_at
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.plasticity.bulk import bulk_of, without_stiffness
from ssilang.kernel.plasticity.points import plastic_zones
from ssilang.kernel.plasticity.run import run_bulk
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem
from ssilang.kernel.stepping.snapshot import Snapshot

DENSITY, POISSON, DT, STEPS, HEIGHT = 1900.0, 0.3, 5e-3, 400, 20
SPEEDS, REFERENCES = (300.0, 250.0, 200.0, 160.0), (1.5e-3, 1.2e-3, 1e-3, 8e-4)
MASS_FACTOR, STIFFNESS_FACTOR = 0.04 * np.pi * 10 / 11, 0.01 / (11 * np.pi)
SOLVERS = ("BandGeneral", "SparseSYM", "UmfPack")
AGREEMENT = 1e-6

TIMES = DT * np.arange(STEPS + 1)
TONES = ((0.4, 1.3), (0.6, 2.9), (0.3, 5.1))
ACCELERATION = (
    2.5 * np.sin(np.pi * TIMES / 4) ** 2 * sum(a * np.sin(2 * np.pi * f * TIMES) for a, f in TONES)
)
PATH = np.interp(np.arange(0, 3.0001, 0.01), [0, 1, 2, 3], [0, 4e-3, -2e-3, 1e-3])

SCRIPT = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
LAY = TABL ; LVS = PROG {speeds} ; LGR = PROG {references} ;
REPE BL {n} ;
  Y0 = {high} * (&BL - 1) ; L0 = DROI {wide} (0. Y0) ({wide}. Y0) ;
  LAY . &BL = L0 TRAN {cells} (0. {high}) ;
FIN BL ;
SOL = LAY . 1 ;
REPE BL ({n} - 1) ; SOL = SOL ET (LAY . (&BL + 1)) ; FIN BL ; ELIM 1.E-6 SOL ;
MOS = MODE SOL 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'IWAN' ;
REPE BL {n} ;
  A0 = MATE (REDU MOS (LAY . &BL)) 'YOUN' (2. * (1. + {nu}) * {rho} * ((EXTR LVS &BL) ** 2))
     'NU' {nu} 'RHO' {rho} 'GAMR' (EXTR LGR &BL) ;
  SI (EGA &BL 1) ; MAS = A0 ; SINON ; MAS = MAS ET A0 ; FINSI ;
FIN BL ;
BAS = SOL POIN 'DROI' (0. 0.) (1. 0.) 1.E-6 ;
KSO = RIGI MOS MAS ; MSO = LUMP MOS MAS ; BLO = (BLOQ 'UX' BAS) ET (BLOQ 'UY' SOL) ;
CSO = ({alpha} * MSO) ET ({beta} * KSO) ; PUSH = MSO * (MANU 'CHPO' SOL 1 'UX' -1.) ;
CH = CHAR 'MECA' PUSH (EVOL 'MANU' (PROG {times}) (PROG {motion})) ;
RIG = KSO ET BLO ; PTOP = SOL POIN 'PROC' (0. {top}.) ;
"""


class Top:
    """Keeps the surface's displacement at all steps."""

    def __init__(self, node: int) -> None:
        self.node, self.wanted = node, np.ones(STEPS + 1, bool)
        self.values: list[float] = []
        self.at = -1

    def receive(self, snapshot: Snapshot) -> None:
        """One more instant."""
        if self.at < 0:
            self.at = snapshot.problem.numbering.index_of(self.node, "UX")
        self.values.append(float(snapshot.u[self.at]))

    def close(self) -> None:
        """Nothing to close."""


def run_ssilang(wide: int) -> tuple[np.ndarray, float]:
    """Displacements of the surface (STEPS + 1,) and seconds of the steps."""
    text = SCRIPT.format(
        wide=wide, n=len(SPEEDS), cells=HEIGHT // len(SPEEDS), high=HEIGHT / len(SPEEDS),
        top=HEIGHT, nu=POISSON, rho=DENSITY, alpha=MASS_FACTOR, beta=STIFFNESS_FACTOR,
        speeds=" ".join(map(str, SPEEDS)), references=" ".join(map(str, REFERENCES)),
        times=" ".join(f"{t:.6g}" for t in TIMES),
        motion=" ".join(f"{a:.17g}" for a in ACCELERATION),
    )  # fmt: skip
    result = run_text(text)
    assert result.exit_code == 0, result.message
    find = result.session.root.find
    zones, supports = plastic_zones(find("MOS")), find("BLO")
    blank = tuple(without_stiffness(z) for z in zones)
    stiffness = Matrix(supports.table, blank, supports.relations)
    problem = make_problem(Inputs(stiffness, TIMES, find("MSO"), find("CSO"), find("CH")))
    bulk, top = bulk_of(zones, find("MAS"), problem.numbering), Top(find("PTOP").node)
    started = time.process_time()
    run_bulk(problem, bulk, bulk.unloaded(), [top], dynamic=True)
    return np.array(top.values), time.process_time() - started


# --- the peer ------------------------------------------------------------------------------


def peer_soil(tag: int, speed: float, reference: float) -> float:
    """A layer's material; its shear modulus."""
    shear = DENSITY * speed**2
    bulk = 2 * shear * (1 + POISSON) / (3 * (1 - 2 * POISSON))
    strains, ratios = break_points(hyperbola(reference))
    points = [float(v) for pair in zip(strains, ratios, strict=True) for v in pair]
    strength = float(shear * strains[-1] * ratios[-1])
    given = (float(shear), float(bulk), strength, float(strains[-1]), -len(strains), *points)
    # version 3.7.1.2 reads the number of surfaces where friction stands in its manual
    ops.nDMaterial("PressureIndependMultiYield", tag, 2, DENSITY, *given)
    return float(shear)


def peer_path() -> np.ndarray:
    """Shear stresses of one cell of the peer that is led along PATH."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    for i, (x, y) in enumerate([(0, 0), (1, 0), (1, 1), (0, 1)], 1):
        ops.node(i, float(x), float(y))
    shear = peer_soil(1, SPEEDS[0], REFERENCES[0])
    ops.element("quad", 1, 1, 2, 3, 4, 1.0, "PlaneStrain", 1)
    for i in (1, 2, 3, 4):
        ops.fix(i, 1 if i < 3 else 0, 1)
    ops.timeSeries("Path", 1, "-time", *map(float, range(len(PATH))), "-values", *PATH.tolist())
    ops.pattern("Plain", 1, 1)
    ops.sp(3, 1, 1.0)
    ops.sp(4, 1, 1.0)
    ops.updateMaterialStage("-material", 1, "-stage", 1)
    ops.constraints("Penalty", 1e9 * shear, 1e9 * shear)
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-13, 20)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    found = [0.0]
    for _ in PATH[1:]:
        assert ops.analyze(1) == 0
        found.append(ops.eleResponse(1, "material", "1", "stress")[3])
    return np.array(found)


def own_path() -> np.ndarray:
    """The same of our law."""
    shear = DENSITY * SPEEDS[0] ** 2
    values = {"YOUN": np.full(1, 2 * shear * (1 + POISSON)), "NU": np.full(1, POISSON)}
    curves = {"GGAM": ([hyperbola(REFERENCES[0])], np.zeros(1, dtype=np.int64))}
    parameters = PointParameters(values, curves)
    law = law_at(PLASTIC_LAWS["IWAN"], parameters)
    stress, inner, found = np.zeros((1, 6)), np.zeros((1, len(law.variables))), [0.0]
    for step in np.diff(PATH):
        strain = np.array([[0.0, 0.0, 0.0, step, 0.0, 0.0]])
        after = law.respond(parameters, stress, strain, inner)
        stress, inner = after.stress, after.variables
        found.append(float(stress[0, 3]))
    return np.array(found)


def run_peer(wide: int, solver: str, steps: int = STEPS) -> tuple[np.ndarray, float]:
    """Displacements of the surface (steps + 1,) and seconds of the steps."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    for j in range(HEIGHT + 1):
        for i in range(wide + 1):
            ops.node(1 + i + j * (wide + 1), float(i), float(j))
            ops.fix(1 + i + j * (wide + 1), 1 if j == 0 else 0, 1)
    for k, (speed, reference) in enumerate(zip(SPEEDS, REFERENCES, strict=True), 1):
        peer_soil(k, speed, reference)
    for j in range(HEIGHT):
        for i in range(wide):
            low = 1 + i + j * (wide + 1)
            corners = (low, low + 1, low + wide + 2, low + wide + 1)
            layer = 1 + j * len(SPEEDS) // HEIGHT
            ops.element("quad", 1 + i + j * wide, *corners, 1.0, "PlaneStrain", layer)
    for k in range(1, len(SPEEDS) + 1):
        ops.updateMaterialStage("-material", k, "-stage", 1)
    ops.timeSeries("Path", 1, "-dt", DT, "-values", *ACCELERATION.tolist())
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.rayleigh(float(MASS_FACTOR), 0.0, float(STIFFNESS_FACTOR), 0.0)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(solver)
    ops.test("NormDispIncr", 1e-9, 30)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    top, found = 1 + HEIGHT * (wide + 1), [0.0]
    started = time.process_time()
    for _ in range(steps):
        assert ops.analyze(1, DT) == 0
        found.append(ops.nodeDisp(top, 1))
    return np.array(found), time.process_time() - started


def difference(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Largest difference, of the largest value."""
    return float(np.abs(ours - theirs).max() / np.abs(ours).max())


def compare(wide: int) -> None:
    """Both on a soil `wide` cells wide."""
    own_path()  # compiles
    solver = min(SOLVERS, key=lambda name: run_peer(wide, name, 10)[1])
    runs = [(run_ssilang(wide), run_peer(wide, solver)) for _ in range(2)]
    own, peer = (min(seconds for _, seconds in side) for side in zip(*runs, strict=True))
    far = difference(runs[0][0][0], runs[0][1][0])
    line = (
        f"{wide * HEIGHT:6d} cells: motions differ by {far:.1e}; ssilang {1e3 * own / STEPS:.2f} ms"
    )
    line += f" a step, OpenSeesPy ({solver}) {1e3 * peer / STEPS:.2f} ms"
    print(line + (f": {peer / own:.2f} times" if far < AGREEMENT else ": no ratio"))


def main() -> None:
    """One cell on a path, then soils of several widths."""
    print(f"stresses of one cell along a path differ by {difference(own_path(), peer_path()):.1e}")
    for wide in [int(a) for a in sys.argv[1:]] or [1, 40]:
        compare(wide)


if __name__ == "__main__":
    main()
