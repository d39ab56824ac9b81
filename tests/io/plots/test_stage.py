"""Scenes in space: what hides what, light, arrows, labels, cuts, and systems that cannot draw."""

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from script_runs import ran

from ssilang.cli.run import run_text
from ssilang.io.errors import NoGraphicsError
from ssilang.io.plots import stage as stages
from ssilang.io.plots.figure import drawing, figure_bytes
from ssilang.io.plots.layers import Layer, PictureOptions
from ssilang.io.plots.painter import Painter
from ssilang.io.plots.palette import index_of, shade
from ssilang.io.plots.scene import draw_scene
from ssilang.io.plots.stage import Photograph, Stage
from ssilang.io.plots.view import View, view_along
from ssilang.kernel.fields.deformed import arrows_at_nodes
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.language.say.diagnostics import render
from tests.windows import can_draw, needs_window

_CORNER = view_along(np.array([1.0, -1.2, 0.8]))  # three faces of a cube
_LINES = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=float)


@pytest.fixture(scope="module")
def stage() -> Iterator[Stage]:
    if not can_draw():
        pytest.skip("no EGL and no OSMesa")
    made = Stage()
    yield made
    made.close()


def cube() -> Mesh:
    table = NodeTable()
    ids = table.add(np.vstack([_LINES, _LINES + np.array([0, 0, 1.0])]))
    return Mesh.of(table, "CUB8", ids[None, :])


def photograph(stage: Stage, view: View, *polygons: Any) -> Photograph:
    """The sheet from -1 to 2 both ways in 300 pixels; polygons are (points, face, edge, width)."""
    painter = Painter(view)
    for points, face, edge, width, light in polygons:
        painter.add(np.asarray(points, dtype=float), face, edge, width, 1, light)
    with drawing(2, 2) as figure:
        axes = figure.add_axes((0, 0, 1, 1))
        return painter.photograph(axes, stage, np.array([[-1.0, -1], [2, 2]]), True)


def shown(figure: Any) -> np.ndarray:
    (image,) = figure.axes[0].images
    return np.asarray(image.get_array())


def inks(image: np.ndarray, least: float = 0.01) -> list[tuple[int, ...]]:
    """Colours that fill more than a share of an image, white left out."""
    found, count = np.unique(image.reshape(-1, 3), axis=0, return_counts=True)
    many = found[count > least * count.sum()]
    return [tuple(map(int, c)) for c in many if c.min() < 255]


def texts(figure: Any) -> set[str]:
    return {t.get_text() for t in figure.axes[0].texts}


def test_the_nearer_of_two_squares_is_seen_and_where_it_is(stage):
    red, blue = (1.0, 0, 0, 1), (0.0, 0, 1, 1)
    low, high = _LINES[None], 0.5 * _LINES[None] + (0.25, 0.25, 1)
    above = photograph(stage, view_along(np.array([0.0, 0, 1])), (high, red, red, 0, ""),
                       (low, blue, blue, 0, ""))  # fmt: skip
    image = above.image
    rows, columns, _ = image.shape
    # the small square covers a quarter of the large one, and that a ninth of the sheet
    parts = [(image == np.array(c)).all(axis=2).mean() for c in ((255, 0, 0), (0, 0, 255))]
    assert parts == pytest.approx([1 / 36, 1 / 12], abs=2e-3)
    painted = np.argwhere((image < 255).any(axis=2))
    assert painted.min(axis=0) == pytest.approx([rows / 3, columns / 3], abs=1)
    assert painted.max(axis=0) == pytest.approx([2 * rows / 3, 2 * columns / 3], abs=1)
    below = photograph(stage, view_along(np.array([0.0, 0, -1])), (high, red, red, 0, ""))
    assert inks(below.image) == [(255, 0, 0)]
    bounds = np.array([[-1.0, -1], [2, 2]])
    middle, near = np.array([[0.5, 0.5], [0.1, 0.1], [1.9, 1.9]]), np.array([0.0, 0, -5])
    assert list(above.shows(middle, near, bounds)) == [False, True, True]


