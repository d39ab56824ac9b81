"""Beams held by stops alone, on one side or with play: the laws of contact, over many draws."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.matrices.relations import blocked
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.statics.linear import solve

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
