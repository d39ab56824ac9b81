"""Grids on four sides, in six faces and on parameters: unlike counts, graded, crooked; numbers."""

import itertools

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import contour, envelope
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.generators.sweep import (
    cone,
    listed_cuts,
    mean_density,
    mean_position,
    rotation,
    ruling,
    stitch,
    sweep_line,
    sweep_surface,
    translation,
)
from ssilang.kernel.mesh.lines.lines import chain_mesh, line_chain
from ssilang.kernel.mesh.lines.subdivision import Subdivision
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import reversed_line, signed_volumes, surface_normals
from ssilang.kernel.mesh.queries.measure import enclosed_volume
from ssilang.kernel.mesh.surfaces.analytic import (
    PolynomialSurface,
    mesh_polynomial_surface,
)
from ssilang.kernel.mesh.surfaces.grid import grid_surface, matching_sides, sides_in_order
from ssilang.kernel.mesh.volumes.block import fill_block

CORNERS = np.random.default_rng(4).uniform(-0.2, 0.2, (2, 2, 2, 3)) + np.stack(
    np.meshgrid([0, 2.0], [0, 3.0], [0, 1.5], indexing="ij"), axis=-1
)
CUTS = [np.array([0, 0.2, 0.7, 1.0]), np.array([0, 0.5, 1.0]), np.array([0, 0.1, 0.3, 0.6, 1.0])]


def trilinear(r, s, t):
    """Position of local coordinates in the crooked brick."""
    w = [np.stack([1 - a, a]) for a in (r, s, t)]
    return np.einsum("i...,j...,k...,ijkd->...d", *w, CORNERS)


def local_grid():
    return np.meshgrid(*CUTS, indexing="ij")


