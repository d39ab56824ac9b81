"""Words behind an operator that are nearly one of its keywords, or of the words that it takes."""

from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache, lru_cache

from ssilang.cli.checking.usage import statements_of
from ssilang.io.plots.palette import COLOURS
from ssilang.language import registry, vocabulary
from ssilang.language.say.errors import SsiError
from ssilang.language.search import VERY_LIKE, nearest, slips
from ssilang.language.text import tree

_OWN = frozenset({"component"})  # scripts may have names of their own
_SHORT, _LONG = 2, 5
"""Letters of a word that may be misspelt, and from which on more than a swap is one slip."""
_ASKED = 8192  # words whose answers are held: more than a long deck has


def misspelt_words(script: tree.Script, names: frozenset[str]) -> Iterator[SsiError]:
    """A warning at each word that its operator does not know, but nearly.

    Parameters
    ----------
    names : frozenset of str
        Names that have a value somewhere: they are no words.
    """
    reader = _Words(names)
    statements = list(statements_of(script.body))
    for statement in statements:
        reader.count(statement.items)
    for statement in statements:
        yield from reader.phrase(statement.items)


class _Words:
    """Goes through phrases from left to right: a word belongs to the operator before it."""

    def __init__(self, names: frozenset[str]) -> None:
        self.names = names
        self.times: Counter[str] = Counter()

    def count(self, items: Iterable[tree.Item]) -> None:
        """Count the words of a phrase, those that are indices of tables too."""
        for item in tree.leaves(items):
            if isinstance(item, tree.Quoted | tree.Name):
                self.times[item.text.upper()] += 1

    def phrase(self, items: Iterable[tree.Item]) -> Iterator[SsiError]:
        """What is misspelt in a phrase and in its parentheses."""
        items = tuple(items)
        operator: registry.Operator | None = None
        for place, item in enumerate(items):
            if isinstance(item, tree.Paren):
                yield from self.phrase(item.items)
            elif isinstance(item, tree.Path):
                yield from self.phrase(i for i in item.indices if isinstance(i, tree.Paren))
            elif isinstance(item, tree.Quoted | tree.Name) and item.text.upper() not in self.names:
                word = item.text.upper().rstrip()
                if operator is not None and (
                    _knows(operator.name, word) or _frees(operator.name, items[place - 1])
                ):
                    continue
                named = self._named(operator, word, isinstance(item, tree.Quoted))
                if named is not None:
                    operator = named
                elif operator is not None and not _named_freely(operator.name, items):
                    yield from self._near(operator, word, item)
                elif place == 0 and isinstance(item, tree.Name) and self._is_operator(word):
                    yield SsiError("unknown-operator", item.span, name=item.text)

    @staticmethod
    def _named(
        before: registry.Operator | None, word: str, quoted: bool
    ) -> registry.Operator | None:
        """The operator that a word names behind another one, which may take it as a word."""
        if before is not None and (quoted or _takes_words(before.name)):
            return None
        return registry.find_operator(word)

    def _is_operator(self, word: str) -> bool:
        """Whether a word that stands nowhere else is nearly an operator's name."""
        if len(word) < vocabulary.SHORT or self.times[word] > 1:
            return False
        full = {o.full_name for o in registry.OPERATORS.values()}
        swapped = any(sorted(word) == sorted(name) for name in registry.OPERATORS)
        return swapped or bool(nearest(word, full, VERY_LIKE))

    def _near(
        self, operator: registry.Operator, word: str, item: tree.Quoted | tree.Name
    ) -> Iterator[SsiError]:
        near = _meant(operator.name, word, self.times[word] == 1)
        if near:
            yield SsiError(
                "near-word", item.span, name=item.text, operator=operator.full_name, near=near
            )


@cache
def _kinds(name: str) -> frozenset[str]:
    """Lists of the vocabulary that an operator takes words of."""
    found = registry.find_operator(name)
    forms = found.forms if found is not None else ()
    declared = {a.kind for form in forms for a in registry.arguments_in(form.entries or ())}
    return frozenset({*declared, *vocabulary.WORDS_OF.get(name, ())} & {*vocabulary.KINDS})


@cache
def _keywords(name: str) -> tuple[str, ...]:
    found = registry.find_operator(name)
    return tuple(w.rstrip() for w in registry.keywords_of(found)) if found is not None else ()


