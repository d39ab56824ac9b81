"""Gradients along lines and surfaces and their work; largest shear strain over a motion."""

import numpy as np
import pytest
from script_runs import finder, found
from together import together

from ssilang.kernel.elements import families
from ssilang.kernel.elements.results.structural_gradients import (
    is_structural,
    names_of_gradient,
    structural_forces,
    structural_gradient,
    structural_names,
    structural_work,
)
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode
from tests.kernel.elements.test_every_element import Two, drawn, turned

CASES = [(e, Mode.THREE_DIMENSIONAL) for e in ("BARR", "POUT", "TIMO", "DKT", "DST", "COQ4")]
CASES += [("BARR", Mode.PLANE_STRESS), ("POUT", Mode.PLANE_STRESS)]


def gradient(two, u):
    return structural_gradient(two.zone, u, zone_field(two.zone, two.material))


def as_field(two, values):
    names = structural_names(two.zone)
    parts = {n: values[:, i] for i, n in enumerate(names)}
    return CellField((CellFieldBlock(two.zone.cells, parts, "STRESSES", two.zone.element),))


@together("element, mode", CASES)
def test_a_linear_motion_has_its_slopes_in_the_own_axes(element, mode):
    two = Two(element, mode, turned(0.5, mode))
    A = np.random.default_rng(1).standard_normal((3, 3))
    if mode is not Mode.THREE_DIMENSIONAL:
        A[2] = A[:, 2] = 0.0
    u = two.x @ two.R @ A.T  # the field turns it
    H = gradient(two, two.field([u, 0 * u]))
    d = mode.dimension
    G = two.R @ A @ two.R.T
    axes = len(structural_names(two.zone)) // d
    x = two.zone.cells.coordinates
    for k in range(2):
        got = H[k].reshape(d, axes, -1)[..., 0]
        assert np.ptp(H[k], axis=-1) == pytest.approx(0.0, abs=1e-9)
        # the own axes do not matter for lengths: squares of the slopes along each
        if axes == 1:
            e = (x[k, 1] - x[k, 0]) / np.linalg.norm(x[k, 1] - x[k, 0])
            assert np.linalg.norm(got) == pytest.approx(np.linalg.norm((G @ e)[:d]))
            assert got[0, 0] == pytest.approx(e @ G @ e)
        else:
            n = np.cross(x[k, 1] - x[k, 0], x[k, 2] - x[k, 0])
            P = np.eye(3) - np.outer(n, n) / (n @ n)
            inside = np.einsum("ki,ki->", G @ P, G @ P)
            if x.shape[1] == 3:
                assert (got**2).sum() == pytest.approx(inside)
                assert got[0, 0] + got[1, 1] == pytest.approx(np.trace(P @ G @ P))


@together("element, mode", CASES)
def test_forces_work_as_products_of_gradients(element, mode):
    two = Two(element, mode, turned(0.5, mode))
    parameters = zone_field(two.zone, two.material)
    u, v = (two.field(drawn(two, mode, s)) for s in (1, 2))
    stress = CellField((families.stress(two.zone, two.material, two.field(drawn(two, mode))),))
    H = gradient(two, u)
    forces = structural_forces(two.zone, stress, as_field(two, H), parameters)
    back = structural_forces(two.zone, stress, as_field(two, gradient(two, v)), parameters)
    nodes = np.arange(len(two.x))

    def work(f, w):
        return sum(
            f.values_at("F" + n[1], nodes) @ w.values_at(n, nodes) for n in ("UX", "UY", "UZ")
        )

    assert work(forces, v) == pytest.approx(work(back, u), rel=1e-9)  # N is symmetric
    assert work(forces, v) != pytest.approx(0.0)
    # along a line: N u_k,x v_k,x over its length
    if "EFFX" in stress.blocks[0].components:
        x = two.zone.cells.coordinates
        L = np.linalg.norm(x[:, 1] - x[:, 0], axis=1)
        N = stress.blocks[0].components["EFFX"].mean(axis=1)
        both = np.einsum("cip,cip->cp", H, gradient(two, v)).mean(axis=1)
        assert work(forces, v) == pytest.approx((N * both * L).sum(), rel=1e-9)
        done = structural_work(two.zone, stress, as_field(two, H))
        expected = stress.blocks[0].components["EFFX"] * H[:, 0]
        np.testing.assert_allclose(done, np.broadcast_to(expected, done.shape))


