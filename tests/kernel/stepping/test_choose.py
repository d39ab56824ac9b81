"""The table of rules: which loop a problem gets, and what is said of it."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from references.soil_block import soil_block
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.stepping import choose
from ssilang.kernel.stepping.choose import RULES, Case, method_of, rule_of, table
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.run import Integration
from ssilang.messages.message import find, sentence

DT, PLAIN = 1e-3, Scheme()


def masses(count=2, shear=0.0, dashpot=False, scheme: Scheme = PLAIN, stops=False):
    """Masses on joints that push alone, or that resist shear too, in a row; stops beside them."""
    bench, tops = Bench(), []
    for i in range(count):
        ground, top = bench.node(-1.0, float(i)), bench.node(0.0, float(i))
        bench.fix(ground)
        bench.spring(1e6 * (i + 1), top, unknown="UX")
        bench.spring(1e6, top, unknown="UY")
        bench.mass(1000.0, top)
        if dashpot:
            bench.dashpot(10.0 * (i + 1), top, "UX")
        bench.joint("SEG2", [ground, top], "JOI1", KN=1e6, KS=shear)
        if tops:
            bench.spring(2e6, tops[-1], top, unknown="UX")
        if stops:
            bench.relate([(1.0, "UX", top)], sense=1)
        tops.append(top)
    push = bench.field(*((t, "FX", -1e4) for t in tops))
    C: Matrix | None = bench.damping if dashpot else None
    return bench.problem(DT * np.arange(4), damping=C, load=bench.load(push), scheme=scheme)


def name_of(problem: Problem, full: bool = False, renewable: bool = False) -> str:
    return rule_of(Case(problem, Integration(problem).motion, DT, full), renewable).name


@together(
    "problem, name",
    [
        (masses(2), "springs"),
        (masses(2, shear=1e5), "modes"),
        (masses(2, dashpot=True), "modes"),
        (masses(scheme=Scheme(conserving=True)), "conserving"),
        (masses(scheme=Scheme(adaptive=True)), "adaptive"),
    ],
)
def test_small_problems_get_the_loop_that_fits_them(problem, name):
    assert name_of(problem) == name


def test_large_problems_are_condensed_by_nested_dissection():
    assert name_of(soil_block(steps=2)) == "dissection"


def test_loads_made_under_way_leave_the_loops_that_can_renew_them():
    assert name_of(masses(), renewable=True) == "condensed"
    assert name_of(masses(scheme=Scheme(conserving=True)), renewable=True) == "conserving"


def test_joints_with_relations_are_condensed_on_one_factor(monkeypatch):
    made, real = [], choose.effective_of
    monkeypatch.setattr(choose, "effective_of", lambda *a, **k: made.append(k) or real(*a, **k))
    problem = masses(stops=True)
    assert choose.choose(Case(problem, Integration(problem).motion, DT)).rule.name == "condensed"
    assert made == [{}]
    said = method_of(RULES[-1], problem)
    assert "4 joint unknowns and an active set" in sentence(said.code, said.data, "en")


def test_full_newton_is_asked_for_and_excludes_adapted_steps():
    assert name_of(masses(), full=True) == "full Newton"
    with pytest.raises(KernelError, match="adapted steps"):
        name_of(replace(masses(), scheme=Scheme(adaptive=True)), full=True)


def test_the_last_rule_takes_what_no_other_does(monkeypatch):
    monkeypatch.setattr(choose, "RULES", RULES[-1:])
    assert name_of(masses()) == "condensed"


def test_the_table_prints_a_line_a_rule_in_order():
    lines = table().splitlines()
    assert [line[: len(rule.name)] for line, rule in zip(lines, RULES, strict=True)] == [
        rule.name for rule in RULES
    ]
    assert all(line.endswith(rule.when) for line, rule in zip(lines, RULES, strict=True))
    assert len({len(line) - len(rule.when) for line, rule in zip(lines, RULES, strict=True)}) == 1


@together("rule", RULES)
def test_choices_are_said_in_both_languages(rule):
    problem = masses(3)
    said, template = method_of(rule, problem), find(rule.said)
    en, fr = (sentence(said.code, said.data, language) for language in ("en", "fr"))
    assert en != fr
    assert ("{q}" in template.en) == ("{q}" in template.fr)
    if "{q}" in template.en:
        assert str(problem.interface.size) in en
        assert str(problem.interface.size) in fr
