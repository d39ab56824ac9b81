"""Axes of beams and joints follow a motion; GRAD WORK FOFI of beams and flat shells."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from together import together

NAMES = ("UX", "UY", "UZ", "RX", "RY", "RZ")
TURN = np.array([0.3, -0.4, 0.9])
"""Rotation vector, 59 degrees about an axis along nothing."""


def _motion(points):
    """A rigid turn of points, as a statement that makes the field U."""
    parts = []
    for name, place in points.items():
        moved = Rotation.from_rotvec(TURN).apply(place) - place
        values = [*moved, *TURN]
        words = " ".join(f"'{n}' {v:.17g}" for n, v in zip(NAMES, values, strict=True))
        parts.append(f"(MANU 'CHPO' {name} {words} 'NATURE' 'DIFFUS')")
    return "U = " + " ET ".join(parts) + " ; "


def _assembled(matrix):
    block = matrix.blocks[0]
    return np.asarray(block.values[0])


def _turned(K):
    R = np.kron(np.eye(len(K) // 3), Rotation.from_rotvec(TURN).as_matrix())
    return R @ K @ R.T


POINTS = {"PA": np.array([1.0, 0.0, 0.0]), "PB": np.array([2.0, 2.0, 1.0])}
START = (
    "OPTI DIME 3 ELEM SEG2 ; PA = 1. 0. 0. ; PB = 2. 2. 1. ; L = MANU 'SEG2' PA PB ; "
    + _motion(POINTS)
)
BEAM = (
    "M = MODE L MECANIQUE ELASTIQUE POUT ; A = MATE M 'YOUN' 3. 'NU' 0.25 'SECT' 1.5 'INRY' 2. "
    "'INRZ' 0.7 'TORS' 0.9 'VECT' (0. 1. 1.) ; "
)
JOINT = (
    "M = MODE L MECANIQUE ELASTIQUE JOI1 'LIE' ; A = MATE M 'DIRECTION' (0. 1. 0.) (1. 0. 0.) "
    "'KN' 5. 'KS1' 2. 'KS2' 3. 'QN' 1. 'QS1' 4. 'QS2' 6. ; "
)


@pytest.mark.parametrize("order", ["U M A", "M A U", "M U A"])
def test_stiffness_of_the_turned_structure_is_the_turned_stiffness(found, order):
    before, after = found(
        START + BEAM + f"K1 = RIGI M A ; C B = FORM {order} ; K2 = RIGI M B ;", "K1", "K2"
    )
    assert _assembled(after) == pytest.approx(_turned(_assembled(before)), abs=1e-12)


def test_axes_of_free_joints_stay(found):
    script = START + JOINT.replace("'LIE'", "'LIBRE'")
    before, after = found(script + "K1 = RIGI M A ; C B = FORM U M A ; K2 = RIGI M B ;", "K1", "K2")
    lever = _assembled(after)[:3, :3]
    assert lever == pytest.approx(_assembled(before)[:3, :3], abs=1e-12)


FLAT = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = DROI 1 (0. 0.) (0. 0.1) ; "
    "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'JOI1' 'LIE' ; "
    "A = MATE M 'DIRECTION' (0. 1.) 'KN' 4. 'KS' 1. ; "
)
AXES = "X = EXTR B 'V1X' 1 1 1 ; Y = EXTR B 'V1Y' 1 1 1 ;"


def test_axes_of_a_flat_joint_follow_its_segment_whatever_its_nodes_turn_by(found):
    move = (
        "(MANU 'CHPO' (L POIN 2) 'UX' 0.1 'NATURE' 'DIFFUS') ET "
        "(MANU 'CHPO' L 'RZ' 2. 'NATURE' 'DIFFUS')"
    )
    x, y = found(FLAT + f"C B = FORM ({move}) M A ; " + AXES, "X", "Y")
    assert (x, y) == pytest.approx((np.sqrt(0.5), np.sqrt(0.5)), abs=1e-14)


def test_a_flat_joint_that_is_turned_over(found):
    move = "MANU 'CHPO' (L POIN 2) 'UY' (-0.3)"
    assert found(FLAT + f"C B = FORM ({move}) M A ; " + AXES, "X", "Y") == pytest.approx(
        (0.0, -1.0), abs=1e-14
    )


def test_axes_of_a_joint_in_space_turn_about_its_segment_and_with_it(found):
    """The part of the mean rotation vector along the segment, then the shortest turn."""
    moves = np.array([[0.3, -0.2, 0.5], [-1.1, 0.4, 0.8]])
    turns = np.array([[0.4, 1.0, -0.3], [0.2, 0.1, 2.0]])
    parts = [
        f"(MANU 'CHPO' {name} "
        + " ".join(f"'{n}' {v:.17g}" for n, v in zip(NAMES, [*move, *turn], strict=True))
        + " 'NATURE' 'DIFFUS')"
        for name, move, turn in zip(POINTS, moves, turns, strict=True)
    ]
    material = found(START + JOINT + "U = " + " ET ".join(parts) + " ; C B = FORM U M A ;", "B")
    seen = np.array([
        [material.blocks[0].components[f"V{k}{c}"][0, 0] for c in "XYZ"] for k in (1, 2)
    ])  # fmt: skip
    a = POINTS["PB"] - POINTS["PA"]
    b = a + moves[1] - moves[0]
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    mean = turns.mean(axis=0)
    about = Rotation.from_rotvec((mean @ a) * a)
    swing = Rotation.align_vectors([b, np.cross(np.cross(a, b), b)],
                                   [a, np.cross(np.cross(a, b), a)])[0]  # fmt: skip
    expected = (swing * about).apply([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
    np.testing.assert_allclose(seen, expected, atol=1e-12)


PLATE = (
    "OPTI DIME 3 ELEM QUA4 ; S = (DROI 3 (0. 0. 0.) (1.2 0.3 0.4)) TRAN 2 (0.1 1. 0.2) ; {} "
    "M = MODE S MECANIQUE ELASTIQUE {} ; A = MATE M 'YOUN' 1.E6 'NU' 0.3 'EPAI' 0.02 ; "
)
TURNED_BEAM = (
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
    TURNED_BEAM.format("BARR", ""),
    TURNED_BEAM.format("TIMO", SECTION),
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
