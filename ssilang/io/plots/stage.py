"""Scenes in space drawn by VTK without a screen: hidden surfaces, light, thick lines, arrows.

What is drawn lives on the sheet: to the right, upwards and towards the eye, with the sheet's half
height as unit, so that coordinates of any size are drawn alike.
"""

import os
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.errors import NoGraphicsError
from ssilang.io.vtk.library import pyvista
from ssilang.kernel.base.arrays import FloatArray
from ssilang.remembered import remembered

Inks = NDArray[np.float64]  # (n, 4) red green blue opacity

_AMBIENT = {
    "shaded": 0.42,
    "tinted": 0.75,
}  # of light that comes from everywhere; the rest is a lamp's
_LAMP = (-0.3, 0.55, 1.6)  # over the eye's left shoulder
_CHOSEN = "VTK_DEFAULT_OPENGL_WINDOW"  # what VTK opens
_STAND_BACK = 1.0, 1.0  # faces, of the lines that lie in them


@dataclass(frozen=True, eq=False)
class Polygons:
    """Polygons, or segments (k = 2), with an ink each.

    Attributes
    ----------
    points : array (n, k, 3)
    inks : array (n, 4)
    width : float
        Of segments, in points of the sheet.
    rank : int
        Segments in one place: the higher is drawn over the lower.
    light : '', 'shaded' or 'tinted'
        How much the brightness of polygons follows the angle at which they are seen.
    """

    points: FloatArray
    inks: Inks
    width: float = 1.0
    rank: int = 0
    light: str = ""


@dataclass(frozen=True, eq=False)
class Dots:
    """Points (n, 3) as balls of `width` points on the sheet, with inks (n, 4)."""

    points: FloatArray
    inks: Inks
    width: float


@dataclass(frozen=True, eq=False)
class Darts:
    """Arrows from `start` (n, 3) along `step` (n, 3), of one ink (4,); strokes without heads."""

    start: FloatArray
    step: FloatArray
    ink: Inks
    heads: bool = True


Thing = Polygons | Dots | Darts


@dataclass(frozen=True, eq=False)
class Photograph:
    """What the eye sees."""

    image: NDArray[np.uint8]  # (rows, columns, 3) of uint8 from the upper left corner
    depth: NDArray[np.float32]  # (rows, columns) z-buffer: 0 at the eye, 1 where nothing is
    reach: tuple[float, float]  # how near to the eye (`View.depth`) 0 and 1 of the depth are

    def shows(self, flat: FloatArray, near: FloatArray, bounds: FloatArray) -> NDArray[np.bool_]:
        """Whether points are seen: on the sheet (n, 2), `near` the eye (n,).

        Parameters
        ----------
        bounds : array (2, 2)
            Lower and upper corner of the sheet.
        """
        rows, columns = self.depth.shape
        extent = bounds[1] - bounds[0]
        place = (flat - bounds[0]) / extent
        column = np.clip((place[:, 0] * columns).astype(int), 0, columns - 1)
        row = np.clip(((1.0 - place[:, 1]) * rows).astype(int), 0, rows - 1)
        slack = 0.01 * float(np.linalg.norm(extent))
        depth, (high, low) = self.depth[row, column].astype(float), self.reach
        return np.asarray((depth == 1.0) | (near >= high - depth * (high - low) - slack))


class Stage:
    """An off-screen window, opened at its first photograph and used for all that follow."""

    def __init__(self) -> None:
        self._plotter: Any = None

    def photograph(
        self,
        things: Sequence[Thing],
        axes: FloatArray,
        bounds: FloatArray,
        pixels: tuple[int, int],
        per_point: float,
        deep: bool = True,
    ) -> Photograph:
        """What an eye sees that looks along -`axes[2]`.

        Parameters
        ----------
        axes : array (3, 3)
            Rows: to the right on the sheet, upwards on the sheet, towards the eye.
        bounds : array (2, 2)
            Lower and upper corner of the sheet.
        pixels : (int, int)
            Width and height of the picture; it holds the whole sheet.
        per_point : float
            Pixels in a point of the sheet.
        deep : bool
            Whether the depths are wanted.

        Raises
        ------
        NoGraphicsError
            If this system has nothing that draws in space.
        """
        sheet = _Sheet(axes, bounds.mean(axis=0), float(bounds[1, 1] - bounds[0, 1]) / 2)
        if self._plotter is None:
            self._plotter = _open()
        plotter = self._plotter
        plotter.clear_actors()
        plotter.render_window.SetSize(*pixels)  # pyvista's own way draws once more
        for thing in things:
            _ADD[type(thing)](plotter, thing, sheet, per_point)
        *_, low, high = plotter.renderer.ComputeVisiblePropBounds()
        if not low <= high:  # nothing is there
            low, high = 0.0, 0.0
        low, high = low - 0.05, high + 0.05
        camera = plotter.camera
        camera.position, camera.focal_point, camera.up = (0, 0, high), (0, 0, low), (0, 1, 0)
        camera.clipping_range = (0.0, high - low)
        plotter.render_window.Render()
        image = _colours(plotter.render_window, *pixels)
        depth = _depths(plotter.render_window, *pixels) if deep else np.ones((1, 1), np.float32)
        return Photograph(image, depth, (high * sheet.unit, low * sheet.unit))

    def close(self) -> None:
        """Give the window back."""
        if self._plotter is not None:
            self._plotter.close()
            self._plotter = None


