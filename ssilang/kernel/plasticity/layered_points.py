"""Plastic shells with points across: thin ones DKT (INTEGRE) and thick ones COQ6 and COQ8.

Across thin ones stand points of Gauss at each surface point: strains follow the membrane strain and
the curvature; each layer is in plane stress. Results are the section's forces and moments, the
layers' stresses stand among the internal variables.
"""

from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.shells.shell_section import SHEAR_FACTOR
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.materials.plastic.laws import plastic_law
from ssilang.kernel.plasticity.points import Fields, PlasticPoints, PointState, law_parameters

OPTION = "INTEGRE"
COMPONENTS = (0, 1, 3)
"""XX YY XY of the tensor, in the shell's own frame."""
HELD = (2, 4, 5)
STRESSES = ("SMSS", "SMTT", "SMST")
THICK = (0, 1, 3, 4, 5)
"""SS TT ST SN TN of thick shells in the tensor."""
ROOTS = np.sqrt(np.where(np.arange(6) < 4, 1.0, SHEAR_FACTOR))


def is_layered(zone: Zone) -> bool:
    """Whether a zone is one of thin shells with points across the thickness."""
    return zone.element == "DKT" and OPTION in zone.options


@dataclass(frozen=True, eq=False)
class LayeredPoints(PlasticPoints):
    """Points (n_cells, n_points * n_layers), the layers of one point together.

    Attributes
    ----------
    heights : array (n_cells, n_points * n_layers)
        Distance from the middle surface along the normal.
    shares : array (n_cells, n_points * n_layers)
        Part of the thickness that a layer stands for.
    """

    heights: FloatArray
    shares: FloatArray
    n_layers: int

    def spread(self, own: FloatArray) -> FloatArray:
        """Strains of layers (n, 3, points), or strains and curvatures (n, 6, ...), as tensors."""
        if own.shape[1] == 6:
            repeated = np.repeat(own, self.weights.shape[1] // own.shape[2], axis=2)
            own = repeated[:, :3] + self.heights[:, None] * repeated[:, 3:]
        return super().spread(own)

    def stress_block(self, state: PointState) -> CellFieldBlock:
        """Forces and moments per length."""
        layers = self.gathered(state.stress) * self.shares[:, None]
        n, _, p = layers.shape
        parts = [layers, layers * self.heights[:, None]]
        shape = (n, 3, p // self.n_layers, self.n_layers)
        sums = np.concatenate([part.reshape(shape).sum(axis=3) for part in parts], axis=1)
        return cell_block(self.zone, family_of(self.zone).stress_names(self.zone), sums)

    def variable_block(self, state: PointState) -> CellFieldBlock:
        """Internal variables of the layers, and their stresses."""
        block = super().variable_block(state)
        own = self.gathered(state.stress)
        stresses = {name: own[:, i].copy() for i, name in enumerate(STRESSES)}
        return replace(block, components={**block.components, **stresses})

    def plastic_block(self, state: PointState) -> CellFieldBlock | None:
        """None: the strains that stay are those of the layers."""
        return None

    def restored(self, blank: PointState, given: Fields) -> tuple[PointState, bool]:
        """The state of the layers from the internal variables."""
        seen = zone_field(self.zone, given[1])
        if STRESSES[0] not in seen:
            return blank, False
        shape = self.weights.shape
        found = [np.broadcast_to(seen.raw(n)[0], shape) for n in (*STRESSES, *self.law.variables)]
        layers, kept = np.stack(found[:3], axis=1), np.stack(found[3:], axis=-1)
        stress_now = self.spread(layers)
        return replace(blank, stress=stress_now, variables=kept.reshape(self.count, -1)), True


class ThickPoints(PlasticPoints):
    """Both points across of COQ6 and COQ8: no stress across, shear as that of the elastic element.

    B has the root of the shear's factor: force and stiffness have the factor then, as the stresses
    of fields; the law sees the root of it.
    """

    @property
    def roots(self) -> FloatArray:
        """Those of the shear's factor."""
        return ROOTS


def layered_points(zone: Zone, characteristics: CellField) -> LayeredPoints:
    """The layers of all cells of a zone.

    Raises
    ------
    MaterialError
        For missing or inadmissible parameters, and a law that is not von Mises'.
    """
    law, family = plastic_law(zone.behaviour), family_of(zone)
    assert law is not None
    given = zone_field(zone, characteristics)
    operator = family.strain_operator(zone, given, "STRESSES", slice(None))
    n, _, p, _ = operator.matrix.shape
    count = zone.options[OPTION]
    assert isinstance(count, int)
    x, w = np.polynomial.legendre.leggauss(count)
    h = np.broadcast_to(given.at("EPAI", "STRESSES"), (n, p))[..., None]
    if (h <= 0).any():
        raise MaterialError("kernel.plasticity.epai-must", h_min=h.min())
    heights, shares = (0.5 * h * x).reshape(n, -1), (0.5 * h * w).reshape(n, -1)
    repeated = np.repeat(operator.matrix, count, axis=2)
    B = repeated[:, :3] + heights[:, None, :, None] * repeated[:, 3:]
    weights = np.repeat(np.broadcast_to(operator.weights, (n, p)), count, axis=1) * shares
    parameters = law_parameters(zone, law, given).at(np.repeat(np.arange(n * p), count))
    return LayeredPoints(
        zone, law, family.layout(zone), B, weights, None, COMPONENTS, HELD, parameters,
        heights, shares, count,
    )  # fmt: skip
