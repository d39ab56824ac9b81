"""Cold start: time of a three-line script by the clock and of the processor, imports and all.

    python benchmarks/cold_start.py [runs]

Each run is a process of its own. The first writes the bytecode, as an installation does, fills the
file caches and is not counted.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

SCRIPT = "OPTI DIME 2 ELEM SEG2 ;\nX1 = 1. + 2. ;\nMESS X1 ;\n"


def seconds(command: list[str]) -> tuple[float, float]:
    """Seconds by the clock and of the processor that a command takes; it must succeed."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=True, capture_output=True, env=environment)
    clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(runs: int = 10) -> None:
    """Print the median and the spread."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "three_lines.ssi"
        script.write_text(SCRIPT)
        ours = [sys.executable, "-m", "ssilang.cli.main", str(script), "--out", folder]
        bare, numpy = ([sys.executable, "-c", code] for code in ("pass", "import numpy"))
        for name, command in (
            ("bare Python", bare),
            ("Python with numpy", numpy),
            ("ssilang, three lines", ours),
        ):
            seconds(command)
            clock, used = (
                sorted(t) for t in zip(*(seconds(command) for _ in range(runs)), strict=True)
            )
            print(
                f"{name:24s} {median(clock):6.3f} s wall (median of {runs}; "
                f"{clock[0]:.3f} to {clock[-1]:.3f}), {median(used):.3f} s of the processor "
                f"({used[0]:.3f} to {used[-1]:.3f})"
            )


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]))
