"""MATE and CARA: fields of parameters of a model."""

from ssilang.kernel.curves.cloud import Cloud
from ssilang.kernel.elements.zone_fields import INSTEAD, zone_field
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.parameter_table import ELASTIC_SHEAR
from ssilang.kernel.interface.laws.parameter_table import check_given as check_joint
from ssilang.kernel.materials.axes import Directions, axis_parameters
from ssilang.kernel.materials.parameters import geometric_names, idle_names, known_names
from ssilang.kernel.materials.plastic.backbone import break_points, hardening_of, hyperbola
from ssilang.kernel.materials.plastic.laws import check_given, plastic_law
from ssilang.language.registry import HelpTable
from ssilang.language.search import nearest_names
from ssilang.operators.models.units import warn_of_units
from ssilang.operators.prelude import *
from ssilang.operators.vocabulary import words

Known = Callable[[Zone], tuple[str, ...]]
Value = tuple[NDArray[Any], Support]
Values = dict[str, Value]

_VALUES = (
    "FLOTTANT",
    "EVOLUTIO",
    "NUAGE",
    "MCHAML",
    "POINT",
    "CHPOINT",
    "MMODEL",
    "MAILLAGE",
    "TABLE",
    "MOT",
)
SHAPES = ("DEFO", "RIDE", "MADE")
"""Parameters of models MODAL and STATIQUE that are fields at points."""


_OUTSIDE = 0.1  # of the width of a section: a plate on a face has its middle a little outside
_AXES = (
    arg("first", "POINT", en="first axis, or centre"),
    many("others", "POINT", en="further vectors or points"),
)
_MODEL = arg("model", "MMODEL", en="model")
_PAIRS = each(
    "pairs",
    arg("name", "MOT", kind="parameter", en="parameter", distinct=True),
    arg("value", *_VALUES, en="its value", range=ANY_NUMBER),
)


def _tables(language: str) -> Sequence[HelpTable]:
    from ssilang.operators.vocabulary.law_tables import law_tables

    return law_tables(language)


@operator(
    "MATE",
    _MODEL,
    select(
        "axes",
        {"DIRECTION": _AXES, "RADIAL": _AXES},
        repeated=True,
        en="axes of orthotropy: along vectors, or from a centre",
    ),
    select(
        "turn",
        {
            "PARALLELE": [],
            "PERPENDICULAIRE": [],
            "INCLINE": [
                arg("angle", "FLOTTANT", en="angle", unit="deg", range=ANY_NUMBER),
                opt(
                    "roll",
                    "FLOTTANT",
                    default=0.0,
                    en="angle about the first axis, in mode FOUR",
                    unit="deg",
                    range=ANY_NUMBER,
                ),
            ],
        },
        en="how the axes lie to that direction",
    ),
    _PAIRS,
    family="model",
    full_name="MATERIAU",
    aliases=("MATR",),
    tables=_tables,
)
def mate(call: Call, **said: Any) -> CellField:
    """Parameters of law and section; those of joints are checked by their law."""
    return _parameters(call, material_names, True, **said)


def parameter_name(written: str, known: Collection[str]) -> str:
    """The parameter that a script means: in full where that is a known one, else four letters."""
    told = written.upper().rstrip()
    return told if told in known else told[:4]


def material_names(zone: Zone) -> tuple[str, ...]:
    """Parameters that MATE reads for a zone: with those that stand for others."""
    names = known_names(zone)
    return (*names, *(other for name, other in INSTEAD.items() if name in names))


@operator("CARA", _MODEL, _PAIRS, family="model", full_name="CARACTERISTIQUE", aliases=("CARB",))
def cara(call: Call, model: Model, pairs: list[tuple[str, Any]]) -> CellField:
    """Parameters of the section."""
    return _parameters(call, lambda zone: geometric_names(zone).all, False, model, [], None, pairs)


