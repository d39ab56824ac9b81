"""The operators known to the language: signatures and help as data, functions as plain Python.

Operators register themselves with the decorator `operator`; everything that needs to know them
(evaluator, help, REPL, checker, documentation) reads `OPERATORS`, which loads them when they are
looked for.
"""

import sys
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from inspect import signature
from types import FunctionType
from typing import Any, Concatenate, Literal, ParamSpec, TypedDict, Unpack

from ssilang.language.cast3m import cast3m_words
from ssilang.language.filled import Filled
from ssilang.language.values import type_of
from ssilang.language.vocabulary.terms import CARRIED, UNSAID, Range
from ssilang.messages.message import Translated, examples, help_texts, spoken

ANY = "*"
NAME = "NOM"
"""Type word of an entry that takes the name of the next operand, whatever object bears it."""

Function = Callable[..., Any]
P = ParamSpec("P")


@dataclass(frozen=True, slots=True, eq=False)
class Argument(Translated):
    """An operand read by type.

    `types` are type words, or (`ANY`,). FLOTTANT accepts ENTIER. A missing optional argument is
    passed as `default`; a `repeated` one is passed as a tuple. `en` and `unit` say what it
    means; `kind` is the kind of words of the vocabulary that a MOT is one of ('component',
    'parameter' ...). The `main` operand decides which form of an operator runs: it is the first
    of the types that the operator knows as main ones, one or two words may stand before it.
    A repeated one leaves the last `leaving` operands of the types `left` for what follows. Of a
    keyword's it may take only those `behind` the word. What `leads` is read before any keyword is
    looked for: it may be spelt like one. Of one that is `whole` the function gets the `Operand`:
    with its name and its place. Numbers outside of `range` are refused, of `usual` told, and those
    not `above` the operand of that name. Words and objects that are `distinct` stand once; curves
    run `over` times ("s") or frequencies ("Hz").
    """

    name: str
    types: tuple[str, ...]
    optional: bool = False
    repeated: bool = False
    default: Any = None
    en: str = ""
    unit: str = ""
    kind: str = ""
    main: bool = False
    leaving: int = 0
    left: tuple[str, ...] = ()
    behind: bool = False
    leads: bool = False
    whole: bool = False
    range: Range = UNSAID
    usual: Range = UNSAID
    above: str = ""
    distinct: bool = False
    over: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Keyword(Translated):
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
    en: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Select(Translated):
    """A keyword that decides what is read behind it: entries by word.

    Passed to the function as `name`: a `Chosen`, or `default` where no word of it stands. A word
    that is among the names `unless(value)` of the main operand is not meant here: a component of
    a field may be called as what can be taken out of it.
    """

    name: str
    cases: "Mapping[str, tuple[Entry, ...]]"
    optional: bool = True
    repeated: bool = False
    default: Any = None
    length: int = 4
    en: str = ""
    unless: Callable[[Any], Collection[str]] | None = None

    @property
    def words(self) -> tuple[str, ...]:
        """The words that choose."""
        return tuple(self.cases)


@dataclass(frozen=True, slots=True, eq=False)
class Group(Translated):
    """Entries read one after the other, as often as they stand there if `repeated`.

    Passed as `name`: a tuple of the values (the value itself if the group has one entry), or a
    list of these where repeated. Behind a word that a group begins with, values are looked for
    behind that word first. The entry `times`, read before, says how often at most, if it stands.
    """

    name: str
    entries: "tuple[Entry, ...]"
    optional: bool = False
    repeated: bool = False
    at_least: int = 0
    en: str = ""
    times: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Either(Translated):
    """One of several groups: the first that can be read, passed as a `Chosen` by its name."""

    name: str
    groups: tuple[Group, ...]
    optional: bool = False
    en: str = ""


@dataclass(frozen=True, slots=True)
class Chosen:
    """What a `Select` or an `Either` has read: the word (or the group's name) and its values."""

    word: str
    values: Mapping[str, Any]

    def __getitem__(self, name: str) -> Any:
        return self.values[name]


Entry = Argument | Keyword | Select | Group | Either


class Meant(TypedDict, total=False):
    """What an entry says of its operands beside their types, as `Argument` has it."""

    unit: str
    kind: str
    leaving: int
    left: tuple[str, ...]
    behind: bool
    whole: bool
    range: Range
    usual: Range
    above: str
    distinct: bool
    over: str


