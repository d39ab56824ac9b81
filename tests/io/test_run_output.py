"""Where a run may read and write, and the list of its files."""

import json
import os
import shutil
import socket
from pathlib import Path
from types import SimpleNamespace

import pytest
from refusing import refusal

from ssilang.io import run_output
from ssilang.io.errors import OutputError
from ssilang.io.run_output import RunOutput
from ssilang.messages.message import sentence


@pytest.fixture
def output(tmp_path: Path) -> RunOutput:
    (tmp_path / "deck").mkdir()
    return RunOutput(tmp_path / "results" / "case", tmp_path / "deck")


def test_files_are_written_below_the_output_folder_only(output, tmp_path):
    assert output.target("a/b.csv") == tmp_path / "results" / "case" / "a" / "b.csv"
    assert output.target("../b.csv") is None
    assert output.target("/etc/passwd") is None
    assert output.target(str(tmp_path / "deck" / "b.csv")) is None


def test_a_link_does_not_lead_outside(output, tmp_path):
    output.directory.mkdir(parents=True)
    (output.directory / "out").symlink_to(tmp_path)
    assert output.target("out/x.csv") is None


@pytest.mark.skipif(os.name != "posix", reason="links of one system")
@pytest.mark.parametrize("name", ["results", "results/case"])
def test_a_link_put_there_since_the_look_is_no_folder(output, tmp_path, name):
    (tmp_path / "elsewhere" / "case").mkdir(parents=True)
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).symlink_to(tmp_path / "elsewhere")
    with refusal(OutputError, "io.output-folder-gone"):
        output.hold()
    assert [p for p in (tmp_path / "elsewhere").rglob("*") if p.is_file()] == []


@pytest.mark.skipif(os.name != "posix", reason="links of one system")
def test_a_link_to_the_folder_itself_moved_is_noticed(output, tmp_path):
    """The lock is the same file there: what differs is the way to it."""
    output.hold()
    try:
        (tmp_path / "results").rename(tmp_path / "moved")
        (tmp_path / "results").symlink_to(tmp_path / "moved")
        with refusal(OutputError, "io.output-folder-gone"):
            output.check()
    finally:
        output.release()


def test_files_are_read_beside_the_script_or_from_the_output(output):
    (output.inputs / "in.csv").write_text("1")
    assert output.source("in.csv") == output.inputs / "in.csv"
    assert output.source("../secret.csv") is None
    assert output.source("/etc/passwd") is None
    output.directory.mkdir(parents=True)
    for name in ("in.csv", "left.csv"):  # of an earlier run
        (output.directory / name).write_text("2")
    left, own = output.directory / "left.csv", output.inputs / "in.csv"
    assert [output.source(n) for n in ("left.csv", "in.csv", "left.csv")] == [left, own, left]
    output.wrote(left, output.directory / "b", left)
    assert output.source("left.csv") == left
    assert (output.read, output.files) == ([own, left], [left, output.directory / "b"])


def test_what_the_run_wrote_is_preferred(output):
    (output.inputs / "x.txt").write_text("old")
    target = output.target("x.txt")
    assert target is not None
    output.add_lines("SORT", target, ["new"])
    found = output.source("x.txt")
    assert found is not None
    assert found.read_text() == "new\n"
    assert output.read == []


def test_an_allowed_folder_may_be_read_and_written(tmp_path):
    other = tmp_path / "other"
    output = RunOutput(tmp_path / "r", tmp_path, (other,))
    assert output.target(str(other / "x.csv")) == other / "x.csv"


def test_a_file_of_another_case_is_found(output):
    other = output.directory.parent / "before"
    other.mkdir(parents=True)
    (other / "mesh.sauv").write_text("kept")
    assert output.source("mesh.sauv") == output.inputs / "mesh.sauv"  # not a folder of results
    (other / "summary.json").write_text("{}")
    assert output.source("mesh.sauv") == other / "mesh.sauv"
    for name, age in (("a", 50), ("z", 10), ("m", 30)):
        shutil.copytree(other, other.with_name(name))
        when = other.stat().st_mtime - age
        os.utime(other.with_name(name) / "mesh.sauv", (when, when))
    shutil.rmtree(other)
    assert output.source("mesh.sauv") == other.with_name("z") / "mesh.sauv"  # the latest


