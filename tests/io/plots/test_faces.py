"""What the painter is given: polygons, colours and widths, for cells of every kind at once.

Cells of four kinds and three colours in no order, one without a value; the field is linear.
"""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from together import together

from ssilang.io.plots.bands import choose_levels
from ssilang.io.plots.cutting import nodal_means
from ssilang.io.plots.faces import add_bands, add_faces, add_points, add_section, band_values
from ssilang.io.plots.layers import Layer, PictureOptions
from ssilang.io.plots.palette import index_of, shade
from ssilang.io.plots.patches import all_faces, pieces, visible_faces
from ssilang.io.plots.values import values_on
from ssilang.io.plots.view import Plane, plane_view
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable

PLACES = [(3, 1.5), (1, 0.5), (2, 0.5), (2, 1), (1, 1.25), (4, 0.75), (5, 3), (0, 0)]
CELLS = {
    "SEG2": ([[6, 0], [4, 7]], "VERT"), "POI1": ([[5], [7]], "ROUG"),
    "QUA4": ([[1, 2, 3, 4]], "DEFA"), "TRI3": ([[2, 5, 3], [5, 0, 3], [7, 2, 1]], "ROUG"),
}  # fmt: skip
WITHOUT = 7  # the node that has no value


@pytest.fixture
def mesh() -> Mesh:
    table = NodeTable()
    ids = table.add(np.array(PLACES, float))
    assert ids.tolist() == list(range(8))
    blocks = [
        CellBlock.make(table, kind, np.array(rows), index_of(colour))
        for kind, (rows, colour) in CELLS.items()
    ]
    return Mesh(table, tuple(blocks))


def linear(points: np.ndarray) -> np.ndarray:
    return points[..., 0] - 2.0 * points[..., 1]


def field(mesh: Mesh) -> NodeField:
    ids = np.array([i for i in range(8) if i != WITHOUT])
    return NodeField.of(mesh.nodes, ids, {"T": linear(mesh.nodes.coordinates[ids])})


class Recorder(SimpleNamespace):
    """A painter that keeps what it is given."""

    def __init__(self) -> None:
        super().__init__(view=plane_view(), polygons=[], dots=[])

    def add(self, points: Any, face: Any = None, edge: Any = None, width: float = 0.0,
            rank: int = 0, light: str = "") -> None:  # fmt: skip
        for i, polygon in enumerate(points):
            inks = [
                None if c is None else np.broadcast_to(c, (len(points), 4))[i] for c in (face, edge)
            ]
            self.polygons.append((polygon[:, :2], *inks, width, rank, light))

    def add_dots(self, points: Any, inks: Any, width: float) -> None:
        self.dots += [(p[:2].tolist(), ink) for p, ink in zip(points, inks, strict=True)]


def drawn(mesh: Mesh, **options: Any) -> list[tuple[Any, ...]]:
    layer = {k: options.pop(k) for k in ("outline", "colour", "edges") if k in options}
    recorder = Recorder()
    add_faces(recorder, visible_faces(mesh), Layer(mesh, **layer), PictureOptions(**options), 5.0)
    return recorder.polygons


@pytest.mark.parametrize("shrink", [None, 0.5])
@pytest.mark.parametrize("filled", ["", "FACE", "FACB"])
def test_each_cell_is_drawn_once_in_its_colour(mesh, filled, shrink):
    found = drawn(mesh, filled=filled, shrink=shrink)
    wanted = [
        (np.array([PLACES[i] for i in row], float), np.array(to_rgb(shade(colour))), kind)
        for kind, (rows, colour) in CELLS.items() if kind != "POI1" for row in rows
    ]  # fmt: skip
    assert len(found) == len(wanted)
    for (points, face, edge, width, rank, light), (places, ink, kind) in zip(
        found, wanted, strict=True
    ):
        middle = places.mean(axis=0)
        exact = places if shrink is None else middle + shrink * (places - middle)
        np.testing.assert_allclose(points, exact)
        if kind == "SEG2":
            assert (face, width, rank) == (None, 1.8, 2)
            np.testing.assert_allclose(edge[:3], ink)
            continue
        assert (rank, light) == (1, "shaded" if filled else "")
        assert 0.15 <= width <= 0.8
        if filled:
            base = np.array([0.72, 0.76, 0.81]) if kind == "QUA4" else 0.25 + 0.75 * ink
            np.testing.assert_allclose(edge[:3], 0.45 * base if filled == "FACE" else 1.0)
        else:
            base = 0.9 + 0.1 * ink
            np.testing.assert_allclose(edge[:3], ink)
        np.testing.assert_allclose(face[:3], base)


def test_outlines_colours_and_edges_of_a_layer(mesh):
    blue = np.array(to_rgb(shade("BLEU")))
    for face, edge in (p[1:3] for p in drawn(mesh, colour=index_of("BLEU"))):
        np.testing.assert_allclose(edge[:3], blue)
        assert face is None or np.allclose(face[:3], 0.9 + 0.1 * blue)
    assert [(p[1], p[3], p[4]) for p in drawn(mesh, outline=True)] == (
        [(None, 1.1, 2)] * 2 + [(None, 0.8, 2)] * 4
    )
    assert {p[3] for p in drawn(mesh, edges=False)} == {1.8, 0.0}


