"""The rocking frame on 50 gap relations (MINI) instead of joints, in ssilang and in OpenSeesPy.

    pip install '.[bench]'
    OMP_NUM_THREADS=1 python benchmarks/rocking_relations.py [steps]      default 5000

The frame of `rocking_frame.py`. Each node of the footing has a unilateral relation `UY >= 0`, by
penalty with the springs' stiffness, so that OpenSeesPy's no-tension springs are the same problem.
The frame is put down at the start: its weight acts at once, relations touch and do not push yet.
Motions must agree within 1e-6 before a speed is printed; the third speed is the same script in the
loop on sparse matrices, that larger models take.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import rocking_frame as frame

JOINTS = "T1 . 'MODELE' = MOJ ; T1 . 'CARACTERISTIQUES' = MAJ ;"
RELATIONS = (
    "T1 . 'RIGI' = (RIGI MOF MAF) ET (RIGI MOC MAC) ET (BLOQ 'UX' P1) ET (BLOQ 'MINI' 'UY' FOO) ; "
    "T1 . 'CONTACT' = 'PENALITE' ; T1 . 'COEFFICIENT' = {kn} ; T1 . 'VITEUNIL' = FAUX ;"
)


def put_down(steps: int, system: str, scale: float = 1.0) -> None:
    """The peer's frame without its static settlement, its masses about to fall."""
    import openseespy.opensees as ops

    settled(steps, system, scale)
    ops.reset()
    ops.setTime(0.0)
    for node in (*range(1, frame.SPRINGS + 1), 201, 202):
        ops.setNodeAccel(node, 2, -frame.GRAVITY, "-commit")


settled = frame.peer_model


def sparse_seconds(steps: int, folder: Path) -> float:
    """Seconds of the loop on sparse matrices."""
    from ssilang.kernel.stepping import choose

    kept = choose.RULES
    choose.RULES = choose.only("condensed")
    try:
        return frame.ours(steps, steps, folder)[1]
    finally:
        choose.RULES = kept


def main(steps: int = 5000) -> None:
    """Compare the motions, then the speeds."""
    assert JOINTS in frame.SCRIPT
    text = frame.SCRIPT.replace(JOINTS, RELATIONS)
    first, last = text.index("T1 . 'DEPL'"), text.index("T1 . 'TEMPS_CALCULES'")
    frame.SCRIPT, frame.peer_model = text[:first] + text[last:], put_down
    every, system = 10, frame.best_system()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        found, _ = frame.ours(steps, every, folder)
        exact = frame.peer(steps, every, system)
        size = np.abs(exact - exact[:, :1]).max(axis=1)
        gap = float((np.abs(found - exact).max(axis=1) / size).max())
        print(f"roof {size[0]:.3f} m, ends {size[1]:.4f} and {size[2]:.4f} m; difference {gap:.1e}")
        if not gap <= frame.AGREEMENT:
            raise SystemExit(f"the two do not agree within {frame.AGREEMENT:.0e}: no ratio")
        speeds = np.array(
            [
                (frame.ours(steps, steps, folder)[1], frame.peer_seconds(steps, system),
                 sparse_seconds(steps, folder))
                for _ in range(3)
            ]
        )  # fmt: skip
    own, peer, sparse = steps / np.median(speeds, axis=0)
    print(f"ssilang     {own:10,.0f} steps/s; {sparse:,.0f} in the loop on sparse matrices")
    print(f"OpenSeesPy  {peer:10,.0f} steps/s ({system}); ratio {own / peer:.1f}")


if __name__ == "__main__":
    started = time.perf_counter()
    main(*(int(a) for a in sys.argv[1:2]))
    print(f"{time.perf_counter() - started:.0f} s in all")
