"""The program on a real terminal: keys, Ctrl-C, completion, paging, the progress line."""

import sys

import pytest

if sys.platform == "win32":
    pytest.skip("pseudo-terminals are POSIX", allow_module_level=True)

from tests.cli.pseudo_terminal import Terminal

PROMPT = r"ssi>\s*"


@pytest.fixture
def terminal(tmp_path):
    """An interactive session behind its first prompt."""
    with Terminal(folder=tmp_path) as opened:
        opened.wait_for(PROMPT)
        yield opened


def test_typed_lines_completion_and_save(terminal, tmp_path):
    terminal.type("X1 = 40 +\n")
    terminal.wait_for(r"\.\.\.")
    terminal.type("2 ;\n")
    terminal.wait_for(PROMPT)
    terminal.type("TAB1 = TABL ; TAB1 . 'ALPHA' = X1 ;\n")
    terminal.wait_for(r";[\r\n]+" + PROMPT)
    terminal.type("TAB1 . AL")
    terminal.press_until("\t", "'ALPHA'")
    terminal.type(" ;\n")
    terminal.wait_for("of value: 42")
    terminal.type("%save kept.ssi\n")
    terminal.wait_for("kept.ssi[^\n]*\n.*" + PROMPT)
    terminal.type("FIN ;\n")
    assert terminal.exit_code() == 0
    assert (tmp_path / "kept.ssi").read_text().startswith("X1 = 40 +\n2 ;\n")


def test_ctrl_c_stops_what_runs_and_keeps_the_session(terminal):
    terminal.type("A1 = 7 ; MESS 'begun' ; REPE B1 ; C1 = 1 ; FIN B1 ;\n")
    terminal.wait_for("begun\r")  # a key before would end the line, and nothing would run
    terminal.press_until("\x03", "interrupted")
    terminal.type("OPTI DIME 2 ELEM QUA4 ; P1 = 0. 0. ; P2 = 1. 0. ; L1 = DROI 100 P1 P2 ;\n")
    # in the middle of one long call of an operator, in compiled code
    terminal.type("S1 = L1 TRAN 800 (0. 1.) ; MESS 'made' ; T1 = INVE S1 ;\n")
    terminal.wait_for("made\r")
    terminal.type("MESS 'again' ; REPE B2 ; T1 = T1 ET (S1 PLUS (1. 0.)) ; FIN B2 ;\n")
    terminal.wait_for("again\r")
    terminal.press_until("\x03", "interrupted")
    terminal.type("MESS 'still' A1 ;\n")
    terminal.wait_for("still7")


def test_long_help_is_paged(tmp_path):
    with Terminal(folder=tmp_path, plain=False) as opened:
        opened.wait_for(PROMPT)
        opened.type("INFO EVOL ;\n")
        opened.wait_for("--More--")
        opened.type("q")
        opened.wait_for(PROMPT)


def test_a_long_loop_says_where_it_is_and_is_wiped_before_text(tmp_path):
    text = "REPE B1 2 ; T0 = 0 ; REPE B2 ; T0 = T0 + 1 ;\n"
    text += "SI (T0 > 100000000) ; QUIT B2 ; FINSI ; FIN B2 ; FIN B1 ;\n"
    (tmp_path / "long.ssi").write_text(text)
    with Terminal("long.ssi", folder=tmp_path) as opened:
        opened.wait_for(r"B1 1/2 > B2 \d+, \d s")
        opened.type("\x03")
        opened.wait_for("interrupted")
        # the terminal itself shows ^C, before what is wiped or behind it
        assert opened.raw_before("error").replace("^C", "").endswith("\r\x1b[K")
        assert opened.exit_code() == 1


def test_the_session_stays_open_after_a_deck(tmp_path):
    (tmp_path / "deck.ssi").write_text("X1 = 3 ;\n")
    with Terminal("-i", "deck.ssi", folder=tmp_path) as opened:
        opened.wait_for(PROMPT)
        opened.type("MESS 'kept' X1 ;\n")
        opened.wait_for("kept3")
        opened.type("FIN ;\n")
        assert opened.exit_code() == 0
