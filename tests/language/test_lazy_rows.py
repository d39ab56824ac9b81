"""Tables whose entries are made when they are asked for act as one that has them all."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from together import together

from ssilang.language.values import PENDING, LazyRows, LazyTable, Mot, Table, promises

WORDS = ("TEMP", "DEPL")
INDEX = st.sampled_from([1, 2, 3, 4, 1.0, True, False, "1", "A", "A ", "TEMP", "DEPL"])
DONE = st.one_of(
    st.tuples(st.just("set"), INDEX, st.integers(5, 9)),
    st.tuples(st.sampled_from(["get", "remove", "has", "waiting"]), INDEX, st.just(0)),
    st.tuples(st.sampled_from(["items", "indices", "len"]), st.just(0), st.just(0)),
)


def _key(index):
    return type(index).__name__, index.rstrip() if isinstance(index, str) else index


class _Entry(Table):
    """What a row becomes; equal to its row."""

    def __init__(self, row):
        super().__init__()
        self.row = row

    def __eq__(self, other):
        return self.row == getattr(other, "row", other)

    __hash__ = None


def _plain(made):
    table = Table()
    return table, {}


def _words(made):
    def find(word):
        made.append(word)
        return f"found {word}"

    return LazyTable(find, promises(*WORDS)), {_key(w): (w, f"found {w}") for w in WORDS}


def _rows(made, listed=False):
    def make(row):
        made.append(row)
        return _Entry(row)

    source = [None] * 3 if listed else ()
    table = LazyRows(make, promises("TEMP"), lambda index: None, source)
    for row in () if listed else range(3):
        table.append(row)
    return table, {_key(i + 1): (i + 1, i) for i in range(3)}


@pytest.mark.parametrize("new", [_plain, _words, _rows, lambda m: _rows(m, True)])
@given(st.lists(DONE, max_size=12))
def test_every_table_is_a_dictionary_that_knows_types_of_indices(new, done):
    """1, 1., VRAI and '1' are four indices, blanks at the end of a word are none of it."""
    made = []
    table, model = new(made)
    for what, index, value in done:
        if what == "set":
            table.set(index, value)
            model[_key(index)] = (index, value)
        elif what == "get":
            assert table.get(index, "none") == model.get(_key(index), (0, "none"))[1]
        elif what == "waiting":
            waits = table.waiting(index)  # rows that are not listed yet are not seen
            assert waits in (None, PENDING, model.get(_key(index), (0, None))[1])
        elif what == "remove":
            table.remove(index)
            model.pop(_key(index), None)
        elif what == "has":
            assert table.has(index) == (_key(index) in model)
        elif what == "items":
            assert table.items() == list(model.values())
        elif what == "indices":
            assert table.indices() == [i for i, _ in model.values()]
        else:
            assert len(table) == len(model)
    assert table.items() == list(model.values())
    assert len(made) == len(set(made))  # each once


def test_nothing_is_made_before_it_is_asked_for():
    made = []
    for table, one in ((_rows(made)[0], 2), (_rows(made, True)[0], 2), (_words(made)[0], "DEPL")):
        assert len(table) > 1
        assert table.has(one)
        assert len(table.indices()) == len(table)
        assert made == []
        assert table.get(one) is table.get(one)
        assert made == [one - 1 if one == 2 else one]
        made.clear()


@together("listed", [False, True])
def test_rows_tell_what_waits(listed):
    table, _ = _rows([], listed)
    assert table.untouched
    assert table.words == ["TEMP"]
    assert table.promises("TEMP")
    assert not table.promises("DEPL")
    table.get(1)
    assert not table.untouched
    assert table.promises("TEMP")
    table.items()
    assert not table.promises("TEMP")
    empty = LazyRows(_Entry, promises("TEMP"), lambda index: None)
    assert not empty.untouched
    assert not empty.promises("TEMP")


def test_a_stand_in_serves_for_what_is_not_made():
    asked = []

    def stand_in(word, whole):
        asked.append(word)
        return {"TEMP": 7.0, "REST": whole}.get(word)

    table = LazyTable(str.lower, promises("TEMP", "DEPL"), stand_in)
    table.set(Mot("A"), 3)
    assert [table.glance(i, 9) for i in ("A", "TEMP", "NO")] == [3, 7.0, 9]
    assert table.glance("DEPL") == "depl"  # nothing stands in for it: it is made
    assert table.get("TEMP") == "temp"
    assert table.glance("TEMP") == "temp"
    assert asked == ["TEMP", "DEPL"]
    assert LazyTable(str.lower, promises("TEMP")).glance("TEMP") == "temp"


@together("subtype", ["", "MODAL", "A B"])
def test_a_subtype_is_an_entry(subtype):
    table = Table(subtype)
    assert table.subtype == subtype
    assert table.items() == ([("SOUSTYPE", subtype)] if subtype else [])
    table.set("SOUSTYPE", 5)
    assert table.subtype == ""
