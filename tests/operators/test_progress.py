"""The progress line of long loops."""

import io
import re

from ssilang.cli.sweeping import sweep
from ssilang.messages.message import teller
from ssilang.operators.session import progress
from ssilang.operators.session.progress import ProgressLine


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_silent_when_not_a_terminal(monkeypatch):
    monkeypatch.setattr(progress, "PATIENCE", 0.0)
    stream = io.StringIO()
    line = ProgressLine("X", teller("en"), stream)
    line.note("starting")
    line(1, 2)
    line(2, 2)
    line.close()
    assert stream.getvalue() == ""


def test_time_left_does_not_count_what_came_before_the_first_report(monkeypatch):
    clock = iter([0.0, 100.0, 101.0, 102.0])
    monkeypatch.setattr(progress.time, "monotonic", lambda: next(clock))
    stream = Terminal()
    line = ProgressLine("X", teller("en"), stream)
    line(10, 40)
    line(20, 40)
    line(30, 40)
    shown = stream.getvalue().split("\r")
    assert "10/40" in shown[1]
    assert "left" not in shown[1]
    assert "20/40, 2 s left" in shown[2]
    assert "30/40, 1 s left" in shown[3]
    line.close()
    assert stream.getvalue().endswith(" \r")


def test_runs_of_a_sweep_are_counted_as_they_end(monkeypatch):
    for name in ("PATIENCE", "REFRESH"):
        monkeypatch.setattr(progress, name, 0.0)
    rows, stream = [{"run": 2}, {"run": 1}], Terminal()
    assert list(sweep._progress(iter(rows), 5, teller("fr"), stream)) == rows
    assert re.findall(r"\r(\w+) \[.*?\] (\d)/5", stream.getvalue()) == [
        ("calculs", "1"),
        ("calculs", "2"),
    ]
    assert stream.getvalue().endswith(" \r")


def test_nothing_shows_in_the_first_two_seconds():
    stream = Terminal()
    line = ProgressLine("X", teller("en"), stream)
    line(1, 10)
    line.close()
    assert stream.getvalue() == ""
