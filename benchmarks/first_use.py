"""First use: what compiling costs a machine that has no compiled code yet.

    OMP_NUM_THREADS=1 python benchmarks/first_use.py [case|deck ...]

Cases: `oscillator` (the deck club_b_sdm), `frame` (rocking_frame.py), `block` (1 964 unknowns of
uplift_openseespy.py); a deck is a file (`cases/*/*.ssi`). Each runs twice, each time in a process
of its own, with a folder for compiled code that is empty the first time. The difference is printed,
in seconds of a clock and of a processor: on a busy machine the first says little. Of decks with
PASAPAS or DYNAMIC it is also printed when the first step of each in the first run was done.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
RUN = "import first_use; first_use.run({!r})"
KINDS = ("first load step", "first step in time")  # files with the time at which each was done
CASES = {
    "oscillator": RUN.format(str(HERE.parent / "cases" / "club_cast3m_2014" / "club_b_sdm.ssi")),
    "frame": "import pathlib, rocking_frame as r; r.ours(2000, 2000, pathlib.Path('.'))",
    "block": "import uplift_openseespy as u; u.run_ssilang(u.make_case(2000, 50))",
}


def run(deck: str) -> None:
    """A deck from the command line; its first chunk of steps in time is one step."""
    from ssilang.cli.main import main as command
    from ssilang.kernel.plasticity.run import BulkRun
    from ssilang.kernel.statics import stepping
    from ssilang.kernel.stepping.run import Integration

    hand_over, within, save = stepping.hand_over, Integration._within_memory, BulkRun.save

    def tell(kind: str) -> None:
        if not Path(kind).exists():
            Path(kind).write_text(str(time.time()), encoding="ascii")

    def handed_over(observers: Any, step: int, made: Any) -> None:
        hand_over(observers, step, made)
        if step > 0:
            tell(KINDS[0])

    def saved(bodies: BulkRun, step: int) -> None:
        save(bodies, step)
        if step > 0:
            tell(KINDS[1] if bodies.problem.M.nnz else KINDS[0])

    def one_first(integration: Integration, first: int, last: int) -> int:
        if first == 0:
            return 1
        tell(KINDS[1])
        return within(integration, first, last)

    stepping.hand_over = handed_over
    BulkRun.save = saved  # type: ignore[method-assign]
    Integration._within_memory = one_first  # type: ignore[method-assign]
    sys.exit(command([deck, "--out", "."]))


def times(program: str, folder: str) -> tuple[float, float]:
    """Seconds by the clock and of a processor that a Python program takes; it must succeed."""
    paths = os.pathsep.join([str(HERE), str(HERE.parent), os.environ.get("PYTHONPATH", "")])
    given = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    given |= {"XDG_CACHE_HOME": folder, "PYTHONPATH": paths}
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(
        [sys.executable, "-c", program], check=True, capture_output=True, env=given, cwd=folder
    )
    after, clock = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - start
    return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(names: list[str]) -> None:
    """Print one line a case."""
    for name in names or list(CASES):
        program = CASES.get(name) or RUN.format(str(Path(name).resolve()))
        with tempfile.TemporaryDirectory() as folder:
            begun = time.time()
            first, step = times(program, folder), ""
            for told in (Path(folder, kind) for kind in KINDS):
                if told.exists():
                    done = float(told.read_text("ascii")) - begun
                    step += f" ({told.name} {done:.1f} s)"
            second = times(program, folder)
            n = sum(1 for _ in Path(folder).rglob("*.code"))
        print(
            f"{Path(name).stem:12s} {n:4d} functions kept; first run {first[0]:6.1f} s{step} "
            f"({first[1]:.1f} of a processor), next {second[0]:.1f} s ({second[1]:.1f}), "
            f"compiling {first[0] - second[0]:.1f} s ({first[1] - second[1]:.1f}), "
            f"load {os.getloadavg()[0]:.0f}",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1:])