class Told(Meant, total=False):
    """The same, and its meaning."""

    en: str


def arg(name: str, *types: str, **said: Unpack[Told]) -> Any:
    """A mandatory operand of one of the types (none: any type)."""
    return Argument(name, types or (ANY,), **said)


def lead(name: str, *types: str, whole: bool = False, en: str = "", kind: str = "") -> Any:
    """A mandatory operand that is read before any keyword: the first one, or right behind `said`.

    Words such as names of files or items of lists may be spelt like a keyword.
    """
    return Argument(name, types or (ANY,), en=en, kind=kind, leads=True, whole=whole)


def named(name: str, optional: bool = False, en: str = "") -> Any:
    """The name that the next operand is written as, whatever object bears it: a str."""
    return Argument(name, (NAME,), optional, en=en, leads=True)


def main(name: str, *types: str, en: str = "") -> Any:
    """The operand whose type decides which form of an operator runs; of numbers, any."""
    return Argument(name, types, en=en, main=True, range=CARRIED)


def opt(name: str, *types: str, default: Any = None, **said: Unpack[Told]) -> Any:
    """An optional operand."""
    return Argument(name, types or (ANY,), optional=True, default=default, **said)


def many(name: str, *types: str, at_least: Literal[0, 1] = 0, **said: Unpack[Told]) -> Any:
    """All operands of one of the types that can be read, as a tuple.

    With `leaving`, the last ones (of the types `left`, or of any that is read) stay for what
    follows: objects to turn, then the points of the axis. With `behind`, a keyword takes only
    those that stand behind it.
    """
    return Argument(
        name, types or (ANY,), optional=at_least == 0, repeated=True, default=(), **said
    )


def key(
    name: str,
    word: str | Sequence[str],
    *read: str | Argument,
    optional: bool = True,
    repeated: bool = False,
    default: Any = None,
    length: int = 4,
    en: str = "",
    **said: Unpack[Meant],
) -> Any:
    """A keyword with the operands behind it, or one of the types; `repeated` collects a list."""
    words = (word,) if isinstance(word, str) else tuple(word)
    behind = tuple(a for a in read if isinstance(a, Argument))
    if types := tuple(t for t in read if isinstance(t, str)):
        behind = (Argument(name, types, **said),)
    return Keyword(name, words, behind, optional, repeated, default, length, en)


def flag(name: str, word: str, length: int = 4, en: str = "") -> Any:
    """A keyword alone: True when it stands there, else False."""
    return Keyword(name, (word,), default=False, length=length, en=en)


def said(word: str, *others: str, length: int = 4) -> Keyword:
    """Words of which one must stand there: they say which form of an operator is meant."""
    return Keyword("word", (word, *others), optional=False, length=length)


def choice(
    name: str,
    words: Sequence[str],
    default: str | None = None,
    optional: bool = True,
    en: str = "",
    length: int = 4,
) -> Any:
    """One of several words; the function gets the full word as declared here."""
    return Keyword(name, tuple(words), optional=optional, default=default, length=length, en=en)


def select(
    name: str,
    cases: "Mapping[str, Sequence[Entry]]",
    optional: bool = True,
    repeated: bool = False,
    length: int = 4,
    en: str = "",
    unless: Callable[[Any], Collection[str]] | None = None,
) -> Any:
    """A keyword that decides what is read behind it; `repeated` collects a list."""
    made = {word: tuple(entries) for word, entries in cases.items()}
    return Select(name, made, optional, repeated, None, length, en, unless)


def group(name: str, *entries: "Entry", en: str = "") -> Group:
    """Entries read one after the other."""
    return Group(name, entries, en=en)


def each(name: str, *entries: "Entry", at_least: int = 0, times: str = "", en: str = "") -> Group:
    """A group read as often as it stands there: pairs of a word and its value ..."""
    return Group(name, entries, at_least == 0, True, at_least, en, times)


def either(name: str, *groups: Group, optional: bool = False, en: str = "") -> Either:
    """The first of several groups that can be read."""
    return Either(name, groups, optional, en)


def _of_parameter(make: Callable[Concatenate[str, P], Any]) -> Callable[P, Any]:
    def declared(*args: P.args, **options: P.kwargs) -> Any:
        return make("", *args, **options)

    return declared


