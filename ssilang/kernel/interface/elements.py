"""The joint elements of the catalogue: sides, names of jumps and tractions, rules.

Sides: a surface joint (RACC, LIAI) has its first half of nodes on the upper side U (structure),
its second half on the lower side L (soil); a joint of two points has L first, then U, so that
its normal goes from the first node to the second. The jump is always u_U - u_L.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.errors import MaterialError, MeshError
from ssilang.kernel.elements.catalog import ELEMENTS, GAUSS, NODAL_WEIGHTS
from ssilang.kernel.elements.shapes.quadrature import Rule, quadrature
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
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

_SURFACES = {
    k.name: JointElement(
        k.name,
        k.cell_type,
        k.reference,
        *((3, *_SURFACE) if Mode.THREE_DIMENSIONAL in k.modes else (2, *_LINE)),
        "LOBATTO" if k.nodal else "GAUSS",
    )
    for k in ELEMENTS.values()
    if k.family == "joint" and k.name != "JOI1"
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
