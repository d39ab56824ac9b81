"""The interactive session: statements typed one after the other, errors that leave it alive.

Lines are read by prompt_toolkit when it is installed, else by readline, else by input().
"""

import contextlib
import importlib
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from ssilang import __version__
from ssilang.cli.interactive import UNFINISHED, listed, run_shown
from ssilang.cli.run import RunOptions, execute, make_session
from ssilang.cli.terminal.loop_progress import follow_loops
from ssilang.cli.terminal.screen import coloured, show
from ssilang.language.run.jumps import StopRun
from ssilang.language.run.session import Session
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Source
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.language.values import Mot, type_of
from ssilang.messages.message import visible
from ssilang.operators.texts.words import written

if TYPE_CHECKING:
    from ssilang.cli.editor.complete import Candidate

Complete = Callable[[str], tuple[str, list[str]]]
Ask = Callable[[str], str]
HISTORY_LENGTH = 5000


def history_file() -> Path:
    """Where typed lines are kept between sessions."""
    base = Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state")
    return base / "ssilang" / "history"


def line_editor(complete: Complete) -> Ask:
    """A function that shows a prompt and returns a line (EOFError, KeyboardInterrupt)."""
    try:
        history_file().parent.mkdir(parents=True, exist_ok=True)
        kept = True
    except OSError:
        kept = False
    try:
        return _toolkit(complete, kept)
    except ImportError:
        return _readline(complete, kept)


def _toolkit(complete: Complete, kept: bool) -> Ask:
    from prompt_toolkit import PromptSession
    from prompt_toolkit.completion import Completer, Completion
    from prompt_toolkit.history import FileHistory, InMemoryHistory

    class Candidates(Completer):
        def get_completions(self, document: Any, complete_event: Any) -> "Iterator[Completion]":
            prefix, found = complete(document.text_before_cursor)
            for word in found:
                yield Completion(word, start_position=-len(prefix))

    history = FileHistory(str(history_file())) if kept else InMemoryHistory()
    session: PromptSession[str] = PromptSession(
        history=history, completer=Candidates(), complete_while_typing=False
    )
    return session.prompt


def _readline(complete: Complete, kept: bool) -> Ask:
    try:
        readline: Any = importlib.import_module("readline")
    except ImportError:  # Windows without an emulation
        return input
    readline.set_completer_delims(" \t\n;()=")
    readline.parse_and_bind("tab: complete")

    def candidate(word: str, state: int) -> str | None:
        line = readline.get_line_buffer()[: readline.get_endidx()]
        prefix, found = complete(line)
        kept_part = word[: len(word) - len(prefix)]
        return kept_part + found[state] if state < len(found) else None

    readline.set_completer(candidate)
    if kept:
        import atexit

        path = history_file()
        with contextlib.suppress(OSError):  # the first session has none
            readline.read_history_file(path)
        readline.set_history_length(HISTORY_LENGTH)
        atexit.register(readline.write_history_file, path)
    return input


def completions(text: str, session: Session) -> tuple[str, list[str]]:
    """Candidates for the end of `text`.

    Returns
    -------
    tuple
        The part of `text` that a candidate replaces, and the candidates, sorted.
    """
    # vocabulary and elements are read at the first Tab, not when the session begins
    from ssilang.cli.editor.complete import candidates
    from ssilang.cli.editor.document import Document
    from ssilang.operators.loader import load_operators

    load_operators()
    document = Document.of(text, None, session.library.standard_names)
    found = candidates(document, len(text), session.library, session.language, session)
    prefix = text[found[0].start :] if found else ""
    typed = prefix.lstrip("'").upper()
    words = {_written(c, prefix) for c in found}
    return prefix, sorted(w for w in words if w.lstrip("'").upper().startswith(typed))


def _written(candidate: "Candidate", prefix: str) -> str:
    """A candidate as it is typed: keywords need no quotes where none was opened."""
    bare = candidate.kind in ("keyword", "word") and candidate.label.isidentifier()
    return candidate.label if bare and prefix[:1] != "'" else candidate.text


