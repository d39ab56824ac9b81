"""What the shells share: nodes that move and turn, strains and stresses with fixed names."""

from __future__ import annotations

from typing import ClassVar

from ssilang.kernel.elements.family import ElementFamily, Layout, node_major_layout
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.materials.model import Zone


class ShellFamily(ElementFamily):
    """Shell whose nodes carry translations and rotations.

    Attributes
    ----------
    strains, stresses : tuple of str
        Names of the components, in the order of the strain operator's rows.
    """

    strains: ClassVar[tuple[str, ...]]
    stresses: ClassVar[tuple[str, ...]]

    def layout(self, zone: Zone) -> Layout:
        """Translations then rotations, node by node."""
        return node_major_layout(zone, NODE_TRANSLATIONS[zone.mode] + NODE_ROTATIONS[zone.mode])

    def strain_names(self, zone: Zone) -> tuple[str, ...]:
        """Strains and curvatures, or strains of the points across."""
        return self.strains

    def stress_names(self, zone: Zone) -> tuple[str, ...]:
        """Forces and moments per length, or stresses of the points across."""
        return self.stresses
