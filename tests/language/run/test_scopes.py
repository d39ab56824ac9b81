"""Names of running procedures: a frame's own before its caller's, and none of its own leaks."""

from ssilang.language.run.scopes import Frame
from ssilang.language.values import ANNULE


def test_frames_over_frames():
    root = Frame()
    for name, value in {"Z": 1, "A": 2, "!OWN": 3, "GONE": 4}.items():
        root.assign(name, value)
    middle = Frame(root, "OUTER")
    middle.assign("A", 20)
    middle.assign("FALSE", False)
    inner = Frame(middle, "INNER")
    inner.assign("B", 300)
    inner.assign("!OWN", 5)
    assert [f.depth for f in (root, middle, inner)] == [0, 1, 2]
    assert [inner.find(n) for n in ("Z", "A", "B", "FALSE", "NONE")] == [1, 20, 300, False, None]
    assert [f.find("!OWN") for f in (root, middle, inner)] == [3, None, 5]
    assert [f.find("A") for f in (root, middle)] == [2, 20]
    inner.assign("Z", 100)
    assert (root.find("Z"), middle.find("Z"), inner.find("Z")) == (1, 1, 100)
    inner.forget("GONE", hiding=True)  # only the script's own words come back
    assert inner.find("GONE") is ANNULE
    assert inner.names() == {"Z", "A", "B", "!OWN", "FALSE"}
    assert middle.names() == {"Z", "A", "!OWN", "GONE", "FALSE"}
    root.forget("GONE", hiding=True)
    root.forget("Z", hiding=False)
    assert root.find("GONE") is None
    assert root.names() == {"A", "!OWN"}
    assert middle.results == []
    assert middle.results is not inner.results
