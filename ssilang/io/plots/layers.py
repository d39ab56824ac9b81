"""What a picture shows and how: its layers and the options of TRAC."""

from collections.abc import Callable
from dataclasses import dataclass, field

from ssilang.io.plots.labels import Annotation
from ssilang.io.plots.view import Plane
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.deformed import Arrows, displacements
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh


@dataclass(frozen=True, eq=False)
class Layer:
    """A mesh of a picture."""

    mesh: Mesh
    displacement: NodeField | None = None  # the mesh is moved by `scale` times the displacement
    scale: float = 0.0
    colour: int | None = None  # of all cells, instead of their own
    field: NodeField | CellField | None = None  # values that colour it
    component: str = ""
    arrows: Arrows | None = None
    outline: bool = False  # only the edges are drawn, over everything (a frame of reference)
    edges: bool = True  # False: a coloured layer shows its values without the edges of its cells

    def positions(self) -> FloatArray:
        """Coordinates of all nodes of the table, moved, shape (len(table), 3)."""
        table = self.mesh.nodes
        if self.displacement is None or self.scale == 0.0:
            return table.coordinates
        return table.coordinates + self.scale * displacements(self.displacement)


@dataclass(frozen=True)
class PictureOptions:
    """Options of TRAC.

    Attributes
    ----------
    hidden : bool
        Hide what lies behind (CACH).
    filled : '', 'FACE', 'FACB' or 'FSDB'
        Fill the faces, shaded in space; with white edges (FACB), these and no shades (FSDB).
    levels, level_count
        Iso-values to show, or how many.
    iso : 'SURFACE', 'LIGNE' or 'SULI'
        Filled bands, lines, or both.
    axes : (str, str)
        Stand at the sides of a picture in the plane.
    legend_name : str, optional
        Stands over the colour bar instead of the component.
    unit_of : function, optional
        What stands behind a component's name over the colour bar, '' where that is not certain.
    frame : Mesh, optional
        The picture shows its surroundings only (BOIT).
    only_colour : int, optional
        Cells of other colours are left out (COUL).
    shrink : float, optional
        Cells are drawn reduced by this ratio (ECLA).
    node_numbers, cell_numbers, point_values : bool
        Write them on the picture (NOEU, ELEM, CHAM).
    labels : tuple of (str, Mesh)
        Names written in the middle of their mesh (QUAL).
    annotation : Annotation, optional
        Categories and tags (ANNO).
    beyond : Plane, optional
        Only what lies behind the plane, seen from the eye, is drawn (COUP).
    section : Plane, optional
        Only what the plane cuts is drawn (SECT).
    bounds : array (2, 2), optional
        Lower and upper corner of the sheet, for the frames of an animation to agree.
    """

    title: str = ""
    hidden: bool = False
    filled: str = ""
    levels: FloatArray | None = None
    level_count: int | None = None
    iso: str = "SURFACE"
    axes: tuple[str, str] = ("", "")
    legend_name: str | None = None
    legend: bool = True
    unit_of: Callable[[str], str] | None = None
    frame: Mesh | None = None
    bounds: FloatArray | None = None
    only_colour: int | None = None
    shrink: float | None = None
    node_numbers: bool = False
    cell_numbers: bool = False
    point_values: bool = False
    labels: tuple[tuple[str, Mesh], ...] = ()
    date: bool = False
    notes: tuple[str, ...] = field(default_factory=tuple)
    annotation: Annotation | None = None
    beyond: Plane | None = None
    section: Plane | None = None
