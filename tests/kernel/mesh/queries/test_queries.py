"""What is asked of meshes, against sets and loops, on a slanted grid of cells of every kind."""

import itertools

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.mesh import boundary, combine, orientation
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.changes import transform
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.queries import measure, partition, quality, select
from ssilang.kernel.mesh.queries.signed_distance import beyond_front, beyond_tip, signed_distance

A = np.array([[1.3, 0.4, -0.2], [0.1, 0.8, 0.3], [-0.3, 0.2, 1.1]])
VOLUMES = {"tetrahedron": 1 / 6, "pyramid": 4 / 3, "prism": 1.0}
WHOLE = {name: kind for name, kind in REFERENCE_CELLS.items() if name in measure._POINTS}


def cell(name, x):
    table = NodeTable()
    table.add(np.column_stack([x, np.zeros((len(x), 3 - x.shape[1]))]))
    return CellBlock.make(table, name, np.arange(len(x))[None])


@together("name", [n for n, k in WHOLE.items() if k.nodes.shape[1] == 3])
def test_volumes_follow_the_determinant_of_a_map(name):
    kind = WHOLE[name]
    exact = VOLUMES.get(kind.shape, 8.0) * np.linalg.det(A)
    block = cell(name, kind.nodes @ A.T + 5.0)
    found = measure.cell_measures(block)
    assert found == pytest.approx([exact])
    assert orientation.signed_volumes(block) == pytest.approx([exact])
    assert orientation.signed_volumes(orientation.flip(block)) == pytest.approx([-exact])
    mesh = Mesh(block.nodes, (block,))
    assert measure.enclosed_volume(boundary.envelope(mesh)) == pytest.approx(exact)


def grid():
    """Two slanted layers of squares 3 x 2, some cut in triangles, with colours, and a line."""
    table, at = NodeTable(), {}
    table.add(np.full((90, 3), -9.0))  # the cells' nodes are not the first ones
    for j, i in itertools.product(range(3), range(4)):
        at[i, j] = int(table.add(np.array([[i + 0.2 * j, 0.9 * j, 0.05 * i]]))[0])
    squares, triangles = [], []
    for i, j in itertools.product(range(3), range(2)):
        ring = [at[i, j], at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]]
        if (i + j) % 2:
            triangles += [[ring[0], ring[1], ring[2]], [ring[2], ring[3], ring[0]]]
        else:
            squares.append(ring)
    blocks = (
        CellBlock.make(table, "TRI3", triangles, np.arange(1, 7)),
        CellBlock.make(table, "QUA4", squares, np.array([7, 5, 3])),
    )
    return Mesh(table, blocks), at


def cells_of(mesh):
    """(type, sorted nodes, colour) of all cells."""
    return [
        (b.cell_type, tuple(sorted(row)), int(c))
        for b in mesh.blocks
        for row, c in zip(b.connectivity.tolist(), b.colours, strict=True)
    ]


def sides_of(mesh):
    """Cells by side."""
    found = {}
    rows = [r for b in mesh.blocks for r in b.connectivity.tolist()]
    for k, ring in enumerate(rows):
        for pair in zip(ring, ring[1:] + ring[:1], strict=True):
            found.setdefault(tuple(sorted(pair)), []).append(k)
    return rows, found


def joined(count, links):
    """Sets of cells that links join, by their first cell."""
    label = list(range(count))
    for _ in range(count):
        for a, b in links:
            label[a] = label[b] = min(label[a], label[b])
    return [[k for k in range(count) if label[k] == first] for first in dict.fromkeys(label)]


@pytest.mark.parametrize("seed", range(12))
def test_a_contour_is_walked_whatever_way_its_cells_run(seed):
    """Cells taken out and turned at random: loops that touch at a corner, cells of both senses."""
    mesh, _ = grid()
    rng = np.random.default_rng(seed)
    mesh = combine.take(mesh, lambda b: rng.permutation(len(b))[: max(1, len(b) - 2)])
    turned = [
        np.where(rng.random(len(b))[:, None] < 0.5, b.connectivity[:, ::-1], b.connectivity)
        for b in mesh.blocks
    ]
    pairs = zip(mesh.blocks, turned, strict=True)
    mesh = Mesh(mesh.nodes, tuple(CellBlock.make(b.nodes, b.cell_type, t) for b, t in pairs))
    rows, sides = sides_of(mesh)
    found = boundary.contour(mesh).single_block().connectivity.tolist()
    alone = {s for s, k in sides.items() if len(k) == 1}
    assert sorted(tuple(sorted(c)) for c in found) == sorted(alone)
    corners = [c for b in mesh.blocks for c in b.connectivity.T.ravel()]
    begun = []
    while found:  # walk by walk, each corner once
        left = {c for pair in found for c in pair}
        start = next(c for c in corners if c in left and c not in begun)
        begun.append(start)
        first = found[0]
        ring = rows[sides[tuple(sorted(first))][0]]
        assert start in first
        assert first in [[a, b] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)]
        length = 1
        while length < len(found) and found[length][0] == found[length - 1][1]:
            length += 1
        assert found[length - 1][1] == first[0]
        found = found[length:]


