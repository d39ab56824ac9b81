"""MODE: which element and which law stand on a mesh."""

import ssilang.kernel.interface.family  # noqa: F401  joints as a family of elements
from ssilang.kernel.elements.catalog import ELEMENTS, GENERIC_ELEMENTS, default_element
from ssilang.kernel.elements.springs import ELEMENT as IMPEDANCE_ELEMENTS
from ssilang.kernel.interface.elements import JOINT_NAMES, is_joint, with_rule
from ssilang.kernel.materials import behaviours
from ssilang.kernel.materials.parameters import LINKS
from ssilang.kernel.mesh.changes.local_refinement import parted
from ssilang.kernel.modal import shape_models
from ssilang.language.cast3m import IN_SCOPE
from ssilang.language.search import nearest
from ssilang.operators.dispatch import union
from ssilang.operators.models.contact import METHODS, cable_model, contact_model, sides_in
from ssilang.operators.prelude import *
from ssilang.operators.vocabulary import words

LONG_NAMES = {"BARRE": "BARR", "POUTRE": "POUT", "TUYAU": "TUYA"}
"""Elements that scripts also write in full."""

LAW_WORDS = (
    "ELASTIQUE", *behaviours.ELASTICITIES, *behaviours.JOINT_WORDS, *behaviours.PLASTIC_WORDS,
    *behaviours.OWN_LAWS, *(w for laws, _ in behaviours.OWN_LAWS.values() for w in laws),
    "IMPEDANCE", *behaviours.IMPEDANCE_LAWS,
)  # fmt: skip

OF_JOINTS = tuple(w for w in behaviours.JOINT_WORDS if w != "PLASTIQUE")
"""Words that only joints have."""


@dataclass
class Wish:
    """What a MODE statement says."""

    formulation: str = ""
    laws: list[str] = field(default_factory=list)
    elements: list[str] = field(default_factory=list)
    constituent: str = ""
    rule: str = ""
    options: dict[str, object] = field(default_factory=dict)


_WORDS = many("said", "MOT", kind="law", en="formulation, law and elements")
_SETTINGS = (
    key("constituent", "CONS", "MOT", en="constituent"),
    key(
        "section",
        "DPGE",
        "POINT",
        en="point that carries the motion of the section in generalised plane strain",
    ),
    key("layers", "INTEGRE", "ENTIER", range=POSITIVE, en="points across the thickness of shells"),
    choice("rule", ("GAUSS", "LOBATTO"), length=8, en="integration of joints"),
    choice("bound", ("LIBRE", "LIE"), en="whether the axes of JOI1 follow"),
    key("measure", "EPSI", "MOT", en="LINEAIRE or QUADRATIQUE: changes nothing"),
)
_KNOWN_LINKS = [" ".join(w) for w in LINKS]
MODE = shared("MODE", "model", full_name="MODELISER", aliases=("MODL",))


@MODE.form(
    choice(
        "formulation", ("CONTACT",), optional=False, en="two sides that do not go into each other"
    ),
    select(
        "friction",
        {
            "FROTTANT": [
                choice("law", ("COULOMB", "FROCABLE"), en="Coulomb's friction, or that of a cable")
            ]
        },
        en="friction",
    ),
    flag("smooth", "UNILATERAL", en="without friction (default)"),
    choice(
        "method",
        METHODS,
        default="MESC",
        en="nodes of the second side (default), of both, or means over its cells or nodes",
    ),
    *_SETTINGS,
)
def contact(
    call: Call,
    formulation: bool,
    friction: Chosen | None,
    smooth: bool,
    method: str,
    said: tuple[str, ...] = _WORDS,
    master: Mesh | Point = Arg("MAILLAGE", "POINT", en="first side, or the cable"),
    cables: Model | None = Opt("MMODEL", en="model of the cable"),
    slave: Mesh | None = Opt(
        "MAILLAGE", en="second side, or the body; none behind a mesh of IMPO 'MAIL'"
    ),
    **settings: Any,
) -> Model:
    """A model of two sides, or of a cable in a body."""
    if friction is not None and friction["law"] is None:
        raise call.error("operators.models.friction-law-missing")
    wish = _wish(call, ("CONTACT", *said), **settings)
    mesh, _ = _usable(call, master, wish)
    ws = workspace(call.session)
    if friction is not None and friction["law"] == "FROCABLE":
        if slave is None:
            raise call.missing(("MAILLAGE",))
        made = cable_model(call, mesh, cables, slave, ws)
    else:
        sides = sides_in(call, mesh) if slave is None else [(mesh, slave, method)]
        made = contact_model(call, sides, friction is not None, ws)
    return Model(tuple(replace(z, constituent=wish.constituent) for z in made.zones))


