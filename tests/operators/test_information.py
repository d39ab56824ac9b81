"""INFO, NOTI, AIDE, SOUC, DATE; the progress line of long loops."""

import io
import re
import time
from datetime import datetime
from types import SimpleNamespace

from script_runs import ran
from together import together

from ssilang.cli.run import execute, run_text
from ssilang.cli.sweeping import sweep
from ssilang.language.text.source import Source
from ssilang.messages.message import teller
from ssilang.operators.session import clock, progress
from ssilang.operators.session.progress import ProgressLine


def test_info_prints_the_page_in_the_language_of_the_session(tmp_path):
    assert "\nSyntax\n" in ran("INFO PROG ;", tmp_path).output
    assert "Syntaxe" in ran("OPTI 'LANG' 'FRAN' ; INFO PROG ;", tmp_path).output


def test_info_of_a_procedure(tmp_path):
    assert "VERIFIE" in ran("INFO @VERIFIE ;", tmp_path).output


def test_noti_lists_operators_and_procedures(tmp_path):
    output = ran("NOTI GIBI ;", tmp_path).output
    assert "  DROI " in output
    assert "  @VERIFIE" in output


def test_aide_finds_operators_by_a_text_of_their_help(tmp_path):
    found = ran("L1 = AIDE 'factorial' ;", tmp_path).session.root.find("L1")
    assert found.values == ["FACTORIE"]
    assert len(ran("L1 = AIDE 'no such text' ;", tmp_path).session.root.find("L1")) == 0


def test_factorie(tmp_path):
    root = ran("A = FACTORIE 0 ; B = FACTORIE 6 ;", tmp_path).session.root
    assert (root.find("A"), root.find("B")) == (1, 720)
    assert run_text("A = FACTORIE -1 ;", output_directory=tmp_path).exit_code == 1


def test_vertytab(tmp_path):
    ran("T = TABL ; T . 'X' = 1. ; VERTYTAB T 'X' 'FLOTTANT' ;", tmp_path)
    for bad in ("VERTYTAB T 'Y' 'FLOTTANT'", "VERTYTAB T 'X' 'ENTIER'"):
        result = run_text(f"T = TABL ; T . 'X' = 1. ; {bad} ;", output_directory=tmp_path)
        assert result.errors[0].code.startswith("stdlib.vertytab-")


def test_calls_of_operators_are_counted_from_zero_on(tmp_path):
    text = (
        "L = PROG 1. ; TEMP 'ZERO' ; L = PROG 1. 2. ; REPE B 3 ; M = LECT 1 ; FIN B ; "
        "T = TEMP 'NOEC' ; TEMP 'IMPR' 'APPE' ; X = T . 'TEMPS_CPU' . 'INITIAL' ;"
    )
    result = ran(text, tmp_path)
    calls = result.session.root.find("T").get("APPELS")
    assert [calls.get(n).values.tolist() for n in ("PROG", "LECT")] == [[1], [3]]
    counts = [line.split() for line in result.output.splitlines()]
    assert counts == [["PROG", "1"], ["TEMP", "2"], ["LECT", "3"]]
    assert result.session.root.find("X") >= 0


def test_processor_time_counts_from_the_start_of_the_process(tmp_path):
    before = time.process_time()
    used = ran("X = TEMP 'CPU' ;", tmp_path).session.root.find("X") / 1000.0
    assert before - 1e-3 <= used <= time.process_time() + 1e-3


def test_clocks_count_from_the_start_from_zero_and_from_the_last_call(monkeypatch, tmp_path):
    session = ran("", tmp_path).session
    wall, cpu = iter([2.0, 2.5, 3.0, 10.0, 10.5, 12.0]), iter([1.0, 5.0, 7.0, 7.2, 7.5, 9.0])
    ticks = {"perf_counter": lambda: session.started + next(wall), "process_time": cpu.__next__}
    monkeypatch.setattr(clock, "time", SimpleNamespace(**ticks))
    said = "A = TEMP 'HORL' ; B = TEMP 'CPU' ; TEMP 'ZERO' ; C = TEMP 'HORL' ; D = TEMP 'CPU' ;"
    execute(session, Source("said", said + " T = TEMP 'NOEC' ;"))
    assert [session.root.find(n) for n in "ABCD"] == [2000, 5000, 7000, 500]
    table = [session.root.find("T").get(n) for n in ("TEMPS_HORLOGE", "TEMPS_CPU")]
    assert [(t.get("INITIAL"), t.get("DERNIER_APPEL")) for t in table] == [
        (12000, 1500), (9000, 1500)
    ]  # fmt: skip


def test_assi_runs_the_phrase_that_follows(tmp_path):
    text = "N = 2 ; X = ASSI N PROG 1. 2. ; A B = 'ASSI' 1 (MAXI X) (MINI X) ; LIST A ; LIST B ;"
    lines = ran(text, tmp_path).output.split("\n")
    assert [float(line.split(":")[1]) for line in lines if "value" in line] == [2.0, 1.0]


SLAVES = (
    "T = TABL 'ESCLAVE' ; T . 1 = PROG 3. -4. ; T . 3 = PROG 5. ; U = TABL 'ESCLAVE' ; "
    "U . 3 = PROG 7. ; U . 1 = PROG 1. 2. ; "
)


@together(
    "phrase, values",
    [
        ("X = ASSI 'TOUS' MAXI T 'ABS' ;", {1: 4.0, 3: 5.0}),
        ("X = 'ASSI' TOUS 'MAXI' 'ABS' T ;", {1: 4.0, 3: 5.0}),
        ("DEBP P A*LISTREEL ; FINP (MAXI A) (MINI A) ; X Y = ASSI 'TOUS' P T ;", {1: 3.0, 3: 5.0}),
        ("DEBP P A*LISTREEL ; FINP (MAXI A) (MINI A) ; Y X = ASSI 'TOUS' P T ;", {1: -4.0, 3: 5.0}),
    ],
)
def test_assi_runs_a_phrase_for_all_objects_of_a_table(phrase, values, tmp_path):
    result = ran(SLAVES + phrase, output_directory=tmp_path)
    found = result.session.root.find("X")
    assert found.subtype == "ESCLAVE"
    assert {i: v for i, v in found.items() if i != "SOUSTYPE"} == values


@together("month, word", [(3, "mars"), (8, "août"), (12, "décembre")])
def test_date_tells_the_month_in_letters(month, word, monkeypatch, tmp_path):
    now = SimpleNamespace(now=lambda: datetime(2024, month, 9, 7, 5))
    monkeypatch.setattr(clock, "datetime", now)
    root = ran("M = DATE 'MOIS' 'LETT' ; D = DATE 'LETT' ;", tmp_path).session.root
    assert (root.find("M"), root.find("D").rstrip()) == (word, f"9 {word} 2024 - 07H05min")


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


def test_other_steps_are_counted_anew(monkeypatch):
    """And one that comes a little late from another thread is not the first of others."""
    clock = iter([0.0, 100.0, 101.0, 102.0, 200.0, 202.0])
    monkeypatch.setattr(progress.time, "monotonic", lambda: next(clock))
    stream = Terminal()
    line = ProgressLine("X", teller("en"), stream)
    for done, total in ((1, 40), (31, 40), (29, 40), (1, 10), (3, 10)):
        line(done, total)
    shown = stream.getvalue().split("\r")
    assert "29/40, 1 s left" in shown[3]
    assert "left" not in shown[4]
    assert "3/10, 7 s left" in shown[5]


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
