"""CHAI, EXTR, CHAN and ET of words; Fortran formats; TYPE and EXIS."""

import errno
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from script_runs import session_after
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.base.errors import KernelError
from ssilang.language.values import ANNULE
from ssilang.operators.texts.fortran_format import formatted


@together(
    "form, value, expected",
    [
        ("(1PE12.5)", 25.86, " 2.58600E+01"),
        ("(F6.2)", 25.86, " 25.86"),
        ("(SP,1PE10.3)", 25.86, "+2.586E+01"),
        ("(E12.5)", 25.86, " 0.25860E+02"),
        ("(D12.5)", 25.86, " 0.25860D+02"),
        ("(I5)", 42, "   42"),
        ("(A4)", "abcdef", "abcd"),
        ("(F8.5)", -0.5, "-0.50000"),
        ("(F3.1)", 123.4, "***"),
        ("(1PE12.5)", 1e-100, " 1.00000-100"),
        ("(1PE12.5)", 0.0, " 0.00000E+00"),
        ("(2X,'x,', F4.1)", 1.25, "  x, 1.2"),
        ("(F4.2)", float("nan"), " NaN"),
    ],
)
def test_number_is_written_as_fortran_writes_it(form, value, expected):
    assert formatted(form, value) == expected


@given(st.floats(allow_nan=False, allow_infinity=False, width=32))
def test_exponential_format_reads_back_to_its_digits(x):
    written = formatted("(1PE15.8)", x)
    assert len(written) == 15
    assert float(written) == pytest.approx(x, rel=1e-8, abs=0)


@together("form", ["F6.2", "(Q3)", "(", ""])
def test_wrong_format_is_explained(form):
    with pytest.raises(KernelError, match="format"):
        formatted(form, 1.0)


def test_message_prints_one_line_and_an_empty_one(printed):
    assert printed("MESS 'n = ' 3 (-2) ; MESS ; SAUT 2 'LIGN' ; MESS 'end' ;") == [
        "n = 3 -2", "", "", "", "end"
    ]  # fmt: skip


def test_error_by_text_by_number_and_in_passing(refused, printed):
    assert "the beam broke" in refused("«ERRE» 'the beam broke' ;")
    assert "error 5" in refused("«ERRE» 5 ;")
    lines = printed("ERRE 0 ; ERRE -366 'AVEC' 'test' (LECT 1 2) 3.5 VRAI ; MESS 'on' ;")
    assert lines[-1] == "on"
    assert "test 1 2 3.50000E+00 VRAI" in lines[0]


def test_errors_ignored_are_shown_and_the_run_goes_on(printed):
    assert printed("OPTI ERRE IGNORE ; X = 1 / 0 ; OPTI ERRE NORMALE ; MESS 'on' ;") == ["on"]


def test_an_error_passed_over_stands_at_its_statement(tmp_path):
    """One that no operand is to blame for: a stream that takes one line no more."""

    class Full(io.StringIO):
        def write(self, text):
            if "boom" in text:
                raise OSError(errno.ENOSPC, "full")
            return super().write(text)

    script = "OPTI ERRE IGNORE ; SI VRAI ; MESS 'boom' ; FINSI ; MESS 'on' ;"
    session = session_after(script, tmp_path, Full())
    told = [(w.code, w.span.text) for w in session.warnings]
    assert told == [("cannot-print", "MESS 'boom'")]
    assert session.out.getvalue() == "on\n"


def test_forgotten_index_and_name(found):
    size, known = found("T = TABL ; T . 1 = 5 ; OUBL T 1 ; N = DIME T ; X = 2 ; OUBL X ;", "N", "X")
    assert size == 0
    assert known is ANNULE


@pytest.mark.parametrize("count", [-1, 10**9])
def test_blank_lines_have_a_limit(count, tmp_path):
    result = run_text(f"N = {count} ; SAUT N 'LIGN' ;", tmp_path)
    assert [e.code for e in result.errors] == ["out-of-range"]
    assert result.errors[0].span.text == "N"
