"""Results, meshes and pictures looked at: in a window, or as a picture without a screen.

VTK's files are read by VTK, meshes of other programs by the door that scripts have.
"""

import io
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.atomic import replacing
from ssilang.io.errors import InputError, OutputError
from ssilang.io.mesh_files.reading import ENDINGS, mesh_with_fields
from ssilang.io.plots.animation import save_animation
from ssilang.io.plots.palette import shade
from ssilang.io.plots.stage import hidden_plotter, light_up
from ssilang.io.plots.view import DEFAULT_DIRECTION
from ssilang.io.vtk.library import pyvista
from ssilang.io.vtk.silence import silent
from ssilang.io.vtk.vtkhdf import COMPONENT, opened_hdf
from ssilang.kernel.fields.deformed import round_down
from ssilang.system import in_bounds

PICTURES = ("png", "jpg", "jpeg", "bmp", "tif", "tiff")
RESULTS = ("vtkhdf", "pvd", "vtu", "vtk", "vtp", "vti", "vtm")
MESHES = (
    *(e[1:] for e in ENDINGS if e[1:] not in RESULTS), "xdmf", "e", "exo", "off", "obj", "ply",
)  # fmt: skip
DRAWN = ("png", "gif", "jpg", "jpeg")

_SIZE = (1280, 960)
_ROOM, _DENSEST = 4 * 10**9, 50  # bytes that a look may take, and times those of its files
_SHARE = 0.08  # of a scene's diagonal: largest displacement shown if no scale is asked for
_MOST_EDGES = 30_000  # cells whose edges are drawn
# what displacements are called
_FIRST, _CALLED = ("UX", "UR"), ("displacement", "depl", "u")
_LABELS = ("group", "material", "part", "gmsh:physical", "gmsh:geometrical", "cell_tags")
_INK = "#1b1f24"


@dataclass(frozen=True)
class Wish:
    """What to see of a file.

    Attributes
    ----------
    field : str
        Name of an array, or NAME:COMPONENT; '' for the displacement, else the first there is.
    step : int, optional
        Instant from 1; None for the last.
    scale : float, optional
        Displacements are shown so many times as large; None for a scale that shows them.
    """

    field: str = ""
    step: int | None = None
    scale: float | None = None


