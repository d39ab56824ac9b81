"""Pasted data: the work of a phrase grows as its length does, and so does what a text takes."""

import sys
import tracemalloc

import pytest
from script_runs import failed

from ssilang.cli.run import run_text
from ssilang.language.text.parser import parse_statements
from ssilang.language.text.source import Source

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