@dataclass(frozen=True, eq=False)
class _Sheet:
    """From space to the sheet: axes (3, 3), its middle (2,) and half its height."""

    axes: FloatArray
    middle: FloatArray
    unit: float

    def put(self, points: FloatArray) -> FloatArray:
        placed: FloatArray = points @ self.axes.T
        placed[..., :2] -= self.middle
        return placed / self.unit

    def turn(self, steps: FloatArray) -> FloatArray:
        return steps @ self.axes.T / self.unit


def _open() -> Any:
    plotter = hidden_plotter()
    plotter.render_window.SetMultiSamples(0)  # pictures are drawn larger and made small
    plotter.enable_parallel_projection()
    plotter.camera.parallel_scale = 1.0
    return plotter


def hidden_plotter(size: tuple[int, int] | None = None) -> Any:
    """A plotter of pyvista that needs no screen.

    The kind of its window is asked for by the environment while it is made, and no longer: windows
    of a program that draws its own are theirs to choose.

    Raises
    ------
    NoGraphicsError
        If this system has nothing that draws in space.
    """
    kind = _window_kind()
    if kind:
        os.environ[_CHOSEN] = kind
    try:
        plotter: Any = pyvista.Plotter(off_screen=True, window_size=size, lighting="none")
    finally:
        if kind:
            del os.environ[_CHOSEN]
    light_up(plotter)
    return plotter


def light_up(plotter: Any) -> None:
    """White paper, and one lamp that goes with the eye."""
    plotter.background_color = "white"
    plotter.add_light(pyvista.Light(position=_LAMP, light_type="camera light"))


@lru_cache(maxsize=1)
def _window_kind() -> str:
    """The kind of VTK's windows that works on this system without a screen, '' for VTK's choice.

    Left to itself VTK asks for an X server first and says so when there is none, and dies where
    it finds no OSMesa.
    """
    try:
        import pyvista  # noqa: F401
    except ImportError as problem:  # a library that its wheels want of the system
        raise NoGraphicsError("io.no-drawing-in-space", reason=str(problem)) from problem
    if not sys.platform.startswith("linux") or _CHOSEN in os.environ:
        return ""
    return str(remembered("graphics", _graphics(), _drawing_kind))


# Draws a window of one kind and looks at it: where libraries are missing, VTK dies of it
_PROBE = """
import sys
from vtkmodules import vtkRenderingOpenGL2
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderer
window = getattr(vtkRenderingOpenGL2, sys.argv[1])()
if not window.SupportsOpenGL():
    sys.exit(1)
window.SetOffScreenRendering(1)
window.SetSize(8, 8)
white = vtkRenderer()
white.SetBackground(1, 1, 1)
window.AddRenderer(white)
window.Render()
seen = vtkUnsignedCharArray()
window.GetPixelData(0, 0, 7, 7, 0, seen, 0)
sys.exit(seen.GetTuple3(0) != (255, 255, 255))
"""
_DRIVERS = "/usr/share/glvnd/egl_vendor.d"  # who draws for libEGL
_SECONDS = 60.0  # that a window may take to open
_KINDS = {
    "vtkEGLRenderWindow": ("libEGL.so.1",),
    "vtkOSOpenGLRenderWindow": ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"),
    "vtkXOpenGLRenderWindow": ("libGL.so.1",),
}
"""Kinds of windows and what they draw with: a card or Mesa by EGL, Mesa alone, the screen's."""


def _drawing_kind() -> str:
    """The first kind of window that draws in a process of its own; none is not remembered."""
    for kind, libraries in _KINDS.items():
        if any(map(_library, libraries)) and (kind != "vtkXOpenGLRenderWindow" or _has_screen()):
            command = [sys.executable, "-P", "-c", _PROBE, kind]
            with suppress(OSError, subprocess.TimeoutExpired):
                if not subprocess.run(
                    command, stdin=subprocess.DEVNULL, capture_output=True, timeout=_SECONDS,
                    check=False,
                ).returncode:  # fmt: skip
                    return kind
    raise NoGraphicsError("io.no-drawing-in-space", reason="libEGL, libOSMesa, libGL")


