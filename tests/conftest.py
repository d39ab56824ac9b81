"""Settings of all tests."""

import pytest
from hypothesis import HealthCheck, settings

# a busy machine, or a first compilation, is no failure of what is tested
settings.register_profile("house", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("house")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long tests come first: none is left to one process while the others wait for it."""
    items.sort(key=lambda item: item.get_closest_marker("long") is None)
