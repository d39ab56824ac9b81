"""Merging, degenerate cells, opened surfaces, joint cells."""

import numpy as np
import pytest
from references.straight_line import line_between, straight_line
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.changes import merge
from ssilang.kernel.mesh.changes.merge import merge_between, merge_close, regenerate, repeated_nodes
from ssilang.kernel.mesh.combine import poi1, union
from ssilang.kernel.mesh.generators.interfaces import joint_mesh
from ssilang.kernel.mesh.generators.sweep import rotation, sweep_line, sweep_surface, translation
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import reversed_line, signed_volumes
from ssilang.kernel.mesh.queries.measure import total_measure

UP, DOWN = np.array([0.0, 1, 0]), np.array([0.0, -1, 0])


def test_oldest_node_of_a_group_stays() -> None:
    nodes = NodeTable()
    ids = nodes.add(np.array([[0.0, 0], [1, 0], [1.001, 0], [0.999, 0]]))
    merge_close(nodes, ids[:1], 0.01)
    assert nodes.resolve(ids).tolist() == [0, 1, 2, 3]
    merge_close(nodes, ids, 0.01)
    assert nodes.resolve(ids).tolist() == [0, 1, 1, 1]


def test_merging_between_two_sets_leaves_each_as_it_is() -> None:
    nodes = NodeTable()
    first = nodes.add(np.array([[0.0, 0], [0.001, 0]]))
    second = nodes.add(np.array([[0.0, 0], [5.0, 0]]))
    for near in (first, first[:0]):
        merge_between(nodes, first, near, 0.01)
        assert nodes.resolve(first).tolist() == first.tolist()
    merge_between(nodes, first, second, 0.01)
    assert nodes.resolve(second).tolist() == [0, 3]
    assert len(np.unique(nodes.resolve(first))) == 2


def test_merging_a_hundred_thousand_nodes_finds_all_pairs() -> None:
    nodes = NodeTable()
    grid = np.stack(np.meshgrid(np.arange(250.0), np.arange(200.0)), axis=-1).reshape(-1, 2)
    ids = nodes.add(np.vstack([grid, grid + 1e-6]))
    merge_close(nodes, ids, 1e-3)
    assert nodes.resolve(ids).tolist() == 2 * ids[: len(grid)].tolist()


def test_merging_needs_a_distance() -> None:
    nodes = NodeTable()
    with pytest.raises(MeshError, match="positive"):
        merge_close(nodes, nodes.add(np.zeros((2, 2))), 0.0)


@together("quadratic, cell", [(False, "TRI3"), (True, "TRI6")])
def test_turned_line_that_touches_its_centre_becomes_triangles(quadratic: bool, cell: str) -> None:
    nodes = NodeTable()
    radius = line_between(nodes, [0, 0], [1, 0], 2, quadratic)
    path = rotation(radius, 90.0, np.zeros(3), np.array([0.0, 0, 1]))
    name = "QUA8" if quadratic else "QUA4"
    sector = sweep_line(radius, path, subdivide(path.length, count=4), name)
    area = total_measure(sector)
    before = sector.node_ids
    assert sector.node_ids is before  # ordered once, and anew after a merge
    merge_close(nodes, before, 1e-6)
    assert sector.node_ids.tolist() == list(dict.fromkeys(nodes.resolve(before).tolist()))
    assert repeated_nodes(sector) == 4
    made = regenerate(sector)
    assert {b.cell_type: len(b) for b in made.blocks} == {name: 4, cell: 4}
    assert repeated_nodes(made) == 0
    cells = np.random.default_rng(2).integers(0, 9, (40, 4))
    table = NodeTable()
    told = repeated_nodes(Mesh.of(table, "QUA4", table.add(np.eye(9)[:, :3])[cells]))
    assert told == sum(len(set(c)) < 4 for c in cells.tolist()) > 9
    assert total_measure(made) == pytest.approx(area)


@together("quadratic, brick, prism", [(False, "CUB8", "PRI6"), (True, "CU20", "PR15")])
@together("along", [0, 1])
def test_surface_turned_about_its_edge_gives_prisms(
    quadratic: bool, brick: str, prism: str, along: int
) -> None:
    nodes = NodeTable()
    a, b = ([0, 0, 0], [1, 0, 0]) if along == 0 else ([0, 0, 0], [0, 0, 2])
    way = np.array([0.0, 0, 2]) if along == 0 else np.array([1.0, 0, 0])
    base = line_between(nodes, a, b, 2, quadratic)
    name = "QUA8" if quadratic else "QUA4"
    plate = sweep_line(base, translation(way), subdivide(1.0, count=2), name)
    path = rotation(plate, 90.0 if along else -90.0, np.zeros(3), np.array([0.0, 0, 1]))
    wedge = sweep_surface(plate, path, subdivide(path.length, count=6))
    volume = total_measure(wedge)
    merge_close(nodes, wedge.node_ids, 1e-6)
    made = regenerate(wedge)
    assert {b.cell_type: len(b) for b in made.blocks} == {brick: 12, prism: 12}
    assert total_measure(made) == pytest.approx(volume, rel=1e-9)
    # cells keep the sense of the bricks from which they come
    senses = [np.sign(signed_volumes(b)) for b in made.blocks]
    assert len(set(np.concatenate(senses))) == 1