def _parameters(
    call: Call,
    known: Known,
    of_laws: bool,
    model: Model,
    axes: list[Chosen],
    turn: Chosen | None,
    pairs: list[tuple[str, Any]],
) -> CellField:
    given: list[Values] = [{} for _ in model.zones]
    said: dict[str, Any] = {}
    for written, value in pairs:
        said[_set_value(call, written, value, model, given, known)] = value
    for directions in axes:
        _set_axes(call, directions, turn, model, given, known)
    for zone, values in zip(model.zones, given, strict=True):
        others = {n: values[n] for n in INSTEAD.values() if n in values}
        refuse_outside(call, zone, others, said)
        tension_to_hardening(values)
        reference_to_curve(call, values, said)
    if of_laws and all(z.behaviour == ("UNILATERAL",) for z in model.zones):
        for zone, values in zip(model.zones, given, strict=True):  # what asks for no parameter
            values.setdefault("JEU", (np.zeros((len(zone.cells), 1)), "GRAVITE"))
    blocks = [b for z, v in zip(model.zones, given, strict=True) for b in _blocks(z, v)]
    if not blocks:
        raise call.error("operators.models.no-parameter", model)
    for zone, values in zip(model.zones, given, strict=True):
        if of_laws and is_joint(zone):
            check_joint(zone, {name: value for name, (value, _) in values.items()})
        refuse_outside(call, zone, values, said)
        _warn_of_nothing(call, zone, values, said)
        told = any(a.size and isinstance(a.flat[0], str) for a, _ in values.values())
        if of_laws and not told:
            check_plastic(call, zone, values, said)
        warn_of_units(call, zone, {n: (v, said[n]) for n, (v, _) in values.items() if n in said})
    return CellField(tuple(blocks), "CARACTERISTIQUES")


def refuse_outside(call: Call, zone: Zone, values: Values, said: dict[str, Any]) -> None:
    """Refuse numbers outside of the range that the vocabulary gives for a parameter."""
    for name in said:
        array = values[name][0] if name in values else np.empty(0)
        found = words.parameter(name, zone) if array.size and array.dtype == float else None
        if found is None:
            continue
        wrong = [v for v in (float(array.min()), float(array.max())) if v not in found.range]
        if wrong:
            raise call.error(
                "operators.models.parameter-range", said[name], name=name, wrong=wrong[0],
                text=found.range.text(name),
                described=words.described(found, call.session.language),
            )  # fmt: skip


def check_plastic(call: Call, zone: Zone, values: Values, said: dict[str, Any]) -> None:
    """Let a plastic law look at its parameters; refusals stand at one that they name."""
    law = None if is_joint(zone) else plastic_law(zone.behaviour)
    if law is None or zone.formulation != "MECANIQUE":
        return
    try:
        check_given(law, {name: value for name, (value, _) in values.items()})
    except MaterialError as problem:
        names = (problem.data.get("name"), *problem.names)
        at = next((said[n] for n in names if n in said), None)
        raise call.error(problem.code, at, **problem.data) from problem


def _warn_of_nothing(call: Call, zone: Zone, values: Values, said: dict[str, Any]) -> None:
    """Warn of a modulus or section of nought, which leaves a system singular where nothing else
    holds it, and of what changes nothing in the zone's mode."""
    session = call.session
    if session.in_library:
        return
    told = [(n, "operators.models.idle-parameter") for n in idle_names(zone) if n in values]
    for name in ("SECT",) if "VISQ" in values else ("YOUN", "SECT"):
        value = values[name][0] if name in values else np.empty(0)
        if value.dtype == float and (value == 0.0).any():
            told.append((name, "operators.models.no-stiffness"))
    shear = values["KS"][0] if "KS" in values else np.empty(0)
    if "FROT" in values and shear.dtype == float and (shear == 0.0).any():
        told.append(("FROT", "operators.models.friction-without-shear"))
    slip = values["FROT"][0] if "FROT" in values and ELASTIC_SHEAR in zone.behaviour else shear[:0]
    if slip.dtype == float and (slip >= 0.0).any():
        told.append(("FROT", "operators.models.friction-unread"))
    for name, code in told:
        if name in said:
            call.warn(code, said[name], name=name, mode=zone.mode.value)


def _set_value(
    call: Call, written: str, value: Any, model: Model, given: list[Values], known: Known
) -> str:
    """Put the value of a parameter into the zones that have it; its name."""
    name = parameter_name(written, tuple(n for z in model.zones for n in known(z)))
    taking = [i for i, z in enumerate(model.zones) if name in known(z)]
    if not taking:
        raise unknown_parameter(call, written, model, known)
    found = 0
    for i in taking:
        made = _values(call, model.zones[i], name, value)
        if made is not None:
            given[i][name] = made
            found += 1
    if not found:
        raise call.error("operators.models.field-not-on-model", value, name=name)
    return name