def test_points_are_dots_in_their_colour_or_that_of_their_value(mesh):
    recorder = Recorder()
    add_points(recorder, visible_faces(mesh), Layer(mesh), None)
    assert [p for p, _ in recorder.dots] == [[4.0, 0.75], [0.0, 0.0]]
    np.testing.assert_allclose([ink[:3] for _, ink in recorder.dots], [to_rgb(shade("ROUG"))] * 2)
    levels = choose_levels(np.array([-2.0, 3.0]), count=5)
    recorder = Recorder()
    add_points(recorder, visible_faces(mesh), Layer(mesh, field=field(mesh), component="T"), levels)
    np.testing.assert_allclose(recorder.dots[0][1], levels.rgba(np.array([2.5]))[0])


def size(polygon: np.ndarray) -> float:
    x, y = polygon.T
    return 0.5 * abs(float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)))


@pytest.mark.parametrize("iso", ["SURFACE", "LIGNE", "SULI"])
def test_bands_lie_where_the_field_has_their_values(mesh, iso):
    layer = Layer(mesh, field=field(mesh), component="T")
    faces = visible_faces(mesh)
    values = band_values([(layer, faces)])
    assert values is not None
    levels = choose_levels(values, count=6)
    recorder = Recorder()
    add_bands(recorder, faces, layer, levels, PictureOptions(iso=iso), 5.0)
    grey = [
        p
        for p in recorder.polygons
        if p[1] is not None and np.allclose(p[1], [0.93, 0.94, 0.95, 1])
    ]
    wanted = [[[1.0, 1.25], [0.0, 0.0]], [[0.0, 0.0], [2.0, 0.5], [1.0, 0.5]]]
    assert [p[0].tolist() for p in grey] == wanted
    bands = [
        p for p in recorder.polygons if p[1] is not None and len(p[0]) > 2 and p[5] == "tinted"
    ]
    lines = [p for p in recorder.polygons if p[1] is None and len(p[0]) == 2 and p[3] == 1.0]
    assert bool(bands) == (iso != "LIGNE")
    assert bool(lines) == (iso != "SURFACE")
    middles = (levels.bounds[1:] + levels.bounds[:-1]) / 2
    inks = levels.rgba(middles)
    for points, ink, *_ in bands:
        row = int(np.argmin(np.abs(inks - ink).sum(axis=1)))
        assert np.all(linear(points) >= levels.bounds[row] - 1e-12)
        assert np.all(linear(points) <= levels.bounds[row + 1] + 1e-12)
    if bands:
        known = 0.625 + sum(size(np.array([PLACES[i] for i in t])) for t in CELLS["TRI3"][0][:2])
        assert sum(size(p[0]) for p in bands) == pytest.approx(known, rel=1e-12)
    for points, _, ink, *_ in lines:
        level = linear(points)
        assert level[0] == pytest.approx(level[1], abs=1e-12)
        row = int(np.argmin(np.abs(levels.bounds - level[0])))
        assert levels.bounds[row] == pytest.approx(level[0], abs=1e-12)
        ruled = (0, 0, 0, 0.8) if iso == "SULI" else levels.rgba(levels.bounds)[row]
        np.testing.assert_allclose(ink, ruled)
    bar = [p for p in recorder.polygons if p[3] == 3.2]
    assert len(bar) == 8  # pieces of the one segment whose nodes both have a value
    for points, _, ink, *_ in bar:
        np.testing.assert_allclose(ink, levels.rgba(linear(points).mean(keepdims=True))[0])
    rims = [
        p
        for p in recorder.polygons
        if p[4] == 1 and p[3] < 1.0 and p[2] is not None and p[2][3] == 0.55
    ]
    assert len(rims) == 3


