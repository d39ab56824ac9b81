"""The compiled loop of unilateral relations against the plain sparse one."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder, assert_alike, recorded
from together import together

from ssilang.kernel.contact.active_set import active_set_of, anew, find_active, list_closed
from ssilang.kernel.contact.modal import takes
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.solvers.active_set.complementarity import ContactProblem, solve_contact
from ssilang.kernel.stepping.choose import Case, Rule, only, rule_of
from ssilang.kernel.stepping.keeping import Cut
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht
from ssilang.kernel.stepping.problem.initial import closed_at_start
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.run import Integration, integrate

FEET, K, M = 6, 4e5, 20.0


def feet(
    options=None, scheme=None, steps=100, damping="Rayleigh", moving=False, lid=False, twice=False
) -> Problem:
    """Masses in a row over stops, joined by springs, that are shaken and rebound.

    `moving`: a stop rises and sinks; `lid`: a mass has a ceiling too (MAXI); `twice`: one relation
    is said twice.
    """
    bench = Bench()
    nodes = [bench.node(float(i), 0.0) for i in range(FEET)]
    stops = []
    for i, node in enumerate(nodes):
        bench.mass(M * (1 + 0.1 * i), node)
        bench.fix(node, "UX")
        stops.append(bench.relate([(1.0, "UY", node)], sense=1))
        if i:
            bench.spring(K, nodes[i - 1], node)
        if i > 1:
            bench.spring(0.3 * K, nodes[i - 2], node)
    bench.spring(0.02 * K, nodes[0])
    if lid:
        bench.relate([(1.0, "UY", nodes[2])], sense=-1)
    if twice:
        bench.relate([(2.0, "UY", nodes[1])], sense=1)
    t = 2e-3 * np.arange(steps + 1)
    weight = bench.field(*((n, "FY", -60.0 * M) for n in nodes))
    push = bench.field((nodes[0], "FY", 900.0), (nodes[-1], "FY", -900.0))
    parts = bench.load(weight).parts + bench.load(push, t, np.sin(17.0 * t)).parts
    if moving:
        imposed = NodeField.of(bench.table, np.array([stops[-1]]), {"FLX": np.array([1.0])})
        parts += bench.load(imposed, t, 0.02 * np.sin(11.0 * t)).parts
    C = {"none": None, "Rayleigh": rayleigh(bench), "dashpots": dashpots(bench, nodes)}[damping]
    fall = bench.field(*((n, "UY", 0.002 * (i + 1)) for i, n in enumerate(nodes)))
    return bench.problem(
        t,
        damping=C,
        load=Load(parts),
        displacement=fall,
        scheme=scheme or Scheme(),
        contact_options=options or ContactOptions(correction="MASSE"),
    )


def rayleigh(bench: Bench) -> Matrix:
    """0.6 M + 1e-4 K."""
    blocks = bench.mass_matrix.scaled(0.6).blocks + bench.stiffness.scaled(1e-4).blocks
    return Matrix(bench.table, blocks, kind="AMORTISSEMENT")


def dashpots(bench: Bench, nodes: list[int]) -> Matrix | None:
    """One on the first mass."""
    bench.dashpot(300.0, nodes[0])
    return bench.damping


def rule(problem: Problem, full: bool = False) -> Rule:
    """The rule that gives the problem's loop."""
    closed = np.zeros(len(problem.contact), bool)
    return rule_of(Case(problem, Integration(problem).motion, 2e-3, full, closed))


def both(problem, monkeypatch):
    """Records and histories of the compiled loop and of the sparse one.

    Impacts of several bodies are chaotic: the sparse loop itself, started one rounding apart, is
    1e-7 apart after 400 steps. The motions are short for that (see `roundings`).
    """
    assert takes(problem)
    one, found = recorded(problem)
    monkeypatch.setattr("ssilang.kernel.stepping.choose.RULES", only("condensed"))
    two, exact = recorded(problem)
    assert exact.loop == "condensed"
    return one, found, two, exact


def agree(one, found, two, exact, tolerance=1e-9):
    assert_alike((one, found), (two, exact), ("u", "v", "a", "reaction", "contact"), tolerance)
    closed = (two.of("contact") > 0.0).mean()
    assert 0.01 < closed < 0.999  # they lift off, and they stand


OPTIONS = {
    "no correction": ContactOptions(),
    "by mass": ContactOptions(correction="MASSE"),
    "by stiffness": ContactOptions(correction="RIGIDITE"),
    "persistent": ContactOptions(persistent=True),
    "both": ContactOptions(correction="MASSE", persistent=True),
    "augmented": ContactOptions("AUGMENTE", correction="MASSE"),
    "penalty": ContactOptions("PENALITE", 50 * K),
}


STEPS = 40  # 12 to 24 feet lift off or land in them


