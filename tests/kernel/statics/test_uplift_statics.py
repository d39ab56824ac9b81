"""Footings on joints that lift off, by load steps, and beams held by stops alone."""

import itertools

import numpy as np
import pytest
from references.assembled import Bench
from references.footing import Strip
from references.recorder import Recorder
from together import together

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.matrices.relations import blocked
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.statics.linear import solve
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.stepping.state import EXTERNAL

STRIP = Strip(4.0, 1.0, 2e7, 6e5)


def strip_problem(times, rotation, cells=16, degree=1):
    """Rigid line on joints: UY of its nodes follows its two ends; theta = (uR - uL)/B."""
    bench = Bench()
    n = cells * degree + 1
    x = np.linspace(-2.0, 2.0, n)
    top = [bench.node(s, 0.0) for s in x]
    soil = [bench.node(s, 0.0) for s in x]
    for node in soil:
        bench.fix(node)
    bench.fix(top[0], "UX")
    for i in range(1, n):
        bench.relate([(1.0, "UX", top[i]), (-1.0, "UX", top[0])])
    for i in range(1, n - 1):
        c = (x[i] + 2.0) / 4.0
        bench.relate([(1.0, "UY", top[i]), (c - 1, "UY", top[0]), (-c, "UY", top[-1])])
    turn = bench.relate([(0.25, "UY", top[-1]), (-0.25, "UY", top[0])])
    starts = range(0, n - 1, degree)
    cellsn = [[*top[i : i + degree + 1], *soil[i : i + degree + 1]] for i in starts]
    kind = ("RAC2", "JOI2") if degree == 1 else ("RAC3", "JOI3")
    bench.joint(kind[0], cellsn, kind[1], KN=STRIP.k0, KS=STRIP.k0)
    half = len(top) // 2
    weight = LoadPart("MECA", bench.field((top[half], "FY", -STRIP.normal)))
    imposed = NodeField.of(bench.table, np.array([turn]), {"FLX": np.array([1.0])})
    curve = Curve((CurvePart(np.asarray(times, float), np.asarray(rotation, float)),))
    return (
        bench.problem(np.asarray(times, float), Load((weight, LoadPart("DIMP", imposed, curve)))),
        soil,
        x,
    )


def moments(problem, soil, x):
    recorder = Recorder(len(problem.times))
    history = step_statics(problem, [recorder])
    forces = np.array([s.reactions.values_at("FY", np.array(soil)) for s in recorder.snapshots])
    order = np.argsort(soil)
    assert (np.diff(order) == 1).all()
    return -forces @ x, forces.sum(axis=1), history


@together("degree, within", [(1, 3e-3), (2, 3e-3)])
def test_strip_moment_follows_the_closed_form(degree, within):
    ratios = np.array([0.0, 1e-9, 0.5, 1.5, 2.0, 5.0, 10.0])
    theta = ratios * STRIP.uplift_rotation
    problem, soil, x = strip_problem(np.arange(7.0), theta, degree=degree)
    found, vertical, _ = moments(problem, soil, x)
    exact = STRIP.moment(theta)
    np.testing.assert_allclose(vertical[1:], STRIP.normal, rtol=1e-9)
    np.testing.assert_allclose(found[2:], exact[2:], rtol=within)


def test_path_of_load_steps_does_not_matter():
    last = 5 * STRIP.uplift_rotation
    one, soil, x = strip_problem([0.0, 1.0], [0.0, last])
    many, _, _ = strip_problem(np.arange(12.0), np.linspace(0.0, last, 12))
    np.testing.assert_allclose(
        moments(one, soil, x)[0][-1], moments(many, soil, x)[0][-1], rtol=1e-9
    )


def test_external_work_is_stored():
    theta = np.linspace(0, 5 * STRIP.uplift_rotation, 400)
    problem, soil, x = strip_problem(np.arange(400.0), theta)
    _, _, history = moments(problem, soil, x)
    # weight is there from the start, its first step works as a jump; compare from step 1 on
    drift = history.imbalance[1:] - history.imbalance[1]
    assert np.abs(drift).max() < 1e-3 * STRIP.energy(theta[-1])


def test_full_uplift_is_named():
    bench = Bench()
    soil, body = bench.node(0.0, -1.0), bench.node(0.0, 0.0)
    bench.fix(soil)
    bench.fix(body, "UX")
    bench.joint("SEG2", [soil, body], "JOI1", KN=1e6, KS=0.0)
    load = bench.load(bench.field((body, "FY", 1.0)), [0.0, 1.0, 2.0], [-1.0, -1.0, 1.0])
    with pytest.raises(ConvergenceError, match="full uplift") as error:
        step_statics(bench.problem(np.arange(3.0), load))
    assert "time 2" in str(error.value)


def held_by_relations(forces):
    """A rigid beam of 2 m on three unilateral supports, loaded at its ends in steps."""
    bench = Bench()
    x = [-1.0, 0.0, 1.0]
    nodes = [bench.node(s, 0.0) for s in x]
    for a, b in itertools.pairwise(nodes):
        bench.spring(0.0, a, b)
    bench.spring(0.0, nodes[0], unknown="UX")
    for n in nodes:
        bench.relate([(1.0, "UY", n)], sense=1)
    bench.fix(nodes[0], "UX")
    bench.relate([(1.0, "UY", nodes[0]), (-2.0, "UY", nodes[1]), (1.0, "UY", nodes[2])])
    loads = [bench.field((nodes[0], "FY", f[0]), (nodes[2], "FY", f[1])) for f in forces]
    steps = tuple((float(i), field) for i, field in enumerate(loads))
    problem = bench.problem(np.arange(float(len(forces))), Load((LoadPart("MECA", steps=steps),)))
    recorder = Recorder(len(forces))
    step_statics(problem, [recorder])
    where = [problem.numbering.index_of(n, "UY") for n in nodes]
    return recorder.of("contact"), recorder.of("u")[:, where]


