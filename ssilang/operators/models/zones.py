"""Zones and models: sets of them, sizes of elements (TAIL), ENLE CHAN 'CONS' EXTR LIST."""

from ssilang.kernel.elements.beams.pipe import pipe_parameters
from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.catalog import BEAMS, BODY_FAMILIES, LINES, SHELLS, family_name
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.structural_gradients import names_of_gradient
from ssilang.kernel.elements.results.tensors import PRINCIPAL
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.materials.parameters import geometric_names, material_names
from ssilang.kernel.mesh.combine import cell_keys
from ssilang.kernel.mesh.queries.quality import smallest_lengths
from ssilang.kernel.statics.constitutive import variable_names
from ssilang.operators.dispatch import CHAN, DIFF, ENLE, EXTR, INTE, listing
from ssilang.operators.prelude import *

_WORD = arg("word", "MOT", en="word to remove")


@ENLE.form(
    main("model", "MMODEL", en="model"),
    select("what", {"FORM": [_WORD], "COMP": [_WORD]}, en="zones of a formulation or a behaviour"),
)
def model_without(call: Call, model: Model, what: Chosen | None) -> Model:
    """A model without some zones."""
    if what is None:
        raise call.error("operators.models.what-to-remove", model)
    said = what["word"].rstrip().upper()
    kept = tuple(
        z
        for z in model.zones
        if (z.formulation != said if what.word == "FORM" else said not in z.behaviour)
    )
    return model if len(kept) == len(model.zones) else Model(kept)


@CHAN.form(said("CONS"), of=("MMODEL",))
def change_constituent_of_model(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    constituent: str = Arg("MOT", en="its new constituent"),
) -> Model:
    """Another constituent."""
    if len({z.constituent for z in model.zones}) > 1:
        raise call.error("operators.models.several-constituents", model)
    name = constituent.rstrip()
    return Model(tuple(replace(z, constituent=name) for z in model.zones))


_NAMES: dict[str, Callable[[Zone], tuple[str, ...]]] = {
    "GEOM": lambda z: geometric_names(z).all,
    "CONT": lambda z: family_of(z).stress_names(z),
    "DEFO": lambda z: family_of(z).strain_names(z),
    "DEPL": lambda z: tuple(dict.fromkeys(family_of(z).layout(z).unknowns)),
    "FORC": lambda z: tuple(dict.fromkeys(family_of(z).layout(z).duals)),
    "GRAD": names_of_gradient,
    "GRAF": lambda z: (),
    "MATE": lambda z: material_names(z).all,
    "CONP": lambda z: PRINCIPAL if is_solid(z) else (),
    "TEMP": lambda z: ("T",),
    "VARI": variable_names,
}


_ATTRIBUTES = {"FORM": "formulation", "CONS": "constituent", "ELEM": "element"}


_NO_NAMES = ("PARA", "NLOC", "PHAS")
"""Parameters, non-local variables and phases: no law has them."""


def _chosen(call: Call, model: Model, what: Chosen) -> Model:
    """Zones that have one of the words, or behave as all of them."""
    words = [w.rstrip() for w in what["names"]]
    if what.word == "COMP":
        words = [w.upper() for w in words]
        kept = tuple(z for z in model.zones if all(w in z.behaviour for w in words))
    else:
        attribute = _ATTRIBUTES[what.word]
        kept = tuple(z for z in model.zones if getattr(z, attribute) in words)
    if not kept:
        if what.word == "COMP":
            raise call.error("operators.models.no-zone-behaves", model, words=words)
        raise call.error("operators.models.no-zone-has", model, words=words)
    return Model(kept)


def _names(kind: str, en: str) -> list[Entry]:
    return [many("names", "MOT", at_least=1, kind=kind, en=en)]


@EXTR.form(
    main("model", "MMODEL", en="model"),
    select(
        "what",
        {
            "MAIL": [flag("rubbing", "FROT", en="of contact with friction alone")],
            "ZONE": [],
            "FORM": _names("formulation", "formulations"),
            "CONS": _names("", "constituents"),
            "ELEM": _names("element", "elements"),
            "COMP": _names("law", "words of the law"),
            **{word: [] for word in (*_NO_NAMES, *_NAMES)},
        },
        optional=False,
        en="mesh, table of zones, zones that have some words, or names of components",
    ),
    gives=by(
        "what",
        {
            "MAIL": "MAILLAGE",
            "ZONE": "TABLE",
            "COMP": "MMODEL",
            **dict.fromkeys(_ATTRIBUTES, "MMODEL"),
        },
        "LISTMOTS",
    ),
)
def extr_model(call: Call, model: Model, what: Chosen) -> Mesh | Table | Model | ListMots:
    """A part of a model."""
    if what.word == "MAIL":
        if what["rubbing"]:
            model = Model(tuple(z for z in model.zones if "FROTTANT" in z.behaviour))
        return model.mesh if model.zones else Mesh(workspace(call.session).nodes, ())
    if what.word == "ZONE":
        pairs = ((Model((z,)), Mesh(z.cells.nodes, (z.cells,))) for z in model.zones)
        return Table.numbered(part for pair in pairs for part in pair)
    if what.word in _NAMES:
        names = [n for z in model.zones for n in _NAMES[what.word](z)]
        return ListMots(list(dict.fromkeys(names)))
    return ListMots() if what.word in _NO_NAMES else _chosen(call, model, what)


