"""Time and memory against size: a block on soil with a no-tension interface, plane and solid.

    OMP_NUM_THREADS=1 python benchmarks/growth.py [picture]
                                                default benchmarks/pictures/growth.png

The models of `uplift_openseespy.py` (2 000 to 116 000 unknowns) and `block_3d_openseespy.py`
(5 000 to 93 000), each in a process of its own: seconds of assembly, of what is done once
(factorisation and the interface's compliance), of a step (the median of the chunks after the
first), and the process's largest resident size. Seconds are those of the one core that it uses.
Prints a table with the exponents of growth between neighbours and draws all of it. Without a
picture's name the one of this folder is replaced.
"""

import json
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

PLANE = (2000, 7500, 30000, 116000)  # unknowns asked for
SOLID = (10, 15, 20, 25, 30)  # cells along a side of the soil
SMALL = {"plane": 500, "solid": 12}
STEPS = 160
COLUMNS = {"assembly": "assembly, s", "once": "once, s", "step": "step, ms", "memory": "peak, MB"}
PICTURE = Path(__file__).parent / "pictures" / "growth.png"


def case_of(kind: str, size: int) -> Any:
    """The module of a kind of model, and its model of a size."""
    if kind == "plane":
        import uplift_openseespy as plane

        return plane, plane.make_case(size, STEPS)
    import block_3d_openseespy as solid

    return solid, solid.make_case(size, STEPS)


def measure(kind: str, size: int) -> dict[str, float]:
    """One row of the table."""
    from block_3d_openseespy import peak_memory

    from ssilang.kernel.stepping.problem.problem import make_problem
    from ssilang.kernel.stepping.run import integrate

    warm, small = case_of(kind, SMALL[kind])
    integrate(make_problem(warm.inputs_of(small)[0]))  # compiles
    module, case = case_of(kind, size)
    started = time.process_time()
    problem = make_problem(module.inputs_of(case)[0])
    assembly = time.process_time() - started
    marks = [(0, time.process_time())]  # steps done, when
    integrate(problem, progress=lambda done, _: marks.append((done, time.process_time())))
    steps, seconds = np.diff(np.array(marks), axis=0).T
    step = float(np.median(seconds[1:] / steps[1:]))
    return {
        "unknowns": problem.numbering.size, "assembly": assembly,
        "once": float(seconds[0] - step * steps[0]), "step": 1e3 * step,
        "memory": peak_memory(),
    }  # fmt: skip


def rows_of(kind: str, sizes: Sequence[int]) -> list[dict[str, float]]:
    """Rows of all sizes, each measured in a process of its own."""
    rows: list[dict[str, float]] = []
    for size in (SMALL[kind], *sizes):  # the small one compiles, which takes memory
        command = [sys.executable, __file__, "--one", kind, str(size)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        if size == SMALL[kind]:
            continue
        rows.append(json.loads(done.stdout.splitlines()[-1]))
        print(line_of(kind, rows), flush=True)
    return rows


def line_of(kind: str, rows: list[dict[str, float]]) -> str:
    """The last row of a table, with the exponent of growth since the one before."""
    cells = [kind, f"{rows[-1]['unknowns']:,.0f}".replace(",", " ")]
    for name in COLUMNS:
        cell = f"{rows[-1][name]:.3g}" if rows[-1][name] < 1000 else f"{rows[-1][name]:.0f}"
        if len(rows) > 1:
            a, b = (np.log([r["unknowns"], r[name]]) for r in rows[-2:])
            cell += f" (n^{(b[1] - a[1]) / (b[0] - a[0]):.1f})"
        cells.append(cell)
    return "| " + " | ".join(cells) + " |"


def draw(tables: dict[str, list[dict[str, float]]], path: Path) -> None:
    """One panel a column, both kinds of model in each."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, panels = plt.subplots(1, len(COLUMNS), figsize=(11, 2.8), layout="constrained")
    for panel, (name, title) in zip(panels, COLUMNS.items(), strict=True):
        for kind, rows in tables.items():
            x = [r["unknowns"] for r in rows]
            panel.loglog(x, [r[name] for r in rows], "o-", label=kind, markersize=3)
        panel.set_title(title, fontsize=9)
        panel.set_xlabel("unknowns", fontsize=8)
        panel.tick_params(labelsize=7)
        panel.grid(alpha=0.3)
    panels[0].legend(fontsize=8)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=80)


def main() -> None:
    """The table and the picture, or one of its rows."""
    if sys.argv[1:2] == ["--one"]:
        print(json.dumps(measure(sys.argv[2], int(sys.argv[3]))))
        return
    print("| model | unknowns | " + " | ".join(COLUMNS.values()) + " |")
    print("| --- " * (2 + len(COLUMNS)) + "|")
    tables = {"plane": rows_of("plane", PLANE), "solid": rows_of("solid", SOLID)}
    draw(tables, Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURE)


if __name__ == "__main__":
    main()
