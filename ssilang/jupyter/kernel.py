"""The kernel: cells run in one session; help, completion and pictures as everywhere else.

Protocol: https://jupyter-client.readthedocs.io/en/stable/messaging.html. ipykernel does it; here
stands what is ours.
"""

import contextlib
import io
import os
import re
import sys
import time
from base64 import b64encode
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TextIO, cast

from ipykernel.kernelbase import Kernel

from ssilang import __version__
from ssilang.api.html import html_of
from ssilang.api.result import pictures_of
from ssilang.cli.editor.complete import Candidate, candidates
from ssilang.cli.editor.document import Document
from ssilang.cli.editor.information import Reader
from ssilang.cli.editor.problems import Findings
from ssilang.cli.interactive import UNFINISHED, listed, run_shown
from ssilang.cli.interrupts import listening
from ssilang.cli.run import RunOptions, make_session
from ssilang.cli.terminal.loop_progress import follow_loops
from ssilang.io.run_output import link_to
from ssilang.language.run.jumps import StopRun
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SeveralErrors, SsiError, interruption
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.language.values import type_of
from ssilang.operators.files.outputs import run_output
from ssilang.operators.loader import load_operators

EVERY = 0.1  # seconds between texts that are sent, at least
_CONTROL = re.compile(r"\x1b\[[0-9;]*[A-Za-z]|\r")


class SentText(io.TextIOBase):
    """A stream that sends what is written, gathered for a moment.

    Parameters
    ----------
    send : function
        Sends a text.
    """

    def __init__(self, send: Callable[[str], object]) -> None:
        self._send = send
        self._waiting: list[str] = []
        self._sent = 0.0

    def write(self, text: str) -> int:
        """Take a text."""
        self._waiting.append(text)
        if time.monotonic() - self._sent > EVERY:
            self.flush()
        return len(text)

    def flush(self) -> None:
        """Send what waits."""
        text = "".join(self._waiting)
        self._waiting.clear()
        self._sent = time.monotonic()
        if text:
            self._send(text)


class SentProgress(io.TextIOBase):
    """A terminal of one line, on which loops and calculations say how far they are.

    Parameters
    ----------
    show : function
        Shows a line in place of the one before; '' takes it away.
    """

    def __init__(self, show: Callable[[str], object]) -> None:
        self._show = show
        self._shown = ""

    def isatty(self) -> bool:
        """Yes: lines of progress appear on terminals alone."""
        return True

    def write(self, text: str) -> int:
        """Show a line; one of blanks wipes it."""
        line = _CONTROL.sub("", text).strip()
        if line != self._shown:
            self._shown = line
            self._show(line)
        return len(text)


Reply = dict[str, Any]


