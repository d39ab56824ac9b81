"""The entries of the tables that procedures take, declared in a file beside the procedure.

`stdlib/dynamic.toml` stands beside `stdlib/dynamic.ssi`; an operator that takes tables has a file
of its full name. A section says where an entry stands, as a script would write it::

    [TAB1.times.TEMPS_CALCULES]              argument, theme, index
    types = ["LISTREEL"]
    unit = "s"
    range = "increasing"                     also "> 0", "0 <= x < 0.5"; outside of `usual` told
    en = "instants of the calculation"
    fr = "instants du calcul"

    [TAB1.results."RESULTATS.I.TEMP"]        I : any integer; * : any index
    [TAB1.problem."F1,F2"]                   two entries of which the same is said

`like` takes entries over from another file, of all themes or of those named behind it; in the
section of an argument these are its own, in that of an entry those of the table it holds. `after`
in the section of an argument names procedures that its table comes from: what these have in it is
theirs, and no entry of this one that would be misspelt. `replaceable = true` above all sections: a
script is meant to write its own procedure of that name.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any

from ssilang.language.registry import find_operator
from ssilang.language.vocabulary.terms import UNSAID, Range, read_range
from ssilang.messages.message import spoken
from ssilang.remembered import tables_of
from ssilang.resources import resource

NUMBER, ANYTHING = "I", "*"
"""Stand in a path for any integer index, and for any index."""

WRITTEN, READ, BOTH, UNUSED, REFUSED = "written", "read", "both", "unused", "refused"
"""`unused` entries are accepted and change nothing, `refused` ones are not available."""

_TABLES = tables_of(Path(__file__).with_suffix(".toml"))
THEMES: tuple[str, ...] = tuple(_TABLES["themes"])
"""Groups of entries in the order in which they are shown."""
MADE_BY: dict[str, str] = _TABLES["made_by"]
"""How objects of a type are mostly made."""


@dataclass(frozen=True, slots=True)
class TableEntry:
    """One entry of a table.

    Attributes
    ----------
    path : tuple of str
        Argument and indices, such as ('TAB1', 'RESULTATS', 'I', 'TEMP').
    types : tuple of str
        Type words; FLOTTANT takes an ENTIER. Empty: any object.
    default : number, bool, word, or (English, French)
        What counts if the entry is not given; a pair only says it. Given to an unused entry, it
        is what happens anyway.
    values : tuple of str
        Words that a MOT may be.
    length : int
        Letters that count in them, in either case; 0: all, as EGA compares.
    older : dict
        Further words that are accepted, with the word that each stands for.
    needed : bool
        Whether the procedure cannot do without it.
    means : tuple of str
        What other procedures, or habit, call the same thing.
    range, usual : Range
        Numbers outside of `range` are refused, outside of `usual` told.
    only : dict
        Words of entries beside it without which it counts for nothing.
    under : str
        A word of OPTI under which it counts in any case.
    over : str
        Unit of the abscissas of a curve.
    by : str
        What any index is the name of: 'unknown'.
    """

    path: tuple[str, ...]
    types: tuple[str, ...]
    theme: str
    en: str
    fr: str
    role: str = READ
    unit: str = ""
    default: Any = None
    values: tuple[str, ...] = ()
    older: Mapping[str, str] | None = None
    length: int = 0
    needed: bool = False
    means: tuple[str, ...] = ()
    taken_over: bool = False
    range: Range = UNSAID
    usual: Range = UNSAID
    only: Mapping[str, Sequence[str]] | None = None
    under: str = ""
    over: str = ""
    by: str = ""

    @property
    def index(self) -> str:
        """Its last index."""
        return self.path[-1]

    def said(self, language: str) -> str:
        """What it is."""
        return spoken(self.en, self.fr, language)

    @property
    def is_read(self) -> bool:
        """Whether the procedure looks at what the script puts there."""
        return self.role in (READ, BOTH)

    @property
    def fallback(self) -> Any:
        """What counts where the entry is not given, None if nothing simple does."""
        return None if isinstance(self.default, tuple) else self.default

    def word(self, given: str) -> str | None:
        """The declared word that `given` is, None if it is none of them."""
        spellings = {**{w: w for w in self.values}, **(self.older or {})}
        said = given.rstrip()
        if said in spellings or not self.length:
            return spellings.get(said)
        short = said.upper()[: self.length]
        return next((w for s, w in spellings.items() if s[: self.length] == short), None)


@dataclass(frozen=True)
class Argument:
    """A table that a procedure takes: name of its argument, or the sub-type it goes by.

    `after` are procedures that have worked on it before.
    """

    name: str
    subtype: str = ""
    after: tuple[str, ...] = ()


@dataclass(frozen=True)
class Declaration:
    """All entries of the tables of a procedure or operator."""

    name: str
    arguments: tuple[Argument, ...]
    entries: tuple[TableEntry, ...]
    replaceable: bool = False

    @cached_property
    def _inside(self) -> dict[tuple[str, ...], dict[str, TableEntry]]:
        found: dict[tuple[str, ...], dict[str, TableEntry]] = {}
        for entry in self.entries:
            found.setdefault(entry.path[:-1], {})[entry.index] = entry
        return found

    def inside(self, path: tuple[str, ...]) -> dict[str, TableEntry]:
        """Entries of the table at a path, by their index."""
        return self._inside.get(path, {})

    def at(self, path: tuple[str, ...], index: object) -> TableEntry | None:
        """The entry that an index of the table at a path is, None if it is none."""
        known = self.inside(path)
        if isinstance(index, str) and index.rstrip() in known:
            return known[index.rstrip()]
        if type(index) is int and NUMBER in known:
            return known[NUMBER]
        return None if index == "SOUSTYPE" else known.get(ANYTHING)

    def after(self, argument: str) -> tuple[str, ...]:
        """Procedures that the table of an argument comes from."""
        return next((a.after for a in self.arguments if a.name == argument), ())

    def of(self, argument: str) -> Iterator[TableEntry]:
        """Entries of one argument, those of nested tables behind the table."""
        yield from (e for e in self.entries if e.path[0] == argument)


def as_written(word: str) -> str:
    """A word as a script must write it: `MOT` takes one that names an operator as a word."""
    return f"MOT '{word}'" if find_operator(word[:4].rstrip() or word) else f"'{word}'"


def is_declared_value(index: str, word: str) -> bool:
    """Whether some procedure's entry of that index takes the word, as it is written, or any."""
    declared = (read_declaration(name) for name in declared_names())
    return any(
        word in (*entry.values, *(entry.older or ())) if entry.values else "MOT" in entry.types
        for declaration in declared
        if declaration is not None
        for entry in declaration.entries
        if entry.index == index
    )


