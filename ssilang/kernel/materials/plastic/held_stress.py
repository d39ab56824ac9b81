"""Laws under stresses that are held at zero: plane stress, bars.

The strains across the held directions are found by Newton, and condensed out of the tangent.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.materials.plastic.laws import PlasticLaw
from ssilang.kernel.materials.plastic.response import PointParameters, Response

TURNS = 60


def respond_held(
    law: PlasticLaw,
    parameters: PointParameters,
    stress: FloatArray,
    strain: FloatArray,
    variables: FloatArray,
    held: tuple[int, ...],
) -> tuple[Response, FloatArray]:
    """Response with zero stress in the components `held`, and the strain that it took (m, 6).

    The tangent (m, 6, 6) has zeros in the held rows and columns.
    """
    if not held:
        return law.respond(parameters, stress, strain, variables), strain
    h = np.array(held)
    whole = strain.copy()
    moduli = parameters.moduli
    whole[:, h] = 0.0
    free = np.setdiff1d(np.arange(6), h)
    ridge = 1e-12 * parameters["YOUN"][:, None, None] * np.eye(len(h))
    found = law.respond(parameters, stress, whole, variables)
    for turn in range(TURNS):
        rest = found.stress[:, h]
        block = (moduli if turn == 0 else found.tangent)[:, h[:, None], h[None, :]]
        rounding = 0.03 * np.abs(moduli @ whole[..., None])[..., 0]  # of where it returned from
        size = np.maximum(np.abs(found.stress), rounding).max(axis=1)
        if not (np.abs(rest).max(axis=1) > 1e-13 * size + 1e-300).any():  # NaN stays so
            break
        whole[:, h] -= np.linalg.solve(block + ridge, rest[..., None])[..., 0]
        found = law.respond(parameters, stress, whole, variables)
    tangent = np.zeros_like(found.tangent)
    cross = found.tangent[:, free[:, None], h[None, :]]
    back = found.tangent[:, h[:, None], free[None, :]]
    own = found.tangent[:, h[:, None], h[None, :]]
    reduced = found.tangent[:, free[:, None], free[None, :]]
    tangent[:, free[:, None], free[None, :]] = reduced - cross @ np.linalg.solve(own + ridge, back)
    final = found.stress.copy()
    final[:, h] = 0.0
    return Response(final, found.variables, tangent, found.elastic), whole