class GibianeKernel(Kernel):  # type: ignore[misc]
    """Runs cells in one session.

    Files and pictures go to `results/notebook` in the folder of the notebook.
    """

    implementation = "ssilang"
    implementation_version = __version__
    language_info = {  # noqa: RUF012
        "name": "gibiane",
        "mimetype": "text/x-gibiane",
        "file_extension": ".ssi",
        "pygments_lexer": "text",
        "codemirror_mode": "text",
    }
    banner = f"ssilang {__version__}"
    # one session: no second console whose cells run in a thread beside, no debugger of Python
    control_msg_types = [  # noqa: RUF012
        t for t in Kernel.control_msg_types if "subshell" not in t and t != "debug_request"
    ]

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._silent = False
        self._text = SentText(lambda text: self._stream("stdout", text))
        self._progress = SentProgress(self._show_progress)
        self._progress_in = -1  # the cell that has a line of progress
        options = RunOptions(
            output_directory=Path("results") / "notebook",
            language=os.environ.get("SSILANG_LANGUAGE", "en"),
        )
        self.gibiane = make_session(Source("session", ""), options, cast(TextIO, self._text))
        self.gibiane.on_warning = lambda w: self._stream("stderr", self._told(w) + "\n")
        follow_loops(self.gibiane, cast(TextIO, self._progress))
        self._pictures = 0

    @property
    def kernel_info(self) -> Reply:
        """What a client is told of the kernel, without what it has not."""
        return super().kernel_info | {"supported_features": []}

    # ---- cells ---------------------------------------------------------------------------------

    async def do_execute(self, code: str, silent: bool, *_: Any, **__: Any) -> Reply:
        """Run a cell."""
        self._silent = silent
        source = Source(
            f"cell {self.execution_count}", code if code.endswith("\n") else code + "\n"
        )
        errors = self._errors(source)
        self._text.flush()
        self._show_pictures()
        if not errors:
            count = self.execution_count
            return {
                "status": "ok", "execution_count": count, "payload": [], "user_expressions": {},
            }  # fmt: skip
        error = {
            "ename": errors[0].code,
            "evalue": self._told(errors[0]).partition("\n")[0],
            "traceback": ["\n\n".join(self._told(e) for e in errors)],
        }
        if not silent:
            self.send_response(self.iopub_socket, "error", error)
        return {"status": "error", "execution_count": self.execution_count, **error}

    def _errors(self, source: Source) -> list[SsiError]:
        """Run a text in the session; what goes wrong. The session goes on."""
        session = self.gibiane
        session.was_interrupted()  # what came before this cell is over
        before, sys.stderr = sys.stderr, cast(TextIO, self._progress)
        try:
            if (link := link_to(Path(session.output_directory))) is not None:
                raise SsiError("io.folder-is-link", None, path=link)
            with listening(own=False):
                for node in parse(source).body:
                    run_shown(session, (node,), self._show, self._print)
                    self._show_pictures()
        except StopRun:
            return []
        except KeyboardInterrupt as stop:
            return [interruption(stop, session.evaluator.current_span)]
        except SeveralErrors as several:
            return several.errors
        except SsiError as error:
            error.span = error.span or session.evaluator.current_span
            return [error]
        finally:
            sys.stderr = before
            self._progress.write("")
            session.frame = session.root
            with contextlib.suppress(OSError):
                run_output(session).flush()
        return []

    async def do_is_complete(self, code: str) -> Reply:
        """Whether Enter runs the text in a console."""
        return (
            {"status": "incomplete", "indent": "  "} if _goes_on(code) else {"status": "complete"}
        )

    async def do_shutdown(self, restart: bool) -> Reply:
        """Finish what the session has begun to write."""
        run_output(self.gibiane).close()
        return {"status": "ok", "restart": restart}

    # ---- what is shown -------------------------------------------------------------------------

    def _told(self, error: SsiError) -> str:
        names = self.gibiane.frame.names() | self.gibiane.library.standard_names
        return render(error, self.gibiane.language, names)

    def _stream(self, name: str, text: str) -> None:
        if not self._silent:
            self.send_response(self.iopub_socket, "stream", {"name": name, "text": text})

    def _print(self, text: str) -> None:
        self._text.write(text.rstrip("\n") + "\n")

    def _show(self, value: Any) -> None:
        """A value: as text, and as HTML where it is a table, a list, a curve, a field."""
        self._text.flush()
        data = {"text/plain": listed(self.gibiane, value)}
        if html := html_of(value):
            data["text/html"] = html
        self._display(data)

    def _show_pictures(self) -> None:
        """Pictures made since the last look."""
        self._text.flush()
        made = pictures_of(self.gibiane)
        for picture in made[self._pictures :]:
            data: dict[str, Any] = {"text/plain": picture.path.name}
            if (png := picture._repr_png_()) is not None:
                data["image/png"] = b64encode(png).decode("ascii")
            elif (svg := picture._repr_svg_()) is not None:
                data["image/svg+xml"] = svg
            self._display(data)
        self._pictures = len(made)

    def _display(self, data: dict[str, Any]) -> None:
        if not self._silent:
            content = {"data": data, "metadata": {}}
            self.send_response(self.iopub_socket, "display_data", content)

    def _show_progress(self, line: str) -> None:
        """A line of progress in place of the one before."""
        there = self._progress_in == self.execution_count
        if self._silent or (not line and not there):
            return
        kind = "update_display_data" if there else "display_data"
        content = {
            "data": {"text/plain": line},
            "metadata": {},
            "transient": {"display_id": f"progress-{self.execution_count}"},
        }
        self.send_response(self.iopub_socket, kind, content)
        self._progress_in = self.execution_count

    # ---- help ----------------------------------------------------------------------------------

    def _document(self, code: str) -> Document:
        load_operators()
        return Document.of(code, None, self.gibiane.library.standard_names)

    async def do_complete(self, code: str, cursor_pos: int) -> Reply:
        """What editors offer, and the session's own names and indices."""
        session = self.gibiane
        document = self._document(code)
        found = candidates(document, cursor_pos, session.library, session.language, session)
        kept = [c for c in found if _begins(c, code[c.start : cursor_pos])]
        start = kept[0].start if kept else cursor_pos
        end = max(kept[0].end, cursor_pos) if kept else cursor_pos
        kinds = [
            {"start": start, "end": end, "text": c.text, "type": c.kind, "signature": c.detail}
            for c in kept
        ]
        return {
            "status": "ok", "matches": [c.text for c in kept],
            "cursor_start": start, "cursor_end": end,
            "metadata": {"_jupyter_types_experimental": kinds},
        }  # fmt: skip

    async def do_inspect(
        self, code: str, cursor_pos: int, detail_level: int = 0, omit_sections: Any = ()
    ) -> Reply:
        """The value of a name of the session, else what editors show under the cursor."""
        session, document = self.gibiane, self._document(code)
        text = "".join(self._held(document, cursor_pos))
        if not text:
            reader = Reader(document, Findings((), {}), session.library, session.language)
            found = reader.hover(cursor_pos)
            text = found[0] if found else ""
        data = {"text/plain": text, "text/markdown": text} if text else {}
        return {"status": "ok", "found": bool(text), "data": data, "metadata": {}}

    def _held(self, document: Document, offset: int) -> Iterator[str]:
        """What the session has under the name at an offset."""
        token = document.place(offset).token
        if token is None or token.kind != "WORD":
            return
        value = self.gibiane.frame.find(token.name)
        if value is not None:
            shown = listed(self.gibiane, value).split("\n")
            yield f"**{token.name}** : {type_of(value)}\n\n```text\n"
            yield "\n".join(shown[:20]) + "\n```"


def _goes_on(code: str) -> bool:
    """Whether a text is the beginning of statements."""
    try:
        parse(Source("cell", code))
    except SeveralErrors as several:
        return {e.code for e in several.errors} <= UNFINISHED
    except SsiError:
        pass
    return False


def _begins(candidate: Candidate, typed: str) -> bool:
    return candidate.text.lstrip("'").upper().startswith(typed.lstrip("'").upper())
