"""DFOU: fields of a Fourier harmonic at an angle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ssilang.operators.prelude import *

_ODD = {
    "UT", "FT", "SMRT", "SMZT", "GART", "GAZT", "EPRT", "EPZT", "GAST", "RTST", "NSST", "MSST",
    "NST", "MST", "RR", "RZ", "MR", "MZ",
}  # fmt: skip
"""Components that go with the sine of a symmetric harmonic; the others go with the cosine."""


@operator(
    "DFOU",
    arg("field", "CHPOINT", "MCHAML", en="field of a harmonic"),
    arg("angle", "FLOTTANT", en="angle", unit="deg", range=ANY_NUMBER),
    gives=Like("field"),
    family="fields",
    full_name="DFOURIER",
)
def dfou(call: Call, field: NodeField | CellField, angle: float) -> NodeField | CellField:
    """Sum a harmonic."""
    n = workspace(call.session).fourier
    turn = np.radians(abs(n) * angle)
    even, odd = (np.cos(turn), np.sin(turn)) if n >= 0 else (np.sin(turn), np.cos(turn))
    if n == 0:
        odd = 1.0  # harmonic 0: uniform stretching and uniform torsion, uncoupled

    def factor(name: str) -> float:
        return float(odd if name in _ODD else even)

    if isinstance(field, NodeField):
        made = {k: NodeValues(v.nodes, factor(k) * v.values) for k, v in field.components.items()}
        return replace(field, components=made)
    blocks = tuple(
        replace(b, components={k: factor(k) * v for k, v in b.components.items()})
        for b in field.blocks
    )
    return replace(field, blocks=blocks)