def test_dots_and_arrows_in_space_stand_where_they_are_in_their_inks(stage):
    """A dot of 14.4 points is a tenth of the sheet of two inches, lit; a stroke has 1.8 points."""
    bounds, areas = np.array([[-1.0, -1], [2, 2]]), []
    for heads in (False, True):
        painter = Painter(view_along(np.array([0.0, 0, 1])))
        colours = [(0.0, 0.8, 0, 1), (0.0, 0, 0.8, 1)]
        painter.add_dots(np.array([(0.5, 0, 0), (1.25, -0.25, 1)]), colours, 14.4)
        start, step = np.array([[-0.5, 1, 0]]), np.array([[2.0, 0.5, 0]])
        painter.add_arrows(start, step, (0.8, 0, 0, 1), heads)
        with drawing(2, 2) as figure:
            axes = figure.add_axes((0, 0, 1, 1))
            image = painter.photograph(axes, stage, bounds, False).image[::-1]
        for part, middle, extent in (
            (0, (0.5, 1.25), (2.0, 0.5)), (1, (0.5, 0), (0.3, 0.3)), (2, (1.25, -0.25), (0.3, 0.3)),
        ):  # fmt: skip
            own = image[..., part] > np.delete(image, part, axis=2).max(axis=2) + 40.0
            areas.append(9.0 * own.mean())
            for found, at, size in zip(np.nonzero(own)[::-1], middle, extent, strict=True):
                place = 3.0 * found / len(image) - 1.0
                assert (place.min() + place.max()) / 2 == pytest.approx(at, abs=0.03)
                assert np.ptp(place) == pytest.approx(size, abs=0.06)
    assert areas[0] == pytest.approx(np.hypot(2.0, 0.5) * 3.0 * 1.8 / 144.0, rel=0.2)
    assert areas[3] > 1.3 * areas[0]


def test_a_stage_that_was_closed_opens_again_and_looks_for_depths_on_demand(stage):
    red, made = (1.0, 0, 0, 1), []
    for deep in (True, False):
        painter = Painter(view_along(np.array([0.0, 0, 1])))
        painter.add(_LINES[None] + (0, 0, 0.25), red, red, 0, 1, "")
        with drawing(2, 2) as figure:
            axes, bounds = figure.add_axes((0, 0, 1, 1)), np.array([[-1.0, -1], [2, 2]])
            made.append(painter.photograph(axes, stage, bounds, deep))
        stage.close()
    assert np.array_equal(made[0].image, made[1].image)
    assert (made[0].depth.shape, made[1].depth.shape) == (made[0].image.shape[:2], (1, 1))
    assert made[0].depth.min() < made[0].depth.max() == 1.0
    at_0, at_1 = made[0].reach
    assert at_0 + float(made[0].depth.min()) * (at_1 - at_0) == pytest.approx(0.25, abs=1e-4)


def test_the_faces_of_a_cube_have_a_shade_each(stage):
    layer = Layer(cube(), colour=index_of("ROUG"), edges=False)

    def found(filled: str) -> list[tuple[int, ...]]:
        options = PictureOptions(filled=filled)
        return inks(shown(draw_scene((layer,), (_CORNER,), options, stage=stage)))

    shaded = found("FACE")
    assert len(shaded) == 3
    assert found("FACB") == shaded
    full = np.array([round(255 * (0.25 + 0.75 * c)) for c in to_rgb(shade("ROUG"))])
    assert np.allclose(found("FSDB"), full, atol=1)
    for ink in shaded:  # darker, of the same hue
        ratio = np.array(ink) / full
        assert np.ptp(ratio) < 0.03
        assert 0.4 < ratio.mean() <= 1.0


