"""ENTI FLOT BORN MASQ BRUI: conversions, bounds, masks, random values."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.registry import Help, operator
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
    reads_itself=True,
)
def enti(call: Call) -> Any:
    """Round."""
    word = call.keyword(tuple(_ROUNDINGS))
    value = call.required(
        "ENTIER", "FLOTTANT", "LISTREEL", "LISTENTI", "CHPOINT", "LISTMOTS", "MOT"
    )
    rounding = _ROUNDINGS[word or call.keyword(tuple(_ROUNDINGS)) or "TRONCATURE"]
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
    family="numbers",
    full_name="FLOTTANT",
    help=Help(
        en="Real of an integer, of each item of a list, or written in a word.",
        fr="Réel d'un entier, de chaque élément d'une liste, ou écrit dans un mot.",
        syntax="OBJ2 = FLOT OBJ1 ;",
        examples=("LIST (FLOT 3) ;", "LIST (FLOT '-1.5E2') ;"),
    ),
    reads_itself=True,
)
def flot(call: Call) -> Any:
    """Convert to reals."""
    value = call.required("FLOTTANT", "LISTREEL", "LISTENTI", "LISTMOTS", "MOT")
    if isinstance(value, str):
        return number_in(call, value)
    if isinstance(value, ListMots):
        return ListReel([number_in(call, w) for w in value.values])
    return value if isinstance(value, float) else ListReel(value.values)


# ---- MASQ ---------------------------------------------------------------------------------------

_TESTS: dict[str, Callable[[Any, Any], Any]] = {
    "SUPE": np.greater, "EGSU": np.greater_equal, "EGAL": np.equal, "EGIN": np.less_equal,
    "INFE": np.less, "DIFF": np.not_equal,
}  # fmt: skip
_FIELDS = ("CHPOINT", "MCHAML", "LISTREEL", "LISTENTI")


@operator(
    "MASQ",
    family="numbers",
    full_name="MASQUE",
    help=Help(
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
    reads_itself=True,
)
def masq(call: Call) -> Any:
    """Compare values."""
    value = call.required(*_FIELDS)
    word = call.keyword((*_TESTS, "COMP", "EXIS"))
    if word is None:
        raise call.error("operators.numbers.which-test")
    if word == "EXIS":
        return _existing(call, value)
    counted = call.keyword(("SOMM",)) is not None
    low = _compared(call, value)
    counted = counted or call.keyword(("SOMM",)) is not None
    if word == "COMP":
        high = _compared(call, value)
        above = _tested(value, low, np.greater_equal)
        made = _times(above, _tested(value, high, np.less_equal))
    else:
        made = _tested(value, low, _TESTS[word])
    return _count(made) if counted else made


def _compared(call: Call, value: Any) -> Any:
    kinds = {
        NodeField: ("FLOTTANT", "CHPOINT"),
        CellField: ("FLOTTANT", "MCHAML"),
        ListReel: ("FLOTTANT", "LISTREEL", "LISTENTI"),
        ListEnti: ("ENTIER", "FLOTTANT", "LISTENTI"),
    }[type(value)]
    operand = call.read(*kinds)
    if operand is None:
        raise call.missing(kinds)
    return operand.value


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


def _existing(call: Call, value: Any) -> CellField:
    if not isinstance(value, CellField):
        raise call.error("operators.numbers.existence-of-cells", value)
    operand = call.read("MOT")
    name = None if operand is None else str(operand.value).rstrip()
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


@operator(
    "BORN",
    family="numbers",
    full_name="BORNER",
    help=Help(
        en="Values cut at an upper bound ('MAXIMUM'), a lower one ('MINIMUM') or both ('COMPRIS'). "
        "Of a field, component by component; of curves, curve by curve: those named are kept.",
        fr="Valeurs bornées en haut ('MAXIMUM'), en bas ('MINIMUM') ou des deux côtés ('COMPRIS'). "
        "D'un champ, composante par composante ; d'évolutions, courbe par courbe : celles qui "
        "sont nommées sont gardées.",
        syntax="OBJ2 = BORN OBJ1 ((MOT1 | N1) 'MAXIMUM' X2 | 'MINIMUM' X1 | 'COMPRIS' X1 X2) ... ;",
        examples=("LIST (BORN (PROG -1. 0.5 3.) 'COMPRIS' 0. 1.) ;",),
    ),
    reads_itself=True,
)
def born(call: Call) -> Any:
    """Clip values."""
    kinds = ("LISTENTI", "LISTREEL", "EVOLUTIO", "CHPOINT", "MCHAML")
    value = call.required(*kinds)
    if isinstance(value, ListReel | ListEnti):
        _, low, high = _bounds(call, False, False)
        return type(value)(np.clip(value.values, low, high))
    named = isinstance(value, NodeField | CellField)
    wanted = []
    while call.operands:
        wanted.append(_bounds(call, named, isinstance(value, Curve)))
    if isinstance(value, Curve):
        return _clipped_curve(call, value, wanted)
    return _clipped_field(call, value, wanted)


def _bounds(call: Call, named: bool, numbered: bool) -> tuple[Any, float, float]:
    known = ("MAXI", "MINI", "COMP")
    who: Any = None
    if numbered:
        who = call.optional("ENTIER")
    word = call.keyword(known)
    if word is None and named:
        who = str(call.required("MOT")).rstrip()
        word = call.keyword(known)
    if word is None:
        raise call.error("operators.numbers.which-bound")
    first = call.required("ENTIER", "FLOTTANT", after=call.keyword_end)
    if word == "COMP":
        return who, first, call.required("ENTIER", "FLOTTANT")
    return (who, -np.inf, first) if word == "MAXI" else (who, first, np.inf)


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


@operator(
    "BRUI",
    family="numbers",
    full_name="BRUIT",
    help=Help(
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
    reads_itself=True,
)
def brui(call: Call) -> Any:
    """Draw values."""
    if call.keyword(("BLAN",)) is None:
        raise call.error("operators.numbers.white-noise-only")
    law = call.keyword(("GAUS", "UNIF", "EXPO", "POIS"))
    if law is None:
        raise call.error("operators.numbers.which-law")
    if law == "POIS":
        mean, count = call.required("ENTIER"), call.required("ENTIER")
        if mean < 0 or count < 0:
            raise call.error("operators.numbers.negative-mean-or-count")
        return ListEnti(session_generator(call, call.optional("ENTIER")).poisson(mean, count))
    mean, width = call.required("FLOTTANT"), call.required("FLOTTANT")
    if width < 0:
        raise call.error("operators.numbers.negative-width", width, width=width)
    support = call.read("ENTIER", "LISTREEL", "MAILLAGE")
    if support is None:
        raise call.missing(("ENTIER", "LISTREEL", "MAILLAGE"))
    from ssilang.operators.curves.words import read_colour

    colour = read_colour(call)
    generator = session_generator(call, call.optional("ENTIER"))
    where = support.value
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
    return Curve((CurvePart(where.values, values, "TEMPS", "BRUIT", "", colour or 0),))