@MODE.form()
def link(
    call: Call,
    formulation: bool = Choice(("LIAISON",), optional=False, en="a link of DYNE"),
    kind: str = Choice(
        tuple(dict.fromkeys(w[0] for w in LINKS)), length=8, optional=False, en="kind"
    ),
    more: str | None = Choice(
        tuple(dict.fromkeys(w[1] for w in LINKS if len(w) > 1)),
        length=8,
        en="with friction, plastic ...",
    ),
    mesh: Mesh = Arg("MAILLAGE", en="its point, a cell POI1"),
) -> Model:
    """A model of links, one for each point."""
    words = (kind, more) if more else (kind,)
    if words not in LINKS:
        raise call.error("operators.models.no-such-link", words=words, known=_KNOWN_LINKS)
    if any(b.cell_type != "POI1" for b in mesh.blocks):
        raise call.error("operators.models.link-on-points", mesh)
    mode = workspace(call.session).mode
    return Model(tuple(Zone(b, "LIAISON", words, shape_models.LINK, mode) for b in mesh.blocks))


@MODE.form(*_SETTINGS)
def mode(
    call: Call,
    said: tuple[str, ...] = _WORDS,
    mesh: Mesh | Point = Arg("MAILLAGE", "POINT", en="mesh"),
    unknowns: tuple[ListMots, ...] = Many(
        "LISTMOTS", kind="component", en="unknowns of IMPEDANCE: one list, or one for each end"
    ),
    **settings: Any,
) -> Model:
    """A model: a zone for each block of the mesh."""
    ws, wish = workspace(call.session), _wish(call, said, **settings)
    if "IMPEDANCE" in wish.laws:
        names = [tuple(str(n).rstrip() for n in m.values) for m in unknowns]
        wish.options["UNKNOWNS"] = (*names, (), ())[:2]
    elif unknowns:
        raise call.error("operators.models.lists-for-impedance", unknowns[0])
    used, ties = _usable(call, mesh, wish)
    if wish.formulation == "CONTACT":
        raise call.missing(("MAILLAGE",))
    if wish.formulation == "CHARGEMENT":
        return Model(tuple(_pressure_zone(block, wish, ws) for block in used.blocks))
    if wish.formulation == "LIAISON":
        raise call.error("operators.models.no-such-link", words=said, known=_KNOWN_LINKS)
    bare = [b.cell_type for b in used.blocks if _bare_surface(b, wish, ws.mode)]
    if bare:
        call.warn("operators.models.surfaces-for-fields-alone", mesh, kinds=bare)
    zones = tuple(
        (_pressure_zone if block.cell_type in bare else _zone)(block, wish, ws)
        for block in used.blocks
    )
    if wish.rule and not any(is_joint(z) for z in zones):
        raise call.error("operators.models.rule-without-joints", rule=wish.rule)
    _check_layers(call, wish, zones)
    return Model(zones, ties)


def _wish(
    call: Call,
    said: Iterable[str],
    constituent: str | None,
    section: Point | None,
    layers: int | None,
    rule: str | None,
    bound: str | None,
    measure: str | None,
) -> Wish:
    """What words and settings say."""
    if measure is not None and measure.upper()[:4] not in ("LINE", "QUAD"):
        raise call.error("operators.models.strains-not-measured-so", measure, said=measure.upper())
    section = section or workspace(call.session).options.get("DPGE")
    given = {"DPGE": section, "INTEGRE": layers, "FRAME": bound}
    wish = Wish(
        constituent=(constituent or "").rstrip(),
        rule=rule or "",
        options={k: v for k, v in given.items() if v is not None},
    )
    for word in said:
        read_word(call, word, wish)
    return wish


def _usable(call: Call, mesh: Mesh | Point, wish: Wish) -> tuple[Mesh, tuple[CellBlock, ...]]:
    """The mesh that elements stand on, and the cells that tie hanging nodes."""
    if isinstance(mesh, Point):
        if not {"IMPEDANCE", *shape_models.UNKNOWN} & {*wish.laws}:
            raise call.error("operators.models.no-element-on-a-point", mesh)
        mesh = mesh.mesh
    if not mesh.blocks:
        raise call.error("operators.models.mesh-empty", mesh)
    if not wish.formulation and not wish.laws:
        raise call.error("operators.models.formulation-missing", mesh)
    used, ties = parted(mesh)
    if not used.blocks:
        raise call.error("operators.models.only-sure-cells")
    _check_elements(call, wish, used)
    return used, ties


