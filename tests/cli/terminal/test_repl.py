"""The interactive session, fed with lines: all that it prints, asks, keeps."""

import atexit
import io
import sys
from types import SimpleNamespace

import pytest

from ssilang.cli.run import RunOptions, make_session
from ssilang.cli.terminal import repl
from ssilang.language.registry import OPERATORS
from ssilang.language.text.source import Source

STOP = KeyboardInterrupt
ASK, MORE = "ssi> ", "... "


class Typed:
    """A session to which lines are typed; KeyboardInterrupt stands for Ctrl-C."""

    def __init__(self, folder, language="en") -> None:
        self.out = io.StringIO()
        options = RunOptions(output_directory=folder, language=language)
        session = make_session(Source("session", ""), options, self.out)
        self.lines: list[str | type[BaseException]] = []
        self.prompts: list[str] = []
        self.repl = repl.Repl(session, self._next, self.out)

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


DIVISION = "error: division by zero\n  --> <{0}>:1:5\n  |\n1 | y = 1 / 0 ;\n  |     ^^^^^\n"
UNREAD = "the file no.ssi cannot be read: no such file or folder\n"


@pytest.mark.parametrize(
    ("lines", "out", "prompts", "kept"),
    [
        (["x = 1 ;", "MESS (x + 1) ;"], "2\n", [ASK] * 3, "x = 1 ;|MESS (x + 1) ;"),
        (["MESS", "  'two lines'", ";"], "two lines\n", [ASK, MORE, MORE, ASK],
         "MESS|  'two lines'|;"),
        (["REPE b 2 ;", "MESS &b ;", "", "FIN b ;"], "1\n2\n", [ASK, MORE, MORE, MORE, ASK],
         "REPE b 2 ;|MESS &b ;||FIN b ;"),
        (["3 + 4 ;", "", "  ", "x = 12 ;", " x ;"], "Integer of value: 7\nInteger of value: 12\n",
         [ASK] * 6, "3 + 4 ;|x = 12 ;| x ;"),
        (["x = 5 ;", "y = 1 / 0 ;", "MESS x ;"], DIVISION.format(2) + "5\n", [ASK] * 4,
         "x = 5 ;|MESS x ;"),
        (["MESS", "'a' ;", "y = 1 / 0 ;"], "a\n" + DIVISION.format(2), [ASK, MORE, ASK, ASK],
         "MESS|'a' ;"),
        (["x = ) ;", "MESS 'alive' ;"], "error 2: this closing parenthesis has no opening one\n"
         "  --> <1>:1:5\n  |\n1 | x = ) ;\n  |     ^\nalive\n", [ASK] * 3, "MESS 'alive' ;"),
        (["MESS 'never", STOP, "MESS 'kept' ;"], "\nkept\n", [ASK, MORE, ASK, ASK],
         "MESS 'kept' ;"),
        (["FIN ;", "MESS 'not reached' ;"], "", [ASK], ""),
        (["%QUIT", "MESS 'not reached' ;"], "", [ASK], ""),
        (["x = 1"], "error: the last statement does not end with ;\n  --> <1>:1:1\n  |\n"
         "1 | x = 1\n  | ^^^^^\n", [ASK, MORE], ""),
        (["MESS", "'end' ;", "%what it"],
         "end\nthere is no command %what; %help lists them\n", [ASK, MORE, ASK, ASK],
         "MESS|'end' ;"),
        (["x = 1 ;", "%run no.ssi"], "error: " + UNREAD, [ASK] * 3, "x = 1 ;"),
        (["%run", "%save", "%save no/such/folder.ssi", "x = 1 ;"],
         "%run needs a file's name\n%save needs a file's name\n"
         "no/such/folder.ssi: No such file or directory\n", [ASK] * 5, "x = 1 ;"),
    ],
)  # fmt: skip
def test_what_is_printed_asked_and_kept(typed, lines, out, prompts, kept):
    assert typed.type(*lines) == out
    assert typed.prompts == prompts
    assert "|".join(typed.repl.kept) == kept


