"""SENS: senses of contours, differences of fields."""

from ssilang.kernel.fields.cell_algebra import added, component_names
from ssilang.kernel.mesh.queries.measure import signed_area
from ssilang.operators.prelude import *


@operator("SENS", family="fields")
def sens(call: Call, contours: Table = Arg("TABLE", en="closed contours by number")) -> Table:
    """Senses of contours."""
    made = Table()
    for number, contour in contours.items():
        if not isinstance(number, int):
            continue
        if not isinstance(contour, Mesh):
            raise call.error("operators.fields.not-a-contour", contours, number=number)
        area = signed_area(contour)
        if area == 0.0:
            raise call.error("operators.fields.contour-without-area", contours, number=number)
        made.set(number, 1 if area > 0.0 else -1)
    return made


@sens.form()
def sens_of_fields(
    call: Call,
    first: CellField = Arg("MCHAML", en="field of one component"),
    second: CellField = Arg("MCHAML", en="field to take from it"),
) -> Table:
    """Means of differences, cell by cell."""
    names = component_names(first)
    if len(names) != 1 or component_names(second) != names:
        raise call.error("operators.fields.one-component-compared", second)
    means: list[float] = []
    for block in added(first, second, -1.0).blocks:
        one = block.components[names[0]]
        values = np.broadcast_to(one, (len(block.cells), one.shape[1]))
        means += values.astype(float).mean(axis=1).tolist()
    return Table.numbered(means)