Arg = _of_parameter(arg)
"""`arg` as the default of the parameter that gets it, by whose name it goes; so the others."""
Opt = _of_parameter(opt)
Many = _of_parameter(many)
Main = _of_parameter(main)
Lead = _of_parameter(lead)
Name = _of_parameter(named)
Key = _of_parameter(key)
Flag = _of_parameter(flag)
Choice = _of_parameter(choice)
Cases = _of_parameter(select)
Each = _of_parameter(each)
OneOf = _of_parameter(either)


@dataclass(frozen=True, slots=True)
class Like:
    """Results of the types, and as many, as the operands of the entry `name` and of `more`."""

    name: str
    more: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class By:
    """Results by what the entry `name` says: its word, True or False for a flag, else its type.

    An entry that collects several says True where there are any.
    """

    name: str
    results: Mapping[object, tuple[str, ...]]
    default: tuple[str, ...] = ()

    def of(self, value: object) -> tuple[str, ...]:
        """Results where the entry has the value."""
        key = value.word if isinstance(value, Chosen) else value
        if isinstance(key, (tuple, list)):
            key = bool(key)
        said = key is None or isinstance(key, str | bool)
        return self.results.get(key if said else type_of(key), self.default)


def by(
    name: str, results: Mapping[Any, str | Sequence[str]], default: str | Sequence[str] = ()
) -> By:
    """Results by the word of a `select` or a `choice`, by a `flag`, or by an operand's type."""
    made = {k: _as_words(v) for k, v in results.items()}
    return By(name, made, _as_words(default))


Gives = tuple[str, ...] | Like | By | None
"""Types of results: type words, 'A|B' where it may be one or the other, `ANY` where only the run
can tell; () for a directive; None where the annotation of the function says it."""


@dataclass(frozen=True, slots=True)
class When(Translated):
    """A condition of the session under which a form is meant: `en` names it in the help."""

    test: Callable[[Any], bool]
    en: str


@dataclass(frozen=True, slots=True)
class HelpTable:
    """A table of help: a title, what to say before it, heads of columns, rows; the first names."""

    title: str
    note: str
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


Tables = Callable[[str], Sequence[HelpTable]]
"""Makes tables in 'en' or 'fr'."""


@dataclass(frozen=True, slots=True)
class Help:
    """Help of an operator or procedure, shown by INFO, `ssilang help` and the manual.

    `tables` makes, in 'en' or 'fr', what is declared elsewhere and belongs to the page. What is
    said of operators stands in `ssilang/messages/pages`, their examples beside it.
    """

    en: str
    fr: str
    syntax: str  # one line an accepted form, notices' style
    examples: tuple[str, ...] = ()  # scripts that run by themselves
    tables: Tables | None = None

    def told(self, language: str) -> str:
        """What it says in 'en' or 'fr'."""
        return spoken(self.en, self.fr, language)


Page = tuple[str, str, str]
"""Where the help of a form stands: family, operator, name of the form's function."""


@dataclass(frozen=True, slots=True)
class Form:
    """One way to write an operator: what it reads, in reading order, what then runs, what it gives.

    `by_hand` is the reason why the function reads for itself, from its call; what such a form
    declares is for help and checks.
    """

    entries: "tuple[Entry, ...] | None"  # None: nothing is declared
    function: Function
    injected: tuple[str, ...] = ()  # parameters that get the session or the call
    gives: Gives = None
    by_hand: str = ""
    when: When | None = None
    of: tuple[str, ...] = ()  # an operand of one of these types stands in the phrase
    module: str = ""  # that declares it
    page: Page = ("", "", "")

    said: Keyword | Select | None = field(init=False, repr=False, compare=False)
    """The words of which one says that this form is meant: `said`, or a mandatory `select`."""
    main: Argument | None = field(init=False, repr=False, compare=False)
    """The operand that decides that this form runs."""
    rest: "tuple[Entry, ...]" = field(init=False, repr=False, compare=False)
    """What is read besides it."""
    beside: frozenset[str] = field(init=False, repr=False, compare=False)
    """Its other keywords, four letters of each: they may stand before the word that says it."""
    plain: bool = field(init=False, repr=False, compare=False)
    """Whether it has operands alone, which are read one after the other."""

    def __post_init__(self) -> None:
        entries = self.entries or ()
        said: Keyword | Select | None = None
        match entries[:1]:
            case (Keyword(name="word", arguments=()) as first,):
                said = first
            case (Select(optional=False) as first,):
                said = first
        main = next((e for e in entries if isinstance(e, Argument) and e.main), None)
        words = () if self.by_hand else words_in(entries[1:])
        object.__setattr__(self, "said", said)
        object.__setattr__(self, "main", main)
        object.__setattr__(self, "beside", frozenset(w[:4].rstrip() for w in words))
        object.__setattr__(self, "rest", tuple(e for e in entries if e is not main))
        object.__setattr__(self, "plain", all(isinstance(e, Argument) for e in entries))


