"""TYPE EXIS OUBL DETR MENA NOMM OBJE METH HERI: objects and their names."""

import gc

from ssilang.language.registry import find_operator
from ssilang.language.run.procedures import BoundMethod, call_procedure
from ssilang.language.values import Objet
from ssilang.operators.files.outputs import forbidden_path, run_output
from ssilang.operators.lists.search import equal_items
from ssilang.operators.prelude import *


@operator("TYPE", family="objects", terminal=True)
def type_word(value: Any = Arg("*", "TEXTE", en="any object")) -> Mot:
    """Name the type."""
    return Mot(type_of(value).ljust(8))


@operator(
    "EXIS",
    lead("value", en="a name, or what is searched in"),
    many(
        "wanted", en="index, component, item, name, support or words of a zone that is looked for"
    ),
    family="objects",
    full_name="EXISTE",
    gives="LOGIQUE",
    reads_itself="its first operand may be a name without object, its second any index of a table",
)
def exis(call: Call) -> Any:
    """Look for something."""
    if not call.operands:
        raise call.missing(("*",))
    operand = call.operands.pop(0)
    call.used.append(operand)
    value = operand.value
    if isinstance(value, Mot) and "%" in operand.span.text and not operand.name:
        return False  # an attribute that the object does not have
    if call.operands and call.operands[0].span.text == "*":
        call.used.append(call.operands.pop(0))
        word = str(call.required("MOT")).strip().upper()
        if word[:4] != "FICH":
            return type_of(operand.value)[:4] == word[:4]
        name = str(operand.value)
        path = run_output(call.session).source(name)
        if path is None:
            raise forbidden_path(call, name)
        return path.is_file()
    search = _SEARCHES.get(type_of(value))
    if search is None or not call.operands:
        return value is not ANNULE
    return search(call, value)


def _in_table(call: Call, table: Table) -> bool:
    operand = call.operands.pop(0)
    call.used.append(operand)
    return table.has(operand.value)


def _in_object(call: Call, holder: Objet) -> bool:
    name = call.take_name()
    return name in holder.attributes or name in holder.methods


def _in_field(call: Call, field: Any) -> bool:
    support = call.read("MAILLAGE", "MMODEL") if isinstance(field, CellField) else None
    if support is not None:
        mesh = support.value.mesh if isinstance(support.value, Model) else support.value
        wanted = {b.raw.tobytes() for b in mesh.blocks}
        return any(b.cells.raw.tobytes() in wanted for b in field.blocks)
    name = str(call.required("MOT")).rstrip()
    if isinstance(field, NodeField):
        return name in field.components
    return any(name in b.components for b in field.blocks)


def _in_words(call: Call, words: ListMots) -> Any:
    between = len(call.operands) > 1 and isinstance(call.operands[1].value, ListMots)
    word = call.keyword(("ET", "OU")) if between else None
    operand = call.needed("MOT", "LISTMOTS")
    if isinstance(operand.value, str):
        return bool(np.any(equal_items(words.values, operand.value, None, False)))
    found = [bool(np.any(equal_items(words.values, w, None, False))) for w in operand.value.values]
    word = word or call.keyword(("ET", "OU"))
    if word is None:
        return tuple(found)
    return all(found) if word == "ET" else any(found)


_ITEMS = {
    True: arg("item", "ENTIER", en="integer looked for", range=ANY_NUMBER),
    False: arg("item", "FLOTTANT", en="real looked for", range=ANY_NUMBER),
}
_TOLERANCE = opt("tolerance", "FLOTTANT", en="distance still counted as equal", range=NOT_NEGATIVE)


def _in_numbers(call: Call, values: Any) -> bool:
    item = call.given(_ITEMS[isinstance(values, ListEnti)])
    tolerance = call.given(_TOLERANCE)
    return bool(np.any(equal_items(values.values, item, tolerance, False)))


def _in_load(call: Call, load: Load) -> bool:
    said = str(call.required("MOT")).rstrip()
    kind = call.optional("MOT")
    if kind is not None:
        parts = [p for p in load.parts if p.name.rstrip() == said]
        held = [p.space if p.space is not None else p.steps[0][1] for p in parts]
        made = ["LISTOBJE" if p.steps else type_of(h) for p, h in zip(parts, held, strict=True)]
        return str(kind).strip() in made
    if said.upper() in ("LIBR", "LIBRE", "LIE"):
        return any(p.free == (said.upper() != "LIE") for p in load.parts)
    return any(p.name.rstrip() == said for p in load.parts)


def _in_model(call: Call, model: Model) -> bool:
    what = call.keyword(tuple(_OF_ZONES))
    if what is None:
        raise call.error("operators.session.what-of-the-model")
    words = {str(w).strip() for w in call.all("MOT")}
    return any(words <= set(_OF_ZONES[what](zone)) for zone in model.zones)


