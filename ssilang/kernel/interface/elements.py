"""The joint elements of the catalogue: sides, names of jumps and tractions, rules.

Sides: a surface joint (RACC, LIAI) has its first half of nodes on the upper side U (structure),
its second half on the lower side L (soil); a joint of two points has L first, then U, so that
its normal goes from the first node to the second. The jump is always u_U - u_L.
"""

from dataclasses import dataclass

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.catalog import ELEMENTS, NODAL_WEIGHTS
from ssilang.kernel.materials.model import Zone


@dataclass(frozen=True)
class JointElement:
    """One joint element."""

    name: str
    face: str  # cell type of one side ('POI1' for two points)
    dimension: int  # of space; the jump has as many components
    strains: tuple[str, ...]  # of the jump, shear first, normal last
    stresses: tuple[str, ...]  # of the traction


_SURFACES = {
    2: (("DRSN", "DRN"), ("SMSN", "SMN")),
    3: (("DRS1", "DRS2", "DRN"), ("SMS1", "SMS2", "SMN")),
}
_POINTS = {
    2: (("GXY", "EXX"), ("EFFY", "EFFX")),
    3: (("GXY", "GXZ", "EXX"), ("EFFY", "EFFZ", "EFFX")),
}

JOINT_NAMES = tuple(k.name for k in ELEMENTS.values() if k.family == "joint")


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
    here, at_nodes = ELEMENTS[element], rule == "LOBATTO"
    for other in (ELEMENTS[name] for name in JOINT_NAMES):
        if other.cell_type == here.cell_type and bool(other.nodal) == at_nodes:
            return other.name
    told = {"element": element, "nodal_weights": NODAL_WEIGHTS}
    raise MeshError("kernel.interface.joint-cannot-integrated-nodes", **told)


def joint_element(zone: Zone) -> JointElement:
    """The joint element of a zone."""
    face, dimension = ELEMENTS[zone.element].reference, zone.mode.dimension
    names = (_POINTS if face == "POI1" else _SURFACES)[dimension]
    return JointElement(zone.element, face, dimension, *names)


def is_joint(zone: Zone) -> bool:
    """True if the zone holds joints."""
    return zone.element in JOINT_NAMES
