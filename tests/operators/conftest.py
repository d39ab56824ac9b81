"""Running a script in a test, its files below the test's own folder."""

from functools import partial

import pytest
import script_runs


@pytest.fixture
def found(tmp_path):
    """Function `(script, *names)`: the objects of these names; the script must succeed."""
    return partial(script_runs.found, folder=tmp_path)


@pytest.fixture
def printed(tmp_path):
    """Function `(script)`: the lines that a script prints; it must succeed."""
    return partial(script_runs.printed, folder=tmp_path)


@pytest.fixture
def refused(tmp_path):
    """Function `(script)`: the message of a script that must fail, without defects inside."""
    return partial(script_runs.refused, folder=tmp_path)
