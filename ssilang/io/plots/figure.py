"""New figures in one style, and their files."""

import io
import logging
import os
import re
import textwrap
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ssilang.io.atomic import replacing
from ssilang.io.plots.markup import cut, to_mathtext

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ssilang.io.plots.stage import Stage

DPI = 150
_STYLE = Path(__file__).with_name("pictures.mplstyle")


def _style() -> dict[Any, Any]:
    """Settings of pictures; a `matplotlibrc` of the folder may be anybody's, and calls LaTeX."""
    import matplotlib as mpl

    own = mpl.rc_params_from_file(_STYLE, use_default_template=False)
    if not os.path.isfile("matplotlibrc"):
        return own
    from matplotlib.style.core import STYLE_BLACKLIST

    plain = {k: v for k, v in mpl.rcParamsDefault.items() if k not in STYLE_BLACKLIST}
    return plain | own


@contextmanager
def drawing(width: float = 7.2, height: float = 4.6) -> "Iterator[Figure]":
    """A new figure of `width` x `height` inches; the style holds inside the block."""
    # where the user has no home matplotlib tells of a cache that it makes elsewhere
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    import matplotlib as mpl
    from matplotlib.figure import Figure

    _share_what_is_read()
    with mpl.rc_context(_style()):
        figure = Figure(figsize=(width, height), dpi=DPI, layout="constrained")
        figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)  # type: ignore[union-attr, call-arg]
        yield figure


@cache
def _share_what_is_read() -> None:
    """Let matplotlib find again what it has read of a formula or of a number on an axis.

    It keeps that by the object that reads, of which each file has its own, and an SVG several: half
    of the time of a picture of curves went into reading the same numbers again. What is read
    depends on the kind of file alone.
    """
    from matplotlib.mathtext import MathTextParser

    def kind(reader: "MathTextParser[Any]") -> object:
        return getattr(reader, "_output_type", id(reader))

    def equal(reader: "MathTextParser[Any]", other: object) -> bool:
        return isinstance(other, MathTextParser) and kind(reader) == kind(other)

    def key(reader: "MathTextParser[Any]") -> int:
        return hash(kind(reader))

    MathTextParser.__eq__ = equal  # type: ignore[method-assign, assignment]
    MathTextParser.__hash__ = key  # type: ignore[method-assign, assignment]


def head(figure: "Figure", title: str) -> None:
    """Write a title over a figure, on several lines if it is long."""
    text = cut(title.strip())
    if text:
        lines = textwrap.wrap(text, max(20, int(8.0 * figure.get_figwidth())))
        figure.suptitle("\n".join(map(to_mathtext, lines)), fontsize=12, fontweight="bold")


class Pictures:
    """The pictures of one run, numbered in order: 0001_name.png ..."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self.files: list[Path] = []
        self._count = 0

    @cached_property
    def stage(self) -> "Stage":
        """Draws what stands in space, for all pictures of the run."""
        from ssilang.io.plots.stage import Stage

        return Stage()

    def close(self) -> None:
        """Give the window back in which scenes were drawn."""
        if "stage" in vars(self):
            self.stage.close()

    def save(self, figure: "Figure", name: str, formats: tuple[str, ...] = ("png",)) -> list[Path]:
        """Write `figure` under the next number in each format; the files appear whole.

        Raises
        ------
        OutputError
            If the directory cannot be written.
        """
        self._count += 1
        stem = f"{self._count:04d}_{slug(name)}".rstrip("_")
        made = [save_figure(figure, self.directory / f"{stem}.{form}") for form in formats]
        self.files += made
        return made


def save_figure(figure: "Figure", path: Path) -> Path:
    """Write `figure` in the format of the extension of `path`, whole or not at all."""
    content = figure_bytes(figure, path.suffix.lstrip("."))
    with replacing(path) as stream:
        stream.write(content)
    return path


def figure_bytes(figure: "Figure", form: str) -> bytes:
    """`figure` as a file of a format: 'png', 'svg' or 'pdf'; its parts are placed once.

    Left to `savefig` each format places them twice and draws twice.
    """
    import matplotlib as mpl

    buffer = io.BytesIO()
    metadata = {"Date": None} if form == "svg" else None
    with mpl.rc_context(_style()):
        _number_plainly(figure)
        if (engine := figure.get_layout_engine()) is not None:
            engine.execute(figure)
            figure.set_layout_engine(None)
        figure.savefig(buffer, format=form, metadata=metadata)
    return buffer.getvalue()


def _number_plainly(figure: "Figure") -> None:
    """Let axes have plain numbers, not formulas: reading those took a fifth of a picture's time."""
    from matplotlib.ticker import ScalarFormatter

    class Plain(ScalarFormatter):
        def __call__(self, x: float, pos: int | None = None) -> str:
            return super().__call__(x, pos).removeprefix(r"$\mathdefault{").removesuffix("}$")

    for axis in (a for axes in figure.axes for a in (axes.xaxis, axes.yaxis)):
        if type(axis.get_major_formatter()) is ScalarFormatter:
            axis.set_major_formatter(Plain())


def slug(title: str) -> str:
    """A short file name made from a title: ASCII letters, digits and hyphens."""
    plain = unicodedata.normalize("NFKD", title).encode("ascii", "ignore").decode()
    return re.sub(r"[^A-Za-z0-9]+", "-", plain).strip("-").lower()[:40].rstrip("-")
