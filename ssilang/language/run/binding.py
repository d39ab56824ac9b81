"""From the unread operands of a phrase to the arguments of an operator, by its declared forms."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import takewhile
from typing import Any

from ssilang.language.registry import (
    ANY,
    NAME,
    SCALAR_RULES,
    Argument,
    Choices,
    Chosen,
    Either,
    Entry,
    Form,
    Group,
    Keyword,
    Operator,
    Said,
    Select,
    Trial,
    find_operator,
    keywords_in,
)
from ssilang.language.run.call import Call, Operand, accepts, shortened
from ssilang.language.say.errors import SsiError
from ssilang.language.values import ListMots, Mot, type_of

Heads = tuple[tuple[int, Mapping[str, tuple[tuple[int, Keyword | Select, str], ...]]], ...]
"""Keywords, with their place and their word, by what it begins with; by the length compared."""


@dataclass(slots=True)
class _Level:
    """Keywords that may stand among the operands being read, and what they gave."""

    keywords: tuple[Keyword | Select, ...]
    heads: Heads
    values: dict[str, Any]
    seen: set[str]


_Kept = tuple[
    list[Operand], int, tuple[bool, bool, int, int], list[tuple[_Level, dict[str, Any], set[str]]]
]


class Binder:
    """Reads the entries of one form from a call; inner entries see the outer keywords too."""

    def __init__(self, call: Call, main: Any, trial: Trial) -> None:
        self.call = call
        self.main = main  # the operand that chose the form
        self.taken = 0  # keywords
        self._given_ones: list[tuple[Argument, Operand]] = []  # of which something is declared
        self._levels: list[_Level] = []
        self._wordless = trial.wordless or call.wordless()
        self._keywords_there = trial.keywords
        self._keyless = self._wordless or not trial.keywords  # none is left to look for

    def bind(
        self,
        entries: tuple[Entry, ...],
        after: int = -1,
        *,
        begun: bool = False,
        open: bool = False,
    ) -> dict[str, Any]:
        """Values of entries by name.

        Parameters
        ----------
        after : int
            Offset in the source behind which values are looked for first.
        begun, open : bool
            The entries go on with a group, or the group goes on behind them: between a name and
            its value no keyword of others is looked for.

        Raises
        ------
        SsiError
            When a mandatory entry cannot be read.
        """
        made = _prepared(entries)
        values = made.defaults.copy()
        for name in made.lists:
            values[name] = []
        if made.flat and (self._wordless or (self._keyless and not made.wanted)):
            for _, entry, read in made.operands:  # nothing can stand between
                values[entry.name] = read(self, entry, after)
            if made.wanted:
                raise missing_keyword(self.call, made.wanted[0].words)
            return values
        level = _Level(made.keywords, made.heads, values, set())
        self._levels.append(level)
        try:
            leading = self._leading(made, level) if made.leading else 0
            self._keywords(begun)
            for place, entry, read in made.operands:
                if place >= leading:
                    values[entry.name] = read(self, entry, after)
                    self._keywords(open)
        finally:
            self._levels.pop()
        for k in made.wanted:
            if k.name not in level.seen:
                raise missing_keyword(self.call, k.words)
        return values

    def _leading(self, made: "_Prepared", level: _Level) -> int:
        """Read what leads, behind the word that chose the form; says how many entries that was."""
        after = -1
        if made.choice is not None:
            only = _Level((made.choice,), made.choice_heads, level.values, level.seen)
            at = self.call.word_index()
            if at is None or not self._keyword(only, at, self.call.text_at(at)):
                return 0  # something stands before the word
            after = self.call.keyword_end
        for a in made.leading:
            level.values[a.name] = self.operand(a, after)
        return len(made.leading) + (made.choice is not None)

    # ---- keywords ------------------------------------------------------------------------------

    def _keywords(self, inmost: bool = False) -> bool:
        """Read keywords as long as the first unread word is one; says whether there were any.

        Those of all open levels, or of the `inmost` alone.
        """
        if self._keyless:
            return False
        levels = self._levels
        if inmost or len(levels) == 1:
            open_ones = levels[-1:] if levels[-1].keywords else ()
        else:
            open_ones = [level for level in reversed(levels) if level.keywords]
        if not open_ones:
            return False
        call, found = self.call, False
        while (at := call.word_index()) is not None:
            word = call.text_at(at)
            for level in open_ones:
                if self._keyword(level, at, word):
                    break
            else:
                return found
            found = True
            if self._keyless:
                break
        return found

    def _keyword(self, level: _Level, at: int, first: str) -> bool:
        """Read the keyword that the first unread word, `first`, is if it is one of the level's."""
        known: tuple[tuple[int, Keyword | Select, str], ...] = ()
        for length, heads in level.heads:
            more = heads.get(first[:length])
            if more is not None:
                known = more if not known else tuple(sorted(known + more, key=lambda k: k[0]))
        for _, k, word in known:
            if k.name in level.seen and not k.repeated:
                continue
            if isinstance(k, Select) and k.unless is not None and self._is_a_name(k.unless):
                continue
            self.call.take_keyword(at)
            self.taken += 1
            self._wordless = self.call.wordless()  # reading only takes away
            self._keyless = self._wordless or self.taken >= self._keywords_there
            level.seen.add(k.name)
            value = self._behind(k, word)
            if k.repeated:
                level.values[k.name].append(value)
            else:
                level.values[k.name] = value
            return True
        return False

    def _is_a_name(self, names: Callable[[Any], Collection[str]]) -> bool:
        """Whether the first unread word is one of the main operand's names."""
        word = self.call.peek_word()
        return word is not None and word.rstrip() in names(self.main)

    def _behind(self, k: Keyword | Select, word: str) -> Any:
        """What a keyword brings: the word, True, the values behind it, or the case it chose."""
        place = self.call.keyword_end
        if isinstance(k, Select):
            inner = k.cases[word]
            if not inner and self._wordless:
                return Chosen(word, {})
            return Chosen(word, self.bind(inner, place))
        if not k.arguments:
            return True if len(k.words) == 1 else word
        parts = [self.operand(a, place) for a in k.arguments]
        if len(k.words) > 1:
            return (word, *parts)
        return parts[0] if len(parts) == 1 else tuple(parts)

    # ---- operands ------------------------------------------------------------------------------

    def operand(self, a: Argument, after: int = -1) -> Any:
        """What an entry gets of the unread operands."""
        if a.repeated:
            return self._several(a, after)
        if NAME in a.types:
            return self.call.take_name(a.optional)
        if a.optional and a.types == ("MOT",) and self._joins():
            return a.default
        operand = self.call.read(*a.types, after=after, only=a.behind)
        if operand is not None:
            return self._given(a, operand)
        if a.optional:
            return a.default
        raise self._lacking(a)

    def _given(self, a: Argument, operand: Operand) -> Any:
        if a.distinct or a.over or a.unit or a.range.bounded or a.usual.bounded:
            self._given_ones.append((a, operand))
        return operand if a.whole else operand.value

    def tell_flaws(self) -> None:
        """Refuse the first number outside of its range, once all else fits; tell what is odd.

        Raises
        ------
        SsiError
            'out-of-range' or 'not-increasing'.
        """
        call = self.call
        for a, operand in self._given_ones:
            call.refuse(a, operand)
        report, values = call.session.report, {a.name: o.value for a, o in self._given_ones}
        for n, (a, operand) in enumerate(self._given_ones):
            call.tell_odd(a, operand)
            least = values.get(a.above)
            if isinstance(least, int | float) and not operand.value > least:
                told = {"value": operand.value, "other": a.above, "least": least}
                report(call.flaw("not-above", a, operand, told))
            before = [o.value for b, o in self._given_ones[:n] if b is a] if a.distinct else []
            if a.distinct and (twice := _twice(operand.value, before)):
                report(call.flaw("given-twice", a, operand, {"twice": twice}))

    def _lacking(self, a: Argument) -> SsiError:
        """The error of an operand that is not there: a word stands where another must be said."""
        if self.call.operands and isinstance(self.call.operands[0].value, str):
            for level in reversed(self._levels):
                unsaid = [k for k in level.keywords if not k.optional and k.name not in level.seen]
                if unsaid and len(unsaid[0].words) > 1:
                    return missing_keyword(self.call, unsaid[0].words)
        return self.call.missing(a.types)

    def _several(self, a: Argument, after: int) -> tuple[Any, ...]:
        call = self.call
        if a.leaving:
            found = call.readable(*a.types)
            left = [i for i in found if accepts(a.left or a.types, call.operands[i].value)]
            kept = set(left[-a.leaving :])
            # indices shift as operands are taken
            values = [
                self._given(a, call.take(i - n, *a.types))
                for n, i in enumerate(i for i in found if i not in kept)
            ]
        else:
            values = []
            words = accepts(a.types, Mot(""))
            only = a.behind
            while not (words and self._joins()):
                operand = call.read(*a.types, after=after, only=only)
                if operand is None:
                    # a keyword may stand between two operands, but for those of a keyword itself
                    if after < 0 and self._levels and self._keywords():
                        continue
                    break
                only = True
                values.append(self._given(a, operand))
                if words and self._levels:
                    self._keywords()
        if not values and not a.optional:
            raise call.missing(a.types)
        return tuple(values)

    def _group(self, g: Group, after: int) -> Any:
        if not g.repeated:
            return self._one(g, after)
        found: list[Any] = []
        read = reversed(self._levels)
        most = next((v.values[g.times] for v in read if g.times in v.values), None)
        while self.call.operands and (most is None or len(found) < most) and self._may_begin(g):
            before, kept = len(self.call.used), self._kept()
            try:
                value = self._one(g, after)
            except SsiError:
                if self._stands_in_the_middle(before):
                    raise
                self._put_back(kept)
                break
            if len(self.call.used) == before:
                break
            found.append(value)
        if len(found) < g.at_least:
            self._one(g, after)  # says what is missing
        return found

    def _one(self, g: Group, after: int) -> Any:
        first = len(self.call.used)
        head, rest = g.entries[:1], g.entries[1:]
        values = self.bind(head, after, open=bool(rest))
        used = self.call.used[first:]
        if used and isinstance(used[0].value, Mot):
            after = used[0].span.end
        values |= self.bind(rest, after, begun=True) if rest else {}
        ordered = tuple(values[e.name] for e in g.entries)
        return ordered[0] if len(ordered) == 1 else ordered

    def _stands_in_the_middle(self, before: int) -> bool:
        """Whether something was read of a group, and what it begins with is no operator."""
        used = self.call.used[before:]
        if not used:
            return False
        first = used[0].value
        return not (isinstance(first, Mot) and find_operator(str(first).rstrip()) is not None)

    def _either(self, e: Either, after: int) -> Chosen | None:
        worst: tuple[int, SsiError] | None = None
        for g in e.groups:
            if not self._may_begin(g):
                continue
            before, kept = len(self.call.used), self._kept()
            try:
                return Chosen(g.name, self.bind(g.entries, after))
            except SsiError as problem:
                depth = len(self.call.used) - before
                if worst is None or depth > worst[0]:
                    worst = depth, problem
                self._put_back(kept)
        if e.optional:
            return None
        if worst is None or not worst[0]:
            self.bind(e.groups[0].entries, after)  # says what is missing
        assert worst is not None
        raise worst[1]

    def _may_begin(self, g: Group) -> bool:
        """Whether the operand that a group begins with may stand there; no more is looked at."""
        first = g.entries[0] if g.entries else None
        if type(first) is Argument and "MOT" in first.types and self._joins():
            return False
        if not self._wordless or type(first) is not Argument or first.optional:
            return True
        return any(accepts(first.types, o.value) for o in self.call.operands)

    def _joins(self) -> bool:
        """Whether the next word is the ET, EGA ... behind the phrase, and no name."""
        return self.call.peek_word() in SCALAR_RULES

    def _kept(self) -> _Kept:
        """The operands, and what the open levels have, as they stand."""
        levels = self._levels if not self._wordless else ()
        return (
            list(self.call.operands),
            len(self.call.used),
            (self._wordless, self._keyless, self.taken, len(self._given_ones)),
            [(v, dict(v.values), set(v.seen)) for v in levels],
        )

    def _put_back(self, kept: _Kept) -> None:
        operands, used, (self._wordless, self._keyless, self.taken, given), levels = kept
        self.call.operands[:] = operands
        del self.call.used[used:], self._given_ones[given:]
        for level, values, seen in levels:
            level.values.clear()
            level.values.update(values)
            level.seen.clear()
            level.seen.update(seen)


