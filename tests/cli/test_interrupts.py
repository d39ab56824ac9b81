"""Ctrl-C that a library swallows, and output that nobody reads any more."""

import ctypes
import io
import json
import os
import signal
import subprocess
import sys

import pytest

from ssilang.cli import interrupts, main
from ssilang.cli.run import RunOptions, make_session
from ssilang.language.text.source import Source

ANYWHERE = """
import sys
from ssilang.cli import interrupts
inside = []
def look(frame, event, argument):
    if not inside:
        inside.append(1)
        try:
            interrupts.interrupt(2, None)
        except KeyboardInterrupt:
            pass
        finally:
            inside.clear()
    return look
sys.settrace(look)
for _ in range(3):
    interrupts.take()
with interrupts.holding():
    pass
sys.settrace(None)
print(interrupts.take(), interrupts.take())
"""


def test_a_signal_may_arrive_at_any_line_of_those_that_ask_for_it():
    """A lock in the handler would wait for ever for the one that it broke into."""
    done = subprocess.run(
        [sys.executable, "-c", ANYWHERE], capture_output=True, text=True, timeout=30, check=False
    )
    assert done.stdout == "True False\n", done.stderr


posix = pytest.mark.skipif(os.name != "posix", reason="signals of one system")


def interrupted_in_compiled_code():
    """Ctrl-C arrives where compiled code calls Python back: no exception gets out of there."""
    ctypes.CFUNCTYPE(None)(lambda: signal.raise_signal(signal.SIGINT))()


def fails_over_it():
    interrupted_in_compiled_code()
    raise RuntimeError("no compiled object yet")


@pytest.mark.parametrize("action", [interrupted_in_compiled_code, fails_over_it])
def test_an_interruption_that_a_library_swallows_stops_the_run(action, tmp_path, capsys):
    session = make_session(Source("deck", ""), RunOptions(tmp_path), io.StringIO())
    with interrupts.listening(), pytest.raises(KeyboardInterrupt):
        session.evaluator.guarded(action, None, "RESO")
    assert capsys.readouterr().err == ""  # no "exception ignored"
    assert not interrupts.take()
    assert session.evaluator.guarded(lambda: 3, None, "RESO") == 3  # the next one runs


def test_an_interruption_is_seen_once(tmp_path):
    session = make_session(Source("deck", ""), RunOptions(tmp_path), io.StringIO())
    with interrupts.listening(), pytest.raises(KeyboardInterrupt):
        session.evaluator.guarded(lambda: signal.raise_signal(signal.SIGINT), None, "RESO")
    assert not interrupts.take()


def test_handlers_of_signals_are_put_back():
    before = signal.getsignal(signal.SIGINT), sys.unraisablehook
    with interrupts.listening():
        assert signal.getsignal(signal.SIGINT) is not before[0]
    assert (signal.getsignal(signal.SIGINT), sys.unraisablehook) == before


def first_line_alone(folder, *words: str, merged: bool = False, **environment: str):
    """Run `ssilang WORDS`, read one line of what it prints and close the pipe."""
    command = [sys.executable, "-m", "ssilang.cli.main", *words]
    to = subprocess.STDOUT if merged else subprocess.PIPE
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=to, env={**os.environ, **environment}
    ) as process:
        first = process.stdout.readline()
        process.stdout.close()
        told = b"" if merged else process.stderr.read()
        return process.wait(60), first, told


@posix
@pytest.mark.parametrize("unbuffered", ["1", ""])
@pytest.mark.parametrize("merged", [False, True])
def test_a_run_whose_reader_left_ends_without_a_word(tmp_path, unbuffered, merged):
    deck = "OPTI SORT 'a.txt' ; SORT 'CHAI' 'kept' ; REPE B 100000 ; MESS 'l' &B ; FIN B ;\n"
    (tmp_path / "deck.ssi").write_text(deck)
    code, first, told = first_line_alone(
        tmp_path, "deck.ssi", merged=merged, PYTHONUNBUFFERED=unbuffered
    )
    assert (code, first, told) == (interrupts.ENDED_BY_CLOSED_PIPE, b"l1\n", b"")
    out = tmp_path / "results" / "deck"
    assert (out / "a.txt").read_text() == "kept\n"  # what was written is whole
    summary = json.loads((out / "summary.json").read_text())
    assert [e["code"] for e in summary["errors"]] == ["reader-left"]


@posix
def test_errors_that_nobody_reads_do_not_keep_the_summary_from_being_written(tmp_path):
    (tmp_path / "deck.ssi").write_text("MESS 'a' ;\n" + "X = 1 / 2 ;\n" * 5000 + "Y = 1 / 0 ;\n")
    first_line_alone(tmp_path, "deck.ssi", merged=True)
    assert (tmp_path / "results" / "deck" / "summary.json").exists()


@posix
def test_help_whose_reader_left_ends_without_a_word(tmp_path):
    code, first, told = first_line_alone(tmp_path, "help", PYTHONUNBUFFERED="1")
    assert first
    assert told == b""
    assert code in (0, interrupts.ENDED_BY_CLOSED_PIPE)  # it may have been done already


@pytest.mark.parametrize("command", ["run", "check", "help"])
def test_an_interruption_while_the_program_starts_is_told_in_a_line(command, monkeypatch, capsys):
    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setitem(main._ACTIONS, command, interrupted)
    assert main.main([command, "deck.ssi"]) == 1
    assert capsys.readouterr().err == "error: interrupted\n"
