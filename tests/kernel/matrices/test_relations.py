"""Relations: the motions that they leave free, against geometry."""

from dataclasses import replace

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices import imposed
from ssilang.kernel.matrices import relations as make
from ssilang.kernel.matrices import tied_relations as tied
from ssilang.kernel.matrices.assembly import (
    assemble,
    constraint_matrix,
    is_symmetric,
    numbering_of,
)
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.statics.linear_motion import rigid_motions

PLANE, SPACE = make.translations(Mode.PLANE_STRAIN), make.translations(Mode.THREE_DIMENSIONAL)


def cloud(n, dim, seed=0):
    table = NodeTable()
    points = np.random.default_rng(seed).uniform(-1.0, 1.0, (n, dim))
    return table, table.add(points)


def rows_of(*parts):
    matrix = Matrix(parts[0].table, (), parts)
    return constraint_matrix(matrix), numbering_of(matrix)


def free_space(C):
    _, s, v = np.linalg.svd(C.toarray())
    return v[int(np.sum(s > 1e-10)) :]


def test_a_weighted_sum_over_respective_nodes_repeats_a_single_node():
    table, ids = cloud(5, 2)
    terms = [make.Term(2.5, "UX", ids[:2]), make.Term(-1.0, "UY", ids[2:4])]
    rows, numbering = rows_of(make.relation_rows(table, [*terms, make.Term(3.0, "UX", ids[4:])], 1))
    C = rows.C.toarray()
    assert list(rows.sense) == [1, 1]
    for i in range(2):
        assert C[i, numbering.index_of(ids[i], "UX")] == 2.5
        assert C[i, numbering.index_of(ids[2 + i], "UY")] == -1.0
        assert C[i, numbering.index_of(ids[4], "UX")] == 3.0
    with pytest.raises(MeshError, match="2 and 3 nodes"):
        make.relation_rows(table, [make.Term(1.0, "UX", ids[:2]), make.Term(1.0, "UX", ids[:3])])
    with refusal(FieldError, "kernel.matrices.relation-node-no-coefficient"):
        make.relation_rows(table, [make.Term(0.0, "UX", ids[:2])])


def test_rows_that_push_by_others_stand_among_those_that_push_by_their_own():
    """Rows that stand twice, in relations of their own, count once."""
    table, ids = cloud(3, 2)
    plain = make.relation_rows(table, [make.Term(2.0, "UX", ids[:2])], 0)
    terms = [make.Term(1.0, "UY", ids[1:2]), make.Term(-3.0, "UX", ids[2:])]
    gap, pull = (make.relation_rows(table, some, 1) for some in (terms, terms[::-1][:1]))
    apart = replace(gap, dual=replace(pull, raw_multipliers=gap.raw_multipliers))
    for parts in ((plain, apart), (apart, plain), (plain, apart, replace(plain), replace(apart))):
        rows, numbering = rows_of(*parts)
        assert not rows.associated
        at = [
            numbering.index_of(ids[k], u) for k, u in ((0, "UX"), (1, "UX"), (1, "UY"), (2, "UX"))
        ]
        order = np.argsort(rows.multipliers)
        C, D = (m.toarray()[order][:, at] for m in (rows.C, rows.D))
        assert C.tolist() == [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, -3]]
        assert D.tolist() == [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 0, -3]]
        assert rows.sense[order].tolist() == [0, 0, 1]
    assert rows_of(plain, replace(plain))[0].associated
    assert is_symmetric(Matrix(table, (), (plain, gap)))
    assert not is_symmetric(Matrix(table, (), (plain, apart)))


def test_multipliers_are_new_nodes_of_their_own():
    table, ids = cloud(3, 2)
    held = make.blocked(table, ids, PLANE)
    assert len(np.unique(held.multipliers)) == 6
    assert held.multipliers.min() > ids.max()
    np.testing.assert_allclose(table.coordinates[held.multipliers[:3]], table.coordinates[ids])


@together("dim, names", [(2, PLANE), (3, SPACE)])
@together("n", [4, 9])
def test_constant_distances_leave_exactly_the_rigid_motions(dim, names, n):
    table, ids = cloud(n, dim)
    rows, numbering = rows_of(tied.rigid_by_distances(table, ids, names))
    free = free_space(rows.C)
    assert len(free) == dim * (dim + 1) // 2
    rigid = rigid_motions(numbering)
    kept = rigid[:, [0, 1, 5]] if dim == 2 else rigid
    np.testing.assert_allclose(rows.C @ kept, 0.0, atol=1e-12)