def _twice(value: Any, before: Sequence[Any]) -> str:
    """A word of a value that stands twice in it or stood before; of an object its type."""
    if isinstance(value, ListMots):
        words = [_bare(w) for w in value.values]
        return next((w for n, w in enumerate(words) if w in words[:n]), "")
    if isinstance(value, str):
        return _bare(value) if _bare(value) in map(_bare, before) else ""
    return type_of(value) if any(value is b for b in before) else ""


def _bare(word: Any) -> str:
    return str(word).rstrip()


_READERS: Mapping[type, Callable[[Binder, Any, int], Any]] = {
    Argument: Binder.operand,
    Group: Binder._group,
    Either: Binder._either,
}


@dataclass(frozen=True, slots=True)
class _Prepared:
    """What is known of entries before any call: keywords, and operands with what reads them.

    `leading` are those read before any keyword, behind the word `choice` if there is one;
    `defaults` what keywords give that do not stand, `lists` those that collect, `wanted` those
    that must stand. A `flat` one has no groups.
    """

    keywords: tuple[Keyword | Select, ...]
    heads: Heads
    defaults: dict[str, Any]
    lists: tuple[str, ...]
    wanted: tuple[Keyword | Select, ...]
    flat: bool
    operands: tuple[tuple[int, Entry, Callable[[Binder, Any, int], Any]], ...]
    choice: Keyword | None
    choice_heads: Heads
    leading: tuple[Argument, ...]


