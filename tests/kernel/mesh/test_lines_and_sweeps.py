"""Subdivision, lines, curves, grids and sweeps against closed forms."""

import math

import numpy as np
import pytest
from references.straight_line import line_between, straight_line
from together import together

from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.generators.sweep import (
    rotation,
    sweep_line,
    sweep_surface,
    translation,
)
from ssilang.kernel.mesh.lines.curves import arc_about_axis
from ssilang.kernel.mesh.lines.lines import line_chain, mesh_curve
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import reversed_line, signed_volumes, surface_normals
from ssilang.kernel.mesh.queries.measure import total_measure
from ssilang.kernel.mesh.surfaces.grid import grid_surface, sides_in_order


def test_equal_densities_give_equal_elements() -> None:
    assert subdivide(1.0, 0.24, 0.24).count == 4
    assert subdivide(1.0, 0.24, 0.24).fractions == pytest.approx(np.linspace(0, 1, 5))


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


@together("quadratic", [False, True])
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


def test_turned_line_sweeps_a_ring() -> None:
    nodes = NodeTable()
    line = line_between(nodes, [1, 0, 0], [2, 0, 0], 4, True)
    path = rotation(line, 90.0, np.zeros(3), np.array([0.0, 0, 1]))
    made = sweep_line(line, path, subdivide(path.length, count=8), "QUA8")
    assert total_measure(made) == pytest.approx(math.pi * 3 / 4, rel=1e-5)
    right = made.sides[1]
    assert np.linalg.norm(nodes.coordinates[right.node_ids], axis=1) == pytest.approx(2.0)


@together("surfaces", ["QUA4", "TRI3", "QUA8", "TRI6", "TRI3 QUA8"])
def test_swept_volume_is_exact_and_well_turned(surfaces: str) -> None:
    nodes, floors = NodeTable(), []
    y, z = np.array([0.0, 2.0, 0]), np.array([0.3, 0, 1.5])
    for x, surface in enumerate(surfaces.split()):  # two of them stand apart
        quadratic = surface in ("QUA8", "TRI6")
        line = line_between(nodes, [3.0 * x, 0, 0], [3.0 * x + 1, 0, 0], 2, quadratic)
        floors.append(sweep_line(line, translation(y), subdivide(2.0, count=3), surface))
    made = sweep_surface(union(*floors), translation(z), subdivide(1.5, count=2))
    assert total_measure(made) == pytest.approx(3.0 * len(floors), rel=1e-12)
    assert all((signed_volumes(block) > 0).all() for block in made.blocks)
    around = made.sides[2]
    sides = 2 * 1.5 + 2 * 2.0 * math.hypot(0.3, 1.5)  # two of the four lean
    assert total_measure(around) == pytest.approx(sides * len(floors))
    assert around.n_cells == 2 * (2 + 3 + 2 + 3) * len(floors)
