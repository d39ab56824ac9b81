"""Static problems by nested dissection give what SuperLU gives."""

import re

import pytest
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.solvers import backends
from ssilang.kernel.statics import linear

BEAM = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
L = DROI 3 (0. 0.) (0. 1.) ; S = L TRAN 12 (6. 0.) ; P = S POIN 'PROC' (6. 1.) ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 2.E9 'NU' 0.3 ;
CL = {conditions} ;
U = RESO ((RIGI MO MA) ET CL) (FORC (0. -1.E4) P) ;
MESS (EXTR U 'UY' P) (EXTR U 'UX' P) (MAXI (REAC CL U)) ;
"""


@together(
    "conditions",
    ["BLOQ 'DEPL' L", "(BLOQ 'DEPL' L) ET (RELA 'UX' P - 'UX' (S POIN 'PROC' (6. 0.)))"],
)
def test_a_beam(conditions, monkeypatch):
    found = []
    for least in (1, 10**9):
        monkeypatch.setattr(backends, "DISSECTED", least)
        used = []
        real = linear.invert

        def spy(*given, used=used, real=real):
            inverse = real(*given)
            used.append(inverse.factor.name)
            return inverse

        monkeypatch.setattr(linear, "invert", spy)
        result = run_text(BEAM.format(conditions=conditions))
        monkeypatch.setattr(linear, "invert", real)
        assert result.exit_code == 0, result.output
        assert used == [backends.DISSECTION if least == 1 else "SuperLU"]
        found.append([float(x) for x in re.findall(r"-?\d\.\d+E?[-+]?\d*", result.output)])
    assert len(found[0]) >= 3
    assert found[0] == pytest.approx(found[1], rel=1e-5)
