"""FORM: the coordinates of all nodes, moved by a field and brought back."""

from ssilang.kernel.elements.results.frames import following_axes
from ssilang.kernel.fields.deformed import displacements
from ssilang.operators.prelude import *


@dataclass(frozen=True, eq=False)
class Configuration:
    """Coordinates of all nodes at one time (CONFIGURATION), shape (n, 3)."""

    coordinates: FloatArray

    def moved(self, field: NodeField) -> "Configuration":
        """Where these nodes are once a field of displacements has moved them."""
        moves = displacements(field)[: len(self.coordinates)]
        return Configuration(self.coordinates + moves)


@operator(
    "FORM",
    gives=by("model", {None: "CONFIGUR"}, ("CONFIGUR", "MCHAML")),
    family="mesh",
    full_name="FORME",
)
def form(
    call: Call,
    start: Configuration | None = Opt("CONFIGUR", en="coordinates to begin with"),
    field: NodeField | None = Opt("CHPOINT", en="displacements", unit="m"),
    model: Model | None = Opt("MMODEL", en="model of the parameters"),
    material: CellField | None = Opt("MCHAML", en="parameters whose local axes follow"),
) -> Configuration | tuple[Configuration, CellField]:
    """Move the nodes."""
    nodes = workspace(call.session).nodes
    if (model is None) != (material is None):
        raise call.missing(("MMODEL",) if model is None else ("MCHAML",))
    if model is not None and field is None:
        raise call.missing(("CHPOINT",))
    if start is not None:
        nodes.coordinates[: len(start.coordinates)] = start.coordinates
    if field is not None:
        ids = field.node_ids
        nodes.coordinates[ids] += displacements(field, ids)
    made = Configuration(nodes.coordinates.copy())
    if model is None or material is None or field is None:
        return made
    return made, following_axes(model, material, field)
