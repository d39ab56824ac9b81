"""Columns of the tables that the compiled laws read and write."""

from __future__ import annotations

# parameters (see Parameter)
KN, KS1, KS2, FU, GF, FC, FROT, SHEAR = range(8)
# state of a point: largest irreversible opening, slips, share of shear stiffness lost, stored
# shear energy, energy lost in shear
XI, SLIP1, SLIP2, DAMAGE, SHEAR_ENERGY, SHEAR_LOSS = range(6)
N_STATE = 6
