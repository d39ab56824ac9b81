"""Records that a page reads: a whole one is taken, and one wrong value is told by its place."""

import copy
import json

import pytest

from ssilang.report.records import RecordError, kinds, read_record

VALUES = {"text": "t", "a number": 0.5, "a count": 2, "true or false": True}
VALUES["two of true or false"] = [False, True]


def whole(kind, wrong, place=""):
    """A value of a kind with two of everything; `wrong` gets places of what it holds."""
    if isinstance(kind, str) and kind[0] == "@":
        return whole(kinds()[kind[1:]], wrong, place)
    if isinstance(kind, str):
        wrong.append(place)
        return VALUES.get(kind.removesuffix("?"), "DEPL")
    if isinstance(kind, list):
        return [whole(kind[0], wrong, f"{place}[{i}]") for i in range(2)]
    inner = dict.fromkeys(sorted(kind["only"]), kind["each"]) if "only" in kind else kind
    names = [(n.removesuffix("?"), k) for n, k in inner.items()]
    return {n: whole(k, wrong, f"{place}.{n}".lstrip(".")) for n, k in names}


def at(record, place):
    """What holds a place, and its last step."""
    steps = [
        int(s) if s.isdigit() else s for s in place.replace("]", "").replace("[", ".").split(".")
    ]
    for step in steps[:-1]:
        record = record[step]
    return record, steps[-1]


@pytest.mark.parametrize("name", ["summary", "fragility", "contents"])
def test_a_wrong_value_is_told_by_its_place(name, tmp_path):
    kind, places = kinds()[name], []
    record, path = whole(kind, places), tmp_path / "r.json"
    path.write_text(json.dumps(record | {"more": 1}))
    assert read_record(path, name) == record | {"more": 1}
    for place in places:
        for bad, held in (({"odd": 1}, "dict"), (None, "None")):
            changed = copy.deepcopy(record)
            holder, last = at(changed, place)
            holder[last] = bad
            path.write_text(json.dumps(changed))
            try:
                found = read_record(path, name)
            except RecordError as refused:
                told = str(refused)
                assert told.startswith(f"{place}: {held} != "), (told, place)
            else:  # null says nothing: what may miss, or is not there
                assert bad is None
                holder, last = at(found, place)
                assert holder[last] is None if isinstance(last, int) else holder.get(last) is None
    needed = [n for n in kind if not n.endswith("?")]
    for one in needed:
        path.write_text(json.dumps({n: v for n, v in record.items() if n != one}))
        with pytest.raises(RecordError, match=f"^{one} = "):
            read_record(path, name)
