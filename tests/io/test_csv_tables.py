"""Columns to CSV and back; assembled matrices as text."""

import time

import numpy as np
import pytest
import scipy.io
from together import together

from ssilang.io import tables
from ssilang.io.errors import InputError
from ssilang.io.matrix_market import market_text, node_lines, system_of, unknown_lines
from ssilang.io.tables import Column, as_columns, csv_lines, read_csv, write_parquet
from tests.kernel.stepping.problem.test_non_associated import K1, K2, C, D, lever


def test_titles_stand_over_columns_of_unequal_length():
    lines = csv_lines([Column("t", [0.0, 0.1]), Column("", [1, 2, 3]), Column("w", ["AB"])])
    assert lines == ["t;;w", "0.0;1;AB", "0.1;2;", ";3;"]
    heads = [Column(t, [], "m").head for t in ("", "  thirteenletters", "a ")]
    assert heads == ["(m)", "thirteenlett (m)", "a (m)"]


def test_numbers_come_back_exactly(tmp_path):
    values = np.random.default_rng(1).normal(size=50) * 10.0 ** np.arange(-25, 25)
    path = tmp_path / "x.csv"
    path.write_text("\n".join(csv_lines([Column("", values), Column("", values[::-1])], ",")))
    read = as_columns(read_csv(path, ","))
    assert np.array_equal(read[0], values)
    assert np.array_equal(read[1], values[::-1])


def test_columns_beyond_the_width_follow_below():
    lines = csv_lines([Column("", [i]) for i in range(5)], width=2)
    assert lines == ["0;1", "", "", "", "2;3", "", "", "", "4"]


def test_digits_are_decimals_of_the_mantissa():
    assert csv_lines([Column("", [1.0 / 3.0])], digits=3) == ["3.333E-01"]


def test_reading_starts_behind_titles_and_says_where_a_word_is(tmp_path):
    path = tmp_path / "x.csv"
    path.write_text("time;force\n0;1.5D3\n1;-2d-1\n")
    assert read_csv(path, ";", 2) == [[0.0, 1500.0], [1.0, -0.2]]
    with pytest.raises(InputError, match="line 1: 'time'"):
        read_csv(path)


def test_blanks_separate_however_many(tmp_path):
    path = tmp_path / "x.txt"
    path.write_text("  1   2  \n 3 4\n\n")
    assert read_csv(path, " ").tolist() == [[1.0, 2.0], [3.0, 4.0]]


@together("end", ["", ";", '\n"7";8', "\n3;4;5", "\n\n9"])
def test_uneven_and_even_rows_are_read_alike(tmp_path, end):
    path = tmp_path / "x.csv"
    path.write_text("1;2\n3;4" + end)
    rows = [list(row) for row in read_csv(path)]
    assert rows[:2] == [[1.0, 2.0], [3.0, 4.0]]
    assert rows[2:] == {
        '\n"7";8': [[7.0, 8.0]],
        "\n3;4;5": [[3.0, 4.0, 5.0]],
        "\n\n9": [[9.0]],
    }.get(end, [])


@together("cell", ["nan", "inf", "-1E999"])
def test_what_is_not_finite_is_refused_where_it_stands(tmp_path, cell):
    path = tmp_path / "x.csv"
    path.write_text(f"1;2\n3;{cell}\n")
    with pytest.raises(InputError, match="line 2"):
        read_csv(path)


def test_one_long_row_over_many_short_ones_is_read_soon(tmp_path):
    path = tmp_path / "x.csv"
    path.write_text(";".join(map(str, range(50_000))) + "\n" + "7\n" * 50_000)
    begin = time.process_time()
    columns = as_columns(read_csv(path))
    assert time.process_time() - begin < 20.0  # thousands of millions of cells would be hours
    assert columns[0].tolist() == [0.0, *[7.0] * 50_000]
    assert [c.tolist() for c in columns[1:]] == [[float(i)] for i in range(1, 50_000)]


def test_digits_that_python_alone_reads_are_no_number(tmp_path):
    path = tmp_path / "x.csv"
    path.write_text("1;1_0\n2;3\n")
    with pytest.raises(InputError, match="1_0"):
        read_csv(path)


def test_columns_without_a_unit_have_none_in_parquet(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    columns = {name: np.arange(2.0) + i for i, name in enumerate("cab")}
    write_parquet(tmp_path / "x.parquet", columns, {"a": "m", "b": ""})
    table = parquet.read_table(tmp_path / "x.parquet")
    assert {f.name: f.metadata for f in table.schema} == {
        "c": None,
        "a": {b"unit": b"m"},
        "b": None,
    }
    assert table.to_pydict() == {"c": [0, 1], "a": [1, 2], "b": [2, 3]}


@together("separator", [";", " "])
def test_a_line_of_too_many_columns_is_refused(separator, tmp_path, monkeypatch):
    monkeypatch.setattr(tables, "MOST_COLUMNS", 1000)
    path = tmp_path / "wide.csv"
    path.write_text("\n" + separator.join(["1."] * 1000) + "\n")
    assert len(as_columns(read_csv(path, separator))) == 1000
    path.write_text("\n" + separator.join(["1."] * 1001) + "\n")
    with pytest.raises(InputError, match=r"wide\.csv, line 2: more than 1000 columns"):
        read_csv(path, separator)
    assert read_csv(path, separator, 3) == []


def test_a_system_has_what_binds_below_and_what_pushes_beside(tmp_path):
    bench, one, two = lever()
    system = system_of(bench.stiffness)
    found = np.zeros((system.size, system.size))
    found[system.rows, system.columns] = system.values
    keys = [*zip(system.columns.tolist(), system.rows.tolist(), strict=True)]
    assert keys == sorted(keys)
    at = [
        i for n in (one, two) for i in np.flatnonzero(system.nodes == n) if system.names[i] == "UY"
    ]
    lever_row = system.size - 1
    assert (found[at, at].tolist(), found[lever_row, at].tolist()) == ([K1, K2], C.tolist())
    assert found[at, lever_row].tolist() == D.tolist()
    (tmp_path / "k.mm").write_bytes(market_text(system))
    assert np.array_equal(scipy.io.mmread(tmp_path / "k.mm").toarray(), found)
    ids = [int(line.split()[3]) - 1 for line in node_lines(system, bench.table.coordinates)]
    assert ids == np.unique(system.nodes).tolist()
    local = [int(line.split()[0]) - 1 for line in unknown_lines(system)[: system.size]]
    assert [ids[i] for i in local] == system.nodes.tolist()
