"""Steel and concrete of fibres against OpenSeesPy's Steel02 and Concrete02: paths, a section.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas: apt install libblas3)
    OMP_NUM_THREADS=1 python benchmarks/uniaxial.py [turns of the section]

Paths first, one fibre in both programs. ACIER_UNI without hardening, with A1FA = 0 and STSU = STSY,
is Steel02 without hardening; BETON_UNI is Concrete02 where strains go one way only. What differs
beyond is printed: the first loading of steel (a plateau and a curve of fourth order against a curve
along b), xi (from the reversal before, over the elastic range, against the largest strain over the
yield strain), the unloading of concrete (one slope and a stiff closing against two slopes).

Then a section of 400 fibres of steel and concrete, the same places and areas in both, under a
normal force and a curvature that goes to and fro: moments, and processor time for each step.
"""

import sys
import time
from collections.abc import Callable

import numpy as np

STEEL = {
    "YOUN": 2e11, "NU": 0.3, "STSY": 4e8, "STSU": 4e8, "EPSH": 0.02, "EPSU": 0.2, "ROFA": 20.0,
    "BFAC": 0.0, "A1FA": 0.0, "A2FA": 0.15,
}  # fmt: skip
CONCRETE = {
    "YOUN": 3e10, "NU": 0.2, "STFC": 3e7, "EZER": 0.002, "STFT": 3e6, "ZETA": 100.0, "ST85": 6e6,
    "TRAF": 11.0,
}  # fmt: skip
REST = {"FALD": 0.0, "A6FA": 0.0, "CFAC": 0.0, "AFAC": 0.0, "ALF1": 0.0, "OME1": 0.0, "FAMX": -1.0}


def peer_steel(given: dict[str, float]) -> None:
    import openseespy.opensees as ops

    curve = (given["A1FA"] / given["ROFA"], given["A2FA"])
    ops.uniaxialMaterial(
        "Steel02", 1, given["STSY"], given["YOUN"], given["BFAC"], given["ROFA"], *curve,
        0.0, 1.0, 0.0, 1.0,
    )  # fmt: skip


def peer_concrete(given: dict[str, float], tag: int = 1) -> None:
    import openseespy.opensees as ops

    end = given["EZER"] + (1 - given["ST85"] / given["STFC"]) / given["ZETA"]
    ops.uniaxialMaterial(
        "Concrete02", tag, -given["STFC"], -given["EZER"], -given["ST85"], -end, 0.1,
        given["STFT"], given["YOUN"] / (given["TRAF"] - 1),
    )  # fmt: skip


def peer_path(
    material: Callable[[dict[str, float]], None], given: dict[str, float], path: np.ndarray
) -> np.ndarray:
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    material(given)
    ops.testUniaxialMaterial(1)
    out = []
    for strain in path:
        ops.setStrain(float(strain))
        out.append(ops.getStress())
    return np.array(out)


def own_path(name: str, given: dict[str, float], path: np.ndarray) -> np.ndarray:
    from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS
    from ssilang.kernel.materials.plastic.response import PointParameters

    law = PLASTIC_LAWS[name]
    p = PointParameters({n: np.array([v]) for n, v in {**REST, **given}.items()}, {})
    stress, variables, last, out = np.zeros((1, 6)), np.zeros((1, len(law.variables))), 0.0, []
    for strain in path:
        step = np.zeros((1, 6))
        step[0, 0] = strain - last
        found = law.respond(p, stress, step, variables)
        stress, variables, last = found.stress, found.variables, strain
        out.append(stress[0, 0])
    return np.array(out)


def through(*corners: float, n: int = 200) -> np.ndarray:
    """A path of strain from 0 through these corners."""
    turns = zip((0.0, *corners[:-1]), corners, strict=True)
    return np.concatenate([np.linspace(a, b, n + 1)[1:] for a, b in turns])


def compare_paths() -> None:
    cycles = through(0.02, -0.02, 0.02, -0.03, 0.03)
    own, peer = own_path("ACIER_UNI", STEEL, cycles), peer_path(peer_steel, STEEL, cycles)
    _said("steel without hardening, first loading (a corner, a curve)", own[:200], peer[:200])
    _said("steel without hardening, from the first reversal on", own[200:], peer[200:])
    hard = {**STEEL, "BFAC": 0.01, "A1FA": 18.5, "STSU": 6e8, "EPSU": 0.1}
    own, peer = own_path("ACIER_UNI", hard, cycles), peer_path(peer_steel, hard, cycles)
    _said("steel of the usual constants (first loading, xi differ)", own, peer)
    for name, path in (
        ("concrete, compression one way", through(-0.02)),
        ("concrete, tension one way", through(0.002)),
        ("concrete, to and fro (unloading differs)", through(-0.003, 0.0, -0.006, 0.002)),
    ):
        own = own_path("BETON_UNI", CONCRETE, path)
        _said(name, own, peer_path(peer_concrete, CONCRETE, path))


