"""A table whose entries are made when they are asked for acts as one that has them."""

import pytest

from ssilang.language.values import LazyRows, Mot, Table, promises


@pytest.fixture
def rows():
    made = []

    def make(row):
        made.append(row)
        table = Table()
        table.set(Mot("TEMP"), 0.1 * row)
        return table

    table = LazyRows(make, promises("TEMP"), lambda index: [(0.0, None)] * len(table.rows))
    for row in (10, 20, 30):
        table.append(row)
    return table, made


def test_an_entry_is_made_once_and_alone(rows):
    table, made = rows
    assert len(table) == 3
    assert table.has(2)
    assert not table.has(4)
    assert table.promises("TEMP")
    assert not table.promises("DEPL")
    assert made == []
    first = table.get(2)
    assert first.get("TEMP") == pytest.approx(2.0)
    assert table.get(2) is first
    assert made == [20]
    assert len(table.stand_ins("TEMP")) == 2
    assert table.get(9, "none") == "none"


def test_all_entries_come_in_order(rows):
    table, made = rows
    table.get(3)
    table.set(Mot("TITRE"), "end")
    assert [index for index, _ in table.items()] == [1, 2, 3, "TITRE"]
    assert sorted(made) == [10, 20, 30]
    assert all(isinstance(value, Table) for index, value in table.items() if type(index) is int)
    assert not table.promises("TEMP")


def test_what_replaces_an_entry_stays(rows):
    table, made = rows
    table.set(1, 5.0)
    table.remove(2)
    assert table.get(1) == 5.0
    assert not table.has(2)
    assert [index for index, _ in table.items()] == [1, 3]
    assert made == [30]