@dataclass(slots=True)
class Trial:
    """What to try on the operands of a call.

    Attributes
    ----------
    forms : tuple of Form
        All that are meant, in order.
    main : int or None
        Index of the operand that chose them.
    fitting : tuple of Form
        Those of them that the operands may fit, by number, types and words.
    keyed : bool
        It was found for operands of these types with these words.
    wordless : bool
        Certainly no word stands among them.
    keywords : int
        Words among them that may be keywords of one of the forms, at the most.
    said : Said or None
        What words alone said, but for the main operand, when they stood there before.
    """

    forms: tuple[Form, ...]
    main: int | None
    fitting: tuple[Form, ...]
    keyed: bool = False
    wordless: bool = False
    keywords: int = sys.maxsize
    said: "Said | None" = None


@dataclass(frozen=True, slots=True)
class Said:
    """A form and its arguments besides the main operand, where keywords alone say them.

    `hidden` are those of names of the main operand that would hide a keyword.
    """

    form: Form
    values: Mapping[str, Any]
    hidden: tuple[Callable[[Any], Collection[str]], ...]


class Choices:
    """What chooses among forms, gathered once."""

    def __init__(self, forms: Sequence[Form]) -> None:
        self.forms = tuple(forms)
        self.conditional = any(f.when is not None or f.of for f in forms)
        self.said = tuple(f for f in forms if f.said is not None)
        self.known = tuple(
            dict.fromkeys(t for f in forms if f.main is not None for t in f.main.types)
        )
        self.plain = tuple(f for f in forms if f.main is None and f.said is None)
        # forms by the type of the main operand, and those of them that want no word
        self.by_kind: dict[str, tuple[tuple[Form, ...], tuple[Form, ...]]] = {}
        self.whens = tuple({id(f.when): f.when for f in forms if f.when is not None}.values())
        alone = len(self.forms) == 1 and self.forms[0].main is None and not self.conditional
        self.only = Trial(self.forms, None, self.forms) if alone else None
        # what was found to try, by types, words and conditions
        self.trials: dict[tuple[object, ...], Trial] = {}


@dataclass(slots=True)
class Operator:
    """An operator: name of at most 4 letters (or a sign), family, forms, help."""

    name: str
    family: str
    forms: list[Form] = field(default_factory=list)
    aliases: tuple[str, ...] = ()
    terminal: bool = False  # its result is not looked at as an operator's name
    full_name: str = ""  # as usually written: 'MODELISER', 'RIGIDITE'
    tables: Tables | None = None  # see `Help`
    empties: bool = False  # objects that hold nothing are as good as others to it
    _choices: Choices | None = None
    _meant: dict[tuple[bool, ...], Choices] = field(default_factory=dict)

    @property
    def choices(self) -> Choices:
        """What chooses among all forms."""
        if self._choices is None:
            self._choices = Choices(self.forms)
        return self._choices

    def choices_where(self, meant: tuple[bool, ...]) -> Choices:
        """What chooses among the forms that the session and the phrase allow."""
        found = self._meant.get(meant)
        if found is None:
            kept = [f for f, allowed in zip(self.forms, meant, strict=True) if allowed]
            found = self._meant[meant] = Choices(kept)
        return found

    @property
    def help(self) -> Help:
        """What is said of the operator and of each form, by module whatever was imported first."""
        texts = help_texts(self.family, self.name)
        forms = dict.fromkeys(f.page[-1] for f in sorted(self.forms, key=lambda f: f.module))
        parts = (texts, *(texts[f] for f in forms if f in texts))
        en, fr, syntax = ("\n".join(p[k] for p in parts if k in p) for k in ("en", "fr", "syntax"))
        return Help(en, fr, syntax, examples(self.family, self.name), self.tables)

    def form(
        self,
        *entries: "Entry",
        gives: str | Sequence[str] | Like | By | None = None,
        by_hand: str = "",
        when: When | None = None,
        of: Sequence[str] = (),
        ahead: bool = False,
    ) -> Callable[[Function], Function]:
        """Decorator that adds a form; forms are tried in order of declaration.

        The first whose mandatory entries can be read runs. Where the first unread word is one
        that forms `said`, these alone are tried; else, where forms have a `main` operand and the
        phrase has one of such a type, those of that type.

        Parameters
        ----------
        *entries : Entry
            What the form reads, in reading order, before what stands as defaults of the function's
            parameters. Keywords are looked for before and after each operand is read.
        gives : str, sequence of str, Like, or By, optional
            Types of the results; by default what the function's annotation says.
        by_hand : str
            Why the function reads for itself: it takes the call, and behind it the main operand
            or the word that chose the form if there is one.
        when : When
            Condition of the session; the form is passed over where it is not met.
        of : sequence of str
            The form is meant only where an operand of one of these types stands in the phrase.
        ahead : bool
            The form is tried before all that were declared so far.
        """

        def add(function: Function) -> Function:
            read = (*entries, *_of_parameters(function))
            made = Form(
                read if read or not by_hand else None,
                function,
                _injected(function),
                gives if gives is None or isinstance(gives, Like | By) else _as_words(gives),
                by_hand,
                when,
                tuple(of),
                OPERATORS.note(self.name),
                (self.family, self.name, _name_of(function)),
            )
            # Put a form in its place: where it stands when all operators are loaded at once.
            self._choices = None
            self._meant.clear()
            ranks = [OPERATORS.rank(self.name, form.module) for form in self.forms]
            place = OPERATORS.rank(self.name, made.module)
            self.forms.insert((bisect_left if ahead else bisect_right)(ranks, place), made)
            return function

        return add


