"""GRAD WORK FOFI of beams and flat shells against geometric stiffness and closed forms."""

import numpy as np
import pytest
from together import together

PLATE = (
    "OPTI DIME 3 ELEM QUA4 ; S = (DROI 3 (0. 0. 0.) (1.2 0.3 0.4)) TRAN 2 (0.1 1. 0.2) ; {} "
    "M = MODE S MECANIQUE ELASTIQUE {} ; A = MATE M 'YOUN' 1.E6 'NU' 0.3 'EPAI' 0.02 ; "
)
BEAM = (
    "OPTI DIME 3 ELEM SEG2 ; S = DROI 3 (0. 0. 0.) (1.2 0.3 0.4) ; M = MODE S MECANIQUE ELASTIQUE "
    "{} ; A = MATE M 'YOUN' 1.E6 'NU' 0.3 'SECT' 0.1 {} ; "
)
SECTION = "'INRY' 1.E-9 'INRZ' 1.E-9 'TORS' 1.E-9 'VECT' (0. 1. 1.)"
MOTION = (
    "X Y Z = COOR S ; U = (NOMC 'UX' ((0.3 * X) - (0.2 * Y * Y)) 'NATU' 'DIFFUS') ET "
    "(NOMC 'UY' ((0.1 * X * Z) + Y) 'NATU' 'DIFFUS') ET (NOMC 'UZ' (X - (0.4 * Y)) 'NATU' 'DIFFUS')"
    " ; V = (NOMC 'UX' (X * X) 'NATU' 'DIFFUS') ET (NOMC 'UY' (Y - (2. * Z * X)) 'NATU' 'DIFFUS') "
    "ET (NOMC 'UZ' (X * Y) 'NATU' 'DIFFUS') ; T = SIGM M A U ; "
)
FORCES = "G = GRAD M U A ; F = FOFI M T G A ; K = KSIG M T A ; H = K * U ; "
CASES = [
    PLATE.format("", "COQ4"),
    PLATE.format("S = CHAN TRI3 S ;", "DKT"),
    BEAM.format("BARR", ""),
    BEAM.format("TIMO", SECTION),
]


def check_forces(found, script):
    f, h = found(script, "F", "H")
    for name in ("FX", "FY", "FZ"):
        ids = h.components[name].nodes
        scale = np.abs(h.values_at(name, ids)).max()
        assert scale > 0
        np.testing.assert_allclose(
            f.values_at(name, ids), h.values_at(name, ids), atol=1e-9 * scale
        )


@together("script", CASES)
def test_forces_on_gradients_are_those_of_the_geometric_stiffness(found, script):
    check_forces(found, script + MOTION + FORCES)


@together("script", CASES)
def test_forces_work_as_stresses_do_on_products_of_gradients(found, script):
    """Forces made with u work in v as those made with v work in u."""
    script += MOTION + (
        "F = FOFI M T (GRAD M U A) A ; G = FOFI M T (GRAD M V A) A ; "
        "L1 = MOTS 'FX' 'FY' 'FZ' ; L2 = MOTS 'UX' 'UY' 'UZ' ; "
        "W1 = XTY F V L1 L2 ; W2 = XTY G U L1 L2 ; "
    )
    first, second = found(script, "W1", "W2")
    assert first == pytest.approx(second, rel=1e-9)
    assert abs(first) > 0


@pytest.mark.parametrize("element", ["COQ4", "DKT"])
def test_work_of_membrane_forces_is_that_on_their_strains(found, element):
    change = "S = CHAN TRI3 S ;" if element == "DKT" else ""
    script = PLATE.format(change, element) + MOTION + (
        "W = WORK M T (GRAD M U A) ; E = EPSI M U A ; "
        "D = ((EXCO 'N11' T 'SCAL') * (EXCO 'EPSS' E 'SCAL')) + ((EXCO 'N22' T 'SCAL') * "
        "(EXCO 'EPTT' E 'SCAL')) + ((EXCO 'N12' T 'SCAL') * (EXCO 'GAST' E 'SCAL')) ; "
    )  # fmt: skip
    work, product = found(script, "W", "D")
    first, second = (f.blocks[0].components["SCAL"] for f in (work, product))
    assert np.abs(first).max() > 0
    np.testing.assert_allclose(first, second, rtol=1e-9)


def test_gradient_of_a_stretched_and_turned_beam(found):
    script = (
        "OPTI DIME 2 ELEM SEG2 ; S = DROI 2 (0. 0.) (0. 2.) ; "
        "M = MODE S MECANIQUE ELASTIQUE POUT ; X Y = COOR S ; "
        "U = (NOMC 'UX' (-0.2 * Y) 'NATU' 'DIFFUS') ET (NOMC 'UY' (0.1 * Y) 'NATU' 'DIFFUS') ; "
        "G = GRAD M U ; "
    )
    block = found(script, "G").blocks[0].components
    np.testing.assert_allclose(block["UX,X"], 0.1)
    np.testing.assert_allclose(block["UY,X"], 0.2)
