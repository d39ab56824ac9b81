"""Procedures that draw: what they compose is looked at, files by the tests of `tests/io/plots`."""

import pytest


@pytest.fixture(autouse=True)
def _unsaved(unsaved: None) -> None:
    """Pictures are one pixel each."""
