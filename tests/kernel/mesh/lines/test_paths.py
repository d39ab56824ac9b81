"""Ways along networks of lines."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.lines import (
    frenet_frames,
    line_chain,
    network_of_lines,
    shortest_line,
)
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


@together("kind", ["SEG2", "SEG3"])
@together("closed", [False, True])
def test_cells_of_a_line_in_no_order_are_put_one_behind_the_other(kind, closed):
    nodes, step = NodeTable(), 1 if kind == "SEG2" else 2
    angle = np.arange(5 * step + 1) * 1.1 / step
    ids = nodes.add(np.column_stack([np.cos(angle), np.sin(angle), angle]))[::-1].copy()
    chain = np.append(ids[:-1], ids[0]) if closed else ids
    cells = np.stack([chain[k : len(chain) - step + k : step] for k in range(step + 1)], axis=1)
    found = line_chain(Mesh.of(nodes, kind, cells[[3, 0, 4, 1, 2]]))
    wanted = chain if not closed else np.roll(chain[:-1], -3 * step).tolist()
    assert found.tolist()[: len(wanted)] == list(wanted)
    assert (found[0] == found[-1]) is np.bool_(closed)
    back = cells.copy()
    back[2] = back[2, ::-1]
    assert line_chain(Mesh.of(nodes, kind, back)).tolist() == chain.tolist()
    with pytest.raises(MeshError, match="follow"):
        line_chain(Mesh.of(nodes, kind, cells[[0, 1, 3]]))


def test_frames_of_an_arc_in_space_are_those_of_its_circle():
    """Uneven steps in a slanted plane, nodes and cells in no order; at both ends along the cell."""
    nodes, order = NodeTable(), np.array([3, 0, 4, 1, 2])
    nodes.add(np.ones((3, 3)))
    across, up, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    c, s = (f(np.cumsum([0.3, 0.2, 0.5, 0.1, 0.4]))[:, None] for f in (np.cos, np.sin))
    out, along = c * across + s * up, c * up - s * across
    ids = nodes.add([3.0, -1.0, 2.0] + 2.0 * out[order])[np.argsort(order)]
    cells = np.column_stack([ids[:-1], ids[1:]])[[2, 0, 3, 1]]
    found, frames = frenet_frames(Mesh.of(nodes, "SEG2", cells))
    frames = frames[np.searchsorted(found, ids)]
    binormal = np.cross(along, -out)
    ends = np.diff(out, axis=0)[[0, -1]]
    along[[0, -1]] = ends / np.linalg.norm(ends, axis=1, keepdims=True)
    wanted = np.stack([along, np.cross(binormal, along), binormal], axis=1)
    np.testing.assert_allclose(frames, wanted, atol=1e-12)


@together("to, binormal", [([0.6, 0, 0.8], [-0.8, 0, 0.6]), ([0, 0, 1], [0, 1, 0])])
@together("count", [1, 3])
def test_straight_lines_have_their_binormal_near_the_z_axis(count, to, binormal):
    nodes = NodeTable()
    ids = nodes.add(np.arange(count + 1)[:, None] ** 1.5 * np.array(to))
    line = Mesh.of(nodes, "SEG2", np.column_stack([ids[:-1], ids[1:]]))
    wanted = [to, np.cross(binormal, to), binormal]
    np.testing.assert_allclose(frenet_frames(line)[1], [wanted] * (count + 1), atol=1e-12)
    with pytest.raises(MeshError, match="branches"):
        frenet_frames(Mesh.of(nodes, "SEG2", [*line.blocks[0].connectivity, ids[[0, -1]]][-2:]))
