"""Initial stresses of PASAPAS that displacements do not explain; matrices of linear zones."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices
from ssilang.kernel.modal.shape_models import is_shape, shape_matrix
from ssilang.operators.statics.pasapas_results import Stresses

NEGLIGIBLE = 1e-12  # of the largest stress: rounding of a calculation that goes on

Zones = list[tuple[Zone, CellField]]


def stress_offsets(
    zones: Zones, stresses: Stresses, given: CellField, displacement: object, time: float
) -> dict[int, CellFieldBlock]:
    """Given stresses less those of the displacement, by identity of the zone."""
    found: dict[int, CellFieldBlock] = {}
    for zone, material in zones:
        seen = zone_field(zone, given)
        names = family_of(zone).stress_names(zone)
        if not any(n in seen for n in names):
            continue
        field = displacement if isinstance(displacement, NodeField) else _nothing(zone)
        now = Stresses([(zone, material)], stresses.thermal).at(field, time)[0]
        rest = {
            n: np.broadcast_to(seen.at(n, "STRESSES", 0.0), now.components[n].shape)
            - now.components[n]
            for n in names
        }
        size = max(float(np.abs(now.components[n]).max(initial=0.0)) for n in names)
        left = max(float(np.abs(v).max(initial=0.0)) for v in rest.values())
        if left > NEGLIGIBLE * max(size, left):
            found[id(zone)] = CellFieldBlock(
                now.cells, rest, now.support, now.element, now.constituent
            )
    return found


def _nothing(zone: Zone) -> NodeField:
    return NodeField(zone.cells.nodes, {})


def offset_load(offsets: dict[int, CellFieldBlock], zones: Zones) -> list[NodeField]:
    """Nodal forces that stand for the offsets, on the side of the loads."""
    forces: list[NodeField] = []
    for zone, material in zones:
        block = offsets.get(id(zone))
        if block is None:
            continue
        family = family_of(zone)
        names = family.stress_names(zone)
        values = -np.stack([block.components[n] for n in names], axis=1)
        vectors = family.force_vectors(zone, values, zone_field(zone, material))
        forces.append(family.layout(zone).scatter(vectors))
    return forces


def linear_blocks(
    zones: list[tuple[Zone, CellField]],
    kind: str,
    make: Callable[[Zone, CellField], ElementMatrices],
) -> list[ElementMatrices]:
    """What `make` gives for each zone, and one block for all MODAL and STATIQUE ones.

    Parameters
    ----------
    kind : str
        'RIGIDITE', 'MASSE' or 'AMORTISSEMENT'.
    """
    blocks = [make(z, m) for z, m in zones if not is_shape(z)]
    if any(is_shape(z) for z, _ in zones):
        shapes = shape_matrix(tuple(z for z, _ in zones), zones[0][1], kind)
        blocks += [] if shapes is None else [shapes]
    return blocks
