"""Search in what help knows: names, summaries, texts, in both languages, ranked."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass

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


def fold(text: str) -> str:
    """Lower case without accents."""
    parts = unicodedata.normalize("NFKD", text.replace("œ", "oe"))
    return "".join(c for c in parts if not unicodedata.combining(c)).lower()


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
