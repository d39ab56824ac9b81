"""Columns of the tables that the compiled laws read and write."""

from __future__ import annotations

# parameters (see Parameter)
KN, KS1, KS2, FU, GF, FC, FROT, SHEAR = range(8)
# state of a point: largest irreversible opening, slips, share of shear stiffness lost, stored
# shear energy, energy lost in shear; HELD: during a step's iteration, whether shear is transmitted
# (CLOSED_SHEAR) or not (OPEN_SHEAR) whatever the normal traction; 0 between steps
XI, SLIP1, SLIP2, DAMAGE, SHEAR_ENERGY, SHEAR_LOSS, HELD = range(7)
N_STATE = 7
CLOSED_SHEAR, OPEN_SHEAR = 1.0, 2.0
