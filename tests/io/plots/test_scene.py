"""Pictures of meshes and fields, looked at pixel by pixel."""

import io
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from PIL import Image
from together import together

from ssilang.io.errors import OutputError
from ssilang.io.plots.annotations import Labels
from ssilang.io.plots.bands import choose_levels
from ssilang.io.plots.composition import Subjects, compose
from ssilang.io.plots.cutting import behind, section_of
from ssilang.io.plots.labels import Annotation, Category
from ssilang.io.plots.layers import Layer, PictureOptions
from ssilang.io.plots.palette import index_of, shade
from ssilang.io.plots.patches import visible_faces
from ssilang.io.plots.scene import draw_scene, sheet_bounds
from ssilang.io.plots.values import VON_MISES, component_names, values_on
from ssilang.io.plots.view import Plane, plane_view, view_along
from ssilang.kernel.fields import deformed
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.deformed import Deformed, DeformedPart
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from tests.windows import needs_window


def grid(n: int = 4, size: float = 1.0) -> Mesh:
    table = NodeTable()
    line = np.linspace(0.0, size, n + 1)
    x, y = np.meshgrid(line, line, indexing="xy")
    ids = table.add(np.column_stack([x.ravel(), y.ravel()])).reshape(n + 1, n + 1)
    corners = (ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1])
    return Mesh.of(table, "QUA4", np.stack([c.ravel() for c in corners], axis=1))


def cube(n: int = 2) -> Mesh:
    table = NodeTable()
    line = np.linspace(0.0, 1.0, n + 1)
    xyz = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    ids = table.add(xyz).reshape(n + 1, n + 1, n + 1)
    a, b = slice(None, -1), slice(1, None)
    order = [(a, a, a), (b, a, a), (b, b, a), (a, b, a), (a, a, b), (b, a, b), (b, b, b), (a, b, b)]
    return Mesh.of(table, "CUB8", np.stack([ids[k].ravel() for k in order], axis=1))


def field(mesh: Mesh, **functions: Any) -> NodeField:
    ids = mesh.sorted_node_ids
    x = mesh.nodes.coordinates[ids]
    return NodeField.of(mesh.nodes, ids, {k: f(x) for k, f in functions.items()})


def pixels(figure: Any) -> np.ndarray:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=60)
    return np.asarray(Image.open(buffer).convert("RGB"), dtype=float) / 255


def share(image: np.ndarray, colour: Any, tolerance: float = 0.06) -> float:
    return float((np.abs(image - np.array(to_rgb(colour))).max(axis=-1) < tolerance).mean())


def drawn(*layers: Layer, **options: Any) -> np.ndarray:
    return pixels(draw_scene(layers, (), PictureOptions(**options)))


def polygons(figure: Any) -> dict[tuple[float, ...], list[np.ndarray]]:
    """Polygons drawn in a plane figure, by face colour."""
    (painted,) = figure.axes[0].collections
    return {
        tuple(face): path.to_polygons()
        for path, face in zip(painted.get_paths(), painted.get_facecolor(), strict=True)
    }


def area(polygon: np.ndarray) -> float:
    x, y = polygon.T
    return 0.5 * abs(float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)))


def test_a_filled_mesh_shows_its_colour():
    red = Layer(grid(), colour=index_of("ROUG"))
    ink = 0.25 + 0.75 * np.array(to_rgb(shade("ROUG")))
    assert share(drawn(red, filled="FACE"), ink) > 0.2
    assert share(drawn(red), ink) < 0.05


def test_only_one_colour_is_drawn():
    mesh = grid(2)
    mesh.blocks[0].colours[:] = [2, 2, 1, 1]
    every = draw_scene((Layer(mesh),))
    some = draw_scene((Layer(mesh),), (), PictureOptions(only_colour=2))
    assert [sum(map(len, polygons(f).values())) for f in (every, some)] == [4, 2]


def test_bands_of_a_linear_field_have_equal_areas():
    mesh = grid(8)
    layer = Layer(mesh, field=field(mesh, T=lambda x: x[:, 0]), component="T", edges=False)
    figure = draw_scene((layer,), (), PictureOptions(level_count=4))
    bar = figure.axes[-1]
    assert bar.get_ylabel().startswith("T ")
    assert "max 1" in bar.get_ylabel()
    areas = [sum(map(area, found)) for found in polygons(figure).values()]
    assert len(areas) == 4
    assert np.allclose(areas, 0.25)


