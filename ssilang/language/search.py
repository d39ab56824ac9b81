"""Search in what help knows, ranked, and the known name that a misspelt word means."""

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from itertools import takewhile
from typing import Any

LIKE, VERY_LIKE = 0.7, 0.8
"""Part of the letters of two words that agree."""

SHORT_LIKE = 0.6
"""Of names of two or three letters, one slip is a third."""


@lru_cache(maxsize=1 << 16)
def slips(a: str, b: str) -> int:
    """Letters put in, left out, changed, or swapped with their neighbour, to make b of a.

    The restricted distance of Damerau and Levenshtein (optimal string alignment): RSEO and RESO
    are one slip apart.
    """
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        last, row, older = row, [i], before
        for j, y in enumerate(b, 1):
            least = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (x != y))
            if i > 1 and j > 1 and x == b[j - 2] and a[i - 2] == y:
                least = min(least, older[j - 2] + 1)
            row.append(least)
        before = last
    return row[-1]


def likeness(a: str, b: str) -> float:
    """Part of the letters that agree: 1 for equal words, 0 for words without a common letter."""
    longest = max(len(a), len(b))
    return 1.0 - slips(a, b) / longest if longest else 1.0


def nearest_names(
    word: str, known: Iterable[str], least: float = LIKE, count: int = 3
) -> list[str]:
    """The known names that look like `word`, the nearest first, at most `count`.

    Of names as near, those with the same letters come first (a swap is the usual slip), then
    those that begin alike for longer.
    """
    said = word.upper().rstrip()
    found = []
    for name in dict.fromkeys(known):
        longest = max(len(said), len(name))
        if not longest or abs(len(said) - len(name)) > (1.0 - least) * longest:
            continue
        alike = likeness(said, name.upper())
        if alike >= least - 1e-12:
            swapped = sorted(said) == sorted(name.upper())
            pairs = zip(said, name.upper(), strict=False)
            beginning = len(list(takewhile(lambda pair: pair[0] == pair[1], pairs)))
            found.append((-alike, not swapped, -beginning, name))
    return [name for *_, name in sorted(found)[:count]]


def nearest(word: str, known: Iterable[str], least: float = LIKE) -> str:
    """The known name that looks most like `word`, '' if none is as like as `least`."""
    return next(iter(nearest_names(word, known, least, 1)), "")


def nearest_told(word: str, known: Iterable[str]) -> dict[str, Any]:
    """What tells of a short name that is not among those known: which of them is near, and all."""
    several = list(known)
    return {"near": nearest(word, several, SHORT_LIKE), "known": several}


_BEGINNING = 4
"""Letters that a word and its abbreviation share at least."""


def meant(word: str, known: Iterable[str]) -> str:
    """The known word that `word` is a slip or an abbreviation of, '' if there is none.

    A word and its beginning (VITESSE, VITE) are near; else one letter in four may be wrong.
    """
    said = word.upper().rstrip()
    found: list[tuple[int, str]] = []
    for other in known:
        short, long = sorted((said, other.upper()), key=len)
        distance = slips(said, other.upper())
        if distance <= len(short) // 4:
            found.append((distance, other))
        elif len(short) >= _BEGINNING and long.startswith(short):
            found.append((len(long), other))
    return min(found, default=(0, ""))[1]


_WORD = re.compile(r"[^\W_]+")
_SHORTEST = 4  # letters of a beginning that two forms of a word share

# points of a match: the name, a word of it, of the summary, of the text
_NAME, _NAME_PART, _SUMMARY, _TEXT, _OFTEN = 100.0, 40.0, 30.0, 8.0, 5
_FORM = 0.6  # part of the points that another form of the word gets (modes, modal)


@dataclass(frozen=True, slots=True)
class Item:
    """Something that can be found.

    Attributes
    ----------
    name : str
        What help shows its page by.
    label : str
        What it is ('operator', 'law of joints').
    summary : str
        One line, in the reader's language.
    text : str
        All that is searched, in both languages.
    """

    name: str
    label: str
    summary: str
    text: str = ""


@lru_cache(10_000)  # a search asks for each text once a word
def fold(text: str) -> str:
    """Lower case without accents."""
    parts = unicodedata.normalize("NFKD", text.replace("œ", "oe"))
    kept = parts if parts.isascii() else "".join(c for c in parts if not unicodedata.combining(c))
    return kept.lower()


def _match(word: str, said: str) -> float:
    """1 for the word said, less for another form of it, 0 for another word."""
    if word == said:
        return 1.0
    shared = max(_SHORTEST, len(said) - 2)
    alike = word[:shared] == said[:shared] and abs(len(word) - len(said)) <= 3
    return _FORM if alike and len(said) >= _SHORTEST else 0.0


def _best(words: Iterable[str], said: str) -> float:
    """The best match, the more the earlier it stands."""
    return max((_match(w, said) * (1.0 + 1.0 / (1 + i)) for i, w in enumerate(words)), default=0.0)


def score(item: Item, said: str) -> float:
    """How well an item fits one folded word, 0 if it does not."""
    name = fold(item.name)
    points = _NAME if name == said else _NAME_PART * _best(_WORD.findall(name), said)
    points += _SUMMARY * _best(_WORD.findall(fold(item.summary)), said)
    found = [m for w in _WORD.findall(fold(item.text)) if (m := _match(w, said))]
    if found:
        points += _TEXT * max(found) + min(sum(found), _OFTEN)
    return points


def search(query: str, items: Iterable[Item]) -> list[Item]:
    """The items that fit all words of a query, the best first."""
    said = _WORD.findall(fold(query))
    if not said:
        return []
    ranked = []
    for item in items:
        points = [score(item, word) for word in said]
        if all(points):
            ranked.append((-sum(points), item.name, item))
    ranked.sort(key=lambda row: row[:2])
    return [item for *_, item in ranked]
