"""ENTI FLOT BORN MASQ BRUI: conversions, bounds, masks, random values."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.io.plots.palette import index_of
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.registry import (
    Chosen,
    Entry,
    Help,
    Like,
    arg,
    by,
    choice,
    each,
    either,
    flag,
    group,
    key,
    main,
    operator,
    opt,
    select,
    shared,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, ListMots, ListReel
from ssilang.operators.numbers.functions import mapped
from ssilang.operators.workspace import workspace


def nearest(x: Any) -> Any:
    """Nearest integer; halves go away from zero."""
    return np.sign(x) * np.floor(np.abs(x) + 0.5)


_ROUNDINGS: dict[str, Callable[[Any], Any]] = {
    "TRONCATURE": np.trunc, "INFERIEUR": np.floor, "SUPERIEUR": np.ceil, "PROCHE": nearest,
}  # fmt: skip


def number_in(call: Call, word: str) -> float:
    """The number that a word says, in any usual way of writing it."""
    try:
        return float(str(word).strip().upper().replace("D", "E"))
    except ValueError:
        raise call.error("operators.numbers.not-number", word, word=word) from None


def _whole(call: Call, values: Any) -> Any:
    if np.any(~np.isfinite(values)) or np.any(np.abs(values) >= 2.0**63):
        raise call.error("operators.numbers.integer-too-large")
    return values.astype(np.int64)


@operator(
    "ENTI",
    choice(
        "way",
        tuple(_ROUNDINGS),
        default="TRONCATURE",
        en="cut, below, above or nearest",
        fr="tronqué, en dessous, au-dessus ou le plus proche",
    ),
    arg(
        "value",
        "ENTIER",
        "FLOTTANT",
        "LISTREEL",
        "LISTENTI",
        "CHPOINT",
        "LISTMOTS",
        "MOT",
        en="numbers, or words that say them",
        fr="nombres, ou mots qui les disent",
    ),
    gives="ENTIER|LISTENTI|CHPOINT",
    family="numbers",
    full_name="ENTIER",
    help=Help(
        en="Integer of a real, of each item of a list or value of a field, or written in a word: "
        "cut ('TRONCATURE', by default), below ('INFERIEUR'), above ('SUPERIEUR'), nearest "
        "('PROCHE').",
        fr="Entier d'un réel, de chaque élément d'une liste ou valeur d'un champ, ou écrit dans un "
        "mot : tronqué ('TRONCATURE', par défaut), en dessous ('INFERIEUR'), au-dessus "
        "('SUPERIEUR'), le plus proche ('PROCHE').",
        syntax="OBJ2 = ENTI ('TRONCATURE' | 'INFERIEUR' | 'SUPERIEUR' | 'PROCHE') OBJ1 ;",
        examples=("LIST (ENTI 'PROCHE' -3.5) ;", "LIST (ENTI (PROG 1.2 2.7)) ;"),
    ),
)
def enti(call: Call, way: str, value: Any) -> Any:
    """Round."""
    rounding = _ROUNDINGS[way]
    if isinstance(value, NodeField):
        return node_algebra.applied(value, rounding)
    if isinstance(value, str):
        value = number_in(call, value)
    elif isinstance(value, ListMots):
        value = ListReel([number_in(call, w) for w in value.values])
    if isinstance(value, int | float):
        return int(_whole(call, np.asarray(rounding(float(value)))))
    return ListEnti(_whole(call, rounding(value.values.astype(float))))


@operator(
    "FLOT",
    arg(
        "value",
        "FLOTTANT",
        "LISTREEL",
        "LISTENTI",
        "LISTMOTS",
        "MOT",
        en="numbers, or words that say them",
        fr="nombres, ou mots qui les disent",
    ),
    gives="FLOTTANT|LISTREEL",
    family="numbers",
    full_name="FLOTTANT",
    help=Help(
        en="Real of an integer, of each item of a list, or written in a word.",
        fr="Réel d'un entier, de chaque élément d'une liste, ou écrit dans un mot.",
        syntax="OBJ2 = FLOT OBJ1 ;",
        examples=("LIST (FLOT 3) ;", "LIST (FLOT '-1.5E2') ;"),
    ),
)
def flot(call: Call, value: Any) -> Any:
    """Convert to reals."""
    if isinstance(value, str):
        return number_in(call, value)
    if isinstance(value, ListMots):
        return ListReel([number_in(call, w) for w in value.values])
    return value if isinstance(value, float) else ListReel(value.values)


# ---- MASQ ---------------------------------------------------------------------------------------

_TESTS: dict[str, Callable[[Any, Any], Any]] = {
    "SUPERIEUR": np.greater, "EGSUPE": np.greater_equal, "EGALE": np.equal,
    "EGINFE": np.less_equal, "INFERIEUR": np.less, "DIFFERENT": np.not_equal,
}  # fmt: skip
_LIMITS = {
    "CHPOINT": ("FLOTTANT", "CHPOINT"),
    "MCHAML": ("FLOTTANT", "MCHAML"),
    "LISTREEL": ("FLOTTANT", "LISTREEL", "LISTENTI"),
    "LISTENTI": ("ENTIER", "FLOTTANT", "LISTENTI"),
}
"""What the values of an object may be compared with, by its type."""

MASQ = shared(
    "MASQ",
    "numbers",
    Help(
        en="Ones where a relation with a number, or with the values of an object of the same "
        "kind, is met, zeros elsewhere; with 'SOMME' their number. 'EXISTE' tells where a field "
        "in cells has a component.",
        fr="Des 1 où une relation avec un nombre, ou avec les valeurs d'un objet de même nature, "
        "est vérifiée, des 0 ailleurs ; avec 'SOMME' leur nombre. 'EXISTE' dit où un champ par "
        "éléments a une composante.",
        syntax="OBJ2 = OBJ1 MASQ 'SUPERIEUR' | 'EGSUPE' | 'EGALE' | 'EGINFE' | 'INFERIEUR' | "
        "'DIFFERENT' ('SOMME') X1 | OBJ3 ;\n"
        "OBJ2 = OBJ1 MASQ 'COMPRIS' ('SOMME') X1 X2 | OBJ3 OBJ4 ;\n"
        "OBJ2 = OBJ1 MASQ 'EXISTE' (MOT1) ;",
        examples=("LIST (MASQ (PROG 1. 5. 9.) 'SUPERIEUR' 4.) ;",),
    ),
    full_name="MASQUE",
)


def _test_of(*limits: str) -> tuple[Entry, ...]:
    """The relation, with what the values are compared with."""
    limit = arg("limit", *limits, en="value to compare with", fr="valeur de comparaison")
    return (
        select(
            "test",
            {
                **{word: [limit] for word in _TESTS},
                "COMPRIS": [
                    arg("low", *limits, en="lower bound", fr="borne inférieure"),
                    arg("high", *limits, en="upper bound", fr="borne supérieure"),
                ],
                "EXISTE": [
                    opt("component", "MOT", en="component", fr="composante", kind="component")
                ],
            },
            optional=False,
            en="relation",
            fr="relation",
        ),
        flag("counted", "SOMM", en="number of ones", fr="nombre de uns"),
    )


def _masked(call: Call, value: Any, test: Chosen, counted: bool) -> Any:
    if test.word == "EXISTE":
        return _existing(call, value, test["component"])
    if test.word == "COMPRIS":
        above = _tested(value, test["low"], np.greater_equal)
        made = _times(above, _tested(value, test["high"], np.less_equal))
    else:
        made = _tested(value, test["limit"], _TESTS[test.word])
    return _count(made) if counted else made


for _kind, _limits in _LIMITS.items():
    MASQ.form(
        main("value", _kind, en="values to test", fr="valeurs à tester"),
        *_test_of(*_limits),
        gives=by("counted", {True: "ENTIER"}, _kind),
    )(_masked)


def _tested(value: Any, other: Any, test: Callable[[Any, Any], Any]) -> Any:
    if isinstance(other, int | float):
        return mapped(lambda x: test(x, other).astype(x.dtype), value)
    if isinstance(value, NodeField):
        made = {
            k: type(v)(v.nodes, test(v.values, other.values_at(k, v.nodes)).astype(float))
            for k, v in value.components.items()
        }
        return node_algebra.rebuilt(value, made)
    if isinstance(value, CellField):
        gap = cell_algebra.added(value, other, -1.0)
        return cell_algebra.applied(gap, lambda x: test(x, 0.0).astype(float))
    if len(value) != len(other):
        from ssilang.kernel.base.errors import KernelError

        raise KernelError("operators.numbers.list-lengths", n_first=len(value), n_second=len(other))
    return type(value)(test(value.values, other.values))


def _times(a: Any, b: Any) -> Any:
    if isinstance(a, NodeField):
        return node_algebra.multiplied(a, b)
    if isinstance(a, CellField):
        return cell_algebra.multiplied(a, b)
    return type(a)(a.values * b.values)


def _count(made: Any) -> int:
    if isinstance(made, NodeField):
        return int(sum(v.values.sum() for v in made.components.values()))
    if isinstance(made, CellField):
        return int(sum(v.sum() for v in cell_algebra.values_of(made)))
    return int(made.values.sum())


def _existing(call: Call, value: Any, component: str | None) -> CellField:
    if not isinstance(value, CellField):
        raise call.error("operators.numbers.existence-of-cells", value)
    name = None if component is None else str(component).rstrip()
    blocks = []
    for block in value.blocks:
        shape = max((v.shape for v in block.components.values()), default=(len(block.cells), 1))
        if name is None:
            made = {k: np.ones(v.shape) for k, v in block.components.items()}
        else:
            made = {name: np.full(shape, float(name in block.components))}
        blocks.append(cell_algebra.rebuilt(block, made))
    return CellField(tuple(blocks), value.title)


# ---- BORN ---------------------------------------------------------------------------------------


BORN = shared(
    "BORN",
    "numbers",
    Help(
        en="Values cut at an upper bound ('MAXIMUM'), a lower one ('MINIMUM') or both ('COMPRIS'). "
        "Of a field, component by component; of curves, curve by curve: those named are kept.",
        fr="Valeurs bornées en haut ('MAXIMUM'), en bas ('MINIMUM') ou des deux côtés ('COMPRIS'). "
        "D'un champ, composante par composante ; d'évolutions, courbe par courbe : celles qui "
        "sont nommées sont gardées.",
        syntax="OBJ2 = BORN OBJ1 ((MOT1 | N1) 'MAXIMUM' X2 | 'MINIMUM' X1 | 'COMPRIS' X1 X2) ... ;",
        examples=("LIST (BORN (PROG -1. 0.5 3.) 'COMPRIS' 0. 1.) ;",),
    ),
    full_name="BORNER",
)
_HIGH = arg("high", "ENTIER", "FLOTTANT", en="upper bound", fr="borne supérieure")
_LOW = arg("low", "ENTIER", "FLOTTANT", en="lower bound", fr="borne inférieure")
_BOUND = select(
    "bound",
    {"MAXIMUM": [_HIGH], "MINIMUM": [_LOW], "COMPRIS": [_LOW, _HIGH]},
    optional=False,
    en="bounds of the values",
    fr="bornes des valeurs",
)


def _ends(bound: Chosen) -> tuple[float, float]:
    return bound.values.get("low", -np.inf), bound.values.get("high", np.inf)


@BORN.form(
    main("value", "LISTENTI", "LISTREEL", en="list", fr="liste"), _BOUND, gives=Like("value")
)
def _clipped_list(value: ListEnti | ListReel, bound: Chosen) -> Any:
    return type(value)(np.clip(value.values, *_ends(bound)))


@BORN.form(
    main("value", "EVOLUTIO", en="curves", fr="évolutions"),
    each(
        "bounds",
        opt("curve", "ENTIER", en="number of a curve, 1 if none", fr="numéro de courbe, 1 sinon"),
        _BOUND,
        at_least=1,
    ),
)
def _clipped_curves(call: Call, value: Curve, bounds: list[tuple[int | None, Chosen]]) -> Curve:
    return _clipped_curve(call, value, [(who, *_ends(bound)) for who, bound in bounds])


@BORN.form(
    main("value", "CHPOINT", "MCHAML", en="field", fr="champ"),
    each(
        "bounds",
        either(
            "one",
            group("only", _BOUND),
            group(
                "named",
                arg("component", "MOT", en="component", fr="composante", kind="component"),
                _BOUND,
            ),
        ),
        at_least=1,
    ),
    gives=Like("value"),
)
def _clipped_fields(call: Call, value: NodeField | CellField, bounds: list[Chosen]) -> Any:
    wanted = []
    for one in bounds:
        name = one.values.get("component")
        who = None if name is None else str(name).rstrip()
        wanted.append((who, *_ends(one["bound"])))
    return _clipped_field(call, value, wanted)


def _clipped_curve(call: Call, value: Curve, wanted: list[tuple[Any, float, float]]) -> Curve:
    parts: list[CurvePart] = []
    for who, low, high in wanted:
        place = 1 if who is None else who
        if not 1 <= place <= len(value.parts):
            raise call.error(
                "operators.numbers.no-such-curve", n_parts=len(value.parts), place=place
            )
        part = value.parts[place - 1]
        parts.append(
            CurvePart(
                part.abscissas,
                np.clip(part.ordinates, low, high),
                part.abscissa_name,
                part.ordinate_name,
                part.legend,
                part.colour,
            )
        )
    return Curve(tuple(parts), value.title, value.kind)


def _clipped_field(call: Call, value: Any, wanted: list[tuple[Any, float, float]]) -> Any:
    node = isinstance(value, NodeField)
    names = list(value.components) if node else cell_algebra.component_names(value)
    made = None
    for who, low, high in wanted:
        if who is None and len(names) != 1:
            raise call.error("operators.numbers.which-component", names=names)
        name = names[0] if who is None else who

        def clip(x: Any, low: float = low, high: float = high) -> Any:
            return np.clip(x, low, high)

        if node:
            only = node_algebra.rebuilt(value, {name: node_algebra.component(value, name)})
            part: Any = node_algebra.applied(only, clip)
            made = part if made is None else node_algebra.united(made, part)
        else:
            part = cell_algebra.applied(cell_algebra.extracted(value, [name], [name]), clip)
            made = part if made is None else cell_algebra.united(made, part)
    return made


# ---- BRUI ---------------------------------------------------------------------------------------


def session_generator(call: Call, skip: int | None) -> np.random.Generator:
    """The session's generator; `skip` starts it again, that many terms further."""
    options = workspace(call.session).options
    found = options.get("RANDOM GENERATOR")
    if found is None or skip is not None:
        found = np.random.default_rng(1)
        if skip is not None and skip < 0:
            raise call.error("operators.numbers.negative-skip", skip, skip=skip)
        if skip:
            found.random(skip)
        options["RANDOM GENERATOR"] = found
    generator: np.random.Generator = found
    return generator