class Brick:
    """Six faces of one table of nodes, each a grid in an order and sense of its own."""

    def __init__(self, seed=0):
        self.nodes = NodeTable()
        self.x = trilinear(*local_grid())
        shape = self.x.shape[:3]
        outer = np.ones(shape, bool)
        outer[1:-1, 1:-1, 1:-1] = False
        self.ids = np.full(shape, -1)
        self.ids[outer] = self.nodes.add(self.x[outer], 0.4)
        self.rng, self.sense = np.random.default_rng(seed), 1 - 2 * (seed % 2)
        self.tables = [self.ids[0], self.ids[-1], self.ids[:, 0], self.ids[:, -1],
                       self.ids[:, :, 0], self.ids[:, :, -1]]  # fmt: skip

    def faces(self, first):
        """Six meshes; the pair of axis `first` comes first, in the sense of the seed."""
        order = [
            *[2 * first, 2 * first + 1][:: self.sense],
            *(k for k in range(6) if k // 2 != first),
        ]
        return [self.face(self.tables[k]) for k in order]

    def face(self, table):
        cells = np.stack([table[:-1, :-1], table[:-1, 1:], table[1:, 1:], table[1:, :-1]], axis=-1)
        cells = cells.reshape(-1, 4)[self.rng.permutation((np.array(table.shape) - 1).prod())]
        cells = np.roll(cells, self.rng.integers(4), axis=1)
        return Mesh.of(self.nodes, "QUA4", cells[:, :: self.rng.choice([-1, 1])])


@pytest.mark.parametrize("first", [0, 1, 2])
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_crooked_block_is_filled_on_its_trilinear_map(first, seed):
    brick = Brick(seed)
    made = fill_block(brick.faces(first), 3)
    block = made.single_block()
    assert len(block) == 3 * 2 * 4
    found, expected = (
        a[np.lexsort(np.round(a, 9).T)]
        for a in (made.nodes.coordinates[made.node_ids], brick.x.reshape(-1, 3))
    )
    np.testing.assert_allclose(found, expected, atol=1e-12)
    volumes = np.abs(signed_volumes(block))
    skin = union(*brick.faces(0))
    assert volumes.sum() == pytest.approx(abs(enclosed_volume(envelope(made))), rel=1e-9)
    assert {tuple(sorted(c)) for b in skin.blocks for c in b.connectivity.tolist()} == {
        tuple(sorted(c)) for b in envelope(made).blocks for c in b.connectivity.tolist()
    }
    assert len(made.sides) == 6
    assert set(block.colours.tolist()) == {3}
    fresh = np.setdiff1d(made.node_ids, brick.ids)
    np.testing.assert_allclose(made.nodes.density[fresh], 0.4)


@together(
    "changed, match",
    [
        (lambda f: [*f[:5], f[4]], "side"),
        (lambda f: [f[0], f[0], *f[2:]], "faces|numbers"),
        (lambda f: [f[0], f[2], f[2], *f[3:]], "side|faces|numbers"),
        (lambda f: [Mesh.of(f[0].nodes, "TRI3", np.array([[0, 1, 2]])), *f[1:]], "QUA4"),
        (lambda f: [Mesh.of(f[0].nodes, "QUA4", f[0].blocks[0].raw[:3]), *f[1:]], "grid"),
    ],
)
def test_faces_that_close_no_block_are_refused(changed, match):
    with pytest.raises(MeshError, match=match):
        fill_block(changed(Brick().faces(0)))


# --- surfaces --------------------------------------------------------------------------------


def four_sides(quadratic):
    """Sides of a bilinear patch of 3 by 2 cells, graded, two of them run the other way."""
    nodes = NodeTable()
    u, v = np.array([0, 0.15, 0.5, 1.0]), np.array([0, 0.65, 1.0])
    if quadratic:
        u, v = (np.sort(np.append(a, (a[1:] + a[:-1]) / 2)) for a in (u, v))
    r, s = np.meshgrid(u, v)
    x = trilinear(r, s, 0 * r + 0.3)
    ids = np.full(r.shape, -1)
    rim = np.ones(r.shape, bool)
    rim[1:-1, 1:-1] = False
    ids[rim] = nodes.add(x[rim], 0.1 + r[rim] + 2 * s[rim])
    chains = ids[0], ids[::-1, -1], ids[-1, ::-1], ids[:, 0]
    return nodes, x, r, s, [chain_mesh(nodes, c, quadratic) for c in chains]


@pytest.mark.parametrize("quadratic", [False, True])
def test_a_grid_stands_on_the_bilinear_map_of_its_sides(quadratic):
    nodes, x, r, s, sides = four_sides(quadratic)
    ordered = sides_in_order(sides)
    chains = [line_chain(m) for m in ordered]
    assert [c[-1] for c in chains] == [c[0] for c in chains[1:] + chains[:1]]
    assert matching_sides(ordered)
    before = len(nodes)
    made = grid_surface(ordered, None, 6)
    wanted = np.zeros(r.shape, bool)
    wanted[1:-1, 1:-1] = True
    if quadratic:
        wanted[1::2, 1::2] = False
    np.testing.assert_allclose(nodes.coordinates[before:], x[wanted], atol=1e-12)
    even_u, even_v = (np.linspace(0, 1, n) for n in r.shape[::-1])
    u, v = (np.broadcast_to(a, r.shape) for a in (even_u[None], even_v[:, None]))
    rim = 0.1 + r + 2 * s
    mean = 0.5 * ((1 - v) * rim[0] + v * rim[-1] + (1 - u) * rim[:, :1] + u * rim[:, -1:])
    np.testing.assert_allclose(nodes.density[before:], mean[wanted])
    block = made.single_block()
    assert (block.cell_type, len(block)) == ("QUA8" if quadratic else "QUA4", 6)
    assert (surface_normals(block)[:, 2] > 0.0).all()
    rim = {tuple(sorted(c)) for m in sides for c in m.single_block().connectivity.tolist()}
    assert rim == {tuple(sorted(c)) for c in contour(made).single_block().connectivity.tolist()}


def test_sides_that_do_not_close_or_mix_degrees_are_refused():
    sides, others = four_sides(False)[4], four_sides(True)[4]
    with pytest.raises(MeshError, match="four"):
        sides_in_order([sides[0], sides[2], sides[1], sides[1]])
    mixed = [*sides_in_order(sides)[:3], others[3]]
    with pytest.raises(MeshError, match="same"):
        grid_surface(mixed, None)
    assert not matching_sides([sides[0], sides[1], sides[1], sides[3]])
    back = sides_in_order([reversed_line(m) for m in sides])
    assert line_chain(back[0])[0] == line_chain(back[3])[-1]


@pytest.mark.parametrize("kind", ["QUA4", "QUA8", "TRI3", "TRI6"])
@pytest.mark.parametrize("regular", [False, True])
def test_polynomial_surfaces_have_their_nodes_on_them(kind, regular):
    nodes = NodeTable()
    rng = np.random.default_rng(1)
    table = 0.15 * rng.standard_normal((3, 4, 3))
    table[0, 1], table[1, 0] = [3, 0.2, 0], [0.1, 2, 0.3]
    surface = PolynomialSurface(table, (-0.2, 1.0), (0.1, 0.9))
    u, v = rng.uniform(size=(2, 6))
    expected = sum(table[j, i] * (u**i * v**j)[:, None] for i in range(4) for j in range(3))
    np.testing.assert_allclose(surface.at(u, v), expected)
    made = mesh_polynomial_surface(nodes, surface, 0.5, kind, regular, 2)
    lines = [surface.along_u(0.1, regular), surface.along_v(1.0, regular),
             surface.along_u(0.9, regular), surface.along_v(-0.2, regular)]  # fmt: skip
    degree = 2 if kind in ("QUA8", "TRI6") else 1
    counts = [max(round(max(a.length, b.length) / 0.5), 1) for a, b in (lines[::2], lines[1::2])]
    assert made.n_cells == counts[0] * counts[1] * (2 if kind[0] == "T" else 1)
    for line, side, back in zip(lines, made.sides, (0, 0, 1, 1), strict=True):
        x = nodes.coordinates[line_chain(side)]
        s = np.linspace(0, 1, len(x))
        np.testing.assert_allclose(x[::-1] if back else x, line(s), atol=1e-9)
    block = made.single_block()
    corners = block.coordinates[:, list(block.kind.corners)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, -1] - corners[:, 0])
    assert (normals @ normals[0] > 0).all()
    rim = {tuple(sorted(c)) for c in contour(made).single_block().connectivity.tolist()}
    assert rim == {
        tuple(sorted(c)) for m in made.sides for c in m.single_block().connectivity.tolist()
    }
    assert len(next(iter(rim))) == degree + 1
    with pytest.raises(MeshError, match="size"):
        mesh_polynomial_surface(nodes, surface, 0.0, kind)
    flat = PolynomialSurface(table[:1], (0.0, 1.0), (0.5, 0.5))
    with pytest.raises(MeshError, match="opposite"):
        mesh_polynomial_surface(nodes, flat, 0.5, kind)


