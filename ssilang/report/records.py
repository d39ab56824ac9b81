"""What a folder of results tells of itself, as `records.toml` declares it.

The records (`summary.json`, `report/contents.json`) may have been written by anybody: what a page
reads of them has the kinds of values declared there, or the record is not read at all. Numbers are
finite: what is none is null.
"""

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from ssilang.remembered import tables_of

MOST_BYTES = 100_000_000
"""Of a record."""


class RecordError(ValueError):
    """A record that is not one: what is wrong, and where."""


def _is_number(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return math.isfinite(value) if isinstance(value, float) else abs(value) < 2**63


_KINDS: dict[str, Callable[[Any], bool]] = {
    "text": lambda v: isinstance(v, str),
    "a number": _is_number,
    "a count": lambda v: _is_number(v) and isinstance(v, int) and v >= 0,
    "true or false": lambda v: isinstance(v, bool),
    "two of true or false": lambda v: isinstance(v, list) and list(map(type, v)) == [bool] * 2,
}


def kinds() -> dict[str, Any]:
    """What records hold, by what they are called in `records.toml`."""
    return tables_of(Path(__file__).with_suffix(".toml"))  # type: ignore[no-any-return]


def read_record(path: Path, kind: str) -> dict[str, Any]:
    """A record of a kind: 'summary', 'contents' or 'fragility'.

    Raises
    ------
    OSError, ValueError
        If it cannot be read.
    RecordError
        If it is no such record.
    """
    found = read_json(path, shown=True)
    _check(found, kinds()[kind], "")
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
        case str():
            _check_plain(value, kind.removesuffix("?"), kind[-1] == "?", place)
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


def _check_plain(value: Any, kind: str, optional: bool, place: str) -> None:
    if kind[0] == "@":
        _check(value, kinds()[kind[1:]], place)
    elif value is not None or not optional:
        one_of = kind.split(" or ")
        holds = _KINDS.get(kind, lambda v: isinstance(v, str) and v in one_of)
        if not holds(value):
            raise RecordError(f"{place}: {_shown(value)} != {kind}")


def _parts(value: dict[str, Any], kind: Any, place: str) -> Iterator[tuple[str, Any]]:
    """Names of a record that are read, with their kinds."""
    if "only" in kind:
        for name in value:
            if name not in kind["only"]:
                raise RecordError(f"{place}: {name[:40]}")
            yield name, kind["each"]
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