@cache
def _prepared(entries: tuple[Entry, ...]) -> _Prepared:
    readers = ((i, e, _READERS.get(type(e))) for i, e in enumerate(entries))
    first = entries[0] if entries else None
    chooses = isinstance(first, Keyword) and first.name == "word" and not first.arguments
    choice = first if chooses and isinstance(first, Keyword) else None
    chosen = () if choice is None else (choice,)
    leads = takewhile(lambda e: isinstance(e, Argument) and e.leads, entries[len(chosen) :])
    keywords = tuple(e for e in entries if isinstance(e, Keyword | Select))
    return _Prepared(
        keywords,
        _heads(keywords),
        {k.name: k.default for k in keywords if not k.repeated},
        tuple(k.name for k in keywords if k.repeated),
        tuple(k for k in keywords if not k.optional),
        not any(isinstance(e, Group | Either) for e in entries),
        tuple((i, e, reader) for i, e, reader in readers if reader is not None),
        choice,
        _heads(chosen),
        tuple(e for e in leads if isinstance(e, Argument)),
    )


def _heads(keywords: Sequence[Keyword | Select]) -> Heads:
    heads: dict[int, dict[str, tuple[tuple[int, Keyword | Select, str], ...]]] = {}
    for i, k in enumerate(keywords):
        begun = heads.setdefault(k.length, {})
        for short, word in shortened(k.words, k.length).items():
            begun[short] = (*begun.get(short, ()), (i, k, word))
    return tuple(heads.items())


