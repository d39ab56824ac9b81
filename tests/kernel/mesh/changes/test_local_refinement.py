"""Local refinement: volumes kept, sizes reached, hanging nodes that follow linear fields."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.changes.local_refinement import divided_to_sizes, is_tie, parted
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.queries.measure import total_measure

CELLS = {
    "SEG2": ([[0, 0, 0], [1, 0, 0]], 1.0),
    "TRI3": ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], 0.5),
    "QUA4": ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], 1.0),
    "TET4": ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], 1 / 6),
    "PRI6": ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], 0.5),
    "CUB8": ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
              [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], 1.0),
}  # fmt: skip
GROWTH = {"SEG2": 2, "TRI3": 4, "QUA4": 4, "TET4": 8, "PRI6": 8, "CUB8": 8}


def grid(kind, n):
    """A line, square or cube of unit cells of a kind, wanted sizes smaller near the origin."""
    dim = {"SEG2": 1, "TRI3": 2, "QUA4": 2}.get(kind, 3)
    axes = np.meshgrid(*[np.arange(n + 1)] * dim, indexing="ij")
    nodes = NodeTable()
    points = np.zeros((axes[0].size, 3))
    for k, axis in enumerate(axes):
        points[:, k] = axis.ravel()
    nodes.add(points)
    number = np.arange(len(points)).reshape(axes[0].shape)

    def at(*shift):
        return number[tuple(slice(s, n + s) for s in shift)].ravel()

    def column(*shifts):
        return np.stack([at(*s) for s in shifts], axis=1)

    if dim == 1:
        table = column((0,), (1,))
    elif dim == 2:
        quad = [(0, 0), (1, 0), (1, 1), (0, 1)]
        rows = [[0, 1, 2, 3]] if kind == "QUA4" else [[0, 1, 2], [0, 2, 3]]
        table = np.concatenate([column(*[quad[i] for i in r]) for r in rows])
    else:
        cube = [(*s, z) for z in (0, 1) for s in [(0, 0), (1, 0), (1, 1), (0, 1)]]
        rows = {
            "CUB8": [range(8)],
            "PRI6": [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]],
            "TET4": [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6],
                     [0, 5, 1, 6]],
        }[kind]  # fmt: skip
        table = np.concatenate([column(*[cube[i] for i in r]) for r in rows])
    return Mesh.of(nodes, kind, table)


@together("kind", CELLS)
def test_one_division_keeps_measure_and_sense(kind):
    points, whole = CELLS[kind]
    nodes = NodeTable()
    nodes.add(np.array(points, dtype=float))
    mesh = Mesh.of(nodes, kind, np.arange(len(points))[None])
    longest = 1.0 if kind in ("SEG2", "QUA4", "CUB8") else 2**0.5
    finer = divided_to_sizes(mesh, np.full(len(points), 0.7 * longest))
    assert finer.n_cells == GROWTH[kind]
    assert len(finer.node_ids) == len(nodes.coordinates)
    assert not any(is_tie(b.cell_type) for b in finer.blocks)
    assert total_measure(finer) == pytest.approx(whole, rel=1e-12)
    x = finer.blocks[0].coordinates
    if kind in ("TET4", "PRI6", "CUB8"):
        arms = {"TET4": (1, 2, 3), "PRI6": (1, 2, 3), "CUB8": (1, 3, 4)}[kind]
        volumes = np.linalg.det(x[:, arms] - x[:, :1])
        np.testing.assert_allclose(volumes, volumes[0], rtol=1e-12)
        assert volumes[0] > 0


@together("kind", CELLS)
def test_hanging_nodes_lie_in_the_middle_and_sizes_are_reached(kind):
    mesh = grid(kind, 3)
    whole = total_measure(mesh)
    at = mesh.nodes.coordinates[mesh.node_ids]
    finer, ties = parted(divided_to_sizes(mesh, 0.1 + 0.5 * np.linalg.norm(at, axis=1)))
    assert total_measure(finer) == pytest.approx(whole, rel=1e-12)
    assert (len(ties) > 0) == (kind != "SEG2")
    hanging = []
    for block in ties:
        x = block.coordinates
        np.testing.assert_allclose(x[:, 0], x[:, 1:].mean(axis=1), atol=1e-14)
        hanging.append(block.connectivity[:, 0])
    every = np.concatenate(hanging) if hanging else np.empty(0, int)
    assert len(np.unique(every)) == len(every)
    assert np.isin(every, finer.node_ids).all()
    edges = np.diff(finer.blocks[0].coordinates[:, [0, 1]], axis=1)
    assert np.linalg.norm(edges, axis=2).min() < 0.3


@together("kind", ["TRI3", "QUA4", "TET4", "PRI6", "CUB8"])
def test_neighbours_differ_by_one_division_and_no_tear_is_left_untied(kind):
    """A node on an edge or face of a cell, and no corner of it, is tied to that very side."""
    mesh = grid(kind, 2)
    cell = mesh.blocks[0].connectivity[-1]  # divided twice, no other wants it
    sizes = np.where(np.isin(mesh.node_ids, cell), 0.45, 9.0)
    finer, ties = parted(divided_to_sizes(mesh, sizes))
    assert len({b.cell_type for b in ties}) == (1 if kind in ("TRI3", "QUA4", "TET4") else 2)
    tied = {int(r[0]) for b in ties for r in b.connectivity}
    x, ids = finer.nodes.coordinates, finer.node_ids
    cells, local = finer.blocks[0].connectivity, [side for _, side in CELL_TYPES[kind].faces]
    for side in local if len(local[0]) > 2 else [CELL_TYPES[kind].corners]:
        first, second, last = x[cells[:, side]][:, [0, 1, -1]].transpose(1, 0, 2)
        way, far = np.stack([second - first, last - first], axis=2), x[ids] - first[:, None]
        share = np.einsum("cij,cnj->cni", np.linalg.pinv(way), far)
        on = np.linalg.norm(np.einsum("cji,cni->cnj", way, share) - far, axis=2) < 1e-9
        on &= (share > -1e-9).all(axis=2) & (share < 1 + 1e-9).all(axis=2)
        on &= (share.sum(axis=2) < 1 + 1e-9) | (len(side) == 4)
        extra = on & ~(ids == cells[:, :, None]).any(axis=1)
        assert set(ids[extra.any(axis=0)].tolist()) <= tied
        np.testing.assert_allclose(2 * share[on], np.round(2 * share[on]), atol=1e-9)


def test_sides_of_volumes_are_divided_with_them():
    mesh = grid("CUB8", 2)
    skin = Mesh.of(mesh.nodes, "QUA4", mesh.blocks[0].connectivity[:, [0, 1, 5, 4]][:1])
    both = Mesh(mesh.nodes, (*mesh.blocks, *skin.blocks))
    at = mesh.nodes.coordinates[both.node_ids]
    sizes = np.where(at[:, 1] == 0.0, 1.2, 0.3)  # the volumes want it, the side does not
    finer, _ = parted(divided_to_sizes(both, sizes))
    faces = next(b for b in finer.blocks if b.cell_type == "QUA4")
    assert len(faces) == 4
    corners = np.isin(faces.connectivity, finer.blocks[0].connectivity)
    assert corners.all()


@together(
    "kind, sizes, said",
    [("QUA4", 0.0, "positive"), ("QUA4", 1e-5, "cells are needed"), ("QUA8", 1.0, "not divided")],
)
def test_what_cannot_be_divided_is_refused(kind, sizes, said):
    if kind == "QUA8":
        nodes = NodeTable()
        nodes.add(np.random.default_rng(0).random((8, 3)))
        mesh = Mesh.of(nodes, "QUA8", np.arange(8)[None])
    else:
        mesh = grid(kind, 2)
    with pytest.raises(MeshError, match=said):
        divided_to_sizes(mesh, np.full(len(mesh.node_ids), sizes))


PATCH = {
    "QUA4": ("OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = (DROI 4 (0. 0.) (4. 0.)) TRAN 4 (0. 4.) ;"
             " C = CONT T0 ; ", "UX UY"),
    "TRI3": ("OPTI DIME 2 ELEM TRI3 MODE PLAN DEFO ; S = (DROI 4 (0. 0.) (4. 0.)) TRAN 4 (0. 4.) ;"
             " C = CONT T0 ; ", "UX UY"),
    "CUB8": ("OPTI DIME 3 ELEM CUB8 ; S = ((DROI 2 (0. 0. 0.) (2. 0. 0.)) TRAN 2 (0. 2. 0.))"
             " VOLU 2 'TRAN' (0. 0. 2.) ; C = ENVE T0 ; ", "UX UY UZ"),
}  # fmt: skip


@together("kind", PATCH)
def test_linear_displacements_pass_through_hanging_nodes(kind, tmp_path):
    """A linear field on the boundary is found inside: the ties are those of the patch test."""
    text, names = PATCH[kind]
    make, rest = text.split(" C = ")
    field = " ET ".join(
        f"(NOMC '{u}' ({a} * (COOR 1 C) + ({b} * (COOR 2 C))))"
        for u, (a, b) in zip(names.split(), [(0.1, 0.3), (0.2, -0.4), (0.5, 0.1)], strict=False)
    )
    deck = f"""{make} X = COOR 1 S ; Y = COOR 2 S ;
T = RAFF S (0.2 + (0.4 * ((X * X + (Y * Y)) ** 0.5))) ; H = T ELEM 'SURE' ; T0 = DIFF T H ;
C = {rest} U0 = {field} ;
MO = MODE T 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 10. 'NU' 0.3 ;
B = BLOQ 'DEPL' C ; R = RELA MO ;
U = RESO ((RIGI MO MA) ET B ET R) (DEPI B U0) ;
E = EPSI MO U ; MESS 'STRAIN ' (MAXI E 'AVEC' (MOTS 'EPXX')) ' ' (MINI E 'AVEC' (MOTS 'EPXX')) ;
MESS 'OTHER ' (MAXI E 'AVEC' (MOTS 'EPYY')) ' ' (MINI E 'AVEC' (MOTS 'EPYY')) ;
MESS 'TIES ' (NBEL H) ;
"""
    result = ran(deck, tmp_path)
    lines = {line.split()[0]: line.split()[1:] for line in result.output.split("\n") if line}
    np.testing.assert_allclose([float(v) for v in lines["STRAIN"]], 0.1, rtol=1e-5)
    np.testing.assert_allclose([float(v) for v in lines["OTHER"]], -0.4, rtol=1e-5)
    assert int(lines["TIES"][0]) > 5
