"""Streams that are closed or full, folders that go away, signals, names that cannot be."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time

import pytest
from script_runs import failed

from ssilang.cli import interrupts

pytestmark = pytest.mark.skipif(os.name != "posix", reason="shells and signals of one system")
needs_full = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")

FINE = "MESS 'hello' ; OPTI SORT 'a.txt' ; SORT 'CHAI' 'kept' ;"
WRONG = "MESS 'hello' ;\nX = 1 / 0 ;"
LONG = "OPTI SORT 'a.txt' ; SORT 'CHAI' 'kept' ; MESS 'begun' ;\nREPE B ;\nX = 1 + 1 ;\nFIN B ;\n"


@pytest.fixture
def shell(tmp_path):
    """Runs a command line of a shell in which $S is ssilang; gives code, output, messages."""
    (tmp_path / "fine.ssi").write_text(FINE)
    (tmp_path / "wrong.ssi").write_text(WRONG)

    def run(command: str):
        program = f"{sys.executable} -m ssilang.cli.main"
        made = subprocess.run(
            ["sh", "-c", command], cwd=tmp_path, env={**os.environ, "S": program},
            capture_output=True, text=True, timeout=100, check=False,
        )  # fmt: skip
        assert "Traceback" not in made.stderr
        assert "Exception ignored" not in made.stderr
        return made.returncode, made.stdout, made.stderr

    return run


def summary(folder, name="fine"):
    return json.loads((folder / "results" / name / "summary.json").read_text())


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        ("fine.ssi >&-", "the stream is closed"),
        *(
            pytest.param(f"{command} >/dev/full", "no space is left", marks=needs_full)
            for command in ("fine.ssi", "help DROI", "check wrong.ssi")
        ),
    ],
)
def test_a_stream_that_takes_nothing_of_what_is_printed_is_an_error(
    shell, tmp_path, command, reason
):
    code, _, told = shell(f"$S {command}")
    assert code == 1
    assert told.startswith(f"error: what is printed cannot be written: {reason}")
    if "fine" in command:
        left = summary(tmp_path)
        assert ([e["code"] for e in left["errors"]], left["exit_code"]) == (["cannot-print"], 1)


def test_a_closed_stream_that_nothing_is_printed_to_is_none(shell, tmp_path):
    (tmp_path / "silent.ssi").write_text("X = 1 ;")
    assert shell("$S silent.ssi >&- 2>&-") == (0, "", "")


@needs_full
def test_messages_that_cannot_be_shown_are_in_the_summary(shell, tmp_path):
    assert shell("$S wrong.ssi 2>/dev/full") == (1, "hello\n", "")
    assert [e["code"] for e in summary(tmp_path, "wrong")["errors"]] == ["arithmetic"]
    assert shell("$S wrong.ssi >&- 2>&-") == (1, "", "")


def test_a_working_folder_that_is_gone_is_told(shell):
    code, out, told = shell("mkdir gone && cd gone && rmdir ../gone && $S ../fine.ssi")
    assert (code, out) == (2, "")
    assert told.startswith("error: the working folder was removed\n")


def test_a_deck_s_name_that_no_file_can_have_is_told(shell):
    code, _, told = shell("$S " + "a" * 300 + ".ssi")
    assert code == 2
    assert "the name is too long" in told


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="names there are characters")
@pytest.mark.parametrize("command", ["", "--report"])
def test_a_name_that_is_no_utf_8_is_shown_with_a_mark(shell, tmp_path, command):
    with open(os.fsencode(tmp_path) + b"/n\xff.ssi", "w", encoding="ascii") as file:
        file.write(WRONG)
    code, _, told = shell(f"$S run n*.ssi --out results/n {command}")
    assert (code, "Traceback" in told) == (1, False)
    assert summary(tmp_path, "n")["deck"].endswith("n?.ssi")
    if command:
        page = (tmp_path / "results" / "n" / "report.html").read_text(encoding="utf-8")
        assert "n?.ssi" in page
        assert "Damaged" not in page


def test_a_word_that_fills_the_memory_is_told(shell, tmp_path):
    (tmp_path / "large.ssi").write_text("X = CHAI '" + "b" * (6 * 10**7) + "' ;")
    code, _, told = shell("$S large.ssi --max-memory 150")
    assert code == 1
    assert told.startswith("error: large.ssi needs more memory than there is")


@pytest.mark.parametrize("name", ["b" * 300, "b\0c", "@" + "b" * 300])
@pytest.mark.parametrize(
    "statement", ["OPTI SORT '{}' ; SORT 'CHAI' 'x' ;", "T = LIRE 'CSV' '{}' ;", "X = 1 + {} ;"]
)
def test_names_that_no_file_can_have_are_refused_in_words(name, statement, tmp_path):
    result = failed(statement.format(name), tmp_path)
    assert "internal" not in [e.code for e in result.errors]


def test_a_procedure_beside_the_script_is_no_link_out_of_its_folder(tmp_path):
    from ssilang.cli.run import RunOptions, run_file

    deck, private = tmp_path / "deck", tmp_path / "private"
    deck.mkdir()
    private.mkdir()
    (private / "secret.ssi").write_text("DEBP @OUT ; FINP 3 ;")
    (deck / "deck.ssi").write_text("X = @OUT ;")
    (deck / "@out.ssi").symlink_to(private / "secret.ssi")
    result = run_file(deck / "deck.ssi", RunOptions(tmp_path / "out"))
    assert [e.code for e in result.errors] == ["forbidden-path"]
    options = RunOptions(tmp_path / "out", allowed=[private])
    assert run_file(deck / "deck.ssi", options).session.root.find("X") == 3
    (deck / "@out.ssi").unlink()
    (deck / "@out.ssi").write_text("DEBP @OUT ; FINP 4 ;")
    result = run_file(deck / "deck.ssi", RunOptions(tmp_path / "out"))
    assert result.session.root.find("X") == 4


# ---- runs that meet or end


def heeding():
    """Heed signals, also where the tests run in the background or under nohup."""
    for name in (signal.SIGHUP, signal.SIGINT):
        signal.signal(name, signal.SIG_DFL)


STARTED: list[subprocess.Popen] = []


@pytest.fixture(autouse=True)
def no_run_is_left_behind():
    """A test that fails leaves no run that goes on for ever."""
    yield
    while STARTED:
        process = STARTED.pop()
        if process.poll() is None:
            process.kill()
            process.wait()


def started(folder, *before):
    """A run that goes on for ever, when it has begun."""
    (folder / "long.ssi").write_text(LONG)
    command = [*before, sys.executable, "-u", "-m", "ssilang.cli.main", "long.ssi"]
    process = subprocess.Popen(
        command,
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=heeding,
    )
    STARTED.append(process)
    assert process.stdout.readline() == "begun\n"
    return process


@pytest.mark.parametrize("name", ["SIGHUP", "SIGTERM", "SIGINT"])
def test_a_signal_to_end_writes_files_and_summary(name, tmp_path):
    process = started(tmp_path)
    process.send_signal(getattr(signal, name))
    _, told = process.communicate(timeout=60)
    assert process.returncode == 1
    assert told.startswith("error: interrupted")
    assert [e["code"] for e in summary(tmp_path, "long")["errors"]] == ["interrupted"]
    assert (tmp_path / "results" / "long" / "a.txt").read_text() == "kept\n"
    assert not (tmp_path / "results" / "long" / ".running").exists()


def test_a_hangup_that_is_ignored_is_ignored_still():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with interrupts.listening():
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        with interrupts.listening():
            assert signal.getsignal(signal.SIGHUP) is interrupts.interrupt
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_DFL
    finally:
        signal.signal(signal.SIGHUP, before)


def test_a_second_run_into_the_same_folder_is_refused_until_the_first_ends(shell, tmp_path):
    first = started(tmp_path)
    try:
        code, out, told = shell("$S fine.ssi --out results/long")
        assert (code, out) == (1, "")
        assert f"process {first.pid} on " in told
        assert not (tmp_path / "results" / "long" / "summary.json").exists()
    finally:
        first.kill()
        first.communicate(timeout=60)
    part = tmp_path / "results" / "long" / ".x.vtu.abcdefgh.part"
    part.write_text("half")
    assert shell("$S fine.ssi --out results/long")[:2] == (0, "hello\n")
    assert not part.exists()
    assert not (tmp_path / "results" / "long" / ".running").exists()


def test_a_removed_output_folder_ends_the_run_without_a_series_of_missing_files(tmp_path):
    deck = (
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (1. 0.) ; OPTI SORT 'one' ;\n"
        "REPE B 100000 ; SORT 'VTK ' L 'TEMP' (FLOT &B) ; SI (&B EGA 3) ; MESS 'begun' ; FINSI ;\n"
        "FIN B ;\n"
    )
    (tmp_path / "deck.ssi").write_text(deck)
    process = subprocess.Popen(
        [sys.executable, "-u", "-m", "ssilang.cli.main", "deck.ssi"], cwd=tmp_path,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout.readline() == "begun\n"
    out = tmp_path / "results" / "deck"
    for _ in range(100):  # the run writes while it is removed
        shutil.rmtree(out, ignore_errors=True)
        if process.poll() is not None:
            break
        time.sleep(0.02)
    _, told = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "was removed or exchanged during the run" in told
    assert not (out / "one.pvd").exists()