def test_distances_need_points_that_span_the_space():
    table = NodeTable()
    ids = table.add(np.array([[0.0, 0], [1, 0], [3, 0]]))
    with pytest.raises(MeshError, match="three nodes"):
        tied.rigid_by_distances(table, ids, PLANE)
    assert len(tied.rigid_by_distances(table, ids, PLANE, check=False)) == 3


@together("dim, mode", [(2, Mode.PLANE_STRAIN), (3, Mode.THREE_DIMENSIONAL)])
def test_a_rigid_body_with_rotations_follows_its_master(dim, mode):
    table, ids = cloud(6, dim)
    names, turns = make.translations(mode), make.rotations(mode)
    rows, numbering = rows_of(tied.rigid_with_rotations(table, ids[:3], ids[3:], names, turns))
    assert numbering.size == 6 * len(names) + 3 * len(turns)
    motions = rigid_motions(numbering)[:, [0, 1, 5] if dim == 2 else slice(None)]
    np.testing.assert_allclose(rows.C @ motions, 0.0, atol=1e-12)
    assert len(free_space(rows.C)) == motions.shape[1]


def test_direction_is_made_of_length_one_and_radial_is_the_radius():
    table = NodeTable()
    ids = table.add(np.array([[3.0, 4.0], [0.0, 2.0]]))
    rows, numbering = rows_of(make.blocked_along(table, ids, PLANE, np.array([3.0, 4.0])))
    np.testing.assert_allclose(rows.C.toarray()[0, :2], [0.6, 0.8])
    radial = make.radial_directions(table, ids, np.zeros(3), None)
    np.testing.assert_allclose(radial[:, :2], [[3, 4], [0, 2]])
    turned = make.orthoradial_directions(radial, None)
    np.testing.assert_allclose((radial * turned).sum(axis=1), 0.0)
    with refusal(MeshError, "kernel.matrices.node-lies-axis-no"):
        make.radial_directions(table, ids, np.array([3.0, 4.0, 0.0]), None)
    with refusal(FieldError, "kernel.matrices.direction-node-no-length"):
        make.blocked_along(table, ids, PLANE, np.zeros(2))
    assert numbering.size == 4


@together("mirrored", [True, False])
def test_symmetry_and_antisymmetry_share_out_the_six_motions(mirrored):
    table, ids = cloud(1, 3)
    normal = np.array([1.0, 2.0, 2.0]) / 3.0
    turns = make.rotations(Mode.THREE_DIMENSIONAL)
    rows, numbering = rows_of(make.mirror_rows(table, ids, normal, SPACE, turns, mirrored))
    order = [numbering.index_of(0, name) for name in (*SPACE, *turns)]
    free = free_space(rows.C)[:, order]
    assert len(free) == 3
    # a mirror keeps displacements in the plane and rotations about its normal
    across, turning = free[:, :3] @ normal, free[:, 3:]
    in_plane = turning - np.outer(turning @ normal, normal)
    if mirrored:
        np.testing.assert_allclose(across, 0.0, atol=1e-12)
        np.testing.assert_allclose(in_plane, 0.0, atol=1e-12)
    else:
        moved = free[:, :3] - np.outer(across, normal)
        np.testing.assert_allclose(moved, 0.0, atol=1e-12)
        np.testing.assert_allclose(turning @ normal, 0.0, atol=1e-12)


def test_nodes_on_the_plane_are_found_within_the_tolerance():
    table = NodeTable()
    ids = table.add(np.array([[1.0, 2], [2, 2.99], [1, 3.5]]))  # along y = x + 1
    points = np.array([[3.0, 4, 0], [5, 6, 0], [3, 4, 7]])
    for given in (points[:2], points):
        near, normal = make.on_plane(table, ids, given, 0.05)
        assert list(near) == [0, 1]
        np.testing.assert_allclose(np.abs(normal), [0.5**0.5, 0.5**0.5, 0], atol=1e-15)
    with pytest.raises(MeshError, match=r"nearest is at 1\.06"):
        make.on_plane(table, ids[2:], points, 0.05)
    for along in (points[0], points[1]):
        with pytest.raises(MeshError, match="points"):
            make.on_plane(table, ids, np.array([points[0], points[1], along]), 0.05)


