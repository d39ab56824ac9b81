"""`--resume`: processes that were killed, checkpoints that belong elsewhere."""

import io
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest
from script_runs import HOPPING

from ssilang.cli.main import main
from ssilang.operators.dynamics.checkpoints import KeptCalculation

posix = pytest.mark.skipif(os.name != "posix", reason="signals of one system")

SHORT = HOPPING.format(dt=1e-3, end=0.1, every=10, steps=20)
LONG = HOPPING.format(dt=1e-3, end=3.0, every=300, steps=200)


def end_behind(path, *words, step=0, hook="reached"):
    """Run a deck that is ended once a step was reached, or when all have."""
    reached = getattr(KeptCalculation, hook)

    def end(self, done, state):
        reached(self, done, state)
        if done >= step:
            raise KeyboardInterrupt

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(KeptCalculation, hook, end)
        assert main([str(path), *words]) == 1


@pytest.fixture
def case(tmp_path, monkeypatch, capsys):
    """Path of a deck in the working folder, whose calculation was ended behind a checkpoint."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "case.ssi"
    path.write_text(SHORT)
    end_behind(path, step=60)
    assert (tmp_path / "results" / "case" / "checkpoints" / "1.state").is_file()
    path.with_name("told.txt").write_text(capsys.readouterr().err)
    return path


def said(capsys) -> str:
    return capsys.readouterr().err


def test_who_ends_a_run_is_told_how_to_go_on(case, capsys):
    told = case.with_name("told.txt").read_text()
    assert "step 60 of 100, t = 0.06, is kept in" in told
    assert "--resume" in told
    assert main([str(case), "--resume"]) == 0
    assert "goes on behind step 60 of 100" in said(capsys)
    assert not (case.parent / "results" / "case" / "checkpoints").exists()


def test_who_ends_a_run_behind_its_last_step_is_told_too(tmp_path, capsys):
    deck, out = tmp_path / "case.ssi", ["--out", str(tmp_path / "out")]
    deck.write_text(SHORT)
    end_behind(deck, *out, hook="finished")
    assert "is kept in" in said(capsys)
    assert main([str(deck), *out, "--resume"]) == 0
    assert "its 100 steps are given back" in said(capsys)


def test_a_checkpoint_of_another_deck_is_refused(case, capsys):
    case.write_text(SHORT.replace("1.E7", "2.E7"))
    for words, sentence in (((), "belong to another deck"), (("--lang", "fr"), "autre jeu")):
        assert main([str(case), "--resume", *words]) == 1
        told = said(capsys)
        assert sentence in told
        assert "--resume" in told
    case.write_text(SHORT)  # it was refused before anything was touched
    assert main([str(case), "--resume"]) == 0
    assert "goes on behind step 60" in said(capsys)


@pytest.mark.parametrize(
    ("other", "told"),
    [
        (None, ["other parameters", "PAS1=2"]),
        (("ssilang.cli.run.__version__", "9.9.9"), ["written by ssilang 0.1.0, this is 9.9.9"]),
        (("ssilang.io.checkpoint.VERSION", 99), ["were written by ssilang"]),
        (("ssilang.operators.dynamics.checkpoints.digest_of", lambda problem: "another"),
         ["checkpoint of calculation 1"]),
    ],
)  # fmt: skip
def test_a_checkpoint_of_something_else_is_refused(case, capsys, monkeypatch, other, told):
    """Of other parameters, another version, another format, another calculation."""
    if other:
        monkeypatch.setattr(*other)
    assert main([str(case), "--resume", *([] if other else ["--set", "PAS1=2"])]) == 1
    found = said(capsys)
    assert [part for part in told if part not in found] == []


@pytest.mark.parametrize(
    ("name", "damaged"),
    [
        ("1.state", lambda data: b""),
        ("1.state", lambda data: b"PK\x05\x06" + 18 * b"\0"),
        ("1.state", lambda data: b"no zip"),
        ("1.rows", lambda data: data[:-8]),
    ],
)
def test_a_damaged_checkpoint_is_refused(case, capsys, name, damaged):
    path = case.parent / "results" / "case" / "checkpoints" / name
    path.write_bytes(damaged(path.read_bytes()))
    assert main([str(case), "--resume"]) == 1
    assert "cannot be read as a checkpoint" in said(capsys)


def test_what_was_written_behind_the_last_checkpoint_does_not_count(case, capsys):
    folder = case.parent / "results" / "case"
    with (folder / "checkpoints" / "1.rows").open("ab") as stream:
        stream.write(b"half of a row")
    assert main([str(case), "--resume"]) == 0
    found = (folder / "dynamic.csv").read_bytes()
    assert main([str(case), "--out", "truth"]) == 0
    assert (case.parent / "truth" / "dynamic.csv").read_bytes() == found


def test_without_a_checkpoint_the_run_begins_at_its_start(case, capsys):
    shutil.rmtree(case.parent / "results" / "case" / "checkpoints")
    assert main([str(case), "--resume"]) == 0
    assert "holds no checkpoint" in said(capsys)


def test_a_run_from_the_start_replaces_the_checkpoints_of_the_one_before(case, capsys):
    said(capsys)
    assert main([str(case)]) == 0
    assert "goes on behind" not in said(capsys)
    assert not (case.parent / "results" / "case" / "checkpoints").exists()


READS = "OPTI ACQU 'k.txt' ; ACQU K1*FLOTTANT ;\n" + SHORT.replace("1.E7", "K1")


def test_a_checkpoint_of_a_run_that_read_other_files_is_refused(case, capsys):
    values = case.parent / "k.txt"
    values.write_text("1.E7\n")
    case.write_text(READS)
    end_behind(case)
    values.write_text("2.E7\n")
    said(capsys)
    assert main([str(case), "--resume"]) == 1
    told = said(capsys)
    assert "read other files" in told
    assert "k.txt" in told
    values.write_text("1.E7\n")
    assert main([str(case), "--resume"]) == 0


@pytest.mark.parametrize(
    ("entry", "reason"),
    [
        ("T . 'REDUCTION' = 1.E-3", "error of the basis"),
        ("T . 'CHARMECA' = VRAI", "script's procedure"),
        ("T . 'REPRISE' . 'PAS' = 0", "'REPRISE' . 'PAS' is 0"),
        ("T . 'REPRISE' . 'MINUTES' = -1.", "'REPRISE' . 'MINUTES' is -1"),
    ],
)
def test_what_cannot_be_kept_is_refused_with_its_reason(entry, reason, tmp_path, capsys):
    path = tmp_path / "case.ssi"
    procedure = "DEBP CHARMECA T1*TABLE X1*FLOTTANT ; R1 = TABL ; FINP R1 ;\n"
    path.write_text(procedure + SHORT.replace("T2 = ", f"{entry} ; T2 = "))
    assert main([str(path), "--out", str(tmp_path / "out")]) == 1
    assert reason in said(capsys)


def started(deck: Path, out: Path, *words: str) -> subprocess.Popen:
    command = [sys.executable, "-m", "ssilang.cli.main", str(deck), "--out", str(out), *words]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def files_of(out: Path) -> dict[str, bytes]:
    found = (p for p in out.rglob("*") if p.is_file() and p.name != "summary.json")
    return {p.relative_to(out).as_posix(): p.read_bytes() for p in found}


def wait_for(path: Path, process: subprocess.Popen) -> None:
    while not path.is_file():
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)


@posix
def test_processes_that_are_killed_go_on_to_the_same_files(tmp_path):
    deck, draw = tmp_path / "case.ssi", random.Random(3)
    deck.write_text(LONG)
    assert started(deck, tmp_path / "truth").wait() == 0
    truth = files_of(tmp_path / "truth")
    assert len(truth) > 10
    for number in (signal.SIGKILL, signal.SIGTERM):
        out = tmp_path / f"out{draw.random()}"
        process = started(deck, out)
        wait_for(out / "checkpoints" / "1.state", process)
        time.sleep(draw.uniform(0.0, 0.3))
        process.send_signal(number)
        _, told = process.communicate()
        assert process.returncode != 0 or not (out / "checkpoints").exists()  # which end with it
        kept = (out / "checkpoints" / "1.state").is_file()  # not if it was killed at its very end
        ended = b" files in " in told
        if process.returncode == 1 and kept and not ended:  # told to end before its end
            assert b"is kept in" in told
        again = started(deck, out, "--resume")
        _, told = again.communicate()
        assert again.returncode == 0, told
        if kept:
            assert b"goes on behind step" in told or b"given back" in told
        assert files_of(out) == truth


def state_of(case):
    """Head of the first checkpoint with its arrays, and what writes them back."""
    path = case.parent / "results" / "case" / "checkpoints" / "1.state"
    with zipfile.ZipFile(path) as file:
        parts = {name: file.read(name) for name in file.namelist()}

    def write(head, arrays=None):
        with zipfile.ZipFile(path, "w") as made:
            for name, content in parts.items():
                found = json.dumps(head).encode() if name == "head.json" else content
                if arrays is not None and name != "head.json":
                    buffer = io.BytesIO()
                    np.save(buffer, arrays(np.load(io.BytesIO(content))))
                    found = buffer.getvalue()
                made.writestr(name, found)

    return json.loads(parts["head.json"]), write


HEADS = {
    "no state": {"state": {}},
    "a list for the state": {"state": [1, 2]},
    "words for the state": {"state": {"own": "x", "held": "x"}},
    "a number for the call": {"call": 3},
    "lists in the call": {"call": {"files": [None], "arithmetic": [None]}},
    "no batches": {"batches": 0, "length": 0, "sum": 0},
}
ARRAYS = {
    "shorter": lambda x: x.ravel()[:1],
    "of another rank": lambda x: x[None],
    "words": lambda x: x.astype("U9"),
    "no numbers": lambda x: x * np.nan if x.dtype.kind == "f" else x,
}


@pytest.mark.parametrize("how", HEADS)
def test_a_head_that_is_none_of_this_calculation_is_refused(case, capsys, how):
    head, write = state_of(case)
    write(head | HEADS[how])
    assert main([str(case), "--resume"]) == 1
    told = said(capsys)
    assert "run without --resume" in told
    assert "defect" not in told


@pytest.mark.parametrize("how", ARRAYS)
def test_arrays_that_are_none_of_this_calculation_are_refused(case, capsys, how):
    head, write = state_of(case)
    write(head, ARRAYS[how])
    assert main([str(case), "--resume"]) == 1
    told = said(capsys)
    assert "does not fit this calculation" in told
    assert "defect" not in told


def test_names_that_a_solver_does_not_keep_are_not_set(case, capsys):
    head, write = state_of(case)
    loop = head["state"]["own"]["loops"][0]
    loop["remembers"]["__class__"] = {"advance": [1], "prepare": [1], "memory": [1]}
    write(head)
    assert main([str(case), "--resume"]) == 0
    assert "goes on behind step 60 of 100" in said(capsys)


def test_a_state_that_unpacks_is_refused_unread(case, capsys):
    path = case.parent / "results" / "case" / "checkpoints" / "1.state"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("head.json", b" " * 2**24 + b"{}")
    assert main([str(case), "--resume"]) == 1
    assert "bytes that unpack" in said(capsys)


@posix
@pytest.mark.parametrize("name", ["1.state", "2.state", "1.rows"])
def test_a_pipe_for_a_checkpoint_is_not_waited_for(case, name):
    path = case.parent / "results" / "case" / "checkpoints" / name
    path.unlink(missing_ok=True)
    os.mkfifo(path)
    words = [sys.executable, "-m", "ssilang.cli.main", str(case), "--resume"]
    ended = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
    assert ended.returncode == 1
    assert "cannot be read as a checkpoint" in ended.stderr


@posix
@pytest.mark.parametrize("words", [(), ("--resume",)])
def test_a_link_for_the_folder_of_checkpoints_removes_nothing_elsewhere(case, capsys, words):
    folder = case.parent / "results" / "case" / "checkpoints"
    elsewhere = folder.rename(case.parent / "elsewhere")
    before = {path.name: path.read_bytes() for path in elsewhere.iterdir()}
    folder.symlink_to(elsewhere)
    assert main([str(case), *words]) == 1
    assert "is a link to another place" in said(capsys)
    assert {path.name: path.read_bytes() for path in elsewhere.iterdir()} == before


@posix
def test_a_link_for_the_folder_of_the_report_gets_nothing(case, capsys):
    elsewhere = case.parent / "elsewhere"
    elsewhere.mkdir()
    (case.parent / "results" / "case" / "report").symlink_to(elsewhere)
    case.write_text("MESS 1 ;")
    assert main([str(case), "--report"]) == 1
    assert "is a link to another place" in said(capsys)
    assert not list(elsewhere.iterdir())
