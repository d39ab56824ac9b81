"""Steps per second of the CLUB CAST3M oscillator with an SDM joint (one unknown that moves).

python benchmarks/club_b.py [steps]
"""

import sys
import tempfile
from pathlib import Path

from oscillator import steps_per_second


def main(steps: int = 1_000_000) -> None:
    """Print the loop's speed and the fixed part of the run."""
    with tempfile.TemporaryDirectory() as folder:
        speed, fixed = steps_per_second(steps, 2.5e-4, Path(folder))
    print(f"club-b: {speed:,.0f} steps/s over {steps:,} steps; script without them {fixed:.3f} s")


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]))