# --- sweeps --------------------------------------------------------------------------------


def floor(degree=1):
    """A triangle and a quadrangle that share a side."""
    nodes = NodeTable()
    p = np.array([[1, 0, 0], [3, 0.2, 0], [2.8, 1.5, 0], [1.2, 1.3, 0], [4.2, 0.9, 0]])
    ids = nodes.add(p, [0.1, 0.2, 0.3, 0.4, 0.5])
    quad, tri = np.array([[0, 1, 2, 3]]), np.array([[1, 4, 2]])
    if degree == 2:
        sides = sorted(
            {tuple(sorted((c[k], c[k - 1]))) for c in (*quad, *tri) for k in range(len(c))}
        )
        middles = dict(zip(sides, nodes.add(p[sides].mean(axis=1)).tolist(), strict=True))
        quad, tri = (
            np.array([[n for k in range(len(c)) for n in
                       (c[k], middles[tuple(sorted((c[k], c[(k + 1) % len(c)])))])] for c in t])
            for t in (quad, tri)
        )  # fmt: skip
    kinds = ("QUA4", "TRI3") if degree == 1 else ("QUA8", "TRI6")
    parts = [Mesh.of(nodes, k, ids[t] if degree == 1 else t, c)
             for k, t, c in zip(kinds, (quad, tri), (2, 5), strict=True)]  # fmt: skip
    return union(*parts)


