"""What the program knows of a word: the vocabulary's meanings joined to the kernel's structure.

The kernel knows which parameters a law or an element has, on which cells it stands and what its
unknowns are; the vocabulary (`ssilang.language.vocabulary`) knows what each name means. Help,
MODE, MATE, OPTI and the checker ask here.
"""

from functools import cache

from ssilang.kernel.elements import springs
from ssilang.kernel.elements.catalog import ELEMENTS, GENERIC_ELEMENTS, family_name
from ssilang.kernel.elements.families import FAMILIES, family_of
from ssilang.kernel.elements.zone_fields import INSTEAD
from ssilang.kernel.interface.laws.law import DEFAULTS
from ssilang.kernel.interface.laws.law_table import LAWS as JOINT_LAWS
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials import behaviours
from ssilang.kernel.materials.parameters import LINKS, Names, geometric_names, material_names
from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS
from ssilang.language import vocabulary
from ssilang.language.vocabulary.terms import Option, Quantity, Word
from ssilang.messages.message import COLON
from ssilang.operators.prelude import *

UNUSED, AXES = "unused", "axes"
"""Kinds of parameters that are taken without effect, and that DIRECTION and RADIAL set."""
_LINES = 12  # of meanings in a hint


# ---- zones that stand for a law or an element ---------------------------------------------------


@cache
def sample(element: str, mode: Mode, behaviour: tuple[str, ...] = ()) -> Zone:
    """A zone of one cell, to ask what such zones have; its nodes say nothing."""
    kind = ELEMENTS[element]
    table = NodeTable()
    ids = table.add(np.zeros((CELL_TYPES[kind.cell_type].n_nodes, 1)))
    block = CellBlock.make(table, kind.cell_type, ids[None])
    said = behaviour or _USUAL.get(kind.family, ("ELASTIQUE", "ISOTROPE"))
    if kind.family == "shape":
        said = ("ELASTIQUE", element)
    options: dict[str, object] = {"DPGE": Point(table, 0)}
    formulation = _FORMULATION.get(kind.family, "MECANIQUE")
    return Zone(block, formulation, said, element, mode, "", options)


_USUAL = {
    "joint": ("ELASTIQUE",),
    "impedance": ("ELASTIQUE", "IMPEDANCE", "ELASTIQUE"),
    "contact": ("UNILATERAL",),
    "pressure": ("PRESSION",),
    "link": ("POINT_PLAN",),
}
_GROUPS = {"plastic": "PLASTIQUE", "creep": "FLUAGE", "damage": "ENDOMMAGEMENT"}
"""Words that laws of a kind stand behind."""
OF_BODIES = ("elasticity", "plastic", "creep", "damage", "joint", "impedance")
"""Kinds of laws of the formulation MECANIQUE."""
_FORMULATION = {"contact": "CONTACT", "pressure": "CHARGEMENT", "link": "LIAISON"}


def samples_of_element(element: str) -> Iterable[Zone]:
    """A zone of an element for each hypothesis that it has."""
    if element == "LIAI":
        return [sample(element, Mode.PLANE_STRAIN, words) for words in LINKS]
    laws = ((), ("ELASTIQUE", "ANISOTROPE")) if element == "JOI1" else ((),)
    modes = ELEMENTS[element].modes
    return (sample(element, mode, law) for law in laws for mode in modes)


def sample_of_law(law: Word) -> Zone | None:
    """A zone that has a law; None for words that bring no parameters of their own."""
    name, plane, space = law.name, Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL
    if law.kind == "joint" and name in JOINT_LAWS:
        own = JOINT_LAWS[name].macro or JOINT_LAWS[name].two_points
        element = "JOI1" if own else "JOI2"
        return sample(element, plane, ("ELASTIQUE", name))
    if law.kind == "plastic" and name in PLASTIC_LAWS and name != "SECTION":
        element = "POJS" if name in behaviours.UNIAXIAL_LAWS else "QUA4"
        return sample(element, plane, ("ELASTIQUE", "ISOTROPE", "PLASTIQUE", name))
    group = _GROUPS.get(law.kind, "")
    if group in behaviours.OWN_LAWS and name in behaviours.OWN_LAWS[group][0]:
        return sample("QUA4", plane, ("ELASTIQUE", "ISOTROPE", group, name))
    if law.kind == "impedance":
        return sample("IMP1", space, ("ELASTIQUE", "IMPEDANCE", name))
    if law.kind == "contact" and name in _CONTACT:
        return sample("COS2", plane, _CONTACT[name])
    if law.kind == "elasticity" and name in behaviours.ELASTICITIES:
        element = _ELASTIC_SAMPLES.get(name, "CUB8")
        return sample(element, space, ("ELASTIQUE", name))
    return None


