"""Entries that a script puts into a table for a procedure which does not have them."""

from __future__ import annotations

from collections.abc import Iterator

from ssilang.cli.checking.usage import statements_of
from ssilang.language.run.library import Library
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.vocabulary.entries import Declaration
from ssilang.language.vocabulary.unread_entries import reads, unread

Given = dict[str, dict[str, tree.Path]]
"""Of each table by its name, the entries that it was given last, and where."""


def unread_entries(script: tree.Script, library: Library) -> Iterator[SsiError]:
    """A warning at each such entry, in the order of the calls.

    A table is known by the name that it has at the call: what stands in it under other names, or
    at computed indices, is left to the run.
    """
    given: Given = {}
    bodies = [n.span for n in script.body if isinstance(n, tree.Definition)]
    procedures = "\n".join(s.source.code[s.start : s.end] for s in bodies)
    for statement in statements_of(script.body):
        yield from _call(statement, given, library, procedures)
        for target in statement.targets:
            if isinstance(target, tree.Name):
                given[target.text] = {}
            elif isinstance(target, tree.Path) and isinstance(target.base, tree.Name):
                index = target.indices[0]
                if len(target.indices) == 1 and isinstance(index, tree.Quoted):
                    given.setdefault(target.base.text, {})[index.text.rstrip()] = target


def _call(
    statement: tree.Statement, given: Given, library: Library, procedures: str
) -> Iterator[SsiError]:
    """Warnings about the tables that a statement calls a procedure of the library with."""
    if not statement.items or not isinstance(statement.items[0], tree.Name):
        return
    name = statement.items[0].text
    procedure = library.find(name) if name in library.standard_names else None
    declared = library.declared(name)
    if procedure is None or declared is None:
        return
    taken = [p.name for p in procedure.definition.parameters if p.type == "TABLE"]
    names = [i.text for i in statement.items[1:] if isinstance(i, tree.Name) and i.text in given]
    for argument, table in zip(taken, names, strict=False):
        read = {i for i in given[table] if any(True for _ in reads(procedures, i))}
        left = {i: target for i, target in given[table].items() if i not in read}
        yield from _unread(declared, argument, table, left, library)


def _unread(
    declared: Declaration, argument: str, table: str, given: dict[str, tree.Path], library: Library
) -> Iterator[SsiError]:
    for index, target in given.items():
        if index == "SOUSTYPE" or declared.at((argument,), index) is not None:
            continue
        text = target.span.source.code
        if any(parent == table for parent in reads(text, index)):
            continue
        said = unread(library, declared, (argument,), index, given.__contains__, text)
        if said is not None:
            yield SsiError(
                said[0], target.span, procedure=declared.name, where=f"'{index}'", **said[1]
            )
