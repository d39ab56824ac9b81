"""Cables in a body: slips, ties and limits of friction by their definitions, node by node."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.contact.cable import Bars, cable_relations
from ssilang.kernel.elements.shapes.reference import shape_functions
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

BOX = np.array([[0, 0, 0], [6, 0, 0.5], [6.5, 5, 0], [0, 5.5, 0], [0, 0, 4], [6, 0, 4], [6, 5, 4.5],
                [0, 5, 4]])  # fmt: skip
PLANE = BOX[:4, :2]


class Cable:
    """Four bars, of which two run the other way; its last node is out of the body."""

    def __init__(self, dim):
        rng = np.random.default_rng(dim)
        self.dim, self.table = dim, NodeTable()
        corners = BOX if dim == 3 else PLANE
        self.body = Mesh.of(self.table, "CUB8" if dim == 3 else "QUA4",
                            self.table.add(corners)[None])  # fmt: skip
        kind = "CUB8" if dim == 3 else "QUA4"
        at = np.array([[-0.7, -0.5, -0.6], [-0.3, 0.1, -0.2], [0.2, 0.3, 0.3], [0.6, -0.2, 0.5]])
        self.shapes = shape_functions(kind, at[:, :dim])
        x = self.shapes @ corners
        x = np.vstack([x, x[-1] + [3.0, 0.4, 0.7][:dim]])
        self.nodes = self.table.add(x)
        pairs = [(0, 1), (2, 1), (2, 3), (4, 3)]
        self.cells = self.nodes[np.array(pairs)]
        self.line = Mesh.of(self.table, "SEG2", self.cells)
        self.x = self.table.coordinates[:, :dim]
        self.bars = Bars(self.cells, *rng.uniform(0.5, 2.0, (4, 4)))
        self.names = ("UX", "UY", "UZ")[:dim]
        self.u = 1e-3 * rng.standard_normal((len(self.table), dim))

    def values(self, relations):
        """Left sides of relations for the displacements, and their multipliers' rows' names."""
        terms = relations.coefficients * np.array([
            self.u[n, self.names.index(name)]
            for n, name in zip(relations.nodes, relations.unknowns, strict=True)
        ])  # fmt: skip
        return np.add.reduceat(terms, relations.row_start[:-1])

    def moved_off(self, k):
        """Displacement of a node of the cable less that of the body there."""
        inner = self.u[self.body.single_block().connectivity[0]]
        return self.u[self.nodes[k]] - self.shapes[k] @ inner

    def way(self, k):
        """Mean direction of the bars at a node, from the first to the last."""
        p = self.x[self.nodes]
        legs = np.diff(p, axis=0) / np.linalg.norm(np.diff(p, axis=0), axis=1)[:, None]
        mean = legs[max(k - 1, 0) : k + 1].sum(axis=0)
        return mean / np.linalg.norm(mean)


@together("dim", [2, 3])
def test_nodes_slip_along_the_cable_and_follow_across(dim):
    c = Cable(dim)
    made = cable_relations(c.line, c.bars, c.body, c.names)
    slips = c.values(made.friction.slip)
    rubbing = [int(n) for n in made.friction.slip.nodes[made.friction.slip.row_start[:-1]]]
    assert sorted(rubbing) == sorted(c.nodes[:4].tolist())
    for node, slip in zip(rubbing, slips, strict=True):
        k = c.nodes.tolist().index(node)
        assert abs(slip) == pytest.approx(abs(c.way(k) @ c.moved_off(k)), rel=1e-9)
    ties = c.values(made.ties)
    assert len(ties) == 4 * (dim - 1)
    across = {}
    for row, value in enumerate(ties):
        node = int(made.ties.nodes[made.ties.row_start[row]])
        across[node] = across.get(node, 0.0) + value**2
    assert set(across) == set(c.nodes[:4].tolist())


@together("dim", [2, 3])
def test_limits_are_the_mean_tension_times_turn_and_length(dim):
    """dT = T (f d alpha + phi d s), T growing with the stretch of each bar."""
    c = Cable(dim)
    made = cable_relations(c.line, c.bars, c.body, c.names).friction
    found = c.values(made.tension) + made.offset
    p = c.x[c.nodes]
    legs = np.diff(p, axis=0)
    length = np.linalg.norm(legs, axis=1)
    legs = legs / length[:, None]
    stretch = np.einsum("nd,nd->n", np.diff(c.u[c.nodes], axis=0), legs)
    b = c.bars
    T = b.tension + b.stiffness * stretch
    rubbing = [int(n) for n in made.slip.nodes[made.slip.row_start[:-1]]]
    for node, limit in zip(rubbing, found, strict=True):
        k = c.nodes.tolist().index(node)
        if k == 0:
            expected = b.linear[0] * length[0] / 2 * T[0]
        else:
            i, j = k - 1, k
            turn = np.arccos(legs[i] @ legs[j])
            whole = sum(b.linear[m] * length[m] / 2 + b.angular[m] * turn / 2 for m in (i, j))
            expected = whole * (T[i] + T[j]) / 2
        assert limit == pytest.approx(expected, rel=1e-9)
    assert not made.coefficient.any()
    assert not made.constant.any()
    assert made.width == 1


def test_cables_that_branch_or_lie_nowhere_are_refused():
    c = Cable(2)
    fork = np.vstack([c.cells, [[c.nodes[1], c.nodes[4]]]])
    bars = Bars(fork, *np.ones((4, 5)))
    with pytest.raises(MeshError, match="branch"):
        cable_relations(Mesh.of(c.table, "SEG2", fork), bars, c.body, c.names)
    far = c.table.add(np.array([[20.0, 0], [21.0, 0]]))[None]
    with pytest.raises(MeshError, match="cable"):
        cable_relations(Mesh.of(c.table, "SEG2", far), Bars(far, *np.ones((4, 1))), c.body, c.names)
