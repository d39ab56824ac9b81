"""Examples that run, for laws, elements, components and options: by name, else by sort."""

from pathlib import Path

from ssilang.language.vocabulary.terms import Word
from ssilang.remembered import tables_of

_OWN = ("elasticity", "plastic", "joint")
"""Sorts of laws of which one has an example of its own."""


def examples() -> dict[str, str]:
    """All scripts by what they show."""
    return tables_of(Path(__file__).with_suffix(".toml"))  # type: ignore[no-any-return]


def example(kind: str, word: Word) -> str:
    """An example of a word, '' if there is none."""
    keys = [f"{kind} {word.name}", f"{kind} {word.kind}", kind]
    if kind == "element" or (kind == "law" and word.kind in _OWN):
        keys.insert(0, word.name)
    return next((examples()[key] for key in keys if key in examples()), "")