@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("turned", [False, True])
def test_a_swept_surface_has_its_layers_sides_and_volume(degree, turned):
    base, cuts = floor(degree), Subdivision(np.array([0, 0.3, 1.0]), 0.2, 0.6)
    way, axis, origin = np.array([0.3, 0.1, 2.0]), np.array([0, 2.0, 0]), np.array([-1.0, 5, 0])
    path = rotation(base, 50.0, origin, axis) if turned else translation(way)
    start = base.nodes.coordinates[base.node_ids].copy()
    before = len(base.nodes)
    made = sweep_surface(base, path, cuts)
    levels = [0.3, 1.0] if degree == 1 else [0.15, 0.3, 0.65, 1.0]
    fresh = base.nodes.coordinates[before:]

    def moved(x, s):
        if not turned:
            return x + s * way
        a, arm = np.radians(50.0) * s, x - origin
        c, d = np.cos(a), np.sin(a)
        R = np.array([[c, 0, d], [0, 1, 0], [-d, 0, c]])  # about y
        return origin + arm @ R.T

    corner = start[base.node_ids < 5]
    for s in levels:
        which = start if s in (0.3, 1.0) else corner
        for x in moved(which, s):
            row = np.linalg.norm(fresh - x, axis=1).argmin()
            np.testing.assert_allclose(fresh[row], x, atol=1e-12)
            assert base.nodes.density[before + row] == pytest.approx(0.2 + 0.4 * s)
    assert len(fresh) == sum(len(start) if s in (0.3, 1.0) else 5 for s in levels)
    kinds = {b.cell_type: len(b) for b in made.blocks}
    assert kinds == ({"CUB8": 2, "PRI6": 2} if degree == 1 else {"CU20": 2, "PR15": 2})
    assert [b.colours.tolist() for b in made.blocks] == [[2, 2], [5, 5]]
    ahead = -1.0 if turned else 1.0  # the normals of the base look there
    volumes = [ahead * signed_volumes(b) for b in made.blocks]
    assert all((v > 0.0).all() for v in volumes)
    area = [2.055, 0.5 * abs(np.linalg.det([[1.2, 0.7], [-0.2, 1.3]]))]
    corners = base.nodes.coordinates[:4]
    area[0] = 0.5 * abs(np.cross(corners[2] - corners[0], corners[3] - corners[1])[2])
    if not turned:
        np.testing.assert_allclose([v.sum() for v in volumes], 2.0 * np.array(area), rtol=1e-12)
    assert path.length == pytest.approx(
        np.radians(50) * (mean_position(base)[0] + 1.0) if turned else np.linalg.norm(way)
    )
    end, around = made.sides[1], made.sides[2]
    np.testing.assert_allclose(
        end.nodes.coordinates[end.blocks[0].connectivity],
        np.array([moved(x, 1.0) for x in base.blocks[0].coordinates]), atol=1e-12,
    )  # fmt: skip
    skin = {tuple(sorted(c)) for m in made.sides for b in m.blocks for c in b.connectivity.tolist()}
    assert skin == {
        tuple(sorted(c)) for b in envelope(made).blocks for c in b.connectivity.tolist()
    }
    assert around.n_cells == 2 * 5


@together("surface", ["QUA4", "TRI3", "QUA8", "TRI6"])
def test_a_swept_line_has_its_sides_in_order_and_its_area(surface):
    nodes = NodeTable()
    degree = 2 if surface in ("QUA8", "TRI6") else 1
    x = np.linspace(0, 1, 3 * degree + 1) ** 2
    if degree == 2:
        x[1::2] = (x[:-1:2] + x[2::2]) / 2
    ids = nodes.add(np.column_stack([3 * x, x, 0 * x]))
    line = chain_mesh(nodes, ids, degree == 2, 4)
    cuts = listed_cuts(np.array([2.0, 2.5, 4.0]), 5.0)
    np.testing.assert_allclose(cuts.fractions, [0, 0.25, 1])
    assert (cuts.start_density, cuts.end_density) == (2.5, 2.5)
    made = sweep_line(line, translation(np.array([-0.5, 2.0, 1.0])), cuts, surface)
    block = made.single_block()
    assert len(block) == 6 * (2 if surface[0] == "T" else 1)
    c = block.coordinates[:, list(block.kind.corners)]
    normal = np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]) / 2
    if surface[0] == "Q":
        normal += np.cross(c[:, 2] - c[:, 0], c[:, 3] - c[:, 0]) / 2
    np.testing.assert_allclose(normal.sum(axis=0), np.cross([3, 1, 0], [-0.5, 2, 1]))
    assert (normal @ normal[0] > 0).all()
    chains = [line_chain(m) for m in made.sides]
    assert [a[-1] for a in chains] == [a[0] for a in chains[1:] + chains[:1]]
    assert set(block.colours.tolist()) == {4}


def test_sizes_and_positions_of_a_base_count_nodes_by_cells():
    base = floor()
    nodes = [0, 1, 2, 3, 1, 4, 2]
    density, x = base.nodes.density, base.nodes.coordinates
    assert mean_density(base) == pytest.approx(density[nodes].mean())
    np.testing.assert_allclose(mean_position(base), x[nodes].mean(axis=0))
    for bad in ([1.0], [2.0, 3.0, 2.0]):
        with pytest.raises(MeshError, match="list"):
            listed_cuts(np.array(bad), 1.0)


def test_ruled_volumes_lie_between_their_ends():
    base = floor()
    other = Mesh(base.nodes, tuple(
        Mesh.of(base.nodes, b.cell_type, b.connectivity + 5, b.colours).single_block()
        for b in base.blocks
    ))  # fmt: skip
    base.nodes.add(base.nodes.coordinates[:5] * [1.3, 0.8, 1] + [0.2, 0, 2.5])
    path = ruling(base, other)
    cuts = Subdivision(np.array([0, 0.4, 1.0]), 1.0, 1.0)
    made = sweep_surface(base, path, cuts)
    x = base.nodes.coordinates
    np.testing.assert_allclose(x[10:15], 0.6 * x[:5] + 0.4 * x[5:10])
    assert len(base.nodes) == 15
    assert path.length == pytest.approx(np.linalg.norm(mean_position(other) - mean_position(base)))
    assert set(made.sides[1].node_ids.tolist()) == set(range(5, 10))
    line, far = (chain_mesh(base.nodes, np.array(c), False) for c in ((0, 1, 4), (8, 7, 9)))
    assert ruling(line, far).length == pytest.approx(
        np.linalg.norm(x[[8, 7, 9]] - x[[0, 1, 4]], axis=1).mean()
    )
    with pytest.raises(MeshError, match="same"):
        ruling(line, chain_mesh(base.nodes, np.array([0, 1]), False))


