"""Which forms of operators ran, and which words chose what they read: are they all tried?"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NoReturn

from ssilang.language.registry import Chosen, Either, Entry, Form, Group, Operator, Select


class FormsRan:
    """Collects the forms that a run has gone through; listens as `Session.on_form`."""

    def __init__(self) -> None:
        self._seen: set[tuple[str, int, str]] = set()

    def __call__(self, operator: Operator, form: Form, values: Mapping[str, Any]) -> None:
        """Note a form that runs, with what its entries read."""
        number = next(n for n, known in enumerate(operator.forms, 1) if known is form)
        self._seen.add((operator.name, number, ""))
        for path, word in _chosen(form.entries or (), values):
            self._seen.add((operator.name, number, f"{path}{word}"))

    def missing(self, operator: Operator) -> list[str]:
        """Forms of an operator that have not run, '2', and words of forms that have, '2 MAXI'.

        A form that does nothing but refuse is none that could run.
        """
        left = []
        for number, form in enumerate(operator.forms, 1):
            function = getattr(form.function, "func", form.function)  # what a partial is made of
            if function.__annotations__.get("return") in (NoReturn, "NoReturn"):
                continue
            if (operator.name, number, "") not in self._seen:
                left.append(str(number))
            elif not form.by_hand:  # what such a form reads is known to it alone
                words = dict.fromkeys(_words(form.entries or ()))
                left += [f"{number} {w}" for w in words if not self._ran(operator, number, w)]
        return left

    def _ran(self, operator: Operator, number: int, word: str) -> bool:
        return (operator.name, number, word) in self._seen


def _words(entries: Iterable[Entry], path: str = "") -> Iterator[str]:
    """Words of each `select`, behind those that lead to it."""
    for entry in entries:
        match entry:
            case Select():
                for word, inner in entry.cases.items():
                    yield f"{path}{word}"
                    yield from _words(inner, f"{path}{word} ")
            case Group():
                yield from _words(entry.entries, path)
            case Either():
                yield from _words(entry.groups, path)


def _chosen(entries: Iterable[Entry], values: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Words that each `select` read, each with those that lead to it."""
    for entry in entries:
        value = values.get(entry.name)
        if value is None:
            continue
        match entry:
            case Select():
                for one in value if entry.repeated else (value,):
                    yield "", one.word
                    for path, word in _chosen(entry.cases[one.word], one.values):
                        yield f"{one.word} {path}", word
            case Group():
                for one in value if entry.repeated else (value,):
                    parts = (one,) if len(entry.entries) == 1 else one
                    named = zip((e.name for e in entry.entries), parts, strict=True)
                    yield from _chosen(entry.entries, dict(named))
            case Either() if isinstance(value, Chosen):
                taken = next(g for g in entry.groups if g.name == value.word)
                yield from _chosen(taken.entries, value.values)