def _as_words(given: str | Sequence[str]) -> tuple[str, ...]:
    return (given,) if isinstance(given, str) else tuple(given)


class Operators(Filled[str, Operator]):
    """Operators by their names: a module brings one, or forms of one that another brings."""

    def __setitem__(self, key: str, value: Operator) -> None:
        if key in self._items:  # the one imported later would take the other's place
            raise ValueError(f"an operator {key} is declared twice: see {self.fillers[key]}")
        super().__setitem__(key, value)

    def in_order(self, key: str) -> tuple[str, ...]:
        """Modules that bring forms of an operator in their order, then those that bring others."""
        found = self[key]
        forms = (form.module for form in found.forms)
        return tuple(dict.fromkeys((*forms, *self.fillers[key], *self.fillers[found.name])))


OPERATORS = Operators("operators")

SCALAR_RULES: Filled[str, Callable[[Any, Any], Any]] = Filled("rules of scalars")
"""What signs (and EGA, ET ...) do on two scalars; must raise TypeError for a LOGIQUE that does
not fit. Registered by the operators that own the signs, used by the short way for scalars."""


def operator(
    name: str,
    *entries: "Entry",
    family: str,
    tables: Tables | None = None,
    aliases: Sequence[str] = (),
    terminal: bool = False,
    full_name: str = "",
    gives: str | Sequence[str] | Like | By | None = None,
    reads_itself: str = "",
    when: When | None = None,
    empties: bool | None = None,
) -> Callable[[Function], Operator]:
    """Decorator that registers an operator with its first form.

    Parameters
    ----------
    name : str
        First four letters, such as 'DROI', or a sign.
    *entries : Entry
        What the form reads, in reading order, before what stands as defaults of the function's
        parameters. Keywords are looked for before and after each operand is read.
    family : str
        Page of the manual: 'mesh', 'field', 'model', 'list', ...
    tables : callable, optional
        Tables of its help, see `Help`.
    gives : str, sequence of str, Like, or By, optional
        Types of the results; by default what the function's annotation says.
    reads_itself : str
        Why the function takes the `call` and reads from it; `entries` are then for help and checks.
    empties : bool, optional
        Whether objects that hold nothing go by without a word; by the family where it is not said.

    Notes
    -----
    A function parameter named `session` or `call` gets the running session or call. The function
    returns nothing, one value, or a tuple of several results. The decorator returns the
    `Operator`, whose `form` decorates further functions.
    """

    def add(function: Function) -> Operator:
        made = shared(
            name, family, tables, aliases=aliases, terminal=terminal, full_name=full_name,
            empties=empties,
        )  # fmt: skip
        made.form(*entries, gives=gives, by_hand=reads_itself, when=when)(function)
        return made

    return add


