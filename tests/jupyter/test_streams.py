"""What a session in a notebook prints: few messages, and one line of progress."""

from ssilang.cli.terminal.loop_progress import LoopProgress
from ssilang.jupyter.streams import SentProgress, SentText
from ssilang.messages.message import teller
from ssilang.operators.session.progress import ProgressLine


def test_texts_are_gathered_and_none_is_lost():
    sent = []
    stream = SentText(sent.append)
    for i in range(1000):
        stream.write(f"{i}\n")
    stream.flush()
    assert "".join(sent) == "".join(f"{i}\n" for i in range(1000))
    assert len(sent) < 100


def test_progress_is_one_line_that_goes_away(monkeypatch):
    monkeypatch.setattr("ssilang.operators.session.progress.PATIENCE", 0.0)
    monkeypatch.setattr("ssilang.operators.session.progress.REFRESH", 0.0)
    shown = []
    line = ProgressLine("DYNAMIC", teller("en"), SentProgress(shown.append))
    line(1, 4)
    line(2, 4)
    line.close()
    assert [text.split("]")[-1].split(",")[0].strip() for text in shown] == ["1/4", "2/4", ""]
    assert shown[0].startswith("DYNAMIC [")


def test_loops_too(monkeypatch):
    monkeypatch.setattr("ssilang.cli.terminal.loop_progress.PATIENCE", 0.0)
    monkeypatch.setattr("ssilang.cli.terminal.loop_progress.REFRESH", 0.0)
    shown = []
    loops = LoopProgress(SentProgress(shown.append), teller("en"))
    loops.enter("B", 3)
    loops.turn(1)
    loops.turn(2)
    loops.leave()
    assert [text.split(",")[0] for text in shown] == ["B 1/3", "", "B 2/3", ""]