def test_middle_nodes_follow_their_corners():
    table = NodeTable()
    ids = table.add(np.array([[0.0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]]))
    rows, _ = rows_of(tied.middle_nodes(Mesh.of(table, "QUA8", ids[None]), ["UX"]))
    assert rows.C.shape == (4, 8)
    linear = table.coordinates[ids] @ np.array([2.0, -1.0, 0.0]) + 3.0
    np.testing.assert_allclose(rows.C @ linear, 0.0, atol=1e-14)


def unit_cube(table, cell_type):
    if cell_type == "QUA4":
        corners = np.array([[0.0, 0], [1, 0], [1.2, 1.1], [0, 1]])
    elif cell_type == "TRI3":
        corners = np.array([[0.0, 0], [2, 0], [0, 2]])
    else:
        corners = np.array(
            [[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1.3, 1],
             [0, 1, 1]]
        )  # fmt: skip
    return Mesh.of(table, cell_type, table.add(corners)[None])


@together("cell_type", ["QUA4", "TRI3", "CUB8"])
def test_hooked_nodes_take_linear_fields_exactly_and_outsiders_stay_free(cell_type):
    table = NodeTable()
    mesh = unit_cube(table, cell_type)
    dim = mesh.dimension
    inside = table.add(np.random.default_rng(1).uniform(0.05, 0.9, (20, dim)))
    far = table.add(np.full((1, dim), 7.0))
    rows, numbering = rows_of(tied.hooked(np.concatenate([inside, far]), mesh, ["UX"]))
    assert rows.C.shape[0] == 20
    assert numbering.index_of(int(far[0]), "UX") == -1
    linear = table.coordinates[numbering.nodes] @ np.array([1.0, -2.0, 0.5])
    np.testing.assert_allclose(rows.C @ linear, 0.0, atol=1e-10)


def test_springs_along_a_direction_push_only_that_way():
    table, ids = cloud(2, 2)
    K = assemble(make.springs(table, ids, PLANE, 5.0, np.array([3.0, 4.0]))).toarray()
    np.testing.assert_allclose(K[:2, :2] @ [0.6, 0.8], [3.0, 4.0])
    np.testing.assert_allclose(K[:2, :2] @ [-0.8, 0.6], 0.0, atol=1e-14)


@together("mirrored", [True, False])
def test_a_line_of_symmetry_in_the_plane_may_slope(mirrored):
    """Symmetry leaves motions along the line, antisymmetry those along its normal."""
    table, ids = cloud(1, 2)
    normal = np.array([0.6, 0.8, 0.0])
    rows, numbering = rows_of(make.mirror_rows(table, ids, normal, PLANE, ("RZ",), mirrored))
    free = free_space(rows.C)
    order = [numbering.index_of(0, name) for name in PLANE]
    along = np.array([-0.8, 0.6]) if mirrored else normal[:2]
    moved = free[:, order]
    np.testing.assert_allclose(moved, np.outer(moved @ along, along), atol=1e-12)
    assert np.abs(moved).max() > 0.1
    turn = numbering.index_of(0, "RZ")
    assert (turn >= 0) == mirrored  # symmetry holds the rotation, antisymmetry says nothing of it
    if mirrored:
        np.testing.assert_allclose(free[:, turn], 0.0, atol=1e-12)


def test_positions_count_along_their_own_axis_and_rotations_nowhere():
    table = NodeTable()
    ids = table.add(np.array([[3.0, 5.0], [7.0, 11.0]]))
    nodes = ids[:1]
    for names, gap in (
        (("UX",), -3.0), (("UY",), -5.0), (("RZ",), 0.0), (("UX", "RZ"), -3.0),
        (("UR",), -3.0), (("UR", "UZ"), -3.0 - 2.0 * 5.0), (("UX", "UY", "RZ"), -3.0 - 2.0 * 5.0),
    ):  # fmt: skip
        terms = [make.Term(1.0 + k, name, nodes) for k, name in enumerate(names)]
        rows = make.relation_rows(table, terms)
        found = imposed.geometric_gaps(Matrix(table, (), (rows,)))
        assert found.values_at("FLX", rows.multipliers).tolist() == [gap], names