def test_cells_without_a_value_are_grey():
    mesh = grid(2)
    half = mesh.sorted_node_ids[:6]
    values = NodeField.of(mesh.nodes, half, {"T": np.arange(6.0)})
    image = drawn(Layer(mesh, field=values, component="T"))
    assert share(image, (0.93, 0.94, 0.95)) > 0.1


def test_no_legend_on_demand():
    mesh = grid(2)
    layer = Layer(mesh, field=field(mesh, T=lambda x: x[:, 0]), component="T")
    assert len(draw_scene((layer,), (), PictureOptions(legend=False)).axes) == 1


def test_numbers_of_nodes_and_cells():
    mesh = grid(2)
    mesh.nodes.coordinates[mesh.nodes.coordinates[:, 0] == 1.0, 0] = 4.0
    named = ("low", Mesh.of(mesh.nodes, "SEG2", np.array([[0, 1], [1, 2]])))
    options = PictureOptions(node_numbers=True, cell_numbers=True, labels=(named,))
    texts = draw_scene((Layer(mesh),), (), options).axes[0].texts
    found = sorted((*np.round(t.get_position(), 9).tolist(), t.get_text()) for t in texts)
    xs = (0, 0.5, 4)
    wanted = [(xs[i], j / 2, str(3 * j + i + 1)) for j in range(3) for i in range(3)]
    wanted += [((0.25, 2.25)[i], j / 2 + 0.25, str(2 * j + i + 1)) for j in (0, 1) for i in (0, 1)]
    assert found == sorted([*wanted, (1.5, 0, "low")])


def test_deformed_shape_stands_before_its_initial_outline():
    mesh = grid(2)
    u = field(mesh, UX=lambda x: 0.01 * x[:, 1])
    made = compose(Subjects(deformed=Deformed((DeformedPart(mesh, u, 50.0),))))
    outline, moved = made.layers
    assert outline.outline
    assert {b.cell_type for b in outline.mesh.blocks} == {"SEG2"}
    assert moved.positions()[:, 0].max() == pytest.approx(1.5)
    assert made.notes == ("amplification 50",)


def test_an_undrawn_scale_is_chosen_and_shared():
    mesh = grid(2)
    small, large = (field(mesh, UX=lambda x, a=a: a * x[:, 1]) for a in (1e-4, 1e-3))
    parts = (DeformedPart(mesh, small), DeformedPart(mesh, large))
    made = compose(Subjects(deformed=Deformed(parts)))
    assert {x.scale for x in made.layers if not x.outline} == {100.0}


def test_components_have_a_panel_each():
    mesh = grid(2)
    u = field(mesh, UX=lambda x: x[:, 1], UY=lambda x: x[:, 0])
    made = compose(Subjects([mesh], values=u))
    figure = draw_scene(made.layers, (), None, None, made.components)
    titles = [a.get_title() for a in figure.axes]
    assert titles[:2] == ["UX", "UY"]
    options = PictureOptions(date=True, notes=("of",))
    views = (plane_view(),) * 3
    figure = draw_scene(made.layers, views, options, None, ("UX",))
    assert [a.axison for a in figure.axes[:4]] == [True, True, True, False]
    assert re.fullmatch(r"of   \d{4}(-\d\d){2} \d\d:\d\d", figure.get_supxlabel())


def test_a_field_that_is_not_a_number_is_still_drawn():
    mesh = grid(2)
    lost = field(mesh, UX=lambda x: np.where(x[:, 1] > 0.6, np.nan, x[:, 1]))
    layer = Layer(mesh, lost, 1.0, field=lost, component="UX")
    assert np.isfinite(draw_scene((layer,)).axes[0].get_xlim()).all()
    nothing = field(mesh, UX=lambda x: np.nan * x[:, 1])
    assert share(drawn(Layer(mesh, field=nothing, component="UX")), (0.93, 0.94, 0.95)) > 0.1


def ends(figure: Any) -> dict[str, list[float]]:
    return {m.get_gid(): list(m.get_xydata()[0]) for m in figure.axes[0].lines if m.get_gid()}


def test_extremes_are_marked_where_they_are():
    mesh = grid(4)
    hill = field(mesh, T=lambda x: x[:, 0] + 2 * x[:, 1])
    made = draw_scene((Layer(mesh, field=hill, component="T"),))
    assert ends(made) == {"min": [0.0, 0.0], "max": [1.0, 1.0]}
    assert "max 3" in made.axes[-1].get_ylabel()
    # one value at many nodes has no place
    slope = field(mesh, T=lambda x: np.maximum(x[:, 0], 0.8) + 1e-3 * x[:, 1])
    assert set(ends(draw_scene((Layer(mesh, field=slope, component="T"),)))) == {"max"}
    options = PictureOptions(legend=False)
    assert not ends(draw_scene((Layer(mesh, field=hill, component="T"),), (), options))


