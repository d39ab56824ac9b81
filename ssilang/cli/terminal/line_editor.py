"""Reading lines from a person: prompt_toolkit when it is installed, else readline, else input()."""

from __future__ import annotations

import contextlib
import importlib
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

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
        def get_completions(self, document: Any, complete_event: Any) -> Iterator[Completion]:
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
        _readline_history(readline)
    return input


def _readline_history(readline: Any) -> None:
    import atexit

    path = history_file()
    with contextlib.suppress(OSError):  # the first session has none
        readline.read_history_file(path)
    readline.set_history_length(HISTORY_LENGTH)
    atexit.register(readline.write_history_file, path)
