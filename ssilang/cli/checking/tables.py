"""Entries that a script puts into a table for a procedure: unknown ones, and wrong values."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ssilang.cli.checking.kinds import ANY_WORD, kind_word
from ssilang.cli.checking.usage import phrases_in, reads_all, statements_of
from ssilang.language.run.library import Library
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.vocabulary.entries import Declaration
from ssilang.language.vocabulary.entry_checks import checked, meant_truth, truth_told
from ssilang.language.vocabulary.unread_entries import reads, unread

Given = dict[str, dict[str, tree.Path]]
"""Of each table by its name, the entries that it was given last, and where."""


Values = Mapping[int, Any]
"""What is known of the value of an entry, by where its target stands."""


def doubtful_entries(script: tree.Script, session: Session, values: Values) -> Iterator[SsiError]:
    """A warning at each unknown entry, the run's error at a wrong value, in the order of the calls.

    A table is known by the name that it has at the call, or had before COPI: what stands in it
    under other names, or at computed indices, is left to the run.
    """
    given: Given = {}
    called: dict[str, tuple[Declaration, str, tree.Statement]] = {}
    library = session.library
    bodies = [n.span for n in script.body if isinstance(n, tree.Definition)]
    procedures = "\n".join(s.source.code[s.start : s.end] for s in bodies)
    for statement in statements_of(script.body):
        for declared, argument, table in _calls(statement, given, library):
            read = {i for i in given[table] if any(True for _ in reads(procedures, i))}
            left = {i: target for i, target in given[table].items() if i not in read}
            yield from _unread(declared, argument, table, left, library)
            yield from _wrong(declared, argument, given[table], values, session)
            called[table] = declared, argument, statement
        for target in statement.targets:
            if isinstance(target, tree.Name):
                given[target.text] = _copied(statement, given)
            elif isinstance(target, tree.Path) and isinstance(target.base, tree.Name):
                index = target.indices[0]
                if len(target.indices) == 1 and isinstance(index, tree.Quoted):
                    given.setdefault(target.base.text, {})[index.text.rstrip()] = target
    yield from _late(script, {t: call for t, call in called.items() if t not in procedures})
    yield from _twice(script)


def _late(
    script: tree.Script, called: Mapping[str, tuple[Declaration, str, tree.Statement]]
) -> Iterator[SsiError]:
    """Entries set behind the last call that takes their table, and not read behind that.

    Loops come back to the call; a table that has another name too is left alone, as are those
    that stand in it, but for the one name that they have beside their index.
    """
    users: dict[str, list[str]] = {}  # of names, the first words of the statements with them
    inner: dict[str, dict[str, Sequence[tree.Item]]] = {}  # of tables, the names at their indices
    filled: dict[str, list[tuple[tree.Quoted, tree.Path, int]]] = {}  # and where what follows is
    for each in statements_of(script.body):
        if reads_all(each):
            return
        words = [i for items in phrases_in(each.items) for i in items if isinstance(i, tree.Name)]
        for word in words:
            users.setdefault(word.text, []).append(each.first_word[:4])
        for target in each.targets if len(each.items) == 1 and words else ():
            if isinstance(target, tree.Path):
                inner.setdefault(target.base.span.text, {})[words[0].text] = target.indices
    for node in script.body:
        target = (*node.targets, None)[0] if isinstance(node, tree.Statement) else None
        index = target.indices[-1] if isinstance(target, tree.Path) else None
        if not isinstance(target, tree.Path) or len(target.indices) > 1:
            continue
        if isinstance(index, tree.Quoted):
            filled.setdefault(target.base.span.text, []).append((index, target, node.span.end))
    for table, (declared, argument, call) in called.items():
        if {*users.get(table, ())} - {call.first_word[:4]}:
            continue
        once = {n: at for n, at in inner.get(table, {}).items() if len(users[n]) == 1}
        for name, indices in {table: (), **once}.items():
            way = [i.text for i in indices if isinstance(i, tree.Quoted)]
            for index, target, end in filled.get(name, ()):
                entry, code = declared.at((argument, *way), index.text), target.span.source.code
                if target.span.start < call.span.end or entry is None or not entry.is_read:
                    continue
                if name not in reads(code[end:], index.text):
                    told = {"procedure": declared.name, "where": f"'{index.text}'"}
                    yield SsiError("entry-behind-call", target.span, **told)


def _twice(script: tree.Script) -> Iterator[SsiError]:
    """Entries that are set again while nothing has read their table since.

    Tables that have another name too, or that procedures of the script may read, are left alone.
    """
    alone = [s.items[0] for s in statements_of(script.body) if s.targets and len(s.items) == 1]
    others = {i.text for i in alone if isinstance(i, tree.Name)}
    others |= _names_in(n for n in script.body if isinstance(n, tree.Definition))
    fresh: dict[str, set[str]] = {}  # by table
    for node in script.body:
        table, where, known = "", "", False
        if isinstance(node, tree.Statement):
            target = (*node.targets, None)[0]
            if isinstance(target, tree.Path) and isinstance(target.base, tree.Name):
                table, where = target.base.text, " . ".join(i.span.text for i in target.indices)
                known = all(isinstance(i, tree.Quoted) for i in target.indices)
                node = replace(node, targets=target.indices)
            if reads_all(node):
                fresh = {}
        for read in _names_in([node]) & fresh.keys():
            del fresh[read]
        if where in fresh.get(table, ()):
            yield SsiError("entry-twice", node.span, where=where)
        if known and table not in others:
            fresh.setdefault(table, set()).add(where)


def _names_in(nodes: Iterable[tree.Node]) -> set[str]:
    """Names that stand anywhere in statements."""
    parts = (i for s in statements_of(nodes) for i in tree.leaves((*s.items, *s.targets)))
    return {i.text for i in parts if isinstance(i, tree.Name)}


def _copied(statement: tree.Statement, given: Given) -> dict[str, tree.Path]:
    """Entries that a name's table has from the start: those of the table that it is a copy of."""
    items = statement.items
    if len(items) == 2 and isinstance(items[0], tree.Name) and isinstance(items[1], tree.Name):
        return dict(given.get(items[1].text, {})) if items[0].text.startswith("COPI") else {}
    return {}


