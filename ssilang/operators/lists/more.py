"""DANS OTER SAUF COLI VERI SOMT RACP: further operators on lists, numbers and fields."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import (
    Help,
    Like,
    arg,
    choice,
    flag,
    main,
    many,
    operator,
    opt,
    said,
    shared,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListEnti, ListMots, ListReel, Mot, Table
from ssilang.operators.dispatch import INTE
from ssilang.operators.lists.items import taken
from ssilang.operators.lists.search import equal_items

DANS = shared(
    "DANS",
    "lists",
    Help(
        en="Whether a list of integers stands in another one (as its k-th stretch of that "
        "length), a real in a list, a point in a mesh, a list of reals in another, in sequence "
        "('SEQU') or in any order ('QUEL').",
        fr="Dit si une liste d'entiers est dans une autre (comme sa k-ième tranche de cette "
        "longueur), un réel dans une liste, un point dans un maillage, une liste de réels dans "
        "une autre, en séquence ('SEQU') ou dans un ordre quelconque ('QUEL').",
        syntax="LOG1 = DANS LENT1 LENT2 ; LOG1 = DANS LREE1 X1 ; LOG1 = DANS POIN1 MAIL1 ; "
        "LOG1 = DANS ('SEQU' | 'QUEL') LREE1 LREE2 ;",
        examples=("SI (DANS (PROG 1. 2.) 2.) ; MESS 'yes' ; FINSI ;",),
    ),
)
_WAY = choice(
    "way",
    ("SEQU", "QUEL"),
    default="SEQU",
    en="in sequence, or in any order",
    fr="en séquence, ou dans un ordre quelconque",
)
_SECOND = {"en": "list where it is looked for", "fr": "liste où on la cherche"}


@DANS.form(
    _WAY,
    arg("point", "POINT", en="point", fr="point"),
    arg("mesh", "MAILLAGE", en="mesh", fr="maillage"),
)
def _point_in_mesh(way: str, point: Point, mesh: Mesh) -> bool:
    return bool(np.any(mesh.node_ids == point.node))


@DANS.form(
    _WAY,
    arg("part", "LISTENTI", en="list of integers", fr="liste d'entiers"),
    arg("whole", "LISTENTI", **_SECOND),
)
def _integers_in_integers(way: str, part: ListEnti, whole: ListEnti) -> bool:
    return _as_stretch(part.values, whole.values)


@DANS.form(
    _WAY,
    arg("whole", "LISTREEL", en="list of reals", fr="liste de réels"),
    arg("number", "FLOTTANT", en="number looked for", fr="nombre cherché"),
)
def _number_in_reals(way: str, whole: ListReel, number: float) -> bool:
    return bool(np.any(np.abs(whole.values - number) <= _slack(whole.values)))


@DANS.form(
    _WAY,
    arg("part", "LISTREEL", en="list of reals", fr="liste de réels"),
    arg("whole", "LISTREEL", **_SECOND),
)
def _reals_in_reals(way: str, part: ListReel, whole: ListReel) -> bool:
    left, right = part.values, whole.values
    slack = _slack(right)
    if way == "QUEL":
        return all(bool(np.any(np.abs(right - v) <= slack)) for v in left)
    if len(left) == 0:
        return True
    if len(left) > len(right):
        return False
    windows = np.lib.stride_tricks.sliding_window_view(right, len(left))
    return bool(np.any(np.all(np.abs(windows - left) <= slack, axis=1)))


def _slack(values: Any) -> float:
    gaps = np.abs(np.diff(values))
    gaps = gaps[gaps > 0]
    return 1e-8 * float(gaps.min()) if len(gaps) else 0.0


def _as_stretch(part: Any, whole: Any) -> bool:
    p = len(part)
    if p == 0:
        return True
    rows = whole[: len(whole) // p * p].reshape(-1, p)
    return bool(np.any(np.all(rows == part, axis=1)))


@operator(
    "OTER",
    arg("table", "TABLE", en="table", fr="table"),
    arg("index", en="index to remove", fr="indice à supprimer"),
    family="tables",
    help=Help(
        en="Removes an index from a table, in place.",
        fr="Supprime un indice d'une table, sur place.",
        syntax="OTER TAB1 OBJ1 ;",
        examples=("T = TABL ; T . 1 = 2. ; OTER T 1 ; LIST (DIME T) ;",),
    ),
)
def oter(call: Call, table: Table, index: Any) -> None:
    """Forget an index."""
    if not table.has(index):
        raise call.error("no-index", index, index=index, known=[k for k, _ in table.items()])
    table.remove(index)


_SUBTRACTED = ("LISTREEL", "LISTENTI", "LISTMOTS")
Subtracted = ListReel | ListEnti | ListMots


@operator(
    "SAUF",
    arg("first", *_SUBTRACTED, en="list", fr="liste"),
    arg("second", *_SUBTRACTED, en="items to leave out", fr="éléments à omettre"),
    opt("tolerance", "FLOTTANT", en="absolute tolerance", fr="tolérance absolue"),
    flag("fold", "NOCA", en="whatever the case", fr="sans égard à la casse"),
    gives=Like("first"),
    family="lists",
    help=Help(
        en="The items of a list that are not in a second one.",
        fr="Les éléments d'une liste qui ne sont pas dans une seconde.",
        syntax="LIS3 = LIS1 SAUF LIS2 (X1 | 'NOCA') ;",
        examples=("LIST ((LECT 1 2 3 4) SAUF (LECT 2 4)) ;",),
    ),
)
def sauf(
    call: Call, first: Subtracted, second: Subtracted, tolerance: float | None, fold: bool
) -> Any:
    """Subtract a list from another."""
    if type(first) is not type(second):
        raise call.error("operators.lists.lists-of-one-type", second)
    gone = np.zeros(len(first), dtype=bool)
    for item in second.values:
        gone |= equal_items(first.values, item, tolerance, fold)
    return taken(first, [int(i) for i in np.flatnonzero(~gone)])


COLI = shared(
    "COLI",
    "fields",
    Help(
        en="Linear combination: fields each followed by its coefficient, or a list of fields (or "
        "a table 1 .. N of fields or lists) with a list of coefficients.",
        fr="Combinaison linéaire : champs chacun suivi de son coefficient, ou une liste de champs "
        "(ou une table 1 .. N de champs ou de listes) avec une liste de coefficients.",
        syntax="CHP1 = COLI CHP2 X2 CHP3 X3 ... ; OBJ1 = COLI LCHP1 | TAB1 LREE1 ;",
        examples=(
            "T = TABL ; T . 1 = PROG 1. 2. ; T . 2 = PROG 3. 4. ; LIST (COLI T (PROG 2. 1.)) ;",
        ),
    ),
    full_name="COLINEAIRE",
)


@COLI.form(
    arg(
        "held",
        "LISTCHPO",
        "TABLE",
        en="fields, or a table 1 .. N of fields or lists",
        fr="champs, ou table 1 .. N de champs ou de listes",
    ),
    arg("factors", "LISTREEL", en="coefficients", fr="coefficients"),
    gives="CHPOINT|MCHAML|LISTREEL",
)
def _combine_held(call: Call, held: ListChpo | Table, factors: ListReel) -> Any:
    numbers = factors.values.tolist()
    if isinstance(held, ListChpo):
        return _combined(call, list(held.values), numbers)
    return _combined(call, [held.get(i) for i in range(1, len(numbers) + 1)], numbers)


@COLI.form(
    many("objects", "CHPOINT", "MCHAML", at_least=1, en="fields", fr="champs"),
    many("factors", "FLOTTANT", en="coefficients", fr="coefficients"),
    gives="CHPOINT|MCHAML",
)
def _combine_fields(call: Call, objects: tuple[Any, ...], factors: tuple[float, ...]) -> Any:
    return _combined(call, list(objects), list(factors))


def _combined(call: Call, objects: list[Any], factors: list[float]) -> Any:
    if not objects or len(objects) != len(factors):
        raise call.error(
            "operators.lists.coefficient-count", n_objects=len(objects), n_factors=len(factors)
        )
    if all(isinstance(o, ListReel) for o in objects):
        if len({len(o) for o in objects}) > 1:
            raise call.error("operators.lists.lengths-differ")
        return ListReel(sum(f * o.values for f, o in zip(factors, objects, strict=True)))
    kinds = {type(o) for o in objects}
    if len(kinds) > 1 or not kinds <= {NodeField, CellField}:
        raise call.error("operators.lists.nothing-to-combine")
    algebra: Any = node_algebra if isinstance(objects[0], NodeField) else cell_algebra
    total = algebra.applied(objects[0], lambda v: v * factors[0])
    for factor, field in zip(factors[1:], objects[1:], strict=True):
        total = algebra.added(total, field, factor)
    return total


@operator(
    "VERI",
    arg("value", "FLOTTANT", "CHPOINT", en="what is tested", fr="ce que l'on teste"),
    family="numbers",
    help=Help(
        en="Whether a real, or all values of a field, are numbers (neither infinite nor "
        "undefined).",
        fr="Dit si un réel, ou toutes les valeurs d'un champ, sont des nombres (ni infinis ni "
        "indéfinis).",
        syntax="LOG1 = VERI X1 | CHPO1 ;",
        examples=("SI (VERI 3.) ; MESS 'a number' ; FINSI ;",),
    ),
)
def veri(value: Any) -> bool:
    """Test for numbers."""
    if isinstance(value, float):
        return bool(np.isfinite(value))
    return all(bool(np.all(np.isfinite(v.values))) for v in value.components.values())


@operator(
    "SOMT",
    arg("field", "CHPOINT", en="field of one component", fr="champ d'une composante"),
    family="fields",
    help=Help(
        en="Sum of the values of a field of a single component (SCAL, most often).",
        fr="Somme des valeurs d'un champ de composante unique (SCAL, le plus souvent).",
        syntax="X1 = SOMT CHPO1 ;",
        examples=("OPTI DIME 2 ; P = 0. 0. ; LIST (SOMT (MANU 'CHPO' P 'SCAL' 3.)) ;",),
    ),
)
def somt(field: NodeField) -> float:
    """Sum values."""
    if len(field.components) != 1:
        raise KernelError("operators.lists.single-component")
    return float(next(iter(field.components.values())).values.sum())


RACP = shared(
    "RACP",
    "numbers",
    Help(
        en="Real roots of a polynomial A0 + A1 X + A2 X**2 ..., in increasing order; with "
        "'IMAGINAIRE' real and imaginary parts of all roots; with 'INTE' the first real root in "
        "an interval (the word VIDE if there is none).",
        fr="Racines réelles d'un polynôme A0 + A1 X + A2 X**2 ..., par ordre croissant ; avec "
        "'IMAGINAIRE' parties réelles et imaginaires de toutes ; avec 'INTE' la première racine "
        "réelle d'un intervalle (le mot VIDE s'il n'y en a pas).",
        syntax="LREE2 (LREE3) = RACP ('IMAGINAIRE') LREE1 | A0 A1 A2 (A3) (A4) ; "
        "X1 = RACP 'INTE' X2 X3 LREE1 ;",
        examples=("LIST (RACP (PROG 6. -5. 1.)) ;",),
    ),
    full_name="RACPOL",
)
_POLYNOMIAL = (
    flag("bairstow", "BAIR", en="changes nothing", fr="sans effet"),
    opt("listed", "LISTREEL", en="coefficients by power", fr="coefficients par puissance"),
    many("numbers", "FLOTTANT", en="coefficients, else", fr="sinon les coefficients"),
)


@RACP.form(said("IMAG"), *_POLYNOMIAL)
def _all_roots(
    call: Call, bairstow: bool, listed: ListReel | None, numbers: tuple[float, ...]
) -> tuple[ListReel, ListReel]:
    roots = _roots(call, listed, numbers)
    return ListReel(roots.real), ListReel(roots.imag)


@RACP.form(
    said("INTE"),
    arg("low", "FLOTTANT", en="one end of an interval", fr="une borne d'un intervalle"),
    arg("high", "FLOTTANT", en="the other end", fr="l'autre borne"),
    *_POLYNOMIAL,
    gives="FLOTTANT|MOT",
)
def _root_within(
    call: Call,
    low: float,
    high: float,
    bairstow: bool,
    listed: ListReel | None,
    numbers: tuple[float, ...],
) -> float | Mot:
    real = _real_roots(_roots(call, listed, numbers))
    inside = real[(real >= min(low, high)) & (real <= max(low, high))]
    return float(inside[0]) if len(inside) else Mot("VIDE")


@RACP.form(*_POLYNOMIAL)
def _roots_of(
    call: Call, bairstow: bool, listed: ListReel | None, numbers: tuple[float, ...]
) -> ListReel:
    return ListReel(_real_roots(_roots(call, listed, numbers)))


def _roots(call: Call, listed: ListReel | None, numbers: tuple[float, ...]) -> ComplexArray:
    """Roots of a polynomial, by real and then by imaginary part."""
    coefficients = listed.values if listed is not None else np.asarray(numbers)
    trimmed = np.trim_zeros(np.asarray(coefficients, dtype=float), "b")
    if len(trimmed) < 2:
        raise call.error("operators.lists.constant-polynomial")
    roots = np.roots(trimmed[::-1]).astype(complex)
    return roots[np.lexsort((roots.imag, roots.real))]


def _real_roots(roots: ComplexArray) -> FloatArray:
    # a real double root comes out of the companion matrix with an imaginary part of order
    # sqrt(machine precision)
    real = roots.real[np.abs(roots.imag) <= 1e-7 * np.maximum(np.abs(roots), 1e-12)]
    return np.sort(real)


@INTE.form(
    main("first", "LISTREEL", en="first list", fr="première liste"),
    arg("second", "LISTREEL", en="second list", fr="seconde liste"),
    syntax="LREE3 = LREE1 INTE LREE2 ;",
    en="Two lists of reals: the values of the first that the second holds as well.",
    fr="Deux listes de réels : les valeurs de la première que contient aussi la seconde.",
    examples=("LIST (INTE (PROG 1. 2. 3.) (PROG 2. 3. 4.)) ;",),
)
def common_reals(first: ListReel, second: ListReel) -> ListReel:
    """Values in both lists, in the order of the first."""
    return ListReel(first.values[np.isin(first.values, second.values)])
