"""The finite elements by name, as data: cells they stand on, family, integration points.

Families give the element its behaviour (see `ssilang.kernel.elements.family`).
"""

from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.shapes.polygons import SIDES
from ssilang.kernel.elements.shapes.quadrature import Rule, quadrature
from ssilang.kernel.elements.shapes.reference import (
    REFERENCE_CELLS,
    ReferenceCell,
    shape_functions,
)
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Mode, Zone

PLANE_MODES = (Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.GENERALISED_PLANE_STRAIN)
SECTION_MODES = (*PLANE_MODES, Mode.AXISYMMETRIC, Mode.FOURIER)
SOLID_FAMILIES = ("solid", "incompressible", "one point")
"""Families of continuous elements."""
BODY_FAMILIES = (*SOLID_FAMILIES, "solid shell")
"""Families whose cells fill space, with translations only."""
FLAT_SHELLS = ("plate", "mindlin")
"""Families of flat cells in space, with forces and moments of their section."""
THIN_SHELLS = ("plate", "meridian", "mindlin")
"""Families of shells with forces and moments of their section."""
SHELLS = (*THIN_SHELLS, "thick")
"""Families of shells whose nodes turn."""
STRAIGHT_BEAMS = ("beam", "timoshenko")
"""Families of beams whose section is given by its constants, or its fibres."""
CUBIC_BEAMS = ("beam", "pipe")
"""Families of beams of cubic deflection, whose forces and strains stand at their ends."""
BEAMS = (*STRAIGHT_BEAMS, "pipe")
"""Families of lines that bend."""
LINES = (*BEAMS, "bar")
"""Families of beams and bars."""
BARS = ("bar", "hoop", "across")
"""Families with a normal force alone."""
FRAME_MODES = (Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.THREE_DIMENSIONAL)


@dataclass(frozen=True, eq=False)
class ElementKind:
    """One finite element.

    Attributes
    ----------
    name : str
        Cast3M's name.
    family : str
        Key of the family table: 'solid', 'bar', 'beam', 'timoshenko', ...
    modes : tuple of Mode
        Hypotheses under which the element exists.
    points : mapping of Support to int
        Number of integration points; supports not listed have those of 'RIGIDITE'.
    default : bool
        True if MODE takes this element when none is named.
    reference : str
        Reference cell whose points carry the values, `cell_type` if empty; joints name the cell
        of one of their faces here.
    layers : int
        How often the points of 'RIGIDITE' and 'STRESSES' are repeated across a thickness.
    nodal : tuple of float
        Weights of integration at the nodes of the reference cell; empty: Gauss points.
    """

    name: str
    cell_type: str
    family: str
    modes: tuple[Mode, ...]
    points: dict[Support, int] = field(default_factory=dict)
    default: bool = True
    reference: str = ""
    layers: int = 1
    nodal: tuple[float, ...] = ()

    @property
    def reference_cell(self) -> ReferenceCell:
        """The domain on which the integration points stand."""
        return REFERENCE_CELLS[self.reference or self.cell_type]


def _element(
    name: str,
    modes: tuple[Mode, ...],
    stiffness: int,
    mass: int = 0,
    cell_type: str = "",
    family: str = "solid",
) -> ElementKind:
    points: dict[Support, int] = {"RIGIDITE": stiffness, "MASSE": mass or stiffness}
    return ElementKind(name, cell_type or name, family, modes, points, default=not cell_type)


GAUSS = {"SEG2": 2, "SEG3": 3, "TRI3": 3, "TRI6": 7, "QUA4": 4, "QUA8": 9}
"""Points by face of joints: no jump is without stiffness."""

NODAL_WEIGHTS = {
    "SEG2": (1.0, 1.0),
    "SEG3": (1 / 3, 4 / 3, 1 / 3),
    "TRI3": (1 / 6, 1 / 6, 1 / 6),
    "QUA4": (1.0, 1.0, 1.0, 1.0),
}
"""Weights of integration at the nodes; serendipity faces have negative ones and are left out."""


def _joint(name: str, cell_type: str, face: str, at_nodes: bool = False) -> ElementKind:
    plane = REFERENCE_CELLS[face].shape == "line"
    modes = (*PLANE_MODES, Mode.AXISYMMETRIC) if plane else _VOLUME
    nodal = NODAL_WEIGHTS[face] if at_nodes else ()
    points: dict[Support, int] = {"RIGIDITE": len(nodal) or GAUSS[face]}
    return ElementKind(name, cell_type, "joint", modes, points, False, face, nodal=nodal)


