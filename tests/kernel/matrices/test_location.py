"""Points are found in the cell that holds them: each kind of cell, mixed, crooked, in space."""

import numpy as np
from together import together

from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS, shape_functions
from ssilang.kernel.matrices.location import locate
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable

KINDS = ("SEG2", "SEG3", "TRI3", "TRI6", "QUA4", "QUA8", "TET4", "TE10", "PYR5", "PRI6", "PR15",
         "CUB8", "CU20")  # fmt: skip
R = np.linalg.qr(np.random.default_rng(2).standard_normal((3, 3)))[0]


def inner(shape, n, rng):
    """Reference points inside a cell."""
    d = {"line": 1, "triangle": 2, "quadrangle": 2}.get(shape, 3)
    x = rng.uniform(-0.95, 0.95, (n, d))
    if shape in ("triangle", "tetrahedron"):
        x = rng.dirichlet(np.ones(d + 1), n)[:, :d]
    elif shape == "prism":
        x[:, :2] = rng.dirichlet(np.ones(3), n)[:, :2]
    elif shape == "pyramid":
        x[:, 2] = rng.uniform(0.05, 0.9, n)
        x[:, :2] *= (1 - x[:, 2:]) * 0.95
    return x


@together("kind", KINDS)
def test_a_point_is_where_the_shape_functions_put_it(kind):
    rng = np.random.default_rng(1)
    cell, table = REFERENCE_CELLS[kind], NodeTable()
    d = cell.nodes.shape[1]
    turn = R if d < 3 else np.eye(3)  # lines and surfaces stand anywhere in space
    corners = []
    for far in (0.0, 6.0):
        x = cell.nodes + rng.uniform(-0.05, 0.05, cell.nodes.shape) * (cell.nodes.shape[0] > 2)
        x = np.column_stack([x, np.zeros((len(x), 3 - d))])
        corners.append((x + np.array([far, 0, 0])) @ turn.T)
    ids = table.add(np.concatenate(corners)).reshape(2, -1)
    block = CellBlock.make(table, kind, ids)
    at = inner(cell.shape, 8, rng)
    shapes = shape_functions(kind, at)
    which = np.array([0, 1] * 4)
    points = np.einsum("pk,pkd->pd", shapes, np.array(corners)[which])
    lost = np.array([[3.2, 0.0, 0.0], [-20.0, 0.0, 0.0]]) @ turn.T
    if d < 3:  # beside its line or surface
        lost = np.concatenate([lost, points[:1] + 0.05 * turn[:, 2]])
    if cell.shape in ("triangle", "tetrahedron", "prism", "pyramid"):  # in the corner of its box
        lost = np.concatenate([lost, [turn @ np.pad(np.full(d, 0.8), (0, 3 - d))]])
    ((cells, found),) = locate(Mesh(table, (block,)), np.concatenate([points, lost]))
    assert cells.tolist() == [*which.tolist(), *[-1] * len(lost)]
    back = np.einsum("pk,pkd->pd", found[:8], np.array(corners)[which])
    np.testing.assert_allclose(back, points, atol=1e-9)
    np.testing.assert_allclose(found[:8], shapes, atol=1e-7)


def test_the_first_block_that_holds_a_point_has_it():
    table = NodeTable()
    x = np.array([[0, 0], [2, 0], [2, 2], [0, 2], [4, 0.0], [4, 2]])
    ids = table.add(x)
    quads = CellBlock.make(table, "QUA4", ids[[[0, 1, 2, 3]]])
    tris = CellBlock.make(table, "TRI3", ids[[[1, 4, 5], [1, 5, 2], [0, 1, 2]]])
    points = np.array([[1, 0.5, 0], [3.5, 0.5, 0], [2.5, 1.5, 0], [2.0, 1.0, 0], [5, 5, 0.0]])
    first, second = locate(Mesh(table, (quads, tris)), points)
    assert first[0].tolist() == [0, -1, -1, 0, -1]
    assert second[0].tolist() == [-1, 0, 1, -1, -1]
    only = locate(Mesh(table, (tris,)), points)[0]
    assert only[0][0] == 2
    assert locate(Mesh(table, (quads,)), points[:0])[0][0].tolist() == []
    near = np.array([[2.0 + 1e-7, 1.0, 0.0], [2.001, 1.0, 0.0]])
    assert locate(Mesh(table, (quads,)), near)[0][0].tolist() == [0, -1]
    assert locate(Mesh(table, (quads,)), near, 0.01)[0][0].tolist() == [0, 0]
