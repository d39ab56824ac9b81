"""TABL INDE OTER ETG and tables in DIME, ENLE, COPI; tables of type VECTEUR in sums."""

from ssilang.kernel.mesh.combine import gathered
from ssilang.operators.dispatch import COPI, DIME, ENLE, unite_all
from ssilang.operators.numbers.arithmetic import rule
from ssilang.operators.prelude import *
from ssilang.operators.texts.words import type_word

TABL = shared("TABL", "tables", full_name="TABLE")


@TABL.form()
def _same(table: Table = Arg("TABLE", en="table that gets a further name")) -> Table:
    return table


@TABL.form()
def _new(subtype: str = Opt("MOT", default="", en="sub-type")) -> Table:
    return Table(str(subtype))


INDE = shared("INDE", "tables", full_name="INDEX")


@INDE.form()
def _indices(table: Table = Arg("TABLE", en="table whose indices are wanted")) -> Table:
    return Table.numbered(table.indices())


@INDE.form()
def _named(
    call: Call,
    star: bool = Flag("*", en="stands before a type word"),
    said: str = Arg("MOT", en="type word"),
) -> Table:
    kind, named = type_word(call, said), call.session.frame.named()
    return Table.of({name: value for name, value in named.items() if type_of(value) == kind})


@DIME.form()
def _table_size(table: Table = Main("TABLE", en="table")) -> int:
    return len(table)


@ENLE.form()
def _without(
    call: Call,
    table: Table = Main("TABLE", en="table"),
    index: Any = Arg("*", "TEXTE", en="index to leave out"),
) -> Table:
    if not table.has(index):
        raise call.error("no-index", index=index, known=[k for k, _ in table.items()])
    made = copied(table)
    made.remove(index)
    return made


def copied(table: Table) -> Table:
    """A new table with the same indices and values."""
    return Table.of(table.items())


@COPI.form()
def _copy_table(table: Table = Main("TABLE", en="table")) -> Table:
    return copied(table)


@rule("+ -", "TABLE", "TABLE")
def _add_vectors(sign: str, a: Table, b: Table) -> Table:
    _check_vectors(a, b)
    made = copied(a)
    for index, value in b.items():
        if index == "SOUSTYPE":
            continue
        before: Any = a.get(index, 0.0)
        made.set(index, before + value if sign == "+" else before - value)
    return made


def _scale_vector(sign: str, table: Table, factor: float) -> Table:
    _check_vectors(table)
    made = copied(table)
    for index, value in table.items():
        if isinstance(value, int | float):
            made.set(index, value * factor if sign == "*" else value / factor)
    return made


def _check_vectors(*tables: Table) -> None:
    for table in tables:
        if table.subtype != "VECTEUR":
            raise NoResultError("operators.tables.not-a-vector", subtype=table.subtype)


for _kind in ("ENTIER", "FLOTTANT"):
    rule("* /", "TABLE", _kind)(_scale_vector)
    rule("*", _kind, "TABLE")(lambda sign, factor, table: _scale_vector(sign, table, factor))


@operator("OTER", family="tables")
def oter(
    call: Call, table: Table = Arg("TABLE", en="table"), index: Any = Arg(en="index to remove")
) -> None:
    """Forget an index."""
    if not table.has(index):
        raise call.error("no-index", index, index=index, known=[k for k, _ in table.items()])
    table.remove(index)


@operator("ETG", gives=ANY, family="objects")
def etg(call: Call, table: Table = Arg("TABLE", en="objects at 1, 2 ...")) -> Any:
    """Union of a table's objects."""
    if table.subtype != "ESCLAVE":
        raise call.error("operators.tables.wrong-subtype", table, subtype=table.subtype)
    values = [v for index, v in table.items() if type(index) is int]
    if values and all(isinstance(v, Mesh) for v in values):
        return gathered([v for v in values if isinstance(v, Mesh)])
    return unite_all(call, table, values)
