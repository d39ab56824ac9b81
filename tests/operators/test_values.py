"""What operators give for every type of operand is the same function of numpy.

Fields stand on points in no order and on cells of two kinds in two zones; `x` and `y` are the
coordinates of where a value stands. Curves are two, of other lengths, and go back in places.
"""

import io
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
import script_runs
from scipy import special
from script_runs import assert_field, session_after
from together import together

from ssilang.cli.run import execute
from ssilang.language.text.source import Source

TABLES = {
    name: tomllib.loads(Path(__file__).with_name(f"{name}.toml").read_text(encoding="utf-8"))
    for name in ("test_phrases", "test_values")
}
PRELUDE = TABLES["test_phrases"]["values"]["before"]
A, B = np.array([3.0, -1.0, 0.5]), np.array([0.25, 2.0, -4.0])
INTEGERS = np.array([3, -2, 0, 7])
UX, UY = (lambda x, y, _=0: x - 2.5), (lambda x, y, _=0: x * y)
VX, VY = (lambda x, y, _=0: y), (lambda x, y, _=0: y * y)


LISTED = TABLES["test_values"]


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_after(PRELUDE, tmp_path_factory.mktemp("values"), io.StringIO())


def asked(session, phrase):
    execute(session, Source("statement", f"R = {phrase} ;"))
    return session.root.find("R")


FUNCTIONS = {
    "ABS": abs, "SIGN": lambda v: np.where(np.asarray(v) < 0, -1, 1), "EXP": np.exp,
    "ERF": special.erf, "ERFC": special.erfc,
    "SIN": lambda v: np.sin(np.radians(v)), "COS": lambda v: np.cos(np.radians(v)),
    "TAN": lambda v: np.tan(np.radians(v)), "SINH": np.sinh, "COSH": np.cosh, "TANH": np.tanh,
    "ASIH": np.arcsinh, "ATG": lambda v: np.degrees(np.arctan(v)), "-1. *": lambda v: -v,
}  # fmt: skip
PAIRS = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide,
    "ATG": lambda a, b: np.degrees(np.arctan2(a, b)),
}  # fmt: skip


def both(function, first, second):
    return [lambda x, y, _, f=f, g=g: function(f(x, y), g(x, y))
            for f, g in zip(first, second, strict=True)]  # fmt: skip


@together("word", FUNCTIONS)
def test_functions_of_all_types_of_operands(session, word):
    f = FUNCTIONS[word]
    assert asked(session, f"{word} -1.5") == pytest.approx(f(-1.5), rel=1e-14)
    np.testing.assert_allclose(asked(session, f"{word} L").values, f(A), rtol=1e-14)
    np.testing.assert_allclose(asked(session, f"{word} I").values, f(INTEGERS), rtol=1e-14)
    assert_field(
        asked(session, f"{word} U"),
        {"UX": lambda x, y, _: f(UX(x, y)), "UY": lambda x, y, _: f(x * y)},
    )
    assert_field(
        asked(session, f"{word} C"),
        {"VX": lambda x, y, _: f(UX(x, y)), "VY": lambda x, y, _: f(x * y)},
    )
    wanted = [lambda x, y, _: f(UX(x, y)), lambda x, y, _: f(x * y)]
    for field, names in (("U", ("UX", "UY")), ("C", ("VX", "VY"))):
        assert_field(asked(session, f"{word} {field}"), dict(zip(names, wanted, strict=True)))
    parts = asked(session, f"{word} E").parts
    assert [p.abscissas.tolist() for p in parts] == [[1, 2, 4], [0, 3]]
    for part, values in zip(parts, (A, [5.0, 0.25]), strict=True):
        np.testing.assert_allclose(part.ordinates, f(np.asarray(values)), rtol=1e-14)
    for axis in ("ABSC", "ORDO") if " " not in word else ():
        (part, _), place = asked(session, f"{word} '{axis}' E").parts, np.array([1.0, 2.0, 4.0])
        both = (f(place), A) if axis == "ABSC" else (place, f(A))
        np.testing.assert_allclose((part.abscissas, part.ordinates), both, rtol=1e-14)


@pytest.mark.parametrize("sign", PAIRS)
def test_two_operands_of_all_types(session, sign):
    f = PAIRS[sign]

    def made(a, b):
        return f"ATG {a} {b}" if sign == "ATG" else f"{a} {sign} {b}"

    assert asked(session, made(7.0, -2.0)) == pytest.approx(f(7.0, -2.0), rel=1e-14)
    np.testing.assert_allclose(asked(session, made("L", "K")).values, f(A, B), rtol=1e-14)
    both_fields = sign not in ("*", "/")
    for one, two, names in (("U", "V", ("UX", "UY")), ("C", "D", ("VX", "VY"))):
        if both_fields:
            wanted = both(f, (UX, UY), (VX, VY))
            assert_field(asked(session, made(one, two)), dict(zip(names, wanted, strict=True)))
        if sign == "ATG":
            continue
        for number in (-1.25, 2):
            wanted = [lambda x, y, _, g=g, n=number: f(g(x, y), n) for g in (UX, UY)]
            assert_field(asked(session, made(one, number)), dict(zip(names, wanted, strict=True)))
            if sign != "/":
                wanted = [lambda x, y, _, g=g, n=number: f(n, g(x, y)) for g in (UX, UY)]
                found = asked(session, made(number, one))
                assert_field(found, dict(zip(names, wanted, strict=True)))
    if sign == "ATG":
        return
    for number in (-1.25, 2):
        np.testing.assert_allclose(asked(session, made("L", number)).values, f(A, number))
        np.testing.assert_allclose(asked(session, made(number, "K")).values, f(number, B))
        if sign != "/":
            np.testing.assert_array_equal(asked(session, made("I", 2)).values, f(INTEGERS, 2))
            np.testing.assert_array_equal(asked(session, made(3, "I")).values, f(3, INTEGERS))
        for part, values in zip(
            asked(session, made("E", number)).parts, (A, [5.0, 0.25]), strict=True
        ):
            np.testing.assert_allclose(part.ordinates, f(np.asarray(values), number), rtol=1e-14)


@together("group", LISTED["printed"])
def test_objects_are_listed_as_they_are(group, tmp_path):
    output = io.StringIO()
    session = session_after(PRELUDE + LISTED["before"], tmp_path, output)
    for phrase, wanted in LISTED["printed"][group].items():
        begin = output.tell()
        execute(session, Source("statement", f"LIST {phrase} ;"))
        script_runs.assert_says(output.getvalue()[begin:], wanted)


def test_a_long_list_loses_its_middle_alone(tmp_path):
    output = io.StringIO()
    text = "N = PROG 1. 'PAS' 1. {} ; LIST (EVOL 'MANU' N (2. * N)) ;"
    session_after(text.format("200."), tmp_path, output)
    _, *kept, last = output.getvalue().split("ordinate")[1].splitlines()
    assert (len(kept), last.split()) == (199, ["2.00000E+02", "4.00000E+02"])
    output = io.StringIO()
    session_after(text.format("205."), tmp_path, output)
    rows = output.getvalue().split("ordinate")[1].splitlines()[1:]
    told = re.search(r"\d+", rows.pop(100))
    assert told is not None
    assert int(told.group()) == 5
    assert [float(r.split()[0]) for r in rows] == [*range(1, 101), *range(106, 206)]