_CONTACT = {
    "UNILATERAL": ("UNILATERAL",),
    "COULOMB": ("FROTTANT", "COULOMB"),
    "FROCABLE": ("FROTTANT", "FROCABLE"),
}
_ELASTIC_SAMPLES = {
    "ARMATURE": "BARR", "SECTION": "TIMO", "MODAL": "MODAL", "STATIQUE": "STATIQUE",
}  # fmt: skip


# ---- parameters -----------------------------------------------------------------------------


def scopes(zone: Zone) -> set[str]:
    """What the meanings of words may be limited to in a zone: element, family, law."""
    return {zone.element, family_name(zone), zone.formulation, *zone.behaviour}


def parameter(name: str, zone: Zone) -> Quantity | None:
    """What a parameter of a zone means."""
    found = vocabulary.find("parameter", name, scopes(zone))
    return found if isinstance(found, Quantity) else None


def law_names(zone: Zone) -> Names:
    """Parameters of a zone's law, with those that MATE takes in the place of others."""
    names = material_names(zone)
    others = tuple(other for name, other in INSTEAD.items() if name in names.all)
    return Names(names.required, (*names.optional, *others))


@dataclass(frozen=True, slots=True)
class Row:
    """A parameter in the table of a law or an element."""

    word: Quantity
    required: bool
    default: float | None


def parameter_rows(zone: Zone, law: bool = True, section: bool = False) -> list[Row]:
    """The parameters of a zone: of its law, of its section or thickness, required ones first."""
    taken = [law_names(zone)] if law else []
    taken += [geometric_names(zone)] if section else []
    rows = []
    for name in dict.fromkeys(n for names in taken for n in names.all):
        word = parameter(name, zone)
        if word is not None:
            rows.append(Row(word, any(name in n.required for n in taken), _default(word, zone)))
    return sorted(rows, key=lambda row: not row.required)


def _default(word: Quantity, zone: Zone) -> float | None:
    if family_name(zone) == "joint" and word.name in law_of(zone.behaviour).optional:
        return DEFAULTS.get(word.name, 0.0)
    return word.default


@cache
def owners(name: str) -> tuple[tuple[Word, Quantity], ...]:
    """The laws and elements that take a parameter, each with what it means there."""
    found = []
    for law in vocabulary.words("law"):
        zones = [sample_of_law(law)]
        if zones[0] is not None and zones[0].element == "JOI2":
            zones.append(sample("JOI1", zones[0].mode, zones[0].behaviour))
        meant = [parameter(name, z) for z in zones if z is not None and name in law_names(z).all]
        found += [(law, word) for word in dict.fromkeys(meant)]
    for element in vocabulary.words("element"):
        for zone in samples_of_element(element.name) if element.name in ELEMENTS else ():
            # laws of joints and links have many parameters alike
            own = ELEMENTS[element.name].family in ("joint", "link")
            if name in (*geometric_names(zone).all, *(law_names(zone).all if own else ())):
                found.append((element, parameter(name, zone)))
                break
    return tuple((owner, word) for owner, word in found if word is not None)


@cache
def known_parameters() -> tuple[str, ...]:
    """Every parameter that some law or element takes."""
    zones = [z for law in vocabulary.words("law") if (z := sample_of_law(law)) is not None]
    zones += [z for name in ELEMENTS for z in samples_of_element(name)]
    names = [n for z in zones for n in (*law_names(z).all, *geometric_names(z).all)]
    return tuple(dict.fromkeys(names))


# ---- elements -------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Components:
    """Names of the components that an element has under some hypotheses."""

    modes: tuple[Mode, ...]
    unknowns: tuple[str, ...]
    strains: tuple[str, ...]
    stresses: tuple[str, ...]


@cache
def components_of(element: str) -> tuple[Components, ...]:
    """Unknowns, strains and stresses of an element, hypotheses with the same ones together."""
    found: dict[tuple[tuple[str, ...], ...], list[Mode]] = {}
    for zone in samples_of_element(element):
        found.setdefault(_components(zone), []).append(zone.mode)
    return tuple(Components(tuple(modes), *names) for names, modes in found.items())


