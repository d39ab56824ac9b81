"""Cold start: wall time of a three-line script, imports and all.

    python benchmarks/cold_start.py [runs]

Each run is a process of its own. The first writes the bytecode, as an installation does, fills the
file caches and is not counted.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

SCRIPT = "OPTI DIME 2 ELEM SEG2 ;\nX1 = 1. + 2. ;\nMESS X1 ;\n"


def wall_time(command: list[str]) -> float:
    """Seconds that a command takes; it must succeed."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    start = time.perf_counter()
    subprocess.run(command, check=True, capture_output=True, env=environment)
    return time.perf_counter() - start


def main(runs: int = 10) -> None:
    """Print the median and the spread."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "three_lines.ssi"
        script.write_text(SCRIPT)
        ours = [sys.executable, "-m", "ssilang.cli.main", str(script), "--out", folder]
        bare = [sys.executable, "-c", "pass"]
        for name, command in (("bare Python", bare), ("ssilang, three lines", ours)):
            wall_time(command)
            times = sorted(wall_time(command) for _ in range(runs))
            print(
                f"{name:24s} {median(times):6.3f} s wall (median of {runs}; "
                f"{times[0]:.3f} to {times[-1]:.3f})"
            )


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]))
