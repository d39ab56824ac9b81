"""How one curve is drawn, from the words of DESS's table ('TIRR MARQ S PLEIN ROND REGU')."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.errors import OutputError
from ssilang.remembered import tables_of


def _tuples(value: Any) -> Any:
    """As matplotlib takes it."""
    return tuple(map(_tuples, value)) if isinstance(value, list) else value


_TABLES = tables_of(Path(__file__).with_suffix(".toml"))
DASHES: dict[str, object] = {word: _tuples(dash) for word, dash in _TABLES["dashes"].items()}
MARKERS: dict[str, object] = {word: _tuples(shape) for word, shape in _TABLES["markers"].items()}


@dataclass(frozen=True)
class LineStyle:
    """Style of one curve: dash, marker, fill, label."""

    line: bool = True
    dash: object = "-"
    marker: object = None
    marker_size: float = 5.5
    solid: bool = False  # marker filled
    few_markers: bool = False  # six markers, evenly spaced
    fill: bool = False
    fill_white: bool = False
    label: str = ""
    unread: tuple[str, ...] = ()  # words that say nothing of a style


def parse_style(text: str) -> LineStyle:
    """The style that a string of DESS's table describes.

    Raises
    ------
    OutputError
        For a marker that there is not.
    """
    words, unread = text.split(), []
    chosen: dict[str, object] = {}
    while words:
        word = words.pop(0).upper()
        if word in _SIMPLE:
            chosen |= _SIMPLE[word]
        elif word in DASHES:
            chosen["dash"] = DASHES[word]
        elif word == "LABEL" or word == "LABE":
            chosen["label"] = words.pop(0) if words else ""
        elif word == "MARQ":
            chosen |= _marker(words)
        else:
            unread.append(word)
    return LineStyle(**chosen, unread=tuple(unread))  # type: ignore[arg-type]


_SIMPLE: dict[str, dict[str, object]] = {
    "NOLI": {"line": False},
    "REMP": {"fill": True},
    "BLAN": {"fill_white": True},
    "REGU": {"few_markers": True},
}
LINE_OPTIONS = (*_SIMPLE, *DASHES, "LABEL", "MARQ")


def _marker(words: list[str]) -> dict[str, object]:
    chosen: dict[str, object] = {}
    while words:
        word = words.pop(0).upper()
        if word in _TABLES["sizes"]:
            chosen["marker_size"] = _TABLES["sizes"][word]
        elif word[:4] == "PLEI":
            chosen["solid"] = True
        elif (marker := (MARKERS | _TABLES["older"]).get(word[:4])) is not None:
            return chosen | {"marker": marker}
        else:
            raise OutputError("io.no-marker", word=word, markers=MARKERS)
    raise OutputError("io.marq-no-marker", markers=MARKERS)


@dataclass(frozen=True)
class Line:
    """One curve ready to draw."""

    number: int
    x: np.ndarray[Any, np.dtype[np.float64]]
    y: np.ndarray[Any, np.dtype[np.float64]]
    colour: str
    name: str
    style: LineStyle
    width: float
    codes: Any = None
    kind: str = ""
