"""Which known word a misspelt one was meant to be."""

from __future__ import annotations

from collections.abc import Iterable

_BEGINNING = 4
"""Letters that a word and its abbreviation share at least."""


def edit_distance(a: str, b: str) -> int:
    """Letters to insert, drop, change or swap with their neighbour to get from `a` to `b`.

    Optimal string alignment (Damerau 1964): a swap of neighbours counts once.
    """
    before: list[int] = []
    last = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        row = [i]
        for j, other in enumerate(b, 1):
            cost = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (letter != other))
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == other:
                cost = min(cost, before[j - 2] + 1)
            row.append(cost)
        before, last = last, row
    return last[-1]


def near_word(word: str, known: Iterable[str]) -> str:
    """The known word that `word` is a slip of, '' if there is none.

    A word and its beginning (VITESSE, VITE) are near; else one letter in four may be wrong.
    """
    said = word.upper().rstrip()
    found: list[tuple[int, str]] = []
    for other in known:
        short, long = sorted((said, other.upper()), key=len)
        distance = edit_distance(said, other.upper())
        if distance <= len(short) // 4:
            found.append((distance, other))
        elif len(short) >= _BEGINNING and long.startswith(short):
            found.append((len(long), other))
    return min(found, default=(0, ""))[1]
