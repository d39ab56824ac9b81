"""Tables and lists of the language: keys by type, copies, entries made when they are asked for."""

import numpy as np
from together import together

from ssilang.language.values import (
    PENDING,
    LazyRows,
    LazyTable,
    ListEnti,
    ListMots,
    ListReel,
    Mot,
    Table,
    normalised,
    promises,
    type_of,
)


def test_indices_of_different_types_are_different():
    table = Table("MODE")
    indices = [2, 2.0, Mot("2"), True, 1, 1.0, Mot("Z"), ListReel([1.0]), ListReel([1.0])]
    for i, index in enumerate(indices):
        table.set(index, i)
    assert len(table) == len(indices) + 1
    assert [table.get(index) for index in indices] == list(range(len(indices)))
    assert table.indices() == [Mot("SOUSTYPE"), *indices]
    assert (table.get(Mot("2   ")), table.get(False), table.get(3, "none")) == (2, None, "none")
    assert table.subtype == "MODE"
    table.set(2, "new")  # stays in its place
    table.remove(True)
    table.remove("NOT THERE")
    assert [v for _, v in table.items()] == ["MODE", "new", 1, 2, 4, 5, 6, 7, 8]
    assert not table.has(True)
    assert table.has(1)


def test_numbered_tables_begin_at_one():
    assert Table.numbered("ZA", "SUB").items() == [("SOUSTYPE", "SUB"), (1, "Z"), (2, "A")]
    made = Table.of({"Z": 1, 3: 2})
    assert [(type_of(i), i, v) for i, v in made.items()] == [("MOT", "Z", 1), ("ENTIER", 3, 2)]


def test_lists_hold_copies():
    given = np.array([3.0, 1.0, 2.0])
    words = ["ZB", "A"]
    real, whole, held = ListReel(given), ListEnti(given), ListMots(words)
    given[:] = 0.0
    words.append("LATE")
    assert (real.values.tolist(), whole.values.tolist()) == ([3, 1, 2], [3, 1, 2])
    longer = held.extended([Mot("M")])
    assert (held.values, longer.values) == (["ZB", "A"], ["ZB", "A", "M"])
    assert (len(ListReel(2.5)), len(ListReel()), len(longer)) == (1, 0, 3)
    own = np.arange(2.0)
    assert ListReel.of(own).values is own


def test_values_that_wait_are_found_once_and_not_shared():
    asked, given = [], promises("ZED", "AMP")

    def find(name):
        asked.append(name)
        return f"{name}!"

    stand_ins = {"AMP": "instead"}
    first, second = (LazyTable(find, given, lambda n, get: stand_ins.get(n)) for _ in "12")
    assert first.indices() == ["ZED", "AMP"]
    assert not asked
    assert (first.glance("AMP"), first.glance("ZED"), first.glance("NO", 7)) == (
        "instead", "ZED!", 7
    )  # fmt: skip
    assert (first.get("AMP  "), first.get("AMP"), first.glance("AMP")) == ("AMP!",) * 3
    assert asked == ["ZED", "AMP"]
    assert second.waiting("ZED") is PENDING
    assert second.items() == [("ZED", "ZED!"), ("AMP", "AMP!")]
    assert asked == ["ZED", "AMP", "ZED", "AMP"]


@together("source", [(), "xy"])
def test_rows_become_tables_when_they_are_asked_for(source):
    made = []

    def make(row):
        made.append(row)
        return Table.of({"ROW": row})

    rows = LazyRows(make, promises("ROW", "TIME"), lambda word: None, source)
    n = len(source)
    assert rows.untouched is (n > 0)
    if n:
        assert rows.promises("TIME")
    assert len(rows) == n
    for row in "abc":
        rows.append(row)
    assert (len(rows), rows.indices()) == (n + 3, list(range(1, n + 4)))
    assert (rows.untouched, rows.words, made) == (True, ["ROW", "TIME"], [])
    assert (rows.promises("TIME"), rows.promises("OTHER")) == (True, False)
    second = rows.get(n + 2)
    assert (second.get("ROW"), made) == ("b", ["b"])
    assert rows.get(n + 2) is second
    assert not rows.untouched
    rows.append("d")
    assert rows.indices()[-1] == n + 4
    rows.remove(n + 4)
    rows.set(n + 1, "mine")
    rows.remove(n + 3)
    rows.set(Mot("Z"), 5)
    assert rows.has(n + 1)
    assert not rows.has(n + 3)
    places = [t.get("ROW") for _, t in rows.items()[:n]]
    assert places == list(range(n))
    assert rows.items()[n:] == [(n + 1, "mine"), (n + 2, second), ("Z", 5)]
    assert not rows.promises("TIME")
    assert made == ["b", *range(n)]


def test_what_operators_return_in_the_words_of_the_language():
    values = [np.float64(1.5), np.int32(3), np.bool_(True), "W", Mot("W"), [1]]
    assert [type_of(normalised(v)) for v in values] == [
        "FLOTTANT", "ENTIER", "LOGIQUE", "MOT", "MOT", "LIST"
    ]  # fmt: skip
