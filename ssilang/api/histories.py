"""Histories out of tables of results: one curve, or all of them at once."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.api.errors import MissingKey, refused
from ssilang.api.fields import node_axes
from ssilang.api.view import library
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import MULTIPLIER, Numbering, field_to_vector
from ssilang.language.search import nearest_told
from ssilang.language.values import LazyRows, Table
from ssilang.operators.curves.evol import results_in_time
from ssilang.operators.curves.instants import InstantField, RecordedFields

if TYPE_CHECKING:
    import xarray


def is_results(value: object) -> bool:
    """Whether a value is a table of results in time: of DYNAMIC, or PASAPAS after its run."""
    if isinstance(value, LazyRows):
        return True
    if not isinstance(value, Table):
        return False
    first = value.get(1)
    steps = isinstance(first, Table) and first.has("TEMP")
    return steps or (isinstance(value.get("TEMPS"), Table) and len(words_of(value)) > 1)


def words_of(table: Table) -> list[str]:
    """What a table of results holds in time: DEPL, VITE ... or DEPLACEMENTS ..."""
    if isinstance(table, LazyRows):
        return [word for word in table.words if word != "TEMP"]
    first = table.get(1)
    if isinstance(first, Table):
        return [str(i).rstrip() for i in first.indices() if i != "TEMP"]
    count = len(table.get("TEMPS"))  # type: ignore[arg-type]
    return [
        str(i).rstrip()
        for i, v in table.items()
        if isinstance(i, str) and isinstance(v, Table) and len(v) == count and i != "TEMPS"
    ]


def full_word(table: Table, word: str, language: str) -> str:
    """The index of a table of results that a word means: DEPL of DEPLACEMENTS too.

    Raises
    ------
    MissingKey
        If the table has nothing of that name in time.
    """
    known = words_of(table)
    for index in (word, *known):
        if index in known and index.startswith(word):
            return index
    told = {"word": word, **nearest_told(word, known)}
    raise refused("api.no-such-result", language, MissingKey, **told)


def over_time(table: Table, word: str, language: str) -> "xarray.DataArray":
    """All values of nodal fields in time, (time, node, component)."""
    fields, times = results_in_time(table, full_word(table, word, language), unmade=True)
    nodes, names, values, points = _arrays(fields)
    return library("xarray", language).DataArray(
        values,
        dims=("time", "node", "component"),
        coords={"time": times, "node": nodes + 1, "component": names, **node_axes(points)},
        name=word,
    )


def _arrays(fields: Sequence[Any]) -> tuple[IntArray, list[str], FloatArray, FloatArray]:
    """Nodes (n,), components, values (n_times, n, n_components) NaN where absent, points (n, 3).

    What was recorded, or is not made yet, is taken as it stands: no field is made of it.
    """
    if isinstance(fields, RecordedFields):
        track, numbering = fields.track, fields.track.problem.numbering
        return _placed(numbering, track.shown, track.values(fields.name, track.shown))
    numberings = {id(f.numbering): f.numbering for f in fields if isinstance(f, InstantField)}
    if len(numberings) == 1:
        (numbering,) = numberings.values()
        rows = [
            f.vector
            if isinstance(f, InstantField)
            else field_to_vector(f, numbering, dual=False, absent=np.nan)
            for f in fields
        ]
        return _placed(numbering, np.arange(numbering.size), np.array(rows))
    return _of_fields([f.make() if isinstance(f, InstantField) else f for f in fields])


def _of_fields(
    fields: Sequence[NodeField],
) -> tuple[IntArray, list[str], FloatArray, FloatArray]:
    """As `_arrays`, of fields that may have any nodes and components; multipliers left out."""
    names = list(dict.fromkeys(n for f in fields for n in f.components if n != MULTIPLIER))
    parts = [f.components[n].nodes for f in fields for n in names if n in f.components]
    nodes = np.unique(np.concatenate([np.zeros(0, np.int64), *parts]))
    values = np.array([[f.values_at(n, nodes, np.nan) for n in names] for f in fields])
    return nodes, names, values.transpose(0, 2, 1), fields[0].table.coordinates[nodes]


def _placed(
    numbering: Numbering, at: IntArray, rows: FloatArray
) -> tuple[IntArray, list[str], FloatArray, FloatArray]:
    """As `_arrays`, of rows (n_times, p) of some unknowns."""
    nodes, places = np.unique(numbering.nodes[at], return_inverse=True)
    codes, columns = np.unique(numbering.codes[at], return_inverse=True)
    values = np.full((len(rows), len(nodes), len(codes)), np.nan)
    values[:, places, columns] = rows
    names = [numbering.unknowns[code] for code in codes.tolist()]
    return nodes, names, values, numbering.table.coordinates[nodes]


def nodes_of(table: Table, word: str, component: str) -> IntArray:
    """Nodes (n,) where a component was saved, of the first instant; none if it was not."""
    fields, _ = results_in_time(table, word, unmade=True)
    if isinstance(fields, RecordedFields):
        track, numbering = fields.track, fields.track.problem.numbering
        if component not in numbering.unknowns:
            return np.zeros(0, dtype=np.int64)
        codes = numbering.codes[track.shown]
        return numbering.nodes[track.shown[codes == numbering.code(component)]]
    first = fields[0].make() if isinstance(fields[0], InstantField) else fields[0]
    part = first.components.get(component) if isinstance(first, NodeField) else None
    return np.zeros(0, dtype=np.int64) if part is None else part.nodes
