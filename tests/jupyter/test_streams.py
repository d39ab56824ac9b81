"""What a session in a notebook prints: few messages, and one line of progress."""

import pytest

from ssilang.cli.terminal.loop_progress import LoopProgress
from ssilang.jupyter.kernel import SentProgress, SentText
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
    clock = iter((0.0, 1.0, 3.0, 3.5, 3.6, 8.0))  # patience 2 s, a line each 0.2 s
    monkeypatch.setattr("ssilang.cli.terminal.loop_progress.time.monotonic", lambda: next(clock))
    shown = []
    loops = LoopProgress(SentProgress(shown.append), teller("en"))
    loops.enter("A", 5)
    loops.turn(1)
    loops.turn(2)
    loops.enter("B", None)
    loops.turn(7)
    loops.leave()
    loops.turn(3)
    loops.leave()
    nested = ["A 2/5 > B 7, 14 s left", "", "A 3/5, 12 s left", ""]
    assert shown == ["A 2/5, 12 s left", "", *nested]


def test_a_cell_has_one_display_of_progress_that_is_written_anew():
    pytest.importorskip("ipykernel")
    from ssilang.jupyter.kernel import GibianeKernel

    class Kernel(GibianeKernel):
        """Its messages, without a notebook."""

        def __init__(self):
            self.sent = []
            self._silent, self._progress_in, self.execution_count = False, -1, 4

        def send_response(self, stream, kind, content):
            self.sent.append((kind, content["transient"]["display_id"], content["data"]))

    kernel = Kernel()
    for line in ("", "DYNAMIC 1/4", "", "DYNAMIC 2/4", ""):
        kernel._show_progress(line)
    kinds, names, data = zip(*kernel.sent, strict=True)
    assert kinds == ("display_data", *["update_display_data"] * 3)
    assert set(names) == {"progress-4"}
    assert [d["text/plain"] for d in data] == ["DYNAMIC 1/4", "", "DYNAMIC 2/4", ""]
