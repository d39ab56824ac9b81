"""POD: proper orthogonal decomposition of fields."""

from ssilang.kernel.fields.proper_orthogonal import as_fields, modes, stacked
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.operators.prelude import *

_METHOD = choice("method", ("SNAPSHOTS", "CLASSIQUE"), en="for few fields, or for few unknowns")


_TABLE = flag("table", "TBAS", en="the result is a table BASE_MODALE")


_OPTIONS = (
    opt("numbers", "LISTENTI", en="fields to take, by number", range=POSITIVE),
    opt("names", "LISTMOTS", kind="component", en="components"),
    opt("matrix", "RIGIDITE", en="scalar product, a mass"),
    arg("count", "ENTIER", range=POSITIVE, en="number of modes"),
    opt("support", "MAILLAGE", en="mesh told by the table"),
)


@operator(
    "POD",
    _METHOD,
    _TABLE,
    arg("fields", "LISTCHPO", en="fields"),
    *_OPTIONS,
    gives=by("table", {True: "TABLE"}, ("LISTCHPO", "LISTREEL")),
    family="modal",
    full_name="POD",
)
def pod(call: Call, fields: ListChpo, **said: Any) -> Table | tuple[ListChpo, ListReel]:
    """Orthogonal decomposition of a list of fields."""
    pairs = {i: f for i, f in enumerate(fields.values, 1) if isinstance(f, NodeField)}
    return _decomposed(call, fields, pairs, **said)


@pod.form(
    _METHOD,
    _TABLE,
    arg("result", "TABLE", en="result of a calculation"),
    opt("entry", "MOT", en="entry that holds the fields"),
    *_OPTIONS,
    gives=by("table", {True: "TABLE"}, ("LISTCHPO", "LISTREEL")),
)
def pod_of_table(
    call: Call, result: Table, entry: str | None, **said: Any
) -> Table | tuple[ListChpo, ListReel]:
    """Orthogonal decomposition of the fields of a result."""
    usual = "DEPLACEMENTS" if result.has("DEPLACEMENTS") else "DEPL"
    word = Mot(usual if entry is None else entry.rstrip().upper())
    inner = result.get(word)
    source = inner if isinstance(inner, Table) else result
    found = {}
    for index, value in source.items():
        item = value.get(word) if isinstance(value, Table) else value
        if type(index) is int and isinstance(item, NodeField):
            found[index] = item
    if not found:
        raise call.error("operators.fields.table-has-no-fields", result, name=word)
    return _decomposed(call, result, dict(sorted(found.items())), **said)


def _decomposed(
    call: Call,
    held: ListChpo | Table,
    fields: dict[int, NodeField],
    method: str | None,
    table: bool,
    numbers: ListEnti | None,
    names: ListMots | None,
    matrix: Matrix | None,
    count: int,
    support: Mesh | None,
) -> Table | tuple[ListChpo, ListReel]:
    if not fields:
        raise call.error("operators.fields.no-field-to-decompose", held)
    if method is None:
        raise call.error("operators.fields.pod-method-and-count")
    if numbers is not None:
        missing = [int(i) for i in numbers.values if int(i) not in fields]
        if missing:
            raise call.error("operators.fields.no-field-number", numbers, number=missing[0])
        fields = {int(i): fields[int(i)] for i in numbers.values}
    wanted = None if names is None else [str(n).rstrip() for n in names.values]
    given = list(fields.values())
    series, places = stacked(given, wanted)
    metric = None if matrix is None else _metric(matrix, places)
    rows, values = modes(series, count, method == "SNAPSHOTS", metric)
    made = as_fields(rows, places, given[0])
    if not table:
        return ListChpo(list(made)), ListReel(values)
    return _basis(call, made, values, support)


def _metric(matrix: Matrix, places: Any) -> sp.csr_array:
    """The matrix on the unknowns of the fields, in their order."""
    numbering = numbering_of(matrix)
    index = np.concatenate([numbering.index(nodes, numbering.code(n)) for n, nodes in places])
    inside = index >= 0
    n, rows = len(index), np.flatnonzero(inside)
    pick = sp.coo_array(
        (np.ones(len(rows)), (rows, index[inside])), shape=(n, numbering.size)
    ).tocsr()
    return sp.csr_array(pick @ assemble(matrix, numbering) @ pick.T)


def _basis(call: Call, fields: list[NodeField], values: Any, support: Mesh | None) -> Table:
    ws = workspace(call.session)
    made, inner = Table("BASE_MODALE"), Table("BASE_DE_MODES")
    for table in (made, inner) if support is not None else ():
        table.set(Mot("MAILLAGE"), support)
    for number, (field, value) in enumerate(zip(fields, values, strict=True), 1):
        mode = Table("MODE")
        mode.set(Mot("POINT_REPERE"), ws.point([0.0] * max(ws.dimension, 1)))
        mode.set(Mot("NUMERO_MODE"), number)
        mode.set(Mot("VALEUR_PROPRE"), float(value))
        mode.set(Mot("FREQUENCE"), float(np.sqrt(max(value, 0.0)) / (2.0 * np.pi)))
        mode.set(Mot("DEFORMEE_MODALE"), field)
        inner.set(number, mode)
    made.set(Mot("MODES"), inner)
    return made
