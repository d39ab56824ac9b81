"""Conditions between the parameters of a law, as data: what must hold, written as users read it."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.response import PointParameters


def require(law: str, p: PointParameters, rules: Mapping[str, NDArray[np.bool_]]) -> None:
    """Refuse parameters for which a rule does not hold at some point.

    Parameters
    ----------
    law : str
        Its word in MODE.
    rules : mapping of str to array (m,) of bool
        What must hold, such as 'STSY <= STSU', and where it does.

    Raises
    ------
    MaterialError
        With the rule, and the values at the first point where it fails of what it names.
    """
    for rule, holds in rules.items():
        if holds.all():
            continue
        at = int(np.flatnonzero(~holds)[0])
        words = "".join(c if c.isalnum() else " " for c in rule).split()
        names = tuple(n for n in dict.fromkeys(words) if n in p.values)
        given = tuple(f"{n} = {p[n][at]:g}" for n in names)
        raise MaterialError(
            "kernel.materials.law-condition", law=law, rule=rule, given=given
        ).about(*names)