def _said(name: str, own: np.ndarray, peer: np.ndarray) -> None:
    print(f"{name}: largest difference {np.abs(own - peer).max() / np.abs(peer).max():.1e}")


def section() -> object:
    """400 points of concrete and eight of steel, as MOCU gets them."""
    from ssilang.cli.run import run_text
    from ssilang.kernel.elements.beams.fibre_section import fibre_section

    words = {n: " ".join(f"'{k}' {v!r}" for k, v in d.items())
             for n, d in (("s", STEEL), ("c", CONCRETE))}  # fmt: skip
    bars = " ET ".join(f"(MANU POI1 ({y} {z} 0.))" for y in (-0.15, 0.15)
                       for z in (-0.15, -0.05, 0.05, 0.15))  # fmt: skip
    text = (
        "OPTI DIME 3 ELEM QUA4 ; S = (DROI 10 (-0.2 -0.2 0.) (0.2 -0.2 0.)) TRAN 10 (0. 0.4 0.) ; "
        f"P = {bars} ; MC = MODE S MECANIQUE ELASTIQUE PLASTIQUE BETON_UNI QUAS ; "
        "MS = MODE P MECANIQUE ELASTIQUE PLASTIQUE ACIER_UNI POJS ; "
        f"A = (MATE MC {words['c']} 'ALPY' 0.8 'ALPZ' 0.8) ET "
        f"(MATE MS {words['s']} 'SECT' 5.E-4 'ALPY' 0. 'ALPZ' 0.) ; M = MC ET MS ;"
    )
    root = run_text(text).session.root
    return fibre_section(root.find("M"), root.find("A"))


def peer_section(made: object, curvatures: np.ndarray, force: float) -> tuple[np.ndarray, float]:
    """Moments about z of the same fibres, and processor seconds of the steps."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    peer_steel(STEEL)
    peer_concrete(CONCRETE, 2)
    ops.section("Fiber", 1)
    steel = np.zeros(len(made.areas), bool)
    for part in made.zones:
        steel[part.rows] = part.zone.element == "POJS"
    for (y, _), area, bar in zip(made.places, made.areas, steel, strict=True):
        ops.fiber(float(y), 0.0, float(area), 1 if bar else 2)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 1, 0)
    ops.element("zeroLengthSection", 1, 1, 2, 1)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, force, 0.0, 0.0)
    ops.timeSeries("Path", 2, "-dt", 1.0, "-values", 0.0, *map(float, curvatures), 0.0)
    ops.pattern("Plain", 2, 2)
    ops.sp(2, 3, 1.0)
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-6 * abs(force), 50)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    moments, began = [], time.process_time()
    for step in range(len(curvatures)):
        if ops.analyze(1):
            raise SystemExit(f"OpenSees did not converge at step {step}")
        ops.reactions()
        moments.append(-ops.nodeReaction(1, 3))
    return np.array(moments), time.process_time() - began


def compare_section(turns: int) -> None:
    from ssilang.kernel.plasticity.moment_curvature import bend

    made = section()
    top = 0.02
    curvatures = np.concatenate([[0.0], through(top, n=100)])
    for _ in range(turns):
        curvatures = np.concatenate([curvatures, top * np.cos(np.pi * np.arange(1, 401) / 200)])
    force = -1e6
    bend(made, np.zeros((1, 2)), np.full(1, force), 1e-8)
    both = np.stack([np.zeros_like(curvatures), curvatures], axis=1)
    began = time.process_time()
    own = bend(made, both, np.full(len(both), force), 1e-6).moments[:, 1]
    seconds = time.process_time() - began
    peer, others = peer_section(made, curvatures, force)
    scale = np.abs(peer).max()
    first = slice(0, 101)
    print(f"section of {len(made.areas)} fibres, {len(both)} steps")
    print(f"  moments, first bending: difference {np.abs(own - peer)[first].max() / scale:.1e}")
    print(f"  moments, to and fro:    difference {np.abs(own - peer).max() / scale:.1e}")
    print(f"  processor time a step: ssilang {1e6 * seconds / len(both):.0f}, "
          f"OpenSeesPy {1e6 * others / len(both):.0f} microseconds")  # fmt: skip
    print(f"  ratio {others / seconds:.2f}")


if __name__ == "__main__":
    compare_paths()
    compare_section(int(sys.argv[1]) if len(sys.argv) > 1 else 2)
