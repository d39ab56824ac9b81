"""The joint elements by name, as data, and their place in the catalogue of elements.

Sides: a surface joint (RACC, LIAI) has its first half of nodes on the upper side U (structure),
its second half on the lower side L (soil); a joint of two points has L first, then U, so that
its normal goes from the first node to the second. The jump is always u_U - u_L.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.errors import MaterialError, MeshError
from ssilang.kernel.elements.catalog import (
    FRAME_MODES,
    PLANE_MODES,
    ElementKind,
    register_element,
)
from ssilang.kernel.elements.shapes.quadrature import Rule, quadrature
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Mode, Zone


@dataclass(frozen=True)
class JointElement:
    """One joint element."""

    name: str
    cell_type: str
    face: str  # cell type of one side ('POI1' for two points)
    dimension: int  # of space; the jump has as many components
    strains: tuple[str, ...]  # of the jump, shear first, normal last
    stresses: tuple[str, ...]  # of the traction
    rule: str = "GAUSS"  # 'GAUSS', or 'LOBATTO': integration at the nodes


_LINE = (("DRSN", "DRN"), ("SMSN", "SMN"))
_SURFACE = (("DRS1", "DRS2", "DRN"), ("SMS1", "SMS2", "SMN"))
_POINTS = {
    2: (("GXY", "EXX"), ("EFFY", "EFFX")),
    3: (("GXY", "GXZ", "EXX"), ("EFFY", "EFFZ", "EFFX")),
}

_SURFACES: dict[str, JointElement] = {
    e.name: e
    for e in (
        JointElement("JOI2", "RAC2", "SEG2", 2, *_LINE),
        JointElement("JOI3", "RAC3", "SEG3", 2, *_LINE),
        JointElement("JOT3", "LIA3", "TRI3", 3, *_SURFACE),
        JointElement("JOI4", "LIA4", "QUA4", 3, *_SURFACE),
        JointElement("JOT6", "LIA6", "TRI6", 3, *_SURFACE),
        JointElement("JOI8", "LIA8", "QUA8", 3, *_SURFACE),
        JointElement("JNO2", "RAC2", "SEG2", 2, *_LINE, "LOBATTO"),
        JointElement("JNO3", "RAC3", "SEG3", 2, *_LINE, "LOBATTO"),
        JointElement("JNT3", "LIA3", "TRI3", 3, *_SURFACE, "LOBATTO"),
        JointElement("JNO4", "LIA4", "QUA4", 3, *_SURFACE, "LOBATTO"),
    )
}
JOINT_NAMES = ("JOI1", *_SURFACES)


def with_rule(element: str, rule: str) -> str:
    """The joint element on the same cells that is integrated by a rule.

    Parameters
    ----------
    rule : 'GAUSS' or 'LOBATTO'

    Raises
    ------
    MeshError
        If the faces have no such rule: nodal weights of 8-node faces are negative, those of
        6-node triangles zero at the corners.
    """
    if element == "JOI1":  # one pair of points: both rules are the same
        return element
    here = _SURFACES[element]
    for other in _SURFACES.values():
        if other.cell_type == here.cell_type and other.rule == rule:
            return other.name
    told = {"element": element, "nodal_weights": NODAL_WEIGHTS}
    raise MeshError("kernel.interface.joint-cannot-integrated-nodes", **told)


def joint_element(zone: Zone) -> JointElement:
    """The joint element of a zone (JOI1 exists in 2D and 3D)."""
    if zone.element == "JOI1":
        return JointElement(
            "JOI1", "SEG2", "POI1", zone.mode.dimension, *_POINTS[zone.mode.dimension]
        )
    return _SURFACES[zone.element]


def is_joint(zone: Zone) -> bool:
    """True if the zone holds joints."""
    return zone.element in JOINT_NAMES


def register_joints() -> None:
    """Put the joints in the catalogue of elements."""
    one: dict[Support, int] = {"RIGIDITE": 1}
    register_element(ElementKind("JOI1", "SEG2", "joint", FRAME_MODES, one, False, "POI1"))
    plane = (*PLANE_MODES, Mode.AXISYMMETRIC)
    for e in _SURFACES.values():
        modes = plane if e.dimension == 2 else (Mode.THREE_DIMENSIONAL,)
        nodal = NODAL_WEIGHTS[e.face] if e.rule == "LOBATTO" else ()
        points: dict[Support, int] = {"RIGIDITE": len(nodal) or GAUSS[e.face]}
        register_element(
            ElementKind(e.name, e.cell_type, "joint", modes, points, False, e.face, nodal=nodal)
        )


# Integration points on the faces of joints: Gauss, or at the nodes.

GAUSS = {"SEG2": 2, "SEG3": 3, "TRI3": 3, "TRI6": 7, "QUA4": 4, "QUA8": 9}
"""Points by face: no jump is without stiffness."""

NODAL_WEIGHTS = {
    "SEG2": (1.0, 1.0),
    "SEG3": (1 / 3, 4 / 3, 1 / 3),
    "TRI3": (1 / 6, 1 / 6, 1 / 6),
    "QUA4": (1.0, 1.0, 1.0, 1.0),
}
"""Weights of integration at the nodes; serendipity faces have negative ones and are left out."""


def face_rule(face: str, rule: str = "GAUSS") -> Rule:
    """Points and weights on a face, by name of the rule.

    Parameters
    ----------
    rule : 'GAUSS' or 'LOBATTO'
        Gauss is the more accurate for the resultant of a partly open footing; points at the
        nodes avoid oscillating tractions where a joint is much stiffer than its neighbours.

    Raises
    ------
    MaterialError
        If the face has no such rule.
    """
    cell = REFERENCE_CELLS[face]
    if rule == "GAUSS":
        return quadrature(cell.shape, GAUSS[face])
    if rule == "LOBATTO" and face in NODAL_WEIGHTS:
        return Rule(cell.nodes, np.array(NODAL_WEIGHTS[face]))
    told = {"face": face, "rule": rule, "nodal_weights": NODAL_WEIGHTS}
    raise MaterialError("kernel.interface.joints-faces-no-integration", **told)


register_joints()
