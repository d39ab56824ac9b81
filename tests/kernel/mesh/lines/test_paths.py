"""Ways along networks of lines."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.lines import network_of_lines, shortest_line
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def network():
    """A square 0 1 2 3 of four cells, a tail 2 4, a lone cell 5 6; cells of any sense."""
    nodes = NodeTable()
    at = [(0, 0), (1, 0), (1, 1), (0, 1.5), (2, 1), (5, 0), (6, 0)]
    ids = nodes.add(np.array([(x, y, 0.0) for x, y in at]), np.zeros(len(at)))
    cells = ids[np.array([[1, 0], [1, 2], [3, 2], [3, 0], [4, 2], [5, 6]])]
    return ids, Mesh.of(nodes, "SEG2", cells)


def test_the_shortest_way_is_taken_and_described_from_its_beginning():
    ids, mesh = network()
    assert network_of_lines(mesh)
    found = shortest_line(mesh, int(ids[0]), int(ids[4]))
    np.testing.assert_array_equal(
        found.blocks[0].connectivity, ids[np.array([[0, 1], [1, 2], [2, 4]])]
    )


def test_points_that_no_way_joins_are_refused():
    ids, mesh = network()
    with pytest.raises(MeshError, match="no way"):
        shortest_line(mesh, int(ids[0]), int(ids[5]))
    with pytest.raises(MeshError, match="ends"):
        shortest_line(mesh, int(ids[0]), int(ids[0]))
