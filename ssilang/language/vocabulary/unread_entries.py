"""Entries of tables that nobody reads: which one was meant, or whose it is."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache

from ssilang.language.run.library import Library
from ssilang.language.search import meant as near_word
from ssilang.language.vocabulary.entries import BOTH, READ, REFUSED, WRITTEN, Declaration

_COUNTS = (READ, WRITTEN, BOTH)


def unread(
    library: Library,
    declared: Declaration,
    path: tuple[str, ...],
    word: str,
    given: Callable[[str], bool],
    script: str,
) -> tuple[str, dict[str, str]] | None:
    """Code and data of the warning of an index that a procedure does not declare.

    Parameters
    ----------
    path : tuple of str
        Where the table is declared.
    given : function
        Whether another entry is given.
    script : str
        Text of the script: a table may go on to the other procedures that it names.

    Returns
    -------
    tuple or None
        None if the entry belongs to another procedure that the script calls, or that comes before.
    """
    known = declared.inside(path).values()
    meant = next((e.index for e in known if word.upper() in e.means and not given(e.index)), "")
    others = [] if meant else [n for n in library.declared_names if n != declared.name]
    # what had the table before, and what the script calls, come first: most tables end there, and
    # the others are not read then
    before = {*declared.after(path[0]), *_called(script)}
    if _owners(library, [name for name in others if name in before], word):
        return None
    owners = _owners(library, others, word)
    readers = " ".join(owner for owner, reads in owners.items() if reads)
    near = meant or near_word(word, (e.index for e in known if e.role != REFUSED))
    code = "entry-unknown" if near else "entry-of-another" if readers else "entry-unread"
    return code, {"near": near, "owners": readers}


def _owners(library: Library, names: Iterable[str], word: str) -> dict[str, bool]:
    """Which of these have an entry of that name, and whether they read it."""
    found: dict[str, bool] = {}
    for name in names:
        other = library.declared(name)
        if other is None:
            continue
        own = [e for e in other.entries if e.index == word and e.role in _COUNTS]
        if own:
            found[name] = any(e.is_read and not e.taken_over for e in own)
    return found


@lru_cache(maxsize=8)
def _called(text: str) -> frozenset[str]:
    """Names that stand in a script, strings aside, in capitals."""
    return frozenset(name.upper() for name in re.findall(r"(?<![\w'@])@?\w+", text))


def reads(text: str, word: str) -> Iterator[str]:
    """What stands before each index `word` that a text reads: a name, or the end of a path.

    Also the tables that the text asks for it (EXIS), or for all their indices (INDE).
    """
    read = _read(text)
    yield from read.before.get(word, ())
    yield from (table for table, rest in read.asked if f"'{word.upper()}'" in rest)
    yield from read.listed


@dataclass(frozen=True)
class _Read:
    """What a text reads of tables: in front of each index, asked by EXIS, listed by INDE."""

    before: dict[str, list[str]]
    asked: list[tuple[str, str]]
    listed: list[str]


# the index is looked at only: it may be the base of the next one
_INDEX = re.compile(r"([@&!]?\w+|['\)])\s*\.\s*(?=(?:'([^']*)'|(\w+))\s*(=?))")
_ASKED = re.compile(r"\bEXIS\w*\s+\(?\s*([@&!]?\w+)([^;]*)", re.IGNORECASE)
_LISTED = re.compile(r"\bINDE\w*\s+([@&!]?\w+)", re.IGNORECASE)


@lru_cache(maxsize=8)
def _read(text: str) -> _Read:
    before: dict[str, list[str]] = {}
    for found in _INDEX.finditer(text):
        base, quoted, bare, sign = found.groups()
        if not sign:
            index = bare.upper() if quoted is None else quoted.rstrip()
            before.setdefault(index, []).append(base.upper())
    asked = [(m.group(1).upper(), m.group(2).upper()) for m in _ASKED.finditer(text)]
    return _Read(before, asked, [m.group(1).upper() for m in _LISTED.finditer(text)])
