"""SUPE CMCT: static condensation of a body, matrices without some unknowns."""

from ssilang.kernel.matrices import superelement
from ssilang.kernel.matrices.condensation import condensed_by_relations, condensed_on_multipliers
from ssilang.kernel.matrices.submatrices import support_mesh
from ssilang.operators.dispatch import EXTR, listing
from ssilang.operators.prelude import *

SUPE = shared("SUPE", "matrix", full_name="SUPER")
_ELEMENT = arg("element", "SUPERELE", en="super-element")
_ACCEPTED = flag("alone", "NOER", en="accepted, changes nothing")


@SUPE.form(said("RIGIDITE"))
def stiffness(
    inside: bool = Flag("NOMU", en="the conditions of the matrix hold inside"),
    matrix: Matrix = Arg("RIGIDITE", en="stiffness of the body"),
    chosen: Mesh | Matrix | NodeField | Point = Arg(
        "MAILLAGE",
        "RIGIDITE",
        "CHPOINT",
        "POINT",
        en="masters: nodes, unknowns of a matrix or components of a field",
    ),
) -> superelement.SuperElement:
    """Stiffness condensed onto the masters."""
    if isinstance(chosen, Matrix | NodeField):
        return superelement.condense(matrix, chosen, inside)
    return superelement.condense(matrix, chosen.node_ids, inside)


@SUPE.form(said("CHARGE"))
def load(
    element: superelement.SuperElement = _ELEMENT,
    load: NodeField = Arg("CHPOINT", en="loads on the body"),
) -> NodeField:
    """Loads on the masters."""
    return superelement.condensed_load(element, load)


@SUPE.form(said("DEPLA"))
def displacement(
    alone: bool = _ACCEPTED,
    element: superelement.SuperElement = _ELEMENT,
    masters: NodeField = Arg("CHPOINT", en="displacement of the masters"),
    load: NodeField | None = Opt("CHPOINT", en="loads on the body"),
) -> NodeField:
    """Displacement of the whole body."""
    return superelement.inner_displacement(element, masters, load)


@SUPE.form(said("MASSE"), gives=by("shapes", {True: ("LISTCHPO", "RIGIDITE")}, "RIGIDITE"))
def mass(
    shapes: bool = Flag("LCHP", en="the displacement for a unit of each master first"),
    element: superelement.SuperElement = _ELEMENT,
    mass: Matrix = Arg("RIGIDITE", en="mass of the body"),
) -> Matrix | tuple[ListChpo, Matrix]:
    """Mass that the masters feel."""
    made = superelement.condensed_mass(element, mass)
    return (ListChpo(tuple(superelement.shape_fields(element))), made) if shapes else made


_PARTS: dict[str, Callable[[superelement.SuperElement], Matrix | Mesh]] = {
    "RIGI": lambda element: element.stiffness,
    "RIGT": lambda element: element.source,
    "BLOQ": lambda element: Matrix(element.source.table, (), element.source.relations),
    "ELEM": lambda element: support_mesh(element.stiffness),
}


@EXTR.form(gives=by("what", {"ELEM": "MAILLAGE"}, "RIGIDITE"))
def extract_from_superelement(
    call: Call,
    element: superelement.SuperElement = Main("SUPERELE", en="super-element"),
    what: str | None = Choice(
        tuple(_PARTS), en="condensed stiffness, stiffness, conditions or mesh of the masters"
    ),
) -> Matrix | Mesh:
    """A part of a super-element."""
    if what is None:
        raise call.error("operators.matrices.extr-of-superele-wants-word", element, words=_PARTS)
    return _PARTS[what](element)


@listing("SUPERELE")
def _listed(element: superelement.SuperElement, short: bool, say: Teller) -> str:
    masters = len(element.masters)
    inner = element.numbering.size - masters
    return say("operators.matrices.super-element", masters=masters, inner=inner)


@operator("CMCT", family="matrix")
def cmct(
    matrix: Matrix = Arg("RIGIDITE", en="relations C"),
    diagonal: NodeField = Arg("CHPOINT", en="M^-1"),
) -> Matrix:
    """On the multipliers."""
    return condensed_on_multipliers(matrix, diagonal)


@cmct.form()
def cmct_of_matrix(
    matrix: Matrix = Arg("RIGIDITE", en="matrix"),
    relations: Matrix = Arg(
        "RIGIDITE", en="relations, or the first matrix that CHAN 'COND' makes of them"
    ),
) -> Matrix:
    """On the unknowns that stay."""
    return condensed_by_relations(matrix, relations)
