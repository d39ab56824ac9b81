"""Running small scripts: their variables, their output, their first error."""

from typing import Any

import pytest
from script_runs import failed, ran

from ssilang.cli.run import RunResult
from ssilang.language.values import Table, type_of


class Script:
    """A run script, asked for its variables and output."""

    def __init__(self, result: RunResult) -> None:
        self.result = result

    def __getitem__(self, name: str) -> Any:
        return self.result.session.root.find(name.upper())

    def kind(self, name: str) -> str:
        return type_of(self[name])

    def at(self, table: str, *path: Any) -> Any:
        value = self[table]
        for index in path:
            assert isinstance(value, Table)
            value = value.get(index)
        return value

    @property
    def lines(self) -> list[str]:
        return self.result.output.split("\n")[:-1]


@pytest.fixture
def run(tmp_path):
    """Run a text that must succeed."""

    def action(text: str) -> Script:
        return Script(ran(text, output_directory=tmp_path / "out"))

    return action


@pytest.fixture
def fails(tmp_path):
    """Function `(text)`: the code of the first error of a text that must fail, as `failed`."""
    return lambda text: failed(text, tmp_path / "out").errors[0].code