def test_boundaries_are_the_sides_of_one_cell():
    mesh, _ = grid()
    _, sides = sides_of(mesh)
    found = boundary.contour(mesh)
    assert {c[1] for c in cells_of(found)} == {s for s, k in sides.items() if len(k) == 1}
    colours = [c for _, _, c in cells_of(mesh)]
    for _, pair, colour in cells_of(found):
        assert colour == colours[sides[pair][0]]
    assert sorted(c[1] for c in cells_of(boundary.edges(mesh))) == sorted(sides)
    assert not boundary.inner_contour(mesh).blocks
    assert measure.signed_area(found) == pytest.approx(3 * 1.8)
    assert measure.signed_area(orientation.reversed_line(found)) == pytest.approx(-3 * 1.8)
    normal = np.array([-0.05 * 0.9, 0.05 * 0.2, 0.9])  # cross product of the grid's directions
    assert measure.enclosed_area(found) == pytest.approx(6 * np.linalg.norm(normal))
    assert measure.total_measure(mesh) == pytest.approx(6 * np.linalg.norm(normal))
    open_line = combine.take(found, lambda b: np.arange(len(b)) > 0)
    assert measure.signed_area(open_line) == pytest.approx(3 * 1.8)
    ids, sizes = measure.node_sizes(mesh)
    x = mesh.nodes.coordinates
    for node, size in zip(ids.tolist(), sizes, strict=True):
        lengths = [np.linalg.norm(x[a] - x[b]) for a, b in sides if node in (a, b)]
        assert size == pytest.approx(np.mean(lengths))


def test_meshes_as_sets_of_cells():
    mesh, _ = grid()
    part = combine.take(mesh, lambda b: np.arange(len(b)) % 2 == 0)
    turned = Mesh(mesh.nodes, tuple(orientation.flip(b) for b in part.blocks))
    rest = [c for c in cells_of(mesh) if c not in cells_of(part)]
    assert cells_of(combine.intersection(mesh, turned)) == cells_of(part)
    assert cells_of(combine.difference(mesh, turned)) == rest
    assert cells_of(combine.symmetric_difference(part, mesh)) == rest
    both = combine.union(mesh, turned, as_given=True)
    assert len(cells_of(both)) == len(cells_of(mesh)) + len(cells_of(part))
    assert cells_of(combine.without_duplicates(both)) == cells_of(mesh)
    again = quality.repeated_cells(both)
    assert sorted(cells_of(again)) == sorted(cells_of(part))
    assert not quality.repeated_cells(mesh).blocks
    assert cells_of(combine.of_type(mesh, "QUA4")) == [c for c in cells_of(mesh) if c[0] == "QUA4"]
    assert {c[2] for c in cells_of(combine.recolour(mesh, 9))} == {9}
    assert cells_of(combine.gathered([mesh, part])) == cells_of(both)


@together("angle", [None, 20.0, 80.0])
def test_parts_are_those_that_sides_join(angle):
    mesh, at = grid()
    x = mesh.nodes.coordinates
    x[[at[3, j] for j in range(3)], 2] += 1.3  # the last row stands up by about half a right angle
    rows, sides = sides_of(mesh)
    normals = [np.cross(x[r[1]] - x[r[0]], x[r[-1]] - x[r[0]]) for r in rows]
    normals = [n / np.linalg.norm(n) for n in normals]
    wall = Mesh.of(mesh.nodes, "SEG2", np.array([[at[1, 1], at[1, 0]], [at[2, 1], at[1, 1]]]))
    cut = {tuple(sorted(r)) for r in wall.blocks[0].connectivity.tolist()}
    for separator in (None, wall):
        links = [
            pair
            for side, cells in sides.items()
            for pair in itertools.combinations(cells, 2)
            if not (separator and side in cut)
            and (angle is None
                 or np.degrees(np.arccos(min(1.0, normals[pair[0]] @ normals[pair[1]]))) <= angle)
        ]  # fmt: skip
        wanted = [{tuple(sorted(rows[k])) for k in part} for part in joined(len(rows), links)]
        found = partition.separated(mesh, separator=separator, angle=angle)
        assert [{c[1] for c in cells_of(p)} for p in found] == wanted
    assert sorted(c for p in found for c in cells_of(p)) == sorted(cells_of(mesh))


