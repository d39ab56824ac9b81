"""A deck reads and writes below its folder and the output folder, and nowhere else."""

import io
import os
from pathlib import Path

import pytest
from script_runs import ran
from together import together

from ssilang.cli.main import main
from ssilang.cli.run import RunOptions, run_source
from ssilang.io.run_output import RunOutput
from ssilang.language.text.source import Source

_MESH = "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (1. 0.)) TRAN 2 (0. 1.) ; L = PROG 1. 2. ;"
_WRITERS = [
    "OPTI SORT '{path}' ; SORT 'EXCE' L ;",
    "OPTI SORT '{path}' ; SORT 'CHAI' 'text' ;",
    "OPTI SORT '{path}' ; SORT 'VTK ' S ;",
    "OPTI SORT '{path}' ; SORT 'AVS ' S ;",
    "OPTI SAUV '{path}' ; SAUV L ;",
    "OPTI IMPR '{path}' ; MESS 'text' ;",
]
_PICTURES = ["TRAC S ;", "DESS (EVOL 'MANU' L L) ;"]
_READERS = [
    "OPTI DONN '{path}' ;",
    "OPTI ACQU '{path}' ; ACQU X*FLOTTANT ;",
    "T = LIRE 'CSV' '{path}' ;",
    "LIRE 'PROC' '{path}' ;",
    "OPTI REST '{path}' ; REST ;",
    "OPTI LECT '{path}' ; T = LIRE 'AVS' ;",
    "T = LIRE 'UNV' '{path}' ;",
    "M = LIRE 'STL' '{path}' ;",
]


@pytest.fixture
def outside(tmp_path):
    """A deck's folder, and a folder beside it that the deck has no business in."""
    (tmp_path / "deck").mkdir()
    (tmp_path / "private").mkdir()
    (tmp_path / "private" / "secret.csv").write_text("1;2\n3;4\n")
    return tmp_path


def run(text: str, base: Path, *allowed: Path):
    source = Source("deck.ssi", text, base / "deck" / "deck.ssi")
    options = RunOptions(output_directory=base / "deck" / "out", allowed=list(allowed))
    return run_source(source, options, io.StringIO(), io.StringIO())


@pytest.mark.parametrize("statement", _WRITERS)
@pytest.mark.parametrize("form", ["../../private/made", "{base}/private/made"])
def test_writing_outside_is_refused(outside, statement, form):
    text = _MESH + statement.format(path=form.format(base=outside))

    def made():
        return [p for p in outside.rglob("made*") if outside / "deck" not in p.parents]

    refused = run(text, outside)
    assert refused.exit_code == 1
    assert "outside" in refused.message
    assert "--allow" in refused.message
    assert made() == []
    assert [p.name for p in (outside / "private").iterdir()] == ["secret.csv"]
    allowed = run(text, outside, (outside / "private").resolve())
    assert allowed.exit_code == 0, allowed.message
    if "{base}" in form:  # else it is a place below the folder of output
        assert {p.parent for p in made()} == {outside / "private"}


@pytest.mark.parametrize("statement", _PICTURES)
@pytest.mark.parametrize("form", ["../../private/made", "{base}/private/made"])
def test_pictures_take_the_name_alone_and_lie_among_the_results(outside, statement, form):
    path = form.format(base=outside)
    result = run(f"{_MESH} OPTI TRAC PSC FTRA '{path}' ; {statement}", outside)
    assert result.exit_code == 0, result.message
    assert {p.parent for p in outside.rglob("*made*")} == {outside / "deck" / "out"}


@pytest.mark.parametrize("form", ["../private/secret.csv", "{base}/private/secret.csv"])
@together("statement", _READERS)
def test_reading_outside_is_refused(outside, statement, form):
    result = run(_MESH + statement.format(path=form.format(base=outside)), outside)
    assert result.exit_code == 1
    assert "outside" in result.message or "--allow" in result.message


def test_a_link_that_leads_outside_is_refused(outside):
    (outside / "deck" / "link.csv").symlink_to(outside / "private" / "secret.csv")
    assert run("T = LIRE 'CSV' 'link.csv' ;", outside).exit_code == 1


def test_allow_opens_a_folder(outside):
    text = "OPTI ACQU '../private/secret.txt' ; ACQU X*FLOTTANT ;"
    (outside / "private" / "secret.txt").write_text("1.5\n")
    assert run(text, outside).exit_code == 1
    result = run(text, outside, (outside / "private").resolve())
    assert result.exit_code == 0, result.message
    assert result.session.root.find("X") == 1.5