class Series:
    """The instants of a file: times (n,) and a data set each."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.times: list[float] = [0.0]
        self._reader: Any = None
        self._one: Any = None
        self._open()

    @silent()
    def _open(self) -> None:
        ending = self.path.suffix.lstrip(".").lower()
        try:
            if ending == "vtkhdf":
                self._reader = _OneFile(self.path)
                self.times = self._reader.time_values
            elif ending == "pvd":
                self._reader = pyvista.get_reader(str(self.path))
                self.times = list(self._reader.time_values) or [0.0]
            elif ending in (*RESULTS, *PICTURES, "stl", "ply", "obj"):
                self._one = self._sound(lambda: pyvista.read(str(self.path)))
            else:
                kind = ENDINGS.get(f".{ending}")
                read = mesh_with_fields(self.path, kind) if kind else _other(self.path)
                self._one = pyvista.from_meshio(read)
        except InputError:
            raise
        except Exception as problem:  # whatever a library says of a file that is none of its own
            raise InputError(
                "io.not-viewed",
                path=self.path,
                reason=(str(problem).strip() or type(problem).__name__).splitlines()[0],
            ) from problem
        if self.at(0).n_points == 0:
            raise InputError("io.not-viewed-no-points", path=self.path)

    def _sound(self, read: Callable[[], Any]) -> Any:
        """What a reader of VTK gives, if it found no fault."""
        with silent() as faulty:
            found = read()
        if faulty():
            raise InputError("io.not-viewed-no-points", path=self.path)
        return found

    @silent()
    def at(self, row: int) -> Any:
        """The data set of an instant, parts together, from 0."""
        if self._one is not None:
            return self._one
        try:
            self._reader.set_active_time_point(row)
            found = self._sound(self._reader.read)
        except (RuntimeError, OSError) as problem:  # a file of the series is gone, or damaged
            raise InputError("io.not-viewed-no-points", path=self.path) from problem
        return found.combine() if isinstance(found, pyvista.MultiBlock) else found


class _OneFile:
    """Instants of a .vtkhdf, which pyvista reads without their times."""

    def __init__(self, path: Path) -> None:
        self._reader, self.time_values = opened_hdf(path)

    def set_active_time_point(self, row: int) -> None:
        self._reader.SetStep(row)

    def read(self) -> Any:
        self._reader.Update()
        found = pyvista.wrap(self._reader.GetOutput())
        for part in found if isinstance(found, pyvista.MultiBlock) else (found,):
            # names of components stand in the field data of our files
            for told in part.field_data:
                array, sign, name = told.rpartition(COMPONENT)
                for place in (part.point_data, part.cell_data):
                    if sign and array in place:
                        column = int(part.field_data[told][0]) - 1
                        place.VTKObject.GetAbstractArray(array).SetComponentName(column, name)
        return found


def _other(path: Path) -> Any:
    """A file that meshio knows by its ending, and scripts do not."""
    import meshio

    told = io.StringIO()
    try:
        with redirect_stdout(told), redirect_stderr(told):
            return meshio.read(path)
    except SystemExit:  # its way to say that no format of that ending fits
        said = " ".join(told.getvalue().split())
        raise InputError("io.not-viewed", path=path, reason=said or "meshio") from None


def chosen_file(path: Path) -> Path:
    """The file to look at: itself, or of a folder of results the latest of the best kind.

    Raises
    ------
    InputError
        If there is none.
    """
    if not path.exists():
        raise InputError("io.not-viewed-absent", path=path)
    if not path.is_dir():
        if path.suffix.lstrip(".").lower() not in (*PICTURES, *RESULTS, *MESHES):
            raise InputError("io.not-viewed-kind", path=path, known=(*RESULTS, *MESHES, *PICTURES))
        return path
    for kind in (*RESULTS[:3], *PICTURES[:1]):
        found = sorted(path.glob(f"*.{kind}"), key=lambda p: p.stat().st_mtime)
        if found:
            return found[-1]
    raise InputError("io.not-viewed-empty", path=path, known=(*RESULTS[:3], *PICTURES[:1]))


def has_screen() -> bool:
    """Whether a window can be opened here."""
    if not sys.platform.startswith("linux"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def looked_at(path: Path, target: Path | None, wish: Wish) -> None:
    """Draw, or show where no picture is asked for, in a process that what a file declares may end.

    Raises
    ------
    InputError, OutputError
        As `draw` and `show`; or if that process ended.
    """
    found = chosen_file(path)
    beside = found.parent.glob("*") if found.suffix == ".pvd" else (found,)
    most = _ROOM + _DENSEST * sum(p.stat().st_size for p in beside if p.is_file())
    look = partial(show, path, wish) if target is None else partial(draw, path, target, wish)
    if in_bounds(look, most, None, InputError, OutputError) is None:
        raise InputError("io.not-viewed-reader-ended", path=found, most=most / 1e6)


def show(path: Path, wish: Wish) -> Path:
    """Open a window, with a slider over the instants if there are several; ends when it closes.

    Raises
    ------
    OutputError
        If there is no screen.
    """
    found = chosen_file(path)
    if not has_screen():
        raise OutputError("io.no-screen", path=path)
    series = Series(found)
    plotter = pyvista.Plotter(window_size=list(_SIZE), title=str(series.path), lighting="none")
    light_up(plotter)
    scene = _Scene(plotter, series, wish)
    scene.draw(scene.last)
    if len(series.times) > 1:
        scene.plotter.add_slider_widget(
            lambda value: scene.draw(round(value) - 1), [1, len(series.times)],
            value=scene.last + 1, title="", fmt="%.0f", color=_INK, pointa=(0.25, 0.06),
            pointb=(0.75, 0.06),
        )  # fmt: skip
    scene.plotter.show()
    return found


def draw(path: Path, target: Path, wish: Wish) -> Path:
    """Write a picture, or with the ending gif all instants as an animation.

    Raises
    ------
    InputError, OutputError
        For a file that cannot be read, an instant or array that is not there, an ending that is
        no picture's, or a system that cannot draw.
    """
    ending = target.suffix.lstrip(".").lower()
    if ending not in DRAWN:
        raise OutputError("io.not-drawn-kind", path=target, known=DRAWN)
    series = Series(chosen_file(path))
    scene = _Scene(hidden_plotter(_SIZE), series, wish)
    try:
        if ending == "gif":
            return save_animation(list(scene.frames()), target, False)
        content = scene.picture(scene.last, "JPEG" if ending.startswith("j") else "PNG")
    finally:
        scene.plotter.close()
    with replacing(target) as stream:
        stream.write(content)
    return target


class _Scene:
    """One window, and what it shows of a series."""

    def __init__(self, plotter: Any, series: Series, wish: Wish) -> None:
        self.plotter, self.series, self.wish = plotter, series, wish
        step = len(series.times) if wish.step is None else wish.step
        if not 1 <= step <= len(series.times):
            raise InputError("io.no-such-instant", step=step, count=len(series.times))
        self.last = step - 1
        self._scale = wish.scale
        self._range: tuple[float, float] | None = None

    def picture(self, row: int, form: str = "PNG") -> bytes:
        """A picture of an instant as a file."""
        from PIL import Image

        self.draw(row)
        buffer = io.BytesIO()
        Image.fromarray(np.asarray(self.plotter.screenshot(None, return_img=True))).save(
            buffer, form
        )
        return buffer.getvalue()

    def frames(self) -> Iterator[bytes]:
        """Pictures of all instants, colours and scale common."""
        self._range = _common_range([self._found(k)[2] for k in range(len(self.series.times))])
        for row in range(len(self.series.times)):
            yield self.picture(row)

    def draw(self, row: int) -> None:
        """Show an instant."""
        data, name, values = self._found(row)
        first = not self.plotter.actors
        camera = None if first else self.plotter.camera.copy()
        self.plotter.clear_actors()
        if values is not None and values.ndim == 2 and values.dtype == np.uint8:
            self.plotter.add_mesh(data, scalars=name, rgb=True, lighting=False)
        else:
            self._add(data, name, values, row)
        if camera is None:  # from above on what lies in a plane, else as TRAC does
            self.plotter.enable_parallel_projection()
            low_x, high_x, low_y, high_y, low_z, high_z = self.plotter.bounds
            if high_z - low_z <= 1e-9 * max(high_x - low_x, high_y - low_y, 1e-300):
                self.plotter.view_xy()
            else:
                self.plotter.view_vector(DEFAULT_DIRECTION, viewup=(0.0, 0.0, 1.0))
            if self.plotter.scalar_bars:  # the scene to the left of it
                self.plotter.camera.zoom(0.86)
                self.plotter.camera.SetWindowCenter(0.14, 0.0)
        else:
            self.plotter.camera = camera

    def _add(self, data: Any, name: str, values: Any, row: int) -> None:
        moved, scale = self._moved(data)
        notes = [self.series.path.name]
        if len(self.series.times) > 1:
            notes.append(f"t = {self.series.times[row]:.6g}")
        if scale not in (0.0, 1.0):
            notes.append(f"x {scale:.3g}")
        look: dict[str, Any] = {"color": shade("GRIS"), "show_edges": data.n_cells <= _MOST_EDGES}
        if values is not None:
            place = moved.point_data if len(values) == moved.n_points else moved.cell_data
            place["shown"] = values
            look |= {
                "scalars": "shown", "cmap": "viridis", "clim": self._range,
                "scalar_bar_args": {"title": name, "color": _INK, "fmt": "%.4g",
                                    "n_labels": 5, "vertical": True, "position_x": 0.83},
            }  # fmt: skip
            del look["color"]
        self.plotter.add_mesh(
            moved, edge_opacity=0.35, copy_mesh=True, ambient=0.55, diffuse=0.45, specular=0.0,
            **look,
        )  # fmt: skip
        self.plotter.add_text("   ".join(notes), font_size=10, color=_INK, position="upper_left")
        self.plotter.add_axes(color=_INK)

    def _moved(self, data: Any) -> tuple[Any, float]:
        """The data set where its displacement takes it, and how many times as far."""
        made = data.copy(deep=False)
        known = _steps(data)
        if known is None:
            return made, 0.0
        if self._scale is None:
            longest = max(self._longest(), 1e-300)
            size = float(data.length)
            self._scale = (
                1.0 if longest > _SHARE * size / 2 else round_down(_SHARE * size / longest)
            )
        made.points = np.asarray(data.points, dtype=float) + self._scale * known
        return made, self._scale

    def _longest(self) -> float:
        """The largest displacement of the instants shown: a scale is kept from one to another."""
        rows = {self.last, len(self.series.times) - 1, len(self.series.times) // 2}
        found = [_steps(self.series.at(k)) for k in rows]
        return max(float(np.linalg.norm(s, axis=1).max(initial=0)) for s in found if s is not None)

    def _found(self, row: int) -> tuple[Any, str, Any]:
        """Data set, name and values (n,) of what colours it at an instant."""
        data = self.series.at(row)
        arrays = {**dict(data.cell_data.items()), **dict(data.point_data.items())}
        name, _, part = self.wish.field.partition(":")
        if not name:
            physical = (n for n in arrays if n not in _LABELS and not n.startswith("vtk"))
            name = _displacement(data) or next(physical, "") or next(iter(arrays), "")
        if not name:
            return data, "", None
        if name not in arrays:
            raise InputError("io.no-such-array", field=name, names=tuple(arrays))
        values = np.asarray(arrays[name])
        if values.ndim == 2 and values.dtype != np.uint8:
            values, name = _component(data, name, values, part)
        return data, name, values


def _displacement(data: Any) -> str:
    """Name of the array of displacements at the points, '' if there is none."""
    for name in data.point_data:
        array = data.point_data.VTKObject.GetAbstractArray(name)
        first = array.GetComponentName(0) or ""
        if array.GetNumberOfComponents() == 3 and (name.lower() in _CALLED or first in _FIRST):
            return str(name)
    return ""


def _steps(data: Any) -> Any:
    """Displacements (n, 3), 0 where a point has none; None if no point has."""
    name = _displacement(data)
    return np.nan_to_num(np.asarray(data.point_data[name], dtype=float)) if name else None


def _component(data: Any, name: str, values: Any, part: str) -> tuple[Any, str]:
    """A column of an array by its name or number from 1, or without one the length of its rows."""
    if not part:
        return np.linalg.norm(values, axis=1), name
    place = data.point_data if name in data.point_data else data.cell_data
    array = place.VTKObject.GetAbstractArray(name)
    names = [array.GetComponentName(k) or str(k + 1) for k in range(values.shape[1])]
    if part in names:
        column = names.index(part)
    elif part.isdigit() and 1 <= int(part) <= len(names):
        column = int(part) - 1
    else:
        raise InputError("io.field-no-component", component=part, names=tuple(names))
    return values[:, column], f"{name} {names[column]}"


def _common_range(several: list[Any]) -> tuple[float, float] | None:
    known = [v[np.isfinite(v)] for v in several if v is not None and v.ndim == 1]
    if not known or not sum(map(len, known)):
        return None
    return min(float(v.min()) for v in known), max(float(v.max()) for v in known)