@pytest.mark.parametrize("name", OPTIONS)
def test_compiled_steps_are_the_sparse_ones(name, monkeypatch):
    problem = feet(OPTIONS[name], steps=STEPS)
    runs = both(problem, monkeypatch)
    assert runs[1].loop == "compiled"
    agree(*runs)
    assert roundings(problem, runs[2]) < 1e-9


def roundings(problem, exact):
    """How far apart rounding alone may take velocities, relative to the largest.

    Two loops that sum in another order round each step their own way. A rounding of a step's
    displacement is one of `2 u / (dt v)` roundings of the velocity (by Newmark's formula), and
    grows at most as one of the start does: impacts multiply it. `steps` of them add up.

    The growth is that of the loop `exact` started one rounding apart. In 100 steps with
    PERSISTANT it is 1e5, and 100 * 20 * 1e5 * 2e-16 exceeds the tolerance: hence 40.
    """
    u, v = (np.abs(exact.of(x)).max() for x in "uv")
    grown = 0.0
    for seed in range(3):
        way = np.random.default_rng(seed).choice([-1.0, 1.0], len(problem.u))
        other = Recorder(len(problem.times))
        integrate(replace(problem, u=problem.u * (1 + np.finfo(float).eps * way)), [other])
        grown = max(grown, np.abs(other.of("v") - exact.of("v")).max() / v)
    return len(problem.times) * 2 * u / (problem.times[1] * v) * grown


@together("scheme", [hht(0.1), generalised_alpha(0.8)])
def test_other_schemes(scheme, monkeypatch):
    agree(*both(feet(ContactOptions(), scheme, steps=40), monkeypatch))


def test_modified_mass(monkeypatch):
    problem = feet(ContactOptions(modified_mass=True), damping="none", steps=100)
    runs = both(problem, monkeypatch)
    assert runs[1].loop == "compiled"
    agree(*runs)


def test_moving_stops_and_ceilings(monkeypatch):
    agree(*both(feet(moving=True, steps=100), monkeypatch))
    monkeypatch.undo()
    agree(*both(feet(lid=True, damping="none"), monkeypatch))


@pytest.mark.parametrize("other", [{"damping": "dashpots"}, {"twice": True}])
def test_what_it_cannot_do_runs_in_the_sparse_loop(other, monkeypatch):
    runs = both(feet(steps=100, **other), monkeypatch)
    assert runs[1].loop == "condensed"
    agree(*runs)


def test_relations_that_it_leaves_to_others():
    assert takes(feet(steps=2))
    assert rule(feet(steps=2)).name == "relations on modes"
    assert not takes(feet(ContactOptions("UZAWA"), steps=2))
    assert rule(feet(steps=2), full=True).name == "full Newton"


@together("gap", [1e-19, -1e-19, 0.0])
def test_rounding_of_the_displacements_around_does_not_part_what_touches(gap):
    """A foot on rigid ground under a body that moved 1 mm: its gap is a rounding of nothing."""
    bench = Bench()
    foot, top = bench.node(0.0, 0.0), bench.node(0.0, 1.0)
    for node in (foot, top):
        bench.mass(M, node)
        bench.fix(node, "UX")
    bench.spring(K, foot, top)
    bench.relate([(1.0, "UY", foot)], sense=1)
    moved = bench.field((foot, "UY", gap), (top, "UY", -1e-3))
    problem = bench.problem(1e-3 * np.arange(3), Load(()), displacement=moved)
    assert closed_at_start(problem).tolist() == [True]
    apart = np.where(problem.u == -1e-3, problem.u, 1e-12)
    assert closed_at_start(replace(problem, u=apart)).tolist() == [False]


def test_saved_instants_and_step_lengths_do_not_matter():
    problem = feet(steps=400)
    few = Recorder(401)
    few.wanted[:] = False
    few.wanted[[0, 3, 250, 400]] = True
    integrate(problem, [few])
    whole, _ = recorded(problem, keeper=Cut(64))
    assert [s.step for s in few.snapshots] == [0, 3, 250, 400]
    for s in few.snapshots:
        np.testing.assert_allclose(s.u, whole.of("u")[s.step], rtol=0, atol=1e-12)


def test_active_sets_end_where_the_reference_ends():
    random = np.random.default_rng(5)
    for m in (1, 4, 30):
        for _ in range(20):
            A = random.standard_normal((m, m))
            W, q = A @ A.T + 0.05 * np.eye(m), random.standard_normal(m)
            rows, none = active_set_of(W, 1.0 / np.diag(W), 1e-12), np.zeros((m, 0))
            rows.closed[:] = random.random(m) < 0.5
            anew(rows)
            list_closed(rows)
            rows.free[:] = q
            assert find_active(rows) > 0
            p = np.where(rows.closed, -rows.found, 0.0)
            exact = solve_contact(ContactProblem(W, q, none, none, np.zeros(0), np.zeros(m, bool)))
            np.testing.assert_allclose(p, exact.p, atol=1e-9 * max(exact.p.max(), 1e-3))