def missing_keyword(call: Call, words: Sequence[str]) -> SsiError:
    """The error for a keyword that must stand there."""
    told = {"words": list(words), "found": call.peek_word() or ""}
    return SsiError("missing-keyword", call.span, operator=call.name, **told)


@dataclass(slots=True)
class Bound:
    """A form that the operands fit, with its arguments."""

    form: Form
    values: dict[str, Any]
    choice: Any = None  # the main operand, or the word, that chose a form read by hand


def bind_operator(found: Operator, call: Call) -> Bound:
    """Choose the form that the operands fit and read its arguments.

    Raises
    ------
    SsiError
        That of the form which got furthest, operands put back.
    """
    every = found.choices
    trial = every.only or _trial(found, every, call)
    if trial.said is not None and (again := _as_before(trial, trial.said, call)) is not None:
        return again
    if len(trial.forms) == 1:  # no other form needs the operands as they stood
        try:
            return _bound(trial.forms[0], call, trial)
        except SsiError as problem:
            _tell_form(problem, trial.forms[0])
            raise
    if len(trial.fitting) < len(trial.forms):
        operands, used = list(call.operands), len(call.used)
        for form in trial.fitting:
            try:
                return _bound(form, call, trial)
            except SsiError:
                call.operands[:] = operands
                del call.used[used:]
    # all are tried, and the error of one is told
    worst: tuple[int, SsiError] | None = None
    for form in trial.forms:
        operands, used = list(call.operands), len(call.used)
        try:
            return _bound(form, call, trial)
        except SsiError as problem:
            depth = len(call.used) - used
            _tell_form(problem, form)
            if worst is None or depth > worst[0] or _names_the_slip(worst, depth, problem):
                worst = depth, problem
            elif depth == worst[0]:
                _expects_too(worst[1], problem)
            call.operands[:] = operands
            del call.used[used:]
    if worst is None:
        raise _no_form(found, call)
    raise worst[1]


