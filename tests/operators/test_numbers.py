"""Functions, conversions, comparisons, masks, random values against Python's own."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from script_runs import ran, refused
from together import together

from ssilang.cli.run import run_text

NUMBERS = st.floats(-1e6, 1e6, allow_nan=False)


def value(script):
    return ran(f"X = {script} ;").session.root.find("X")


@together("limit", [0.0, 0.3, 2.0, 30.0])
def test_fresnels_integrals_are_those_of_their_definition(found, limit):
    """t = u^2 takes the root of the denominator away."""
    cosine, sine = found(f"C S = IFRE {limit} ; L = PROG C S ;", "L").values
    for value, function in ((cosine, math.cos), (sine, math.sin)):
        whole = quad(lambda u, f=function: f(u * u), 0.0, math.sqrt(limit), limit=200)[0]
        assert value == pytest.approx(whole * math.sqrt(2 / math.pi), abs=1e-10)


@given(NUMBERS, NUMBERS)
@settings(max_examples=40, deadline=None)
def test_comparisons_order_like_the_reals(a, b):
    signs = ("<", ">", "<EG", ">EG", "EGA", "NEG")
    asked = "".join(f"L{i} = A {sign} B ; " for i, sign in enumerate(signs))
    root = run_text(f"A = {a!r} ; B = {b!r} ; {asked}").session.root
    assert [root.find(f"L{i}") for i in range(6)] == [a < b, a > b, a <= b, a >= b, a == b, a != b]


def test_random_values_follow_their_law_and_repeat():
    gauss = value("BRUI 'BLAN' 'GAUS' 2. 0.5 20000").values
    # mean within 5 deviations of the mean's own distribution
    assert gauss.mean() == pytest.approx(2.0, abs=5 * 0.5 / math.sqrt(20000))
    assert gauss.std() == pytest.approx(0.5, rel=0.03)
    uniform = value("BRUI 'BLAN' 'UNIF' 1. 3. 1000").values
    assert uniform.min() >= -2
    assert uniform.max() <= 4
    assert value("BRUI 'BLAN' 'GAUS' 2. 0.5 20000").values.tolist() == gauss.tolist()


@together("base", ["-8.", "(PROG -8. 8.)"])
def test_other_roots_of_negative_values_are_refused(base: str) -> None:
    line = "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (-8. 0.) (8. 0.) ; "
    assert "0.5" in refused(line + f"X = ({base}) ** 0.5 ;")
    assert run_text(line + f"X = ({base}) ** (1. / 9.) ;").exit_code == 0


BIG = st.integers(-(2**40), 2**40)


@given(st.lists(st.tuples(BIG, BIG), min_size=1, max_size=5), st.sampled_from("+-*/"))
@settings(max_examples=80)
def test_lists_of_integers_follow_the_rules_of_single_ones(pairs, sign):
    left, right = (" ".join(map(str, side)) for side in zip(*pairs, strict=True))
    result = run_text(f"X = (LECT {left}) {sign} (LECT {right}) ;")
    singles = [run_text(f"X = {a} {sign} {b} ;") for a, b in pairs]
    if any(s.exit_code for s in singles):
        assert result.exit_code == 1
        assert "division by zero" in result.message
        return
    expected = [s.session.root.find("X") for s in singles]
    if max(map(abs, expected)) >= 2**63:
        assert result.exit_code == 1
        assert "64 bits" in result.message
    else:
        assert result.session.root.find("X").values.tolist() == expected


def test_a_sum_of_a_list_may_be_longer_than_its_items():
    assert value("SOMM (LECT 9000000000000000000 9000000000000000000)") == 18 * 10**18


@together("mean, count", [(7, 400), (0, 3), (3, 0)])
def test_noise_of_poisson_has_its_mean(mean, count):
    result = ran(f"L = BRUI 'BLAN' 'POIS' {mean} {count} ;")
    values = result.session.root.find("L").values
    assert len(values) == count
    # six deviations of the mean of so many values, whose variance is the mean
    assert abs(values.sum() - mean * count) <= 6.0 * math.sqrt(mean * count)


@together("words", ["-1 3", "1 -3"])
def test_noise_of_poisson_refuses_negative_counts(words):
    (error,) = run_text(f"L = BRUI 'BLAN' 'POIS' {words} ;").errors
    assert error.code == "out-of-range"
