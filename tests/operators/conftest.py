"""Running a script in a test and looking at what it made."""

import pytest

from ssilang.cli.run import run_text


@pytest.fixture
def found():
    """Function `(script, *names)`: the objects of these names; the script must succeed."""

    def run(script, *names):
        result = run_text(script)
        assert result.exit_code == 0, result.message
        values = tuple(result.session.root.find(n) for n in names)
        return values[0] if len(values) == 1 else values

    return run


@pytest.fixture
def printed():
    """Function `(script)`: the lines that a script prints; it must succeed."""

    def run(script):
        result = run_text(script)
        assert result.exit_code == 0, result.message
        return result.output.rstrip("\n").split("\n")

    return run


@pytest.fixture
def refused():
    """Function `(script)`: the message of a script that must fail, without defects inside."""

    def run(script):
        result = run_text(script)
        assert result.exit_code == 1
        assert "defect of ssilang" not in result.message
        return result.message

    return run
