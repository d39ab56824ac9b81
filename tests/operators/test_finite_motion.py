"""POLA PICA CAPI WORK FOFI TAGR against homogeneous motions known in closed form."""

import numpy as np
import pytest
from scipy.linalg import logm

CUBE = (
    "OPTI DIME 3 MODE TRID ELEM CUB8 ; L = DROI 2 (0. 0. 0.) (1. 0. 0.) ; "
    "S = TRAN 1 L (0.1 1. 0.) ; V = VOLU 1 S 'TRAN' (0. 0.2 1.) ; "
    "M = MODE V MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2.E3 'NU' 0.3 ; X Y Z = COOR V ; "
)
F = np.array([[0.4, -1.1, 0.2], [1.3, 0.5, 0.1], [0.05, -0.2, 0.9]])
H = F - np.eye(3)
AXES = "XYZ"


def displacement(gradient, name="U"):
    parts = []
    for i, axis in enumerate(AXES):
        terms = " + ".join(f"({float(gradient[i, j])!r} * {a})" for j, a in enumerate(AXES))
        parts.append(f"(NOMC 'U{axis}' ({terms}) 'NATU' 'DIFFUS')")
    return f"{name} = " + " ET ".join(parts) + " ; "


def gradients(field):
    block = field.blocks[0].components
    return np.array([[np.ravel(block[f"U{a},{b}"]) for b in AXES] for a in AXES])


def tensor(field, prefix="SM", shear="SM", factor=1.0):
    c = field.blocks[0].components
    T = np.zeros((3, 3))
    for i, a in enumerate(AXES):
        for j, b in enumerate(AXES):
            name = (prefix if i == j else shear) + min(a, b) + max(a, b)
            T[i, j] = np.ravel(c[name])[0] * (1.0 if i == j else factor)
    return T


def test_polar_decomposition_is_a_rotation_times_a_symmetric_stretch(found):
    r, u, s = found(
        CUBE + displacement(H) + "R1 U1 = POLA M (GRAD M U) 'DEPL' ; R2 S2 = POLA M U1 ;",
        "R1", "U1", "S2",
    )  # fmt: skip
    R, U = gradients(r)[..., 0], gradients(u)[..., 0]
    np.testing.assert_allclose(R @ U, F, atol=1e-12)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(U, U.T, atol=1e-12)
    assert (np.linalg.eigvalsh(U) > 0).all()
    np.testing.assert_allclose(gradients(s)[..., 0], U, atol=1e-12)  # F itself, rotation one


def test_strains_of_gradients_are_logarithms_that_a_rotation_leaves(found):
    e, of_u = found(
        CUBE + displacement(H) + "R1 U1 = POLA M (GRAD M U) 'DEPL' ; D = EPSI M (GRAD M U) 'DEPL' ;"
        " E = EPSI M U1 ;",
        "E", "D",
    )  # fmt: skip
    expected = logm(F.T @ F) / 2
    for field in (e, of_u):
        np.testing.assert_allclose(tensor(field, "EP", "GA", 0.5), expected, atol=1e-12)


@pytest.mark.parametrize(("mode", "last"), [("PLAN DEFO", ()), ("AXIS", ("EPTT",))])
def test_logarithms_of_a_plane_gradient_leave_the_third_axis(found, mode, last):
    script = (
        f"OPTI DIME 2 MODE {mode} ELEM QUA4 ; L = DROI 1 (1 0) (2 0) ; S = TRAN 1 L (0. 1.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; X Y = COOR S ; "
        "U = (NOMC 'UR' (0.3 * X)) ET (NOMC 'UZ' ((0.5 * X) - (0.2 * Y))) ; "
    )
    plane = script.replace("UR", "UX").replace("UZ", "UY") if not last else script
    asked = "E = EPSI M (GRAD M U) 'DEPL' ; R V = POLA M (GRAD M U) 'DEPL' ; D = EPSI M V ;"
    e, of_stretch = (f.blocks[0].components for f in found(plane + asked, "E", "D"))
    G = np.array([[1.3, 0.0], [0.5, 0.8]])
    E = logm(G.T @ G) / 2
    a, b = ("X", "Y") if not last else ("R", "Z")
    for name, value in ((f"EP{a}{a}", E[0, 0]), (f"EP{b}{b}", E[1, 1]), (f"GA{a}{b}", 2 * E[0, 1])):
        np.testing.assert_allclose(e[name], value, atol=1e-12)
        np.testing.assert_allclose(of_stretch[name], value, atol=1e-12)
    for name in last:
        np.testing.assert_allclose([e[name], of_stretch[name]], np.log(1.3), atol=1e-12)


def test_cauchy_stress_of_a_piola_stress_and_back(found):
    s, c, back = found(
        CUBE + displacement(H) + "S = SIGM M A U ; C = PICA M S U ; B = CAPI M C U ;",
        "S", "C", "B",
    )  # fmt: skip
    S, C = tensor(s), tensor(c)
    np.testing.assert_allclose(C, F @ S @ F.T / np.linalg.det(F), rtol=1e-10)
    np.testing.assert_allclose(tensor(back), S, rtol=1e-9)
    assert c.title == "CONTRAINTES"


def test_almansi_strain_of_a_green_strain(found):
    e, a = found(CUBE + displacement(H) + "E = EPSI 'QUAD' M U ; A1 = PICA M E U ;", "E", "A1")
    E, almansi = tensor(e, "EP", "GA", 0.5), tensor(a, "EP", "GA", 0.5)
    np.testing.assert_allclose(E, (F.T @ F - np.eye(3)) / 2, atol=1e-12)
    inverse = np.linalg.inv(F)
    np.testing.assert_allclose(almansi, (np.eye(3) - inverse.T @ inverse) / 2, atol=1e-11)


def test_corotational_frame_turns_principal_axes_only(found):
    s, c = found(CUBE + displacement(H) + "S = SIGM M A U ; C = PICA 'JAUM' M S U ;", "S", "C")
    w, x = np.linalg.svd(F)[0::2]
    R = w @ x
    np.testing.assert_allclose(tensor(c), R @ tensor(s) @ R.T, rtol=1e-9)


def test_user_stresses_stay(found):
    s, c = found(CUBE + displacement(H) + "S = SIGM M A U ; C = PICA 'UTIL' M S U ;", "S", "C")
    assert c is s


def test_work_is_the_stress_times_the_gradient(found):
    w, s = found(
        CUBE + displacement(H) + "S = SIGM M A U ; W = INTG M (WORK M S (GRAD M U)) ;", "W", "S"
    )
    assert w == pytest.approx(np.sum(tensor(s) * H))  # volume 1


def test_transposed_gradient(found):
    g, t = found(CUBE + displacement(H) + "G = GRAD M U ; T = TAGR G ;", "G", "T")
    np.testing.assert_array_equal(gradients(t), gradients(g).transpose(1, 0, 2))


def test_forces_on_gradients_do_the_work_of_the_second_order_strain(found):
    other = np.array([[0.3, 0.1, 0.0], [-0.2, 0.5, 0.4], [0.7, 0.0, -0.1]])
    script = CUBE + displacement(H) + displacement(other, "V1")
    w, s = found(
        script + "S = SIGM M A U ; F = FOFI M S (GRAD M U) ; "
        "W = XTY F V1 (MOTS 'FX' 'FY' 'FZ') (MOTS 'UX' 'UY' 'UZ') ;",
        "W", "S",
    )  # fmt: skip
    assert w == pytest.approx(np.einsum("ij,ki,kj->", tensor(s), H, other))