def _calls(
    statement: tree.Statement, given: Given, library: Library
) -> Iterator[tuple[Declaration, str, str]]:
    """The tables that a statement calls procedures of the library with: argument and name."""
    for items in phrases_in(statement.items):
        name = items[0].text if items and isinstance(items[0], tree.Name) else ""
        procedure = library.find(name) if name in library.standard_names else None
        declared = library.declared(name) if procedure is not None else None
        if procedure is None or declared is None:
            continue
        taken = [p.name for p in procedure.definition.parameters if p.type == "TABLE"]
        names = [i.text for i in items[1:] if isinstance(i, tree.Name) and i.text in given]
        for argument, table in zip(taken, names, strict=False):
            yield declared, argument, table


def _wrong(
    declared: Declaration,
    argument: str,
    given: dict[str, tree.Path],
    values: Values,
    session: Session,
) -> Iterator[SsiError]:
    """The refusal of each value that is of another type, or no allowed word."""
    for index, target in given.items():
        entry, value = declared.at((argument,), index), values.get(target.span.start)
        kind = kind_word(value) if value is not None and value is not ANY_WORD else ""
        if entry is None or not entry.is_read or not kind:
            continue
        value = 1 if kind == "ENTIER" else value
        name = declared.name
        meant = meant_truth(entry, value)
        if meant is not value:
            told = truth_told(name, (argument, index), meant)
            yield SsiError("word-of-truth", target.span, **told)
            continue
        try:
            checked(session, entry, value, (argument, index), procedure=name, operator=name)
        except SsiError as error:
            error.span = target.span
            yield error


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