def test_a_series_that_another_replaces_is_let_go(output):
    gone: list[str] = []
    first, second, third = (
        SimpleNamespace(base=Path(base), release=lambda name=name: gone.append(name))
        for name, base in (("first", "a"), ("second", "a"), ("third", "b"))
    )
    for series in (first, third, first, second):
        output.keep_series(series)
    assert (gone, [*output.series.values()]) == (["first"], [second, third])


def test_lines_are_gathered_and_written_whole(output):
    target = output.target("log.txt")
    assert target is not None
    for i in range(1000):
        output.add_lines("SORT", target, [f"line {i}"])
    output.close()
    assert target.read_text().splitlines() == [f"line {i}" for i in range(1000)]
    assert output.files == [target]
    assert [p.name for p in target.parent.iterdir()] == ["log.txt"]


def test_naming_the_file_again_begins_it_anew(output):
    target = output.target("log.txt")
    assert target is not None
    output.add_lines("SORT", target, ["first"])
    output.reopen("SORT")
    assert target.read_text() == "first\n"
    output.add_lines("SORT", target, ["second"])
    output.close()
    assert target.read_text() == "second\n"


def test_folders_whose_names_begin_alike_are_others(tmp_path):
    for name in ("deck", "deckhand", "r", "results"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "x.csv").write_text("1")
    output = RunOutput(tmp_path / "r", tmp_path / "deck", (tmp_path / "allow",))
    assert output.source("x.csv") == tmp_path / "deck" / "x.csv"
    for name in ("deckhand", "results"):
        assert output.source(f"../{name}/x.csv") is None
        assert output.source(str(tmp_path / name / "x.csv")) is None
        assert output.target(f"../{name}/y.csv") is None
    assert output.target(str(tmp_path / "allowed" / "y.csv")) is None
    assert output.target(str(tmp_path / "allow" / "y.csv")) == tmp_path / "allow" / "y.csv"


def test_links_in_another_case_s_folder_lead_nowhere(output, tmp_path):
    (tmp_path / "secret.csv").write_text("1")
    (tmp_path / "private").mkdir()
    (tmp_path / "private" / "summary.json").write_text("{}")
    (tmp_path / "private" / "kept.csv").write_text("1")
    before = output.directory.parent / "before"
    before.mkdir(parents=True)
    (before / "summary.json").write_text("{}")
    (before / "x.csv").symlink_to(tmp_path / "secret.csv")
    (before.parent / "linked").symlink_to(tmp_path / "private")
    (before.parent / "third").mkdir()
    (before.parent / "third" / "y.csv").write_text("1")
    (before / "y.csv").symlink_to(before.parent / "third" / "y.csv")
    for name in ("x.csv", "kept.csv", "y.csv"):
        assert output.source(name) == output.inputs / name  # which is not there
    (before / "z.csv").write_text("1")
    assert output.source("z.csv") == before / "z.csv"


@pytest.mark.parametrize("name", ["a" * 300, "a\0b", "loop", "loop/x", "a" * 4096 + "/b"])
def test_names_that_no_file_can_have_are_refused(output, name):
    for folder in (output.directory, output.inputs):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "loop").symlink_to("loop")
    for ask in (output.target, output.source):
        with refusal(OutputError, "io.no-such-place"):
            ask(name)


def test_the_output_folder_is_held_by_one_run(output):
    other = RunOutput(output.directory, output.inputs)
    output.hold()
    with refusal(OutputError, "io.folder-in-use") as refused:
        other.hold()
    assert refused.value.data["pid"] == os.getpid()
    output.release()
    assert list(output.directory.iterdir()) == []
    other.hold()
    other.release()


def test_a_lock_that_its_run_removes_meanwhile_is_made_again(output, monkeypatch):
    path, lock = output.directory / ".running", run_output.lock

    def late(handle):
        path.unlink()
        monkeypatch.setattr(run_output, "lock", lock)
        lock(handle)

    monkeypatch.setattr(run_output, "lock", late)
    output.hold()
    assert json.loads(path.read_text())["pid"] == os.getpid()
    output.release()
    assert not path.exists()


