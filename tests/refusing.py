"""What must be refused, told by the code of its message."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest


@contextmanager
def refusal(kind: type[Exception], code: str) -> Iterator[pytest.ExceptionInfo]:
    """The block must raise an error of this kind whose message has this code."""
    with pytest.raises(kind) as caught:
        yield caught
    assert caught.value.code == code
