"""A second process that compiles beside the first, on a machine that has no kept code yet.

While a function is compiled, those that it reaches by address (`apart`) become known: a run needs
most of them next. They are told to another process, which compiles them and keeps their code; the
run loads what it finds done. Who makes a file of a function's name compiles it; the run waits where
the other has begun, and never the other way. What only Python calls is not known before its turn:
`ahead.toml` has the types that most decks share, room by room, and the other process is told of a
room when the run compiles the first function of it. It begins before that with joints, where the
script steps some (`cli.main`), and is told of one of several solvers when a model has chosen it
(`tell_more`). Were the types others, it would work in vain, and no answer would change.

Nothing starts but where it was allowed (the command line does) and there is a second core. The
other process is given names and types by a pipe, writes only kept code, and ends with the run,
however that ends.
"""

import atexit
import importlib
import os
import pickle
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache, partial
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from ssilang.kernel.base.compiled import ALLOWED, PLAIN, UNCOMPILED
from ssilang.kernel.base.compiled.cache import digest
from ssilang.kernel.base.compiled.kinds import words_of_types
from ssilang.system import POSIX, cores

if TYPE_CHECKING:
    import subprocess

PACKAGES = Path(__file__).parents[4]
"""Where the package lies."""
POLL = 0.002  # s
LENGTH = 4  # bytes that tell how long a task is
AHEAD = Path(__file__).with_name("ahead.toml")
KERNEL = "ssilang.kernel."


Task = tuple[str, bytes]
"""Title of a function with its kinds of arguments, and what `task_of` makes of it."""


