"""Single distorted cells and fields for tests of elements."""

import numpy as np

from ssilang.kernel.base.scientific import spla
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.elements import families
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import (
    assemble,
    field_to_vector,
    numbering_of,
    vector_to_field,
)
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable

ELASTIC = ("ELASTIQUE", "ISOTROPE")
SOLIDS = [
    k.name
    for k in ELEMENTS.values()
    if k.family in ("solid", "one point") and k.cell_type[:3] != "SEG"
]
PLANE = [n for n in SOLIDS if CELL_TYPES[ELEMENTS[n].cell_type].dimension == 2]
SPACE = [n for n in SOLIDS if CELL_TYPES[ELEMENTS[n].cell_type].dimension == 3]


def corners_only(cell_type):
    """The linear cell on the corners of another."""
    linear = {"TRI6": "TRI3", "QUA8": "QUA4", "TE10": "TET4", "PR15": "PRI6", "CU20": "CUB8",
              "SEG3": "SEG2", "PY13": "PYR5"}  # fmt: skip
    return linear.get(cell_type, cell_type)


def cell_zone(element, mode, seed=1, offset=3.0, constituent=""):
    """One straight-sided distorted cell away from the axis, as a zone."""
    from ssilang.kernel.elements.shapes.reference import shape_functions

    kind = ELEMENTS[element]
    reference = REFERENCE_CELLS[kind.cell_type]
    linear = corners_only(kind.cell_type)
    corners = REFERENCE_CELLS[linear].nodes
    moves = np.random.default_rng(seed).uniform(-0.12, 0.12, corners.shape)
    d = corners.shape[1]
    shear = np.eye(d) + 0.3 * np.eye(d, k=1)
    positions = (corners + moves) @ shear.T
    positions[:, 0] += offset
    x = shape_functions(linear, reference.nodes) @ positions
    table = NodeTable()
    ids = table.add(x)
    block = CellBlock.make(table, kind.cell_type, ids[None])
    return Zone(block, "MECANIQUE", ELASTIC, element, mode, constituent)


def line_zone(element, points, mode, behaviour=ELASTIC):
    """A chain of line cells through points (n, dim)."""
    table = NodeTable()
    ids = table.add(np.asarray(points, float))
    block = CellBlock.make(table, "SEG2", np.column_stack([ids[:-1], ids[1:]]))
    return Zone(block, "MECANIQUE", behaviour, element, mode)


TILT = np.linalg.qr(np.random.default_rng(9).standard_normal((3, 3)))[0]


def tilted_plate(element, behaviour=ELASTIC):
    """Two triangles of one plane in space, the second walked the other way."""
    table = NodeTable()
    x = np.array([[0, 0, 0], [2, 0.3, 0], [1.7, 1.5, 0], [0.1, 1.2, 0]]) @ TILT.T
    ids = table.add(x)
    cells = CellBlock.make(table, "TRI3", ids[[[0, 1, 2], [0, 3, 2]]])
    return Zone(cells, "MECANIQUE", behaviour, element, Mode.THREE_DIMENSIONAL)


def material(zone, **values):
    """Constant parameters on a zone."""
    n = len(zone.cells)
    components = {k: np.full((n, 1), float(v)) for k, v in values.items()}
    block = CellFieldBlock(zone.cells, components, "GRAVITE", zone.element, zone.constituent)
    return CellField((block,), "CARACTERISTIQUES")


def model(*zones):
    """A model of these zones."""
    return Model(zones)


def field(zone, **functions):
    """A nodal field from functions of the coordinates (n, 3)."""
    table = zone.cells.nodes
    ids = np.arange(len(table))
    x = table.coordinates
    values = {k: np.broadcast_to(f(x), len(table)) for k, f in functions.items()}
    return NodeField.of(table, ids, values, "DIFFUS")


def solved(zone, given, fixed, load):
    """Displacements under nodal forces; `fixed(numbering)` says which unknowns are held."""
    K = Matrix(zone.cells.nodes, (families.stiffness(zone, given),))
    numbering = numbering_of(K)
    free = ~fixed(numbering)
    A = sp.csc_array(assemble(K, numbering))[free][:, free]
    u = np.zeros(numbering.size)
    u[free] = spla.spsolve(A, field_to_vector(load, numbering)[free])
    return vector_to_field(u, numbering)