def unknown_parameter(call: Call, written: str, model: Model, known: Known) -> Exception:
    """The refusal of a name that no zone of a model has, with the near ones."""
    name = written.upper().rstrip()
    if name == "ADHE" and any(z.formulation == "CONTACT" for z in model.zones):
        return call.error("operators.models.adherence-without-equation", written)
    names = tuple(dict.fromkeys(n for z in model.zones for n in known(z)))
    near = nearest_names(name, names, 0.5)
    zone = next(z for z in model.zones if not near or near[0] in known(z))
    told = words.told_parameters(zone, near or known(zone), call.session.language)
    return call.error(
        "operators.models.parameter-unknown", written, name=name, near=near[0] if near else "",
        names=names, told="\n".join(told),
    )  # fmt: skip


def _values(call: Call, zone: Zone, name: str, value: Any) -> Value | None:
    """Values of a parameter on the cells of a zone; None if a field does not stand there."""
    n = len(zone.cells)
    if zone.formulation == "LIAISON" and not isinstance(value, float | CellField):
        return _one_object(value, n)
    if isinstance(value, Mesh | Table | str):
        refused = _no_number(call, name, value)
        if not refused.data["word"]:
            raise refused
        call.warn(refused.code, value, **refused.data)  # whoever reads it is refused
        return _one_object(value, n)
    if name in ("MODS", "MATS"):
        # Refuse what does not describe a section.
        if name == "MODS" and not isinstance(value, Model):
            raise call.error("operators.models.section-model-wrong", value)
        if name == "MODS":
            _tell_outside(call, value)
        if name == "MATS" and not isinstance(value, CellField):
            raise call.error("operators.models.section-material-wrong", value)
        return _one_object(value, n)
    if isinstance(value, Model):
        raise _no_number(call, name, value)
    if isinstance(value, CellField):
        seen = zone_field(zone, value)
        if not seen.names:
            return None
        if name not in seen.names and len(seen.names) > 1:
            raise call.error(
                "operators.models.field-has-several-components", value, name=name, names=seen.names
            )
        return seen.raw(name if name in seen.names else seen.names[0])
    if isinstance(value, NodeField) and name not in SHAPES:
        raise call.error("operators.models.parameter-is-no-nodal-field", value, name=name)
    if isinstance(value, Point | Curve | Cloud | NodeField):
        if isinstance(value, Point) and name not in ("VECT", "CGRA"):
            raise _no_number(call, name, value)
        return _one_object(value, n)
    if name == "VECT":
        raise call.error("operators.models.vect-is-a-vector", value)
    return np.full((n, 1), float(value)), "GRAVITE"


def _tell_outside(call: Call, section: Model) -> None:
    """Warn of points of a section far outside the box of its faces."""
    places = [(z.element, z.cells.coordinates.reshape(-1, 3)) for z in section.zones]
    faces = [x for element, x in places if element != "POJS"]
    for x in (x for element, x in places if element == "POJS" and faces):
        low, high = (f(np.concatenate(faces), axis=0) for f in (np.min, np.max))
        off = (np.maximum(low - x, x - high)[:, :2] / (high - low)[:2]).max(axis=1)
        if (worst := off.max()) > _OUTSIDE:
            y, z, _ = x[off.argmax()]
            call.warn("operators.models.fibre-outside", section, y=y, z=z, share=100.0 * worst)


def _no_number(call: Call, name: str, value: Any) -> SsiError:
    """The refusal of a parameter: of what a word was read past, where that is no value at all."""
    if isinstance(value, str) and call.operands and type_of(call.operands[0].value) not in _VALUES:
        value = call.required(ANY)
    word = value if isinstance(value, str) else ""
    code = "kernel.elements.parameter-not-a-number"
    return call.error(code, value, name=name, found=type_of(value), word=word, curve=False)


def _one_object(value: Any, n: int) -> Value:
    """The same object in n cells."""
    one = np.empty((1, 1), dtype=object)
    one[0, 0] = value
    return np.broadcast_to(one, (n, 1)), "GRAVITE"


def _set_axes(
    call: Call, axes: Chosen, turn: Chosen | None, model: Model, given: list[Values], known: Known
) -> None:
    taking = [i for i, z in enumerate(model.zones) if "V1X" in known(z)]
    if not taking:
        raise call.error("operators.models.no-zone-has-axes")
    vectors = [None if p is None else p.coordinates for p in (*axes["others"], None, None)]
    first, radial = axes["first"].coordinates, axes.word == "RADIAL"
    roll = float(turn["roll"]) if turn is not None and turn.word == "INCLINE" else 0.0
    if roll and any(model.zones[i].mode is not Mode.FOURIER for i in taking):
        raise call.error("operators.models.roll-in-fourier-alone", turn["roll"])  # type: ignore[index]
    told = Directions(first, vectors[0], radial, _angle(turn), vectors[1], roll)
    for i in taking:
        values, support = axis_parameters(model.zones[i], told)
        given[i].update({n: (v, support) for n, v in values.items()})


