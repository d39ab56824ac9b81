"""What an editor knows of the library, against what the language reads in it; whose tables are."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from together import together

from ssilang.cli.editor.document import Document, holders
from ssilang.language.text import tree
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse

LIBRARY = sorted((Path(__file__).parents[3] / "stdlib").glob("*.ssi"))
READERS = ("ACQU", "ARGU", "LIRE", "NOMM", "OBTE")


def parts(node: Any) -> Iterator[Any]:
    """A node and all that stands in it."""
    if isinstance(node, tuple):
        for one in node:
            yield from parts(one)
    elif is_dataclass(node):
        yield node
        for field in fields(node):
            if field.name not in ("span", "cache"):
                yield from parts(getattr(node, field.name))


def given(statement: tree.Statement) -> list[tree.Name]:
    """Names that get a value."""
    reads = statement.items[1:] if statement.first_word[:4] in READERS else ()
    return [item for item in (*statement.targets, *reads) if isinstance(item, tree.Name)]


@together("path", LIBRARY)
def test_names_are_those_that_the_language_reads(path):
    document = Document.of(path.read_text(encoding="utf-8"), path)
    script = parse(Source(str(path), document.source.text, path))
    found = document.names.found
    assert [o.start for o in found] == sorted(o.start for o in found)
    assert all(o.whole.start <= o.start < o.end <= o.whole.end for o in found)
    headings = [part for part in parts(script) if isinstance(part, tree.Definition)]
    assert [o.name for o in found if o.kind == "procedure" and o.defines] == [
        h.name for h in headings
    ]
    assert [(o.scope, o.name) for o in found if o.kind == "parameter"] == [
        (i, p.name) for i, h in enumerate(headings, 1) for p in h.parameters
    ]
    assert {o.scope for o in found if o.kind != "procedure"} <= set(range(len(headings) + 1))
    statements = [part for part in parts(script) if isinstance(part, tree.Statement)]
    spans = {(n.span.start, n.span.end) for s in statements for n in given(s)}
    assert {(o.start, o.end) for o in found if o.kind == "variable" and o.defines} == spans
    loops = [part for part in parts(script) if isinstance(part, tree.Loop)]
    assert [o.name for o in found if o.kind == "loop" and o.defines] == [
        "&" + loop.name for loop in loops
    ]


@together("path", LIBRARY)
def test_a_name_of_a_procedure_is_renamed_wherever_it_is_meant(path):
    """The renamed text is read as the old one was, with another name in the same places."""
    document = Document.of(path.read_text(encoding="utf-8"), path)
    names = document.names
    script = parse(Source(str(path), document.source.text, path))
    headings = [part for part in parts(script) if isinstance(part, tree.Definition)]
    for first in {o.name: o for o in names.found if o.kind == "parameter"}.values():
        alike = names.alike(first)
        assert {o.name for o in alike} == {first.name}
        assert {o.scope for o in alike} == {first.scope}
        assert all(names.at(o.start) == o == names.at(o.end) for o in alike)
        assert first in names.definitions(first)
        assert first.name in names.visible(first.scope)
        assert first.name not in names.visible(0)
        heading = headings[first.scope - 1]
        told = [n.span.start for n in parts(heading.body) if isinstance(n, tree.Name)
                and n.text == first.name]  # fmt: skip
        indices = {i.span.start for n in parts(heading.body) if isinstance(n, tree.Path)
                   for i in n.indices}  # fmt: skip
        assert {o.start for o in alike} >= set(told) - indices


PROCEDURES = SimpleNamespace(
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
        assert [name for _, name in holders(table, document, PROCEDURES)] == names
