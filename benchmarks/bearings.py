"""Bearings against OpenSeesPy's elastomericBearingBoucWen and singleFPBearing: paths, a tower.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas: apt install libblas3)
    OMP_NUM_THREADS=1 python benchmarks/bearings.py [steps]

The same displacements are imposed on one bearing in both programs. Then a mass on a lead and rubber
bearing is shaken in both, the same steps of average acceleration: displacements, steps a second.
What differs: APPUI_PENDULE is lifted by its bowl (u^2 / 2 R), singleFPBearing is not but turns its
forces with the bowl's slope; here the normal force is imposed, not the vertical displacement.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

KN, KS, KPOS, QD = 1e9, 1.1e7, 1e6, 2e5
RADIUS, MU, WEIGHT, MASS = 2.0, 0.06, 1e6, 1e5
DT, PUSH = 1e-3, 3e5
LINE = ("-orient", 0.0, 1.0, 0.0, -1.0, 0.0, 0.0)


def peer(kind: str, eta: float = 1.0) -> None:
    """Two points in one place, the lower one held."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 0, 1)
    ops.uniaxialMaterial("Elastic", 1, KN)
    ops.uniaxialMaterial("Elastic", 2, 1.0)
    if kind == "lead":
        ops.element("elastomericBearingBoucWen", 1, 1, 2, KS, QD, KPOS / KS, 0.0, 1.0, eta, 0.5,
                    0.5, "-P", 1, "-Mz", 2, *LINE)  # fmt: skip
    else:
        ops.frictionModel("Coulomb", 1, MU)
        ops.element("singleFPBearing", 1, 1, 2, 1, RADIUS, KS, "-P", 1, "-Mz", 2, *LINE)


def analysed(kind: str, *integrator: object) -> None:
    import openseespy.opensees as ops

    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-4, 50)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


def peer_path(kind: str, path: np.ndarray, eta: float = 1.0) -> np.ndarray:
    """Shear forces on a path of horizontal displacements under WEIGHT."""
    import openseespy.opensees as ops

    peer(kind, eta)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, -WEIGHT, 0.0)
    analysed("Static", "LoadControl", 1.0)
    ops.analyze(1)
    ops.loadConst("-time", 0.0)
    ops.timeSeries("Path", 2, "-dt", 1.0, "-values", 0.0, *map(float, path), float(path[-1]))
    ops.pattern("Plain", 2, 2)
    ops.sp(2, 1, 1.0)
    out = []
    for _ in path:
        if ops.analyze(1):
            raise SystemExit("OpenSees did not converge")
        ops.reactions()
        out.append(ops.nodeReaction(2, 1))
    return np.array(out)


def own_path(kind: str, path: np.ndarray, eta: float = 1.0) -> np.ndarray:
    """The same by the law itself, the vertical jump such that the normal force is WEIGHT."""
    from ssilang.kernel.interface.laws.columns import N_PARAMETERS, N_STATE, LawCode, Parameter
    from ssilang.kernel.interface.laws.point_laws import respond

    p, lead = np.zeros((1, N_PARAMETERS)), kind == "lead"
    # singleFPBearing's first stiffness holds its bowl's, KS of APPUI_PENDULE is friction's alone
    first = KS if lead else KS - WEIGHT / RADIUS
    for name, value in {"KN": KN, "KS1": first, "QD": QD, "KPOS": KPOS, "ETA": eta, "BETA": 0.5,
                        "RAYO": RADIUS, "FROT": MU}.items():  # fmt: skip
        p[0, Parameter[name]] = value
    code = np.array([int(LawCode.LEAD if lead else LawCode.PENDULUM)])
    state, out = np.zeros((1, N_STATE)), []
    for u in path:
        w = np.array([[u, -WEIGHT / KN + (0.0 if lead else u * u / (2 * RADIUS))]])
        t, new, D = np.zeros((1, 2)), np.zeros((1, N_STATE)), np.zeros((1, 2, 2))
        respond(code, w, state, p, t, new, D)
        state = new
        out.append(t[0, 0])
    return np.array(out)


def compare_paths() -> None:
    u = 0.1 * np.sin(np.linspace(0, 4 * np.pi, 401)[1:]) * np.linspace(0.2, 1, 400)
    for kind, eta in (("lead", 1.0), ("lead", 2.0), ("pendulum", 1.0)):
        own, other = own_path(kind, u, eta), peer_path(kind, u, eta)
        name = f"lead and rubber, exponent {eta:g}" if kind == "lead" else "pendulum"
        apart = np.abs(own - other).max() / np.abs(other).max()
        print(f"{name}: forces on 400 steps differ by {apart:.1e}")


def peer_motion(steps: int) -> tuple[np.ndarray, float]:
    """Last displacement of a mass on lead and rubber, and processor seconds of the steps."""
    import openseespy.opensees as ops

    peer("lead")
    ops.mass(2, MASS, MASS, 0.0)
    ops.timeSeries("Trig", 1, 0.0, 1e9, 1 / 0.7)
    ops.pattern("Plain", 1, 1)
    ops.load(2, PUSH, 0.0, 0.0)
    analysed("Transient", "Newmark", 0.5, 0.25)
    u, began = [0.0], time.process_time()
    for _ in range(steps):
        if ops.analyze(1, DT):
            raise SystemExit("OpenSees did not converge")
        u.append(ops.nodeDisp(2, 1))
    return np.array(u), time.process_time() - began


def own_motion(steps: int) -> tuple[float, float]:
    """Last displacement, and processor seconds of a script's whole run."""
    from ssilang.cli.run import run_text

    text = (
        "OPTI DIME 2 ELEM SEG2 ; P0 = 0. 0. ; P = 0. 0.1 ; L = DROI 1 P0 P ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'APPUI_PLOMB' 'JOI1' ; "
        f"A = MATE M 'KN' {KN} 'KS' {KS} 'QD' {QD} 'KPOS' {KPOS} ; T = TABL ; "
        "T . 'RIGI' = (RIGI M A) ET (BLOQ P0 'UX' 'UY') ; "
        f"T . 'MASS' = MASS 'DEPL' {MASS} P ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "
        f"LI = PROG 0. 'PAS' {DT} {steps * DT!r} ; V = {PUSH} * (SIN (LI * 252.)) ; "
        "T . 'CHAR' = CHAR 'MECA' (FORC (1. 0.) P) (EVOL 'MANU' LI V) ; "
        "T . 'TEMPS_CALCULES' = LI ; R = DYNAMIC T ; "
        "U = EXTR (R . (DIME R) . 'DEPL') P 'UX' ; "
    )
    with tempfile.TemporaryDirectory() as folder:
        began = time.process_time()
        result = run_text(text, output_directory=Path(folder))
        seconds = time.process_time() - began
    if result.exit_code:
        raise SystemExit(result.output)
    return result.session.root.find("U"), seconds


def compare_motion(steps: int) -> None:
    own_motion(100)  # compiles
    _, fixed = own_motion(100)
    last, seconds = own_motion(steps)
    u, others = peer_motion(steps)
    seconds -= fixed
    print(f"{steps} steps of a mass on lead and rubber, without the script's {fixed:.2f} s:")
    print(
        f"  last displacements differ by {abs(last - u[-1]) / np.abs(u).max():.1e} of the largest"
    )
    print(f"  steps a second: ssilang {steps / seconds:.0f}, OpenSeesPy {steps / others:.0f}")
    print(f"  ratio {others / seconds:.0f}")


if __name__ == "__main__":
    compare_paths()
    compare_motion(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
