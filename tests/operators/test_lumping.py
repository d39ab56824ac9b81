"""Lumped masses of every body carry its whole mass, each way, and none of it is negative."""

import numpy as np
import pytest
from script_runs import finder
from together import together

PLANE = "OPTI DIME 2 MODE PLAN DEFO ELEM {cell} ; A = 0. 0. ; B = 3. 0. ; "
BODY = PLANE + "L = DROI 3 A B ; S = TRAN 2 L (0. 2.) ; MO = MODE S 'MECANIQUE' 'ELASTIQUE' {el} ; "
SOLID = "MA = MATE MO 'YOUN' 1.E9 'NU' 0.3 'RHO' 5. ; "
SPACE = (
    "OPTI DIME 3 MODE TRID ELEM {cell} ; A = 0. 0. 0. ; B = 3. 0. 0. ; L = DROI 3 A B ; "
    "S = TRAN 2 L (0. 2. 0.) ; V = VOLU S 'TRAN' 1 (0. 0. 1.) ; "
    "MO = MODE V 'MECANIQUE' 'ELASTIQUE' {el} ; "
)
BEAM = (
    "OPTI DIME {dim} MODE {mode} ELEM SEG2 ; A = {a} ; B = {b} ; L = DROI 4 A B ; "
    "MO = MODE L 'MECANIQUE' 'ELASTIQUE' {el} ; "
    "MA = MATE MO 'YOUN' 1.E9 'NU' 0.3 'RHO' 5. 'SECT' 2. 'INRY' 0.1 'INRZ' 0.2 'TORS' 0.3 ; "
)
BODIES = {
    **{c: BODY.format(cell=c, el=f"'{c}'") + SOLID for c in ("TRI3", "QUA4", "TRI6", "QUA8")},
    **{c: SPACE.format(cell=c, el=f"'{c}'") + SOLID for c in ("CUB8", "CU20")},
    "POUT": BEAM.format(dim=3, mode="TRID", a="0. 0. 0.", b="1. 2. 2.", el="'POUT'"),
    "TIMO": BEAM.format(dim=3, mode="TRID", a="0. 0. 0.", b="1. 2. 2.", el="'TIMO'"),
    "POUT in the plane": BEAM.format(
        dim=2, mode="PLAN CONT", a="0. 0.", b="0. 3.", el="'POUT'"
    ).replace("'INRY' 0.1 ", "").replace("'TORS' 0.3 ", ""),
}  # fmt: skip
AXES = {"3": ("UX", "UY", "UZ"), "2": ("UX", "UY")}


@together("name", BODIES)
def test_lumping_keeps_the_mass(name):
    body = BODIES[name]
    axes = AXES["3" if "DIME 3" in body else "2"]
    sums = ""
    for u in axes:
        sums += (
            f"E{u} = MANU 'CHPO' (EXTR MO 'MAIL') 1 '{u}' 1. ; S{u} = XTMX E{u} ML ; "
            f"T{u} = XTMX E{u} (MASS MO MA) ; "
        )
    found = finder(body + "ML = LUMP MO MA ; " + sums)
    whole = 5.0 * (2.0 * 3.0 if "SECT" in body else 6.0)
    for u in axes:
        assert found(f"S{u}") == pytest.approx(whole, rel=1e-12)
        assert found(f"T{u}") == pytest.approx(whole, rel=1e-12)
    lumped = found("ML")
    for block in lumped.blocks:
        diagonal = np.einsum("nii->ni", block.values)
        assert (block.values == diagonal[:, :, None] * np.eye(diagonal.shape[1])).all()
        assert (diagonal >= 0).all()
