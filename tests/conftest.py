"""Settings of all tests."""

import os
import sys

import pytest
from hypothesis import HealthCheck, settings

# processes that tests start keep their byte code, as a person's do: half of a start otherwise
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# a busy machine, or a first compilation, is no failure of what is tested
settings.register_profile("house", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("house")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long tests come first: none is left to one process while the others wait for it."""
    items.sort(key=lambda item: item.get_closest_marker("long") is None)