_OF_ZONES: dict[str, Callable[[Any], tuple[Any, ...]]] = {
    "FORM": lambda zone: (zone.formulation,),
    "CONS": lambda zone: (zone.constituent,),
    "ELEM": lambda zone: (zone.element,),
    "MATE": lambda zone: zone.behaviour,
    "NON_LOCAL": lambda zone: (),  # MODE makes none
}


def _in_solution(call: Call, solution: Any) -> bool:
    word = str(call.required("MOT")).rstrip().upper()
    return word == "CONT" and all(m.has(Mot("CONTRAINTE_MODALE")) for m in solution.modes)


_SEARCHES: dict[str, Callable[[Call, Any], Any]] = {
    "TABLE": _in_table, "OBJET": _in_object, "CHPOINT": _in_field, "MCHAML": _in_field,
    "LISTMOTS": _in_words, "LISTENTI": _in_numbers, "LISTREEL": _in_numbers,
    "CHARGEME": _in_load, "MMODEL": _in_model,
    "NUAGE": lambda call, cloud: str(call.required("MOT")).rstrip() in cloud.columns,
    "SOLUTION": _in_solution,
}  # fmt: skip


OUBL = shared("OUBL", "objects", full_name="OUBLIER")


@OUBL.form()
def _forget_index(
    table: Table = Lead("TABLE", en="table that loses an index"),
    index: Any = Lead("*", "TEXTE", en="index to forget"),
) -> None:
    table.remove(index)


@OUBL.form()
def _forget_name(session: Session, name: str = Name(en="name to forget")) -> None:
    session.frame.forget(name, hiding=find_operator(name) is not None)


@OUBL.form()
def _forget_nothing(
    call: Call,
    nameless: Any = Arg("*", "TEXTE", en="object without a name: nothing is forgotten"),
) -> None:
    call.warn("operators.session.nothing-forgotten", nameless, found=type_of(nameless))


@operator("DETR", family="objects", full_name="DETRUIRE")
def detr(objects: tuple[Any, ...] = Many("*", "TEXTE", en="objects no longer used")) -> None:
    """Accept and ignore."""


@operator("DEBU", family="objects", full_name="DEBUT")
def debu() -> None:
    """Accept and ignore."""


@operator("MENA", family="objects", full_name="MENAGE")
def mena(
    forced: bool = Flag("OBLI", en="at once"),
    ignored: tuple[Any, ...] = Many("*", "TEXTE", en="changes nothing"),
) -> None:
    """Collect garbage when it is asked for by 'OBLI'."""
    if forced:
        gc.collect()


@operator("NOMM", family="objects", full_name="NOMMER")
def nomm(
    call: Call,
    name: Any = Lead("*", "TEXTE", en="name, written or computed"),
    value: Any = Lead("*", "TEXTE", en="object that gets it"),
) -> None:
    """Assign to a computed name."""
    if not isinstance(name, Mot):
        raise call.error("operators.session.name-is-a-word", name)
    said = str(name).strip().upper()
    if not said:
        raise call.error("operators.session.empty-name", name)
    call.session.frame.assign(said[:24], value)


# ---- objects with methods -----------------------------------------------------------------------


@operator(
    "OBJE",
    arg("constructor", "PROCEDUR", en="method that makes it"),
    many("arguments", en="its arguments"),
    gives=ANY,
    family="objects",
    full_name="OBJET",
    reads_itself="the constructor reads its arguments itself",
)
def obje(call: Call) -> tuple[Any, ...]:
    """Construct an object."""
    constructor: Procedure = call.required("PROCEDUR")
    made = Objet(constructor.name)
    results = call_procedure(call.session.evaluator, BoundMethod(constructor, made), call)
    return (made, *results)


@operator("METH", family="objects", full_name="METHODE")
def meth(
    call: Call,
    holder: Objet | None = Opt("OBJET", en="object, else the present one"),
    name: str = Name(en="name of the method"),
    method: Procedure = Arg("PROCEDUR", en="what it does"),
) -> None:
    """Attach a method."""
    target = holder or call.session.frame.object
    if target is None:
        raise call.error("operators.session.no-object")
    target.methods[name] = method


@operator("HERI", family="objects", full_name="HERITE")
def heri(
    call: Call,
    objects: tuple[Objet, ...] = Many(
        "OBJET", en="heir, unless it is the present object, and whose methods it gets"
    ),
) -> None:
    """Inherit methods."""
    holder = objects[0] if len(objects) > 1 else call.session.frame.object
    if not objects or holder is None:
        raise call.error("operators.session.nothing-to-inherit")
    holder.methods.update(objects[-1].methods)