_VOLUME = (Mode.THREE_DIMENSIONAL,)
_ROD: dict[Support, int] = {"RIGIDITE": 2, "MASSE": 3}

ELEMENTS: dict[str, ElementKind] = {
    kind.name: kind
    for kind in (
        _element("TRI3", SECTION_MODES, 1, 3),
        _element("TRI6", SECTION_MODES, 3, 7),
        _element("QUA4", SECTION_MODES, 4),
        _element("QUA8", SECTION_MODES, 9),
        *(_element(name, SECTION_MODES, n, 3 * n) for name, n in SIDES.items()),
        _element("Q4RI", SECTION_MODES, 1, 4, "QUA4", "one point"),
        _element("Q8RI", SECTION_MODES, 4, 9, "QUA8"),
        _element("TET4", _VOLUME, 1, 4),
        _element("TE10", _VOLUME, 4, 27),
        _element("PRI6", _VOLUME, 6),
        _element("PR15", _VOLUME, 21),
        _element("P15R", _VOLUME, 6, 21, "PR15"),
        _element("PYR5", _VOLUME, 8),
        _element("PY13", _VOLUME, 27),
        _element("CUB8", _VOLUME, 8),
        _element("CU20", _VOLUME, 27),
        _element("C20R", _VOLUME, 8, 27, "CU20"),
        _element("ICT3", SECTION_MODES, 3, 3, "TRI3", "incompressible"),
        _element("ICT6", SECTION_MODES, 3, 7, "TRI6", "incompressible"),
        _element("ICQ4", SECTION_MODES, 4, 4, "QUA4", "incompressible"),
        _element("ICQ8", SECTION_MODES, 9, 9, "QUA8", "incompressible"),
        _element("ICT4", _VOLUME, 1, 4, "TET4", "incompressible"),
        _element("IC10", _VOLUME, 4, 27, "TE10", "incompressible"),
        _element("ICP6", _VOLUME, 6, 6, "PRI6", "incompressible"),
        _element("IC15", _VOLUME, 21, 21, "PR15", "incompressible"),
        _element("ICY5", _VOLUME, 8, 8, "PYR5", "incompressible"),
        _element("IC13", _VOLUME, 27, 27, "PY13", "incompressible"),
        _element("ICC8", _VOLUME, 8, 8, "CUB8", "incompressible"),
        _element("IC20", _VOLUME, 27, 27, "CU20", "incompressible"),
        ElementKind("M1D2", "SEG2", "solid", (Mode.UNIDIMENSIONAL,), {"RIGIDITE": 2}),
        ElementKind("M1D3", "SEG3", "solid", (Mode.UNIDIMENSIONAL,), {"RIGIDITE": 3}),
        ElementKind("BARR", "SEG2", "bar", FRAME_MODES, _ROD),
        ElementKind("BAR3", "SEG3", "bar", FRAME_MODES, _ROD),
        _element("POI1", PLANE_MODES[2:], 1, 0, "POI1", "across"),
        _element("CERC", SECTION_MODES[-2:], 1, 0, "POI1", "hoop"),
        _element("POUT", FRAME_MODES, 2, 0, "SEG2", "beam"),
        _element("TIMO", FRAME_MODES, 1, 2, "SEG2", "timoshenko"),
        _element("POJS", FRAME_MODES, 1, 0, "POI1", "fibre"),
        _element("TRIS", FRAME_MODES, 3, 0, "TRI3", "fibre"),
        _element("QUAS", FRAME_MODES, 4, 0, "QUA4", "fibre"),
        _element("TUYA", _VOLUME, 2, 0, "SEG2", "pipe"),
        _element("DKT", _VOLUME, 3, 0, "TRI3", "plate"),
        ElementKind(
            "COQ3", "TRI3", "plate", _VOLUME, {"RIGIDITE": 3, "STRESSES": 1}, default=False
        ),
        _element("SEG2", SECTION_MODES, 2, 0, "SEG2", "pressure"),
        _element("SEG3", SECTION_MODES, 2, 0, "SEG3", "pressure"),
        _element("SHB8", _VOLUME, 5, 8, "CUB8", "solid shell"),
        _element("DST", _VOLUME, 3, 0, "TRI3", "mindlin"),
        _element("COQ4", _VOLUME, 4, 0, "QUA4", "mindlin"),
        ElementKind(
            "COQ6", "TRI6", "thick", _VOLUME, {"RIGIDITE": 3, "MASSE": 7}, default=False, layers=2
        ),
        ElementKind(
            "COQ8", "QUA8", "thick", _VOLUME, {"RIGIDITE": 4, "MASSE": 9}, default=False, layers=2
        ),
        _element("COQ2", SECTION_MODES, 3, 4, "SEG2", "meridian"),
        ElementKind("JOI1", "SEG2", "joint", FRAME_MODES, {"RIGIDITE": 1}, False, "POI1"),
        _joint("JOI2", "RAC2", "SEG2"),
        _joint("JOI3", "RAC3", "SEG3"),
        _joint("JOT3", "LIA3", "TRI3"),
        _joint("JOI4", "LIA4", "QUA4"),
        _joint("JOT6", "LIA6", "TRI6"),
        _joint("JOI8", "LIA8", "QUA8"),
        _joint("JNO2", "RAC2", "SEG2", True),
        _joint("JNO3", "RAC3", "SEG3", True),
        _joint("JNT3", "LIA3", "TRI3", True),
        _joint("JNO4", "LIA4", "QUA4", True),
        _element("IMP1", tuple(Mode), 1, 0, "POI1", "impedance"),
        _element("IMP2", tuple(Mode), 1, 0, "SEG2", "impedance"),
        _element("MODAL", tuple(Mode), 1, 0, "POI1", "shape"),
        _element("STATIQUE", tuple(Mode), 1, 0, "POI1", "shape"),
        _element("LIAI", tuple(Mode), 1, 0, "POI1", "link"),
        _element("COS2", tuple(Mode), 2, 0, "SEG2", "contact"),
        _element("COT3", tuple(Mode), 1, 0, "TRI3", "contact"),
        _element("COQU", tuple(Mode), 4, 0, "QUA4", "contact"),
    )
}

