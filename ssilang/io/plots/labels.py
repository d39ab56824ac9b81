"""Annotations of pictures (ANNO): categories beside the drawing, tags at points.

Numbers written by a Fortran edit descriptor: '(F5.1)', '(I4)', '(1PE12.5)', '(G10.2)'.
"""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ssilang.io.errors import OutputError
from ssilang.io.plots.markup import to_mathtext
from ssilang.io.plots.palette import shade
from ssilang.io.plots.view import View
from ssilang.kernel.mesh.mesh import Point

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


# where a tag stands, seen from its point, and how its text is then aligned
PLACES: dict[str, tuple[float, float]] = {
    "SO": (-1, -1), "S": (0, -1), "SE": (1, -1), "O": (-1, 0), "C": (0, 0), "E": (1, 0),
    "NO": (-1, 1), "N": (0, 1), "NE": (1, 1),
}  # fmt: skip
_ALONG = {-1: "right", 0: "center", 1: "left"}
_UP = {-1: "top", 0: "center", 1: "bottom"}


@dataclass(frozen=True)
class Category:
    """A colour and what it stands for."""

    colour: int
    text: str


@dataclass(frozen=True)
class Tag:
    """A text at a point.

    `place` is a key of `PLACES`; `distance` from the point in hundredths of the picture's size
    (None: usual); `link` draws a line from the point to the text.
    """

    point: Point
    text: str
    colour: int = 0
    place: str = "NE"
    distance: float | None = None
    link: bool = True


@dataclass(frozen=True)
class Annotation:
    """Categories and tags of a picture (ANNOTATI)."""

    categories: tuple[Category, ...] = ()
    tags: tuple[Tag, ...] = ()

    def joined(self, other: "Annotation") -> "Annotation":
        """Both together."""
        return Annotation(self.categories + other.categories, self.tags + other.tags)


def draw_tags(axes: "Axes", view: View, annotation: Annotation, size: float) -> None:
    """Write the tags of a panel."""
    for tag in annotation.tags:
        x, y = view.project(tag.point.coordinates)
        right, up = PLACES[tag.place]
        usual = 0.05 * size if tag.distance is None else tag.distance
        reach = usual if right or up else 0.0
        place: Any = (x + right * reach, y + up * reach)
        line = {"arrowstyle": "-", "color": shade(tag.colour, ink=True), "lw": 0.8, "shrinkB": 0}
        axes.annotate(
            to_mathtext(tag.text),
            (float(x), float(y)),
            place,
            color=shade(tag.colour, ink=True),
            fontsize=9,
            ha=_ALONG[int(right)],
            va=_UP[int(up)],
            arrowprops=line if tag.link and reach else None,
            zorder=6,
            bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.7},
        )


def draw_categories(figure: "Figure", annotation: Annotation) -> None:
    """Write the categories as a legend on the right of a picture."""
    from matplotlib.patches import Patch

    if annotation.categories:
        figure.legend(
            handles=[
                Patch(facecolor=shade(c.colour), label=to_mathtext(c.text))
                for c in annotation.categories
            ],
            loc="outside right upper",
            frameon=False,
        )


_DESCRIPTOR = re.compile(r"\(?\s*(?:1P)?([IFEDG])(\d+)(?:\.(\d+))?(?:E\d+)?\s*\)?$", re.IGNORECASE)


def formatted(descriptor: str, value: float) -> str:
    """`value` as the descriptor writes it, without leading blanks.

    Raises
    ------
    OutputError
        For a descriptor that is not one of I, F, E, D, G.
    """
    match = _DESCRIPTOR.match(descriptor.strip())
    if match is None:
        raise OutputError("io.no-number-format", descriptor=descriptor)
    kind = match.group(1).upper()
    digits = int(match.group(3) or 0)
    if kind == "I":
        return str(round(value))
    if kind == "F":
        return f"{value:.{digits}f}"
    if kind == "G":
        return f"{value:.{max(digits, 1)}G}"
    return f"{value:.{digits}E}"
