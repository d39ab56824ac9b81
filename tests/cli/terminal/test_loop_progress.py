"""The line that says where loops are, against a clock and a terminal of the test's own."""

import io

import pytest

from ssilang.cli.run import RunOptions, run_source
from ssilang.cli.terminal import loop_progress
from ssilang.cli.terminal.loop_progress import LoopProgress, _Wiping
from ssilang.language.text.source import Source

GONE = "\r\x1b[K"


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(loop_progress.time, "monotonic", lambda: now[0])
    return now


def _told(code, **data):
    assert code == "operators.session.time-left"
    return f"{data['seconds']:g} left"


def test_a_line_after_patience_and_not_more_often_than_it_is_read(clock):
    out = io.BytesIO()
    stream = io.TextIOWrapper(out, write_through=False)  # holds back what is not flushed
    progress = LoopProgress(stream, _told)
    progress.enter("OUT", 10)
    shown = []
    for time, number in ((100.5, 1), (101.9, 2), (102.0, 3), (102.1, 4), (102.25, 6)):
        clock[0] = time
        progress.turn(number)
        shown.append(out.getvalue().decode())
    assert shown[:2] == ["", ""]
    assert shown[2] == "\rOUT 3/10, 8 left"  # two turns in 2 s: eight are to come
    assert shown[3] == shown[2]  # a tenth of a second after the last
    assert shown[4] == shown[3] + GONE + "\rOUT 6/10, 2.25 left"  # as many are to come as are done


def test_inner_loops_stand_behind_and_the_line_goes_with_the_outermost(clock):
    stream = io.StringIO()
    progress = LoopProgress(stream, _told)
    progress.enter("OUT", None)
    progress.turn(2)
    clock[0] = 103.0
    progress.enter("IN", 7)
    progress.turn(1)
    assert stream.getvalue() == "\rOUT 2 > IN 1/7, 3 s"
    progress.leave()
    assert not stream.getvalue().endswith(GONE)
    progress.leave()
    assert stream.getvalue().endswith(GONE)
    before = stream.getvalue()
    progress.wipe()
    assert stream.getvalue() == before


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize("end", ["FIN A ;", "FIN A ; x = 1 / 0 ;", "y = 1 / 0 ; FIN A ;"])
def test_loops_that_are_left_by_any_way_are_named_no_more(clock, monkeypatch, tmp_path, end):
    monkeypatch.setattr(loop_progress, "PATIENCE", -1.0)
    monkeypatch.setattr(loop_progress, "REFRESH", -1.0)
    monkeypatch.setenv("TERM", "xterm")
    script = "REPE A 2 ; REPE B 3 ; SI (&B > 1) ; QUIT B ; FINS ; FIN B ; REPE C 1 ; FIN C ; "
    options, terminal = RunOptions(output_directory=tmp_path), Terminal()
    run_source(Source("script", script + end), options, io.StringIO(), terminal)
    shown, _, told = terminal.getvalue().rpartition(GONE)
    lines = [line.partition(",")[0] for line in shown.replace(GONE, "").split("\r")[1:]]
    turns = [
        f"A {i}/2{inner}" for i in (1, 2) for inner in ("", " > B 1/3", " > B 2/3", " > C 1/1")
    ]
    assert lines == (turns[:4] if end.startswith("y") else turns)
    assert ("error" in told) == ("1 / 0" in end)


def test_a_text_takes_the_line_away_first(clock):
    stream, out = io.StringIO(), io.StringIO()
    progress = LoopProgress(stream, _told)
    progress.enter("OUT", 2)
    clock[0] = 110.0
    progress.turn(1)
    assert stream.getvalue() == "\rOUT 1/2, 10 s"  # no turn is done: no rate is known
    assert _Wiping(out, progress).write("told\n") == 5
    assert stream.getvalue().endswith(GONE)
    assert out.getvalue() == "told\n"
