"""What a folder of results holds, read for its report: the one reader, whoever asks.

A run with `--report` leaves a record beside what every run leaves (`io/recording.py`); without it
the report has the summary, the deck if it is still there, the deck's own series, tables, pictures.
"""

import csv
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.atomic import inside
from ssilang.io.errors import InputError, OutputError
from ssilang.io.recording import CONTENTS, FOLDER
from ssilang.kernel.base.arrays import FloatArray
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source
from ssilang.report.records import RecordError, read_record

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
    """A folder of results."""

    folder: Path
    summary: dict[str, Any]  # as `summary.json` has it; empty for a run that never came to write it
    deck: str  # its name and its text, '' if that is gone or no longer what ran
    text: str
    recorded: bool = False  # whether the run took down what a report shows
    calculations: list[Calculation] = field(default_factory=list)
    drawings: list[dict[str, Any]] = field(default_factory=list)
    shapes: list[Shapes] = field(default_factory=list)
    left_out: dict[str, int] = field(default_factory=dict)
    # pictures of each verdict; its figures stand in the summary's statistics
    verdicts: list[list[dict[str, Any]]] = field(default_factory=list)
    series: list[Path] = field(default_factory=list)  # what the deck itself wrote
    tables: dict[str, dict[str, FloatArray]] = field(default_factory=dict)
    pictures: list[Path] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)  # files that are damaged


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
    found = sorted(p for p in folder.iterdir() if inside(folder, p.name))
    own = {f["path"] for f in summary.get("files", ())} if summary else {p.name for p in found}
    unread: list[str] = []
    series = [p for p in found if p.suffix in SERIES and p.name in own]
    tables = tables_of([p for p in found if p.name in own], unread)
    if not summary and not series and not tables and not (folder / FOLDER).is_dir():
        raise InputError("report.no-run", folder=folder)
    contents = _contents(folder, own, bool(summary), unread)
    deck = str(contents.get("name") or summary.get("deck", ""))
    text = contents.get("text", "") if contents else _text(summary)
    drawn = {name for d in contents.get("drawings", ()) for name in d["files"]}
    pictures = [p for p in found if p.suffix == ".png" and p.name in own - drawn]
    return Results(
        folder, summary, deck, text, bool(contents),
        [_calculation(folder, c, unread) for c in contents.get("calculations", ())],
        contents.get("drawings", []),
        [
            Shapes(s["name"], s["kind"], _own(folder, s["scene"]), s["frequencies"])
            for s in contents.get("shapes", ())
        ],
        contents.get("left_out", {}),
        contents.get("verdicts", []),
        series, tables, pictures, unread,
    )  # fmt: skip


def _summary(folder: Path) -> dict[str, Any]:
    path = folder / SUMMARY
    if inside(folder, SUMMARY) is None:
        return {}
    try:
        return read_record(path, "summary")
    except RecordError as problem:
        raise InputError("report.not-a-summary", path=path, problem=problem) from None
    except (OSError, ValueError) as problem:
        raise InputError("report.damaged", path=path, problem=problem) from None


def _contents(folder: Path, own: set[str], ended: bool, unread: list[str]) -> dict[str, Any]:
    """The run's record; what an earlier run has left is none."""
    name = f"{FOLDER}/{CONTENTS}"
    path = inside(folder, name)
    if path is None or (ended and name not in own):
        return {}
    try:
        return read_record(path, "contents")
    except RecordError as problem:
        unread.append(f"{name} ({problem})")
    except (OSError, ValueError):
        unread.append(name)
    return {}


def _text(summary: dict[str, Any]) -> str:
    """The deck, where it still is the one that ran: a record could name any file of the reader."""
    name, digest = summary.get("deck", ""), summary.get("deck_digest", "")
    if not digest or name.startswith(("//", "\\\\")):  # another machine's
        return ""
    try:
        path = Path(name)
        if not path.is_file() or path.stat().st_size > MOST_BYTES:
            return ""
        deck = Source.decode("", path.read_bytes())
    except (OSError, ValueError, SsiError):
        return ""
    return deck.text if deck.digest == digest else ""


def _own(folder: Path, name: str) -> Path:
    """A file of the record's folder; one that is elsewhere is not there."""
    return inside(folder / FOLDER, name) or folder / FOLDER / "-" / Path(name).name


def _calculation(folder: Path, told: dict[str, Any], unread: list[str]) -> Calculation:
    """A calculation with its histories."""
    path = _own(folder, told["table"])
    columns: dict[str, FloatArray] = {}
    try:
        columns = _columns(path)
    except (OSError, ValueError):
        unread.append(f"{FOLDER}/{path.name}")
    scene = None if told.get("scene") is None else _own(folder, told["scene"])
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
    """Columns of numbers by their titles."""
    if path.stat().st_size > MOST_BYTES:
        raise OSError
    with path.open(encoding="utf-8", errors="replace", newline="") as file:
        first = file.readline()
        sign = ";" if ";" in first else ","
        try:
            names = [name.strip() for name in next(csv.reader([first], delimiter=sign))]
            rows = [row for row in csv.reader(file, delimiter=sign) if row]
        except csv.Error:  # a cell without an end
            raise ValueError from None
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
        from pyarrow.parquet import ParquetFile, read_table
    except ModuleNotFoundError:
        raise ValueError from None
    try:
        if ParquetFile(path).metadata.num_rows * 8 > MOST_BYTES:
            raise ValueError
        table = read_table(path)
        return {n: np.asarray(table[n].to_numpy(), float) for n in table.column_names}
    except ArrowException:
        raise OSError from None
