"""Fields of joints: where their points are, how far these are open, which are open."""

import numpy as np
import pytest
from together import together

JOINT = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; L1 = DROI 3 (0. 0.) (3. 0.) ; L2 = L1 PLUS (0. 0.) ; "
    "J = RACC 1.E-3 L2 L1 ; M = MODE J MECANIQUE ELASTIQUE JOI2 ; "
)
GAUSS = np.array([i + 0.5 + s / 2 / np.sqrt(3.0) for i in range(3) for s in (-1, 1)])


def _at_points(field):
    return np.concatenate([np.ravel(b.components["SCAL"]) for b in field.blocks])


@together(
    "statement",
    [
        "C = CHAN 'CHAM' (COOR 1 J) M 'STRESSES'",
        "C = CHAN 'CHAM' (COOR 1 L1) M 'STRESSES'",
        "C = CHAN 'CHAM' (COOR 1 L2) M 'STRESSES'",
        "C = CHAN 'STRESSES' M (CHAN 'CHAM' (COOR 1 L1) M)",
        "C = CHAN 'STRESSES' (COOR 1 M) M",
        "C = COOR 1 (EPSI M (MANU 'CHPO' J 1 'UX' 0.))",
    ],
)
def test_coordinates_of_the_points_of_joints(found, statement):
    """From both sides, or from one of them alone, which are at one place."""
    assert _at_points(found(JOINT + statement + " ;", "C")) == pytest.approx(GAUSS, abs=1e-14)


def test_open_points_are_found(found):
    """The upper side turned about (0, 0) by 0.1 and pushed down by 0.15: open where x > 1.5."""
    points, x, gap, cells, direct, off = found(
        JOINT + "U = NOMC 'UY' ((0.1 * (COOR 1 L2)) - 0.15) ; E = EPSI M U ; "
        "P = EXCO 'DRN' (CHAN 'CHPO' M E 'SUPP') 'SCAL' ; O = P POIN 'SUPERIEUR' 0. ; "
        "N = NBNO O ; X = MINI (COOR 1 O) ; G = MAXI P ; "
        "C = NBEL (E ELEM 'SUPERIEUR' 0. 'AVEC' (MOTS 'DRN')) ; "
        "D = NBNO (E POIN 'SUPERIEUR' 0. 'AVEC' (MOTS 'DRN')) ; "
        "Q = EXCO 'DRN' (CHAN 'CHPO' M E) 'SCAL' ; "
        "R = MAXI (Q - ((0.1 * (COOR 1 J)) - 0.15)) 'ABS' ;",
        "N", "X", "G", "C", "D", "R",
    )  # fmt: skip
    assert points == direct == 3
    assert x == pytest.approx(GAUSS[3])
    assert gap == pytest.approx(0.1 * GAUSS[-1] - 0.15)
    assert cells == 2
    assert off < 1e-14