def test_the_bar_says_component_and_unit():
    mesh = grid(2)
    layer = Layer(mesh, field=field(mesh, FX=lambda x: x[:, 0]), component="FX")

    def label(**options: Any) -> str:
        return draw_scene((layer,), (), PictureOptions(**options)).axes[-1].get_ylabel()

    assert label(unit_of={"FX": "kN"}.get).startswith("FX (kN) ")
    assert label(unit_of=lambda name: "").startswith("FX ")
    assert label(legend_name="force", unit_of={"FX": "kN"}.get).startswith("force ")


def test_colours_of_several_shapes_are_named():
    mesh = grid(2)
    u = field(mesh, UX=lambda x: 0.01 * x[:, 1])
    parts = DeformedPart(mesh, u, 0.0, 1), DeformedPart(mesh, u, 50.0, 2)
    made = compose(Subjects(deformed=Deformed(parts)))
    named = [(c.colour, c.text) for c in made.legend.categories]
    assert named == [(1, "amplification 0"), (2, "amplification 50")]
    assert made.notes == ()
    twice = DeformedPart(mesh, u, 10.0, 2)  # one colour for two amplifications says nothing
    assert not compose(Subjects(deformed=Deformed((*parts, twice)))).legend.categories


def test_the_legend_of_colours_leaves_room_for_all_that_is_written():
    mesh = grid(4)
    told = Annotation((Category(1, "amplification 0"), Category(2, "amplification 600")))
    figure = draw_scene((Layer(mesh),), (), PictureOptions(annotation=told))
    (legend,) = figure.legends
    assert [t.get_text() for t in legend.get_texts()] == ["amplification 0", "amplification 600"]
    figure.draw_without_rendering()
    (axes,) = figure.axes
    low, high = axes.get_ylim()
    marks = [m for m in axes.get_yticklabels() if low <= m.get_position()[1] <= high]
    assert len(marks) > 3
    assert min(m.get_window_extent().x0 for m in marks) >= 0
    boxes = axes.get_window_extent(), legend.get_window_extent()
    assert boxes[0].x1 < boxes[1].x0 < boxes[1].x1 <= figure.bbox.x1


def test_multipliers_have_no_panel():
    mesh = grid(2)
    u = field(mesh, UX=lambda x: x[:, 1])
    away = mesh.nodes.add(np.zeros((1, 2)))
    both = NodeField(mesh.nodes, {**u.components, "LX": NodeValues(away, np.ones(1))})
    made = compose(Subjects([mesh], values=both))
    assert made.components == ()
    assert made.layers[0].component == "UX"


def test_arrows_lie_within_the_frame():
    mesh = grid(2)
    arrows = deformed.arrows_at_nodes(
        field(mesh, FX=lambda x: 1.0 + 0 * x[:, 0]), ("FX", "FY", ""), 0.5
    )
    figure = draw_scene((Layer(mesh),), (), None, arrows)
    (quiver,) = [c for c in figure.axes[0].collections if hasattr(c, "U")]
    assert np.allclose(quiver.U, 0.5)
    assert figure.axes[0].get_xlim()[1] > 1.5


def test_nothing_to_draw_is_said():
    with pytest.raises(OutputError, match="nothing to draw"):
        draw_scene((Layer(Mesh(NodeTable(), ())),))


