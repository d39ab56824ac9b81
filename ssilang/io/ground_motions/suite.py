"""What the motions of a suite do not have in common: their units, the size of their numbers."""

import re
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError
from ssilang.io.ground_motions.formats import read_cosmos, read_esm, read_peer, read_titled
from ssilang.io.ground_motions.record import GroundMotion, plain_unit

_APART = 5.0
"""Ratio of neighbouring peaks, in order of size, that a suite of one unit hardly has."""


def motion_in(path: Path) -> GroundMotion | None:
    """The first motion of a file in any of the formats that are read, None if it is in none."""
    for read in (read_peer, read_esm, read_cosmos, read_titled):
        with suppress(InputError):
            found = read(path)
            return found if isinstance(found, GroundMotion) else found[0]
    return None


def units_named(motions: Mapping[str, GroundMotion]) -> dict[str, str]:
    """Unit of each motion that names one, by its name; none where all name the same."""
    named = {n: plain_unit(m.unit) for n, m in motions.items() if m.has_unit}
    return named if len(set(named.values())) > 1 else {}


_UPWARDS = re.compile(
    r"(?<![A-Z])(UP|UD|DOWN|DWN|VERT|VERTICAL|HNZ|HGZ|HLZ)$|[-_](V|Z)$", re.IGNORECASE
)
"""How the name of a file, or what it says of itself, ends of a component along the vertical."""


def vertical(motions: Mapping[str, GroundMotion]) -> list[str]:
    """Names of the motions along the vertical."""
    ends = {n: (n.rpartition(".")[0] or n, m.event) for n, m in motions.items()}
    return [n for n, said in ends.items() if any(_UPWARDS.search(s.strip()) for s in said)]


def peaks_apart(motions: Mapping[str, GroundMotion], in_si: bool) -> dict[str, float]:
    """Peaks of the motions that stand apart from the most, by name; as the script has them.

    Parameters
    ----------
    in_si : bool
        Whether the script reads them in SI: those that name a unit are converted.
    """
    peaks = {
        n: float(np.abs(m.values).max()) * (m.in_si if in_si else 1) for n, m in motions.items()
    }
    names = sorted((n for n in peaks if peaks[n] > 0.0), key=peaks.__getitem__)
    if len(names) < 3:  # two say nothing of what is usual
        return {}
    order = np.array([peaks[n] for n in names])
    steps = order[1:] / order[:-1]
    at = int(np.argmax(steps)) + 1
    fewer = names[at:] if len(names) - at <= at else names[:at]
    return {n: peaks[n] for n in fewer} if steps[at - 1] >= _APART else {}
