"""What an operator gives, before it runs: types of results by form."""

import re
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from ssilang.language.registry import By, Form, Like
from ssilang.language.values import type_of, words_of_classes

Results = tuple[str, ...]
"""A result each: a type word, 'A|B' for one or the other, `ANY` where only the run can tell."""


def results_of(form: Form, values: Mapping[str, Any] | None = None) -> Results | None:
    """Types of the results of a form.

    Parameters
    ----------
    values : mapping, optional
        Arguments that were bound, for forms that give what they were given.

    Returns
    -------
    tuple of str or None
        () for a directive; None where neither declaration nor annotation tells.
    """
    given = form.gives
    if isinstance(given, Like):
        held = [(values or {}).get(name) for name in (given.name, *given.more)]
        if None in held:
            return None
        return tuple(
            type_of(v) for h in held for v in (h if isinstance(h, (tuple, list)) else (h,))
        )
    if isinstance(given, By):
        return given.of((values or {}).get(given.name))
    if given is not None:
        return given
    return annotated(form.function)


@cache
def annotated(function: Callable[..., Any]) -> Results | None:
    """Types of what a function's annotation says that it returns, None where it does not tell."""
    note = function.__annotations__.get("return", "")
    if note is None:
        return ()
    text = note.__name__ if isinstance(note, type) else str(note)
    found = re.fullmatch(r"tuple\[(.+)\]", text)
    parts = [p.strip() for p in found.group(1).split(",")] if found else [text]
    if "..." in parts:
        return None
    words = [_words(part) for part in parts]
    if words == [("",)]:
        return ()
    return None if any(w is None for w in words) else tuple("|".join(w) for w in words if w)


def _words(note: str) -> tuple[str, ...] | None:
    """Type words of an annotation such as 'Mesh | Point'; None if one is no class known."""
    found: list[str] = []
    for name in (n.strip() for n in note.split("|")):
        if name == "None":
            found.append("")
            continue
        word = _type_words().get(name.split(".")[-1].split("[")[0])
        if word is None:
            return None
        found.append(word)
    return tuple(dict.fromkeys(found))


_type_words = cache(words_of_classes)