def test_files_are_run_and_written(typed, tmp_path):
    """What a file does is not kept: the script that is saved says %run no more."""
    part, kept = tmp_path / "part.ssi", tmp_path / "kept.ssi"
    part.write_text("x = 9 ;\n")
    out = typed.type(f"%run '{part}'", "MESS x ;", "y = 1 / 0 ;", "z = 2 ;", f"%save {kept}")
    assert out == f"9\n{DIVISION.format(2)}2 lines written to {kept}\n"
    assert kept.read_text() == "MESS x ;\nz = 2 ;\n"


def test_objects_and_commands_are_listed_in_both_languages(tmp_path):
    french = Typed(tmp_path / "out", "fr")
    line = "b = 'mot' ; a = VRAI ; k = 2 ; f = 1.5 ; p = PROG 1. ; t = TABL ;"
    out = french.type(line, "%vars", "%help", "1 / 0 ;").split("\n")
    own = [row.split() for row in out if row and row[0] in "ABFKPT" and row[:2] not in ("FA", "PI")]
    assert own == [
        ["A", "LOGIQUE", "VRAI"], ["B", "MOT", "mot"], ["F", "FLOTTANT", "1.5"],
        ["K", "ENTIER", "2"], ["P", "LISTREEL"], ["T", "TABLE"],
    ]  # fmt: skip
    assert any(row.split() == ["%help", "cette", "liste"] for row in out)
    assert "erreur : division par zéro" in out
    assert "Syntaxe" in french.type("INFO PROG ;")
    assert "Syntaxe" not in Typed(tmp_path / "out").type("INFO PROG ;")


def test_an_error_inside_a_procedure_returns_to_the_top(typed):
    typed.type("DEBP P ; inner = 1 ; z = 1 / 0 ; FINP ;", "P ;", "x = 3 ;")
    session = typed.repl.session
    assert session.frame is session.root
    assert session.root.find("X") == 3
    assert session.root.find("INNER") is None


def test_control_c_while_running_keeps_the_session(typed, monkeypatch):
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


def offered(text: str) -> tuple[str, list[str]]:
    """What stands for a library of names."""
    prefix = text.split(" ")[-1]
    return prefix, [w for w in ("'ALPHA'", "ALP2", "ALP1") if w.startswith(prefix)]


def test_readline_gets_candidates_and_history(monkeypatch, tmp_path):
    """Where no prompt_toolkit is."""
    line, calls, left = "MESS AL", dict[str, object](), []
    names = ("set_completer_delims", "parse_and_bind", "set_completer", "set_history_length",
             "read_history_file")  # fmt: skip
    fake = SimpleNamespace(**{n: lambda value, n=n: calls.__setitem__(n, value) for n in names})
    fake.get_line_buffer, fake.get_endidx = lambda: line + " + 1", lambda: len(line)
    fake.write_history_file = object()
    monkeypatch.setitem(sys.modules, "prompt_toolkit", None)
    monkeypatch.setitem(sys.modules, "readline", fake)
    monkeypatch.setattr(atexit, "register", lambda *args: left.append(args))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert repl.line_editor(offered) is input
    found = calls["set_completer"]
    assert [found("AL", i) for i in range(3)] == ["ALP2", "ALP1", None]
    line = "MESS "
    assert [found("", i) for i in range(4)] == ["'ALPHA'", "ALP2", "ALP1", None]
    line = "T . 'AL"
    assert found("'AL", 0) == "'ALPHA'"
    assert calls["read_history_file"] == left[0][1] == tmp_path / "ssilang/history"
    assert left[0][0] is fake.write_history_file
    assert calls["set_history_length"] == 5000
    monkeypatch.delenv("XDG_STATE_HOME")
    monkeypatch.setattr("pathlib.Path.home", lambda: tmp_path)
    assert repl.history_file() == tmp_path / ".local/state/ssilang/history"
    monkeypatch.setenv("XDG_STATE_HOME", "/dev/null")  # nothing can be kept
    calls.clear()
    assert repl.line_editor(offered) is input
    assert "read_history_file" not in calls
    assert len(left) == 1


def test_the_toolkit_replaces_what_was_typed_of_a_word():
    toolkit = pytest.importorskip("prompt_toolkit")
    ask = repl._toolkit(offered, kept=False)
    document = toolkit.document.Document("MESS AL")
    found = list(ask.__self__.completer.get_completions(document, None))
    assert [(c.text, c.start_position) for c in found] == [("ALP2", -2), ("ALP1", -2)]