class Repl:
    """One interactive session over a `Session`.

    Parameters
    ----------
    ask : function
        Shows a prompt, returns a line; raises EOFError at the end of the input.
    out : text stream
        Where the session prints.
    """

    def __init__(self, session: Session, ask: Ask, out: TextIO) -> None:
        self.session = session
        self.ask = ask
        self.out = out
        self.kept: list[str] = []  # statements that ran, for %save
        self.pending = ""
        self._count = 0
        self._commands: dict[str, Callable[[str], None]] = {
            "%help": lambda _: self._say("cli.commands"),
            "%vars": self._variables,
            "%save": self._save,
            "%run": self._run_file,
            "%quit": self._quit,
        }
        session.on_warning = self._report
        follow_loops(session, sys.stderr)

    def loop(self) -> None:
        """Read and run until FIN, %quit or the end of the input."""
        while True:
            try:
                line = self.ask("... " if self.pending else "ssi> ")
            except KeyboardInterrupt:
                self.pending = ""
                self.out.write("\n")
                continue
            except EOFError:
                if self.pending.strip():
                    self._parse_and_run(self.pending, last=True)
                return
            if not self.feed(line):
                return

    def feed(self, line: str) -> bool:
        """Take one typed line; False when the session is to end."""
        if not self.pending and line.lstrip().startswith("%"):
            return self._command(line.strip())
        self.pending += line + "\n"
        if not self.pending.strip():
            self.pending = ""
            return True
        return self._parse_and_run(self.pending)

    def _command(self, line: str) -> bool:
        name, _, rest = line.partition(" ")
        action = self._commands.get(name.lower())
        if action is None:
            self._say("cli.no-such-command", name=name)
            return True
        return self._guarded(lambda: action(rest.strip().strip("'\"")))

    # ---- statements --------------------------------------------------------------------------

    def _parse_and_run(self, text: str, last: bool = False) -> bool:
        self._count += 1
        source = Source(f"<{self._count}>", text)
        try:
            script = parse(source)
        except SeveralErrors as several:
            if not last and {e.code for e in several.errors} <= UNFINISHED:
                self._count -= 1
                return True  # the statement goes on in the next line
            self.pending = ""
            for error in several.errors:
                self._report(error)
            return True
        self.pending = ""
        return self._guarded(lambda: self._run_nodes(script.body), text)

    def _guarded(self, action: Callable[[], None], text: str = "") -> bool:
        """Do something that may fail: the session survives; False after FIN."""
        session = self.session
        session.was_interrupted()  # Ctrl-C at the prompt is over
        session.evaluator.current_span = None  # nothing of this line has run
        try:
            action()
        except StopRun:
            return False
        except KeyboardInterrupt:
            self._say("cli.session-goes-on")
        except SeveralErrors as several:
            for error in several.errors:
                self._report(error)
        except SsiError as error:
            error.span = error.span or session.evaluator.current_span
            self._report(error)
        else:
            self.kept += text.rstrip("\n").split("\n") if text else []
        finally:
            session.frame = session.root
            self.out.flush()
        return True

    def _run_nodes(self, nodes: tuple[tree.Node, ...]) -> None:
        run_shown(self.session, nodes, self._show, lambda text: show(text, self.out))

    def _show(self, value: object) -> None:
        self.out.write(visible(listed(self.session, value)) + "\n")

    def _report(self, error: SsiError) -> None:
        names = self.session.frame.names() | self.session.library.standard_names
        text = render(error, self.session.language, names)
        self.out.write(coloured(text, self.out) + "\n")

    def _say(self, code: str, /, **data: object) -> None:
        self.out.write(self.session.told(code, **data) + "\n")

    # ---- commands ----------------------------------------------------------------------------

    def _quit(self, _: str) -> None:
        raise StopRun

    def _variables(self, _: str) -> None:
        for name, value in sorted(self.session.root.variables.items()):
            short = written(value) if isinstance(value, bool) else value
            shown = f" {short}" if isinstance(value, bool | int | float | Mot) else ""
            self.out.write(visible(f"{name:<24} {type_of(value)}{shown}") + "\n")

    def _save(self, path: str) -> None:
        if not path:
            self._say("cli.file-name-wanted", name="%save")
            return
        try:
            Path(path).write_text("\n".join(self.kept) + "\n", encoding="utf-8")
        except OSError as problem:
            self.out.write(f"{path}: {problem.strerror}\n")
            return
        self._say("cli.lines-saved", count=len(self.kept), path=path)

    def _run_file(self, path: str) -> None:
        if not path:
            self._say("cli.file-name-wanted", name="%run")
            return
        execute(self.session, read_source(Path(path)))


def start(options: RunOptions) -> int:
    """Open a fresh interactive session; returns the exit code."""
    return interact(make_session(Source("session", ""), options, sys.stdout), greet=True)


def interact(session: Session, greet: bool = False) -> int:
    """Go on interactively with a session; returns the exit code."""
    person = sys.stdin.isatty()
    ask = line_editor(lambda text: completions(text, session)) if person else _next_line
    repl = Repl(session, ask, sys.stdout)
    if greet and person:
        repl._say("cli.welcome", version=__version__)
    repl.loop()
    return 0


def _next_line(_: str) -> str:
    """The next line of an input that is no terminal."""
    line = sys.stdin.readline()
    if not line:
        raise EOFError
    return line.rstrip("\n")
