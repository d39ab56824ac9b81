"""Values that no calculation can use: numbers that are not finite, curves without content."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.curves.curve import Curve, Load
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.language.values import ListReel


def flaw_of(value: object) -> str:
    """Code of the refusal of a value, '' if it is sound."""
    if isinstance(value, Curve) and not value.parts:
        return "entry-no-curve"
    if not all(np.isfinite(v).all() for v in _numbers_in(value)):
        return "entry-not-finite"
    return ""


def _numbers_in(value: object) -> list[Any]:
    """The numbers that an object holds, as arrays."""
    if isinstance(value, float):
        return [value]
    if isinstance(value, ListReel):
        return [np.asarray(value.values, dtype=float)]
    if isinstance(value, NodeField):
        return [p.values for p in value.components.values()]
    if isinstance(value, CellField):
        parts = (v for b in value.blocks for v in b.components.values())
        return [v for v in parts if v.dtype.kind == "f"]
    if isinstance(value, Matrix):
        return [b.values for b in value.blocks] + [r.coefficients for r in value.relations]
    if isinstance(value, Curve):
        return [a for p in value.parts for a in (p.abscissas, p.ordinates)]
    if isinstance(value, Load):
        held = [h for p in value.parts for h in (p.space, p.time, *(f for _, f in p.steps))]
        return [n for h in held for n in _numbers_in(h)]
    return []
