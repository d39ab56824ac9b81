"""Fields given in cells (MCHAML): values at nodes or integration points of each cell."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from numpy.typing import NDArray

from ssilang.kernel.mesh.mesh import CellBlock

# where in the cell the values stand (Cast3M: supports 1 to 5)
Support = Literal["NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES"]


@dataclass(frozen=True, eq=False)
class CellFieldBlock:
    """Values over one block of cells.

    Parameters
    ----------
    components : mapping of str to array (n_cells, n_points)
        `n_points` is 1 for a value constant in the cell. Floats, or objects (curves, points) for
        parameters that depend on a field or give a direction.
    element : str
        Name of the finite element whose integration points carry the values ('' at nodes).
    constituent : str
        Cast3M's constituent of the model zone, '' if none.
    """

    cells: CellBlock
    components: Mapping[str, NDArray[Any]]
    support: Support = "NOEUD"
    element: str = ""
    constituent: str = ""


@dataclass(frozen=True, eq=False)
class CellField:
    """A field in cells: blocks, each over one block of cells.

    `title` is Cast3M's sub-type: 'SCALAIRE', 'CONTRAINTES', 'DEFORMATIONS', 'CARACTERISTIQUES',
    'VARIABLES INTERNES' ...
    """

    blocks: tuple[CellFieldBlock, ...]
    title: str = ""
