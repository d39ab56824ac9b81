"""No input breaks the interpreter: limits, errors with a place; work grows as a phrase does."""

import sys
import tracemalloc

import pytest
from script_runs import failed
from together import together

from ssilang.cli.run import RunOptions, run_text
from ssilang.language.run.session import Limits
from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text.parser import parse_statements
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse


def test_statement_limit_stops_an_endless_loop(tmp_path):
    options = RunOptions(output_directory=tmp_path, limits=Limits(statements=1000))
    result = run_text("REPE b ; x = &b ; FIN b ;", options=options)
    assert result.errors[0].code == "statement-limit"


@together("body", ["", "SI FAUX ; FINSI ;", "ITER b ;"])
def test_the_limit_counts_turns_and_conditions(tmp_path, body):
    options = RunOptions(output_directory=tmp_path, limits=Limits(statements=1000))
    result = run_text(f"REPE b ; {body} FIN b ;", options=options)
    assert result.errors[0].code == "statement-limit"


def test_recursion_limit_is_an_option(tmp_path):
    text = "DEBP P n*ENTIER ; SI (n > 0) ; P (n - 1) ; FINSI ; FINP ; P 50 ;"
    deep = RunOptions(output_directory=tmp_path, limits=Limits(recursion=60))
    shallow = RunOptions(output_directory=tmp_path, limits=Limits(recursion=20))
    assert run_text(text, options=deep).exit_code == 0
    assert run_text(text, options=shallow).errors[0].code == "recursion"


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("x = " + "(" * 20000 + "1" + ")" * 20000 + " ;", "nesting"),
        ("x = " + "9" * 6000 + " ;", "long-integer"),
        ("x = «1.E309» ;", "long-real"),
        ("x = 3 * «-1D999» ;", "long-real"),
        ("x = 10 ; REPE b 40 ; x = «x * x» ; FIN b ;", "arithmetic"),
        ("x = «7 ** 100000000» ;", "arithmetic"),
        ("t = TEXT 'u' ; u = TEXT «'t'» ; x = t 3 ;", "endless-text"),
        ("t = TEXT «'('» ; x = t 3 ;", "unclosed-paren"),
        ("x = EXTR ((PROG 1.) / (PROG 0.)) 1 ; REPE b «x» ; QUIT b ; FIN b ;", "loop-count"),
        ("\x00 = 3 ;", "syntax"),
    ],
    ids=lambda v: v[:24],
)
def test_extreme_scripts_end_in_a_message(fails, text, code):
    assert fails(text) == code


@pytest.mark.parametrize(
    ("text", "x"),
    [
        ("SI VRAI ; " * 1000 + "x = 3 ; " + "FINSI ; " * 1000, 3),
        ("x = " + "1 + " * 5000 + "1 ;", 5001),
        ("t = TABL ; t . 1 = t ; t . 2 = 7 ; u = t . 1 . 1 . 1 ; x = u . 2 ;", 7),
    ],
    ids=["nested SI", "long sum", "table in itself"],
)
def test_large_scripts_run(run, text, x):
    assert run(text)["x"] == x


@together("before, behind", [(2000, 0), (0, 2000), (900, 900)])
def test_a_very_long_line_is_shown_around_its_error(before, behind):
    text = "x = " + "1 + " * before + "(FOO 3.)" + " + 1" * behind + " ;"
    shown, marks = run_text(text).message.split("\n")[3:5]
    assert (len(shown), shown[marks.index("^") : len(marks)]) == (164, "FOO")
    assert shown[4:].strip(".") in text
    assert (shown[4:7] == "...", shown[-3:] == "...") == (before > 0, behind > 0)


def test_a_long_integer_does_not_hide_the_errors_behind_it():
    with pytest.raises(SeveralErrors) as caught:
        parse(Source("deck", "X = 99999999999999999999 ; Y = 3.) ; Z = 88888888888888888888 ;"))
    codes = sorted(e.code for e in caught.value.errors)
    assert codes == ["extra-paren", "long-integer", "long-integer"]


# a factor in length, and the most that work may grow: n log n and whole batches are well below
TIMES, MOST = 4, 4.4

LONG = {
    "reals": lambda n: "L = PROG " + "1.5 " * n + ";",
    "reals, a line each": lambda n: "L = PROG\n" + " 1.5\n" * n + ";",
    "integers": lambda n: "L = LECT " + "7 " * n + ";",
    "repetitions": lambda n: "L = PROG " + "2 * 1.5 " * n + ";",
    "names": lambda n: "A = 1.5 ; L = PROG " + "A " * n + ";",
    "parentheses": lambda n: "L = PROG " + "(1. + 1.) " * n + ";",
    "words": lambda n: "L = MOTS " + "'UX' " * n + ";",
    "a curve": lambda n: f"E = EVOL 'MANU' (PROG {'1. ' * n}) (PROG {'2. ' * n}) ;",
    "a sum of reals": lambda n: "A = 1.5 ; X = A" + " + A" * n + " ;",
    "a sum of lists": lambda n: "A = PROG 1. ; X = A" + " + A" * n + " ;",
    "a union": lambda n: "A = VRAI ; X = A" + " ET A" * n + " ;",
    "a message": lambda n: "MESS " + "1.5 " * n + ";",
    "a table": lambda n: "T = TABL ;" + "T . 'A' = 1.5 ;" * n,
}


def lines_run(script):
    """How many lines of Python a script takes."""
    count = 0

    def line(frame, event, _):
        nonlocal count
        count += event == "line"
        return line

    before = sys.gettrace()
    sys.settrace(line)
    try:
        result = run_text(script)
    finally:
        sys.settrace(before)
    assert result.exit_code == 0, result.message
    return count


@pytest.mark.parametrize("kind", LONG)
def test_work_grows_as_the_length_does(kind):
    run_text(LONG[kind](5))  # what is loaded once
    start, some, many = (lines_run(LONG[kind](n)) for n in (1, 600, TIMES * 600))
    assert (many - start) / (some - start) < MOST


@pytest.mark.parametrize("sign", ["+", "'+'", "-", "*"])
def test_a_long_chain_gives_what_its_signs_give(sign, run):
    n = 1500
    expected = {"+": 2.0 + n, "'+'": 2.0 + n, "-": 2.0 - n, "*": 2.0}[sign]
    assert run(f"A = 1. ; X = 2. {f'{sign} A ' * n} ;")["X"] == expected


def test_a_long_chain_says_where_it_is_wrong():
    script = "A = 1. ;\nX = A" + "\n + A" * 700 + "\n + 'm'" + "\n + A" * 700 + " ;"
    result = failed(script)
    assert "+ does not go with FLOTTANT and MOT\n    --> script:702:2" in result.message


def test_what_stands_behind_a_long_chain_is_read_as_behind_a_short_one(run):
    script = "A = 1. ; X = A " + "+ A " * 600 + "> 600. ; Y = PROG " + "1. " * 600 + "PAS 1. 3. ;"
    made = run(script)
    assert made["X"] is True
    assert made["Y"].values.tolist()[-3:] == [1.0, 2.0, 3.0]


def test_a_long_string_takes_a_few_bytes_a_letter():
    text = "A = '" + "x" * 1_000_000 + "' ;"
    parse_statements(Source("warm", "A = 'x' ;"))
    tracemalloc.start()
    try:
        (statement,) = parse_statements(Source("script", text))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert len(statement.items[0].text) == 1_000_000
    assert peak < 10 * len(text)