def _angle(turn: Chosen | None) -> float:
    if turn is None or turn.word == "PARALLELE":
        return 0.0
    return 90.0 if turn.word == "PERPENDICULAIRE" else float(turn["angle"])


def _blocks(zone: Zone, given: Values) -> list[CellFieldBlock]:
    """One block for each support that the values stand on."""
    supports: dict[Support, dict[str, NDArray[Any]]] = {}
    varying = [s for v, s in given.values() if v.shape[1] > 1]
    main: Support = varying[0] if varying else "GRAVITE"
    for name, (values, support) in given.items():
        place = support if values.shape[1] > 1 else main
        supports.setdefault(place, {})[name] = values
    return [zone.block(components, support) for support, components in supports.items()]


# Curves in MATE: TRAC in place of ECRO, cyclic soil by GGAM or by the strain GAMR.

_PERCENT = 1e-2
"""Shear strain at half of Gmax beyond which no soil is known: plastic clay has 5e-3."""


def reference_to_curve(
    call: Call, values: dict[str, tuple[NDArray[Any], Support]], said: dict[str, Any]
) -> None:
    """Replace GAMR by the curve GGAM that it means; look at curves that are given.

    A field of GAMR counts by its mean in each cell.

    Raises
    ------
    MaterialError
        If both are given, or for curves that no soil has.
    """
    if "GAMR" in values:
        table, _ = values.pop("GAMR")
        if "GGAM" in values:
            raise call.error("operators.models.reduction-given-twice", said["GAMR"])
        if table.dtype == object:
            raise call.error("operators.models.gamr-is-a-number", said["GAMR"])
        references = table.mean(axis=1)
        different, place = np.unique(references, return_inverse=True)
        curves = np.array([hyperbola(float(g)) for g in different], dtype=object)
        values["GGAM"] = curves[place][:, None], "GRAVITE"
        _warn_of_percent(call, said["GAMR"], float(different[-1]))
    elif "GGAM" in values:
        for curve in {id(v): v for v in values["GGAM"][0].flat}.values():
            if not isinstance(curve, Curve):
                raise MaterialError("kernel.plasticity.parameter-curve", name="GGAM")
            strains, ratios = break_points(curve)
            half = float(np.interp(-0.5, -ratios, strains))
            _warn_of_percent(call, said["GGAM"], half if ratios[-1] <= 0.5 else 0.0)


def _warn_of_percent(call: Call, value: Any, half: float) -> None:
    """Warn of strains that are percentages."""
    if half > _PERCENT:
        call.warn("operators.models.strains-in-percent", value, half=half)


def tension_to_hardening(values: dict[str, tuple[NDArray[Any], Support]]) -> None:
    """Replace TRAC by the ECRO that it means.

    Raises
    ------
    MaterialError
        If ECRO is given too, or if YOUN is missing or not one number.
    """
    if "TRAC" not in values:
        return
    table, support = values.pop("TRAC")
    if "ECRO" in values:
        raise MaterialError("operators.models.hardening-given-twice")
    young = values["YOUN"][0] if "YOUN" in values else np.empty((0, 0))
    law = young.flat[0] if young.size and all(v == young.flat[0] for v in young.flat) else None
    # a word was told, and is refused where the curve is read
    made = {id(v): v if isinstance(v, str) else _hardening(v, law) for v in table.flat}
    curves = np.empty(table.shape, dtype=object)
    for place, curve in np.ndenumerate(table):
        curves[place] = made[id(curve)]
    values["ECRO"] = curves, support


def _hardening(tension: Any, young: Any) -> Any:
    """ECRO of a curve TRAC; of a cloud of them over one field, row by row with YOUN there."""
    if isinstance(tension, Cloud) and len(tension.columns) == 2:
        (field, levels), (_, curves) = tension.columns.items()
        over = isinstance(young, Curve) and young.parts[0].abscissa_name.strip() == field
        rows = [_hardening(c, young.at(float(x)) if over else young)
                for x, c in zip(tension.numbers(field), curves, strict=True)]  # fmt: skip
        return Cloud({field: levels, "ECRO": tuple(rows)})
    if not isinstance(tension, Curve):
        raise MaterialError("operators.models.trac-is-a-curve")
    if not isinstance(young, float):
        raise MaterialError("operators.models.trac-needs-one-youn")
    return hardening_of(tension, young)