def test_edges_of_the_back_are_hidden_on_demand(stage):
    """Of the twelve edges of a cube nine are seen, three behind it."""
    layer = Layer(cube(), colour=index_of("NOIR"))

    def darkness(**options: Any) -> float:
        image = shown(draw_scene((layer,), (_CORNER,), PictureOptions(**options), stage=stage))
        return float((255 - image.astype(float)).mean())

    assert darkness(hidden=True) / darkness() == pytest.approx(9 / 12, abs=0.05)


def test_numbers_of_hidden_nodes_are_not_written(stage):
    mesh = cube()
    options = {"node_numbers": True, "labels": (("P", mesh),)}
    seen = draw_scene((Layer(mesh),), (_CORNER,), PictureOptions(hidden=True, **options),
                      stage=stage)  # fmt: skip
    # the corner behind (0, 1, 0) is number 4; the middle of the cube bears its name
    assert texts(seen) == {"1", "2", "3", "5", "6", "7", "8"}
    whole = draw_scene((Layer(mesh),), (_CORNER,), PictureOptions(**options), stage=stage)
    assert texts(whole) == {*"12345678", "P"}


def test_arrows_behind_a_face_are_hidden(stage):
    mesh = cube()
    ids = mesh.sorted_node_ids
    force = NodeField.of(mesh.nodes, ids[:4], {"FZ": np.ones(4)})
    arrows = arrows_at_nodes(force, ("", "", "FZ"), 0.5, 2)

    def redness(**options: Any) -> float:
        made = draw_scene((Layer(mesh, colour=8),), (_CORNER,), PictureOptions(**options),
                          arrows, stage=stage)  # fmt: skip
        image = shown(made).astype(float)
        return float((image[..., 0] > image[..., 2] + 60).sum())

    # of the four arrows up from the corners of the bottom, that of the corner behind is lost
    assert 0 < redness(hidden=True) < 0.85 * redness()


def test_windows_of_others_stay_theirs(stage):
    """How a scene's window is chosen is gone when it stands: a program may open its own."""
    before = dict(os.environ)
    other = Stage()
    painted = photograph(other, _CORNER, (_LINES[None], (1.0, 0, 0, 1), (1.0, 0, 0, 1), 0, ""))
    other.close()
    assert inks(painted.image)
    assert dict(os.environ) == before


def test_coordinates_far_from_the_origin_are_drawn_alike(stage):
    """As those of a map: a block of one metre at 10 000 km."""
    image = {}
    for away in (0.0, 1e7):
        table = NodeTable()
        ids = table.add(np.vstack([_LINES, _LINES + np.array([0, 0, 1.0])]) + away)
        layer = Layer(Mesh.of(table, "CUB8", ids[None, :]), colour=2)
        made = draw_scene((layer,), (_CORNER,), PictureOptions(filled="FACE"), stage=stage)
        image[away] = shown(made).astype(float)
    assert np.abs(image[0.0] - image[1e7]).mean() < 0.5


def test_bands_in_space_have_the_colours_of_the_bar_toned_by_light(stage):
    mesh = cube()
    ids = mesh.sorted_node_ids
    height = NodeField.of(mesh.nodes, ids, {"Z": mesh.nodes.coordinates[ids, 2]})
    layer = Layer(mesh, field=height, component="Z", edges=False)
    view = view_along(np.array([0.0, -1, 0]))
    made = draw_scene((layer,), (view,), PictureOptions(level_count=4), stage=stage)
    found = inks(shown(made))
    assert len(found) == 4
    assert made.axes[-1].get_ylabel().startswith("Z ")


def test_pictures_of_vectors_hold_the_scene_as_an_image(stage):
    made = draw_scene((Layer(cube()),), (_CORNER,), PictureOptions(title="A cube"), stage=stage)
    text = figure_bytes(made, "svg").decode()
    assert "data:image/png" in text
    assert ">A cube</text>" in text


SOLID = (
    "OPTI DIME 3 ELEM SEG2 MODE TRID ; L = DROI 2 (0. 0. 0.) (2. 0. 0.) ; OPTI ELEM QUA4 ; "
    "S = TRAN L 1 (0. 1. 0.) ; OPTI ELEM CUB8 ; V = S VOLU 'TRAN' 2 (0. 0. 1.) ; "
)


