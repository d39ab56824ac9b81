"""Objects made again from a save file."""

import types
from collections.abc import Callable, Iterable, Mapping
from enum import Enum
from functools import cache
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from ssilang.io.archive.classes import NODE_FIELDS, class_named, packing_named, saved_fields
from ssilang.io.archive.container import DAMAGES, Archive, Record
from ssilang.io.errors import InputError
from ssilang.io.plots.palette import COLOURS
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.mesh.cells import find_cell_type
from ssilang.kernel.mesh.nodes import NodeTable

_BEYOND = 1.7e308  # what is larger is infinite, or no number that scripts make


class Decoder:
    """Makes the objects of a file over the nodes of a session.

    The nodes of the file are appended to those that the session has; node numbers shift by as
    many.

    Parameters
    ----------
    nodes : NodeTable
        Of the session.
    """

    def __init__(self, archive: Archive, nodes: NodeTable) -> None:
        self._archive = archive
        self._nodes = nodes
        self._shift = len(nodes)
        self._made: dict[int, Any] = {}
        self._added = 0
        self._named: list[NDArray[Any]] = []  # node numbers of objects
        self._amiss = False  # a number that is none was met
        self.not_finite: list[str] = []  # names of what holds such

    def decode(self, code: Any) -> Any:
        """The value that a code stands for.

        Raises
        ------
        InputError
            If the file is damaged.
        """
        if not isinstance(code, list):
            self._amiss |= isinstance(code, int | float) and not -_BEYOND < code < _BEYOND
            return code
        try:
            return self._decoded(code)
        except KernelError:
            raise
        except DAMAGES as error:
            raise InputError("io.damaged", name=self._archive.path.name, error=error) from error

    def named(self, records: Iterable[Record]) -> list[tuple[str, Any]]:
        """Names of records with their objects, all of them read and all of their nodes there.

        Raises
        ------
        InputError
            If the file is damaged.
        """
        found = []
        for name, code in ((n, c) for r in records for n, c in r.names.items()):
            self._amiss = False
            found.append((name, self.decode(code)))
            self.not_finite += [name] * self._amiss
        for numbers in self._named:
            if numbers.size and not 0 <= numbers.min() <= numbers.max() < len(self._nodes):
                raise self._unfit("nodes", "node numbers")
        return found

    def _decoded(self, code: list[Any]) -> Any:
        kind, what = code[0], code[1]
        if kind == "o":
            return self._object(what)
        if kind == "a":
            array = self._archive.array(what)
            self._amiss |= not np.isfinite(array).all()
            return array
        if kind == "l":
            return [self.decode(v) for v in what]
        if kind == "t":
            return tuple(self.decode(v) for v in what)
        if kind == "d":
            return {self.decode(k): self.decode(v) for k, v in what}
        if kind == "e":
            cls = class_named(what)
            if not issubclass(cls, Enum):
                raise self._unfit("class", what)
            return cls[code[2]]
        if kind == "ao":
            made = np.empty(len(code[2]), dtype=object)
            made[:] = [self.decode(v) for v in code[2]]
            return made.reshape(what)
        raise InputError("io.holds-unknown-kind-data", name=self._archive.path.name, kind=kind)

    def _object(self, number: int) -> Any:
        if number in self._made:
            return self._made[number]
        if number < 0:  # Python would count from the last
            raise LookupError(number)
        name, parts = self._archive.objects[number]
        if name == "nodes":
            self._made[number] = self._table(parts)
        elif ":" in name:
            self._made[number] = self._instance(name, parts)
        else:
            packing = packing_named(name)
            if packing.fill is None:
                self._made[number] = packing.make(self.decode(parts))
            else:
                # known before its content is read: it may hold itself
                made = self._made[number] = packing.make(None)
                packing.fill(made, self.decode(parts))
        return self._made[number]

    def _instance(self, name: str, parts: dict[str, Any]) -> Any:
        cls = class_named(name)
        known = set(saved_fields(cls))
        values = {k: self.decode(v) for k, v in parts.items() if k in known}
        if (flaw := flaw_of(cls, values)) != "":
            raise self._unfit(cls.__name__, flaw)
        for field in NODE_FIELDS.get(cls.__name__, ()):
            if values.get(field) is not None:
                values[field] = values[field] + self._shift
                self._named.append(np.asarray(values[field]))
        return cls(**values)

    def _unfit(self, kind: str, part: str) -> InputError:
        name = self._archive.path.name
        return InputError("io.damaged-object", name=name, kind=kind, part=part)

    def _table(self, parts: list[Any]) -> NodeTable:
        """The session's table, with the nodes of the file that it has not yet."""
        coordinates, density, alias = (self.decode(p) for p in parts)
        count = len(density)
        sizes = coordinates.shape == (count, 3) and alias.shape == density.shape == (count,)
        if not sizes or alias.dtype.kind not in "iu" or not np.isfinite(coordinates).all():
            raise self._unfit("nodes", "coordinates")
        if not ((alias >= 0) & (alias < count)).all() or (alias[alias] != alias).any():
            raise self._unfit("nodes", "alias")
        fresh = slice(self._added, len(density))
        self._nodes.add(coordinates[fresh], density[fresh])
        self._added = max(self._added, len(density))
        dropped = np.flatnonzero(alias != np.arange(len(alias)))
        self._nodes.merge(alias[dropped] + self._shift, dropped + self._shift)
        return self._nodes


# Whether what a save file says of an object can be: types of its fields, sizes that agree.
#
# A file may be damaged or written by hand. What does not fit is refused when the file is read: an
# object that is made can be used.


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
    """An array of the kind of numbers; whole ones are real, as needed."""
    if not isinstance(value, np.ndarray):
        return False
    (wanted,) = get_args(inside[1])
    if wanted is Any:
        return True
    return value.dtype.kind in ("bui" if issubclass(wanted, np.integer) else "buif")


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
    kind, raw = find_cell_type(values["cell_type"]), values["raw"]
    if kind is None:
        return "cell_type"
    if raw.ndim != 2 or raw.shape[1] != kind.n_nodes:
        return "raw"
    colours = values["colours"]
    known = colours.shape == raw.shape[:1] and _between(colours, len(COLOURS))
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
    if not 0 <= values["colour"] < len(COLOURS):
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


def _arrows(values: Mapping[str, Any]) -> str:
    count = len(values["origins"])
    shapes = {"origins": (count, 3), "vectors": (count, 3), "nodes": (count,)}
    there = {n: shape for n, shape in shapes.items() if values.get(n) is not None}
    return next((n for n, shape in there.items() if values[n].shape != shape), "")


def _between(numbers: Any, stop: int) -> bool:
    return bool(((numbers >= 0) & (numbers < stop)).all())


_AGREEMENTS: dict[str, Callable[[Mapping[str, Any]], str]] = {
    "ArrowPart": _arrows,
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
