"""Names that get a value which nothing reads."""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from ssilang.language.say.errors import SsiError
from ssilang.language.search import VERY_LIKE, nearest
from ssilang.language.text import tree

_NAME = re.compile(r"[@&!]?[^\W\d]\w*")
_ALONE = {("**", "/"), ("*", "+"), ("*", "-")}  # signs about a 1 that belongs to what follows
_RANK = {"+": 0, "-": 0, "*": 1, "/": 1, "**": 2}  # of signs, in other languages
_NAMED = 5  # places that a note names
_SHORTEST = 4  # letters of a word that may be a misspelt name
_PROPERTIES = frozenset({"MATE", "MODE", "RIGI", "MASS", "AMOR", "CHAR", "LIRE"})
_NODAL = frozenset({"APPU", "AMOR"})
_WAYS = frozenset({"UX", "UY", "UZ", "RX", "RY", "RZ"})
_LEVEL = {"UX", "UY"}, {"RX", "RY"}  # pairs that a base of space may have turned
_SHEAR = re.compile(r"G(0|MAX|SOL|_?\d)?", re.IGNORECASE)
_PULSATION = re.compile(r"\(?(2\.?\*PI|PI\*2\.?)\*")
_WHOLE_SESSION = frozenset({"SAUV", "LIST", "REST", "NOMM"})  # may read any name


def unused_names(script: tree.Script) -> list[SsiError]:
    """A warning for each name that no statement reads, at its first assignment.

    Names that stand in quoted words count as read: texts and computed names use them. A statement
    with several names is left out when one of them is read. A table that TABL makes is not read
    where it is filled.
    """
    read: set[str] = set()
    first: dict[str, tree.Name] = {}
    filled, others = set[str](), set[str]()
    for statement in statements_of(script.body):
        words = _words(statement.items)
        if reads_all(statement):
            return []
        read |= words
        for target in statement.targets:
            if isinstance(target, tree.Name):
                first.setdefault(target.text, target)
                if (*statement.items, target)[0].span.text[:4].upper() != "TABL":
                    others.add(target.text)
            elif isinstance(target, tree.Path) and isinstance(target.base, tree.Name):
                filled.add(target.base.text)
                read |= _words(target.indices)
            else:
                read |= _words((target,))
    read |= filled & others
    for statement in statements_of(script.body):
        names = {t.text for t in statement.targets if isinstance(t, tree.Name)}
        if names & read:
            read |= names
    return [
        SsiError("unused-name", target.span, name=name)
        for name, target in first.items()
        if name not in read
    ]


def reads_all(statement: tree.Statement) -> bool:
    return statement.first_word[:4] in _WHOLE_SESSION and len(statement.items) == 1


def stale_names(script: tree.Script) -> Iterator[SsiError]:
    """A warning for each property or file that is given anew, and not read behind that.

    What was made of the one before keeps it. A turn of a loop comes before those behind it, and a
    procedure may be called, with the names of its caller, from anywhere.
    """
    reads: dict[str, list[tuple[int, int, float]]] = {}  # where, until when, from when on
    given: list[tuple[int, tree.Name]] = []
    made, start = {*_PROPERTIES}, 0
    for node in script.body:
        found = [*statements_of([node])]
        end = start + len(found)
        until = end if isinstance(node, tree.Loop) else 0
        again = end if isinstance(node, tree.Definition) else math.inf
        for at, each in enumerate(found, start):
            if reads_all(each):
                given = []
            target, first = (*each.targets, None)[0], (*each.items, None)[0]
            paths = [t for t in each.targets if not isinstance(t, tree.Name)]
            for name in _words((*each.items, *paths)):
                reads.setdefault(name, []).append((at, until, again))
            while isinstance(first, tree.Paren):
                first = (*first.items, None)[0]
            by = first.text if isinstance(first, tree.Name) else ""
            if isinstance(target, tree.Name) and {by, by[:4]} & made:
                given.append((at, target))
                made.add(target.text)
        start = end
    for at, target in given:
        others = [r for r in reads.get(target.text, ()) if r[0] != at]
        if others and not any(at < max(i, to) or at >= again for i, to, again in others):
            yield SsiError("stale-name", target.span, name=target.text)


def misspelt_names(
    script: tree.Script, names: frozenset[str], words: frozenset[str]
) -> list[SsiError]:
    """A warning for each bare word that has no value and looks like a name that has one.

    Parameters
    ----------
    names : frozenset of str
        Names that have a value somewhere.
    words : frozenset of str
        Words that operators know, which need no value.
    """
    found: dict[str, SsiError] = {}
    long_names = [n for n in names if len(n) >= _SHORTEST and n[0] != "&"]
    for statement in statements_of(script.body):
        for item in bare_names(statement.items[1:] if not statement.assigns else statement.items):
            if len(item.text) < _SHORTEST or item.text in names or item.text[:4] in words:
                continue
            near = nearest(item.text, long_names, VERY_LIKE)
            # a word with a letter in front or behind is a name made from a keyword
            made = near in item.text or item.text in near
            if near and not made and item.text not in found:
                found[item.text] = SsiError(
                    "perhaps-misspelt", item.span, name=item.text, like=near
                )
    return list(found.values())