@listing("MMODEL")
def list_model(model: Any, short: bool, say: Teller) -> str:
    """Zones of a model, one a line."""
    lines = [say("operators.models.listed-model", count=len(model.zones))]
    for i, z in enumerate(model.zones, start=1):
        lines.append(
            say(
                "operators.models.listed-zone",
                number=i,
                count=len(z.cells),
                cell_type=z.cells.cell_type,
                element=z.element,
                words=[z.formulation, *z.behaviour],
                mode=z.mode.value,
                constituent=z.constituent,
            )
        )
    return "\n".join(lines)


def same_zone(one: Zone, other: Zone) -> bool:
    """Whether two zones put the same element and law on the same cells."""
    laws = [(z.formulation, z.behaviour, z.element, z.mode, z.constituent) for z in (one, other)]
    if laws[0] != laws[1] or one.cells.cell_type != other.cells.cell_type:
        return False
    if one.cells is other.cells:
        return True
    if len(one.cells) != len(other.cells):
        return False
    keys = [np.sort(cell_keys(z.cells)) for z in (one, other)]
    return bool((keys[0] == keys[1]).all())


def _found_in(zone: Zone, model: Model) -> bool:
    return any(same_zone(zone, other) for other in model.zones)


_FIRST = main("first", "MMODEL", en="model")
_SECOND = arg("second", "MMODEL", en="other model")


@DIFF.form()
def difference_of_models(first: Model = _FIRST, second: Model = _SECOND) -> Model:
    """Zones of one of two models only."""
    left = [z for z in first.zones if not _found_in(z, second)]
    return Model((*left, *(z for z in second.zones if not _found_in(z, first))))


@INTE.form()
def intersection_of_models(first: Model = _FIRST, second: Model = _SECOND) -> Model:
    """Common zones of two models."""
    common = tuple(z for z in first.zones if _found_in(z, second))
    if not common:
        raise MeshError("operators.models.no-common-zone")
    return Model(common)


def _depth(zone: Zone, given: ZoneField, family: str) -> FloatArray:
    """Thickness (n or 1, 1) of shells, that of the rectangle of the same gyration of beams."""
    if family in SHELLS:
        return given.at("EPAI", "GRAVITE")
    if family == "pipe":
        given = pipe_parameters(zone, given)
    names = [n for n in ("INRY", "INRZ") if n in given] or ["INRZ"]
    inertia = np.max(np.broadcast_arrays(*(given.at(n, "GRAVITE") for n in names)), axis=0)
    return np.asarray(np.sqrt(12.0 * inertia / given.at("SECT", "GRAVITE")))


@operator("TAIL", family="models", full_name="TAILLE")
def tail(
    call: Call,
    what: str | None = Choice(("DIAMETRE_MIN", "DIRECTION"), en="which size"),
    model: Model = Arg("MMODEL", en="model"),
    given: CellField | None = Opt("MCHAML", en="thickness or section of shells and beams"),
) -> CellField:
    """Smallest lengths of elements."""
    if what != "DIAMETRE_MIN":
        raise call.error("operators.models.only-diametre-min-built", model)
    blocks = []
    for zone in model.zones:
        family = family_name(zone)
        if family not in (*BODY_FAMILIES, *SHELLS, *LINES):
            raise call.error("operators.models.no-smallest-length", model, element=zone.element)
        values = {"L": smallest_lengths(zone.cells)[:, None]}
        if family in (*SHELLS, *BEAMS):
            if given is None:
                raise call.error(
                    "operators.models.bending-elements-need-section", model, element=zone.element
                )
            depth = _depth(zone, zone_field(zone, given), family)
            values["L2H"] = values["L"] ** 2 / depth
        blocks.append(CellFieldBlock(zone.cells, values, "GRAVITE", zone.element))
    return CellField(tuple(blocks), "CARACTERISTIQUES")