class Beside:
    """The other process as the run sees it; in the other process, what waits there."""

    def __init__(self) -> None:
        self.found: list[Task] | None = None  # in the other process: of what it compiles
        self._told: set[str] = set()
        self._own: set[str] = set()  # taken by this process
        self._rooms: set[str] = set()  # told of
        self._needed: list[Task] = []  # told of, in the order of need, by now perhaps taken
        self._process: subprocess.Popen[bytes] | None = None
        self._claims: Path | None = None

    def tell(self, name: str, task: bytes) -> None:
        """Code that was just made calls a function: `task` is its pickled name and types."""
        if name in self._told:
            return
        self._told.add(name)
        if self.found is not None:
            self.found.append((name, task))
            return
        self._start()
        process = self._process
        if process is not None and process.stdin is not None:
            self._needed.append((name, task))
            try:
                parts = name.encode(), task
                heads = (len(part).to_bytes(LENGTH, "little") for part in parts)
                process.stdin.write(b"".join([*heads, *parts]))
                process.stdin.flush()
            except OSError:  # it has ended: the run goes on alone
                self.end()

    @property
    def helped(self) -> bool:
        """Whether another process compiles for this one."""
        return self._process is not None

    def enter(self, module: str) -> None:
        """The run compiles a function of a module: others of its room will be needed too."""
        parts = module.removeprefix(KERNEL).split(".")
        self._start()  # it gets ready meanwhile
        for room in (".".join(parts[:n]) for n in (1, 2)):
            if self.helped and self.found is None and room not in self._rooms:
                self._rooms.add(room)
                for name, task in tasks_ahead(room):
                    self.tell(name, task)

    @contextmanager
    def taking(self, name: str) -> Iterator[bool]:
        """While a function is compiled, or after the other process has; whether it is ours."""
        if self._claims is None or name in self._own:
            yield True
            return
        place = self._place(name)
        done = place.with_suffix(".done")
        try:
            place.touch(exist_ok=False)
        except FileExistsError:
            self._wait(done)
            yield False
            return
        except OSError:  # the folder has gone
            yield True
            return
        self._own.add(name)
        try:
            yield True
        finally:
            if self.found is not None:
                with suppress(OSError):
                    done.touch()

    def _place(self, name: str) -> Path:
        """The file that who compiles a function makes."""
        assert self._claims is not None
        return self._claims / digest(name)

    def _wait(self, done: Path) -> None:
        """Until the other process has compiled a function: others that it has not begun with."""
        while self._process is not None and self._process.poll() is None and not done.exists():
            while self._needed:
                name, task = self._needed.pop(0)
                *told, is_later = pickle.loads(task)
                if not is_later and not self._place(name).exists():
                    _make(*told)
                    break
            else:
                time.sleep(POLL)

    def _start(self) -> None:
        """Start the other process, once, where it is allowed; without it all goes as before."""
        if "beside" not in ALLOWED:
            return
        ALLOWED.discard("beside")
        if PLAIN or UNCOMPILED or not POSIX or cores() < 2:
            return
        import subprocess  # few runs have anything to compile
        import tempfile

        others = [p for p in os.environ.get("PYTHONPATH", "").split(os.pathsep) if p]
        paths = os.pathsep.join([str(PACKAGES), *others])  # an empty one is the working folder
        program = f"import sys; from {__name__} import BESIDE; BESIDE.serve(sys.argv[1])"
        try:
            self._claims = Path(tempfile.mkdtemp(prefix="ssilang-compiling-"))
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-c", program, str(self._claims)],
                stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                env=os.environ | {"PYTHONPATH": paths}, start_new_session=True,
            )  # fmt: skip
        except OSError:
            self.end()
            return
        atexit.register(self.end)

    def end(self) -> None:
        """Stop the other process."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            with suppress(OSError):
                process.communicate()
        claims, self._claims = self._claims, None
        if claims is not None:
            shutil.rmtree(claims, ignore_errors=True)

    def serve(self, claims: str) -> None:
        """Compile what is told on the standard input, until the run has ended.

        The last is the first: the run takes others itself. Of what a function calls, however, the
        first comes first, and what first steps do without comes when nothing else waits.
        """
        self._claims, waiting = Path(claims), list[Task]()
        threading.Thread(target=self._read, args=(sys.stdin.buffer, waiting), daemon=True).start()
        while True:
            if not waiting:
                time.sleep(POLL)
                continue
            *told, _ = pickle.loads(waiting.pop()[1])
            self.found = []
            _make(*told)
            for found in reversed(self.found):
                _put(found, waiting)

    def _read(self, tasks: IO[bytes], waiting: list[Task]) -> None:
        while heads := tasks.read(2 * LENGTH):
            sizes = (int.from_bytes(head, "little") for head in (heads[:LENGTH], heads[LENGTH:]))
            name, task = (tasks.read(size) for size in sizes)
            _put((name.decode(), task), waiting)
        if self._claims is not None:
            shutil.rmtree(self._claims, ignore_errors=True)
        os._exit(0)


def _make(module: str, name: str, words: str, types: bytes) -> None:
    """Compile a function, unless it is already."""
    with suppress(Exception):  # whoever calls it will tell
        function = getattr(importlib.import_module(module), name)
        function.ready(words, partial(pickle.loads, types))


def _put(told: Task, waiting: list[Task]) -> None:
    """One more task; the last of the list is done first."""
    later = pickle.loads(told[1])[-1]
    if told[0] not in dict(waiting):
        waiting.insert(0 if later else len(waiting), told)


BESIDE = Beside()
"""Of this process."""


def tell_ahead(room: str) -> None:
    """Tell of functions that the run will call: a room of `ahead.toml`."""
    BESIDE.enter(room)


def tell_more(*rooms: str) -> None:
    """Tell of functions that one of several models needs, where there is another process."""
    if BESIDE.helped:
        for room in rooms:
            BESIDE.enter(room)


def tasks_ahead(room: str) -> list[Task]:
    """Functions of a room of `ahead.toml`, in the order of need; none of a room it has not."""
    import tomllib

    from numba import types

    known = tomllib.loads(AHEAD.read_text(encoding="ascii"))
    if room not in known:
        return []
    parts = {path: path.split(".") for path in known["records"]}
    records = {".".join(p[-n:]): path for path, p in parts.items() for n in (1, 2)}

    @cache
    def record(name: str) -> Any:
        module, _, own = records[name].rpartition(".")
        kind = getattr(importlib.import_module(KERNEL + module), own)
        made: Any = types.BaseTuple  # numba's, untyped
        return made.from_types([*types_of(known["records"][records[name]])], kind)

    def types_of(text: str) -> Iterator[Any]:
        for word in text.split():
            times, _, kind = word.rpartition("*")
            name, _, indices = kind.rstrip("]").partition("[")
            one = record(name) if name in records else getattr(types, name)
            yield from [types.Array(one, int(indices), "C") if indices else one] * int(times or 1)

    found = []
    for path, text in known[room].items():
        module, _, name = path.rpartition(".")
        args = (*types_of(text),)
        words = words_of_types(args)
        told = KERNEL + module, name, words
        made = getattr(importlib.import_module(told[0]), name)
        found.append((title(*told), task_of(*told, args, getattr(made, "later", False))))
    return found


def title(module: str, name: str, words: str) -> str:
    """A function for kinds of arguments."""
    return f"{module}.{name}({words})"


def task_of(
    module: str, name: str, words: str, types: tuple[Any, ...], later: bool = False
) -> bytes:
    """A function with kinds of arguments, numba's types of them, and whether it can wait."""
    return pickle.dumps((module, name, words, pickle.dumps(types), later))
