"""The interactive session, fed with lines."""

from __future__ import annotations

import io

import pytest

from ssilang.cli.run import RunOptions, make_session
from ssilang.cli.terminal.repl import Repl
from ssilang.language.text.source import Source


class Typed:
    """A session to which lines are typed; KeyboardInterrupt stands for Ctrl-C."""

    def __init__(self, folder) -> None:
        self.out = io.StringIO()
        session = make_session(Source("session", ""), RunOptions(output_directory=folder), self.out)
        self.lines: list[str | type[BaseException]] = []
        self.prompts: list[str] = []
        self.repl = Repl(session, self._next, self.out)

    def _next(self, prompt: str) -> str:
        self.prompts.append(prompt)
        if not self.lines:
            raise EOFError
        line = self.lines.pop(0)
        if isinstance(line, str):
            return line
        raise line

    def type(self, *lines: str | type[BaseException]) -> str:
        self.lines += lines
        before = len(self.out.getvalue())
        self.repl.loop()
        return self.out.getvalue()[before:]


@pytest.fixture
def typed(tmp_path):
    return Typed(tmp_path / "out")


def test_variables_live_from_line_to_line(typed):
    assert typed.type("x = 1 ;", "MESS (x + 1) ;") == "2\n"


def test_a_statement_may_span_lines(typed):
    assert typed.type("MESS", "  'two lines'", ";") == "two lines\n"
    assert typed.prompts[:3] == ["ssi> ", "... ", "... "]


def test_a_block_runs_when_it_is_closed(typed):
    out = typed.type("REPE b 2 ;", "MESS &b ;", "FIN b ;")
    assert out == "1\n2\n"


def test_a_value_is_shown(typed):
    assert "7" in typed.type("3 + 4 ;")
    assert "12" in typed.type("x = 12 ;", "x ;")


def test_an_error_keeps_the_session(typed):
    out = typed.type("x = 5 ;", "y = 1 / 0 ;", "MESS x ;")
    assert "division by zero" in out
    assert out.endswith("5\n")


def test_a_syntax_error_keeps_the_session(typed):
    out = typed.type("x = ) ;", "MESS 'alive' ;")
    assert "parenthesis" in out
    assert out.endswith("alive\n")


def test_an_error_inside_a_procedure_returns_to_the_top(typed):
    typed.type("DEBP P ; inner = 1 ; z = 1 / 0 ; FINP ;", "P ;", "x = 3 ;")
    session = typed.repl.session
    assert session.frame is session.root
    assert session.root.find("X") == 3
    assert session.root.find("INNER") is None


def test_control_c_while_typing_forgets_the_line(typed):
    out = typed.type("MESS 'never", KeyboardInterrupt, "MESS 'kept' ;")
    assert out.strip() == "kept"


def test_control_c_while_running_keeps_the_session(typed, monkeypatch):
    from ssilang.language.registry import OPERATORS

    def interrupted(call):
        raise KeyboardInterrupt

    form = OPERATORS["PROG"].forms[0]
    monkeypatch.setattr(OPERATORS["PROG"], "_choices", None)  # what earlier runs gathered
    monkeypatch.setattr(OPERATORS["PROG"], "_meant", {})
    monkeypatch.setattr(
        OPERATORS["PROG"], "forms", [type(form)(form.entries, interrupted, form.injected)]
    )
    out = typed.type("x = 1 ;", "y = PROG 1. ;", "MESS x ;")
    assert "interrupted" in out
    assert out.endswith("1\n")


def test_fin_and_quit_leave(typed):
    assert typed.type("FIN ;", "MESS 'not reached' ;") == ""
    typed.lines.clear()
    assert typed.type("%quit", "MESS 'not reached' ;") == ""


def test_info_shows_help(typed):
    assert "Syntax" in typed.type("INFO PROG ;")


def test_save_writes_what_ran(typed, tmp_path):
    path = tmp_path / "kept.ssi"
    typed.type("x = 1 ;", "y = 1 / 0 ;", "z = 2 ;", f"%save {path}")
    assert path.read_text() == "x = 1 ;\nz = 2 ;\n"


def test_save_into_a_folder_that_is_not_there(typed, tmp_path):
    out = typed.type("x = 1 ;", f"%save {tmp_path}/no/such/folder.ssi", "MESS 'alive' ;")
    assert out.endswith("alive\n")


def test_run_a_file(typed, tmp_path):
    (tmp_path / "part.ssi").write_text("x = 9 ;\n")
    assert typed.type(f"%run {tmp_path}/part.ssi", "MESS x ;").endswith("9\n")
    assert "cannot be read" in typed.type("%run nothing.ssi")


def test_vars_and_unknown_commands(typed):
    out = typed.type("n = 4 ;", "%vars", "%what")
    assert "N                        ENTIER 4" in out
    assert "%what" in out


def test_unfinished_input_at_the_end_is_reported(typed):
    assert "does not end with ;" in typed.type("x = 1")
