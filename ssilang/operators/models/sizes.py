"""TAIL: sizes of the elements of a model."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.beams.pipe import pipe_parameters
from ssilang.kernel.elements.catalog import ELEMENTS, SOLID_FAMILIES
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.queries.heights import smallest_lengths
from ssilang.language.registry import Help, arg, choice, operator, opt
from ssilang.language.run.call import Call

_SHELLS = ("plate", "mindlin", "thick", "meridian")
_BEAMS = ("beam", "timoshenko", "pipe")


def _depth(zone: Zone, given: ZoneField, family: str) -> FloatArray:
    """Thickness (n or 1, 1) of shells, that of the rectangle of the same gyration of beams."""
    if family in _SHELLS:
        return given.at("EPAI", "GRAVITE")
    if family == "pipe":
        given = pipe_parameters(zone, given)
    names = [n for n in ("INRY", "INRZ") if n in given] or ["INRZ"]
    inertia = np.max(np.broadcast_arrays(*(given.at(n, "GRAVITE") for n in names)), axis=0)
    return np.asarray(np.sqrt(12.0 * inertia / given.at("SECT", "GRAVITE")))


@operator(
    "TAIL",
    choice("what", ("DIAMETRE_MIN", "DIRECTION"), en="which size"),
    arg("model", "MMODEL", en="model"),
    opt("given", "MCHAML", en="thickness or section of shells and beams"),
    family="models",
    full_name="TAILLE",
    help=Help(
        "'DIAMETRE_MIN': the smallest length of each element, at its middle, component L: "
        "between two nodes, or from a node to a side that does not hold it. It limits the time "
        "step "
        "of explicit schemes. Shells and beams have a second component L2H = L^2 / h, to which the "
        "time of bending waves is in proportion, h being the thickness of CARA1 or that of the "
        "rectangle that has the larger radius of gyration of the section.",
        "MCHAML1 = TAIL 'DIAMETRE_MIN' MODL1 (MCHAML2) ;",
        (
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 0.3) ; "
            "LIST (MINI (TAIL 'DIAMETRE_MIN' (MODE S MECANIQUE ELASTIQUE))) ;",
        ),
    ),
)
def tail(call: Call, what: str | None, model: Model, given: CellField | None) -> CellField:
    """Smallest lengths of elements."""
    if what != "DIAMETRE_MIN":
        raise call.error("operators.models.only-diametre-min-built", model)
    blocks = []
    for zone in model.zones:
        family = ELEMENTS[zone.element].family
        if family not in (*SOLID_FAMILIES, *_SHELLS, *_BEAMS, "bar"):
            raise call.error("operators.models.no-smallest-length", model, element=zone.element)
        values = {"L": smallest_lengths(zone.cells)[:, None]}
        if family in (*_SHELLS, *_BEAMS):
            if given is None:
                raise call.error(
                    "operators.models.bending-elements-need-section", model, element=zone.element
                )
            depth = _depth(zone, zone_field(zone, given), family)
            values["L2H"] = values["L"] ** 2 / depth
        blocks.append(CellFieldBlock(zone.cells, values, "GRAVITE", zone.element))
    return CellField(tuple(blocks), "CARACTERISTIQUES")
