"""200 motions on the rocking frame: `ssilang sweep` against OpenSeesPy, both on as many cores.

    OMP_NUM_THREADS=1 python benchmarks/many_motions.py [motions [steps [cores [of the peer]]]]

By default 200 motions of 20 000 steps on all cores. Each motion is the ground acceleration of
`rocking_frame.py` at another scale. Whole runs count: reading, modelling and writing on both sides.
The peer may run some of the motions only, evenly chosen; motions per second are compared, by the
clock and by the processors' time, which other work on the machine changes less. The largest roof
displacements of all motions that both ran must agree within 1e-6 before a ratio is printed.
"""

import io
import os
import resource
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
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


@dataclass
class Spent:
    """Seconds by the clock, and of all processes that ended."""

    clock: float
    processors: float

    @classmethod
    def now(cls) -> "Spent":
        """Seconds until now."""
        used = [resource.getrusage(w) for w in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        return cls(time.perf_counter(), sum(u.ru_utime + u.ru_stime for u in used))

    def since(self, before: "Spent") -> "Spent":
        """Seconds between two moments."""
        return Spent(self.clock - before.clock, self.processors - before.processors)


def our_roofs(count: int, steps: int, folder: Path, cores: int = 0) -> tuple[np.ndarray, Spent]:
    """Largest roof displacements of all motions from a sweep, and what it took."""
    import pyarrow.parquet as pq

    from ssilang.cli.sweeping.sweep import SweepOptions, sweep

    motions = folder / "motions"
    motions.mkdir()
    for i in range(count):
        write_motion(motions / f"m{i:03d}.csv", steps, scale_of(i, count))
    deck = folder / "frame.ssi"
    deck.write_text(script(steps, EVERY, Path("none")))
    started = Spent.now()
    options = SweepOptions(deck, motions=motions, out=folder / "out", jobs=cores)
    if sweep(options, io.StringIO(), sys.stderr):
        raise SystemExit("a run failed")
    spent = Spent.now().since(started)
    rows = pq.read_table(folder / "out" / "sweep.parquet").to_pylist()
    return np.array([row["roof"] for row in rows]), spent


def peer_roofs(scales: list[float], steps: int, cores: int) -> tuple[np.ndarray, Spent, str]:
    """As `our_roofs` of motions of these scales, and the peer's solver."""
    spawn = get_context("spawn")
    with ProcessPoolExecutor(1, spawn) as pool:
        system = pool.submit(best_system).result()
    started = Spent.now()
    with ProcessPoolExecutor(cores, spawn) as pool:
        found = list(pool.map(peer_roof, [(steps, system, scale) for scale in scales]))
    return np.array(found), Spent.now().since(started), system


def main(count: int = 200, steps: int = 20_000, cores: int = 0, of_peer: int = 0) -> None:
    """Compare the answers, then the times."""
    cores = cores or os.cpu_count() or 1
    chosen = np.unique(np.linspace(0, count - 1, of_peer or count).round().astype(int))
    with tempfile.TemporaryDirectory() as name:
        found, mine = our_roofs(count, steps, Path(name), cores)
    exact, theirs, system = peer_roofs([scale_of(i, count) for i in chosen], steps, cores)
    gap = float(np.abs(found[chosen] / exact - 1).max())
    print(f"motions of {steps} steps on {cores} cores; largest difference {gap:.1e}")
    if not gap <= AGREEMENT:
        raise SystemExit(f"the two do not agree within {AGREEMENT:.0e}: no ratio")
    rows = (("ssilang sweep", mine, count), (f"OpenSees {system}", theirs, len(chosen)))
    for label, spent, n in rows:
        print(
            f"{label:20s} {n:4d} motions: {spent.clock:7.1f} s by the clock, "
            f"{spent.processors / n:.3f} s of a core each"
        )
    clock = (theirs.clock / len(chosen)) / (mine.clock / count)
    cpu = (theirs.processors / len(chosen)) / (mine.processors / count)
    print(f"ratio {clock:.1f} by the clock, {cpu:.1f} by the time of a core")


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:5]))