# ---- reading the files ------------------------------------------------------------------------


def declared_names() -> list[str]:
    """Procedures and operators whose entries are declared."""
    return sorted(p.stem.upper() for p in resource("stdlib").glob("*.toml"))


@cache
def read_declaration(name: str) -> Declaration | None:
    """The declaration of a procedure or operator, None if it has none."""
    import tomllib

    path = resource("stdlib") / f"{name.lower()}.toml"
    if not path.is_file():
        return None
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    entries: list[TableEntry] = []
    arguments = []
    replaceable = data.pop("replaceable", False)
    for argument, section in data.items():
        found = _entries_of(section, (argument,))
        subtype, after = section.get("subtype", ""), tuple(section.get("after", ()))
        arguments.append(Argument(argument, subtype, after))
        entries += {e.path: e for e in found}.values()  # what is said last holds
    # by theme, what is inside of a table right behind it
    entries.sort(key=lambda e: THEMES.index(e.theme))
    return Declaration(name.upper(), tuple(arguments), tuple(entries), replaceable)


def _entries_of(section: dict[str, Any], path: tuple[str, ...]) -> Iterator[TableEntry]:
    yield from _like(section.get("like", ()), path, "")
    for theme, members in section.items():
        if theme in ("like", "subtype", "after"):
            continue
        for names, said in members.items():
            for written in names.split(","):
                entry = _entry((*path, *written.split(".")), theme, said)
                yield entry
                yield from _like(said.get("like", ()), entry.path, theme)


_FORMS: dict[str, Callable[[Any], Any]] = {
    "types": tuple, "values": tuple, "means": tuple, "range": read_range, "usual": read_range,
    "default": lambda said: (said["en"], said["fr"]) if isinstance(said, dict) else said,
}  # fmt: skip
"""How what a file says of an entry is kept, where not as it stands there."""


def _entry(path: tuple[str, ...], theme: str, said: dict[str, Any]) -> TableEntry:
    kept: dict[str, Any] = {k: v for k, v in said.items() if k != "like"}
    kept |= {k: form(kept[k]) for k, form in _FORMS.items() if k in kept}
    return TableEntry(path, kept.pop("types", ()), theme, **kept)


def _like(sources: tuple[str, ...], path: tuple[str, ...], theme: str) -> Iterator[TableEntry]:
    """Entries of the first table of other files, put at a path."""
    for source in sources:
        name, *themes = source.split()
        declared = read_declaration(name)
        assert declared is not None, f"{path[0]} is like {name}, which has no file"
        first = declared.arguments[0].name
        for entry in declared.of(first):
            if not themes or entry.theme in themes:
                yield replace(
                    entry, path=(*path, *entry.path[1:]), theme=theme or entry.theme,
                    taken_over=True,
                )  # fmt: skip
