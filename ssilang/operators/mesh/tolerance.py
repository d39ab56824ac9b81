"""How near points count as being at one place."""

from ssilang.operators.prelude import *

DISTANCE = opt(
    "distance",
    "FLOTTANT",
    en="how far off still counts, a tenth of the density by default",
    unit="m",
    range=NOT_NEGATIVE,
)


def tolerance_of(ws: Workspace, given: float | None, positions: FloatArray) -> float:
    """The given distance, else a tenth of the density, else a hair of the extent."""
    if given is not None:
        return given
    if ws.density > 0.0:
        return 0.1 * ws.density
    return 1e-9 * float(np.ptp(positions, axis=0).max(initial=0.0))


# Forms that are meant in the plane, or in space.

IN_PLANE = When(lambda s: workspace(s).dimension < 3, "in the plane")
IN_SPACE = When(lambda s: workspace(s).dimension == 3, "in space")
