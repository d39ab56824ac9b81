"""KENT, CORI and GYRO against energies, whirling shafts and turning rods."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.matrices.assembly import assemble, constraint_matrix, numbering_of

SHAFT = (
    "OPTI DIME 3 MODE TRID ELEM SEG2 ; P = 0 0 0 ; Q = {q} ; L = DROI {n} P Q ; "
    "M = MODE L MECANIQUE ELASTIQUE {element} ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 'RHO' 7800. "
    "'SECT' 0.01 'INRY' 2.E-5 'INRZ' 2.E-5 'TORS' 4.E-5 'OMEG' 50. ; "
)


def shaft(element="TIMO", n=4, q="(0. 0. 2.)"):
    return SHAFT.format(element=element, n=n, q=q)


def dense(matrix):
    return assemble(matrix).toarray()


@pytest.mark.parametrize("element", ["TIMO", "POUT"])
def test_gyroscopic_moment_of_a_tilting_shaft(found, element):
    g = found(shaft(element) + "G = GYRO M A ;", "G")
    G, numbering = dense(g), numbering_of(g)
    np.testing.assert_allclose(G, -G.T, atol=1e-9)
    # the whole shaft tilts rigidly about x and about y: moments +-I_p OMEG
    x, y = np.zeros(len(G)), np.zeros(len(G))
    for node in numbering.nodes[numbering.where("UX")]:
        z = numbering.table.coordinates[node][2]
        x[numbering.index_of(node, "UY")], x[numbering.index_of(node, "RX")] = -z, 1.0
        y[numbering.index_of(node, "UX")], y[numbering.index_of(node, "RY")] = z, 1.0
    polar = 7800 * 4e-5 * 2.0 * 50.0
    # the axis is z: M_x = I_p OMEG ty', M_y = -I_p OMEG tx'
    assert x @ G @ y == pytest.approx(polar, rel=1e-9)
    assert y @ G @ x == pytest.approx(-polar, rel=1e-9)
    assert x @ G @ x == pytest.approx(0.0, abs=1e-9)


def test_forward_whirl_is_faster_than_backward_whirl(found):
    script = shaft("TIMO", 8).replace("'OMEG' 50.", "'OMEG' 3000.") + (
        "K = (RIGI M A) ET (BLOQ 'UX' 'UY' (P ET Q)) ET (BLOQ 'UZ' 'RZ' P) ; B = MASS M A ; "
        "G = GYRO M A ; "
    )
    k, b, g = found(script, "K", "B", "G")
    held = constraint_matrix(k, numbering_of(k)).C.toarray().any(axis=0)
    free = np.ix_(~held, ~held)
    K, M, G = (dense(m)[free] for m in (k, b, g))
    n = len(K)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, G)]])
    w = np.linalg.eigvals(A).imag
    low, high = np.sort(w[w > 1])[:2]
    # a slender shaft on two supports: w^2 (1 + a) -+ 2 a OMEG w = w0^2, a = pi^2 I / (S L^2)
    a = np.pi**2 * 2e-5 / (0.01 * 4)
    assert high - low == pytest.approx(2 * a * 3000 / (1 + a), rel=0.05)


@pytest.mark.parametrize("element", ["TIMO", "POUT", "BARR"])
def test_centrifugal_stiffness_of_a_rigid_translation_is_its_mass(found, element):
    script = shaft(element, q="(1. 2. 2.)").replace("'OMEG' 50.", "")
    if element == "BARR":
        i = script.index("'INRY'")
        script = script[:i] + "; "
    k, e = found(
        script + "K = KENT 'CENTRIFUGE' M A (0. 3. 4.) ; E = KENT 'EULER' M A (0. 3. 4.) ;",
        "K",
        "E",
    )
    K, E, numbering = dense(k), dense(e), numbering_of(k)
    mass = 7800 * 0.01 * 3.0
    t = np.array([0.3, -1.0, 2.0])
    u = np.zeros(len(K))
    for i, name in enumerate(("UX", "UY", "UZ")):
        u[numbering.where(name)] = t[i]
    w = np.array([0.0, 3.0, 4.0])
    assert u @ K @ u == pytest.approx(mass * t @ np.cross(w, np.cross(w, t)))
    np.testing.assert_allclose(K, K.T, atol=1e-8)
    np.testing.assert_allclose(E, -E.T, atol=1e-8)
    v = np.zeros(len(K))
    v[numbering.where("UX")] = 1.0
    assert v @ E @ u == pytest.approx(mass * np.cross(w, t)[0])


def test_centrifugal_stiffness_of_a_bent_beam_is_the_integral_of_its_deflection(found):
    k = found(shaft("POUT", 1) + "K = KENT 'CENTRIFUGE' M A (0. 0. 5.) ;", "K")
    K, numbering = dense(k), numbering_of(k)
    u = np.zeros(len(K))
    tip = numbering.nodes[numbering.where("UX")].max()
    u[numbering.index_of(tip, "UX")] = 1.0  # cubic 3 s^2 - 2 s^3: mean square 13 / 35
    assert u @ K @ u == pytest.approx(-25 * 7800 * 0.01 * 2 * 13 / 35)


def test_block_in_a_turning_frame(found):
    script = (
        "OPTI DIME 3 MODE TRID ELEM CUB8 ; L = DROI 1 (1 0 0) (2 0 0) ; S = TRAN 1 L (0. 1. 0.) ; "
        "V = VOLU 2 S 'TRAN' (0. 0. 1.) ; M = MODE V MECANIQUE ELASTIQUE ; "
        "A = MATE M 'YOUN' 1. 'NU' 0.3 'RHO' 3. ; B = MASS M A ; "
        "K = KENT 'CENTRIFUGE' M A (0. 0. 2.) ; "
    )
    k, b = found(script, "K", "B")
    K, M, numbering = dense(k), dense(b), numbering_of(k)
    turned = np.isin(numbering.codes, [numbering.code("UX"), numbering.code("UY")])
    expected = -4 * M * np.outer(turned, turned)
    np.testing.assert_allclose(K, expected, atol=1e-12)


def test_damping_that_turns_resists_nothing_when_the_body_turns_with_it(found):
    script = shaft("TIMO").replace("'OMEG' 50.", "'OMEG' 50. 'VISQ' 1.E6") + (
        "C H = AMOR M A 'COROTATIF' ; "
    )
    c, h = found(script, "C", "H")
    C, H, numbering = dense(c), dense(h), numbering_of(c)
    np.testing.assert_allclose(H, -H.T, atol=1e-9 * np.abs(H).max())  # a round section
    # a bent shape carried round at OMEG: v = w x u in the fixed frame, no force
    rng = np.random.default_rng(0)
    u, v = np.zeros(len(C)), np.zeros(len(C))
    for names in (("UX", "UY"), ("RX", "RY")):
        x, y = (numbering.where(n) for n in names)
        u[x], u[y] = rng.normal(size=(2, len(x)))
        v[x], v[y] = -50.0 * u[y], 50.0 * u[x]
    assert np.abs(C @ v).max() > 1.0
    np.testing.assert_allclose(C @ v + H @ u, 0.0, atol=1e-9 * np.abs(C @ v).max())


def test_torsion_mode_of_a_shaft_has_a_largest_rotation_of_one(found):
    script = shaft("TIMO", 8) + (
        "K = (RIGI M A) ET (BLOQ 'UX' 'UY' (P ET Q)) ET (BLOQ 'UZ' 'RZ' P) ; "
        "T = VIBR 'SIMU' 393. 1 K (MASS M A) ; F = T . 'MODES' . 1 . 'FREQUENCE' ; "
        "X = MAXI (EXCO (T . 'MODES' . 1 . 'DEFORMEE_MODALE') 'RZ') 'ABS' ; "
        "G = T . 'MODES' . 1 . 'MASSE_GENERALISEE' ; "
    )
    f, x, g = found(script, "F", "X", "G")
    speed = np.sqrt(2e11 / 2.6 / 7800)
    assert f == pytest.approx(speed / 8, rel=0.01)  # a quarter of a wave over 2 m
    assert x == pytest.approx(1.0)
    assert g == pytest.approx(7800 * 4e-5 * 2 / 2, rel=0.02)


PLATE = (
    "OPTI DIME 3 MODE TRID ELEM {cell} ; L = DROI 2 (0. 0. 0.) (1. 0. 0.) ; "
    "S = L TRAN 2 (0. 0.6 0.8) ; M = MODE S MECANIQUE ELASTIQUE {element} ; "
    "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'RHO' 7800. 'EPAI' 0.02 ; "
)


def rigid(matrix, direction):
    """Translation by a vector, as a vector of the unknowns."""
    numbering = numbering_of(matrix)
    v = np.zeros(numbering.size)
    for name, value in zip(("UX", "UY", "UZ"), direction, strict=True):
        v[numbering.where(name)] = value
    return v


@together("cell, element", [("TRI3", "DKT"), ("QUA4", "COQ4"), ("QUA8", "COQ8"), ("SEG2", "POUT")])
def test_coriolis_forces_of_a_rigid_velocity(found, cell, element):
    if element == "POUT":
        script, mass = shaft("POUT").replace("'OMEG' 50.", ""), 7800 * 0.01 * 2
    else:
        script, mass = PLATE.format(cell=cell, element=element), 7800 * 0.02
    c, k = found(
        script + "C = CORI M A (1. 2. 3.) ; K = KENT 'CENTRIFUGE' M A (1. 2. 3.) ;", "C", "K"
    )
    assert c.kind == "AMORTISSEMENT"
    C = dense(c)
    np.testing.assert_allclose(C, -C.T, atol=1e-9)
    w, v, u = np.array([1.0, 2.0, 3.0]), np.array([0.4, -0.3, 0.2]), np.array([0.1, 0.5, -0.7])
    assert rigid(c, u) @ C @ rigid(c, v) == pytest.approx(2 * mass * u @ np.cross(w, v), rel=1e-9)
    pushed = mass * u @ np.cross(w, np.cross(w, v))
    assert rigid(k, u) @ dense(k) @ rigid(k, v) == pytest.approx(pushed, rel=1e-9)


def test_turning_ring_has_a_centrifugal_stiffness_about_its_axis(found):
    script = (
        "OPTI DIME 2 MODE AXIS ELEM QUA4 ; L = DROI 1 (1. 0.) (1.5 0.) ; S = L TRAN 1 (0. 1.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 1. 'NU' 0.3 'RHO' 5. ; "
        "K = KENT 'CENTRIFUGE' M A (0. 3.) ; J = KENT 'CENTRIFUGE' M A ;"
    )
    k, j = found(script, "K", "J")
    numbering = numbering_of(k)
    v = np.zeros(numbering.size)
    v[numbering.where("UR")] = 1.0
    mass = 5.0 * np.pi * (1.5**2 - 1.0)
    assert v @ dense(k) @ v == pytest.approx(-9 * mass, rel=1e-9)
    np.testing.assert_allclose(dense(k), 9 * dense(j))
    v[:], v[numbering.where("UZ")] = 0.0, 1.0
    assert v @ dense(k) @ v == 0.0