def _graphics() -> str:
    """What decides which windows draw: VTK's version, the system's libraries, the screen."""
    from vtkmodules.vtkCommonCore import vtkVersion

    found = [_library(name) for libraries in _KINDS.values() for name in libraries]
    with suppress(OSError):
        found += sorted(os.listdir(_DRIVERS))
    return f"{vtkVersion.GetVTKVersion()} {_has_screen()} {found}"


def _has_screen() -> bool:
    return bool(os.environ.get("DISPLAY"))


@cache
def _library(name: str) -> str:
    """A library of the system: its file, size and time, '' if there is none."""
    from ctypes import CDLL

    try:
        CDLL(name)
        with open("/proc/self/maps", encoding="utf-8") as maps:
            path = next(line.split()[-1] for line in maps if f"/{name}" in line)
        found = os.stat(path)
    except StopIteration:
        return name
    except OSError:
        return ""
    return f"{path} {found.st_size} {found.st_mtime_ns}"


def _colours(window: Any, columns: int, rows: int) -> NDArray[np.uint8]:
    """What a window shows, from the upper left corner."""
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

    values = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, columns - 1, rows - 1, 0, values, 0)
    return np.asarray(pyvista.convert_array(values)).reshape(rows, columns, 3)[::-1]


def _depths(window: Any, columns: int, rows: int) -> NDArray[np.float32]:
    """The z-buffer of a window, from the upper left corner."""
    from vtkmodules.vtkCommonCore import vtkFloatArray

    values = vtkFloatArray()
    window.GetZbufferData(0, 0, columns - 1, rows - 1, values)
    return np.asarray(pyvista.convert_array(values)).reshape(rows, columns)[::-1]


def _add_polygons(plotter: Any, thing: Polygons, sheet: _Sheet, per_point: float) -> None:
    n, k, _ = thing.points.shape
    rows = np.arange(n * k).reshape(n, k)
    colours = (255 * np.clip(thing.inks, 0, 1)).round().astype(np.uint8)
    made = pyvista.PolyData()
    made.points = sheet.put(thing.points.reshape(-1, 3))
    cells = np.hstack([np.full((n, 1), k), rows]).ravel()
    if k == 2:
        made.lines = cells
    else:
        made.faces = cells
    made.cell_data["ink"] = colours
    light = _AMBIENT.get(thing.light)
    ambient, diffuse = (1.0, 0.0) if light is None else (light, 1.0 - light)
    actor = plotter.add_mesh(
        made, scalars="ink", rgba=True, line_width=thing.width * per_point, copy_mesh=False,
        lighting=light is not None, ambient=ambient, diffuse=diffuse, specular=0.0,
        reset_camera=False, render=False, show_scalar_bar=False, smooth_shading=False,
    )  # fmt: skip
    mapper = actor.mapper
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    if k == 2:
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -2.0 * thing.rank)
    else:
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(*_STAND_BACK)


def _add_dots(plotter: Any, thing: Dots, sheet: _Sheet, per_point: float) -> None:
    made = pyvista.PolyData(sheet.put(thing.points))
    made.point_data["ink"] = (255 * np.clip(thing.inks, 0, 1)).round().astype(np.uint8)
    plotter.add_mesh(
        made, scalars="ink", rgba=True, point_size=thing.width * per_point, style="points",
        render_points_as_spheres=True, ambient=0.6, diffuse=0.4, copy_mesh=False,
        reset_camera=False, render=False, show_scalar_bar=False,
    )  # fmt: skip


def _add_darts(plotter: Any, thing: Darts, sheet: _Sheet, per_point: float) -> None:
    made = pyvista.PolyData(sheet.put(thing.start))
    made.point_data["step"] = sheet.turn(thing.step)
    slim = pyvista.Arrow(
        tip_length=0.28, tip_radius=0.075, tip_resolution=12, shaft_radius=0.022,
        shaft_resolution=8,
    )  # fmt: skip
    shown = made.glyph(orient="step", scale="step", geom=slim)
    plotter.add_mesh(
        shown, color=tuple(thing.ink[:3]), ambient=0.55, diffuse=0.45, copy_mesh=False,
        reset_camera=False, render=False, show_scalar_bar=False, scalars=None,
    )  # fmt: skip


_ADD: dict[type, Any] = {Polygons: _add_polygons, Dots: _add_dots, Darts: _add_darts}