def left_to_right(script: tree.Script) -> Iterator[SsiError]:
    """A note, at the first, of places where a sign comes before one that elsewhere goes first.

    And of each 1 that a power, or a product in front of a sum, takes for itself alone.
    """
    fives = [
        five
        for statement in statements_of(script.body)
        for items in phrases_in((*statement.targets, *statement.items))
        for five in zip(*(items[k:] for k in range(5)), strict=False)
    ]
    for five in fives:
        a, first, one, then, c = (" ".join(item.span.text.split()) for item in five)
        if (first, then) in _ALONE and isinstance(five[2], tree.Number) and five[2].value == 1:
            told = {"wrong": f"{a} {first} {one}", "meant": f"{a} {first} ({one} {then} {c})"}
            yield SsiError("one-changes-nothing", five[0].span.to(five[4].span), **told)
    found = [f for f in fives if _RANK.get(_sign(f[1]), 3) < _RANK.get(_sign(f[3]), 0)]
    said = []
    for five in found[:_NAMED]:
        line = five[0].span.source.position(five[0].span.start)[0]
        a, first, b, then, c = (" ".join(item.span.text.split()) for item in five)
        said.append(f"{a} {first} {b} {then} {c} = ({a} {first} {b}) {then} {c} ({line})")
    if found:
        told = {"places": said, "more": len(found) - len(said)}
        yield SsiError("left-to-right", found[0][0].span.to(found[0][4].span), **told)


def crossed_words(script: tree.Script, *, plane: bool) -> Iterator[SsiError]:
    """Springs along one axis by another one's number, frequencies (Hz) that are pulsations.

    And shear moduli for Young's. Two horizontal axes of space may be turned.
    """
    for statement in statements_of(script.body):
        for items in phrases_in(statement.items):
            word = (*items, None)[0]
            first = word.text[:4] if isinstance(word, tree.Name) else ""
            named: list[str] = []
            for a, b in pairwise(items):
                if (
                    isinstance(a, tree.Quoted)
                    and a.text == "YOUN"
                    and _SHEAR.fullmatch(b.span.text)
                ):
                    yield SsiError("shear-for-young", b.span, name=b.span.text)
            for item in items if first in _NODAL else ():
                (of, *more) = item.items if isinstance(item, tree.Paren) else (item,)
                last = of.indices[-1] if isinstance(of, tree.Path) and not more else None
                other = last.text.upper() if isinstance(last, tree.Quoted) else ""
                if isinstance(item, tree.Quoted) and item.text.upper() in _WAYS:
                    named.append(item.text.upper())
                elif other in _WAYS and named and other not in named:
                    if plane or {*named, other} not in _LEVEL:
                        told = {"operator": first, "unknown": named[-1], "other": other}
                        yield SsiError("spring-of-another", item.span, **told)
                    named = []
        target = statement.targets[0] if statement.assigns and statement.targets else None
        index = target.indices[-1] if isinstance(target, tree.Path) else None
        entry = index.text.upper() if isinstance(index, tree.Quoted) else ""
        said = "".join(i.span.text for i in statement.items).replace(" ", "").upper()
        if entry in ("FREQUENCE", "FREQUENCES") and _PULSATION.match(said) and "/" not in said:
            span = statement.items[0].span.to(statement.items[-1].span)
            yield SsiError("pulsation-for-frequency", span, name=entry)


def _sign(item: tree.Item) -> str:
    return item.text if isinstance(item, tree.Symbol) else ""


def phrases_in(items: Sequence[tree.Item]) -> Iterator[Sequence[tree.Item]]:
    """A phrase and those in its parentheses."""
    yield items
    for item in items:
        inside = item.items if isinstance(item, tree.Paren) else ()
        yield from phrases_in(item.indices if isinstance(item, tree.Path) else inside)


def bare_names(items: Sequence[tree.Item]) -> Iterator[tree.Name]:
    """Names that stand as operands, not as indices of tables, nor before the lists of `EVOL`."""
    said = [i.text.upper()[:4] for i in items if isinstance(i, tree.Quoted | tree.Name)]
    free = "EVOL" in said and bool({"MANU", "COMP"} & {*said})
    for place, item in enumerate(items):
        if isinstance(item, tree.Name):
            if not free or item is items[-1] or isinstance(items[place + 1], tree.Symbol):
                yield item
        elif isinstance(item, tree.Paren):
            yield from bare_names(item.items)
        elif isinstance(item, tree.Path):
            yield from bare_names(
                [item.base, *(i for i in item.indices if isinstance(i, tree.Paren))]
            )


def statements_of(nodes: Iterable[tree.Node]) -> Iterator[tree.Statement]:
    """All statements, with the parts of blocks that read values."""
    for node in nodes:
        if isinstance(node, tree.Statement):
            yield node
        elif isinstance(node, tree.If):
            yield node.condition
            yield from statements_of(node.then)
            yield from statements_of(node.otherwise)
        elif isinstance(node, tree.Loop):
            yield tree.Statement((), node.count, node.span)
            yield from statements_of(node.body)
        else:
            yield from statements_of(node.body)
            yield tree.Statement((), node.results, node.span)


def _words(items: Iterable[tree.Item]) -> set[str]:
    found: set[str] = set()
    for item in tree.leaves(items):
        if isinstance(item, tree.Name):
            found.add(item.text)
        elif isinstance(item, tree.Quoted):
            found |= {w.upper() for w in _NAME.findall(item.text)}
    return found
