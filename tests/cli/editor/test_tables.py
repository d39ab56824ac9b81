"""Which procedure a table is given to, and as which of its arguments."""

from types import SimpleNamespace

from together import together

from ssilang.cli.editor.document import Document, holders

LIBRARY = SimpleNamespace(
    declared_names=["@PA", "@PB"],
    declared={
        name: SimpleNamespace(arguments=[SimpleNamespace(name=n) for n in arguments])
        for name, arguments in {"@PA": ["first", "second"], "@PB": ["only"]}.items()
    }.get,
)
GIVEN = "ZT . 'A' = 1 ; AT . 'B' = 2 ; MT = TABL ; "


@together(
    "call, found",
    [
        ("X = @PA ZT AT ;", {"ZT": ["first"], "AT": ["second"]}),
        ("X = @PA 3. AT 'MOT' ZT ;", {"AT": ["first"], "ZT": ["second"]}),
        ("X = @PA MT ZT ;", {"ZT": ["second"], "MT": ["first"]}),
        ("X = @PB AT ZT ;", {"AT": ["only"]}),
        ("@PB ZT ; Y = 2 * (@PA AT ZT) ;", {"ZT": ["only", "second"], "AT": ["first"]}),
    ],
)
def test_a_table_is_the_argument_whose_place_it_takes(call, found):
    document = Document.of(GIVEN + call)
    for table, names in found.items():
        assert [name for _, name in holders(table, document, LIBRARY)] == names
