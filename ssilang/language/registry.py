"""The operators known to the language: signatures and help as data, functions as plain Python.

Operators register themselves with the decorator `operator`; everything that needs to know them
(evaluator, help, REPL, checker, documentation) reads `OPERATORS`.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

ANY = "*"

Function = Callable[..., Any]


@dataclass(frozen=True, slots=True)
class Argument:
    """An operand read by type.

    `types` are type words, or (`ANY`,). FLOTTANT accepts ENTIER. A missing optional argument is
    passed as `default`; a `repeated` one is passed as a tuple.
    """

    name: str
    types: tuple[str, ...]
    optional: bool = False
    repeated: bool = False
    default: Any = None


@dataclass(frozen=True, slots=True)
class Keyword:
    """Words of which one may stand among the operands, with the operands that follow it.

    Passed to the function as `name`: without `arguments` the word itself (or True when there is
    only one word), else the value (or tuple of values when there are several arguments).
    """

    name: str
    words: tuple[str, ...]
    arguments: tuple[Argument, ...] = ()
    optional: bool = True
    repeated: bool = False
    default: Any = None
    length: int = 4  # characters compared


Entry = Argument | Keyword


def arg(name: str, *types: str) -> Argument:
    """A mandatory operand of one of the types (none: any type)."""
    return Argument(name, types or (ANY,))


def opt(name: str, *types: str, default: Any = None) -> Argument:
    """An optional operand."""
    return Argument(name, types or (ANY,), optional=True, default=default)


def many(name: str, *types: str, at_least: Literal[0, 1] = 0) -> Argument:
    """All operands of one of the types that can be read, as a tuple."""
    return Argument(name, types or (ANY,), optional=at_least == 0, repeated=True, default=())


def key(
    name: str,
    word: str | Sequence[str],
    *arguments: Argument,
    optional: bool = True,
    repeated: bool = False,
    default: Any = None,
    length: int = 4,
) -> Keyword:
    """A keyword with what follows it; `repeated` collects a list."""
    words = (word,) if isinstance(word, str) else tuple(word)
    return Keyword(name, words, arguments, optional, repeated, default, length)


def flag(name: str, word: str, length: int = 4) -> Keyword:
    """A keyword alone: True when it stands there, else False."""
    return Keyword(name, (word,), default=False, length=length)


def choice(
    name: str, words: Sequence[str], default: str | None = None, optional: bool = True
) -> Keyword:
    """One of several words; the function gets the full word as declared here."""
    return Keyword(name, tuple(words), optional=optional, default=default)


@dataclass(frozen=True, slots=True)
class Form:
    """One way to write an operator: what it reads, in reading order, and what then runs."""

    entries: tuple[Entry, ...] | None  # None: the function reads for itself, from its Call
    function: Function
    injected: tuple[str, ...] = ()  # parameters that get the session or the call


@dataclass(frozen=True, slots=True)
class Help:
    """Help of an operator in two languages, shown by INFO, `ssilang help` and the manual."""

    en: str
    fr: str
    syntax: str = ""  # one line an accepted form, notices' style
    examples: tuple[str, ...] = ()  # scripts that run by themselves


@dataclass(slots=True)
class Operator:
    """An operator: name of at most 4 letters (or a sign), family, forms, help."""

    name: str
    family: str
    help: Help
    forms: list[Form] = field(default_factory=list)
    aliases: tuple[str, ...] = ()
    terminal: bool = False  # its result is not looked at as an operator's name
    full_name: str = ""  # as usually written: 'MODELISER', 'RIGIDITE'

    def form(self, *entries: Entry) -> Callable[[Function], Function]:
        """Decorator that adds a form; forms are tried in order of declaration."""

        def add(function: Function) -> Function:
            self.forms.append(Form(tuple(entries), function, _injected(function)))
            return function

        return add


OPERATORS: dict[str, Operator] = {}

SCALAR_RULES: dict[str, Callable[[Any, Any], Any]] = {}
"""What signs (and EGA, ET ...) do on two scalars; must raise TypeError for a LOGIQUE that does
not fit. Registered by the operators that own the signs, used by the short way for scalars."""


def operator(
    name: str,
    *entries: Entry,
    family: str,
    help: Help,
    aliases: Sequence[str] = (),
    terminal: bool = False,
    full_name: str = "",
    reads_itself: bool = False,
) -> Callable[[Function], Operator]:
    """Decorator that registers an operator with its first form.

    Parameters
    ----------
    name : str
        First four letters, such as 'DROI', or a sign.
    *entries : Argument or Keyword
        What the form reads, in reading order. Keywords are looked for before and after each
        operand is read.
    family : str
        Page of the manual: 'mesh', 'field', 'model', 'list', ...
    reads_itself : bool
        The function takes the `call` and reads from it (operators with a free syntax).

    Notes
    -----
    A function parameter named `session` or `call` gets the running session or call. The function
    returns nothing, one value, or a tuple of several results. The decorator returns the
    `Operator`, whose `form` decorates further functions.
    """

    def add(function: Function) -> Operator:
        declared = None if reads_itself else tuple(entries)
        made = Operator(name, family, help, [], tuple(aliases), terminal, full_name or name)
        made.forms.append(Form(declared, function, _injected(function)))
        for word in (name, *aliases):
            OPERATORS[word] = made
        return made

    return add


def _injected(function: Function) -> tuple[str, ...]:
    names = inspect.signature(function).parameters
    return tuple(n for n in ("session", "call") if n in names)


def find_operator(word: str) -> Operator | None:
    """The operator that a word names: signs in full, names on their first four letters."""
    found = OPERATORS.get(word)
    if found is not None:
        return found
    return OPERATORS.get(word[:4].rstrip()) if len(word) > 4 or word.endswith(" ") else None


def operators_by_family() -> Mapping[str, list[Operator]]:
    """Operators grouped for help and manual, each once, sorted."""
    groups: dict[str, list[Operator]] = {}
    for name in sorted(OPERATORS):
        made = OPERATORS[name]
        if made.name == name:
            groups.setdefault(made.family, []).append(made)
    return groups


def keywords_of(found: Operator) -> list[str]:
    """Keywords that an operator declares or that its syntax lines quote."""
    words = set(re.findall(r"'([A-Z][A-Z0-9_]*) *'", found.help.syntax))
    for form in found.forms:
        for entry in form.entries or ():
            if isinstance(entry, Keyword):
                words.update(w.strip() for w in entry.words)
    return sorted(words)
