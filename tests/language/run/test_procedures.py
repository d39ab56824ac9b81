"""Section 10: procedures, and whose their names are."""

import os

from ssilang.language.run import library
from ssilang.language.run.scopes import PREDEFINED, Frame
from ssilang.language.values import ANNULE


def test_at_procedures_are_found_beside_the_deck(tmp_path):
    from ssilang.cli.run import run_file

    (tmp_path / "@twice.procedur").write_text("DEBP @TWICE a*ENTIER ; r = 2 * a ; FINP r ;\n")
    deck = tmp_path / "deck.dgibi"
    deck.write_text("x = @twice 4 ;\n")
    assert run_file(deck).session.root.find("X") == 8


def test_a_failed_statement_stops_the_script(tmp_path):
    from ssilang.cli.run import run_text

    result = run_text("x = 1 ; y = 1 / 0 ; x = 2 ;", output_directory=tmp_path)
    assert result.session.root.find("X") == 1
    assert result.errors[0].span.source.position(result.errors[0].span.start)[0] == 1


def test_the_chain_of_calls_is_told(tmp_path):
    from ssilang.cli.run import run_text

    text = "DEBP INNER ; x = 1 / 0 ; FINP ;\nDEBP OUTER ; INNER ; FINP ;\nOUTER ;"
    error = run_text(text, output_directory=tmp_path).errors[0]
    assert [name for name, _ in error.calls] == ["INNER", "OUTER"]


def test_sessions_share_the_tree_of_a_file_of_the_library_until_it_changes(tmp_path, monkeypatch):
    path = tmp_path / "double.ssi"
    path.write_text("DEBP DOUBLE X1*FLOTTANT ; Y1 = X1 + X1 ; FINP Y1 ;")
    monkeypatch.setattr(library, "standard_procedures", lambda: {"DOUBLE": path})
    first, second = (library.Library(tmp_path).find("DOUBLE") for _ in range(2))
    assert first.definition is second.definition
    path.write_text("DEBP DOUBLE X1*FLOTTANT ; Y1 = X1 + X1 + 0. ; FINP Y1 ;")
    os.utime(path, ns=(1, 1))
    assert library.Library(tmp_path).find("DOUBLE").definition is not first.definition


def test_frames_over_frames(tmp_path):
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
    own = Frame(Frame(Frame(root, "OF_LIBRARY", library=True), "AGAIN", library=True), "GIVEN")
    own.caller.assign("A", 7)
    own.caller.caller.assign("A", 8)
    assert (own.depth, own.find("A"), own.caller.find("A")) == (3, 2, 7)
    given = library.Library(tmp_path).find("FZERO")
    for name, value in {"FUNCTION": given, "PI": 3, "MASS": 4}.items():
        own.assign(name, value)
    later = Frame(own, "LATER", library=True)
    assert [later.find(n) for n in ("A", "MASS", "FUNCTION")] == [None, None, given]
    assert later.find("PI") == PREDEFINED["PI"]
    assert later.named()["MASS"] == 4
    assert middle.results == []
    assert middle.results is not inner.results
