"""A wall that rocks freely: OpenSees' example of its element RockingBC, and the deck of ssilang.

    pip install '.[bench]'
    OMP_NUM_THREADS=1 python benchmarks/rocking_wall.py [longest step, s] [shortest] [duration]
                                                        default 1e-3 1e-6 2.3

The peer runs the case "Free" of `EXAMPLES/ExampleScripts/RockingBC_example.tcl` of its repository
(Avgenakis and Psycharis 2020) with longer steps than the example's 1e-5 s, 1e-8 at impacts; ssilang
runs `cases/published/rocking_wall.ssi`. Both model one wall, and differ in how its foot gives way
(RockingBC integrates stresses near the contact, the deck has 15 springs) and in rotations
(corotational, small). So motions are compared, not held equal: no speed is printed if instants or
swings are more than 5 % apart.
"""

import itertools
import math
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

WIDTH, THICKNESS, DENSITY, GRAVITY = 1.0, 1.0, 2.5, 9.81
ANGLE, TILT, DAMPING, STRAIN, YIELD = 0.2, 0.1, 0.05, 5e-6, 5e-3
DECK_DURATION = 3.6
AGREEMENT = 5e-2
FORCE_RATIO = 1e-3
"""Change of the axial force in a step above which RockingBC asks for a shorter one."""
DECK = Path(__file__).parents[1] / "cases" / "published" / "rocking_wall.ssi"


def analysis(system: str = "UmfPack") -> None:
    """What both analyses of the peer share."""
    import openseespy.opensees as ops

    ops.wipeAnalysis()
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system(system)
    ops.algorithm("Newton")


def peer_model(shortest: float) -> None:
    """The wall under its weight, tilted, with its dampers."""
    import openseespy.opensees as ops

    height = WIDTH / math.tan(ANGLE)
    young = DENSITY * GRAVITY * height / STRAIN
    strength = -DENSITY * GRAVITY * height / YIELD
    mass = DENSITY * height * WIDTH * THICKNESS
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for tag in range(3):
        ops.node(1 + tag, 0.0, tag * height / 2.0)
    ops.element(
        "RockingBC", 1, 2, 1, 15, young, 0.0, strength, WIDTH, THICKNESS, 0.0, "-convlim", 1e-15,
        "-useshear", 0, "-blevery", 1, "-useUelNM", 1, "-usecomstiff", 0, "-af", 1.0, "-aflim", 0.4,
        "-convlimmult", 1.0, "-maxtries", 50, "-NlimN", FORCE_RATIO, "-NlimT", 1.0,
        "-Dtlim", shortest, "-errorifNexceeds", 1,
    )  # fmt: skip
    ops.geomTransf("Corotational", 1)
    section = (WIDTH * THICKNESS, young, THICKNESS * WIDTH**3 / 12.0)
    ops.element("elasticBeamColumn", 2, 2, 3, *section, 1)
    ops.fix(1, 1, 1, 1)
    ops.mass(2, mass, mass, mass * (WIDTH**2 + height**2) / 12.0)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, -mass * GRAVITY, 0.0)
    analysis()
    ops.test("EnergyIncr", 1e-10, 100)
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    if ops.analyze(10):
        raise SystemExit("OpenSees: no equilibrium under the weight")
    ops.loadConst("-time", 0.0)
    first = math.sqrt(ops.eigen("-fullGenLapack", 1)[0])
    ops.pattern("Plain", 2, 1)
    ops.load(2, 1.0, 0.0, 0.0)
    while abs(ops.nodeDisp(2, 3)) < TILT * (1.0 - 1e-9):
        left = TILT - abs(ops.nodeDisp(2, 3))
        ops.integrator("DisplacementControl", 2, 3, -min(0.005 * TILT, left))
        ops.analysis("Static")
        if ops.analyze(1):
            raise SystemExit("OpenSees: the wall could not be tilted")
    ops.setTime(0.0)
    ops.rayleigh(0.0, 2.0 * DAMPING / first, 0.0, 0.0)
    ops.remove("loadPattern", 2)
    analysis()
    ops.test("RelativeNormUnbalance", 1e-10, 100)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def peer(longest: float, shortest: float, duration: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Instants, rotations at mid height, seconds of the processor for the motion alone.

    Steps are halved where the element asks for it, and lengthened after ten good ones, as the
    example does.
    """
    import openseespy.opensees as ops

    peer_model(shortest)
    times, turns = [0.0], [ops.nodeDisp(2, 3)]
    step, good, start = longest, 0, time.process_time()
    while times[-1] < duration:
        if ops.analyze(1, step):
            if step == shortest:
                raise SystemExit(f"OpenSees stopped at {times[-1]:.3f} s")
            step, good = max(shortest, 0.5 * step), 0
            continue
        good += 1
        if good >= 10 and ops.eleResponse(1, "forceratioNmax")[0] < 0.9 * FORCE_RATIO:
            step = min(longest, 1.5 * step)
        times.append(ops.getTime())
        turns.append(ops.nodeDisp(2, 3))
    return np.array(times), np.array(turns), time.process_time() - start


def landings(times: np.ndarray, turns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Instants at which the wall is upright, and its largest tilt before each."""
    at = np.flatnonzero(turns[:-1] * turns[1:] < 0.0)
    part = turns[at] / (turns[at] - turns[at + 1])
    bounds = np.concatenate([[0], at + 1])
    tilts = [np.abs(turns[i:j]).max() for i, j in itertools.pairwise(bounds)]
    return times[at] + part * (times[at + 1] - times[at]), np.array(tilts)


def ours() -> tuple[np.ndarray, np.ndarray, float]:
    """Instants and tilts of the deck, seconds of the processor of a whole run of it."""
    from ssilang.cli.run import RunOptions, run_file

    with tempfile.TemporaryDirectory() as folder:
        start = time.process_time()
        result = run_file(DECK, RunOptions(output_directory=Path(folder)))
        spent = time.process_time() - start
    if result.exit_code:
        raise SystemExit(result.message)
    found = [np.array(result.session.root.find(name).values) for name in ("LZ", "LP")]
    return found[0], found[1], spent


def main(longest: float = 1e-3, shortest: float = 1e-6, duration: float = 2.3) -> None:
    """Compare the motions, then the time that they take."""
    ours()  # compiled once
    instants, tilts, mine = ours()
    times, turns, theirs = peer(longest, shortest, duration)
    peer_instants, peer_tilts = landings(times, turns)
    common = len(peer_instants)
    print("upright (s)  ssilang", instants.round(5), " RockingBC", peer_instants.round(5))
    print("tilt (rad)   ssilang", tilts.round(5), " RockingBC", peer_tilts.round(5))
    apart = [
        np.abs(a[:common] / b - 1.0).max()
        for a, b in ((instants, peer_instants), (tilts, peer_tilts))
    ]
    if not max(apart) <= AGREEMENT:
        raise SystemExit(f"the two are more than {AGREEMENT:.0%} apart: no ratio")
    print(f"ssilang    {mine / DECK_DURATION:8.2f} s of processor for a second, the whole deck")
    print(f"RockingBC  {theirs / duration:8.2f} s, {len(times) - 1} steps, the motion alone")
    print(f"ratio      {theirs / duration / (mine / DECK_DURATION):8.1f}")


if __name__ == "__main__":
    main(*(float(a) for a in sys.argv[1:4]))
