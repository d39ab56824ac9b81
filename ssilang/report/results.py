"""What a folder of results holds, read for its report: the one reader, whoever asks.

A run with `--report` leaves a record beside what every run leaves (`io/recording.py`); without it
the report has the summary, the deck if it is still there, the deck's own series, tables, pictures.
"""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.errors import InputError, OutputError
from ssilang.io.recording import CONTENTS, FOLDER
from ssilang.kernel.base.arrays import FloatArray
from ssilang.language.text.source import Source

SUMMARY = "summary.json"
SERIES = (".vtkhdf", ".pvd")
MOST_BYTES = 50_000_000
"""Of a table; a larger one is named, not shown."""


@dataclass(frozen=True)
class Calculation:
    """A calculation in time that a run has taken down."""

    name: str
    columns: dict[str, FloatArray]
    footings: list[dict[str, Any]]
    footings_left: int
    largest: list[dict[str, Any]]
    scene: Path | None
    whole: bool


@dataclass(frozen=True)
class Shapes:
    """Modes, fields or a mesh that a run has left."""

    name: str
    kind: str
    scene: Path
    frequencies: list[float]


@dataclass(frozen=True)
class Results:
    """A folder of results.

    Attributes
    ----------
    summary : dict
        As `summary.json` has it; empty for a run that never came to write it.
    deck, text : str
        Its name and its text, '' if that is gone.
    changed : bool
        Whether the text is that of a file that has changed since.
    recorded : bool
        Whether the run took down what a report shows.
    verdicts : list of lists of dict
        Pictures of each verdict; its figures stand in the summary's statistics.
    series, tables, pictures : lists of Path
        What the deck itself wrote.
    unread : list of str
        Files that are damaged.
    """

    folder: Path
    summary: dict[str, Any]
    deck: str
    text: str
    changed: bool = False
    recorded: bool = False
    calculations: list[Calculation] = field(default_factory=list)
    drawings: list[dict[str, Any]] = field(default_factory=list)
    shapes: list[Shapes] = field(default_factory=list)
    left_out: dict[str, int] = field(default_factory=dict)
    verdicts: list[list[dict[str, Any]]] = field(default_factory=list)
    series: list[Path] = field(default_factory=list)
    tables: dict[str, dict[str, FloatArray]] = field(default_factory=dict)
    pictures: list[Path] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)


def read_results(folder: Path) -> Results:
    """Read a folder.

    Raises
    ------
    InputError
        If it is none, or no run has left anything there.
    """
    if not folder.is_dir():
        raise InputError("report.no-folder", folder=folder)
    summary = _summary(folder)
    found = sorted(p for p in folder.iterdir() if p.is_file())
    own = {f["path"] for f in summary.get("files", ())} if summary else {p.name for p in found}
    unread: list[str] = []
    series = [p for p in found if p.suffix in SERIES and p.name in own]
    tables = tables_of([p for p in found if p.name in own], unread)
    if not summary and not series and not tables and not (folder / FOLDER).is_dir():
        raise InputError("report.no-run", folder=folder)
    contents = _contents(folder, own, bool(summary), unread)
    deck = str(contents.get("name") or summary.get("deck", ""))
    text, changed = contents.get("text", ""), False
    if not contents:
        text, changed = _text(folder, summary)
    drawn = {name for d in contents.get("drawings", ()) for name in d["files"]}
    pictures = [p for p in found if p.suffix == ".png" and p.name in own - drawn]
    return Results(
        folder, summary, deck, text, changed, bool(contents),
        [_calculation(folder, c, unread) for c in contents.get("calculations", ())],
        contents.get("drawings", []),
        [
            Shapes(s["name"], s["kind"], folder / FOLDER / s["scene"], s["frequencies"])
            for s in contents.get("shapes", ())
        ],
        contents.get("left_out", {}),
        contents.get("verdicts", []),
        series, tables, pictures, unread,
    )  # fmt: skip


def _summary(folder: Path) -> dict[str, Any]:
    path = folder / SUMMARY
    if not path.is_file():
        return {}
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as problem:
        raise InputError("report.damaged", path=path, problem=problem) from None
    if not isinstance(found, dict) or not _is_sound(found):
        raise InputError("report.not-a-summary", path=path)
    return found


_LISTS = {
    "files": ("path", "bytes"), "figures": ("name", "value", "expected", "tolerance", "ok"),
    "warnings": ("line", "text"), "errors": ("line", "text"),
}  # fmt: skip
"""What each entry of a summary's lists has."""