@pytest.mark.parametrize("word", ["EXTE", "CHAU", "VENV"])
def test_no_operator_talks_to_the_system(outside, word):
    result = run(f"X = {word} 'ls' ; MESS X ;", outside)
    assert result.exit_code == 1
    assert "out of ssilang's scope" in result.message


def test_warnings_of_libraries_stay_out_of_a_run_from_python(tmp_path, recwarn):

    ran("X = (PROG 1. 0.) / (PROG 0. 0.) ;", tmp_path)
    assert not recwarn.list


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no pipes with a name")
@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("kind", ["pipe", "device", "huge"])
def test_a_script_is_a_file_that_ends(tmp_path, process, ssilang, command, kind):
    """A pipe would be waited for, a device read until the memory is full: not by this process."""
    deck = tmp_path / "d.ssi"
    if kind == "pipe":
        os.mkfifo(deck)
    elif kind == "device":
        deck.symlink_to("/dev/zero")
    else:
        with deck.open("wb") as stream:
            stream.truncate(2**26 + 1)
    ended = (ssilang if kind == "huge" else process)(command, str(deck))
    assert ended.code == 2
    assert "d.ssi" in ended.err
    assert ("too large" if kind == "huge" else "no file of text") in ended.err
    deck.unlink()
    (tmp_path / "sound.ssi").write_text("A = 1 ;")
    deck.symlink_to("sound.ssi")  # a link to a file is a file
    assert ssilang(command, str(deck)).code == 0


@pytest.mark.parametrize("link", ["results", "results/d"])
def test_results_that_lead_elsewhere_are_written_where_the_user_says_so(
    tmp_path, monkeypatch, link
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "d.ssi").write_text("OPTI SORT 'a.csv' ; SORT 'EXCE' (PROG 1.) ;")
    place = tmp_path / link
    place.parent.mkdir(exist_ok=True)
    place.symlink_to(tmp_path / "elsewhere")
    assert main(["run", "d.ssi"]) == 1
    assert main(["run", "--report", "d.ssi"]) == 1
    assert list((tmp_path / "elsewhere").iterdir()) == []
    assert main(["run", "d.ssi", "--out", link]) == 0
    assert (tmp_path / "elsewhere" / "a.csv").is_file()


@pytest.mark.skipif(os.name != "posix", reason="links of one system")
@pytest.mark.parametrize("link", ["results", "results/d"])
def test_results_exchanged_for_a_link_between_look_and_use(tmp_path, monkeypatch, capsys, link):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "d.ssi").write_text("OPTI SORT 'a.csv' ; SORT 'EXCE' (PROG 1.) ;")
    assert main(["run", "d.ssi"]) == 0
    holds = RunOutput.hold

    def exchanged(output):
        (tmp_path / link).rename(tmp_path / "aside")
        (tmp_path / link).symlink_to(tmp_path / "elsewhere")
        return holds(output)

    monkeypatch.setattr(RunOutput, "hold", exchanged)
    assert main(["run", "d.ssi"]) == 1
    assert "was removed or exchanged during the run" in capsys.readouterr().err
    assert [p for p in (tmp_path / "elsewhere").rglob("*") if p.is_file()] == []


@pytest.mark.parametrize(
    "words", [["run", "--out"], ["run", "--allow"], ["sweep", "--out"], ["sweep", "--allow"]]
)
@pytest.mark.parametrize("kind", ["circle", "file"])
def test_a_folder_that_is_none_is_named(tmp_path, ssilang, one_after_the_other, words, kind):
    """Links that go round, a file: where results go it is told, with `--allow` it opens nothing."""
    (tmp_path / "d.ssi").write_text("A = 1. ; SORT 'BILA' 'a' A ;")
    if kind == "circle":
        (tmp_path / "round").symlink_to("round")
    else:
        (tmp_path / "round").write_text("")
    command, option = words
    given = ["--set", "A=1,2", "--jobs", "1"] if command == "sweep" else []
    ended = ssilang(command, str(tmp_path / "d.ssi"), *given, option, str(tmp_path / "round"))
    assert ended.code == (0 if option == "--allow" else 2 if command == "sweep" else 1)
    assert option == "--allow" or "round" in ended.err


def test_a_sweep_writes_no_results_that_lead_elsewhere(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "d.ssi").write_text("A = 1. ;")
    (tmp_path / "results").symlink_to(tmp_path / "elsewhere")
    assert main(["sweep", "d.ssi", "--set", "A=1,2"]) == 2
    assert "results is a link to another place" in capsys.readouterr().err
    assert list((tmp_path / "elsewhere").iterdir()) == []
