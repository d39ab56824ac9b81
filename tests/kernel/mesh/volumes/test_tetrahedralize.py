"""Closed surfaces filled with tetrahedra: volume, conformity, errors."""

import numpy as np
import pytest
from references.straight_line import straight_line
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import contour, envelope
from ssilang.kernel.mesh.changes.split import split_quadrangles
from ssilang.kernel.mesh.combine import cell_keys, union
from ssilang.kernel.mesh.generators.sweep import sweep_line, sweep_surface, translation
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import signed_volumes
from ssilang.kernel.mesh.queries.measure import total_measure
from ssilang.kernel.mesh.volumes.tetrahedralize import _inner_points, _lattice, lift_faces
from ssilang.kernel.mesh.volumes.volume import fill_volume


def box_skin(cuts: tuple[int, int, int]) -> Mesh:
    """Skin of QUA4 of a box of sides 1, 2 and 1.5."""
    nodes = NodeTable()
    ids = nodes.add(np.array([[0.0, 0, 0], [1.0, 0, 0]]))
    line = straight_line(nodes, int(ids[0]), int(ids[1]), cuts[0])
    y, z = np.array([0.0, 2.0, 0.0]), np.array([0.0, 0.0, 1.5])
    floor = sweep_line(line, translation(y), subdivide(2.0, count=cuts[1]), "QUA4")
    return envelope(sweep_surface(floor, translation(z), subdivide(1.5, count=cuts[2])))


@together("cuts", [(1, 1, 1), (3, 4, 5), (6, 6, 2), (8, 8, 8)])
def test_tetrahedra_fill_a_box_and_keep_its_triangles(cuts: tuple[int, int, int]) -> None:
    skin = split_quadrangles(box_skin(cuts))
    volume = fill_volume(skin)
    assert total_measure(volume) == pytest.approx(3.0, rel=1e-12)
    # a cell without volume would have a vanishing part of the cube of its size
    assert signed_volumes(volume.single_block()).min() > 1e-5 * 3.0 / volume.n_cells
    found = envelope(volume).single_block()
    assert sorted(cell_keys(found).tolist()) == sorted(cell_keys(skin.single_block()).tolist())


def sheared_skin(cuts: tuple[int, int, int]) -> Mesh:
    """Triangles of the box, each layer pushed away: most of the box round it is outside."""
    skin = box_skin(cuts)
    xyz = skin.nodes.coordinates
    xyz[:, 0] += 0.7 * xyz[:, 2]
    xyz[:, 1] += 0.4 * xyz[:, 2]
    return split_quadrangles(skin)


def test_long_triangles_on_a_sheared_box_are_kept() -> None:
    skin = sheared_skin((5, 3, 2))
    volume = fill_volume(skin)
    assert total_measure(volume) == pytest.approx(3.0, rel=1e-12)
    found = envelope(volume).single_block()
    assert sorted(cell_keys(found).tolist()) == sorted(cell_keys(skin.single_block()).tolist())


def test_points_are_added_inside_alone() -> None:
    skin = sheared_skin((5, 10, 8))
    used, triangles = np.unique(skin.single_block().connectivity, return_inverse=True)
    added = _inner_points(skin.nodes.coordinates[used], triangles.reshape(-1, 3))
    back = added - np.outer(added[:, 2], [0.7, 0.4, 0.0])
    assert len(added) > 50
    assert ((back > 0.0) & (back < [1.0, 2.0, 1.5])).all()


def test_weights_grow_with_the_square_of_the_size() -> None:
    block, found = sheared_skin((5, 3, 2)).single_block(), []
    used, triangles = np.unique(block.connectivity, return_inverse=True)
    for size in (0.4, 0.02):  # of a box of one
        points = size * block.nodes.coordinates[used]
        lifted = lift_faces(points, triangles.reshape(-1, 3), np.full(len(block), 1.5))
        found.append(np.concatenate([lifted.weights / size**2, lifted.radii / size]))
    assert np.ptp(found[0]) > 1.0
    np.testing.assert_allclose(*found, atol=1e-3)


def test_points_added_beside_small_triangles_keep_their_distance() -> None:
    skin = split_quadrangles(box_skin((4, 8, 6)))
    block = split_quadrangles(box_skin((4, 4, 4))).single_block()
    hole = block.coordinates.reshape(-1, 3) * 0.3 + [0.35, 0.7, 0.5]  # its sides are 0.075 at least
    points = np.vstack([skin.single_block().coordinates.reshape(-1, 3), hole])
    used, triangles = np.unique(points.round(9), axis=0, return_inverse=True)
    added = _inner_points(used, triangles.reshape(-1, 3))
    apart = np.linalg.norm(added[:, None] - added, axis=-1)[np.triu_indices(len(added), 1)]
    assert apart.min() > 0.75 * 0.075


def test_quadrangles_carry_pyramids() -> None:
    skin = box_skin((3, 4, 5))
    volume = fill_volume(skin)
    kinds = {b.cell_type: len(b) for b in volume.blocks}
    assert kinds["PYR5"] == skin.n_cells
    assert total_measure(volume) == pytest.approx(3.0, rel=1e-12)
    assert {b.cell_type for b in envelope(volume).blocks} == {"QUA4"}
    assert envelope(volume).n_cells == skin.n_cells


def test_a_cavity_stays_empty() -> None:
    skin = split_quadrangles(box_skin((6, 12, 9)))
    hole = split_quadrangles(box_skin((2, 2, 2)))
    hole.nodes.coordinates[:] = hole.nodes.coordinates * 0.4 + [0.3, 0.6, 0.4]
    moved = skin.nodes.add(hole.nodes.coordinates)
    inner = Mesh.of(skin.nodes, "TRI3", moved[hole.single_block().connectivity])
    volume = fill_volume(union(skin, inner))
    assert total_measure(volume) == pytest.approx(3.0 * (1 - 0.4**3), rel=1e-12)


def test_an_open_surface_is_refused() -> None:
    skin = split_quadrangles(box_skin((2, 2, 2)))
    block = skin.single_block()
    with pytest.raises(MeshError, match="not closed: 3 sides"):
        fill_volume(Mesh.of(skin.nodes, "TRI3", block.connectivity[1:]))


def test_lines_are_refused() -> None:
    skin = box_skin((2, 2, 2))
    block = skin.single_block()
    some = Mesh.of(skin.nodes, "QUA4", block.connectivity[:1])
    with pytest.raises(MeshError, match="SEG2"):
        fill_volume(contour(some))


def test_a_lattice_stands_in_the_middle_of_its_box_and_is_not_too_fine():
    low, high = np.array([-1.0, 2.0, 0.3]), np.array([1.3, 2.9, 4.0])
    points = _lattice(low, high, 0.4)
    corners = points[: len(points) // 2]
    near = 2 * 0.03 * 0.4  # each point is moved by so little at most, on either side
    np.testing.assert_allclose(corners.min(axis=0) - low, high - corners.max(axis=0), atol=near)
    assert len(corners) == 6 * 3 * 10  # 2.3, 0.9, 3.7 by 0.4
    np.testing.assert_allclose(points[len(corners) :], corners + 0.2, atol=near)
    with refusal(MeshError, "kernel.mesh.surface-asks-more-ten"):
        _lattice(low, high, 0.01)