@together("iso", ["", "SURFACE", "LIGNE", "SULI"])
def test_what_a_plane_cuts_has_the_colours_of_cells_or_of_values(iso):
    """Two bricks of 2 and 1 beside a wall, cut at a quarter; one corner has no value."""
    table = NodeTable()
    xs, levels = (0, 2, 3), choose_levels(np.array([-4.0, 3.0]), count=7)
    table.add(np.array([(x, y, z) for x in xs for y in (0, 1) for z in (0, 1)], float))
    table.add(np.array([(x, 2, z) for x in xs for z in (0, 1)], float))
    first = np.array([0, 4, 6, 2, 1, 5, 7, 3])
    cells = [("CUB8", first, "ROUG"), ("CUB8", first + 4, "DEFA"),
             ("QUA4", [12, 14, 15, 13], "VERT"), ("TRI3", [14, 16, 17], "DEFA")]  # fmt: skip
    blocks = [CellBlock.make(table, k, np.array([n]), index_of(c)) for k, n, c in cells]
    known = np.array([i for i in range(18) if i != 11])
    given = NodeField.of(table, known, {"T": linear(table.coordinates[known])})
    layer = Layer(Mesh(table, tuple(blocks)), field=given if iso else None, component="T")
    plane = Plane.through(*np.array([(5, 1, 0.25), (0, 0, 0.25), (0, 3, 0.25)]))
    recorder = Recorder()
    add_section(recorder, layer, plane, levels if iso else None, PictureOptions(iso=iso))
    faces = [p for p in recorder.polygons if len(p[0]) > 2]
    cut = [p for p in recorder.polygons if p[3] > 1.0]
    ends = sorted([sorted(p[0].tolist()) for p in cut])
    assert ends == [[[0, 2], [2, 2]], [[2.25, 2], [3, 2]]]
    if not iso:
        inks = {c: 0.25 + 0.75 * np.array(to_rgb(shade(c))) for c in ("ROUG", "VERT")}
        inks["DEFA"] = 0.25 + 0.75 * np.array([0.72, 0.76, 0.81])
        for of, rows in (
            ("ROUG", faces[:2]),
            ("DEFA", faces[2:]),
            ("VERT", cut[:1]),
            ("DEFA", cut[1:]),
        ):
            for p in rows:
                np.testing.assert_allclose([p[1], p[2]], [[*inks[of], 1.0]] * 2)
        assert [sum(size(p[0]) for p in rows) for rows in (faces[:2], faces[2:])] == [2.0, 1.0]
        assert {p[3:] for p in faces} | {p[3:] for p in cut} == {(0.35, 0, ""), (1.8, 0, "")}
        return
    for p in cut:
        assert p[3:] == (3.2, 3, "")
        np.testing.assert_allclose(p[2], levels.rgba(linear(p[0]).mean(keepdims=True))[0])
    assert sum(size(p[0]) for p in faces) == pytest.approx(0.0 if iso == "LIGNE" else 2.0)
    middles = (levels.bounds[1:] + levels.bounds[:-1]) / 2
    for points, ink, *_, light in faces:
        row = int(np.argmin(np.abs(levels.rgba(middles) - ink).sum(axis=1)))
        assert levels.bounds[row] - 1e-6 <= linear(points).min()
        assert linear(points).max() <= levels.bounds[row + 1] + 1e-6
        assert not light
    lines = [p for p in recorder.polygons if p[3] == 1.0]
    assert bool(lines) == (iso != "SURFACE")


@pytest.mark.parametrize("support", ["NOEUD", "GRAVITE", "RIGIDITE", "MASSE"])
def test_values_in_cells_come_to_their_nodes(mesh, support):
    """A linear field is kept; a node has the mean of its cells; other cells have none."""
    parts = []
    for block in mesh.blocks[2:]:
        kind = block.kind.name
        nodes = block.coordinates
        if support == "NOEUD":
            places = nodes
        else:
            x, y = support_rule(kind, support).points.T
            shape = np.array(
                [1.0 - x - y, x, y] if kind == "TRI3" else
                [(1 + a * x) * (1 + b * y) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            ).T  # fmt: skip
            places = np.einsum("pk,nkd->npd", shape, nodes)
        parts.append(CellFieldBlock(block, {"S": linear(places)}, support, kind))
    found = CellField(tuple(parts), "")
    means: dict[int, list[float]] = {}
    for faces in all_faces(mesh):
        values = values_on(faces, found, "S")
        exact = linear(mesh.nodes.coordinates[faces.nodes])
        if faces.block.kind.dimension < 2:
            assert np.isnan(values).all()
            continue
        if support != "NOEUD" and len(support_rule(faces.kind, support).points) == 1:
            exact = np.broadcast_to(exact.mean(axis=1, keepdims=True), exact.shape)
        np.testing.assert_allclose(values, exact, atol=1e-12)
        for nodes, row in zip(faces.nodes, values, strict=True):
            for node, value in zip(nodes.tolist(), row.tolist(), strict=True):
                means.setdefault(node, []).append(value)
    nodal = nodal_means(all_faces(mesh), found, "S", 8)
    for node in range(8):
        if node in means:
            assert nodal[node] == pytest.approx(np.mean(means[node]))
        else:
            assert np.isnan(nodal[node])


@together("kind", ["TRI3", "QUA4", "POL5", "PO12"])
def test_pieces_of_a_face_cover_it_once(kind):
    """Areas of the pieces of an affine image: the sum is the face's, none is turned."""
    sides = {"TRI3": 3, "QUA4": 4, "POL5": 5, "PO12": 12}[kind]
    angle = 2.0 * np.pi * np.arange(sides) / sides
    corners = np.stack([2.0 * np.cos(angle) + np.sin(angle), 3.0 * np.sin(angle)], axis=1)
    shape, parts = pieces(kind, 3)
    assert shape.shape[1] == sides
    a, b, c = np.moveaxis((shape @ corners)[parts], 1, 0)
    areas = 0.5 * np.linalg.det(np.stack([b - a, c - a], axis=-1))
    assert areas.min() > 0.0
    assert areas.sum() == pytest.approx(6.0 * 0.5 * sides * np.sin(2.0 * np.pi / sides))
