"""Numbers of the nodes that a swept surface makes (decks that say NOEUD N rely on them)."""

import numpy as np
from together import together

from ssilang.kernel.mesh.generators.sweep import sweep_line, translation
from ssilang.kernel.mesh.lines.subdivision import Subdivision
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable


@together("degree", [1, 2])
def test_far_side_then_lateral_lines_then_inside(degree):
    table = NodeTable()
    x = np.linspace(0.0, 3.0, 3 * degree + 1)
    ids = table.add(np.column_stack([x, 0.0 * x]))
    cells = np.stack([ids[i : len(ids) - degree + i : degree] for i in range(degree + 1)], axis=1)
    line = Mesh.of(table, "SEG2" if degree == 1 else "SEG3", cells)
    cuts = Subdivision(np.array([0.0, 0.5, 1.0]), 1.0, 1.0)
    sweep_line(line, translation(np.array([0.0, 2.0, 0.0])), cuts, "QUA4")
    made = table.coordinates[len(ids) :]
    n = len(ids)
    np.testing.assert_allclose(made[:n], np.column_stack([x, 0 * x + 2.0, 0 * x]))
    heights = [1.0] if degree == 1 else [0.5, 1.0, 1.5]
    side = np.array(heights)
    for k, at in enumerate((0.0, 3.0)):
        rows = made[n + k * len(side) : n + (k + 1) * len(side)]
        np.testing.assert_allclose(rows[:, 0], at)
        np.testing.assert_allclose(rows[:, 1], side)
    assert (np.diff(made[n + 2 * len(side) :, 1]) >= 0.0).all()
