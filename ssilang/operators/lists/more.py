"""DANS OTER SAUF COLI VERI SOMT RACP: further operators on lists, numbers and fields."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Point
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListReel, Mot, Table
from ssilang.operators.dispatch import INTE
from ssilang.operators.lists.items import taken
from ssilang.operators.lists.search import equal_items


@operator(
    "DANS",
    family="lists",
    help=Help(
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
    reads_itself=True,
)
def dans(call: Call) -> bool:
    """Test membership."""
    word = call.keyword(("SEQU", "QUEL")) or "SEQU"
    point = call.read("POINT")
    if point is not None:
        mesh = call.required("MAILLAGE")
        place: Point = point.value
        return bool(np.any(mesh.node_ids == place.node))
    first = call.read("LISTENTI")
    if first is not None:
        return _as_stretch(first.value.values, call.required("LISTENTI").values)
    left = call.required("LISTREEL").values
    number = call.read("FLOTTANT")
    if number is not None:
        return bool(np.any(np.abs(left - number.value) <= _slack(left)))
    right = call.required("LISTREEL").values
    word = call.keyword(("SEQU", "QUEL")) or word
    slack = _slack(right)
    if word == "QUEL":
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
    arg("table", "TABLE"),
    arg("index"),
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


@operator(
    "SAUF",
    family="lists",
    help=Help(
        en="The items of a list that are not in a second one.",
        fr="Les éléments d'une liste qui ne sont pas dans une seconde.",
        syntax="LIS3 = LIS1 SAUF LIS2 (X1 | 'NOCA') ;",
        examples=("LIST ((LECT 1 2 3 4) SAUF (LECT 2 4)) ;",),
    ),
    reads_itself=True,
)
def sauf(call: Call) -> Any:
    """Subtract a list from another."""
    kinds = ("LISTREEL", "LISTENTI", "LISTMOTS")
    first, second = call.required(*kinds), call.required(*kinds)
    if type(first) is not type(second):
        raise call.error("operators.lists.lists-of-one-type", second)
    tolerance = call.optional("FLOTTANT")
    fold = call.keyword(("NOCA",)) is not None
    gone = np.zeros(len(first), dtype=bool)
    for item in second.values:
        gone |= equal_items(first.values, item, tolerance, fold)
    return taken(first, [int(i) for i in np.flatnonzero(~gone)])


@operator(
    "COLI",
    family="fields",
    full_name="COLINEAIRE",
    help=Help(
        en="Linear combination: fields each followed by its coefficient, or a list of fields (or "
        "a table 1 .. N of fields or lists) with a list of coefficients.",
        fr="Combinaison linéaire : champs chacun suivi de son coefficient, ou une liste de champs "
        "(ou une table 1 .. N de champs ou de listes) avec une liste de coefficients.",
        syntax="CHP1 = COLI CHP2 X2 CHP3 X3 ... ; OBJ1 = COLI LCHP1 | TAB1 LREE1 ;",
        examples=(
            "T = TABL ; T . 1 = PROG 1. 2. ; T . 2 = PROG 3. 4. ; LIST (COLI T (PROG 2. 1.)) ;",
        ),
    ),
    reads_itself=True,
)
def coli(call: Call) -> Any:
    """Combine linearly."""
    held = call.read("LISTCHPO", "TABLE")
    if held is None:
        objects = call.all("CHPOINT", "MCHAML")
        factors = call.all("FLOTTANT")
    else:
        factors = call.required("LISTREEL").values.tolist()
        value = held.value
        if isinstance(value, ListChpo):
            objects = list(value.values)
        else:
            objects = [value.get(i) for i in range(1, len(factors) + 1)]
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
    arg("value", "FLOTTANT", "CHPOINT"),
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
    arg("field", "CHPOINT"),
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


@operator(
    "RACP",
    family="numbers",
    full_name="RACPOL",
    help=Help(
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
    reads_itself=True,
)
def racp(call: Call) -> Any:
    """Find roots."""
    words: set[str] = set()
    while (said := call.keyword(("IMAG", "BAIR", "INTE"))) is not None:
        words.add(said)
    listed = call.read("LISTREEL")
    numbers = call.all("FLOTTANT")
    while (said := call.keyword(("IMAG", "BAIR"))) is not None:
        words.add(said)
    bounds = numbers[:2] if "INTE" in words else []
    coefficients = listed.value.values if listed is not None else np.asarray(numbers)
    trimmed = np.trim_zeros(np.asarray(coefficients, dtype=float), "b")
    if len(trimmed) < 2:
        raise call.error("operators.lists.constant-polynomial")
    roots = np.roots(trimmed[::-1])
    roots = roots[np.lexsort((roots.imag, roots.real))]
    if "IMAG" in words:
        return ListReel(roots.real), ListReel(roots.imag)
    # a real double root comes out of the companion matrix with an imaginary part of order
    # sqrt(machine precision)
    real = np.sort(roots.real[np.abs(roots.imag) <= 1e-7 * np.maximum(np.abs(roots), 1e-12)])
    if "INTE" not in words:
        return ListReel(real)
    if len(bounds) != 2:
        raise call.error("operators.lists.interval-ends")
    low, high = sorted(bounds)
    inside = real[(real >= low) & (real <= high)]
    return float(inside[0]) if len(inside) else Mot("VIDE")


@INTE.on(
    "LISTREEL",
    syntax="LREE3 = LREE1 INTE LREE2 ;",
    en="Two lists of reals: the values of the first that the second holds as well.",
    fr="Deux listes de réels : les valeurs de la première que contient aussi la seconde.",
    examples=("LIST (INTE (PROG 1. 2. 3.) (PROG 2. 3. 4.)) ;",),
)
def common_reals(call: Call, first: ListReel) -> ListReel:
    """Values in both lists, in the order of the first."""
    second: ListReel = call.required("LISTREEL")
    return ListReel(first.values[np.isin(first.values, second.values)])
