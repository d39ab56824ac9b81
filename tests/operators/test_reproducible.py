"""A run gives the same numbers to the last bit, however quick the machine is."""

from __future__ import annotations

from itertools import count

import numpy as np
import pytest

from ssilang.cli.run import run_text
from ssilang.kernel.stepping import run as stepping

BAR = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; NEL = {cells} ; PA = 0. 1.E-4 ; PW = 0. -1. ;
BAR0 = DROI NEL PA (0. 0.2) ; MOB = MODE BAR0 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
MAB = MATE MOB 'YOUN' 2.E11 'NU' 0. 'RHO' 8000. 'SECT' 4.E-4 ; JOI = MANU 'SEG2' PW PA ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ; MAJ = MATE MOJ 'KN' 8.E11 'KS' 0. ;
ONE = MANU 'CHPO' BAR0 1 'UY' 1. ; T = TABL ; T . 'DEPL' = 1.E-4 * ONE ; T . 'VITE' = -100. * ONE ;
T . 'RIGI' = (RIGI MOB MAB) ET (BLOQ 'UX' BAR0) ET (BLOQ 'UX' 'UY' PW) ; T . 'MASS' = MASS MOB MAB ;
T . 'MODELE' = MOJ ; T . 'CARACTERISTIQUES' = MAJ ; T . 'VITEUNIL' = FAUX ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' {dt} 'NPAS' {steps} ; T . 'PAS_SAUVES' = 5 ;
R = DYNAMIC T ; L = EXTR (EVOL 'TEMP' R 'DEPL' 'UY' PA) 'ORDO' ;
"""


class Clock:
    """A clock by which each look takes so long."""

    def __init__(self, seconds: float) -> None:
        self._looks, self._seconds = count(), seconds

    def perf_counter(self) -> float:
        return next(self._looks) * self._seconds


@pytest.mark.parametrize(("cells", "steps"), [(300, 2000), (2, 20000)])
def test_the_clock_changes_no_bit(cells, steps, tmp_path, monkeypatch):
    found = []
    text = BAR.format(cells=cells, steps=steps, dt=2e-8 if cells > 2 else 1e-7)
    for seconds in (1e-9, 0.03, 5.0):
        monkeypatch.setattr(stepping, "time", Clock(seconds))
        result = run_text(text, tmp_path)
        assert result.exit_code == 0, result.message
        found.append(np.asarray(result.session.root.find("L").values))
    assert found[0].min() < 0.0  # it touches the wall
    assert np.array_equal(found[0], found[1])
    assert np.array_equal(found[0], found[2])
