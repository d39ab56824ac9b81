"""What may stand at the cursor: operators, their keywords, procedures, variables, table indices."""

from __future__ import annotations

import re

from ssilang.language.registry import find_operator, keywords_of, operators_by_family
from ssilang.language.run.session import Session
from ssilang.language.values import Table
from ssilang.language.vocabulary import words_of

CONTROL = ("SI", "SINON", "FINSI", "REPETER", "FIN", "QUITTER", "ITERER", "DEBPROC", "FINPROC")
_WORD = re.compile(r"[@&!#%]?\w*$")
_TABLE_PATH = re.compile(r"([@&!]?\w+(?:\s*\.\s*(?:'[^']*'|\w+))*)\s*\.\s*('?)([^'.()]*)$")
_ANY_WORD = re.compile(r"[@&!]?[^\W\d]\w*|\*\*|[-+*/]")


def completions(text: str, session: Session) -> tuple[str, list[str]]:
    """Candidates for the end of `text`.

    Returns
    -------
    tuple
        The part of `text` that a candidate replaces, and the candidates, sorted.
    """
    in_table = _TABLE_PATH.search(text)
    if in_table is not None:
        table = _table(in_table.group(1), session)
        keys = {*_keys(table), *_declared_keys(table, session)}
        if keys:
            quote, typed = in_table.group(2), in_table.group(3)
            prefix = quote + typed
            return prefix, sorted(k for k in keys if _begins(k, prefix, typed))
    quoted = _open_quote(text)
    if quoted is not None:
        words = [f"'{w}'" for w in _keywords(text)]
        return "'" + quoted, sorted(w for w in words if w[1:].startswith(quoted.upper()))
    found = _WORD.search(text)
    prefix = found.group() if found else ""
    return prefix, sorted(w for w in _names(text, session) if w.startswith(prefix.upper()))


def _begins(key: str, prefix: str, typed: str) -> bool:
    return key.startswith(prefix) or key.strip("'").startswith(typed)


def _open_quote(text: str) -> str | None:
    """The text behind a quote that is not closed, None if all are."""
    parts = text.split("'")
    return parts[-1] if len(parts) % 2 == 0 else None


def _names(text: str, session: Session) -> set[str]:
    operators = {o.full_name for group in operators_by_family().values() for o in group}
    names = {n for n in operators if n[0].isalpha()} | {*CONTROL}
    names |= session.frame.names() | session.library.standard_names
    return names | set(_keywords(text))


def _statement(text: str) -> str:
    """The statement under the cursor."""
    bare = re.sub(r"'[^']*'", lambda m: " " * len(m.group()), text)
    return text[bare.rfind(";") + 1 :]


def _keywords(text: str) -> list[str]:
    """Keywords of the last operator named in the statement under the cursor."""
    for word in reversed(_ANY_WORD.findall(re.sub(r"'[^']*'?", " ", _statement(text)))):
        found = find_operator(word.upper())
        if found is not None and word[0].isalpha():
            return [*keywords_of(found), *words_of(found.name)]
    return []


def _table(path: str, session: Session) -> Table:
    """The table that a path such as T . 'A' names, an empty one if it names none."""
    names = [p.strip() for p in re.split(r"\s*\.\s*", path)]
    value = session.frame.find(names[0].upper())
    for name in names[1:]:
        if not isinstance(value, Table):
            break
        value = value.get(int(name) if name.isdigit() else name.strip("'"))
    return value if isinstance(value, Table) else Table()


def _keys(table: Table) -> list[str]:
    """Indices of a table, as they are written."""
    return [
        f"'{k}'" if isinstance(k, str) else str(k)
        for k, _ in table.items()
        if isinstance(k, str | int | float)
    ]


def _declared_keys(table: Table, session: Session) -> set[str]:
    """Entries of the procedures that take a table with the indices that this one has."""
    given = [k for k, _ in table.items() if k != "SOUSTYPE"]
    found: set[str] = set()
    for name in session.library.declared_names if given else ():
        declared = session.library.declared(name)
        for argument in declared.arguments if declared is not None else ():
            known = declared.inside((argument.name,)) if declared is not None else {}
            if all(isinstance(k, str) and k.rstrip() in known for k in given):
                found |= {f"'{e.index}'" for e in known.values() if e.is_read and len(e.index) > 1}
    return found
