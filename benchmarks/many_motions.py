"""200 motions on the rocking frame: `ssilang sweep` against OpenSeesPy, both on as many cores.

    OMP_NUM_THREADS=1 python benchmarks/many_motions.py [motions [steps [cores]]]

By default 200 motions of 20 000 steps on all cores.

Each motion is the ground acceleration of `rocking_frame.py` at another scale. Wall times of whole
runs: reading, modelling and writing included on both sides. The largest roof displacements of all
motions must agree within 1e-6 before a ratio is printed.
"""

from __future__ import annotations

import io
import os
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from rocking_frame import AGREEMENT, DT, best_system, peer_model, script, write_motion

EVERY = 10


def scale_of(number: int, count: int) -> float:
    """Scale of a motion, 0.5 to 1.2."""
    return 0.5 + 0.7 * number / max(count - 1, 1)


def peer_roof(task: tuple[int, str, float]) -> float:
    """Largest roof displacement of one motion in OpenSeesPy."""
    import openseespy.opensees as ops

    steps, system, scale = task
    peer_model(steps, system, scale)
    top = abs(ops.nodeDisp(201, 1))
    for _ in range(steps // EVERY):
        if ops.analyze(EVERY, DT):
            return float("nan")
        top = max(top, abs(ops.nodeDisp(201, 1)))
    return top


def our_roofs(count: int, steps: int, folder: Path, cores: int = 0) -> tuple[np.ndarray, float]:
    """Largest roof displacements of all motions from a sweep, and its seconds."""
    import pyarrow.parquet as pq

    from ssilang.cli.sweeping.sweep import SweepOptions, sweep

    motions = folder / "motions"
    motions.mkdir()
    for i in range(count):
        write_motion(motions / f"m{i:03d}.csv", steps, scale_of(i, count))
    deck = folder / "frame.ssi"
    deck.write_text(script(steps, EVERY, Path("none")))
    started = time.perf_counter()
    options = SweepOptions(deck, motions=motions, out=folder / "out", jobs=cores)
    if sweep(options, io.StringIO(), sys.stderr):
        raise SystemExit("a run failed")
    seconds = time.perf_counter() - started
    rows = pq.read_table(folder / "out" / "sweep.parquet").to_pylist()
    return np.array([row["roof"] for row in rows]), seconds


def main(count: int = 200, steps: int = 20_000, cores: int = 0) -> None:
    """Compare the answers, then the times."""
    cores = cores or os.cpu_count() or 1
    with tempfile.TemporaryDirectory() as name:
        found, mine = our_roofs(count, steps, Path(name), cores)
    with ProcessPoolExecutor(cores, mp_context=get_context("spawn")) as pool:
        system = pool.submit(best_system).result()
        tasks = [(steps, system, scale_of(i, count)) for i in range(count)]
        started = time.perf_counter()
        exact = np.array(list(pool.map(peer_roof, tasks)))
        theirs = time.perf_counter() - started
    gap = float(np.abs(found / exact - 1).max())
    print(f"{count} motions of {steps} steps on {cores} cores; largest difference {gap:.1e}")
    if not gap <= AGREEMENT:
        raise SystemExit(f"the two do not agree within {AGREEMENT:.0e}: no ratio")
    print(f"ssilang sweep {mine:8.1f} s, {count / mine:.1f} motions/s")
    print(f"OpenSeesPy    {theirs:8.1f} s, {count / theirs:.1f} motions/s ({system})")
    print(f"ratio         {theirs / mine:8.1f}")


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:4]))
