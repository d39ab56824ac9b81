"""Sums, products and functions of fields in cells, block by block; fields of curves."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.mesh.mesh import same_cells

Values = NDArray[Any]
SCALAR = "SCAL"
ObjectRule = Callable[[str, object, object], object]
"""Sum, product ... of two objects that cells hold, from the sign and the two."""


def rebuilt(block: CellFieldBlock, components: Mapping[str, Values]) -> CellFieldBlock:
    """A block like `block` with other components."""
    return CellFieldBlock(block.cells, components, block.support, block.element, block.constituent)


def _same_zone(a: CellFieldBlock, b: CellFieldBlock) -> bool:
    return a.constituent == b.constituent and same_cells(a.cells, b.cells)


def numeric(name: str, values: Values) -> Values:
    """The values of a component, refused when they are objects."""
    if values.dtype == object:
        raise FieldError("kernel.fields.component-holds-objects-not", name=name)
    return values


def applied(
    field: CellField,
    function: Callable[[Any], Any],
    names: Iterable[str] | None = None,
    objects: bool = False,
) -> CellField:
    """The field of a function `array -> array` of the values (of components `names` only).

    Components of objects are refused, unless the function takes them.
    """
    wanted = None if names is None else set(names)
    blocks = []
    for block in field.blocks:
        made = {
            k: np.asarray(function(v if objects else numeric(k, v)))
            if wanted is None or k in wanted
            else v
            for k, v in block.components.items()
        }
        blocks.append(rebuilt(block, made))
    return CellField(tuple(blocks), field.title)


def _support(a: CellFieldBlock, b: CellFieldBlock) -> CellFieldBlock:
    """The block whose points a result stands at: the one with more points."""
    count = [max((v.shape[1] for v in block.components.values()), default=1) for block in (a, b)]
    return b if count[1] > count[0] else a


def added(
    a: CellField, b: CellField, factor: float = 1.0, objects: ObjectRule | None = None
) -> CellField:
    """`a + factor * b`: common components of common zones add up, the others are kept."""
    blocks = list(a.blocks)
    for block in b.blocks:
        place = next((i for i, mine in enumerate(blocks) if _same_zone(mine, block)), None)
        if place is None:
            scaled = {k: _scaled(v, factor) for k, v in block.components.items()}
            blocks.append(rebuilt(block, scaled))
        else:
            blocks[place] = _added_block(blocks[place], block, factor, objects)
    return CellField(tuple(blocks), a.title or b.title)


def _scaled(values: Values, factor: float) -> Values:
    return values if values.dtype == object or factor == 1.0 else values * factor


def _added_block(
    a: CellFieldBlock, b: CellFieldBlock, factor: float, objects: ObjectRule | None
) -> CellFieldBlock:
    made = dict(a.components)
    for name, values in b.components.items():
        if name not in made:
            made[name] = _scaled(values, factor)
            continue
        x, y = a.components[name], b.components[name]
        if a.support != b.support and 1 not in (x.shape[1], y.shape[1]):
            told = {"name": name, "support": a.support, "support_2": b.support}
            raise FieldError("kernel.fields.component-stands-field", **told)
        if made[name].dtype == object or values.dtype == object:
            sign = "+" if factor == 1.0 else "-"
            made[name] = _of_objects(name, sign, made[name], values, objects)
        else:
            made[name] = made[name] + factor * values
    return rebuilt(_support(a, b), made)


def _of_objects(name: str, sign: str, a: Values, b: Values, objects: ObjectRule | None) -> Values:
    """Objects (or an object and a number) combined point by point."""
    if objects is None:
        raise FieldError("kernel.fields.component-holds-objects-not", name=name)
    return of_objects(sign, a, b, objects)


def of_objects(sign: str, a: Any, b: Any, objects: ObjectRule) -> Values:
    """Objects (or objects and numbers) combined point by point; equal pairs once."""
    wide = np.broadcast_shapes(np.shape(a), np.shape(b))
    x, y = np.broadcast_to(a, wide).ravel(), np.broadcast_to(b, wide).ravel()
    made = np.empty(x.size, dtype=object)
    known: dict[tuple[object, object], object] = {}
    for i, (left, right) in enumerate(zip(x, y, strict=True)):
        pair = _pair_key(left), _pair_key(right)
        if pair not in known:
            known[pair] = objects(sign, left, right)
        made[i] = known[pair]
    return made.reshape(wide)


def _pair_key(item: object) -> object:
    return item if isinstance(item, float | np.generic) else id(item)


def united(a: CellField, b: CellField) -> CellField:
    """Union (ET): zones and components of both; where both have one, the values must agree."""
    blocks = list(a.blocks)
    for block in b.blocks:
        place = next((i for i, mine in enumerate(blocks) if _same_zone(mine, block)), None)
        if place is None:
            blocks.append(block)
            continue
        made = dict(blocks[place].components)
        for name, values in block.components.items():
            if name in made and not _agree(made[name], values):
                raise FieldError("kernel.fields.component-differs-between-two", name=name)
            made.setdefault(name, values)
        blocks[place] = rebuilt(_support(blocks[place], block), made)
    return CellField(tuple(blocks), a.title or b.title)


def _agree(a: Values, b: Values) -> bool:
    if a.dtype == object or b.dtype == object:
        return bool(np.all(a == b))
    return bool(np.allclose(a, b, rtol=1e-6, atol=0.0)) if a.shape == b.shape else False


def multiplied(
    a: CellField, b: CellField, divide: bool = False, objects: ObjectRule | None = None
) -> CellField:
    """Product (or quotient) by a scalar field, or component by component.

    Raises
    ------
    FieldError
        If a zone of one field is not a zone of the other, or components do not fit.
    """
    blocks = []
    for mine in a.blocks:
        other = next((o for o in b.blocks if same_cells(mine.cells, o.cells)), None)
        if other is None:
            told = {"n_cells": len(mine.cells), "cell_type": mine.cells.cell_type}
            raise FieldError("kernel.fields.zone-first-field-not", **told)
        blocks.append(_multiplied_block(mine, other, divide, objects))
    return CellField(tuple(blocks), a.title)


def _multiplied_block(
    a: CellFieldBlock, b: CellFieldBlock, divide: bool, objects: ObjectRule | None
) -> CellFieldBlock:
    def run(name: str, x: Values, y: Values) -> Values:
        return _product(name, x, y, divide, objects)

    if len(b.components) == 1 and (SCALAR in b.components or len(a.components) > 1):
        (factor,) = b.components.values()
        made = {k: run(k, v, factor) for k, v in a.components.items()}
    elif list(a.components) == [SCALAR] and not divide:
        factor = a.components[SCALAR]
        made = {k: run(k, factor, v) for k, v in b.components.items()}
    elif len(a.components) == len(b.components) == 1:
        ((name, x),), (y,) = a.components.items(), b.components.values()
        made = {name: run(name, x, y)}
    elif set(a.components) == set(b.components):
        made = {k: run(k, v, b.components[k]) for k, v in a.components.items()}
    else:
        told = {"components": a.components, "components_2": b.components}
        raise FieldError("kernel.fields.cells-field-by-field-not-defined", **told)
    return rebuilt(_support(a, b), made)


def _product(
    name: str, a: Values, b: Values, divide: bool, objects: ObjectRule | None = None
) -> Values:
    if a.dtype == object or b.dtype == object:
        return _of_objects(name, "/" if divide else "*", a, b, objects)
    if not divide:
        return np.asarray(a * b)
    if np.any(b == 0):
        raise FieldError("kernel.fields.field-divide-zero")
    return np.asarray(a / b)


def multiplied_by_names(
    a: CellField,
    b: CellField,
    names: tuple[Iterable[str], Iterable[str], Iterable[str]],
    divide: bool = False,
    factors: Iterable[float] | None = None,
) -> CellField:
    """Components of `a` times components of `b` under new names, pair by pair.

    Each product (or quotient) is multiplied (divided) by its factor, if there are some.
    """
    pairs = list(zip(*names, strict=True))
    weights = [1.0] * len(pairs) if factors is None else list(factors)
    blocks = []
    for mine in a.blocks:
        other = next((o for o in b.blocks if same_cells(mine.cells, o.cells)), None)
        if other is None:
            continue
        made: dict[str, Values] = {}
        for (left, right, name), weight in zip(pairs, weights, strict=True):
            if left in mine.components and right in other.components:
                x, y = numeric(left, mine.components[left]), numeric(right, other.components[right])
                value = _product(name, x, y, divide)
                value = value / weight if divide else value * weight
                made[name] = made[name] + value if name in made else value
        blocks.append(rebuilt(_support(mine, other), made))
    return CellField(tuple(blocks), a.title)


def component_names(field: CellField) -> list[str]:
    """Names of the components of all zones, each once, in order."""
    return list(dict.fromkeys(n for b in field.blocks for n in b.components))


def extracted(
    field: CellField, names: Iterable[str], new: Iterable[str], check: bool = True
) -> CellField:
    """Components `names` under the names `new`.

    Raises
    ------
    FieldError
        If the field has none of a name (with `check`).
    """
    pairs = list(zip(names, new, strict=True))
    known = component_names(field)
    for name, _ in pairs:
        if check and name not in known:
            raise FieldError("kernel.fields.field-no-component", name=name, known=known)
    blocks = []
    for block in field.blocks:
        made = {n: block.components[o] for o, n in pairs if o in block.components}
        if made:
            blocks.append(rebuilt(block, made))
    return CellField(tuple(blocks), field.title)


def renamed(field: CellField, old: Iterable[str], new: Iterable[str]) -> CellField:
    """Components `old` under the names `new`; the others keep theirs."""
    names = dict(zip(old, new, strict=True))
    blocks = [
        rebuilt(b, {names.get(k, k): v for k, v in b.components.items()}) for b in field.blocks
    ]
    return CellField(tuple(blocks), field.title)


def values_of(field: CellField, names: Iterable[str] | None = None) -> list[Values]:
    """Arrays of the numeric components (of those named)."""
    wanted = None if names is None else set(names)
    return [
        v
        for b in field.blocks
        for k, v in b.components.items()
        if v.dtype != object and (wanted is None or k in wanted)
    ]


def through(name: str, abscissas: Sequence[float], fields: Sequence[CellField]) -> CellField:
    """In each cell the curve of the values of fields of one component against abscissas.

    Parameters
    ----------
    name : str
        Of the abscissas; the ordinates bear the name of the component.

    Raises
    ------
    FieldError
        If the abscissas do not increase, or the fields differ in cells or component.
    """
    x = np.asarray(abscissas, dtype=float)
    if (np.diff(x) <= 0).any():
        i = int(np.argmax(np.diff(x) <= 0))
        raise FieldError("kernel.curves.abscissas-must-increase-follows", x=x[i + 1], x_2=x[i])
    names = {n for f in fields for n in component_names(f)}
    if len(names) != 1:
        raise FieldError("kernel.fields.curves-of-one-component", names=sorted(names))
    (component,) = names
    blocks = [_block(b, component, name, x, fields) for b in fields[0].blocks]
    return CellField(tuple(blocks), fields[0].title)


def _block(
    block: CellFieldBlock, component: str, name: str, x: FloatArray, fields: Sequence[CellField]
) -> CellFieldBlock:
    rows = []
    for field in fields:
        mine = next((b for b in field.blocks if same_cells(b.cells, block.cells)), None)
        if mine is None or mine.support != block.support:
            raise FieldError("kernel.fields.curves-of-other-cells", n_cells=len(block.cells))
        rows.append(numeric(component, mine.components[component]))
    values = np.stack(np.broadcast_arrays(*rows), axis=-1).astype(float)
    made = np.empty(values.shape[:2], dtype=object)
    known: dict[bytes, Curve] = {}
    for place in np.ndindex(*made.shape):
        key = values[place].tobytes()
        if key not in known:
            part = CurvePart(x, values[place].copy(), name, component)
            known[key] = Curve((part,))
        made[place] = known[key]
    return rebuilt(block, {component: made})
