"""Parameters of the joint laws: defaults, admissibility."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.laws.columns import Parameter

DEFAULTS: dict[str, float] = {"FROT": -1.0, "ETA": 1.0, "BETA": 0.5}
"""What laws take for the parameters that are not given, if not 0: a joint without tension, the
plainest hysteresis."""

HARD_AREA = 0.1
"""Share of the area of each place under a footing that its hard spots take (PDUR)."""


def check_macro_parameters(parameters: FloatArray) -> None:
    """Refuse a macro-element without stiffness or size.

    Raises
    ------
    MaterialError
        Naming the parameter.
    """
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite")
    columns = {p.name: parameters[:, p] for p in Parameter}
    refuse(columns["KN"] <= 0, columns["KN"], "KN", "> 0")
    for name in ("LARG", "LONG", "RAYO"):
        refuse(columns[name] < 0, columns[name], name, "> 0")
    for name in ("COHE", "QULT"):
        refuse(columns[name] < 0, columns[name], name, ">= 0")
    spots = columns["PDUR"]
    even = (spots == 0) | ((spots > HARD_AREA) & (spots < 1))
    refuse(~even, spots, "PDUR", f"0, {HARD_AREA} < ... < 1")
    strong = columns["COHE"] == 0.0
    for name, idle in (("QULT", 0.0), ("FROT", -1.0), ("PDUR", 0.0)):
        if (strong & (columns[name] > idle)).any():
            raise MaterialError("kernel.interface.macro-needs-cohe", name=name)


def refuse(wrong: np.ndarray, values: FloatArray, name: str, wanted: str) -> None:
    """Refuse the first value of a parameter that is `wrong`: it must be as `wanted`."""
    if wrong.any():
        raise MaterialError(
            "kernel.interface.joint-parameter-must",
            name=name,
            values=values[wrong][0],
            wanted=wanted,
        )