def _tell_form(problem: SsiError, form: Form) -> None:
    """Let an error show the syntax of the form that it is about."""
    problem.data.setdefault("form_page", form.page)


def _names_the_slip(worst: tuple[int, SsiError], depth: int, problem: SsiError) -> bool:
    """Whether an error shows a variable where another, that got as far, only misses a word."""
    first, expected = worst[1], problem.data.get("expected")
    return (
        depth == worst[0]
        and first.code == "missing-keyword"
        and problem.code == "wrong-argument"
        and isinstance(expected, list)
        and "MOT" in expected
        and bool(problem.data.get("name"))
    )


def _expects_too(first: SsiError, other: SsiError) -> None:
    """Let the error of one form tell what another, that got as far, expects at that place."""
    wanted, more = first.data.get("expected"), other.data.get("expected")
    if first.code == other.code and isinstance(wanted, list) and isinstance(more, list):
        wanted += [t for t in more if t not in wanted]


def _as_before(trial: Trial, said: Said, call: Call) -> Bound | None:
    """The form and arguments that words have said before, where they still mean the same."""
    main, choice, values = trial.main, None, dict(said.values)
    if main is not None and said.form.main is not None:
        if said.hidden:
            names = {n for names_of in said.hidden for n in names_of(call.operands[main].value)}
            if any(word in names for word in call.words()):
                return None
        choice = call.take(main, *said.form.main.types).value
        values[said.form.main.name] = choice
    call.take_first(len(call.operands))
    return Bound(said.form, values)


