"""Histories of runs joined: each value under its own head, whatever the order of the names."""

import csv
import json

import pyarrow as pa
import pyarrow.parquet as pq
from together import together

from ssilang.cli.sweeping.histories import join_histories

SWEPT = ("ZETA", "MU", "ALFA", "CAS", "FLAG")  # neither sorted nor of one kind
VALUES = [(2, 3, "dense", 7, True), (0.5, -1, "1", 8, False), (9.0, 0, "x", 9, True)]
HISTORY = {"time": [0.0, 0.1, 0.3], "MU": [1.5, -2.5, 4.0], "b": [7.0, 8.0, 9.0]}


def rows_in(folder, suffix):
    """Three runs that wrote a table, one that failed, one whose columns are others."""
    rows = []
    for i, values in enumerate([*VALUES, VALUES[0], VALUES[1]]):
        run = folder / "runs" / f"r{i}"
        run.mkdir(parents=True)
        columns = {k: [10.0 * i + x for x in v] for k, v in HISTORY.items()}
        if i == 4:
            columns["c"] = columns.pop("b")
        if suffix == "csv":
            lines = [list(columns), *zip(*columns.values(), strict=True)]
            (run / "h.csv").write_text("\n".join(";".join(map(str, x)) for x in lines) + "\n")
        else:
            pq.write_table(pa.table(columns), run / "h.parquet")
        (run / "summary.json").write_text(json.dumps({"files": [{"path": f"h.{suffix}"}]}))
        named = dict(zip(SWEPT, values, strict=True))
        rows.append({"run": i + 1, "folder": run.name, "exit_code": int(i == 3), **named})
    return rows


@together("suffix", ["csv", "parquet"])
def test_swept_values_stand_under_their_own_names(tmp_path, suffix):
    joined = join_histories(rows_in(tmp_path, suffix), SWEPT, tmp_path)
    (path,) = joined.files
    assert (path, joined.others) == (tmp_path / "histories" / f"h.{suffix}", 1)
    if suffix == "csv":
        with path.open() as stream:
            found = list(csv.DictReader(stream, delimiter=";"))
    else:
        found = pq.read_table(path).to_pylist()
    assert len(found) == 9
    for i, values in enumerate(VALUES):
        for k in range(3):
            row = found[3 * i + k]
            given = {"run": i + 1, **dict(zip(SWEPT, values, strict=True))}
            given["MU (sweep)"] = given.pop("MU")
            own = {name: 10.0 * i + HISTORY[name][k] for name in HISTORY}
            assert set(row) == {*given, *own}
            for name, value in (given | own).items():
                if isinstance(value, bool):
                    assert row[name] in (value, "VRAI" if value else "FAUX"), name
                elif name == "ALFA":
                    assert row[name] == value
                else:
                    assert float(row[name]) == value, name
