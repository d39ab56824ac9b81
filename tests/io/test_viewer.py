"""ssilang view: what is drawn of results, meshes and pictures; what is refused; the window."""

import os
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import meshio
import numpy as np
import pytest
from PIL import Image, ImageSequence
from pyvista import Plotter
from script_runs import ran

from ssilang.cli.main import main
from ssilang.io.errors import InputError
from ssilang.io.viewer import Series, Wish, _common_range, chosen_file, draw
from ssilang.system import CAN_FORK
from tests.report.test_strangers_folder import grid_of
from tests.windows import needs_window

BEAM = (
    "OPTI DIME 3 ELEM SEG2 MODE TRID ; L = DROI 4 (0. 0. 0.) (4. 0. 0.) ; OPTI ELEM QUA4 ; "
    "S = TRAN L 2 (0. 1. 0.) ; OPTI ELEM CUB8 ; V = S VOLU 'TRAN' 1 (0. 0. 1.) ; X = COOR 1 V ; "
    "OPTI SORT 'beam' ; "
    "REPE BT 3 ; U = NOMC 'UZ' ((0.001 * (&BT - 1)) * X * X) ; "
    "SORT 'VTK ' V 'V' U '' X 'HEAT' FORM 'TEMP' (0.1 * &BT) ; FIN BT ; "
)


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Software draws each pixel."""
    monkeypatch.setattr("ssilang.io.viewer._SIZE", (320, 240))


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a series of three instants in one file, and one with a list of files."""
    root = tmp_path_factory.mktemp("results")
    for name, form in (("one", "'VTKHDF'"), ("many", "")):
        ran(BEAM.replace("FORM", form), root / name)
    return root


def shown(path: Path, target: Path, **wish: object) -> np.ndarray:
    """The picture without the colour bar and its words."""
    draw(path, target, Wish(**wish))  # type: ignore[arg-type]
    with Image.open(target) as image:
        return np.asarray(image.convert("RGB"), dtype=float)[40:, :1000]


def painted(image: np.ndarray) -> np.ndarray:
    return (image < 200).any(axis=2)


def test_a_folder_stands_for_its_results(results):
    assert chosen_file(results / "one").name == "beam.vtkhdf"
    assert chosen_file(results / "many").name == "beam.pvd"
    assert Series(chosen_file(results / "one")).times == pytest.approx([0.1, 0.2, 0.3])


@needs_window
def test_displacements_are_shown_and_amplified(results, tmp_path):
    """The end goes up by 0.032 m, the box's diagonal is 4.2 m: ten times that is 8 % of it."""
    usual = shown(results / "one", tmp_path / "x.png")
    ten = shown(results / "many", tmp_path / "x.png", scale=10.0)
    none = shown(results / "one", tmp_path / "x.png", scale=0.0)
    assert np.array_equal(usual, ten)
    high, low = (np.ptp(np.argwhere(painted(x[:700])), axis=0)[0] for x in (usual, none))
    # its far end, which hangs low on the sheet, comes up
    assert high < low - 10