def _bound(form: Form, call: Call, trial: Trial) -> Bound:
    main, by_main = trial.main, form.main if trial.main is not None else None
    choice: Any = None
    before = len(call.used)
    if main is not None and by_main is not None:
        choice = call.take(main, *by_main.types).value
        before += 1
    elif form.by_hand and form.said is not None:
        choice = call.keyword(form.said.words, form.said.length)
    if form.by_hand:
        return Bound(form, {}, choice)
    entries = form.rest if by_main is not None else form.entries or ()
    values: dict[str, Any] = {}
    if entries:
        binder = Binder(call, choice, trial)
        if form.plain:
            for entry in entries:
                assert isinstance(entry, Argument)
                values[entry.name] = binder.operand(entry)
        else:
            values = binder.bind(entries)
        binder.tell_flaws()
        if form.said is not None and "word" not in form.injected:
            values.pop("word", None)
        words_alone = trial.keyed and binder.taken and not call.operands
        if words_alone and len(call.used) == before + binder.taken:
            _remember(trial, form, values)
    if by_main is not None:
        values[by_main.name] = choice
    return Bound(form, values)


def _remember(trial: Trial, form: Form, values: Mapping[str, Any]) -> None:
    """Keep what keywords alone have said: the same words say it again."""
    if form is trial.fitting[0] and all(map(_lasts, values.values())):
        selects = [k for k in keywords_in(form.rest) if isinstance(k, Select)]
        hidden = tuple(k.unless for k in selects if k.unless is not None)
        trial.said = Said(form, dict(values), hidden)


def _lasts(value: Any) -> bool:
    """Whether a value cannot be changed by who gets it."""
    if isinstance(value, Chosen):
        return all(map(_lasts, value.values.values()))
    return value is None or isinstance(value, str | int | float) or value == ()


_MOST_KNOWN = 500  # things to try that an operator keeps


def _trial(found: Operator, every: Choices, call: Call) -> Trial:
    """Forms to try; what stands there decides, and is looked up where it stood there before."""
    seen = call.seen()
    if seen is None:
        forms, main = _candidates(found, call)
        return Trial(tuple(forms), main, tuple(forms))
    key: tuple[object, ...] = seen
    if every.whens:
        key = (*seen, *[call.meets(w) for w in every.whens])
    known = every.trials.get(key)
    if known is None:
        forms, main = _candidates(found, call)
        kinds, words = tuple([type_of(o.value) for o in call.operands]), call.words()
        left = kinds if main is None else kinds[:main] + kinds[main + 1 :]
        fitting = tuple(f for f in forms if _may_fit(f, left if f.main else kinds, words))
        if len(every.trials) >= _MOST_KNOWN:  # words may be data
            every.trials.clear()
        keywords = list(keywords_in(e for f in forms for e in f.rest))
        most = sum(any(_is_one_of((word,), k) for k in keywords) for word in words)
        known = Trial(tuple(forms), main, fitting, True, not words, most)
        every.trials[key] = known
    return known


def _may_fit(form: Form, kinds: Sequence[str], words: Sequence[str]) -> bool:
    """Whether operands of these types, with these words, may be enough for a form.

    Reading takes operands away, but for macros: what a form lacks now, it lacks whatever is read
    before. Groups are not looked into.
    """
    if form.by_hand:
        return True
    wanted = 0
    for e in form.rest:
        if isinstance(e, Group | Either) or e.optional:
            continue
        wanted += 1
        if isinstance(e, Argument):
            if not any(_may_be(e.types, kind) for kind in kinds):
                return False
            continue
        if not _is_one_of(words, e):
            return False
    return wanted <= len(kinds)


def _is_one_of(words: Sequence[str], k: Keyword | Select) -> bool:
    """Whether one of the words may be the keyword."""
    said = shortened(k.words, k.length)
    return any(word[: k.length] in said for word in words)


def _may_be(types: Sequence[str], kind: str) -> bool:
    """Whether an operand of a type may be read as one of the types, or for its name."""
    name = NAME in types or (kind == "PROCEDUR" and "MOT" in types)
    return name or accepts_kind(types, kind)


