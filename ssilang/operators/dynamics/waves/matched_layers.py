"""ZPML: matrices of a perfectly matched layer, behind the procedure @PML."""

from __future__ import annotations

from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

FEWEST = 4
"""Cells through the layer below which it reflects about as much as dampers."""


@operator("ZPML", arg("table", "TABLE", en="table of @PML"), family="dynamics")
def zpml(call: Call, table: Table) -> Table:
    """Read the table, hand back three matrices."""
    from ssilang.kernel.waves.matched_layer import matched_layer

    entries = Entries(call, table, "@PML")
    made = matched_layer(
        entries.needed("MODELE"), entries.needed("CARACTERISTIQUES"),
        entries.needed("INTERIEUR"), entries.get("REFLEXION"),
    )  # fmt: skip
    if made.cells < FEWEST - 1e-6:
        entries.warn("operators.dynamics.thin-layer", cells=made.cells, fewest=FEWEST)
    result = Table()
    for name, matrix in (("RIGI", made.stiffness), ("MASS", made.mass), ("AMOR", made.damping)):
        result.set(name, matrix)
    return result
