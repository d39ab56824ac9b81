"""`ssilang check --format`: problems for programs."""

import json

SCRIPT = "OPTI DIME 2 ELME SEG2 ;\nX = 1 / (2. ;\nFIN ;\n"


def test_json_has_places_and_fixes(ssilang, tmp_path):
    sound = tmp_path / "sound.ssi"
    sound.write_text("OPTI DIME 2 ELME SEG2 ;\nFIN ;\n")
    broken = tmp_path / "broken.ssi"
    broken.write_text(SCRIPT)
    outcome = ssilang("check", "--format", "json", str(sound), str(broken))
    assert outcome.code == 1
    first, second = json.loads(outcome.out)
    assert (first["file"], first["line"], first["column"]) == (str(sound), 1, 13)
    assert (first["severity"], first["code"]) == ("warning", "near-word")
    assert first["fixes"][0]["text"] == "ELEM"
    assert (second["line"], second["column"], second["code"]) == (2, 9, "unclosed-paren")
    assert second["fixes"][0]["column"] == 12


def test_notes_of_github_escape_what_ends_them(ssilang, tmp_path):
    deck = tmp_path / "a,b.ssi"
    deck.write_text(SCRIPT)
    outcome = ssilang("check", "--format", "github", str(deck))
    assert outcome.code == 1
    place, _, message = outcome.out.strip().removeprefix("::error ").partition("::")
    assert place.startswith(f"file={tmp_path}/a%2Cb.ssi,line=2,endLine=2,col=9,endColumn=10")
    assert message
    assert "\n" not in message


def test_nothing_wrong(ssilang, tmp_path):
    deck = tmp_path / "case.ssi"
    deck.write_text("MESS 1 ;\nFIN ;\n")
    outcome = ssilang("check", "--format", "json", str(deck))
    assert (outcome.code, json.loads(outcome.out)) == (0, [])
    assert ssilang("check", "--format", "github", str(deck)).out == ""