def test_a_folder_that_is_exchanged_is_noticed(output):
    output.hold()
    assert output.target("a.csv") is not None
    shutil.rmtree(output.directory)
    for act in (lambda: output.target("a.csv"), output.close):
        with refusal(OutputError, "io.output-folder-gone"):
            act()
    (other := RunOutput(output.directory, output.inputs)).hold()  # another run makes it again
    with pytest.raises(OutputError):
        output.check()
    output.release()
    assert (output.directory / ".running").exists()  # the other one's
    other.release()


def killed(folder: Path, host: str) -> None:
    """What a killed run leaves."""
    folder.mkdir(parents=True)
    (folder / ".running").write_text(json.dumps({"pid": 4, "host": host}))
    (folder / "sub").mkdir()
    for name in (".a.vtu.abc_1234.part", "sub/.b.csv.12345678.part", "c.part", ".d.part"):
        (folder / name).write_text("half")


def test_what_a_killed_run_left_is_taken_over_and_removed(output):
    killed(output.directory, socket.gethostname())
    below = output.directory / "other"
    below.mkdir()
    (below / ".running").write_text("")  # another run's folder
    (below / ".e.vtu.abc_1234.part").write_text("half")
    output.hold()
    found = {str(p.relative_to(output.directory)) for p in output.directory.rglob("*.part")}
    assert found == {"c.part", ".d.part", "other/.e.vtu.abc_1234.part"}
    output.release()


def test_a_run_of_another_host_is_not_taken_over(output):
    killed(output.directory, "elsewhere")
    with pytest.raises(OutputError) as refused:
        output.hold()
    assert refused.value.data["host"] == "elsewhere"
    assert refused.value.data["elsewhere"] == output.directory / ".running"
    assert (output.directory / ".a.vtu.abc_1234.part").exists()
    (output.directory / ".running").unlink()
    output.hold()
    output.release()


def test_a_lock_that_is_a_link_is_not_followed(output, tmp_path):
    output.directory.mkdir(parents=True)
    (tmp_path / "precious").write_text("text")
    (output.directory / ".running").symlink_to(tmp_path / "precious")
    output.hold()
    output.release()
    assert (tmp_path / "precious").read_text() == "text"


def test_a_folder_that_takes_no_lock_is_used_without(output, tmp_path):
    (tmp_path / "results").write_text("")  # a file where the folder should be
    output.hold()
    assert output.lock is None


def test_files_below_the_run_s_folders_are_its_own(output, tmp_path):
    output = RunOutput(output.directory, output.inputs, (tmp_path / "allowed",))
    for own in (output.directory, output.inputs, tmp_path / "allowed"):
        assert not output.is_foreign(own / "sub" / "x.csv")
    assert output.is_foreign(output.directory.parent / "before" / "x.csv")


@pytest.mark.parametrize(("length", "shown"), [(59, 59), (60, 60), (61, 60)])
def test_a_refused_name_is_shown_up_to_sixty_letters(output, length, shown):
    name = "a" * (length - 2) + "\0"  # which is shown as two letters
    with pytest.raises(OutputError) as refused:
        output.target(name)
    plain = "a" * (length - 2) + "\\0"
    assert refused.value.data["name"] == plain[:shown] + ("..." if shown < length else "")


@pytest.mark.parametrize(("mask", "mode"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_files_have_the_rights_that_the_user_gives(output, mask, mode):
    target = output.target("log.txt")
    assert target is not None
    before = os.umask(mask)
    try:
        output.add_lines("SORT", target, ["text"])
        output.close()
        assert os.umask(mask) == mask  # which is left as it was
    finally:
        os.umask(before)
    assert target.stat().st_mode & 0o777 == mode


def test_what_cannot_be_written_is_told_in_the_reader_s_language(output):
    target = output.target("log.txt")
    assert target is not None
    target.mkdir(parents=True)
    with pytest.raises(OutputError) as refused:
        output.add_lines("SORT", target, ["text"])
    assert sentence("io.cannot-written", refused.value.data).endswith("it is a folder")
    assert sentence("io.cannot-written", refused.value.data, "fr").endswith("c'est un dossier")