def _check_elements(call: Call, wish: Wish, mesh: Mesh) -> None:
    """Refuse names of elements of which none fits the mesh; impedances have but their own."""
    kinds, own = {b.cell_type for b in mesh.blocks}, IMPEDANCE_ELEMENTS
    if "IMPEDANCE" in wish.laws and kinds <= own.keys():
        for named in (n for n in wish.elements if n not in own.values()):
            call.warn("operators.models.element-of-impedances", element=named)
        return
    fitting = [n for n in wish.elements if n in GENERIC_ELEMENTS or ELEMENTS[n].cell_type in kinds]
    if wish.elements and not fitting:
        named = wish.elements[0]
        told: dict[str, Any] = {"element": named, "cell_type": ELEMENTS[named].cell_type}
        told |= {"kinds": sorted(kinds), "fitting": _fitting(call, kinds)}
        raise call.error("operators.models.element-of-other-cells", **told)


def _check_layers(call: Call, wish: Wish, zones: tuple[Zone, ...]) -> None:
    """Plastic thin shells have 2 to 15 points across the thickness, or yield as a whole."""
    plastic = [z.element for z in zones if "PLASTIQUE" in z.behaviour]
    count = wish.options.get("INTEGRE", 2)
    if "DKT" in plastic and isinstance(count, int) and not 2 <= count <= 15:
        raise call.error("operators.models.points-across", count=count)


OTHER_ELEMENTS = (
    "BAEX", "TUFI", "LISP", "LISM", "LIA2", "LIA3", "LIA4", "LIA6", "LIA8", "JOP3", "JOP6",
    "JOP8", "JGI2", "JGI4", "JGT3", "JCI4", "JCT3", "SHB6", "TRIP", "QUAP", "CUBP", "TETP",
    "PRIP", "TRIQ", "QUAQ", "CUBQ", "ZCO2", "ZCO3", "ZCO4", "XQ4R", "XC8R", "RACO", "TRH6",
    "BBCA", "CIFL", "CAF2", "CAF3",
)  # fmt: skip
"""Elements of Cast3M that are not built."""


def read_word(call: Call, word: str, wish: Wish) -> None:
    """A formulation, a law or an element.

    Raises
    ------
    SsiError
        If it is none, or not available.
    """
    said = LONG_NAMES.get(word.upper().rstrip(), word.upper().rstrip())
    element = said if said in GENERIC_ELEMENTS else said[:4]
    if said in behaviours.OTHER_BEHAVIOURS:  # some begin as an element does: TUYAU_FISSURE
        raise _unknown(call, said)
    if (element in ELEMENTS and element != shape_models.LINK) or element in GENERIC_ELEMENTS:
        wish.elements.append(element)
    elif (law := behaviours.full_word(said, LAW_WORDS)) is not None:
        wish.laws.append(law)
    elif (formulation := behaviours.full_word(said, behaviours.FORMULATIONS)) is not None:
        wish.formulation = formulation
    elif said != "PRESSION" or wish.formulation != "CHARGEMENT":
        raise _unknown(call, said)


def _fitting(call: Call, kinds: Iterable[str]) -> list[str]:
    """The elements that stand on some cells."""
    return words.elements_on(set(kinds), workspace(call.session).mode)


def _unknown(call: Call, said: str) -> Exception:
    known = (*behaviours.FORMULATIONS, *LAW_WORDS, *ELEMENTS, *GENERIC_ELEMENTS)
    if said in behaviours.UNDESCRIBED_LAWS:
        return call.error("operators.models.joint-law-not-built", said=said)
    if said in behaviours.CHANGED_LAWS:
        raise call.error("operators.models.footing-law-not-built", said, said=said)
    if said in behaviours.UNPUBLISHED:
        names = behaviours.UNPUBLISHED[said]
        raise call.error("operators.models.law-without-equations", said, said=said, names=names)
    written = next((o.value for o in call.used[::-1] if str(o.value).upper() == said), None)
    laws = (*behaviours.ELASTICITIES, *behaviours.JOINT_WORDS, *behaviours.OWN_LAWS)
    if (other := behaviours.full_word(said, behaviours.OTHER_FORMULATIONS)) is not None:
        subject = behaviours.OTHER_FORMULATIONS[other]
        code = "operators.models.formulation-not-available"
        return call.error(
            code, written, said=other, known=behaviours.FORMULATIONS,
            outside="" if subject == IN_SCOPE else Sentence(f"help.subject-{subject}"),
        )  # fmt: skip
    if said[:4].rstrip() in OTHER_ELEMENTS:
        return call.error("operators.models.element-not-built", written, said=said)
    if (link := behaviours.full_word(said, behaviours.OTHER_LINKS)) is not None:
        kinds = tuple(dict.fromkeys(k[0] for k in LINKS))
        return call.error("operators.models.link-not-available", written, said=link, kinds=kinds)
    if behaviours.full_word(said, behaviours.OTHER_BEHAVIOURS):
        code = "operators.models.behaviour-not-available"
        return call.error(code, written, said=said, words=laws)
    near = nearest(said, known, 0.5)
    mesh = next((o.value for o in call.used if isinstance(o.value, Mesh)), None)
    element = mesh is not None and near not in (*behaviours.FORMULATIONS, *LAW_WORDS)
    kinds = sorted({b.cell_type for b in mesh.blocks}) if mesh is not None and element else []
    return call.error(
        "operators.models.word-unknown",
        written,
        said=said,
        near=near,
        known=known,
        kinds=kinds,
        fitting=_fitting(call, kinds),
    )


