"""What was not tested and why, above the closing line: a count for each reason."""

import re
from collections import Counter
from collections.abc import Generator, Iterable
from typing import Any

import pytest

_NO_MODULE = re.compile(r"^could not import '([\w.]+)': .*", re.DOTALL)

Report = pytest.TestReport | pytest.CollectReport


def lines(skipped: Iterable[Report]) -> list[str]:
    """A line for each reason, the one that costs most tests first.

    A file that skips itself as a whole counts as one: nobody knows the tests in it.
    """
    tests, files = Counter[str](), Counter[str]()
    for report in skipped:
        place = report.longrepr
        said = place[2] if isinstance(place, tuple) else str(place)
        reason = _NO_MODULE.sub(r"no module \1", said.removeprefix("Skipped: "))
        (tests if isinstance(report, pytest.TestReport) else files)[reason] += 1
    order = sorted({*tests, *files}, key=lambda r: (-tests[r], -files[r], r))
    return [f"not tested: {_count(tests[r], files[r])}: {r}" for r in order]


def _count(tests: int, files: int) -> str:
    counts = ((tests, "test"), (files, "file"))
    return " and ".join(f"{n} {word}{'s' * (n > 1)}" for n, word in counts if n)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_terminal_summary(terminalreporter: Any) -> Generator[None, None, None]:
    """After all that pytest and others tell, right above the closing line."""
    yield
    for line in lines(terminalreporter.stats.get("skipped", ())):
        terminalreporter.write_line(line, yellow=True)
