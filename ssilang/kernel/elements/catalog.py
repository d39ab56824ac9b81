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


def _solid(
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


def _anywhere(name: str, cell_type: str, family: str, points: int = 1) -> ElementKind:
    return ElementKind(name, cell_type, family, tuple(Mode), {"RIGIDITE": points}, default=False)


_VOLUME = (Mode.THREE_DIMENSIONAL,)
_ROD: dict[Support, int] = {"RIGIDITE": 2, "MASSE": 3}

ELEMENTS: dict[str, ElementKind] = {
    kind.name: kind
    for kind in (
        _solid("TRI3", SECTION_MODES, 1, 3),
        _solid("TRI6", SECTION_MODES, 3, 7),
        _solid("QUA4", SECTION_MODES, 4),
        _solid("QUA8", SECTION_MODES, 9),
        *(_solid(name, SECTION_MODES, n, 3 * n) for name, n in SIDES.items()),
        _solid("Q4RI", SECTION_MODES, 1, 4, "QUA4", "one point"),
        _solid("Q8RI", SECTION_MODES, 4, 9, "QUA8"),
        _solid("TET4", _VOLUME, 1, 4),
        _solid("TE10", _VOLUME, 4, 27),
        _solid("PRI6", _VOLUME, 6),
        _solid("PR15", _VOLUME, 21),
        _solid("P15R", _VOLUME, 6, 21, "PR15"),
        _solid("PYR5", _VOLUME, 8),
        _solid("PY13", _VOLUME, 27),
        _solid("CUB8", _VOLUME, 8),
        _solid("CU20", _VOLUME, 27),
        _solid("C20R", _VOLUME, 8, 27, "CU20"),
        _solid("ICT3", SECTION_MODES, 3, 3, "TRI3", "incompressible"),
        _solid("ICT6", SECTION_MODES, 3, 7, "TRI6", "incompressible"),
        _solid("ICQ4", SECTION_MODES, 4, 4, "QUA4", "incompressible"),
        _solid("ICQ8", SECTION_MODES, 9, 9, "QUA8", "incompressible"),
        _solid("ICT4", _VOLUME, 1, 4, "TET4", "incompressible"),
        _solid("IC10", _VOLUME, 4, 27, "TE10", "incompressible"),
        _solid("ICP6", _VOLUME, 6, 6, "PRI6", "incompressible"),
        _solid("IC15", _VOLUME, 21, 21, "PR15", "incompressible"),
        _solid("ICY5", _VOLUME, 8, 8, "PYR5", "incompressible"),
        _solid("IC13", _VOLUME, 27, 27, "PY13", "incompressible"),
        _solid("ICC8", _VOLUME, 8, 8, "CUB8", "incompressible"),
        _solid("IC20", _VOLUME, 27, 27, "CU20", "incompressible"),
        ElementKind("M1D2", "SEG2", "solid", (Mode.UNIDIMENSIONAL,), {"RIGIDITE": 2}),
        ElementKind("M1D3", "SEG3", "solid", (Mode.UNIDIMENSIONAL,), {"RIGIDITE": 3}),
        ElementKind("BARR", "SEG2", "bar", FRAME_MODES, _ROD),
        ElementKind("BAR3", "SEG3", "bar", FRAME_MODES, _ROD),
        ElementKind("POI1", "POI1", "across", PLANE_MODES[2:], {"RIGIDITE": 1}, default=False),
        ElementKind("CERC", "POI1", "hoop", SECTION_MODES[-2:], {"RIGIDITE": 1}, default=False),
        ElementKind("POUT", "SEG2", "beam", FRAME_MODES, {"RIGIDITE": 2}, default=False),
        ElementKind(
            "TIMO", "SEG2", "timoshenko", FRAME_MODES, {"RIGIDITE": 1, "MASSE": 2}, default=False
        ),
        ElementKind("POJS", "POI1", "fibre", FRAME_MODES, {"RIGIDITE": 1}, default=False),
        ElementKind("TRIS", "TRI3", "fibre", FRAME_MODES, {"RIGIDITE": 3}, default=False),
        ElementKind("QUAS", "QUA4", "fibre", FRAME_MODES, {"RIGIDITE": 4}, default=False),
        ElementKind("TUYA", "SEG2", "pipe", _VOLUME, {"RIGIDITE": 2}, default=False),
        ElementKind("DKT", "TRI3", "plate", _VOLUME, {"RIGIDITE": 3}, default=False),
        ElementKind(
            "COQ3", "TRI3", "plate", _VOLUME, {"RIGIDITE": 3, "STRESSES": 1}, default=False
        ),
        ElementKind("SEG2", "SEG2", "pressure", SECTION_MODES, {"RIGIDITE": 2}, default=False),
        ElementKind("SEG3", "SEG3", "pressure", SECTION_MODES, {"RIGIDITE": 2}, default=False),
        ElementKind(
            "SHB8", "CUB8", "solid shell", _VOLUME, {"RIGIDITE": 5, "MASSE": 8}, default=False
        ),
        ElementKind("DST", "TRI3", "mindlin", _VOLUME, {"RIGIDITE": 3}, default=False),
        ElementKind("COQ4", "QUA4", "mindlin", _VOLUME, {"RIGIDITE": 4}, default=False),
        ElementKind(
            "COQ6", "TRI6", "thick", _VOLUME, {"RIGIDITE": 3, "MASSE": 7}, default=False, layers=2
        ),
        ElementKind(
            "COQ8", "QUA8", "thick", _VOLUME, {"RIGIDITE": 4, "MASSE": 9}, default=False, layers=2
        ),
        ElementKind(
            "COQ2", "SEG2", "meridian", SECTION_MODES, {"RIGIDITE": 3, "MASSE": 4}, default=False
        ),
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
        _anywhere("IMP1", "POI1", "impedance"),
        _anywhere("IMP2", "SEG2", "impedance"),
        _anywhere("MODAL", "POI1", "shape"),
        _anywhere("STATIQUE", "POI1", "shape"),
        _anywhere("LIAI", "POI1", "link"),
        _anywhere("COS2", "SEG2", "contact", 2),
        _anywhere("COT3", "TRI3", "contact", 1),
        _anywhere("COQU", "QUA4", "contact", 4),
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
