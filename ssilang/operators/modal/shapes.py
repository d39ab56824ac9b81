"""NNOR, TABLE * RIGIDITE, JEU: shapes made of unit size, inertia of shapes, gaps of relations."""

from ssilang.kernel.matrices.assembly import assemble, field_to_vector, numbering_of
from ssilang.kernel.matrices.imposed import geometric_gaps
from ssilang.kernel.statics.linear import product
from ssilang.operators.modal.basis import shapes_in
from ssilang.operators.numbers.arithmetic import rule
from ssilang.operators.prelude import *

# --- unit size -------------------------------------------------------------------------------


_THING = arg("thing", "CHPOINT", "TABLE", en="field, or basis")


@operator("NNOR", gives=Like("thing"), family="modal", full_name="NNOR")
def _nnor(
    call: Call,
    largest: bool = Flag("INFI", en="by the largest value, the default"),
    thing: NodeField | Table = _THING,
    side: str | None = Choice(
        ("AVEC", "SANS"), en="of the components named (default), or of the others"
    ),
    names: ListMots | None = Opt("LISTMOTS", en="components", kind="component"),
) -> NodeField | Table:
    chosen = None if names is None else {str(w).rstrip() for w in names.values}
    return _of_unit_size(thing, lambda f: _largest(call, f, chosen, side == "SANS"))


def _of_unit_size(
    thing: NodeField | Table, size: Callable[[NodeField], float]
) -> NodeField | Table:
    if isinstance(thing, NodeField):
        return _divided(thing, size(thing))
    return _unit_basis(thing, size)


def _largest(call: Call, field: NodeField, names: set[str] | None, without: bool) -> float:
    chosen = [
        part.values
        for name, part in field.components.items()
        if names is None or (name in names) != without
    ]
    top = max((float(np.abs(v).max(initial=0.0)) for v in chosen), default=0.0)
    if top == 0.0:
        raise call.error("operators.modal.field-is-zero", field)
    return top


def _euclidean(field: NodeField, metric: Matrix | None) -> float:
    if metric is None:
        return float(np.sqrt(sum(float(p.values @ p.values) for p in field.components.values())))
    numbering = numbering_of(metric)
    x = field_to_vector(field, numbering, dual=False)
    return float(np.sqrt(x @ (assemble(metric, numbering) @ x)))


def _divided(field: NodeField, size: float) -> NodeField:
    parts = {k: replace(p, values=p.values / size) for k, p in field.components.items()}
    return NodeField(field.table, parts, field.nature)


def _unit_basis(table: Table, size: Any) -> Table:
    """A copy of a BASE_MODALE or BASE_DE_MODES table with shapes of size one."""
    inner = table.get("MODES")
    if isinstance(inner, Table):
        rest = {i: v for i, v in table.items() if i not in ("MODES", "SOUSTYPE")}
        return Table.of({**rest, "MODES": _unit_basis(inner, size)}, table.subtype)
    made = Table(table.subtype)
    for index, entry in table.items():
        shape = entry.get("DEFORMEE_MODALE") if isinstance(entry, Table) else None
        if isinstance(entry, Table) and isinstance(shape, NodeField):
            entry = _unit_mode(entry, shape, size(shape))
        made.set(index, entry)
    return made


def _unit_mode(entry: Table, shape: NodeField, by: float) -> Table:
    """A mode's table after its shape was divided by a number."""
    made = Table()
    for index, value in entry.items():
        if index == "DEFORMEE_MODALE":
            value = _divided(shape, by)
        elif index == "MASSE_GENERALISEE" and isinstance(value, float):
            value = value / by**2
        elif index == "DEPLACEMENTS_GENERALISES" and isinstance(value, Table):
            scaled = {i: v / by for i, v in value.items() if isinstance(v, float)}
            value = Table.of(scaled, value.subtype)
        made.set(index, value)
    return made


@_nnor.form(said("EUCL"), gives=Like("thing"))
def by_euclidean_norm(
    thing: NodeField | Table = _THING,
    metric: Matrix | None = Opt("RIGIDITE", en="matrix of the norm"),
) -> NodeField | Table:
    """Shapes of Euclidean norm one."""
    return _of_unit_size(thing, lambda f: _euclidean(f, metric))


# --- inertia of shapes -----------------------------------------------------------------------


@rule("*", "TABLE", "RIGIDITE")
@rule("*", "RIGIDITE", "TABLE")
def _inertia(_sign: str, left: Any, right: Any) -> Table:
    """MASSE_DEFORMEE of each shape of a table of modes or static links, which is completed."""
    table, mass = (left, right) if isinstance(left, Table) else (right, left)
    found = shapes_in(table)
    if not found:
        raise KernelError("operators.modal.nothing-to-multiply")
    for shape in found:
        shape.entry.set(Mot("MASSE_DEFORMEE"), product(mass, shape.field))
    return table


# --- gaps ------------------------------------------------------------------------------------


@operator("JEU", family="relations")
def jeu(matrix: Matrix = Arg("RIGIDITE", en="relations")) -> NodeField:
    """Values -C x of the relations."""
    return geometric_gaps(matrix)