def _candidates(found: Operator, call: Call) -> tuple[Sequence[Form], int | None]:
    """Forms to try, in order, and the index of the main operand where it chose them."""
    every = choices = found.choices
    if every.conditional:
        choices = found.choices_where(tuple(_is_meant(f, call) for f in every.forms))
    forms = choices.forms
    if len(forms) == 1 and forms[0].main is None:
        return forms, None
    words = call.words() if choices.said else []
    if words:
        spoken = [f for f in every.said if _is_said(f, words)]
        meant = sorted((f for f in spoken if f in forms), key=lambda f: not f.of) if spoken else []
        if spoken and not meant:
            raise call.missing(tuple(dict.fromkeys(t for f in spoken for t in f.of)) or (ANY,))
        if meant:
            return meant, None
    main = call.main_operand(*choices.known) if choices.known else None
    if main is not None:
        chosen, silent = _of_kind(choices, type_of(call.operands[main].value))
        if chosen and not silent:
            raise missing_keyword(call, _words_said(chosen))
        return silent, main
    return choices.plain, None


def _of_kind(choices: Choices, kind: str) -> tuple[tuple[Form, ...], tuple[Form, ...]]:
    """Forms whose main operand may be of the type, and those of them that want no word."""
    found = choices.by_kind.get(kind)
    if found is None:
        fit = tuple(
            f for f in choices.forms if f.main is not None and accepts_kind(f.main.types, kind)
        )
        found = choices.by_kind[kind] = fit, tuple(f for f in fit if f.said is None)
    return found


def _is_meant(form: Form, call: Call) -> bool:
    if form.when is not None and not call.meets(form.when):
        return False
    return not form.of or call.stands(*form.of)


def accepts_kind(types: Sequence[str], kind: str) -> bool:
    """Whether an object of type `kind` may be read as one of the types."""
    return ANY in types or kind in types or (kind == "ENTIER" and "FLOTTANT" in types)


def _is_said(form: Form, words: Sequence[str]) -> bool:
    """Whether a word of the form's stands first among the unread ones, or behind its keywords."""
    if form.said is None:
        return False
    said, length = shortened(form.said.words, form.said.length), form.said.length
    for word in words:
        if word[:length] in said:
            return True
        if word[:4] not in form.beside:
            break
    return False


def _words_said(forms: Iterable[Form]) -> list[str]:
    """The words of forms, each once."""
    return list(dict.fromkeys(w for f in forms if f.said is not None for w in f.said.words))


def _no_form(found: Operator, call: Call) -> SsiError:
    """The error where no form of an operator fits the words and types that stand there."""
    unmet = [f.when for f in found.forms if f.when is not None and not call.meets(f.when)]
    words = _words_said(found.forms)
    known = dict.fromkeys(t for f in found.forms if f.main is not None for t in f.main.types)
    wanted = dict.fromkeys(t for f in found.forms for t in f.of)
    if known and not (words and call.peek_word()):
        return call.missing(tuple(known))
    if words:
        return missing_keyword(call, sorted(words))
    if unmet:
        return SsiError(
            "form-condition", call.span, operator=call.name, en=unmet[0].en, fr=unmet[0].fr
        )
    return call.missing(tuple(wanted) or (ANY,))


def run_operator(found: Operator, call: Call) -> Any:
    """Choose the form that the operands fit and run it; returns what the function returned."""
    bound = bind_operator(found, call)
    form, values = bound.form, bound.values
    calls = call.session.calls
    calls[found.name] = calls.get(found.name, 0) + 1
    if call.session.on_form is not None:
        call.session.on_form(found, form, values)
    if form.by_hand:
        chooses = form.main is not None or form.said is not None
        return form.function(call, bound.choice) if chooses else form.function(call)
    if form.injected:
        if "session" in form.injected:
            values["session"] = call.session
        if "call" in form.injected:
            values["call"] = call
    return form.function(**values)