def test_body_held_by_unilateral_relations_alone_is_in_balance():
    contact, u = held_by_relations([(0.0, 0.0), (-3.0, -1.0), (-1.0, -1.0)])
    np.testing.assert_allclose(contact[1:].sum(axis=1), [4.0, 2.0], rtol=1e-12)
    np.testing.assert_allclose(contact[1:] @ [-1.0, 0.0, 1.0], [-2.0, 0.0], atol=1e-12)
    assert (u > -1e-12).all()


def test_overturned_body_has_no_equilibrium():
    with pytest.raises(ConvergenceError, check=lambda e: e.code == "kernel.statics.at-load-step"):
        held_by_relations([(0.0, 0.0), (-1.0, 2.0)])


@together("factors", [[1.0, 1.0, 1.0], [0.5, 1.0, 2.0], [0.0, 1.0, 2.0]])
@together("joint", [False, True])
def test_a_load_that_is_there_at_the_start_does_the_work_of_one_that_grows(factors, joint):
    """Its work is what is stored, F^2 / 2k, whatever the first instant finds out of balance."""
    bench = Bench()
    low, top = bench.node(0.0, 0.0), bench.node(0.0, 1.0)
    bench.fix(low)
    bench.fix(top, "UX")
    if joint:
        bench.joint("SEG2", [low, top], "JOI1", KN=4e5, KS=0.0)
        bench.spring(1e5, top)
    else:
        bench.spring(5e5, top)
    times = np.arange(3.0)
    problem = bench.problem(times, bench.load(bench.field((top, "FY", -3e3)), times, factors))
    history = step_statics(problem, [Recorder(3)])
    force = 3e3 * np.array(factors[1:])
    np.testing.assert_allclose(history.energies[1:, EXTERNAL], force**2 / 1e6, rtol=1e-9)
    assert np.abs(history.imbalance).max() <= 1e-9 * history.energies[-1, EXTERNAL]


PLAY = 0.01


def beam(n, stiffness, length=10.0):
    """A free Euler beam of n elements along X: its matrix and its nodes."""
    table = NodeTable()
    ids = table.add(np.column_stack([np.linspace(0.0, length, n + 1), np.zeros(n + 1)]))
    h = length / n
    k = stiffness / h**3 * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
    )  # fmt: skip
    cells = np.column_stack([ids[:-1], ids[1:]])
    local, names, forces = np.array([0, 0, 1, 1]), ("UY", "RZ") * 2, ("FY", "MZ") * 2
    block = ElementMatrices(table, cells, local, names, forces, np.tile(k, (n, 1, 1)))
    return Matrix(table, (block,)), ids


def with_stops(body, stops, both_sides):
    """Stops below at zero and, if asked for, above at PLAY; the imposed values."""
    below = blocked(body.table, stops, ["UY"], 1)
    if not both_sides:
        return Matrix(body.table, body.blocks, (below,)), {}
    above = blocked(body.table, stops, ["UY"], -1)
    nodes = above.multipliers
    values = {"FLX": NodeValues(nodes, np.full(len(nodes), PLAY))}
    return Matrix(body.table, body.blocks, (below, above)), values


def check(matrix, solution, stops, force):
    """No crossing, no pulling, no push across a gap, for each family of stops."""
    y = solution.values_at("UY", stops)
    near = 1e-7 * np.abs(solution.components["UY"].values).max() + 1e-15
    small = 1e-7 * np.abs(force).sum()
    for relation, gap, sign in zip(matrix.relations, (y, PLAY - y), (-1.0, 1.0), strict=False):
        push = sign * solution.values_at("LX", relation.multipliers)
        assert gap.min() >= -near
        assert push.min() >= -small
        assert np.abs(push * gap).max() <= 10.0 * small * max(near / 1e-7, 1e-9)


@pytest.mark.parametrize("both_sides", [False, True])
def test_beams_on_stops_alone_obey_the_laws_of_contact(both_sides):
    draw = np.random.default_rng(7)
    solved = 0
    for _ in range(60):
        n = int(draw.integers(2, 40))
        body, ids = beam(n, 10.0 ** draw.uniform(2, 8))
        stops = np.sort(draw.choice(ids, size=int(draw.integers(2, n + 2)), replace=False))
        force = 3.0 * draw.standard_normal(n + 1) - 1.0
        x = np.linspace(0.0, 10.0, n + 1)
        centre = force @ x / force.sum()
        if not both_sides and not (force.sum() < 0.0 and x[stops[0]] < centre < x[stops[-1]]):
            continue  # it falls off
        matrix, imposed = with_stops(body, stops, both_sides)
        load = NodeField(body.table, {"FY": NodeValues(ids, force), **imposed}, "DISCRET")
        check(matrix, solve(matrix, [load])[0], stops, force)
        solved += 1
    assert solved > 20


def test_a_beam_that_tips_off_its_stops_is_refused():
    body, ids = beam(10, 1e5)
    matrix, _ = with_stops(body, ids[:4], False)
    force = NodeField(body.table, {"FY": NodeValues(ids[-1:], np.array([-1.0]))}, "DISCRET")
    with pytest.raises(
        ConvergenceError,
        match=r"unilateral.*held by them alone: translation along Y, rotation about Z",
    ):
        solve(matrix, [force])
