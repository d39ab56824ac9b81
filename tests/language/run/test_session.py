"""Warnings and notes of a session: kept, and told to who listens."""

from __future__ import annotations

import io

import pytest

from ssilang.language.run.session import Session
from ssilang.language.say.errors import ReaderLeft, SsiError


def warning() -> SsiError:
    found = SsiError("division-by-zero", None)
    found.warns = True
    return found


def test_warnings_are_kept_with_and_without_a_listener():
    session, told = Session(out=io.StringIO()), []
    first, second = warning(), warning()
    session.report(first)
    session.on_warning = told.append
    session.report(second)
    assert session.warnings == [first, second]
    assert told == [second]


def test_a_listener_that_fails_is_asked_no_more():
    session = Session(out=io.StringIO())

    def full(_: object) -> None:
        raise OSError(28, "No space left on device")

    session.on_warning = session.on_note = full
    for _ in range(2):
        session.report(warning())
        session.note("step 1")
    assert len(session.warnings) == 2
    assert session.on_warning is None
    assert session.on_note is None


@pytest.mark.parametrize("tell", [lambda s: s.report(warning()), lambda s: s.note("step 1")])
def test_a_reader_who_left_ends_the_run(tell):
    session = Session(out=io.StringIO())

    def gone(_: object) -> None:
        raise BrokenPipeError

    session.on_warning = session.on_note = gone
    with pytest.raises(ReaderLeft):
        tell(session)