@cache
def _takes_words(name: str) -> bool:
    """Whether an operator takes all words behind it: names of parameters, words of a list."""
    found = registry.find_operator(name)
    forms = found.forms if found is not None else ()
    lists = [
        entry
        for form in forms
        for entry in form.entries or ()
        if isinstance(entry, registry.Argument | registry.Group) and entry.repeated
    ]
    return any("MOT" in a.types for a in registry.arguments_in(lists))


def _named_freely(name: str, items: tuple[tree.Item, ...]) -> bool:
    """Whether a word of the phrase chooses a way to read where names stand as the script likes.

    Axes of `EVOL 'MANU'`.
    """
    said = {i.text.upper() for i in items if isinstance(i, tree.Quoted | tree.Name)}
    return any(w[:length] in cases for w in said for length, cases in _free_cases(name))


@cache
def _free_cases(name: str) -> tuple[tuple[int, frozenset[str]], ...]:
    """Words that choose within an operator, with the letters that count, before free names."""
    found = registry.find_operator(name)
    selects = [
        entry
        for form in (found.forms if found is not None else ())
        for entry in form.entries or ()
        if isinstance(entry, registry.Select)
    ]
    return tuple(
        (s.length, frozenset(w[: s.length] for w, inner in s.cases.items() if _has_free(inner)))
        for s in selects
    )


def _has_free(entries: Iterable[registry.Entry]) -> bool:
    """Whether a word of no list of the vocabulary is read, besides the values of keywords."""
    return any(
        isinstance(e, registry.Argument) and e.types == ("MOT",) and not e.kind for e in entries
    )


def _frees(name: str, before: tree.Item) -> bool:
    """Whether a keyword stands before the word that takes any: the name of a constituent."""
    found, said = registry.find_operator(name), getattr(before, "text", "").upper()
    return any(
        isinstance(k, registry.Keyword)
        and _has_free(k.arguments[:1])
        and said[: k.length] in {w[: k.length] for w in k.words}
        for form in (found.forms if found is not None else ())
        for k in registry.keywords_in(form.entries or ())
    )


@cache
def _values() -> frozenset[str]:
    """Words that options may be set to, by their first letters."""
    options = (o for o in vocabulary.words("option") if isinstance(o, vocabulary.Option))
    values = {v.name[: vocabulary.SHORT] for o in options for v in o.values}
    return frozenset({*values, *(n[: vocabulary.SHORT] for n in vocabulary.names("element"))})


@lru_cache(_ASKED)
def _knows(operator: str, word: str) -> bool:
    short, kinds = word[: vocabulary.SHORT], _kinds(operator)
    if short in COLOURS:
        return True
    alike = [w for w in _keywords(operator) if w[: vocabulary.SHORT] == short]
    if "law" in kinds:  # JOINT_SDM and JOINT_SOFT differ behind their fourth letter
        alike = [w for w in alike if w.startswith(word) or word.startswith(w)]
    return (
        bool(alike)
        or any(vocabulary.full_name(kind, word) for kind in kinds)
        or ("option" in kinds and short in _values())
    )


@lru_cache(_ASKED)
def _meant(operator: str, word: str, once: bool) -> str:
    """The word that is meant, '' if none is certain enough; `once`: it stands nowhere else."""
    if len(word) < _SHORT:
        return ""
    kinds = _kinds(operator)
    for kind in sorted(kinds - _OWN):
        found = [n for n in vocabulary.near(kind, word) if _begins_alike(word, n)]
        if found:
            return found[0]
    if kinds & _OWN and once and not vocabulary.full_name("parameter", word):
        known = vocabulary.names("component")
        if word[1:2] == "I" and {word[0] + "P" + word[2:], word[0] + "A" + word[2:]} & {*known}:
            return ""  # an inelastic strain, EIXX beside EPXX and GIXY beside GAXY
        near = [n for n in known if _one_slip(word, n)]
        if near:
            return min(near, key=lambda n: (sorted(n) != sorted(word), n))
    swapped = [w for w in _keywords(operator) if sorted(w) == sorted(word)]
    if swapped and once:
        return swapped[0]
    return nearest(word, _keywords(operator), VERY_LIKE) if len(word) >= _LONG else ""


def _begins_alike(word: str, name: str) -> bool:
    """Whether the first letter is right, or letters were swapped: CREF does not mean TREF."""
    return word[0] == name[0] or sorted(word) == sorted(name)


def _one_slip(word: str, name: str) -> bool:
    """Whether letters were swapped, or one is too many or missing; VX beside UX is another word."""
    other = sorted(word) == sorted(name) or len(word) != len(name) or len(name) >= _LONG
    return len(name) > 1 and slips(word, name) == 1 and other
