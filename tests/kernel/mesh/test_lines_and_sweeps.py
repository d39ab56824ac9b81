"""Subdivision, lines, curves, grids and sweeps against closed forms."""

import math

import numpy as np
import pytest
from references.straight_line import straight_line

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.generators.sweep import (
    rotation,
    ruling,
    sweep_line,
    sweep_surface,
    translation,
)
from ssilang.kernel.mesh.lines.curves import arc_about_axis, arc_through, cubic_through, parabola
from ssilang.kernel.mesh.lines.lines import line_chain, mesh_curve
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import reversed_line, signed_volumes, surface_normals
from ssilang.kernel.mesh.queries.measure import total_measure
from ssilang.kernel.mesh.surfaces.grid import grid_surface, sides_in_order


def line_between(nodes: NodeTable, a: list[float], b: list[float], n: int, q: bool = False) -> Mesh:
    ids = nodes.add(np.array([a, b], dtype=float))
    return straight_line(nodes, int(ids[0]), int(ids[1]), n, quadratic=q)


def test_graded_sizes_follow_a_geometric_progression_between_the_densities() -> None:
    cuts = subdivide(10.0, 0.2, 1.0)
    sizes = np.diff(cuts.fractions) * 10.0
    assert sizes[1:] / sizes[:-1] == pytest.approx(sizes[1] / sizes[0])
    # the element sizes bracket the densities asked for at the ends
    assert pytest.approx(sizes[0], rel=0.15) == 0.2
    assert pytest.approx(sizes[-1], rel=0.15) == 1.0


def test_equal_densities_give_equal_elements() -> None:
    assert subdivide(1.0, 0.24, 0.24).count == 4
    assert subdivide(1.0, 0.24, 0.24).fractions == pytest.approx(np.linspace(0, 1, 5))


def test_missing_density_is_an_error() -> None:
    with pytest.raises(MeshError, match="positive"):
        subdivide(1.0, 0.0, 0.1)


def test_arc_of_seg3_has_its_middles_on_the_circle() -> None:
    nodes = NodeTable()
    start = int(nodes.add(np.array([[2.0, 0, 0]]))[0])
    axis = np.array([0.0, 0, 1])
    arc = arc_about_axis(nodes.coordinates[start].copy(), np.zeros(3), axis, math.pi / 2)
    line = mesh_curve(nodes, arc, start, None, subdivide(arc.length, count=4), quadratic=True)
    at = nodes.coordinates[line_chain(line)]
    assert np.linalg.norm(at, axis=1) == pytest.approx(2.0)
    assert at[-1] == pytest.approx([0.0, 2.0, 0.0], abs=1e-12)
    assert total_measure(line) == pytest.approx(math.pi, rel=1e-4)


def test_arc_through_three_points_takes_the_way_over_the_middle_one() -> None:
    a, m, b = (np.array(p, dtype=float) for p in ([1, 0, 0], [0, -1, 0], [0, 1, 0]))
    arc = arc_through(a, m, b)
    assert arc.length == pytest.approx(1.5 * math.pi)
    assert arc(np.array([1.0]))[0] == pytest.approx(b, abs=1e-12)


def test_parabola_spaces_its_nodes_by_length() -> None:
    curve = parabola(*(np.array(p, dtype=float) for p in ([0, 0, 0], [1, 2, 0], [2, 0, 0])))
    # y = 2 x - x**2 on 0..2: length sqrt(5) + asinh(2) / 2
    assert curve.length == pytest.approx(math.sqrt(5) + math.asinh(2) / 2, rel=1e-10)
    at = curve(np.linspace(0, 1, 401))
    assert at[:, 1] == pytest.approx(2 * at[:, 0] - at[:, 0] ** 2)
    steps = np.linalg.norm(np.diff(at, axis=0), axis=1)
    assert steps == pytest.approx(steps.mean(), rel=1e-4)


