"""Which procedure's declaration holds for a table of the script, told by its calls and entries."""

from collections.abc import Iterator, Sequence

from ssilang.cli.editor.document import Document
from ssilang.cli.editor.tokens import Token
from ssilang.language.run.library import Library
from ssilang.language.vocabulary.entries import Declaration, TableEntry

Holder = tuple[Declaration, str]
"""A declaration, and the name of the argument that a table is."""


def holders(table: str, document: Document, library: Library) -> list[Holder]:
    """The procedures that the script gives a table to; else those that have all its entries."""
    called = list(_called(table, document, library))
    return called or list(suiting(_given(document).get(table, set()), library))


def entries_at(
    path: Sequence[Token], document: Document, library: Library
) -> list[tuple[Declaration, TableEntry]]:
    """The entries that an index behind a path may be."""
    found = []
    for declaration, argument in holders(path[0].name, document, library) if path else ():
        place = (argument, *(t.name for t in path[1:]))
        found += [(declaration, e) for e in declaration.inside(place).values()]
    return found


def _called(table: str, document: Document, library: Library) -> Iterator[Holder]:
    """Procedures in whose calls the name stands, as which of their tables."""
    declared = set(library.declared_names)
    given = _given(document)
    for phrase in document.phrases:
        names = [t for t in phrase.cut.tokens if t.kind == "WORD"]
        for i, token in enumerate(names):
            if token.name not in declared or token.name in given:
                continue
            behind = [t.name for t in names[i + 1 :] if t.name in given]
            declaration = library.declared(token.name)
            if declaration is None or table not in behind:
                continue
            at = behind.index(table)
            if at < len(declaration.arguments):
                yield declaration, declaration.arguments[at].name


def _given(document: Document) -> dict[str, set[str]]:
    """Indices of each table that the script makes or gives values to."""
    found: dict[str, set[str]] = {}
    for phrase in document.phrases:
        cut, equal = phrase.cut, phrase.cut.equal or 0
        tokens, value = cut.tokens[:equal], cut.tokens[equal + 1 : equal + 2]
        if len(tokens) >= 3 and tokens[1].kind == "_DOT":
            found.setdefault(tokens[0].name, set()).add(tokens[2].name)
        elif len(tokens) == 1 and value and value[0].name in ("TABL", "TABLE"):
            found.setdefault(tokens[0].name, set())
    return found


def suiting(indices: set[str], library: Library) -> Iterator[Holder]:
    """Procedures and operators whose tables have all of some indices, if there are any."""
    given = indices - {"SOUSTYPE"}
    for name in library.declared_names if given else ():
        declaration = library.declared(name)
        for argument in declaration.arguments if declaration is not None else ():
            assert declaration is not None
            if all(index in declaration.inside((argument.name,)) for index in given):
                yield declaration, argument.name