def test_parts_dealt_out_and_halved():
    mesh, at = grid()
    every = cells_of(mesh)
    dealt = partition.scattered(mesh, 4)
    assert [sorted(cells_of(p)) for p in dealt] == [sorted(every[k::4]) for k in range(4)]
    halves = partition.balanced(mesh, 4)
    assert sorted(len(cells_of(p)) for p in halves) == [2, 2, 2, 3]
    assert sorted(c for p in halves for c in cells_of(p)) == sorted(every)
    x = mesh.nodes.coordinates
    middle = [np.mean([x[list(c[1]), 0].mean() for c in cells_of(p)]) for p in halves]
    assert max(middle[:2]) < min(middle[2:])
    for count in (0, 3):
        with pytest.raises(MeshError) as caught:
            partition.balanced(mesh, count)
        assert caught.value.data == {"count": count}
    kept = ((at[0, 0], at[0, 1]), (at[3, 0], at[3, 1]))
    ends = combine.take(mesh, lambda b: [bool(set(kept[0]) <= set(r) or set(kept[1]) <= set(r))
                                         for r in b.connectivity.tolist()])  # fmt: skip
    assert [len(cells_of(p)) for p in partition.connected(ends)] == [1, 1]
    assert len(partition.connected(mesh)) == 1
    three = Mesh.of(mesh.nodes, "SEG2", np.array([[4, 5], [5, 6], [5, 9], [9, 10]]))
    assert [len(cells_of(p)) for p in partition.separated(three)] == [4]
    branches = partition.separated(three, by_branching=True)
    assert [len(cells_of(p)) for p in branches] == [1, 1, 2]
    np.testing.assert_array_equal(select.junctions(three), [5])
    block = mesh.blocks[0]
    near = partition.by_neighbours(block)
    assert sorted(near.connectivity.tolist()) == sorted(block.connectivity.tolist())
    assert near.connectivity[0].tolist() == block.connectivity[0].tolist()
    shades = {
        tuple(r): int(c) for r, c in zip(block.connectivity.tolist(), block.colours, strict=True)
    }
    assert [shades[tuple(r)] for r in near.connectivity.tolist()] == near.colours.tolist()