def plate_and_line(cuts: int) -> tuple[Mesh, Mesh, Mesh]:
    """Squares above the line y = 0 from x = 0 to 2, triangles below, and the line's two halves."""
    nodes = NodeTable()
    first = line_between(nodes, [0, 0], [1, 0], cuts)
    last = int(first.single_block().connectivity[-1, -1])
    end = int(nodes.add(np.array([[2.0, 0]]))[0])
    second = straight_line(nodes, last, end, cuts)
    both = union(first, second)
    cells = ((UP, "QUA4"), (DOWN, "TRI3"))
    rows = [sweep_line(both, translation(v), subdivide(1.0, count=2), name) for v, name in cells]
    return union(*rows), first, both


def test_crack_tip_stays_single_and_the_mouth_opens() -> None:
    plate, first, _ = plate_and_line(3)
    opened, lip = merge.cut_open(plate, first)
    assert len(opened.node_ids) == len(plate.node_ids) + 3
    assert lip.n_cells == 3
    tip = first.single_block().connectivity[-1, -1]
    assert lip.single_block().connectivity[-1, -1] == tip
    nodes = plate.nodes
    nodes.coordinates[np.setdiff1d(lip.node_ids, [tip]), 1] -= 0.1
    assert total_measure(opened) == pytest.approx(4.0 - 0.1 * (2 / 3 + 1 / 6))


def test_line_across_the_whole_surface_cuts_it_in_two() -> None:
    plate, _, both = plate_and_line(2)
    opened, lip = merge.cut_open(plate, both)
    assert len(opened.node_ids) == len(plate.node_ids) + len(both.node_ids)
    assert not set(lip.node_ids.tolist()) & set(both.node_ids.tolist())


@together("quadratic, name", [(False, "RAC2"), (True, "RAC3")])
def test_joint_pairs_nodes_whatever_the_sense_of_the_second_line(
    quadratic: bool, name: str
) -> None:
    nodes = NodeTable()
    upper = line_between(nodes, [0, 0], [1, 0], 3, quadratic)
    lower = reversed_line(line_between(nodes, [0, 0], [1, 0], 3, quadratic))
    block = joint_mesh(upper, lower, 1e-3).single_block()
    assert (block.cell_type, len(block)) == (name, 3)
    x = block.coordinates
    half = x.shape[1] // 2
    assert x[:, :half] == pytest.approx(x[:, half:])
    assert set(block.connectivity[:, :half].ravel()) == set(upper.node_ids)


def test_gap_turns_the_first_half_so_that_the_normal_opens_the_joint() -> None:
    nodes = NodeTable()
    lower = line_between(nodes, [0, 0], [1, 0], 2)
    upper = reversed_line(line_between(nodes, [0, 0.01], [1, 0.01], 2))
    x = joint_mesh(upper, lower, 0.1).single_block().coordinates
    way = x[:, 1] - x[:, 0]
    normal = np.column_stack([-way[:, 1], way[:, 0]])
    assert ((x[:, 0] - x[:, 2])[:, :2] * normal).sum(axis=1) == pytest.approx(0.005)


def test_facets_are_paired_in_space() -> None:
    nodes = NodeTable()
    first = line_between(nodes, [0, 0, 0], [1, 0, 0], 2)
    other = line_between(nodes, [0, 0, 0], [1, 0, 0], 2)
    sheets = [
        sweep_line(m, translation(UP), subdivide(1.0, count=3), "QUA4") for m in (first, other)
    ]
    block = joint_mesh(*sheets, 1e-6).single_block()
    assert (block.cell_type, len(block)) == ("LIA4", 6)
    assert block.coordinates[:, :4] == pytest.approx(block.coordinates[:, 4:])


def test_far_meshes_do_not_join() -> None:
    nodes = NodeTable()
    first, second = line_between(nodes, [0, 0], [1, 0], 2), line_between(nodes, [0, 1], [1, 1], 2)
    with pytest.raises(MeshError, match="faces"):
        joint_mesh(first, second, 0.1)
    with pytest.raises(MeshError, match="POI1"):
        joint_mesh(poi1(nodes, first.node_ids), second, 0.1)


@together(
    "cells, apart, counts",
    [
        ((2, 3), 0.5, (2, 3)),  # 4 cells against 2 on one half, 3 on the other
        ((3, 3), 1.0, (4, 6)),  # nothing fits
    ],
)
@together("height, measure", [(1.0, "a length"), (0.3, "an area")])
def test_the_length_or_area_that_is_not_joined_is_told(cells, apart, counts, height, measure):
    nodes = NodeTable()
    first = line_between(nodes, [0, 0], [1, 0], 4)
    halves = [line_between(nodes, [0.5 * i, 0], [0.5 + 0.5 * i, 0], n) for i, n in enumerate(cells)]
    sides = [first, union(*halves)]
    if measure == "an area":
        path = translation(height * UP)
        sides = [sweep_line(m, path, subdivide(height, count=1), "QUA4") for m in sides]
    with pytest.raises(MeshError, match=f"the two sides are joined over {measure} of") as told:
        joint_mesh(*sides, 1e-3)
    data = told.value.data
    assert data["apart"] == pytest.approx(apart * height)
    assert data["joined"] == pytest.approx((1.0 - apart) * height)
    assert (data["n_first"], data["n_second"]) == counts


def test_nodes_that_are_merged_with_merged_ones_are_one():
    nodes = NodeTable()
    nodes.add(np.zeros((6, 2)))
    nodes.merge(np.array([5]), np.array([2]))
    nodes.merge(np.array([1, 2, 4]), np.array([0, 1, 3]))  # a chain at once, on to an alias
    assert nodes.resolve(np.arange(6)).tolist() == [5, 5, 5, 4, 4, 5]
