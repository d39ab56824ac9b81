"""What is known of a value before the script runs: its type, a word's content, a constant."""

from functools import cache
from typing import Any

from ssilang.language.registry import ANY
from ssilang.language.run.not_built import NotBuilt
from ssilang.language.values import Mot


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


@cache
def known_model(words: tuple[str, ...]) -> Any:
    """A stand-in for a model of which the words behind MODE are known."""
    return type("MMODEL", (), {"__slots__": (), "words": words})()


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

    known = value is not UNKNOWN and value is not SOMETHING and type(value) is not NotBuilt
    return type_of(value) if known else ""


def one_of(word: str) -> Any:
    """A stand-in for a result of type `word`, unknown where it may be of several types."""
    return UNKNOWN if word == ANY or "|" in word else typed(word)
