"""The table of a sweep, as its folder has it."""

import csv
import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product, takewhile
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np

from ssilang.io.atomic import inside
from ssilang.io.errors import InputError
from ssilang.kernel.base.arrays import FloatArray
from ssilang.report.html import text
from ssilang.report.records import MOST_BYTES, read_json, read_record

TABLE, RUNS, KEPT = "sweep.csv", "runs", "row.json"
"""In a sweep's folder, and in that of a run: written last, a run that has it is done."""
MOTION = "MOTION"
"""Name under which a deck finds the path of its ground motion."""
RESERVED = ("run", "exit_code", "seconds", "error", "warnings", "folder")
"""Titles of what a run is; the others are of what was given and of figures."""
MOTIONS = "motions of the calculations"
INTENSITIES = ("PGA", "SA", "PGV", "PGD", "CAV", "ARIAS")
"""Figures taken as intensities if none is named; SA1 or SA(T1) is one of SA."""
_KIND = re.compile(r"[A-Za-z]+")


@dataclass(frozen=True)
class Sweep:
    """A folder of a sweep: rows of its table by title, as they are written."""

    folder: Path
    rows: list[dict[str, str]]
    swept: list[str]  # titles of what was given and of what runs reported
    figures: list[str]


def is_sweep(folder: Path) -> bool:
    """Whether a folder has the table and the runs of a sweep."""
    return inside(folder, TABLE) is not None and (folder / RUNS).is_dir()


def read_sweep(folder: Path) -> Sweep:
    """Read the table of a sweep.

    Raises
    ------
    InputError
        If it is damaged.
    """
    path = folder / TABLE
    try:
        if path.stat().st_size > MOST_BYTES:
            raise ValueError(f"more than {MOST_BYTES // 10**6} MB")
        with path.open(encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file, delimiter=";")
            rows = [{k: v or "" for k, v in row.items() if k} for row in reader]
            titles = list(reader.fieldnames or [])
    except (OSError, ValueError, csv.Error) as problem:
        raise InputError("report.damaged", path=path, problem=problem) from None
    if not {*RESERVED} - {"warnings"} <= set(titles) or not rows:
        raise InputError("report.not-a-sweep", path=path)
    swept = list(takewhile(lambda t: t != "exit_code", titles[1:]))
    return Sweep(folder, rows, swept, [t for t in titles if t not in (*RESERVED, *swept)])


def edited(sweep: Sweep) -> list[str]:
    """Numbers of the rows whose figures are not those that their runs have kept."""
    found, own = [], [*sweep.swept, *sweep.figures]
    for row in sweep.rows:
        path = inside(sweep.folder / RUNS, f"{row['folder']}/{KEPT}") if row["folder"] else None
        try:
            kept = read_json(path)["row"] if path else row
            same = all(real(row[n]) == real(str(kept.get(n))) for n in own)
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            same = False
        found += [] if same else [row["run"]]
    return found


@dataclass(frozen=True)
class Warned:
    """What runs were warned of: the sentence of the first, its number and folder, how many were."""

    text: str
    run: str
    folder: str
    count: int


def summary_of(folder: Path, run: object) -> dict[str, Any]:
    """The summary of a run by its folder's name; empty if there is none, or a damaged one."""
    path = inside(folder / RUNS, f"{run}/summary.json")
    try:
        return read_record(path, "summary") if path else {}
    except (OSError, ValueError):
        return {}


def warnings_of(folder: Path, rows: Sequence[Mapping[str, Any]]) -> list[Warned]:
    """What the runs of a sweep were warned of, each code once."""
    codes = [(code, row) for row in rows for code in str(row.get("warnings", "")).split()]
    count, found = Counter(code for code, _ in codes), []
    for code, row in dict(reversed(codes)).items():
        given = summary_of(folder, row["folder"]).get("warnings", ())
        text = next((str(w["text"]).replace("\n", "\\n") for w in given if w["code"] == code), code)
        found.append(Warned(text, str(row["run"]), str(row["folder"]), count[code]))
    return found[::-1]


