"""Steps per second and memory of the block on soil (plane strain, joint with the SDM law).

    python benchmarks/block_on_soil.py

Runs the deck `cases/footing/block_on_soil.ssi` in a process of its own and reads the figures of
its summary: unknowns, steps, the loop's speed for each of its three calculations, peak memory.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

DECK = Path(__file__).parents[1] / "cases" / "footing" / "block_on_soil.ssi"


def main() -> None:
    """Run the deck twice (the first compiles) and print the second's figures."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "ssilang.cli.main", str(DECK), "--out", folder]
        for _ in range(2):
            subprocess.run(command, check=True, capture_output=True)
        summary = json.loads((Path(folder) / "summary.json").read_text())
    for line in summary["statistics"]["calculations"]:
        print(
            f"{line['unknowns']} unknowns, {line['interface_unknowns']} of the interface: "
            f"{line['steps']} steps in {line['seconds']:.2f} s, "
            f"{line['steps_per_second']:,.0f} steps/s"
        )
    print(f"whole deck {summary['seconds']:.1f} s, peak memory {summary['peak_memory_mb']:.0f} MB")


if __name__ == "__main__":
    main()
