"""Models: which element and which law stand on which cells (MMODEL)."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from numpy.typing import NDArray

from ssilang.kernel.fields.cell_field import CellFieldBlock, Support
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, same_cells


class Mode(Enum):
    """Kinematic hypothesis of a calculation (OPTI 'MODE')."""

    PLANE_STRAIN = "PLAN DEFO"
    PLANE_STRESS = "PLAN CONT"
    GENERALISED_PLANE_STRAIN = "PLAN GENE"
    AXISYMMETRIC = "AXIS"
    FOURIER = "FOUR"
    THREE_DIMENSIONAL = "TRID"
    UNIDIMENSIONAL = "UNID PLAN DYDZ"

    @property
    def dimension(self) -> int:
        """Number of coordinates that a point has."""
        return {"TRID": 3, "UNID": 1}.get(self.value[:4], 2)


@dataclass(frozen=True, eq=False)
class Zone:
    """One block of cells with its element and law.

    Parameters
    ----------
    formulation : str
        'MECANIQUE' here; other formulations are refused when the model is made.
    behaviour : tuple of str
        Words of the law, such as ('ELASTIQUE', 'ISOTROPE') or ('ELASTIQUE', 'JOINT_SDM').
    element : str
        Finite element: 'QUA4', 'BARR', 'POUT', 'TIMO', 'JOI1', 'JOI2' ...
    mode : Mode
        Hypothesis in force when the model was made.
    """

    cells: CellBlock
    formulation: str
    behaviour: tuple[str, ...]
    element: str
    mode: Mode
    constituent: str = ""
    options: dict[str, object] = field(default_factory=dict)

    def block(
        self, components: Mapping[str, NDArray[Any]], support: Support = "STRESSES"
    ) -> CellFieldBlock:
        """Values of a field on the zone."""
        return CellFieldBlock(self.cells, components, support, self.element, self.constituent)


def same_elements(a: Zone | None, b: Zone) -> bool:
    """Whether two zones are the same element on the same cells, of whatever law."""
    return a is not None and a.element == b.element and same_cells(a.cells, b.cells)


@dataclass(frozen=True, eq=False)
class Model:
    """Zones, in the order in which they were joined by ET.

    Parameters
    ----------
    ties : tuple of CellBlock
        SURE cells of a mesh refined by parts: nodes that hang on coarser cells (read by RELA).
    """

    zones: tuple[Zone, ...]
    ties: tuple[CellBlock, ...] = ()

    @property
    def mesh(self) -> Mesh:
        """The mesh of all zones, each block once."""
        seen: dict[int, CellBlock] = {id(z.cells): z.cells for z in self.zones}
        blocks = tuple(seen.values())
        return Mesh(blocks[0].nodes, blocks)