def simplex(k):
    """A regular simplex of edge one in space."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0.5, np.sqrt(0.75), 0],
                        [0.5, np.sqrt(1 / 12), np.sqrt(2 / 3)]])  # fmt: skip
    return corners[: k + 1]


@together("k", [2, 3])
def test_quality_is_one_of_regular_simplices_alone_and_blind_to_turns(k):
    rng = np.random.default_rng(k)
    R = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    regular = (2.7 * simplex(k) @ R.T + [1.0, 2.0, 3.0])[None]
    assert quality.aspect_ratio(regular) == pytest.approx([1.0])
    assert quality.skewness(regular) == pytest.approx([0.0], abs=1e-12)
    assert quality.quality_in_metric(regular, None) == pytest.approx([1.0])
    M = np.broadcast_to(np.eye(3) / 2.7**2, (1, 3, 3))
    assert quality.quality_in_metric(regular, M) == pytest.approx([1.0])
    for factor in (0.5, 2.0):
        found = quality.quality_in_metric(factor * regular, M)
        assert found == pytest.approx([0.5])
    x = rng.standard_normal((20, k + 1, 3))
    turned = 3.0 * x[:, ::-1] @ R.T
    for of in (quality.aspect_ratio, quality.skewness,
               lambda c: quality.quality_in_metric(c, None)):  # fmt: skip
        np.testing.assert_allclose(of(turned), of(x), rtol=1e-9)
    edges = [np.linalg.norm(x[:, a] - x[:, b], axis=1)
             for a, b in itertools.combinations(range(k + 1), 2)]  # fmt: skip
    if k == 2:
        a, b, c = edges
        s = (a + b + c) / 2
        area = np.sqrt(s * (s - a) * (s - b) * (s - c))  # Heron
        longest = np.max(edges, axis=0)
        np.testing.assert_allclose(quality.aspect_ratio(x),
                                   np.sqrt(0.75) * longest**2 / (2 * area))  # fmt: skip
        best = 3 * np.sqrt(3) / 4 * (a * b * c / (4 * area)) ** 2
        np.testing.assert_allclose(quality.skewness(x), 1 - area / best)
        np.testing.assert_allclose(quality.quality_in_metric(x, None),
                                   4 * np.sqrt(3) * area / (a**2 + b**2 + c**2))  # fmt: skip
    flat = x.copy()
    flat[:, -1] = 0.3 * flat[:, 0] + 0.7 * flat[:, 1]
    assert (quality.skewness(flat) == 1.0).all()
    assert (quality.aspect_ratio(flat) > 1e6).all()


def test_flat_quadrangles_and_smallest_lengths():
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    assert quality.flatness(square[None]) == pytest.approx([100.0])
    assert quality.flatness(square[None, :, :2]) == pytest.approx([100.0])
    for bent in np.random.default_rng(4).standard_normal((9, 4, 3)) * 0.3 + square:
        sides = np.roll(bent, -1, axis=0) - bent  # normals at the first corner and the third
        one, two = (np.cross(sides[k], -sides[k - 1]) for k in (0, 2))
        turn = np.arccos(one @ two / np.linalg.norm(one) / np.linalg.norm(two))
        assert quality.flatness(bent[None]) == pytest.approx([100 * (1 - turn / np.pi)])
    long = cell("QUA4", np.array([[0.0, 0.0], [5.0, 0.0], [5.3, 0.4], [0.3, 0.4]]))
    assert quality.smallest_lengths(long) == pytest.approx([0.4])
    low = cell("TET4", np.array([[0.0, 0, 0], [4, 0, 0], [0, 3, 0], [1, 1, 0.2]]))
    assert quality.smallest_lengths(low) == pytest.approx([0.2])
    brick = cell("CUB8", REFERENCE_CELLS["CUB8"].nodes * [0.7, 2.0, 0.9] @ rotated().T)
    assert quality.smallest_lengths(brick) == pytest.approx([1.4])
    for top in np.random.default_rng(5).uniform(-1.0, 2.0, (9, 3)):  # by each of its flat sides
        x = np.array(
            [[0.0, 0, 0], [1, 0, 0], [1.1, 0.7, 0], [0.6, 0.7, 0], top + np.array([0, 0, 1.1])]
        )
        wanted = [np.linalg.norm(a - b) for a, b in itertools.combinations(x, 2)]
        for _, side in CELL_TYPES["PYR5"].faces:
            a, b, c = x[list(side[:3])]
            normal = np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a))
            wanted += [abs((x[k] - a) @ normal) for k in {*range(5)} - {*side}]
        assert quality.smallest_lengths(cell("PYR5", x)) == pytest.approx([min(wanted)])
    assert quality.smallest_lengths(cell("SEG3", np.array([[0.0], [2.0], [3.0]]))) == 1.0


def rotated():
    return np.linalg.qr(np.random.default_rng(0).standard_normal((3, 3)))[0]


@together("name", ["SEG2", "TRI3", "TRI6", "QUA4", "TET4", "PYR5", "PRI6", "CUB8"])
def test_cells_contain_their_means_and_nothing_beyond_a_side(name):
    nodes = REFERENCE_CELLS[name].nodes
    nodes = np.column_stack([nodes, np.zeros((len(nodes), 3 - nodes.shape[1]))]) @ A.T + [2, 1, 0]
    block, rng = cell(name, nodes), np.random.default_rng(3)
    corners = nodes[list(CELL_TYPES[name].corners)]
    for _ in range(12):
        w = rng.dirichlet(np.ones(len(corners)))
        assert select.cells_containing(block, w @ corners).all()
        far = corners.mean(axis=0) + 1.02 * (corners[rng.integers(len(corners))] - corners.mean(0))
        assert not select.cells_containing(block, far).any()
    if CELL_TYPES[name].dimension < 3:
        off = np.cross(corners[1] - corners[0], [0.1, 0.7, 0.3])
        if CELL_TYPES[name].dimension == 2:
            off = np.cross(corners[1] - corners[0], corners[-1] - corners[0])
        assert not select.cells_containing(block, corners.mean(axis=0) + 1e-3 * off).any()


def test_a_point_far_from_the_origin_is_where_it_is_but_for_rounding():
    point = cell("POI1", np.array([[1e6, -3e6, 0.0]]))
    for off, there in ((1e-2, True), (1.0, False)):
        assert select.cells_containing(point, np.array([1e6 + off, -3e6, 0.0])).all() == there


def test_cells_and_nodes_are_picked():
    mesh, at = grid()
    x = mesh.nodes.coordinates
    ids = [at[1, 0], at[1, 1], at[2, 1], at[2, 0], at[0, 0]]
    for strictly, test in ((True, all), (False, any)):
        found = select.resting_on(mesh, np.array(ids), strictly)
        assert cells_of(found) == [c for c in cells_of(mesh) if test(n in ids for n in c[1])]
    middle = x[at[1, 1]]
    around = select.containing(mesh, middle, every=True)
    assert cells_of(around) == [c for c in cells_of(mesh) if at[1, 1] in c[1]]
    assert cells_of(select.containing(mesh, middle)) == cells_of(around)[:1]
    assert select.nearest_node(mesh, x[at[2, 1]] + [0.3, 0.2, 0.1]) == at[2, 1]
    with refusal(MeshError, "kernel.mesh.mesh-empty-no-nearest"):
        select.nearest_node(Mesh(mesh.nodes, ()), middle)
    row = [at[i, 0] for i in range(4)] + [at[3, 1], at[2, 1]]
    line = Mesh.of(mesh.nodes, "SEG2", np.array(list(itertools.pairwise(row))), np.arange(5))

    def told(start, end, of=line):
        part = select.stretch(of, start, end).blocks[0]
        return part.connectivity.tolist(), part.colours.tolist()

    forward = [list(p) for p in itertools.pairwise(row[1:5])]
    assert told(row[1], row[4]) == (forward, [1, 2, 3])
    assert told(row[4], row[1]) == ([p[::-1] for p in forward[::-1]], [3, 2, 1])
    ring = Mesh.of(mesh.nodes, "SEG2", np.array([*itertools.pairwise(row), (row[-1], row[0])]))
    wrapped = [[row[4], row[5]], [row[5], row[0]], [row[0], row[1]]]
    assert told(row[4], row[1], ring)[0] == wrapped
    for end, code in ((row[1], "two-points-line-part"), (at[0, 1], "node-no-end-cell")):
        with refusal(MeshError, f"kernel.mesh.{code}"):
            select.stretch(line, row[1], end)


def star(n=7):
    """A star in a slanted plane: nodes, frame and origin."""
    r = np.where(np.arange(2 * n) % 2, 1.0, 2.3)
    t = np.pi * np.arange(2 * n) / n + 0.1
    flat = np.column_stack([r * np.cos(t), r * np.sin(t)])
    frame = np.linalg.qr(A)[0]
    frame *= np.sign(np.linalg.det(frame))
    table = NodeTable()
    ids = table.add(flat @ frame[:, :2].T + [1.0, -2.0, 0.5])
    lines = Mesh.of(table, "SEG2", np.column_stack([ids, np.roll(ids, -1)]))
    return flat, frame, lines


def test_points_in_contours_and_their_distances():
    flat, frame, lines = star()
    rng = np.random.default_rng(8)
    p = rng.uniform(-2.5, 2.5, (300, 2))
    after = np.roll(flat, -1, axis=0)
    turns = np.zeros(300)  # winding: sum of the angles of the sides, as points see them
    for a, b in zip(flat, after, strict=True):
        u, v = a - p, b - p
        turns += np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))
    inside = np.abs(turns) > np.pi
    space = p @ frame[:, :2].T + [1.0, -2.0, 0.5]
    np.testing.assert_array_equal(select.inside_contour(space, lines, True), inside)
    assert not select.inside_contour(space + 0.01 * frame[:, 2], lines, False).any()
    border = 0.3 * flat + 0.7 * after
    border = border @ frame[:, :2].T + [1.0, -2.0, 0.5]
    assert select.inside_contour(border, lines, False).all()
    assert not select.inside_contour(border, lines, True).any()
    s = np.linspace(0.0, 1.0, 2001)
    many = np.concatenate([a + s[:, None] * (b - a) for a, b in zip(flat, after, strict=True)])
    gap = np.array([np.linalg.norm(many - q, axis=1).min() for q in p])
    found = select.segment_distance(p, flat, after)
    np.testing.assert_allclose(found, gap, atol=1e-3 * 0.5)
    table = NodeTable()
    ids = table.add(flat)
    plane = Mesh.of(table, "SEG2", np.column_stack([ids, np.roll(ids, -1)]))
    signed = signed_distance(p, plane, 2)  # normals to the left of an anticlockwise line: inwards
    np.testing.assert_allclose(signed, np.where(inside, gap, -gap), atol=1e-3)


def box(cut):
    """A slanted box of bricks or prisms, 2 x 1 x 1 cells, and where it is."""
    table = NodeTable()
    grid = np.array([[i, j, k] for k in range(2) for j in range(2) for i in range(3)], float)
    table.add(grid @ A.T)
    bricks = [[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]]
    if not cut:
        return Mesh.of(table, "CUB8", np.array(bricks))
    prisms = [[b[i] for i in p] for b in bricks for p in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
    return Mesh.of(table, "PRI6", np.array(prisms))


@pytest.mark.parametrize("cut", [False, True])
def test_points_in_volumes_and_before_their_skins(cut):
    mesh, rng = box(cut), np.random.default_rng(9)
    local = rng.uniform([-0.5, -0.5, -0.5], [2.5, 1.5, 1.5], (200, 3))
    out = np.max([-local, local - [2, 1, 1]], axis=(0, 2))
    p = local @ A.T
    np.testing.assert_array_equal(select.inside_volume(p, mesh, -1e-9), out < 0.0)
    face = np.array([[0.3, 0.4, 1.0], [2.0, 0.2, 0.6]]) @ A.T
    assert select.inside_volume(face, mesh, 1e-9).all()
    assert not select.inside_volume(face, mesh, -1e-9).any()
    walls = np.array([[1.0, 0.5, 0.5], [1.0, 0.3, 0.7], [0.5, 0.5, 0.5]]) @ A.T  # between cells
    assert select.inside_volume(walls, mesh, -0.1).all()
    low, high = np.array([[[0.05], [0.15]], [[1.95], [1.85]]]) * [1.0, 0.0, 0.0] + [0.0, 0.5, 0.5]
    kept = select.inside_volume(np.concatenate([low, high]) @ A.T, mesh, -0.1)
    assert kept.tolist() == [False, True] * 2
    skin = boundary.envelope(mesh)
    found = signed_distance(p, skin, 3)
    inward = np.linalg.inv(A)  # rows: normals of the faces of the slanted box
    depth = np.min([(local / np.linalg.norm(inward, axis=1)).T,
                    ((np.array([2, 1, 1]) - local) / np.linalg.norm(inward, axis=1)).T],
                   axis=(0, 1))  # fmt: skip
    np.testing.assert_allclose(found[out < 0], -depth[out < 0], atol=1e-9)
    assert (found[out > 0] > 0.0).all()
    s = np.array(list(itertools.product(np.linspace(0, 1, 41), repeat=2)))
    many = [np.insert(s * np.delete([2, 1, 1], k), k, side, axis=1) @ A.T
            for k in range(3) for side in (0.0, float([2, 1, 1][k]))]  # fmt: skip
    gap = np.array([np.linalg.norm(np.concatenate(many) - q, axis=1).min() for q in p])
    np.testing.assert_allclose(np.abs(found), gap, atol=0.03)
    assert (np.abs(found) <= gap + 1e-12).all()
    with refusal(MeshError, "kernel.mesh.mesh-volume-cells-needed"):
        select.inside_volume(p, skin, 0.0)


def test_distances_beyond_tips_and_fronts():
    table = NodeTable()
    table.add(np.array([[0.0, 0, 0], [2.0, 0, 0], [3.0, 1.0, 0], [3.0, 4.0, 0]]))
    line = Mesh.of(table, "SEG2", np.array([[0, 1], [2, 1], [2, 3]]))
    p = np.array([[-1.5, 0.7], [0.2, -3.0], [5.0, 6.5], [2.9, 3.0]])
    np.testing.assert_allclose(beyond_tip(p, line, (3, 0)), [1.5, -0.2, 2.5, -1.0])
    with pytest.raises(MeshError) as caught:
        beyond_tip(p, line, (1,))
    assert caught.value.data == {"n_touching": 2}
    table = NodeTable()
    x = np.array([[0.0, 0, 0], [2.0, 0, 0], [0, 3.0, 0], [2.5, 3.0, 0], [2.0, 5.0, 0]])
    table.add(x @ A.T)
    surface = Mesh.of(table, "TRI3", np.array([[0, 1, 2], [1, 3, 2], [2, 3, 4]]))
    front = Mesh.of(table, "SEG2", np.array([[1, 3], [3, 4]]))
    y, a = x @ A.T, x @ A.T
    for k, (first, last, third) in enumerate(((1, 3, 2), (3, 4, 2))):
        along = (y[last] - y[first]) / np.linalg.norm(y[last] - y[first])
        inside = a[third] - a[first]
        out = -(inside - (inside @ along) * along)
        out /= np.linalg.norm(out)
        normal = np.cross(along, out)
        length = np.linalg.norm(y[3] - y[1]) if k else 0.0
        for s, ahead, up in ((0.4, 0.3, 0.2), (0.7, -0.2, -0.1)):
            point = y[first] + s * along + ahead * out + up * normal
            found = beyond_front(point[None], surface, front)
            np.testing.assert_allclose(np.ravel(found), [ahead, length + s], atol=1e-12)


def test_faults_of_meshes_are_found():
    table = NodeTable()
    x = np.array([[0.0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1], [4, 0], [4, 2]])
    table.add(np.full((7, 3), 8.0))
    ids = table.add(np.column_stack([x, np.zeros(10)]))
    bent = CellBlock.make(table, "QUA8", ids[:8])
    plain = CellBlock.make(table, "QUA4", ids[[4, 2, 8, 9]])  # the side in the other sense
    found = quality.unmatched_middles(Mesh(table, (bent, plain)))
    assert found.blocks[0].connectivity.tolist() == [[ids[3]]]
    line = CellBlock.make(table, "SEG2", ids[[6, 0]])
    found = quality.unmatched_middles(Mesh(table, (bent, line)))
    assert found.blocks[0].connectivity.tolist() == [[ids[7]]]
    mixed = box(False)
    top = Mesh.of(mixed.nodes, "TET4", np.array([[7, 8, 11, 0], [6, 7, 9, 2], [6, 7, 8, 3]]))
    unfit = quality.unfit_faces(Mesh(mixed.nodes, mixed.blocks + top.blocks))
    assert {tuple(sorted(r)) for r in unfit.blocks[0].connectivity.tolist()} == {
        (7, 8, 11), (6, 7, 9),
    }  # fmt: skip
    assert not quality.unfit_faces(mixed).blocks


def test_maps_move_what_they_say_and_keep_what_they_hold():
    rng = np.random.default_rng(12)
    a, b, c = rng.standard_normal((3, 3))
    x = rng.standard_normal((9, 3))
    unit = (b - a) / np.linalg.norm(b - a)
    angle = 37.0
    t = np.radians(angle)
    K = np.cross(np.eye(3), unit)  # Rodrigues
    R = np.eye(3) + np.sin(t) * K + (1 - np.cos(t)) * K @ K
    np.testing.assert_allclose(transform.turn(angle, a, b - a)(x), a + (x - a) @ R.T)
    half = transform.turn(180.0, a, b - a)(x)
    np.testing.assert_allclose(transform.mirror_line(a, b)(x), half)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal)
    H = np.eye(3) - 2 * np.outer(normal, normal)
    np.testing.assert_allclose(transform.mirror_plane(a, b, c)(x), a + (x - a) @ H)
    np.testing.assert_allclose(transform.mirror_point(a)(x), a - (x - a))
    np.testing.assert_allclose(transform.scaling(2.5, a)(x), a + 2.5 * (x - a))
    S = np.eye(3) + 1.5 * np.outer(unit, unit)
    np.testing.assert_allclose(transform.affinity(2.5, a, b)(x), a + (x - a) @ S)
    np.testing.assert_allclose(transform.shift(b)(x), x + b)
    polar = transform.to_cylindrical(a, b - a, c - a)(x)
    first = (c - a) - ((c - a) @ unit) * unit
    first /= np.linalg.norm(first)
    frame = np.column_stack([first, np.cross(unit, first), unit])
    np.testing.assert_allclose(a + transform.from_cylindrical(polar) @ frame.T, x)
    old, new = rng.standard_normal((2, 4, 3))
    np.testing.assert_allclose(transform.affine_through(old, new, 3)(old), new)
    part = transform.affine_through(old[:2], new[:2], 3)
    across = np.cross(old[1] - old[0], a)
    np.testing.assert_allclose(part(old[:1] + across), new[:1] + across)
    for given, code in ((old[[0, 0, 1]], "points-define-map-line"),
                        (old[:0], "map-takes-many-points")):  # fmt: skip
        with refusal(MeshError, f"kernel.mesh.{code}"):
            transform.affine_through(given, new[: len(given)], 3)
    with pytest.raises(MeshError) as caught:
        transform.affine_through(old, new, 2)
    assert caught.value.data == {"dimension": 3, "n_old": 4}
    mesh, at = grid()
    copier = transform.NodeCopier(mesh.nodes, transform.shift(b))
    mesh.nodes.density[at[1, 1]] = 0.7
    before = mesh.nodes.coordinates.copy()
    two = [copier.mesh(mesh), copier.mesh(boundary.contour(mesh))]
    for copy, source in zip(two, (mesh, boundary.contour(mesh)), strict=True):
        for mine, other in zip(copy.blocks, source.blocks, strict=True):
            np.testing.assert_allclose(mine.coordinates, other.coordinates + b)
            np.testing.assert_array_equal(mine.colours, other.colours)
    assert set(two[1].node_ids) <= set(two[0].node_ids)
    assert mesh.nodes.density[copier.of_nodes(np.array([at[1, 1]]))] == 0.7
    np.testing.assert_array_equal(mesh.nodes.coordinates[: len(before)], before)
    pairs = transform.mapping_between(mesh, two[0])
    assert pairs.of_nodes(np.array([[at[2, 0], at[0, 1]]])).tolist() == [
        [copier.copies[at[2, 0]], copier.copies[at[0, 1]]]
    ]
    with refusal(MeshError, "kernel.mesh.node-not-belong-mesh"):
        pairs.of_nodes(np.array([0]))
    transform.move(mesh.nodes, np.array([at[0, 0], at[0, 0], at[3, 1]]), transform.shift(b))
    moved = np.flatnonzero((mesh.nodes.coordinates[: len(before)] != before).any(axis=1))
    assert moved.tolist() == sorted([at[0, 0], at[3, 1]])
    np.testing.assert_allclose(mesh.nodes.coordinates[at[0, 0]], before[at[0, 0]] + b)


@together("name", ["TRI3", "QUA4", "TET4", "CUB8", "PRI6", "PYR5"])
def test_a_linear_motion_of_what_is_held_is_followed_within(name):
    """One node is not held: the others, in no order and with a stranger, are."""
    rng = np.random.default_rng(8)
    table, flat = NodeTable(), name in ("TRI3", "QUA4")
    x = np.array(list(itertools.product(range(3), range(3), range(1 if flat else 3))), float)
    middle = len(x) // 2
    x[middle, : 2 if flat else 3] += 0.2
    ids = table.add(x)
    low = [0, 1, 3, 4] if flat else [0, 1, 3, 4, 9, 10, 12, 13]
    whole = np.array(low)[:, None] + ([0, 3, 4, 1] if flat else [0, 9, 12, 3, 1, 10, 13, 4])
    split = {"TRI3": [[0, 1, 2], [0, 2, 3]], "QUA4": [[0, 1, 2, 3]], "CUB8": [list(range(8))],
             "TET4": [[0, 1, 2, 5], [0, 2, 3, 7], [0, 5, 7, 4], [2, 7, 5, 6], [0, 2, 7, 5]],
             "PRI6": [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]],
             "PYR5": [[0, 1, 2, 3, 6], [0, 4, 5, 1, 6], [0, 3, 7, 4, 6]]}[name]  # fmt: skip
    cells = whole[:, split].reshape(-1, len(split[0]))
    A = rng.standard_normal((3, 3))
    if flat:  # out of its plane
        A[:, 2] = 0.0
    held = rng.permutation(np.setdiff1d(ids, [middle]))
    stranger = table.add(np.ones((1, 3)))
    masters = np.concatenate([held, stranger])
    places = table.coordinates[masters] @ A.T + [1.0, 2.0, 3.0]
    nodes, moved = transform.followed(Mesh.of(table, name, cells), masters, places)
    assert nodes.tolist() == ids.tolist()
    np.testing.assert_allclose(moved, table.coordinates[nodes] @ A.T + [1.0, 2.0, 3.0], atol=1e-12)


def test_inner_nodes_become_even_and_those_held_or_on_the_rim_stay():
    """Of a square of 4 x 4 cells whose corners and one inner node are held, pulled to one side."""
    table = NodeTable()
    x = np.array(list(itertools.product(range(5), range(5), range(1))), float)
    ids, low = table.add(x), np.array([5 * i + j for i in range(4) for j in range(4)])
    mesh = Mesh.of(table, "QUA4", low[:, None] + [0, 5, 6, 1])
    held = ids[[0, 4, 11, 20, 24]]
    places = x[held] * [1.0, 2.0, 1.0] + [
        [0.0, 0, 0],
        [0, 0, 0],
        [0.4, 0.3, 0],
        [0, 0, 0],
        [1, 0, 0],
    ]
    plain, even = (transform.followed(mesh, held, places, wish)[1] for wish in (False, True))
    inner = np.array([6, 7, 8, 12, 13, 16, 17, 18])
    others = np.setdiff1d(ids, inner)
    np.testing.assert_allclose(even[others], plain[others])
    np.testing.assert_allclose(even[held], places)
    around = even[inner[:, None] + [-5, 5, -1, 1]].mean(axis=1)
    np.testing.assert_allclose(even[inner], around)


def test_lines_that_bend_that_continue_and_that_repeat():
    table = NodeTable()
    ring = np.array([[0.0, 0], [1.5, -0.4], [3, 0], [3.2, 0.9], [3, 2], [1.4, 1.1]])
    ids = table.add(np.column_stack([ring, np.zeros(6)]))
    rows = np.array([[0, 1, 2], [2, 3, 4], [4, 5, 0]])
    bent = Mesh.of(table, "SEG3", ids[rows])
    area = 3.0  # of the triangle; each parabola has two thirds of its middle's triangle
    for a, m, b in ring[rows]:
        area += 4 / 3 * 0.5 * (np.cross(np.append(m - a, 0), np.append(b - a, 0))[2])
    assert measure.signed_area(bent) == pytest.approx(area)
    assert measure.signed_area(orientation.reversed_line(bent)) == pytest.approx(-area)
    with refusal(MeshError, "kernel.mesh.area-inside-line-asked"):
        measure.signed_area(combine.poi1(table, ids))
    first, second, third = (
        Mesh.of(table, "SEG2", ids[list(p)][None]) for p in ((2, 4), (0, 2), (4, 5))
    )
    for order in ((first, second, third), (second, first, third)):
        found = combine.union(*order).blocks[0].connectivity.tolist()
        assert found == ids[[[0, 2], [2, 4], [4, 5]]].tolist()
    given = combine.union(first, second, third, as_given=True).blocks[0].connectivity
    assert given.tolist() == ids[[[2, 4], [0, 2], [4, 5]]].tolist()
    twice = Mesh.of(table, "SEG2", np.array([[0, 1], [1, 0], [2, 3], [0, 1], [3, 2], [4, 5]]))
    assert [len(cells_of(p)) for p in partition.connected(twice)] == [3, 2, 1]
    corners = Mesh.of(table, "TRI3", ids[[[0, 2, 4], [5, 4, 2]]])  # the second in the other sense
    edge = boundary.contour(corners).blocks[0].connectivity
    assert sorted(edge[:, 0].tolist()) == sorted(edge[:, 1].tolist())  # one loop, one sense
    assert edge[0].tolist() in ids[[[0, 2], [4, 0]]].tolist()
    lone = boundary.lone_cells(Mesh(table, (
        CellBlock.make(table, "TRI3", ids[[[0, 2, 4], [4, 2, 0], [5, 4, 2]]]),
    )))  # fmt: skip
    assert lone.blocks[0].connectivity.tolist() == [ids[[5, 4, 2]].tolist()]
