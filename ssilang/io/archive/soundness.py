"""Whether what a save file says of an object can be: types of its fields, sizes that agree.

A file may be damaged or written by hand. What does not fit is refused when the file is read: an
object that is made can be used.
"""

from __future__ import annotations

import types
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np

from ssilang.io.plots.palette import NAMES
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.mesh.cells import CELL_TYPES


def flaw_of(cls: type, values: Mapping[str, Any]) -> str:
    """Name of a field that the class cannot hold, '' if it can hold all of them."""
    hints = _hints(cls)
    for name, value in values.items():
        if not fits(value, hints.get(name, Any)):
            return name
    agrees = _AGREEMENTS.get(cls.__name__)
    return "" if agrees is None else agrees(values)


@cache
def _hints(cls: type) -> dict[str, Any]:
    try:
        return get_type_hints(cls)
    except NameError:  # a class that its module imports for the types alone
        return {}


def fits(value: object, hint: Any) -> bool:
    """Whether a value is of a type, its items included."""
    if hint is Any or hint is object:
        return True
    origin, inside = get_origin(hint), get_args(hint)
    rule = _RULES.get(origin)
    if rule is not None:
        return rule(value, inside)
    if hint is float:
        return isinstance(value, int | float)
    return not isinstance(hint, type) or isinstance(value, hint)


def _tuple(value: object, inside: tuple[Any, ...]) -> bool:
    if not isinstance(value, tuple):
        return False
    if inside[-1:] == (Ellipsis,):
        return all(fits(v, inside[0]) for v in value)
    return len(value) == len(inside) and all(map(fits, value, inside))


def _mapping(value: object, inside: tuple[Any, ...]) -> bool:
    if not isinstance(value, dict):
        return False
    return all(fits(k, inside[0]) and fits(v, inside[1]) for k, v in value.items())


def _array(value: object, inside: tuple[Any, ...]) -> bool:
    """An array of the kind of numbers; whole ones are real and real ones complex, as needed."""
    if not isinstance(value, np.ndarray):
        return False
    (wanted,) = get_args(inside[1])
    if wanted is Any:
        return True
    return value.dtype.kind in ("bui" if issubclass(wanted, np.integer) else "buifc")


_RULES: dict[Any, Callable[[object, tuple[Any, ...]], bool]] = {
    tuple: _tuple,
    dict: _mapping,
    Mapping: _mapping,
    get_origin(Mapping[str, int]): _mapping,
    np.ndarray: _array,
    Literal: lambda value, words: value in words,
    Union: lambda value, hints: any(fits(value, h) for h in hints),
    types.UnionType: lambda value, hints: any(fits(value, h) for h in hints),
    list: lambda value, inside: isinstance(value, list) and all(fits(v, inside[0]) for v in value),
}


# ---- sizes


def _cell_block(values: Mapping[str, Any]) -> str:
    kind, raw = CELL_TYPES.get(values["cell_type"]), values["raw"]
    if kind is None:
        return "cell_type"
    if raw.ndim != 2 or raw.shape[1] != kind.n_nodes:
        return "raw"
    colours = values["colours"]
    known = colours.shape == raw.shape[:1] and _between(colours, len(NAMES))
    return "" if known else "colours"


def _node_values(values: Mapping[str, Any]) -> str:
    nodes = values["nodes"]
    if nodes.ndim != 1 or (np.diff(nodes) <= 0).any():
        return "nodes"
    return "" if values["values"].shape == nodes.shape else "values"


def _cell_field_block(values: Mapping[str, Any]) -> str:
    count = len(values["cells"])
    if any(a.ndim != 2 or len(a) != count for a in values["components"].values()):
        return "components"
    return _known_element(values)


def _known_element(values: Mapping[str, Any]) -> str:
    return "" if values.get("element", "") in ("", *ELEMENTS) else "element"


def _curve_part(values: Mapping[str, Any]) -> str:
    x, y = values["abscissas"], values["ordinates"]
    if x.ndim != 1 or x.shape != y.shape:
        return "ordinates"
    if not 0 <= values["colour"] < len(NAMES):
        return "colour"
    named = ("words", "abscissa_words")
    return next((n for n in named if len(values.get(n) or x) != len(x)), "")


def _load_part(values: Mapping[str, Any]) -> str:
    """Without a field in space there are fields at times."""
    if values.get("space") is not None:
        return ""
    return "space" if values.get("time") is not None or not values.get("steps") else ""


def _element_matrices(values: Mapping[str, Any]) -> str:
    nodes, local, unknowns = values["raw_nodes"], values["local"], values["unknowns"]
    if nodes.ndim != 2:
        return "raw_nodes"
    if local.shape != (len(unknowns),) or not _between(local, nodes.shape[1]):
        return "local"
    if len(values["duals"]) != len(unknowns):
        return "duals"
    wanted = (len(nodes), len(unknowns), len(unknowns))
    return "" if values["values"].shape == wanted else "values"


def _relations(values: Mapping[str, Any]) -> str:
    start, n_terms = values["row_start"], len(values["unknowns"])
    n_rows = values["raw_multipliers"].size
    ends = start.shape == (n_rows + 1,) and start[0] == 0 and start[-1] == n_terms
    if not ends or (np.diff(start) < 0).any():
        return "row_start"
    sizes = {"raw_nodes": n_terms, "coefficients": n_terms, "raw_multipliers": n_rows}
    sizes["sense"] = n_rows
    return next((name for name, n in sizes.items() if values[name].shape != (n,)), "")


def _between(numbers: Any, stop: int) -> bool:
    return bool(((numbers >= 0) & (numbers < stop)).all())


_AGREEMENTS: dict[str, Callable[[Mapping[str, Any]], str]] = {
    "CellBlock": _cell_block,
    "NodeValues": _node_values,
    "CellFieldBlock": _cell_field_block,
    "Zone": _known_element,
    "CurvePart": _curve_part,
    "LoadPart": _load_part,
    "ElementMatrices": _element_matrices,
    "Relations": _relations,
}
"""Rules of sizes by class: a field that does not agree with the others, or ''."""
