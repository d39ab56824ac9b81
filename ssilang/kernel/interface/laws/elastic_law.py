"""The bonded joint: t = diag(KS1, KS2, KN) w, no state."""

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import clear, copy_state
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.law import Law


@compiled
def elastic_point(
    code: int, w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray,
    D: FloatArray,
) -> None:  # fmt: skip
    """Traction and tangent of one point, written in place."""
    n = w.shape[0] - 1
    clear(D)
    copy_state(state, new)
    for i in range(n):
        D[i, i] = p[Par.KS1 + i]
        t[i] = p[Par.KS1 + i] * w[i]
    D[n, n] = p[Par.KN]
    t[n] = p[Par.KN] * w[n]


@compiled
def elastic_energy(
    code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray
) -> float:
    """Stored energy of one point, per unit area."""
    stored = 0.0
    for i in range(w.shape[0]):
        stored += 0.5 * w[i] * t[i]
    return stored


LAWS = {
    "ELASTIQUE": Law(LawCode.ELASTIC, elastic_point, elastic_energy, ("KN", "KS"), linear=True),
}