# --- stitches and cones ---------------------------------------------------------------------------


@pytest.mark.parametrize(("n", "m"), [(3, 7), (7, 3), (4, 1)])
def test_two_lines_are_stitched_without_gap(n, m):
    nodes = NodeTable()
    s, t = np.linspace(0, 1, n + 1) ** 1.5, np.linspace(0, 1, m + 1)
    a = nodes.add(np.column_stack([3 * s, 0.2 * s, 0 * s]))
    b = nodes.add(np.column_stack([3 * t, 1 + 0.5 * t, 0 * t]))
    made = stitch(chain_mesh(nodes, a, False), chain_mesh(nodes, b, False), 3).single_block()
    x = made.coordinates
    areas = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])[:, 2] / 2
    assert len(made) == n + m
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(3 * (1 + 1.3) / 2)
    near = max(np.linalg.norm(x[:, i] - x[:, j], axis=1).max() for i, j in ((0, 1), (1, 2), (2, 0)))
    assert near < 2.0 or m == 1  # no way along the whole strip
    ends = chain_mesh(nodes, a[[0, -1]], False), chain_mesh(nodes, b[[0, -1]], False)
    assert set(stitch(*ends).single_block().connectivity[0]) == {a[0], a[-1], b[0]}  # the shorter
    with pytest.raises(MeshError, match="same"):
        stitch(chain_mesh(nodes, a[:2], False), chain_mesh(nodes, a[:2], False))


def test_cells_are_joined_to_a_point_but_those_that_hold_it():
    base = floor()
    tip = int(base.nodes.add(np.array([[2.0, 0.5, 1.7]]))[0])
    made = cone(base, tip)
    corners = [b.coordinates for b in made.blocks]
    areas = {"PYR5": 0.0, "TET4": 0.0}
    for b, x in zip(made.blocks, corners, strict=True):
        for i, j in itertools.pairwise(range(1, x.shape[1] - 1)):
            arms = x[0, [i, j, -1]] - x[0, 0]
            areas[b.cell_type] += np.linalg.det(arms) / 6
    flat = [0.5 * np.cross(c[2] - c[0], c[-1] - c[1])[2] for c in (base.blocks[0].coordinates[0],)]
    assert areas["PYR5"] == pytest.approx(flat[0] * 1.7 / 3)
    assert areas["TET4"] == pytest.approx(0.5 * (1.2 * 1.3 + 0.2 * 0.7) * 1.7 / 3)
    assert [b.colours.tolist() for b in made.blocks] == [[2], [5]]
    ring = contour(base)
    fan = cone(ring, 0)
    assert fan.n_cells == ring.n_cells - 2
    alone = Mesh.of(base.nodes, "POI1", np.array([[1], [4]]))
    assert cone(alone, 4).single_block().connectivity.tolist() == [[1, 4]]
    bows = Mesh.of(base.nodes, "SEG3", np.array([[0, 1, 2], [4, 3, 2]]))  # in no chain
    curved = cone(bows, tip).single_block()
    assert curved.connectivity[:, [0, 1, 2, 4]].tolist() == [[0, 1, 2, tip], [4, 3, 2, tip]]
    ends = curved.coordinates[:, [2, 4, 0]]
    np.testing.assert_allclose(curved.coordinates[:, [3, 5]], (ends[:, :2] + ends[:, 1:]) / 2)
    straight = Mesh.of(base.nodes, "SEG2", np.array([[0, 3]]))
    both = cone(Mesh(base.nodes, (*bows.blocks, *straight.blocks)), tip)
    assert [(b.cell_type, len(b)) for b in both.blocks] == [("TRI6", 2), ("TRI3", 1)]
    with pytest.raises(MeshError, match="away"):
        cone(Mesh.of(base.nodes, "POI1", np.array([[4]])), 4)
    with pytest.raises(MeshError, match="TET4"):
        cone(Mesh(base.nodes, made.blocks[1:]), 0)


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