@needs_window
def test_hidden_faces_are_not_seen():
    # a red square above a blue one, seen from above and from below
    table = NodeTable()
    square = np.array([(0.0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    low, high = table.add(square), table.add(square + np.array([0, 0, 1.0]))
    mesh = Mesh.of(table, "QUA4", np.stack([high, low]), np.array([2, 1], dtype=np.int8))
    options = PictureOptions(filled="FACE", hidden=True)

    def redness(z: float) -> float:
        view = view_along(np.array([0.0, 1e-6, z]))
        image = pixels(draw_scene((Layer(mesh),), (view,), options))
        return float((image[..., 0] > image[..., 2] + 0.2).mean())

    assert redness(1.0) > 0.2
    assert redness(-1.0) < 0.001


def test_outer_faces_of_a_volume():
    assert sum(len(f.nodes) for f in visible_faces(cube(3))) == 6 * 9


@needs_window
def test_behind_a_plane():
    mesh = cube(2)
    plane = Plane.through(*np.array([(0.0, 0.5, 0), (1, 0.5, 0), (0, 0.5, 1)]))
    view = view_along(np.array([0.0, -1.0, 0.2]))
    left = behind(mesh, plane, view, mesh.nodes.coordinates)
    # four cells are left: their outer faces
    assert sum(len(f.nodes) for f in visible_faces(left)) == 16
    lower = [
        pixels(draw_scene((Layer(mesh, colour=2),), (view,), PictureOptions(**options)))
        for options in ({"filled": "FACE"}, {"filled": "FACE", "beyond": plane})
    ]
    assert 0 < (lower[1] < 0.9).any(axis=2).mean() < (lower[0] < 0.9).any(axis=2).mean()


def test_section_of_a_cube_has_the_area_and_values_of_the_plane():
    mesh = cube(3)
    plane = Plane.through(*np.array([(0.0, 0, 0), (1, 0, 1), (0, 1, 0)]))  # z = x
    values = mesh.nodes.coordinates @ np.array([1.0, 2.0, 3.0])
    points, found, colours = section_of(mesh, plane, mesh.nodes.coordinates, values)
    crossed = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    assert 0.5 * np.linalg.norm(crossed, axis=1).sum() == pytest.approx(np.sqrt(2.0))
    assert np.allclose(found, points @ np.array([1.0, 2.0, 3.0]))
    assert set(colours) == {0}


def test_section_of_surfaces_is_a_line_that_leaves_joints_out():
    table = NodeTable()
    ids = table.add(np.array([(x, y, 0.0) for y in (0, 1, 3) for x in (0, 2, 5)]))
    above = table.add(np.array([(0, 0, 0.5), (2, 0, 0.5), (2, 1, 0.5), (0, 1, 0.5)]))
    ids = np.concatenate([ids, above])
    cells = {"LIA4": [[0, 1, 4, 3, 9, 10, 11, 12]], "TRI3": [[1, 2, 5], [3, 4, 7]],
             "QUA4": [[0, 1, 4, 3], [4, 5, 8, 7]]}  # fmt: skip
    parts = [Mesh.of(table, kind, ids[rows]) for kind, rows in cells.items()]
    blocks = [
        replace(b, colours=np.full(len(b), k, np.int8))
        for k, p in enumerate(parts)
        for b in p.blocks
    ]
    mesh = Mesh(table, tuple(blocks))
    plane = Plane.through(*np.array([(1.5, 0, 0), (1.5, 3, 0), (1.5, 0, 1)]))
    values = table.coordinates @ np.array([1.0, 2.0, 0.0])
    points, found, colours = section_of(mesh, plane, table.coordinates, values, 2)
    assert np.allclose(found, points @ np.array([1.0, 2.0, 0.0]))
    ends = {c: np.sort(points[colours == c, :, 1]).round(9).tolist() for c in set(colours)}
    assert ends == {1: [[1.0, 2.5]], 2: [[0.0, 1.0]]}  # the joint's colour is 0


def test_a_plane_needs_three_points_off_a_line():
    with pytest.raises(OutputError, match="on a line"):
        Plane.through(np.zeros(3), np.ones(3), 2 * np.ones(3))


def stresses(mesh: Mesh, **values: float) -> CellField:
    n = mesh.n_cells
    parts = {k: np.full((n, 4), v) for k, v in values.items()}
    return CellField((CellFieldBlock(mesh.blocks[0], parts, "STRESSES", "QUA4"),), "CONTRAINTES")


def test_von_mises_of_a_uniform_stress():
    mesh = grid(1)
    stress = stresses(mesh, SMXX=3.0, SMYY=-1.0, SMZZ=0.0, SMXY=2.0)
    assert component_names(stress)[0] == VON_MISES
    (faces,) = visible_faces(mesh)
    exact = np.sqrt(3.0**2 + 1.0 + 3.0 + 3 * 2.0**2)
    assert np.allclose(values_on(faces, stress, VON_MISES), exact)


@together("mesh, kind", [(grid(1), "QUA4"), (cube(1), "CUB8")])
def test_values_at_integration_points_are_extended_to_the_nodes(mesh, kind):
    """Linear values and the products of their axes are kept."""
    from ssilang.kernel.elements.catalog import ELEMENTS, support_rule

    def values(x: np.ndarray) -> np.ndarray:
        products = x[:, 0] * (7 * x[:, -1] - 3 * x[:, 1]) + 4 * x.prod(axis=1)
        return 1 + 2 * x[:, 0] + 5 * x[:, -1] + products

    given = values(support_rule(kind, "STRESSES").points)[None]
    field = CellField((CellFieldBlock(mesh.blocks[0], {"T": given}, "STRESSES", kind),))
    exact = values(ELEMENTS[kind].reference_cell.nodes)
    for faces in visible_faces(mesh):
        assert np.allclose(values_on(faces, field, "T")[0], exact[faces.local])


def test_values_along_a_joint_are_the_same_on_both_sides():
    from ssilang.kernel.elements.catalog import support_rule

    table = NodeTable()
    ids = table.add(np.array([(x, y) for y in (0.0, 0.5) for x in (-1.0, 1.0)]))
    joint = Mesh.of(table, "RAC2", ids[None, :])
    (xi,) = support_rule("JOI2", "MASSE").points.T
    given = CellFieldBlock(joint.blocks[0], {"T": (3 + 2 * xi)[None]}, "MASSE", "JOI2")
    assert len(xi) > 1
    sides = visible_faces(joint)
    assert {n for faces in sides for n in faces.nodes.ravel().tolist()} == {*ids.tolist()}
    for faces in sides:
        found = values_on(faces, CellField((given,)), "T")
        assert np.allclose(found, 3 + 2 * table.coordinates[faces.nodes, 0])


def test_principal_strokes_of_a_shear():
    arrows = deformed.principal_strokes(stresses(grid(1), SMXX=0.0, SMYY=0.0, SMZZ=0.0, SMXY=5.0))
    large = {p.name: p.vectors[0] for p in arrows.parts}
    assert np.allclose(np.abs(large["SI11"]), 5.0 / np.sqrt(2) * np.array([1, 1, 0]))
    assert large["SI11"] @ large["SI33"] == pytest.approx(0.0)


def test_a_closed_joint_shows_its_values_along_its_lines():
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0), (1, 0), (0, 0), (1, 0)]))
    joint = Mesh.of(table, "RAC2", ids[None, :])
    values = {"SMN": np.array([[-3.0]])}
    traction = CellField((CellFieldBlock(joint.blocks[0], values, "STRESSES", "JOI2"),))
    layer = Layer(joint, field=traction, component="SMN")
    figure = draw_scene((layer,), (), PictureOptions(levels=np.array([-4.0, -2.0, 0.0])))
    low = figure.axes[0].collections[0].get_edgecolor()
    wide = figure.axes[0].collections[0].get_linewidths()
    expected = choose_levels(np.array([-3.0]), None, np.array([-4.0, -2.0, 0.0]))
    shown = np.isclose(low, expected.rgba(np.array([-3.0]))).all(axis=1)
    assert max(w for w, s in zip(wide, shown, strict=True) if s) > 3