def is_still(
    rows: Sequence[Mapping[str, Any]], swept: Sequence[str], name: str, figures: Sequence[str]
) -> bool:
    """Whether figures are the same whatever a swept value, the others as they are."""
    others = [n for n in swept if n != name]
    keys = others, [*others, *figures]
    few, more = ({repr([_rounded(r.get(n)) for n in k]) for r in rows} for k in keys)
    return len(more) == len(few) < len(rows)


def _rounded(value: Any) -> Any:
    """A number to nine digits: another mesh sums in another order."""
    number = real(value) if isinstance(value, str) else value
    return float(f"{number:.9g}") if isinstance(number, float) else value


def usual_intensities(figures: Sequence[str]) -> list[str]:
    """Figures that are taken as intensities if none is named."""
    return [n for n in figures if (kind := _KIND.match(n)) and kind[0].upper() in INTENSITIES]


def chooses_records(
    rows: Sequence[Mapping[str, Any]], swept: Sequence[str], name: str, intensities: Sequence[str]
) -> bool:
    """Whether a swept value chooses records of one peak: an intensity stays, others do not.

    Where one changes in proportion to the value, that is a scale.
    """
    moved = [n for n in intensities if not is_still(rows, swept, name, [n])]
    if not all(real(str(r[name])) for r in rows) or len(moved) in (0, len(intensities)):
        return 0 < len(moved) < len(intensities)
    made = [{**r, **{n: float(r[n] or 0) / float(r[name]) for n in moved}} for r in rows]
    return not any(is_still(made, swept, name, [n]) for n in moved)


def unscaled(
    folder: Path,
    rows: Sequence[Mapping[str, Any]],
    swept: Sequence[str],
    figures: Sequence[str],
    intensities: Sequence[str],
) -> Iterator[tuple[str, dict[str, object]]]:
    """Intensities that a swept value alone leaves as they are, or alone scales.

    Codes with their data: motions and other figures change with it where the one does not, or
    neither do; not of what chooses records.
    """
    asked, others = list[tuple[bool, str, str]](), [n for n in figures if n not in intensities]
    for figure, name in product(intensities, [n for n in swept if n != MOTION]):
        still = is_still(rows, swept, name, [figure])
        idle = is_still(rows, swept, name, figures if still else others)
        chosen = still and chooses_records(rows, swept, name, intensities)
        asked += [(still, figure, name)] * (still != idle and not chosen and bool(still or others))
    made = []
    for row in rows if asked else ():
        told = summary_of(folder, row["folder"]).get("statistics", {}).get("calculations", [])
        made.append({**row, MOTIONS: [c.get("motions") for c in told]})
    known = any(any(row[MOTIONS]) for row in made)
    for still, figure, name in asked:
        shaken = not is_still(made, swept, name, [MOTIONS]) if known else still
        if shaken == still:
            code = "report.fragility-still" if still else "report.fragility-alone"
            yield code, {"name": figure, "swept": name}


def link_to(folder: Path, run: str) -> str:
    """Where a run's page stands, seen from the sweep's folder; '' if it has none."""
    for name in ("report.html", "output.txt"):
        if run and inside(folder / RUNS, f"{run}/{name}") is not None:
            return text(f"{RUNS}/{quote(run)}/{name}")
    return ""


def grouped(
    rows: Sequence[Mapping[str, Any]], axis: str, figure: str, others: Sequence[str]
) -> dict[str, FloatArray]:
    """Numbers (2, n) of a figure over a name, in its order, by the values of other names."""
    groups: dict[str, list[tuple[float, float]]] = {}
    for row in rows:
        x, y = (real(str(row.get(name))) for name in (axis, figure))
        if x is not None and y is not None:
            said = [Path(row[n]).stem if n == MOTION else f"{n} = {row[n]}" for n in others]
            groups.setdefault(", ".join(said), []).append((x, y))
    return {name: np.array(sorted(points)).T for name, points in groups.items()}


def short(value: str) -> str:
    """A motion's path by its name, other values as they are."""
    return Path(value).name if "/" in value or "\\" in value else value


def real(value: str) -> float | None:
    try:
        found = float(value)
    except ValueError:
        return None
    return found if math.isfinite(found) else None
