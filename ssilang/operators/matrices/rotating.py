"""KENT CORI GYRO: matrices of turning bodies."""

from ssilang.kernel.elements.beams.rotating import gyroscopic, inertia_coupling
from ssilang.kernel.elements.solids.kinematics import cross_matrix
from ssilang.operators.matrices.element import MODEL, PARAMETERS, joined, present
from ssilang.operators.prelude import *

_VECTOR = opt("vector", "POINT", en="rotation vector", unit="rad/s", usual=NOT_ZERO)


@operator("KENT", family="matrix")
def kent(
    call: Call,
    what: str | None = Choice(
        ("CENTRIFUGE", "EULER"), en="for the rotation vector, or for its rate"
    ),
    model: Model = MODEL,
    fields: tuple[CellField, ...] = PARAMETERS,
    vector: Point | None = _VECTOR,
) -> Matrix:
    """Turning frame."""
    if what is None:
        raise call.error("operators.matrices.which-stiffness")
    shown, material = present(call, model), joined(fields)
    W = cross_matrix(_rotation(call, shown, vector))
    coupling = W @ W if what == "CENTRIFUGE" else W
    blocks = tuple(inertia_coupling(z, material, coupling) for z in shown.zones)
    return Matrix(shown.mesh.nodes, blocks, (), "RIGIDITE")


def _rotation(call: Call, model: Model, given: Point | None) -> FloatArray:
    """Rotation vector (3,); in bodies of revolution along the radius, circumference and axis."""
    turning = any(z.mode in (Mode.AXISYMMETRIC, Mode.FOURIER) for z in model.zones)
    if turning:
        return np.array([0.0, 0.0, 1.0 if given is None else float(given.coordinates[1])])
    if given is None:
        raise call.missing(("POINT",))
    if len(given.coordinates) == 2:
        raise call.error("operators.matrices.rotation-vector-in-space")
    return np.array(given.coordinates, dtype=float)


@operator("CORI", family="matrix", full_name="CORIOLIS")
def cori(
    call: Call,
    harmonic: bool = Flag("HARM", en="not available"),
    model: Model = MODEL,
    fields: tuple[CellField, ...] = PARAMETERS,
    vector: Point | None = _VECTOR,
) -> Matrix:
    """Coriolis' damping."""
    if harmonic:
        raise call.error("operators.matrices.harm-not-available")
    shown, material, kind = present(call, model), joined(fields), "AMORTISSEMENT"
    coupling = 2.0 * cross_matrix(_rotation(call, shown, vector))
    blocks = tuple(inertia_coupling(z, material, coupling, kind) for z in shown.zones)
    return Matrix(shown.mesh.nodes, blocks, (), kind)


@operator("GYRO", family="matrix", full_name="GYROSCOPIQUE")
def gyro(call: Call, model: Model = MODEL, fields: tuple[CellField, ...] = PARAMETERS) -> Matrix:
    """Turning beams."""
    shown, material = present(call, model), joined(fields)
    if not any("OMEG" in b.components for b in material.blocks):
        call.warn("operators.matrices.speed-of-rotation-missing")
    blocks = tuple(gyroscopic(z, material) for z in shown.zones)
    return Matrix(shown.mesh.nodes, blocks, (), "AMORTISSEMENT")
