"""Points, meshes and fields, as Python sees them: arrays, frames, grids."""

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.api.errors import MissingKey, refused
from ssilang.api.html import AXES, components_shown, html_of, nodes_shown
from ssilang.api.view import View, library
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.search import nearest_told

if TYPE_CHECKING:
    import pandas
    from pyvista import UnstructuredGrid
    from xarray import Dataset


class PointView(View[Point]):
    """A POINT."""

    @property
    def node(self) -> int:
        """Its node's number, from 1, as the language shows it."""
        return self.held.node + 1

    @property
    def coordinates(self) -> FloatArray:
        """Coordinates (3,)."""
        return self.held.coordinates.copy()

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        return np.asarray(self.coordinates, dtype)

    def __repr__(self) -> str:
        return f"<POINT {self.held.nodes.told(self.held.node)}>"


class MeshView(View[Mesh]):
    """A MAILLAGE.

    Examples
    --------
    >>> import ssilang
    >>> r = ssilang.run("OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (0 0) (2 0) ; M = L TRAN 1 (0 1) ;")
    >>> r["M"]
    <MAILLAGE 2 QUA4, 6 nodes>
    >>> r["M"].points[:, :2].max(axis=0), r["M"].cells["QUA4"].shape
    (array([2., 1.]), (2, 4))
    """

    @cached_property
    def nodes(self) -> IntArray:
        """Numbers of its nodes, from 1, increasing (n,)."""
        return self.held.sorted_node_ids + 1

    @property
    def points(self) -> FloatArray:
        """Coordinates of its nodes (n, 3), in the order of `nodes`."""
        return self.held.nodes.coordinates[self.nodes - 1]

    @property
    def cells(self) -> dict[str, IntArray]:
        """Rows of `points` of the cells (m, k), by type of cell."""
        found: dict[str, list[IntArray]] = {}
        for block in self.held.blocks:
            rows = np.searchsorted(self.nodes - 1, block.connectivity)
            found.setdefault(block.cell_type, []).append(rows)
        return {kind: np.concatenate(rows) for kind, rows in found.items()}

    def __len__(self) -> int:
        return self.held.n_cells

    def pyvista(self, **fields: "FieldView | CellFieldView") -> "UnstructuredGrid":
        """The mesh as an UnstructuredGrid of pyvista.

        Parameters
        ----------
        **fields
            Fields that it carries, under these names: at its points, or in its cells as means over
            their integration points. Displacements become vectors, that warp it.
        """
        from ssilang.io.vtk.grid import grid_of

        nodal = {n: f.held for n, f in fields.items() if isinstance(f, FieldView)}
        inside = {n: f.held for n, f in fields.items() if isinstance(f, CellFieldView)}
        made = grid_of(self.held, nodal, inside)
        pv = library("pyvista", self.language)
        sizes = np.diff(made.offsets, prepend=0)
        starts = made.offsets - sizes
        cells = np.insert(made.connectivity, starts, sizes)
        grid = pv.UnstructuredGrid(cells, made.types, made.points)
        for data, arrays in ((grid.point_data, made.point_data), (grid.cell_data, made.cell_data)):
            for name, array in arrays.items():
                data[name] = array.values
        return grid

    def __repr__(self) -> str:
        kinds = ", ".join(f"{len(b)} {b.cell_type}" for b in self.held.blocks)
        return f"<MAILLAGE {kinds or 'empty'}, {len(self.nodes)} nodes>"