BRUI = shared(
    "BRUI",
    "numbers",
    Help(
        en="Random values without correlation: Gauss (mean, deviation), uniform (mean, half "
        "width), exponential; as a list, a curve over given times or a field on a mesh; Poisson as "
        "a list of integers. A run repeated gives the same values; a last integer skips terms.",
        fr="Valeurs aléatoires non corrélées : gaussiennes (moyenne, écart-type), uniformes "
        "(moyenne, amplitude), exponentielles ; en liste, en évolution ou en champ ; Poisson en "
        "liste d'entiers. Un calcul répété redonne les mêmes ; un dernier entier saute des termes.",
        syntax="OBJ1 = BRUI 'BLAN' 'GAUS' | 'UNIF' | 'EXPO' X1 X2 N2 | LREE1 (COUL1) | GEO1 (N3) ; "
        "LENT1 = BRUI 'BLAN' 'POIS' N1 N2 (N3) ;",
        examples=("LIST (DIME (BRUI 'BLAN' 'GAUS' 0. 1. 10)) ;",),
    ),
    full_name="BRUIT",
)
_NOISE = key("noise", "BLAN", optional=False, en="white noise", fr="bruit blanc")
_SKIP = opt(
    "skip",
    "ENTIER",
    en="terms that the generator, begun again, skips",
    fr="termes que saute le générateur, repris au début",
)