_OF_CONTAINERS = frozenset(
    ("arithmetic", "clouds", "comparisons", "control", "functions", "lists", "numbers", "objects",
     "output", "session", "tables", "words")
)  # fmt: skip
"""Families of operators that fill, take apart, compare and print: to them nothing is a value."""

OF_MODELS = frozenset(("load", "matrix", "stress"))
"""Families of operators that take fields on the model that stands beside them."""


def shared(
    name: str,
    family: str,
    tables: Tables | None = None,
    *,
    aliases: Sequence[str] = (),
    terminal: bool = False,
    full_name: str = "",
    empties: bool | None = None,
) -> Operator:
    """Register an operator whose forms stand in several families; `form` adds one."""
    holds = family in _OF_CONTAINERS if empties is None else empties
    called = full_name or name
    made = Operator(name, family, [], tuple(aliases), terminal, called, tables, holds)
    for word in (name, *aliases):
        OPERATORS[word] = made
    return made


def _name_of(function: Function) -> str:
    """What a function is called, or the one that it is a part of."""
    while isinstance(function, partial):
        function = function.func
    return str(getattr(function, "__name__", ""))


def _of_parameters(function: Function) -> "tuple[Entry, ...]":
    """Entries that stand as defaults of a function's parameters, called as these."""
    if not isinstance(function, FunctionType) or function.__defaults__ is None:
        return ()
    names = function.__code__.co_varnames[: function.__code__.co_argcount]
    given = zip(reversed(names), reversed(function.__defaults__), strict=False)
    return tuple(reversed([_called(e, n) for n, e in given if isinstance(e, Entry)]))


def _called(entry: "Entry", name: str) -> "Entry":
    """An entry that goes by the name of a parameter, and so the one operand of a keyword."""
    if isinstance(entry, Keyword) and [a.name for a in entry.arguments] == [entry.name]:
        return replace(entry, name=name, arguments=(replace(entry.arguments[0], name=name),))
    return replace(entry, name=name)


def _injected(function: Function) -> tuple[str, ...]:
    """Those parameters of a function that the session or the call is handed for."""
    if isinstance(function, FunctionType) and not hasattr(function, "__wrapped__"):
        code = function.__code__  # looking at it takes a tenth of the time of a signature
        names: Collection[str] = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    else:
        names = signature(function).parameters
    return tuple(n for n in ("session", "call", "word") if n in names)


def find_operator(word: str) -> Operator | None:
    """The operator that a word names: signs in full, names on their first four letters.

    A text of several words names none: 'MODE 1 frequency' is a label. Nor does the whole name of a
    procedure of Cast3M: NORMALIM is no NORM.
    """
    found = OPERATORS.get(word)
    if found is not None:
        return found
    if " " in word.rstrip() or not (len(word) > 4 or word.endswith(" ")):
        return None
    found = OPERATORS.get(word[:4].rstrip())
    known = cast3m_words().get(word.rstrip()) if found is not None else None
    return None if known is not None and known.kind == "procedure" else found


def operators_by_family() -> Mapping[str, list[Operator]]:
    """Operators grouped for help and manual, each once, sorted."""
    groups: dict[str, list[Operator]] = {}
    for name in sorted(OPERATORS):
        made = OPERATORS[name]
        if made.name == name:
            groups.setdefault(made.family, []).append(made)
    return groups


def keywords_of(found: Operator) -> list[str]:
    """Keywords that an operator's forms declare."""
    return sorted({w.strip() for form in found.forms for w in words_in(form.entries or ())})


def words_in(entries: "Iterable[Entry]") -> Iterator[str]:
    """All words of keywords among entries, inner ones too."""
    for found in keywords_in(entries):
        yield from found.words


def keywords_in(entries: "Iterable[Entry]") -> Iterator[Keyword | Select]:
    """All keywords among entries, inner ones too."""
    return (e for e in _with_inner(entries) if isinstance(e, Keyword | Select))


def arguments_in(entries: "Iterable[Entry]") -> Iterator[Argument]:
    """All operands of entries, inner ones too."""
    return (e for e in _with_inner(entries) if isinstance(e, Argument))


def _with_inner(entries: "Iterable[Entry]") -> "Iterator[Entry]":
    for entry in entries:
        yield entry
        match entry:
            case Keyword():
                yield from entry.arguments
            case Select():
                for inner in entry.cases.values():
                    yield from _with_inner(inner)
            case Group():
                yield from _with_inner(entry.entries)
            case Either():
                yield from _with_inner(entry.groups)
