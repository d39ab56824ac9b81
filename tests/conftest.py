"""Settings of all tests."""

import contextlib
import ctypes
import gc
import importlib.util
import itertools
import os
import sys
from base64 import b64decode
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from _pytest.pathlib import import_path
from hypothesis import HealthCheck, settings
from left_behind import nothing_is_left_behind  # noqa: F401
from not_tested import pytest_terminal_summary  # noqa: F401
from petsc_there import lacking

from ssilang import late_imports
from ssilang.cli.main import SELDOM
from ssilang.cli.sweeping import pool, worker
from ssilang.cli.sweeping.worker import Row, Task
from ssilang.io.plots import animation, figure
from ssilang.kernel.base import compiled
from ssilang.kernel.solvers.backends import keep_factors

# processes that tests start keep their byte code, as a person's do: half of a start otherwise;
# and what they print waits in a buffer, as a person's does
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
os.environ.pop("PYTHONUNBUFFERED", None)
sys.dont_write_bytecode = False

# a busy machine, or a first compilation, is no failure of what is tested
settings.register_profile("house", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("house")

# as the command line: searches through all that thousands of tests leave are a tenth of their time
gc.set_threshold(SELDOM)


figure.DPI = 60  # what few pixels show is the same, and software draws each pixel of a scene


_FOLDERS = itertools.count()


@pytest.fixture
def tmp_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The next number is free: pytest looks through all folders for that, thousands in the end."""
    path = tmp_path_factory.getbasetemp() / str(next(_FOLDERS))
    path.mkdir(mode=0o700)
    return path


@pytest.fixture
def one_after_the_other(unsaved: None, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Runs of a sweep with one job are made in this process: a new one costs a second.

    Pictures of its figures are composed alone: to write them was most of the rest.
    """

    def run_all(tasks: list[Task], jobs: int) -> Iterator[Row]:
        return pool.run_all(tasks, jobs) if jobs > 1 else pool.run_alone(tasks)

    monkeypatch.setattr("ssilang.cli.sweeping.sweep.run_all", run_all)
    yield
    keep_factors(0)


_PIXEL = b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4//8/AAX+Av4N70a4AAAAAElFTkSuQmCC"
)


@pytest.fixture
def unsaved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures are composed; placing their texts and writing them is most of a short script.

    One white pixel stands for them, which an animation can read back.
    """
    for module in (figure, animation):
        monkeypatch.setattr(module, "figure_bytes", lambda *_: _PIXEL)
    monkeypatch.setattr(figure, "DPI", 15)


@pytest.fixture
def unplaced(monkeypatch: pytest.MonkeyPatch) -> None:
    """Parts of figures stay where they are put: room for texts is half of a picture's time."""
    engine = "matplotlib.layout_engine.ConstrainedLayoutEngine"
    monkeypatch.setattr(f"{engine}.execute", lambda *_: None)


@pytest.fixture(scope="session")
def petsc_is_there() -> None:
    """Who runs its tests asks whether it is there, and not each process that collects them."""
    if lacking():
        pytest.skip(lacking())


class _Nothing(set[str]):
    """What processes of tests may start: the other processors have tests of their own."""

    def add(self, what: str) -> None:
        """Stay empty, also where a test calls the command line."""


compiled.ALLOWED = _Nothing()


COMPILE = {"kernel", "decks", "docs", "diagnostics", "api"}
"""Folders whose tests need most of what is compiled."""
LATE = {"operators", "stdlib"}
"""Folders whose tests need much of it: the second process comes to them when it is there."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long tests come first: none is left to one process while the others wait for it.

    Then those of the command line, that wait for processes of theirs, so that quick ones are last.
    Then those that compile, so that they are one process's: two would compile the same at a time.
    """

    def order(item: pytest.Item) -> tuple[bool, ...]:
        folders, short = item.nodeid.split("/"), item.get_closest_marker("long") is None
        late = not LATE.isdisjoint(folders)
        return short, "cli" not in folders, COMPILE.isdisjoint(folders), late

    items.sort(key=order)


def pytest_collection(session: pytest.Session) -> None:
    """One process begins with the last file: of a new checkout each makes half of the byte code."""
    tests, root = Path(__file__).parent, session.config.rootpath
    whole = [Path(root, a) for a in session.config.args] == [tests]
    if whole and os.environ.get("PYTEST_XDIST_WORKER") == "gw1":
        for path in sorted(tests.rglob("test_*.py"), reverse=True):
            with contextlib.suppress(Exception):  # who collects it tells of it
                import_path(path, mode="importlib", root=root, consider_namespace_packages=False)


def pytest_collection_finish() -> None:
    """What is there now stays to the end: no search for garbage looks at it again."""
    gc.freeze()
    gc.collect()  # searches through all come when so much is new as was found here
    # a run asks whether something is frozen, and the answer counts all that is
    late_imports.gc = SimpleNamespace(**vars(gc) | {"get_freeze_count": lambda: 1})
    worker.gc = SimpleNamespace(get_freeze_count=lambda: 0)  # the objects of all tests are too many


class _Memory:
    """What ended scripts leave are circles of objects: found once they may hold this many bytes.

    A script's objects are few and their arrays are large, while Python counts objects alone.
    """

    ROOM = 400e6

    def __init__(self) -> None:
        self.least = self.resident()
        system = ctypes.CDLL(None) if sys.platform == "linux" else None
        self.give_back = getattr(system, "malloc_trim", lambda _: 0)

    @staticmethod
    def resident() -> float:
        """Bytes of this process in memory; 0 where the system does not tell."""
        told = Path("/proc/self/statm")
        return int(told.read_text().split()[1]) * 4096.0 if told.exists() else 0.0

    def look(self) -> None:
        if self.resident() > self.least + self.ROOM:
            gc.collect()
            self.give_back(0)
            self.least = self.resident()


_MEMORY = _Memory()


@pytest.hookimpl(trylast=True)
def pytest_runtest_logfinish() -> None:
    """Behind each test, when its fixtures are gone."""
    _MEMORY.look()


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish() -> None:
    """Search for garbage here: pytest does so behind, when xdist interrupts after 5 s."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session")
def build():
    """The module `docs/build.py`, which stands in no package."""
    path = Path(__file__).resolve().parents[1] / "docs" / "build.py"
    spec = importlib.util.spec_from_file_location("build_manual", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["build_manual"] = module
    spec.loader.exec_module(module)
    return module
