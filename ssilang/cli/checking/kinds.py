"""What is known of a value before the script runs: its type, a word's content, a constant."""

from __future__ import annotations

import typing
from functools import cache
from typing import Any

from ssilang.language.registry import Form
from ssilang.language.values import Mot, known_classes


class Ambiguous(Exception):
    """What happens next depends on a value that is not known."""


class Unknown:
    """Any object, perhaps none."""

    __slots__ = ()


UNKNOWN = Unknown()


class Something:
    """Results of an operator that says nothing of their types: none is taken for a word."""

    __slots__ = ()


SOMETHING = Something()


class AnyWord(Mot):
    """A MOT whose content is not known."""

    __slots__ = ()


ANY_WORD = AnyWord("?")


_ACTIVE = frozenset({"PROCEDUR", "TEXTE", "ANNULE"})  # what they do depends on which one it is


@cache
def typed(word: str) -> Any:
    """A stand-in for an object of which only the type is known.

    `type_of` gives the name of its class.
    """
    if word == "MOT":
        return ANY_WORD
    if word in _ACTIVE:
        return UNKNOWN
    return type(word, (), {"__slots__": ()})() if word else UNKNOWN


def same(a: Any, b: Any) -> Any:
    """What is known of a value that may be one or the other."""
    if a is b or (type(a) is type(b) and isinstance(a, int | float | Mot) and a == b):
        return a
    ta, tb = kind_word(a), kind_word(b)
    return typed(ta) if ta and ta == tb and ta != "PROCEDUR" else UNKNOWN


def kind_word(value: Any) -> str:
    """Type word of a stand-in or value, '' when unknown."""
    from ssilang.language.values import type_of

    return "" if value is UNKNOWN or value is SOMETHING else type_of(value)


NOTHING = "nothing"


def result_type(form: Form) -> str:
    """Type word of what a form gives, from its function's annotation.

    Returns
    -------
    str
        A type word, `NOTHING` for a directive, '' when the annotation does not say.
    """
    note = form.function.__annotations__.get("return", "")
    if note is None or note == "None":
        return NOTHING
    name = note if isinstance(note, str) else getattr(note, "__name__", "")
    return _type_words().get(name.split(".")[-1], "")


@cache
def _type_words() -> typing.Mapping[str, str]:
    return {cls.__name__: word for cls, word in known_classes().items()}
