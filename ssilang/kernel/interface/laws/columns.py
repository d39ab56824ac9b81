"""Columns of the tables that the compiled laws read and write."""

from __future__ import annotations

# parameters (see Parameter)
KN, KS1, KS2, FU, GF, FC, FROT, SHEAR, TPHI, TPSI, COHE, FTRC, EF, ECN, FNE, QT = range(16)
LARG, LONG, RAYO, SYMMETRIC = range(16, 20)
# state of a point: largest irreversible opening, slips, share of shear stiffness lost, stored
# shear energy, energy lost in shear; HELD: during a step's iteration, whether shear is transmitted
# (CLOSED_SHEAR) or not (OPEN_SHEAR) whatever the normal traction; 0 between steps
# Mohr-Coulomb joints: XI plastic normal jump, DAMAGE plastic compression, STATUS (0 untouched,
# 1 open, 2 in contact), OPENING of an open point, CUMULATED plastic jump
XI, SLIP1, SLIP2, DAMAGE, SHEAR_ENERGY, SHEAR_LOSS, HELD, STATUS, OPENING, CUMULATED = range(10)
N_STATE = 10
CLOSED_SHEAR, OPEN_SHEAR = 1.0, 2.0
