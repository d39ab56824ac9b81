"""COUL of curves, deformed shapes and arrows."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ssilang.io.plots.palette import NAMES, index_of
from ssilang.operators.dispatch import COUL
from ssilang.operators.prelude import *


@COUL.form(
    main("value", "EVOLUTIO", "DEFORME", "VECTEUR", en="what is coloured"),
    opt(
        "given",
        "LISTMOTS",
        "ENTIER",
        "MOT",
        en="colour, its number, or one for each part",
        kind="colour",
        range=ANY_NUMBER,
    ),
    gives=Like("value"),
)
def _recolour(call: Call, value: Any, given: ListMots | int | str | None) -> Any:
    if given is None:
        colours = [workspace(call.session).colour] * len(value.parts)
    elif isinstance(given, ListMots):
        colours = [index_of(str(v)) for v in given.values]
        if len(colours) < len(value.parts):
            raise call.error(
                "operators.drawing.colour-count",
                given,
                n_colours=len(colours),
                n_parts=len(value.parts),
            )
    else:
        colours = [_colour(call, given)] * len(value.parts)
    parts = tuple(_coloured(p, c) for p, c in zip(value.parts, colours, strict=False))
    return replace(value, parts=parts)


def _coloured(part: Any, colour: int) -> Any:
    is_curve = isinstance(part, CurvePart)
    return part.coloured(colour) if is_curve else replace(part, colour=colour)


def _colour(call: Call, given: str | int) -> int:
    """Index of a colour given by name, or by its number from 1 (negative: the default)."""
    if isinstance(given, str):
        return index_of(given)
    if given > len(NAMES):
        raise call.error("operators.drawing.colour-number", given, count=len(NAMES), given=given)
    return max(given - 1, 0)