def _is_sound(summary: dict[str, Any]) -> bool:
    """Whether a summary has what a report reads."""
    lists = [(summary.get(name), keys) for name, keys in _LISTS.items()]
    if not all(isinstance(rows, list) and _have(rows, keys) for rows, keys in lists):
        return False
    statistics, units = summary.get("statistics"), summary.get("units")
    if not isinstance(statistics, dict) or not isinstance(units, dict | None):
        return False
    runs = statistics.get("calculations", [])
    plain = all(isinstance(summary.get(n), str) for n in ("version", "deck"))
    plain = plain and isinstance(summary.get("seconds"), int | float)
    return plain and isinstance(runs, list) and _have(runs, ()) and "system" in (units or "system")


def _have(rows: list[Any], keys: tuple[str, ...]) -> bool:
    return all(isinstance(row, dict) and row.keys() >= set(keys) for row in rows)


def _contents(folder: Path, own: set[str], ended: bool, unread: list[str]) -> dict[str, Any]:
    """The run's record; what an earlier run has left is none."""
    path, name = folder / FOLDER / CONTENTS, f"{FOLDER}/{CONTENTS}"
    if not path.is_file() or (ended and name not in own):
        return {}
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        found = None
    if not isinstance(found, dict) or not all(
        isinstance(found.get(key), list) and _have(found[key], keys)
        for key, keys in _RECORDED.items()
    ):
        unread.append(name)
        return {}
    return found


_RECORDED = {
    "calculations": (
        "procedure",
        "table",
        "scene",
        "whole",
        "footings",
        "footings_left",
        "largest",
    ),
    "drawings": ("title", "x", "y", "log", "files", "curves"),
    "shapes": ("name", "kind", "scene", "frequencies"),
}
"""What each entry of a record's lists has."""


def _text(folder: Path, summary: dict[str, Any]) -> tuple[str, bool]:
    """The deck as it is now, and whether it is younger than the run."""
    path = Path(str(summary.get("deck", "")))
    try:
        text = Source.decode("", path.read_bytes()).text if path.is_file() else ""
        changed = bool(text) and path.stat().st_mtime > (folder / SUMMARY).stat().st_mtime
    except OSError:
        return "", False
    return text, changed


def _calculation(folder: Path, told: dict[str, Any], unread: list[str]) -> Calculation:
    """A calculation with its histories."""
    path = folder / FOLDER / told["table"]
    columns: dict[str, FloatArray] = {}
    try:
        columns = _columns(path)
    except (OSError, ValueError):
        unread.append(f"{FOLDER}/{path.name}")
    scene = None if told["scene"] is None else folder / FOLDER / told["scene"]
    return Calculation(
        told["procedure"],
        columns,
        told["footings"],
        told["footings_left"],
        told["largest"],
        scene,
        told["whole"],
    )


def tables_of(paths: list[Path], unread: list[str]) -> dict[str, dict[str, FloatArray]]:
    """Tables of histories, CSV and Parquet; those that are no numbers are left alone."""
    found = {}
    for path in paths:
        try:
            if path.suffix == ".csv" and path.stat().st_size < MOST_BYTES:
                columns = _columns(path)
            elif path.suffix == ".parquet":
                columns = _parquet(path)
            else:
                continue
        except ValueError:
            continue
        except (OSError, OutputError):
            unread.append(path.name)
            continue
        if len(columns) > 1 and len(next(iter(columns.values()))) > 1:
            found[path.name] = columns
    return found


def _columns(path: Path) -> dict[str, FloatArray]:
    """Columns of numbers by their titles.

    Raises
    ------
    ValueError
        If it holds anything else.
    """
    with path.open(encoding="utf-8", errors="replace", newline="") as file:
        first = file.readline()
        sign = ";" if ";" in first else ","
        names = [name.strip() for name in next(csv.reader([first], delimiter=sign))]
        rows = [row for row in csv.reader(file, delimiter=sign) if row]
    if rows and len(rows[-1]) < len(names):  # half a line
        rows.pop()
    values = np.array([[float(x or "nan") for x in row] for row in rows], float)
    if len(names) != len(set(names)) or (rows and values.shape[1] != len(names)):
        raise ValueError
    values = values.reshape(len(rows), len(names))
    return {name: values[:, i] for i, name in enumerate(names)}


def _parquet(path: Path) -> dict[str, FloatArray]:
    try:
        from pyarrow import ArrowException
        from pyarrow.parquet import read_table
    except ModuleNotFoundError:
        raise ValueError from None
    try:
        table = read_table(path)
        return {n: np.asarray(table[n].to_numpy(), float) for n in table.column_names}
    except ArrowException:
        raise OSError from None
