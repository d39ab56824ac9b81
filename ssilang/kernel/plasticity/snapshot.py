"""A saved instant with the state of the plastic bodies."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.plasticity.bulk import Bulk, State
from ssilang.kernel.stepping.snapshot import Snapshot

NOTHING = np.zeros(0)


@dataclass(frozen=True, eq=False)
class BulkSnapshot(Snapshot):
    """State at one instant, the bodies' included: their fields come with those of the joints."""

    bulk: Bulk
    bulk_state: State

    @property
    def body_stresses(self) -> CellField:
        """Stresses of the plastic bodies alone."""
        return CellField(tuple(self.bulk.stresses(self.bulk_state)), "CONTRAINTES")

    @property
    def joint_tractions(self) -> CellField:
        """Tractions of the joints alone."""
        return super().tractions

    @property
    def tractions(self) -> CellField:
        """Stresses of the plastic bodies and tractions of the joints."""
        blocks = self.bulk.stresses(self.bulk_state)
        return CellField((*blocks, *super().tractions.blocks), "CONTRAINTES")

    @property
    def variables(self) -> CellField:
        """Internal variables of bodies and joints."""
        blocks = self.bulk.variables(self.bulk_state)
        return CellField((*blocks, *super().variables.blocks), "VARIABLES INTERNES")

    @property
    def plastic_strains(self) -> CellField:
        """Plastic strains of the bodies and plastic jumps of the joints."""
        blocks = self.bulk.plastic_strains(self.bulk_state)
        joints = super().plastic_strains.blocks
        return CellField((*blocks, *joints), "DEFORMATIONS INELASTIQUES")
