"""Pictures of docs/matter.md: a sweep of cases/footing/when_it_matters.ssi.

    python docs/matter.py [processes]

Over h/(Vs T) at three slendernesses and three mass ratios, tied and with uplift; pictures go to
docs/pictures, the table is printed.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

import ssilang

HERE = Path(__file__).resolve().parent
DECK = HERE.parent / "cases" / "footing" / "when_it_matters.ssi"
SOFTNESS = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4]
SLENDER, HEAVY = [1.0, 2.0, 4.0], [0.05, 0.15, 0.3]
COLOURS = ["#2060c0", "#c02020", "#207020"]


def swept(jobs: int, **values: object) -> pd.DataFrame:
    """Rows of a sweep; a run that failed ends it."""
    table = ssilang.sweep(DECK, jobs=jobs, **values)
    if table["exit_code"].any():
        raise SystemExit(table[table["exit_code"] != 0].to_string())
    return table


def drawn(tables: dict[str, pd.DataFrame], column: str, label: str, name: str) -> None:
    """One picture: computed points, and Veletsos' line where the column is the period."""
    figure, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    for colour, (title, rows) in zip(COLOURS, tables.items(), strict=False):
        x = rows["SOFT"].astype(float)
        style = "o" if column == "period" else "o-"
        axes.plot(x, rows[column], style, color=colour, label=title, markersize=4)
        if column == "period":
            axes.plot(x, rows["veletsos"], "-", color=colour, linewidth=1)
    axes.set_xlabel("h / (Vs T): from rock to soft soil")
    axes.set_ylabel(label)
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(HERE / "pictures" / f"{name}.png", dpi=100)


def main(jobs: int) -> None:
    """Sweep, draw, print."""
    (HERE / "pictures").mkdir(exist_ok=True)
    slender = swept(jobs, HR=SLENDER, SOFT=SOFTNESS)
    heavy = swept(jobs, GAM=HEAVY, SOFT=SOFTNESS)
    by_slenderness = {f"h/r = {x:g}": slender[slender["HR"].astype(float) == x] for x in SLENDER}
    by_mass = {f"m/(rho pi r2 h) = {x:g}": heavy[heavy["GAM"].astype(float) == x] for x in HEAVY}
    for rows in by_slenderness.values():
        rows.insert(0, "force", rows["force_lifted"] / rows["force_tied"])
    drawn(by_slenderness, "period", "period over that on rock", "matter_period")
    drawn(by_mass, "period", "period over that on rock", "matter_mass")
    drawn(by_slenderness, "damping", "damping ratio (5 % on rock)", "matter_damping")
    drawn(by_slenderness, "force", "force with uplift over tied", "matter_force")
    columns = ["SOFT", "HR", "GAM", "period", "veletsos", "damping", "force_tied", "force_lifted"]
    for table in (slender, heavy):
        for column in ("HR", "GAM"):
            if column not in table:
                table[column] = ""
        print(table[[*columns, "rotation"]].to_string(index=False))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 0)