def test_solids_have_their_own_names_and_points_none():
    space = Two("CUB8", Mode.THREE_DIMENSIONAL, np.eye(3)).zone
    assert not is_structural(space)
    assert len(names_of_gradient(space)) == 9
    shell = Two("COQ8", Mode.THREE_DIMENSIONAL, np.eye(3)).zone
    assert names_of_gradient(shell) == ()
    line = Two("POUT", Mode.PLANE_STRESS, np.eye(3)).zone
    assert names_of_gradient(line) == ("UX,X", "UY,X")


_BLOCK = (
    "OPTI DIME 3 ELEM CU20 ; L = DROI 1 (0. 0. 0.) (1. 0. 0.) ; S = TRAN 1 L (0. 2. 0.) ;"
    "V = VOLU 'TRAN' 2 S (0.3 0. 3.) ; M = MODE V MECANIQUE ELASTIQUE ; X Y Z = COOR V ;"
)


def largest(script):
    field = found(script, "G")
    return np.concatenate([b.components["SCAL"].ravel() for b in field.blocks])


def test_simple_shear_is_its_own_strain_and_the_largest_counts():
    script = _BLOCK + "U = NOMC 'UY' (Z * 3.E-3) ; G = ZGAM M (SUIT U (U * -2.) (U * 0.5)) ;"
    np.testing.assert_allclose(largest(script), 6e-3)


def test_any_linear_motion_gives_the_deviator():
    gradient = np.array([[1.0, 2, -1], [0, -2, 3], [4, 1, 5]]) * 1e-4
    words = " ET ".join(
        f"(NOMC 'U{a}' ((X * {g[0]}) + (Y * {g[1]}) + (Z * {g[2]})))"
        for a, g in zip("XYZ", gradient, strict=True)
    )
    e = (gradient + gradient.T) / 2
    e -= np.eye(3) * np.trace(e) / 3
    script = _BLOCK + f"G = ZGAM M (SUIT ({words})) ;"
    np.testing.assert_allclose(largest(script), np.sqrt(2 * (e * e).sum()))


def test_recorded_motion_gives_what_its_fields_give():
    script = _BLOCK + (
        "A = MATE M 'YOUN' 1.E7 'NU' 0.3 'RHO' 2000. ; T = TABL ;"
        "T . 'RIGI' = (RIGI M A) ET (BLOQ 'DEPL' S) ; T . 'MASS' = MASS M A ;"
        "T . 'VITE' = NOMC 'UY' (Z * Z) ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.002 'NPAS' 20 ;"
        "T . 'PAS_SAUVES' = MOT 'TOUS' ; R = DYNAMIC T ; G = ZGAM M R ; L = SUIT ;"
        " REPE K 21 ; L = L ET (R . &K . 'DEPL') ;"
        "FIN K ; G2 = ZGAM M L ; D = MAXI (ABS (G - G2)) ; E = MINI G2 ;"
    )
    find = finder(script)
    assert find("D") < 1e-12 * find("E")
    assert find("E") > 1e-5


def test_round_solids_count_the_hoop():
    script = (
        "OPTI DIME 2 MODE AXIS ELEM QUA8 ; S = TRAN 1 (DROI 1 (1. 0.) (2. 0.)) (0. 1.) ;"
        "M = MODE S MECANIQUE ELASTIQUE ; R = COOR 1 S ; G = ZGAM M (SUIT (NOMC UR (R * 3.E-3))) ;"
    )
    # strains (3, 0, 3): deviator (1, -2, 1)
    np.testing.assert_allclose(largest(script), 1e-3 * np.sqrt(2 * 6))