def test_cubic_goes_through_its_points() -> None:
    points = [np.array(p, dtype=float) for p in ([0, 0, 0], [1, 1, 0], [2, -1, 1], [3, 0, 0])]
    at = cubic_through(*points, regular=False)(np.array([0.0, 1 / 3, 2 / 3, 1.0]))
    assert at == pytest.approx(np.array(points), abs=1e-12)


@pytest.mark.parametrize("quadratic", [False, True])
def test_grid_is_regular_on_a_rectangle(quadratic: bool) -> None:
    nodes = NodeTable()
    c = nodes.add(np.array([[0.0, 0], [3, 0], [3, 2], [0, 2]])).tolist()
    counts = (6, 4, 6, 4)
    sides = [
        straight_line(nodes, c[k], c[(k + 1) % 4], n, quadratic=quadratic)
        for k, n in enumerate(counts)
    ]
    made = grid_surface(sides_in_order([sides[0], reversed_line(sides[1]), *sides[2:]]), None)
    block = made.single_block()
    assert (made.n_cells, block.cell_type) == (24, "QUA8" if quadratic else "QUA4")
    assert surface_normals(block)[:, 2] == pytest.approx(0.25)


def test_graded_grid_keeps_its_lines_straight() -> None:
    nodes = NodeTable()
    c = nodes.add(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])).tolist()
    low = straight_line(nodes, c[0], c[1], -5, (0.1, 0.4))
    high = straight_line(nodes, c[2], c[3], -5, (0.4, 0.1))
    sides = [low, straight_line(nodes, c[1], c[2], 3), high, straight_line(nodes, c[3], c[0], 3)]
    made = grid_surface(sides, None)
    x = np.unique(nodes.coordinates[made.node_ids, 0].round(9))
    assert x == pytest.approx(nodes.coordinates[line_chain(low), 0], abs=1e-8)


def test_turned_line_sweeps_a_ring() -> None:
    nodes = NodeTable()
    line = line_between(nodes, [1, 0, 0], [2, 0, 0], 4, True)
    path = rotation(line, 90.0, np.zeros(3), np.array([0.0, 0, 1]))
    made = sweep_line(line, path, subdivide(path.length, count=8), "QUA8")
    assert total_measure(made) == pytest.approx(math.pi * 3 / 4, rel=1e-5)
    right = made.sides[1]
    assert np.linalg.norm(nodes.coordinates[right.node_ids], axis=1) == pytest.approx(2.0)


def test_sides_of_a_swept_surface_run_round_it() -> None:
    nodes = NodeTable()
    line = line_between(nodes, [0, 0, 0], [1, 0, 0], 2)
    made = sweep_line(line, translation(np.array([0.0, 1, 0])), subdivide(1.0, count=3), "QUA4")
    chains = [line_chain(s) for s in made.sides]
    assert all(chains[k][-1] == chains[(k + 1) % 4][0] for k in range(4))


@pytest.mark.parametrize("surface", ["QUA4", "TRI3", "QUA8", "TRI6"])
def test_swept_volume_is_exact_and_well_turned(surface: str) -> None:
    nodes = NodeTable()
    line = line_between(nodes, [0, 0, 0], [1, 0, 0], 2, surface in ("QUA8", "TRI6"))
    y, z = np.array([0.0, 2.0, 0]), np.array([0.3, 0, 1.5])
    floor = sweep_line(line, translation(y), subdivide(2.0, count=3), surface)
    made = sweep_surface(floor, translation(z), subdivide(1.5, count=2))
    assert total_measure(made) == pytest.approx(3.0, rel=1e-12)
    assert (signed_volumes(made.single_block()) > 0).all()


def test_ruling_refuses_lines_of_other_cuts() -> None:
    nodes = NodeTable()
    first = line_between(nodes, [0, 0, 0], [1, 0, 0], 2)
    with pytest.raises(MeshError, match="same structure"):
        ruling(first, line_between(nodes, [0, 1, 0], [1, 1, 0], 3))