@together("how", ["bounds", "frame", "own"])
def test_the_sheet_shows_what_is_asked_for(how):
    """Bounds as they are; what is framed, or all that is drawn, with a twentieth around it."""
    small, large = grid(2, 2.0), grid(3, 4.0)
    given = np.array([[-1.0, 2.0], [7.0, 5.0]])
    options = {"bounds": {"bounds": given, "frame": small}, "frame": {"frame": small}}.get(how, {})
    found = sheet_bounds(
        [Layer(small), Layer(large)], None, plane_view(), PictureOptions(**options)
    )
    size = {"frame": 2.0, "own": 4.0}.get(how, 0.0)
    wanted = given if how == "bounds" else [[-0.05 * size] * 2, [1.05 * size] * 2]
    np.testing.assert_allclose(found, wanted)


def test_labels_that_are_seen_are_written_where_they_stand_up_to_so_many(
    monkeypatch,
):
    monkeypatch.setattr("ssilang.io.plots.annotations._MOST_LABELS", 2)
    places, view = np.arange(15.0).reshape(5, 3), view_along(np.array([0.0, 0.0, 1.0]))
    made, written = Labels(view), []
    made.add(places, list("abcde"), "red", 5)
    axes = SimpleNamespace(text=lambda x, y, t, **how: written.append((x, y, t, how["fontsize"])))
    photograph = SimpleNamespace(shows=lambda flat, depth, bounds: np.array([0, 1, 0, 1, 1], bool))
    flat = view.project(places)
    for seen, rows in ((None, (0, 1)), (photograph, (1, 3))):
        written.clear()
        made.write(axes, seen, np.zeros((2, 2)))
        assert written == [(*flat[i], "abcde"[i], 5) for i in rows]
