"""The same oscillator in ssilang and in OpenSeesPy: same motion first, then the two speeds.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas: apt install libblas3)
    python benchmarks/oscillator_openseespy.py [steps]

Both step by average acceleration with the same dt and Newton's method on the same bilinear
spring (OpenSees: Elastic and ENT materials in two zeroLength elements). The ratio is printed
only if the two displacements agree within 1e-9 of the release at every step of one second.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from oscillator import (
    MASS,
    POINT,
    RELEASE,
    SCRIPT,
    SOIL,
    STIFFNESS,
    run,
    steps_per_second,
)

DT = 2.5e-4
AGREEMENT = 1e-9


def peer_model() -> None:
    """The oscillator at rest, released, ready to analyse."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, float(MASS))
    ops.uniaxialMaterial("Elastic", 1, STIFFNESS)
    ops.uniaxialMaterial("ENT", 2, SOIL)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)
    ops.setNodeDisp(2, 1, RELEASE, "-commit")
    ops.setNodeAccel(2, 1, float(-STIFFNESS * RELEASE / MASS), "-commit")
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-6, 20)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def peer_motion(steps: int) -> np.ndarray:
    """Displacements of the peer at all steps, the start first."""
    import openseespy.opensees as ops

    peer_model()
    u = [RELEASE]
    for _ in range(steps):
        if ops.analyze(1, DT):
            raise SystemExit("OpenSees did not converge")
        u.append(ops.nodeDisp(2, 1))
    return np.array(u)


def peer_speed(steps: int) -> float:
    """Steps per second of the peer, its loop in one call."""
    import openseespy.opensees as ops

    best = np.inf
    for _ in range(3):
        peer_model()
        start = time.perf_counter()
        if ops.analyze(steps, DT):
            raise SystemExit("OpenSees did not converge")
        best = min(best, time.perf_counter() - start)
    return steps / best


def main(steps: int = 200_000) -> None:
    """Compare the motions, then the speeds."""
    n, speeds = round(1.0 / DT), {}
    with tempfile.TemporaryDirectory() as folder:
        exact = peer_motion(n)
        for name, script in (("a clamped beam", SCRIPT), ("a mass on a spring", POINT)):
            ours = run(n, DT, 1, Path(folder), script)
            distance = float(np.max(np.abs(ours.u - exact))) / RELEASE
            print(f"{name}: largest difference over 1 s {distance:.1e} of the release")
            if not distance <= AGREEMENT:
                raise SystemExit(f"the two do not agree within {AGREEMENT:.0e}: no ratio")
            speeds[name] = steps_per_second(steps, DT, Path(folder), script)[0]
    peer = peer_speed(steps)
    print(f"OpenSeesPy          {peer:12,.0f} steps/s")
    for name, speed in speeds.items():
        print(f"{name:18s}  {speed:12,.0f} steps/s, ratio {speed / peer:.1f}")


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]))