def _components(zone: Zone) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
    if springs.is_impedance(zone):
        return springs.unknowns_of(zone)[0], (), ()
    try:
        family = family_of(zone)
    except MeshError:  # sides that carry a pressure, or are in contact
        return (), (), ()
    try:
        unknowns = tuple(dict.fromkeys(family.layout(zone).unknowns))
    except FieldError:  # sections of beams have strains and no unknowns
        unknowns = ()
    return unknowns, family.strain_names(zone), family.stress_names(zone)


def elements_with(component: str) -> list[str]:
    """Elements that have a component."""
    return [
        name
        for name in ELEMENTS
        if any(component in (*c.unknowns, *c.strains, *c.stresses) for c in components_of(name))
    ]


def elements_on(cells: Collection[str], mode: Mode) -> list[str]:
    """Elements with a stiffness that stand on some cells under a hypothesis."""
    kinds = [k for k in ELEMENTS.values() if k.cell_type in cells and mode in k.modes]
    return [k.name for k in kinds if k.family in FAMILIES and k.family != "link"]


def cells_of(element: str) -> tuple[str, ...]:
    """Cells that an element stands on."""
    if element in GENERIC_ELEMENTS:
        return tuple(GENERIC_ELEMENTS[element])
    return (ELEMENTS[element].cell_type,)


def laws_of(element: str) -> tuple[str, ...]:
    """Laws that an element has, as they follow ELASTIQUE in MODE."""
    family = ELEMENTS[element].family
    laws = [name for name, families in behaviours.ELASTICITIES.items() if family in families]
    if family == "joint":
        points = [n for n, law in JOINT_LAWS.items() if law.macro or law.two_points]
        faces = element != "JOI1"
        laws += [n for n in JOINT_LAWS if n != "ELASTIQUE" and not (faces and n in points)]
    laws += [f"PLASTIQUE {n}" for n in _plastic(family)]
    for group, (own, families) in behaviours.OWN_LAWS.items():
        laws += [f"{group} {n}" for n in own if family in families]
    return tuple(laws)


def _plastic(family: str) -> tuple[str, ...]:
    if family not in behaviours.PLASTIC_FAMILIES:
        return ()
    if family in behaviours.SECTION_FAMILIES:
        return (*behaviours.SECTION_LAWS, *(("SECTION",) if family == "timoshenko" else ()))
    bodies = tuple(n for n in PLASTIC_LAWS if n not in (*behaviours.UNIAXIAL_LAWS, "SECTION"))
    bodies += behaviours.UNIAXIAL_LAWS if family in behaviours.UNIAXIAL_FAMILIES else ()
    return behaviours.FIBRE_LAWS if family == "fibre" else bodies


def elements_of_law(law: Word) -> list[str]:
    """Elements that have a law."""
    if law.kind == "contact":
        sides = [n for n, k in ELEMENTS.items() if k.family == "contact"]
        return sides if law.name in _CONTACT else []
    if law.kind == "impedance":
        return [n for n, k in ELEMENTS.items() if k.family == "impedance"]
    if law.name == "ELASTIQUE":
        return [n for n, k in ELEMENTS.items() if k.family in FAMILIES]
    said = f"{_GROUPS.get(law.kind, '')} {law.name}".lstrip()
    return [n for n in ELEMENTS if said in laws_of(n)]


# ---- lines of hints -----------------------------------------------------------------------------


def described(word: Word, language: str) -> str:
    """A meaning with its unit: "Young's modulus (Pa)"."""
    unit = word.unit if isinstance(word, Quantity) else ""
    return f"{word.meaning(language)} ({unit})" if unit else word.meaning(language)


def told_parameters(zone: Zone, names: Iterable[str], language: str) -> list[str]:
    """Lines that say what some parameters of a zone mean, those that it needs first."""
    chosen = set(names)
    rows = [r for r in parameter_rows(zone, section=True) if r.word.name in chosen]
    rows = [r for r in rows if not r.word.kind]
    return [f"{r.word.name}{COLON[language]}{described(r.word, language)}" for r in rows[:_LINES]]


def told_options(names: Iterable[str], language: str) -> list[str]:
    """Lines that say what some options of OPTI are."""
    found = [w for n in names if (w := vocabulary.find("option", n)) is not None]
    return [f"{w.name}{COLON[language]}{w.meaning(language)}" for w in found]


def told_values(option: str, words: Iterable[str], language: str) -> list[str]:
    """Lines that say what the values of an option are, where the vocabulary says it."""
    found = vocabulary.find("option", option)
    values = {v.name: v for v in found.values} if isinstance(found, Option) else {}
    colon = COLON[language]
    return [f"{n}{colon}{values[n].meaning(language)}" for n in words if n in values]