@needs_window
def test_colours_are_those_of_the_field_asked_for(results, tmp_path):
    heat = shown(results / "one", tmp_path / "heat.png", field="HEAT", scale=0.0)
    columns = heat[painted(heat).any(axis=1)]
    middle = columns[len(columns) // 2]
    inked = np.flatnonzero((middle < 200).any(axis=1))
    left, right = middle[inked[:60]].mean(axis=0), middle[inked[-260:-200]].mean(axis=0)
    assert left[2] > left[1]  # violet, where HEAT is small
    assert right[1] > right[2]  # green to yellow


@needs_window
def test_components_have_their_names(results, tmp_path):
    """In a file of the whole series as in one of an instant."""
    by_name = shown(results / "one", tmp_path / "z.png", field="U:UZ", scale=0.0)
    assert np.array_equal(
        by_name, shown(results / "many", tmp_path / "z.png", field="U:UZ", scale=0.0)
    )
    assert np.array_equal(
        by_name, shown(results / "one", tmp_path / "z.png", field="U:3", scale=0.0)
    )
    with pytest.raises(InputError) as refused:
        draw(results / "one", tmp_path / "w.png", Wish("U:9"))
    assert refused.value.data["names"] == ("UX", "UY", "UZ")


@needs_window
def test_a_gif_holds_all_instants(results, tmp_path, small, monkeypatch):
    said: list[str] = []
    monkeypatch.setattr(Plotter, "add_text", lambda self, text, **how: said.append(text))
    draw(results / "one", tmp_path / "x.gif", Wish())
    with Image.open(tmp_path / "x.gif") as movie:
        frames = [np.asarray(f.convert("L"), dtype=float) for f in ImageSequence.Iterator(movie)]
    assert len(frames) == 3
    assert np.abs(frames[0] - frames[2]).max() > 60
    assert said == [f"beam.vtkhdf   t = 0.{k}   x 10" for k in (1, 2, 3)]
    draw(results / "one", tmp_path / "x.gif", Wish(scale=0.0))
    assert said[3:] == [f"beam.vtkhdf   t = 0.{k}" for k in (1, 2, 3)]
    with Image.open(tmp_path / "x.gif") as movie:
        frames = [np.asarray(f.convert("RGB"), float) for f in ImageSequence.Iterator(movie)]
    yellow = [(f[60:, :250, :2].min(axis=2) > f[60:, :250, 2] + 150.0).any() for f in frames]
    assert yellow == [False, False, True]  # where the largest value of all instants is


def test_colours_of_instants_have_a_common_range():
    """Of numbers alone: an instant may have none, and pictures have colours of their own."""
    values = [np.array([1.0, np.nan, 3.0]), None, np.full((2, 3), 9.0), np.array([-2.0])]
    assert _common_range(values) == (-2.0, 3.0)
    assert _common_range([None, np.array([np.nan])]) is None


@needs_window
def test_meshes_of_others_and_pictures(tmp_path):
    points = np.array([(0.0, 0, 0), (4, 0, 0), (4, 1, 0), (0, 1, 0)])
    mesh = meshio.Mesh(points, [("triangle", np.array([(0, 1, 2), (0, 2, 3)]))])
    meshio.write(tmp_path / "plate.msh", mesh, file_format="gmsh")
    draw(tmp_path / "plate.msh", tmp_path / "plate.png", Wish())
    with Image.open(tmp_path / "plate.png") as made:
        image = np.asarray(made.convert("RGB"), dtype=float)
    rows, columns = np.ptp(np.argwhere(painted(image[100:700, :1040])), axis=0)
    assert columns / rows == pytest.approx(4.0, rel=0.05)  # seen from above
    draw(tmp_path / "plate.png", tmp_path / "again.png", Wish())
    with Image.open(tmp_path / "again.png") as again:
        assert (np.asarray(again.convert("L")) < 200).any()


def test_meshes_are_read_by_the_door_of_scripts(tmp_path):
    """What meshio does not read, or reads wrongly: solids of Abaqus, with two blocks of nodes."""
    (tmp_path / "two.inp").write_text(
        "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n*NODE\n5, 2., 0.\n6, 2., 1.\n"
        "*ELEMENT, TYPE=CPS4, ELSET=LEFT\n1, 1, 2, 3, 4\n"
        "*ELEMENT, TYPE=CPE4, ELSET=RIGHT\n2, 2, 5, 6, 3\n"
    )
    data = Series(tmp_path / "two.inp").at(0)
    assert (data.n_points, data.n_cells, data.area) == (6, 2, pytest.approx(2.0))
    assert list(data.cell_data["part"]) == [1.0, 2.0]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["one", "-o", "x.png", "--field", "NO"], "no field 'NO', the file has"),
        (["one", "-o", "x.png", "--field", "HEAT", "--step", "9"], "there are 3"),
        (["one", "-o", "x.png", "--field", "U:9"], "no component '9'"),
        (["one", "-o", "x.txt"], "no name of a picture"),
        (["none", "-o", "x.png"], "no file or folder"),
        (["empty", "-o", "x.png"], "holds nothing to show"),
        (["bad.txt", "-o", "x.png"], "of no kind that can be shown"),
        (["bad.vtu", "-o", "x.png"], "no points, or is damaged"),
        (["cut", "-o", "x.png"], "no points, or is damaged"),
        (["bad.msh", "-o", "x.png"], "bad.msh cannot be read as GMSH"),
        (["one"], "ssilang view one -o picture.png"),
        (["one", "--lang", "fr"], "il n'y a pas d'écran"),
    ],
)
@needs_window
def test_what_cannot_be_shown_is_said(words, said, results, monkeypatch, capsys):
    monkeypatch.chdir(results)
    monkeypatch.setattr("ssilang.io.viewer.has_screen", lambda: False)
    monkeypatch.setattr("ssilang.cli.main._silence", lambda: None)  # it would end pytest's stream
    Path("empty").mkdir(exist_ok=True)
    for name in ("bad.msh", "bad.vtu", "bad.txt"):
        Path(name).write_text("nothing\n")
    shutil.copytree("many", "cut", dirs_exist_ok=True)
    for piece in Path("cut").rglob("*.vtu"):
        piece.write_bytes(piece.read_bytes()[: piece.stat().st_size // 2])
    assert main(["view", *words]) == 2
    assert said in capsys.readouterr().err
    assert not list(results.glob("x.*"))


def blank_png(side: int) -> bytes:
    """A square of one bit a point, made row by row: an image of it would take what VTK takes."""
    packer, row = zlib.compressobj(1), bytes(1 + side // 8)
    rows = [packer.compress(row) for _ in range(side)]
    made = b"\x89PNG\r\n\x1a\n"
    for kind, body in (
        (b"IHDR", struct.pack(">IIBBBBB", side, side, 1, 0, 0, 0, 0)),
        (b"IDAT", b"".join(rows) + packer.flush()),
        (b"IEND", b""),
    ):
        said = kind + body
        made += struct.pack(">I", len(body)) + said + struct.pack(">I", zlib.crc32(said))
    return made


@pytest.mark.skipif(not CAN_FORK, reason="nothing bounds VTK there")
@pytest.mark.parametrize(("ending", "forks"), [("vtu", True), ("png", False)])
@needs_window
def test_what_takes_all_memory_is_refused(ending, forks, tmp_path):
    """A picture of 1.6 GB, a cell that says it has 2 10^10 points: none that the file holds.

    In a process of its own: a fork of one that has drawn may wait for ever for its threads.
    """
    path, target = tmp_path / f"made.{ending}", tmp_path / "x.png"
    code = (
        "import sys\n"
        "from ssilang import system\n"
        "from ssilang.cli import main\n"
        "from ssilang.io import viewer\n"
        f"viewer._ROOM, main._silence, system.CAN_FORK = 10**9, lambda: None, {forks}\n"
        f"sys.exit(main.main(['view', {str(path)!r}, '-o', {str(target)!r}]))\n"
    )
    for sound in (True, False):
        if ending == "png":
            path.write_bytes(blank_png(400 if sound else 40000))
        else:
            path.write_text(grid_of(1000, last=3 if sound else 2 * 10**10))
        assert path.stat().st_size < 2**21
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        assert done.returncode == (0 if sound else 2), done.stderr
        assert ("or takes more than" in done.stderr) is not sound
        assert target.exists() is sound
        target.unlink(missing_ok=True)


@pytest.mark.parametrize("words", ["DATASET F\x1b[2JOO", "DATASET UNSTRUCTURED_GRID\nPO\x1b[2JI 3"])
def test_words_of_a_damaged_file_reach_no_terminal(words, tmp_path, capfd):
    path = tmp_path / "bad.vtk"
    path.write_text(f"# vtk DataFile Version 3.0\nof somebody\nASCII\n{words}\n")
    with pytest.raises(InputError):
        draw(path, tmp_path / "x.png", Wish())
    assert capfd.readouterr() == ("", "")


@needs_window
@pytest.mark.parametrize("binary", [False, True])
def test_a_cut_mesh_of_others_is_no_picture(tmp_path, binary, small):
    """VTK shows what it has read, and noughts for the rest."""
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.ImageData(dimensions=(4, 3, 2)).cast_to_unstructured_grid()
    mesh.point_data["u"] = np.arange(3.0 * mesh.n_points).reshape(-1, 3)
    path = tmp_path / "whole.vtk"
    mesh.save(str(path), binary=binary)
    draw(path, tmp_path / "whole.png", Wish())
    cut = tmp_path / "cut.vtk"
    for share in (0.4, 0.7, 0.97):
        cut.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
        with pytest.raises(InputError) as told:
            draw(cut, tmp_path / "cut.png", Wish())
        assert told.value.code == "io.not-viewed-no-points", share
        assert not (tmp_path / "cut.png").exists()


@pytest.mark.skipif(shutil.which("Xvfb") is None, reason="no X server without a screen (xvfb)")
def test_a_window_opens_with_a_slider_over_instants(results):
    """In a process of its own, on a screen in memory; the window is closed as soon as it stands."""
    code = (
        "import pyvista\n"
        "from ssilang.io import viewer\n"
        "kept = pyvista.Plotter.show\n"
        "def show(self, **how):\n"
        "    slider = self.slider_widgets[0].GetRepresentation()\n"
        "    slider.SetValue(1.0); self.slider_widgets[0].InvokeEvent('EndInteractionEvent')\n"
        "    kept(self, auto_close=False, interactive=False)\n"
        "    print(type(self.render_window).__name__, self.text, len(self.slider_widgets))\n"
        "pyvista.Plotter.show = show\n"
        "viewer.show(__import__('pathlib').Path('one'), viewer.Wish())\n"
    )
    reader, writer = os.pipe()
    # a server that begins anew when its only client goes, as VTK's look does, refuses the next one
    screen = subprocess.Popen(
        ["Xvfb", "-noreset", "-displayfd", str(writer), "-screen", "0", "1300x1000x24"],
        pass_fds=[writer],
        stderr=subprocess.DEVNULL,
    )
    os.close(writer)
    try:
        number = os.read(reader, 16).decode().strip()
        there = {**os.environ, "DISPLAY": f":{number}"}
        there.pop("VTK_DEFAULT_OPENGL_WINDOW", None)
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=results, env=there, capture_output=True, text=True,
            check=False, timeout=120,
        )  # fmt: skip
    finally:
        screen.terminate()
        screen.wait()
        os.close(reader)
    assert number.isdigit()
    assert done.returncode == 0, done.stderr[-2000:]
    assert "vtkXOpenGLRenderWindow" in done.stdout, done.stderr[-2000:]
