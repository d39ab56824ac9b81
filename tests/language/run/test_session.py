"""Warnings and notes of a session: kept, and told to who listens."""

import gc
import io
import weakref

import pytest
from together import together

from ssilang.cli.run import run_text
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


@together("tell", [lambda s: s.report(warning()), lambda s: s.note("step 1")])
def test_a_reader_who_left_ends_the_run(tell):
    session = Session(out=io.StringIO())

    def gone(_: object) -> None:
        raise BrokenPipeError

    session.on_warning = session.on_note = gone
    with pytest.raises(ReaderLeft):
        tell(session)


def test_nothing_keeps_what_a_script_made_when_its_result_is_gone(tmp_path):
    texts = [
        "x = PROG 1. 2. ; y = x * 2. ;",  # a name that is no number
        "t = TABL ; t . 1 = PROG 1. ; y = (t . 1) * 2. ;",  # an entry that is none
        "t = PROG 1. 2. ; x = 1 ; REPE B 1 ; y = 1. + (x / 0) ; FIN B ;",
        "ET = 3 ; y = VRAI ET FAUX ;",  # a variable that hides an operator
        "x = TEXT 'a' ; MESS x y ; ERRE 'no' ;",
        "DEBP P a*'ENTIER' ; SI (a EGA 0) ; y = a / 0 ; FINS ; FINP (a - 1) ; x = P (P 1) ;",
    ]
    kept = {t: weakref.ref(run_text(t, output_directory=tmp_path).session) for t in texts}
    gc.collect()  # once: a search through all that thousands of tests keep takes 0.4 s
    assert [text for text, session in kept.items() if session() is not None] == []