def _bare_surface(block: CellBlock, wish: Wish, mode: Mode) -> bool:
    """Whether cells are a surface in space for which neither a law nor an element is said."""
    surface = block.kind.dimension == 2 and not block.kind.joint
    return surface and mode is Mode.THREE_DIMENSIONAL and not (wish.laws or wish.elements)


def _zone(block: CellBlock, wish: Wish, ws: Workspace) -> Zone:
    name = _element(block, wish, ws.mode)
    kind = ELEMENTS[name]
    if ws.mode not in kind.modes:
        names = ", ".join(m.value for m in kind.modes)
        raise MeshError(
            "operators.models.element-not-in-mode", name=name, mode=ws.mode.value, names=names
        )
    options = dict(wish.options)
    if ws.mode is Mode.FOURIER:
        options["harmonic"] = ws.fourier
    behaviour = behaviours.normalised(wish.laws, kind.family)
    if kind.family == "joint" and "ANISOTROPE" in behaviour and kind.name != "JOI1":
        raise MeshError("operators.models.anisotropy-of-two-points", name=name)
    if wish.rule and kind.family == "joint":
        name = with_rule(name, wish.rule)
    constituent = wish.constituent
    if kind.family == "impedance" and not constituent:  # several may stand on one point
        said = [n for names in options["UNKNOWNS"] for n in names]  # type: ignore[attr-defined]
        constituent = " ".join((*behaviour[1:], *said))
    return Zone(block, "MECANIQUE", behaviour, name, ws.mode, constituent, options)


def _pressure_zone(block: CellBlock, wish: Wish, ws: Workspace) -> Zone:
    """Sides that carry a pressure."""
    if block.kind.dimension != ws.mode.dimension - 1 or block.kind.joint:
        raise MeshError("operators.models.cells-carry-no-pressure", cell_type=block.cell_type)
    options = {"harmonic": ws.fourier} if ws.mode is Mode.FOURIER else {}
    named = [n for n in wish.elements if ELEMENTS[n].cell_type == block.cell_type]
    element = named[0] if named else block.cell_type
    behaviour = ("PRESSION",)
    return Zone(block, "CHARGEMENT", behaviour, element, ws.mode, wish.constituent, dict(options))


def _element(block: CellBlock, wish: Wish, mode: Mode) -> str:
    """The named element that fits the cells, else the default one."""
    cell = block.cell_type
    if "IMPEDANCE" in wish.laws and cell in IMPEDANCE_ELEMENTS:
        return IMPEDANCE_ELEMENTS[cell]
    for name in wish.elements:
        if name in GENERIC_ELEMENTS:
            if cell in GENERIC_ELEMENTS[name]:
                return GENERIC_ELEMENTS[name][cell]
        elif ELEMENTS[name].cell_type == cell:
            return name
    for shape in shape_models.UNKNOWN:
        if shape in wish.laws and cell == "POI1":
            return shape
    joints = [n for n in JOINT_NAMES if ELEMENTS[n].cell_type == cell]
    if joints and (block.kind.joint or any(w in OF_JOINTS for w in wish.laws)):
        return joints[0]
    return default_element(cell, mode)


@union(("MMODEL", "MMODEL"))
def join_models(first: Model, second: Model) -> Model:
    """Zones of both, each once."""
    known = {id(z) for z in first.zones}
    ties = {id(t): t for t in (*first.ties, *second.ties)}
    zones = first.zones + tuple(z for z in second.zones if id(z) not in known)
    return Model(zones, tuple(ties.values()))
