"""What a folder of results tells of itself, as declared here; anything else is refused.

The records (`summary.json`, `report/contents.json`) may have been written by anybody: what a page
reads of them has these kinds of values, or the record is not read at all. A name that ends with ?
may miss. Numbers are finite: what is none is null.
"""

import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

MOST_BYTES = 100_000_000
"""Of a record."""


class RecordError(ValueError):
    """A record that is not one: what is wrong, and where."""


@dataclass(frozen=True)
class Kind:
    """A kind of plain values by its name."""

    name: str
    holds: Callable[[Any], bool]


@dataclass(frozen=True)
class Maybe:
    """What may be null."""

    kind: Any


@dataclass(frozen=True)
class Named:
    """A record of some of these names, all of one kind."""

    kind: Any
    names: frozenset[str]


def _is_number(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return math.isfinite(value) if isinstance(value, float) else abs(value) < 2**63


TEXT = Kind("text", lambda v: isinstance(v, str))
NUMBER = Kind("a number", _is_number)
COUNT = Kind("a count", lambda v: _is_number(v) and isinstance(v, int) and v >= 0)
TRUTH = Kind("true or false", lambda v: isinstance(v, bool))
PAIR = Kind(
    "two of true or false", lambda v: isinstance(v, list) and list(map(type, v)) == [bool] * 2
)


def _one_of(*names: str) -> Kind:
    return Kind(" or ".join(names), lambda v: isinstance(v, str) and v in names)


MESSAGE = {"line": Maybe(COUNT), "text": TEXT}
_PEAK = {"value": Maybe(NUMBER), "time": Maybe(NUMBER)}
VERDICT = {
    "area": Maybe(NUMBER), "capacity": Maybe(NUMBER), "friction": Maybe(NUMBER),
    "peaks": Named(_PEAK, frozenset({
        "PART", "PRESSION", "TAUX", "OUVERTURE", "MOMENT", "ROTATION", "ENFONCEMENT",
        "RENVERSEMENT", "GLISSEMENT",
    })),
    "left": Named(Maybe(NUMBER), frozenset({"ROTATION", "ENFONCEMENT"})),
    "floors": [{
        "floor": COUNT, "component": TEXT, "damping": TEXT, "acceleration": Maybe(NUMBER),
        "frequency": Maybe(NUMBER), "largest?": NUMBER,
        "frequencies?": [NUMBER], "accelerations?": [NUMBER],
    }],
}  # fmt: skip
SUMMARY = {
    "version": TEXT, "deck": TEXT, "deck_digest?": TEXT, "seconds": NUMBER, "exit_code?": NUMBER,
    "statements?": COUNT, "peak_memory_mb?": NUMBER, "files": [{"path": TEXT, "bytes": COUNT}],
    "figures": [{
        "name": TEXT, "value": Maybe(NUMBER), "expected": Maybe(NUMBER),
        "tolerance": Maybe(NUMBER), "ok": Maybe(TRUTH),
    }],
    "warnings": [MESSAGE], "errors": [MESSAGE], "units?": {"system": TEXT},
    "statistics": {
        "calculations?": [{
            "procedure?": TEXT, "unknowns?": NUMBER, "interface_unknowns?": NUMBER,
            "steps?": NUMBER, "method?": TEXT, "solver?": TEXT,
            "most_interface_iterations?": NUMBER, "energy_imbalance?": NUMBER, "seconds?": NUMBER,
            "motions?": [NUMBER],
        }],
        "verdicts?": [VERDICT],
    },
}  # fmt: skip
"""What a page reads of `summary.json` (`cli/summary.py` writes it)."""

FRAGILITY = {"limits": [TEXT], "intensities": [TEXT]}
"""What a sweep was asked for (`report/fragilities.py` writes it)."""

DRAWING = {
    "title": TEXT, "x": TEXT, "y": TEXT, "log": PAIR, "files": [TEXT], "loop?": TRUTH,
    "curves": [{"name": Maybe(TEXT), "x": [Maybe(NUMBER)], "y": [Maybe(NUMBER)]}],
}  # fmt: skip
CONTENTS = {
    "name?": TEXT, "text?": TEXT,
    "calculations": [{
        "procedure": TEXT, "table": TEXT, "scene": Maybe(TEXT), "whole": TRUTH,
        "footings": [{"kind": TEXT, "axes": [TEXT]}], "footings_left": COUNT,
        "largest": [{
            "kind": _one_of("OUVERTURE", "COMPRESSION", "CISAILLEMENT", "DEPL", "REACTIONS"),
            "component": TEXT, "value": Maybe(NUMBER), "time": Maybe(NUMBER), "place": [NUMBER],
        }],
    }],
    "drawings": [DRAWING],
    "shapes": [{"name": TEXT, "kind": TEXT, "scene": TEXT, "frequencies": [Maybe(NUMBER)]}],
    "verdicts?": [[DRAWING]], "left_out?": {"calculations": COUNT, "drawings": COUNT},
}  # fmt: skip
"""What a page reads of `report/contents.json` (`io/recording.py` writes it)."""


def read_record(path: Path, kind: Mapping[str, Any]) -> dict[str, Any]:
    """A record of a kind.

    Raises
    ------
    OSError, ValueError
        If it cannot be read.
    RecordError
        If it is no such record.
    """
    found = read_json(path, shown=True)
    _check(found, kind, "")
    return dict(found)


def read_json(path: Path, shown: bool = False) -> Any:
    """What a file of JSON holds that anybody may have written; `shown`: NaN is null.

    Raises
    ------
    OSError, ValueError
        If it cannot be read: what is too large, or nested too deep, too.
    """
    if path.stat().st_size > MOST_BYTES:
        raise RecordError(f"more than {MOST_BYTES // 10**6} MB")
    try:
        text = path.read_text(encoding="utf-8")
        found: Any = json.loads(text, parse_constant=(lambda _: None) if shown else None)
        if shown and "\\ud" in text.lower():  # halves of a character are in no page
            json.dumps(found, ensure_ascii=False).encode()
    except RecursionError:
        raise ValueError("brackets within brackets") from None
    return found


def _check(value: Any, kind: Any, place: str) -> None:
    """Hold a value to a kind; what may miss and is null is taken away."""
    match kind:
        case Maybe():
            if value is not None:
                _check(value, kind.kind, place)
        case Kind():
            if not kind.holds(value):
                raise RecordError(f"{place}: {_shown(value)} != {kind.name}")
        case [inner]:
            if not isinstance(value, list):
                raise RecordError(f"{place}: {_shown(value)} != []")
            for i, each in enumerate(value):
                _check(each, inner, f"{place}[{i}]")
        case _:
            if not isinstance(value, dict):
                raise RecordError(f"{place}: {_shown(value)} != {{}}".lstrip(": "))
            for name, inner in _parts(value, kind, place):
                _check(value[name], inner, f"{place}.{name}".lstrip("."))


def _parts(value: dict[str, Any], kind: Any, place: str) -> Iterator[tuple[str, Any]]:
    """Names of a record that are read, with their kinds."""
    if isinstance(kind, Named):
        for name in value:
            if name not in kind.names:
                raise RecordError(f"{place}: {name[:40]}")
            yield name, kind.kind
        return
    for told, inner in kind.items():
        name = told.removesuffix("?")
        if name == told and name not in value:
            raise RecordError(f"{place}.{name} = ?".lstrip("."))
        if name != told and value.get(name) is None:
            value.pop(name, None)
        else:
            yield name, inner


def _shown(value: Any) -> str:
    return repr(value)[:40] if isinstance(value, str | int | float | None) else type(value).__name__
