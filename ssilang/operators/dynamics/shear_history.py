"""ZGAM: the largest shear strains behind the procedure ISSLEQ."""

from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.results.tensors import largest_shear_strain
from ssilang.kernel.stepping.node_histories import NodeHistories
from ssilang.operators.curves.evol import results_in_time
from ssilang.operators.curves.instants import AnyField, InstantField, RecordedFields
from ssilang.operators.prelude import *
from ssilang.operators.statics.stresses import tell_no_unknown

MOST_VALUES = 1 << 20
"""Values of element vectors held at a time."""


@operator("ZGAM", family="dynamics")
def zgam(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    motion: ListChpo | Table = Arg("LISTCHPO", "TABLE", en="displacements, or results of DYNAMIC"),
) -> CellField:
    """Largest strain zone by zone."""
    fields: Sequence[AnyField] = (
        results_in_time(motion, "DEPL", unmade=True)[0]
        if isinstance(motion, Table)
        else cast("list[NodeField]", motion.values)
    )
    if isinstance(motion, ListChpo):
        tell_no_unknown(call, cast(NodeField, fields[0]), model)
    layouts = [(z, families.family_of(z).layout(z)) for z in model.zones]
    blocks = (largest_shear_strain(z, _vectors(own, fields)) for z, own in layouts)
    return CellField(tuple(blocks), "SCALAIRE")


def _vectors(layout: Layout, fields: Sequence[AnyField]) -> Iterator[FloatArray]:
    """Element vectors (n_instants, n_cells, n_rows) of displacements, some instants at a time."""
    if isinstance(fields, RecordedFields):
        yield from _recorded(layout, fields.track)
        return
    for field in fields:
        made = field.make() if isinstance(field, InstantField) else field
        yield layout.gather(made)[None]


def _recorded(layout: Layout, track: NodeHistories) -> Iterator[FloatArray]:
    """As `_vectors`, of what was recorded: no field is made."""
    numbering = track.problem.numbering
    nodes = layout.table.resolve(layout.raw_nodes)[:, layout.local]
    at = numbering.index(nodes, np.array([numbering.code(name) for name in layout.unknowns]))
    there = np.isin(at, track.shown)
    places = np.searchsorted(track.unknowns, np.where(there, at, track.unknowns[0]))
    needed, inverse = np.unique(places, return_inverse=True)
    some = max(1, MOST_VALUES // at.size)
    for rows in track.pieces:
        values = rows.values("u", needed)
        for first in range(0, len(rows), some):
            part = values[first : first + some]
            yield np.where(there, part[:, inverse.reshape(at.shape)], 0.0)
