"""Running a script in a test and looking at what it made."""

import re
from pathlib import Path
from typing import Any

import pytest

from ssilang.cli.run import RunOptions, RunResult, run_text


def ran(
    script: str, output_directory: Path | None = None, options: RunOptions | None = None
) -> RunResult:
    """The end of a script that must succeed."""
    result = run_text(script, output_directory, options)
    assert result.exit_code == 0, result.message
    return result


_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def found(script: str, *names: str, folder: Path | None = None) -> Any:
    """The objects of these names, one alone for one name; the script must succeed."""
    root = ran(script, folder).session.root
    values = tuple(root.find(n) for n in names)
    return values[0] if len(values) == 1 else values


def printed(script: str, folder: Path | None = None) -> list[str]:
    """The lines that a script prints; it must succeed."""
    return ran(script, folder).output.rstrip("\n").split("\n")


def failed(script: str, folder: Path | None = None) -> RunResult:
    """The end of a script that must fail at what stands between « and », where these stand."""
    before, here, rest = script.partition("«")
    place, _, after = rest.partition("»")
    result = run_text(before + place + after, output_directory=folder)
    assert result.exit_code == 1
    assert "defect of ssilang" not in result.message
    if here:
        span = result.errors[0].span
        assert (span.start, span.source.text[span.start : span.end]) == (len(before), place)
    return result


def refused(script: str, folder: Path | None = None) -> str:
    """The message of a script that must fail, as `failed`."""
    return failed(script, folder).message


def assert_says(output: str, wanted: str) -> None:
    """A text is as known but for blanks: words as they are, numbers to four digits."""
    found = " ".join(output.split())
    assert _NUMBER.sub("#", found) == _NUMBER.sub("#", wanted)
    numbers = [[float(x) for x in _NUMBER.findall(t)] for t in (found, wanted)]
    assert numbers[0] == pytest.approx(numbers[1], rel=1e-4, abs=1e-9)
