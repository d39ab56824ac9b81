"""What objects of the package hold, and that operators leave it as it is."""

from collections import Counter
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.language.registry import Operator
from ssilang.language.run import phrases
from ssilang.language.run.call import Call

CHANGE = {"DEPL", "FORM", "REMP"}
MANY = 100  # calls of one operator in a test, of which no more are looked at


def arrays_of(whole: Any) -> Iterator[np.ndarray]:
    """All arrays that an object leads to, each once; of nodes those that there are."""
    seen: dict[int, Any] = {}
    waiting = [whole]
    while waiting:
        one = waiting.pop()
        if id(one) in seen:
            continue
        seen[id(one)] = one
        match one:
            case np.ndarray():
                yield one
            case NodeTable():
                waiting.append(one.coordinates)
            case dict():
                waiting += one.values()
            case list() | tuple() | set() | frozenset():
                waiting += one
            case object() if type(one).__module__.startswith("ssilang."):
                waiting += getattr(one, "__dict__", {}).values()
                slots = (n for kind in type(one).__mro__ for n in getattr(kind, "__slots__", ()))
                waiting += (getattr(one, n) for n in slots if hasattr(one, n))


@pytest.fixture
def operands_stay(monkeypatch: pytest.MonkeyPatch) -> None:
    """Operators leave what they are given as it is, but those that are there to change it."""
    run, calls = phrases.run_operator, Counter[str]()

    def watched(found: Operator, call: Call) -> Any:
        calls[found.name] += 1
        if found.name in CHANGE or calls[found.name] > MANY:
            return run(found, call)
        given = [(array, array.copy()) for o in call.operands for array in arrays_of(o.value)]
        made = run(found, call)
        for array, before in given:
            same = (array.shape, array.tobytes()) == (before.shape, before.tobytes())
            assert same, f"{found.name} has changed an operand"
        return made

    monkeypatch.setattr(phrases, "run_operator", watched)