DIES = "import os; os.abort()"


@pytest.fixture
def unknown_system(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A system whose windows nobody has tried yet; the folder that remembers them."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "caches"))
    monkeypatch.delenv("VTK_DEFAULT_OPENGL_WINDOW", raising=False)
    stages._window_kind.cache_clear()
    yield tmp_path / "caches" / "ssilang" / "started"
    stages._window_kind.cache_clear()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere VTK chooses")
@pytest.mark.parametrize(
    ("there", "lives", "screen", "expected"),
    [
        ("libEGL libOSMesa libGL", "EGL OS X", ":9", "vtkEGLRenderWindow"),
        ("libOSMesa libGL", "EGL OS X", ":9", "vtkOSOpenGLRenderWindow"),
        ("libEGL libOSMesa libGL", "OS X", ":9", "vtkOSOpenGLRenderWindow"),
        ("libGL", "EGL OS X", ":9", "vtkXOpenGLRenderWindow"),
        ("libGL", "EGL OS X", "", None),
        ("libEGL libOSMesa libGL", "X", "", None),
        ("libEGL libGL", "OS", ":9", None),
        ("", "EGL OS X", ":9", None),
    ],
)
def test_the_first_window_that_draws_is_taken_and_remembered(
    there, lives, screen, expected, unknown_system,
    monkeypatch,
) :  # fmt: skip
    """Windows that die are tried in a process of their own; what has worked is not tried again."""
    monkeypatch.setattr(stages, "_library", lambda name: name.split(".")[0] in there.split())
    monkeypatch.setenv("DISPLAY", screen)
    alive = [f"vtk{kind}" for kind in lives.split()]
    probe = f"import os, sys\nsys.argv[1].startswith(tuple({alive!r})) or os.abort()"
    monkeypatch.setattr(stages, "_PROBE", probe)
    if expected is None:
        for _ in range(2):
            with pytest.raises(NoGraphicsError):
                stages._window_kind()
        assert not list(unknown_system.glob("graphics-*"))
        return
    assert stages._window_kind() == expected
    stages._window_kind.cache_clear()
    monkeypatch.setattr(stages, "_PROBE", DIES)
    assert stages._window_kind() == expected
    stages._window_kind.cache_clear()
    monkeypatch.setattr(stages, "_library", lambda name: "another driver")
    with pytest.raises(NoGraphicsError):
        stages._window_kind()


@pytest.mark.parametrize("missing", ["window", "library", "driver"])
def test_a_system_that_cannot_draw_keeps_the_run(missing, unknown_system, tmp_path, monkeypatch):
    if missing == "window":
        monkeypatch.setattr(stages, "_KINDS", {})
    elif missing == "driver":
        monkeypatch.setattr(stages, "_PROBE", DIES)
    else:  # as where a wheel finds no libXrender
        monkeypatch.setitem(sys.modules, "pyvista", None)
    said = ran(SOLID + "TRAC 'CACH' V ; A = 1 ;", tmp_path / "out")
    assert said.session.root.find("A") == 1
    (warning,) = said.session.warnings
    assert "the picture is left out" in render(warning, "en")
    assert "libegl1" in render(warning, "en")
    assert not list(tmp_path.glob("out/*"))


@needs_window
def test_edges_of_another_mesh_over_what_hides_them(tmp_path):
    """ARET: the box hides, edges of its cells (red) are not drawn but those of the other mesh."""
    from PIL import Image

    run_text(SOLID + "A = (ARET V) COUL 'VERT' ; TRAC 'ARET' (V COUL 'ROUG') A ;", tmp_path)
    (path,) = tmp_path.glob("*.png")
    image = np.asarray(Image.open(path).convert("RGB"), dtype=float)
    assert not (image[..., 0] > image[..., 1] + 60).any()
    assert (image[..., 1] > image[..., 0] + 60).any()