# words that name an element of each cell type at once
GENERIC_ELEMENTS: dict[str, dict[str, str]] = {
    "BBAR": {k.cell_type: k.name for k in ELEMENTS.values() if k.family == "incompressible"},
    "POLY": {name: name for name in ("TRI3", "QUA4", *SIDES)},
}


LOCKING = {"QUA4": True, "CUB8": True, "TRI3": False, "TET4": False, "PRI6": False, "PYR5": False}
"""Elements too stiff for nearly incompressible matter; whether the mean volume change cures it."""


def family_name(zone: Zone) -> str:
    """Name of the family of a zone's element."""
    return ELEMENTS[zone.element].family


def support_shapes(element: str, support: Support) -> FloatArray:
    """Shape functions (n_points, n_nodes) of an element's reference cell at a support's points."""
    kind = ELEMENTS[element]
    return shape_functions(kind.reference or kind.cell_type, support_rule(element, support).points)


def by_cells(family: str) -> dict[str, str]:
    """The element of a family by the cells that it stands on."""
    return {k.cell_type: k.name for k in ELEMENTS.values() if k.family == family}


def default_element(cell_type: str, mode: Mode) -> str:
    """Name of the element that MODE takes for a cell type when none is named.

    Raises
    ------
    MeshError
        If an element must be named for these cells, or none exists.
    """
    fitting = [k for k in ELEMENTS.values() if k.cell_type == cell_type and mode in k.modes]
    for kind in fitting:
        if kind.default:
            return kind.name
    told = {"cell_type": cell_type, "mode": mode.value, "names": [k.name for k in fitting]}
    raise MeshError("kernel.elements.cells-no-default-element", **told)


def support_rule(element: str, support: Support) -> Rule:
    """Points where a support of an element stands, with weights.

    'NOEUD' gives the nodes and 'GRAVITE' one point; their weights serve only averages.
    """
    kind = ELEMENTS[element]
    cell = kind.reference_cell
    if support == "NOEUD" or (support == "STRESSES" and kind.family in CUBIC_BEAMS):
        n = len(cell.nodes)
        return Rule(cell.nodes, np.full(n, float(quadrature(cell.shape, 1).weights.sum()) / n))
    if support == "GRAVITE":
        return quadrature(cell.shape, 1)
    if kind.nodal:
        return Rule(cell.nodes, np.array(kind.nodal))
    count = kind.points.get(support, kind.points.get("RIGIDITE", 1))
    rule = quadrature(cell.shape, count)
    if kind.layers == 1 or support == "MASSE":
        return rule
    points, weights = np.tile(rule.points, (kind.layers, 1)), np.tile(rule.weights, kind.layers)
    return Rule(points, weights / kind.layers)
