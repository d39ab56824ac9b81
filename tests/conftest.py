"""Settings of all tests."""

import gc
import os
import sys

import pytest
from hypothesis import HealthCheck, settings

from ssilang.cli.main import SELDOM
from ssilang.io.plots import figure
from ssilang.kernel.base import compiled

# processes that tests start keep their byte code, as a person's do: half of a start otherwise
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# a busy machine, or a first compilation, is no failure of what is tested
settings.register_profile("house", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("house")

# as the command line: searches through all that thousands of tests leave are a tenth of their time
gc.set_threshold(SELDOM)


figure.DPI = 60  # what few pixels show is the same, and software draws each pixel of a scene


class _Nothing(set[str]):
    """What processes of tests may start: the other processors have tests of their own."""

    def add(self, what: str) -> None:
        """Stay empty, also where a test calls the command line."""


compiled.ALLOWED = _Nothing()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long tests come first: none is left to one process while the others wait for it."""
    items.sort(key=lambda item: item.get_closest_marker("long") is None)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish() -> None:
    """Search for garbage here: pytest does so behind, when xdist interrupts after 5 s."""
    gc.collect()
    gc.freeze()
