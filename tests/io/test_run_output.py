"""Where a run may read and write, and the list of its files."""

from __future__ import annotations

from pathlib import Path

import pytest

from ssilang.io.run_output import RunOutput


@pytest.fixture
def output(tmp_path: Path) -> RunOutput:
    (tmp_path / "deck").mkdir()
    return RunOutput(tmp_path / "results" / "case", tmp_path / "deck")


def test_files_are_written_below_the_output_folder_only(output: RunOutput, tmp_path: Path) -> None:
    assert output.target("a/b.csv") == tmp_path / "results" / "case" / "a" / "b.csv"
    assert output.target("../b.csv") is None
    assert output.target("/etc/passwd") is None
    assert output.target(str(tmp_path / "deck" / "b.csv")) is None


def test_a_link_does_not_lead_outside(output: RunOutput, tmp_path: Path) -> None:
    output.directory.mkdir(parents=True)
    (output.directory / "out").symlink_to(tmp_path)
    assert output.target("out/x.csv") is None


def test_files_are_read_beside_the_script_or_from_the_output(output: RunOutput) -> None:
    (output.inputs / "in.csv").write_text("1")
    assert output.source("in.csv") == output.inputs / "in.csv"
    assert output.source("../secret.csv") is None
    assert output.source("/etc/passwd") is None


def test_what_the_run_wrote_is_preferred(output: RunOutput) -> None:
    (output.inputs / "x.txt").write_text("old")
    target = output.target("x.txt")
    assert target is not None
    output.add_lines("SORT", target, ["new"])
    found = output.source("x.txt")
    assert found is not None
    assert found.read_text() == "new\n"


def test_an_allowed_folder_may_be_read_and_written(tmp_path: Path) -> None:
    other = tmp_path / "other"
    output = RunOutput(tmp_path / "r", tmp_path, (other,))
    assert output.target(str(other / "x.csv")) == other / "x.csv"


def test_a_file_of_another_case_is_found(output: RunOutput) -> None:
    other = output.directory.parent / "before"
    other.mkdir(parents=True)
    (other / "mesh.sauv").write_text("kept")
    assert output.source("mesh.sauv") == output.inputs / "mesh.sauv"  # not a folder of results
    (other / "summary.json").write_text("{}")
    assert output.source("mesh.sauv") == other / "mesh.sauv"


def test_lines_are_gathered_and_written_whole(output: RunOutput) -> None:
    target = output.target("log.txt")
    assert target is not None
    for i in range(1000):
        output.add_lines("SORT", target, [f"line {i}"])
    output.close()
    assert target.read_text().splitlines() == [f"line {i}" for i in range(1000)]
    assert output.files == [target]
    assert [p.name for p in target.parent.iterdir()] == ["log.txt"]


def test_naming_the_file_again_begins_it_anew(output: RunOutput) -> None:
    target = output.target("log.txt")
    assert target is not None
    output.add_lines("SORT", target, ["first"])
    output.reopen("SORT")
    assert target.read_text() == "first\n"
    output.add_lines("SORT", target, ["second"])
    output.close()
    assert target.read_text() == "second\n"