class FieldView(View[NodeField]):
    """A CHPOINT: values at nodes, by component.

    Multipliers LX of conditions, which stand on nodes of their own, are left out beside others.

    Examples
    --------
    >>> import ssilang
    >>> r = ssilang.run("OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0 0) (4 0) ; U = 3. * (COOR 1 L) ;")
    >>> u = r["U"]
    >>> u["SCAL"], u.points[:, 0]
    (array([ 0., 12.,  6.]), array([0., 4., 2.]))
    >>> u["SCAK"]
    Traceback (most recent call last):
        ...
    ssilang.api.errors.MissingKey: error: the field has no component 'SCAK'
      = did you mean 'SCAL'?
    """

    @property
    def components(self) -> tuple[str, ...]:
        """Their names."""
        return components_shown(self.held)

    @cached_property
    def nodes(self) -> IntArray:
        """Numbers of the nodes that have a value, from 1, increasing (n,)."""
        return nodes_shown(self.held) + 1

    @property
    def points(self) -> FloatArray:
        """Coordinates of these nodes (n, 3)."""
        return self.held.table.coordinates[self.nodes - 1]

    def __getitem__(self, component: str) -> FloatArray:
        """Values of a component (n,) in the order of `nodes`, NaN where a node has none."""
        if component not in self.components:
            raise _no_component(component, self.components, self.language)
        return self.held.values_at(component, self.nodes - 1, np.nan)

    def __len__(self) -> int:
        return len(self.nodes)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        """Values (n, n_components)."""
        columns = [self[name] for name in self.components]
        found = np.column_stack(columns) if columns else np.zeros((0, 0))
        return np.asarray(found, dtype)

    def frame(self) -> "pandas.DataFrame":
        """A DataFrame: a row a node, its number as index, coordinates and components as columns."""
        made = dict(zip(AXES, self.points.T, strict=True)) | {n: self[n] for n in self.components}
        pd = library("pandas", self.language)
        return pd.DataFrame(made, index=pd.Index(self.nodes, name="node"))

    def xarray(self) -> "Dataset":
        """A Dataset over `node`, with the coordinates x, y, z."""
        return library("xarray", self.language).Dataset(
            {name: ("node", self[name]) for name in self.components},
            coords={"node": self.nodes, **node_axes(self.points)},
        )

    def _repr_html_(self) -> str:
        return html_of(self.held)

    def __repr__(self) -> str:
        return f"<CHPOINT {' '.join(self.components)}, {len(self)} nodes>"


class CellFieldView(View[CellField]):
    """A MCHAML: values at points of cells, zone by zone."""

    @property
    def components(self) -> tuple[str, ...]:
        """Their names, of all zones."""
        return tuple(dict.fromkeys(n for b in self.held.blocks for n in b.components))

    @property
    def zones(self) -> int:
        """How many zones there are."""
        return len(self.held.blocks)

    def values(self, component: str, zone: int = 1) -> FloatArray:
        """Values (n_cells, n_points) of a component in a zone, counted from 1."""
        if not 1 <= zone <= self.zones:
            raise refused(
                "api.no-such-zone", self.language, MissingKey, zone=zone, count=self.zones
            )
        block = self.held.blocks[zone - 1]
        if component not in block.components:
            raise _no_component(component, tuple(block.components), self.language)
        values = block.components[component]
        return np.broadcast_to(values, (len(block.cells), values.shape[-1])).copy()

    def __getitem__(self, component: str) -> FloatArray:
        """Values (n_cells, n_points) of the only zone that has the component."""
        having = [i for i, b in enumerate(self.held.blocks, 1) if component in b.components]
        if not having:
            raise _no_component(component, self.components, self.language)
        if len(having) > 1:
            raise refused("api.which-zone", self.language, component=component, zones=having)
        return self.values(component, having[0])

    def points(self, zone: int = 1) -> FloatArray:
        """Where the values of a zone stand (n_cells, n_points, 3)."""
        from ssilang.kernel.elements.results.supports import point_coordinates

        return point_coordinates(self.held)[zone - 1][1]

    def frame(self) -> "pandas.DataFrame":
        """A DataFrame: a row a point, by zone, cell and point; components that are numbers."""
        pd = library("pandas", self.language)
        parts = []
        for zone, block in enumerate(self.held.blocks, 1):
            numbers = {n: v for n, v in block.components.items() if v.dtype != object}
            width = max((v.shape[1] for v in numbers.values()), default=1)
            shape = (len(block.cells), width)
            cells, points = (i.ravel() + 1 for i in np.indices(shape))
            made = {n: np.broadcast_to(v, shape).ravel() for n, v in numbers.items()}
            parts.append(pd.DataFrame({"zone": zone, "cell": cells, "point": points, **made}))
        whole = pd.concat(parts) if parts else pd.DataFrame({"zone": [], "cell": [], "point": []})
        return whole.set_index(["zone", "cell", "point"])

    @property
    def mesh(self) -> MeshView:
        """Its cells."""
        blocks = tuple({id(b.cells): b.cells for b in self.held.blocks}.values())
        return MeshView(Mesh(blocks[0].nodes, blocks), self.language)

    def __repr__(self) -> str:
        cells = sum(len(b.cells) for b in self.held.blocks)
        return f"<MCHAML {self.held.title} {' '.join(self.components)}, {cells} cells>"


def node_axes(points: FloatArray) -> dict[str, tuple[str, FloatArray]]:
    """Coordinates (n, 3) as xarray takes them: x, y, z over `node`."""
    return {axis: ("node", points[:, i]) for i, axis in enumerate(AXES)}


def _no_component(name: str, known: Sequence[str], language: str) -> Exception:
    told = {"name": name, **nearest_told(name, known)}
    return refused("api.no-such-component", language, MissingKey, **told)