@BRUI.form(
    _NOISE,
    choice("law", ("POIS",), optional=False, en="Poisson's law", fr="loi de Poisson"),
    arg("mean", "ENTIER", en="mean", fr="moyenne"),
    arg("count", "ENTIER", en="number of values", fr="nombre de valeurs"),
    _SKIP,
)
def _poisson(
    call: Call, noise: bool, law: str, mean: int, count: int, skip: int | None
) -> ListEnti:
    if mean < 0 or count < 0:
        raise call.error("operators.numbers.negative-mean-or-count")
    return ListEnti(session_generator(call, skip).poisson(mean, count))


@BRUI.form(
    _NOISE,
    choice("law", ("GAUS", "UNIF", "EXPO"), optional=False, en="law", fr="loi"),
    arg("mean", "FLOTTANT", en="mean", fr="moyenne"),
    arg("width", "FLOTTANT", en="deviation or half width", fr="écart-type ou amplitude"),
    arg(
        "where",
        "ENTIER",
        "LISTREEL",
        "MAILLAGE",
        en="number of values, times, or mesh",
        fr="nombre de valeurs, instants, ou maillage",
    ),
    choice("colour", COLOURS, en="colour of the curve", fr="couleur de l'évolution"),
    _SKIP,
    gives="LISTREEL|EVOLUTIO|CHPOINT",
)
def _continuous(
    call: Call,
    noise: bool,
    law: str,
    mean: float,
    width: float,
    where: Any,
    colour: str | None,
    skip: int | None,
) -> Any:
    if width < 0:
        raise call.error("operators.numbers.negative-width", width, width=width)
    generator = session_generator(call, skip)
    if isinstance(where, int) and where < 0:
        raise call.error("operators.numbers.negative-count", where, where=where)
    nodes = where.sorted_node_ids if hasattr(where, "sorted_node_ids") else None
    count = where if isinstance(where, int) else len(where if nodes is None else nodes)
    values = {
        "GAUS": lambda: generator.normal(mean, width, count),
        "UNIF": lambda: generator.uniform(mean - width, mean + width, count),
        "EXPO": lambda: generator.exponential(width, count),
    }[law]()
    if isinstance(where, int):
        return ListReel(values)
    if nodes is not None:
        return NodeField.of(where.nodes, nodes, {"SCAL": values}, "DIFFUS")
    return Curve(
        (CurvePart(where.values, values, "TEMPS", "BRUIT", "", index_of(colour) if colour else 0),)
    )
