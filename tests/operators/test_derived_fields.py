"""CHPO XXT CMCT CABL MFIL DIMN ORTH MAX1 DFOU PSIP POD against closed forms."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.matrices.assembly import assemble

TWO = "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; K = (APPU 'UX' 4. P) ET (APPU 'UX' 5. Q) ; "
AT = np.array([0, 4, 1, 2, 3])  # the ends of a line come first
LINE = "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (4. 0.) ; X = COOR 1 L ; "
PLATE = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; L = DROI 3 (0 0) (3 0) ; S = TRAN 2 L (0. 2.) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2. 'NU' 0.3 'RHO' 1. ; K = RIGI M A ; "
)


def dense(matrix):
    return assemble(matrix).toarray()


# ---- matrices


def test_field_on_the_unknowns_of_a_matrix(found):
    u, r = found(PLATE + "U = CHPO 'UNIFORME' 2.5 K ; R = CHPO K 'ALEATOIRE' ;", "U", "R")
    assert set(u.components) == {"UX", "UY"}
    assert (u.components["UX"].values == 2.5).all()
    assert len(r.components["UY"].nodes) == 12
    assert len(set(r.components["UY"].values)) == 12


def test_filter_is_a_weighted_mean(found):
    script = LINE + "W = 1. + (X MASQ 'EGAL' 1.) ; F = MFIL W 1.5 2. ; Y = F * X ; "
    f, y = found(script, "F", "Y")
    A = dense(f)
    np.testing.assert_allclose(A.sum(axis=1), 1.0)
    w = (1 - 1 / 1.5) ** 2  # of a neighbour at distance 1; the node at 1 weighs twice
    row = A[list(AT).index(2)]
    np.testing.assert_allclose(row[np.argsort(AT)], np.array([0, 2 * w, 1, w, 0]) / (1 + 3 * w))
    smooth = (2 * w + 2 + 3 * w) / (1 + 3 * w)
    assert y.components["SCAL"].values[list(AT).index(2)] == pytest.approx(smooth)
    none = found(LINE + "F = MFIL (X + 1.) ;", "F")
    np.testing.assert_allclose(dense(none), np.eye(5))


def test_orthogonal_field(found):
    script = PLATE + (
        "MS = MASS M A ; B = VIBR 'SIMU' 0.01 5 (K ET (BLOQ 'DEPL' L)) MS ; "
        "U1 = B . 'MODES' . 1 . 'DEFORMEE_MODALE' ; U2 = B . 'MODES' . 2 . 'DEFORMEE_MODALE' ; "
        "LU = (SUIT U1) ET U2 ; LN = PROG (XTMX U1 MS) (XTMX U2 MS) ; "
        "XX = CHPO 'ALEATOIRE' K ; Y = ORTH XX LU LN MS ; "
        "A1 = YTMX Y U1 MS ; A2 = YTMX Y U2 MS ; A0 = YTMX XX U1 MS ; "
    )
    a1, a2, a0 = found(script, "A1", "A2", "A0")
    assert abs(a0) > 1e-3
    assert max(abs(a1), abs(a2)) < 1e-9


# ---- fields


def test_largest_value_becomes_one(found):
    a, b = found(
        LINE + "U = (NOMC 'UX' (X - 7.)) ET (NOMC 'UY' X) ; A = MAX1 U ; "
        "B = MAX1 U 'SANS' (MOTS 'UX') ;",
        "A", "B",
    )  # fmt: skip
    np.testing.assert_allclose(a.components["UX"].values, (AT - 7) / -7)
    assert b.components["UY"].values.max() == 1.0
    assert b.components["UX"].values.min() == -7 / 4


def test_harmonic_at_an_angle(found):
    make = "P = 1. 0. ; U = MANU 'CHPO' P 3 'UR' 3. 'UZ' 2. 'UT' 4. ; V = DFOU U 20. ;"
    for n in (0, 2, -3):
        v = found(f"OPTI DIME 2 MODE FOUR {n} ; " + make, "V").components
        a = np.radians(20 * abs(n))
        even, odd = (np.cos(a), np.sin(a)) if n > 0 else (np.sin(a), np.cos(a))
        even, odd = (1.0, 1.0) if n == 0 else (even, odd)
        seen = [v[k].values[0] for k in ("UR", "UZ", "UT")]
        np.testing.assert_allclose(seen, [3 * even, 2 * even, 4 * odd])


SERIES = (
    LINE
    + "S1 = NOMC 'UX' (SIN (45. * X)) ; S2 = NOMC 'UX' (COS (90. * X)) ; LC = VIDE 'LISTCHPO' ; "
    "REPE B 7 ; T = FLOT &B ; LC = LC ET ((S1 * (SIN (40. * T))) + (S2 * (0.1 * (COS (70. * T))))) "
    "; FIN B ; "
)


def test_decomposition_is_the_singular_one_both_ways(found):
    script = SERIES + (
        "M1 V1 = POD LC 'SNAPSHOTS' 3 ; M2 V2 = POD LC 'CLASSIQUE' 3 ; D = DIME M1 ; "
        "T1 = POD LC (LECT 1 2 3) (MOTS 'UX') 'SNAPSHOTS' 2 'TBAS' L ; "
        "VP = T1 . 'MODES' . 1 . 'VALEUR_PROPRE' ; "
    )
    m1, v1, m2, v2, lc, vp = found(script, "M1", "V1", "M2", "V2", "LC", "VP")
    rows = np.array([f.components["UX"].values for f in lc.values])
    _, s, vectors = np.linalg.svd(rows)
    np.testing.assert_allclose(v1.values, s[:2] ** 2 / 7, rtol=1e-9)  # rank two
    np.testing.assert_allclose(v2.values, v1.values, rtol=1e-9)
    for k in range(2):
        mode = m1.values[k].components["UX"].values
        expected = vectors[k] / vectors[k][np.abs(vectors[k]).argmax()]
        np.testing.assert_allclose(mode, expected, atol=1e-9)
        np.testing.assert_allclose(m2.values[k].components["UX"].values, mode, atol=1e-8)
    first = np.linalg.svd(rows[:3])[1][0]
    assert vp == pytest.approx(first**2 / 3)


def test_decomposition_with_a_mass_is_the_same_both_ways(found):
    script = SERIES + (
        "MO = MODE L MECANIQUE ELASTIQUE BARR ; "
        "MA = MATE MO 'YOUN' 1. 'NU' 0. 'SECT' 1. 'RHO' 1. ; "
        "MS = MASS MO MA ; M1 V1 = POD LC 'SNAPSHOTS' MS 2 ; M2 V2 = POD LC 'CLASSIQUE' MS 2 ; "
        "A = YTMX (EXTR M1 1) (EXTR M1 2) MS ; "
    )
    m1, v1, m2, v2, a = found(script, "M1", "V1", "M2", "V2", "A")
    np.testing.assert_allclose(v2.values, v1.values, rtol=1e-8)
    assert abs(a) < 1e-9
    for one, other in zip(m1.values, m2.values, strict=True):
        np.testing.assert_allclose(
            one.components["UX"].values, other.components["UX"].values, atol=1e-8
        )


def test_a_table_is_decomposed_without_naming_its_entry(found):
    line = "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (2. 0.) ; X = COOR 1 L ; "
    table = "T = TABL ; T . 1 = X ; T . 2 = 2. * X ; M V = POD T 'CLASSIQUE' 1 ; "
    listed = "N W = POD ((SUIT X) ET (2. * X)) 'CLASSIQUE' 1 ;"
    result = "R = TABL ; R . 'DEPL' = TABL ; R . 'VITE' = T ; R . 'DEPL' . 1 = 9. * X ; "
    named = "A B = POD R 'VITE' 'CLASSIQUE' 1 ; C D = POD R 'CLASSIQUE' 1 ;"
    of_table, of_list, chosen, other = found(line + table + listed + result + named, *"VWBD")
    assert of_table.values[0] == of_list.values[0] == chosen.values[0] > 0.0
    assert other.values[0] > 2.0 * chosen.values[0]


@together(
    "mesh, at",
    [
        ("CHAN 'TRI7' (CHAN 'TRI6' S)", "0.3 0.4"),
        ("CHAN 'QUA9' S", "0.3 0.4"),
        ("VOLU (ENVE V)", "0.3 0.4 0.6"),  # TE10 and PY13
        ("CHAN 'CU27' V", "0.3 0.4 0.6"),
        ("CHAN 'TE15' (CHAN 'TE10' V)", "0.3 0.4 0.6"),
    ],
)
def test_projection_reproduces_a_square_in_cells_of_second_degree(found, mesh, at):
    dimension = len(at.split())
    text = "OPTI DIME 2 ELEM QUA8 ; S = (DROI 2 (0 0) (1 0)) TRAN 2 (0 1) ; "
    if dimension == 3:
        text = (
            "OPTI DIME 3 ELEM CU20 ; V = ((DROI 2 (0 0 0) (1 0 0)) TRAN 2 (0 1 0)) VOLU 2 "
            "'TRAN' (0 0 1) ; "
        )
    text += (
        f"P = {at} ; M = {mesh} ; X = NOMC 'T' (COOR 1 M) ; Y = NOMC 'T' (COOR 2 M) ; "
        "C = CHAN 'CHAM' ((X * X) + (X * Y)) M ; V1 = EXTR (PROI (MANU 'POI1' P) C) 'T' P ; "
        "A = MESU M ;"
    )
    value, size = found(text, "V1", "A")
    assert value == pytest.approx(0.3 * 0.3 + 0.3 * 0.4)
    assert size == pytest.approx(1.0)


BRICK = (
    "OPTI DIME 3 MODE TRID ELEM CUB8 ; V = ((DROI 1 (4. 1. 0.5) (5. 1. 0.5)) TRAN 1 (0. 1. 0.)) "
    "VOLU 1 'TRAN' (0. 0. 1.) ; M = MODE V MECANIQUE ELASTIQUE ; "
    "S = MANU 'CHML' M 'SMXX' 3. 'SMYY' -1. 'SMZZ' 2. 'SMXY' 0.5 'SMXZ' 0.7 'SMYZ' -0.4 "
    "'TYPE' 'CONTRAINTES' 'STRESSES' ; O = 0. 0. 0. ; D = 0. 0. 1. ; "
)
SIGMA = np.array([[3.0, 0.5, 0.7], [0.5, -1.0, -0.4], [0.7, -0.4, 2.0]])


def test_stresses_in_the_axes_of_a_torus(found):
    """Large circle of radius 3 at the height 0.25: the axes by hand at one point."""
    values = found(
        BRICK + "T = RTEN S M 'TORI' 'CIRC' O D (0. 3. 0.25) ; X Y Z = COOR T ; "
        "A1 = EXTR X 'SCAL' 1 1 3 ; A2 = EXTR Y 'SCAL' 1 1 3 ; A3 = EXTR Z 'SCAL' 1 1 3 ; "
        "B1 = EXTR T 'SMXX' 1 1 3 ; B2 = EXTR T 'SMYY' 1 1 3 ; B3 = EXTR T 'SMZZ' 1 1 3 ; "
        "B4 = EXTR T 'SMXZ' 1 1 3 ;",
        "A1", "A2", "A3", "B1", "B2", "B3", "B4",
    )  # fmt: skip
    place, stress = np.array(values[:3]), values[3:]
    radial = np.array([place[0], place[1], 0.0]) / np.hypot(place[0], place[1])
    around = np.array([-radial[1], radial[0], 0.0])
    outward = place - (3.0 * radial + [0.0, 0.0, 0.25])
    outward = outward / np.linalg.norm(outward)
    along = np.cross(outward, around)
    seen = [v @ SIGMA @ v for v in (around, along, outward)]
    assert stress == pytest.approx((*seen, around @ SIGMA @ outward), rel=1e-10)


def test_stresses_turned_by_a_field_of_rotations(found):
    """A quarter turn about z, R = [0 -1 0, 1 0 0, 0 0 1]: Rt A R has A22 first."""
    script = (
        BRICK + "X Y Z = COOR V ; "
        "R = GRAD M ((NOMC 'UX' (-1. * Y)) ET (NOMC 'UY' X) ET (NOMC 'UZ' Z)) ; "
        "T = RTEN S M R ; U = RTEN S M R 'RART' ; B = RTEN T M R 'RART' ; "
        "X1 = EXTR T 'SMXX' 1 1 1 ; X2 = EXTR T 'SMXZ' 1 1 1 ; X3 = EXTR U 'SMXZ' 1 1 1 ; "
        "X4 = MAXI 'ABS' (B - S) ;"
    )
    R = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    first, second, third, back = found(script, "X1", "X2", "X3", "X4")
    assert (first, second) == pytest.approx(((R.T @ SIGMA @ R)[0, 0], (R.T @ SIGMA @ R)[0, 2]))
    assert third == pytest.approx((R @ SIGMA @ R.T)[0, 2])
    assert back == pytest.approx(0.0, abs=1e-13)


SHELL = (
    "OPTI DIME 3 MODE TRID ELEM TRI3 ; A = 0. 0. 0. ; B = 3. 0.4 1. ; C = 2.7 2. 1.5 ; "
    "S = (A DROI 3 B) TRAN 2 (C MOIN B) ; M = MODE S MECANIQUE ELASTIQUE DKT ; "
    "MA = MATE M 'YOUN' 10. 'NU' 0.25 'EPAI' 0.5 ; X Y Z = COOR S ; "
    "U = (NOMC 'UX' (0.01 * X)) ET (NOMC 'UY' (0.02 * Y)) ; F = SIGM M MA U ; "
)


def _membrane(first, second):
    """Forces in two axes of the surface, from the strains of space, by hand."""
    e = np.diag([0.01, 0.02, 0.0])
    e1, e2, g = first @ e @ first, second @ e @ second, 2 * first @ e @ second
    stiff = 10.0 * 0.5 / (1 - 0.25**2)
    shear = 10.0 * 0.5 / (2 * 1.25)
    return stiff * (e1 + 0.25 * e2), stiff * (e2 + 0.25 * e1), shear * g


def _axes():
    """The shell's normal, and the vector (0.2 1 0) in its plane."""
    normal = np.cross([3.0, 0.4, 1.0], [-0.3, 1.6, 0.5])
    normal = normal / np.linalg.norm(normal)
    first = np.array([0.2, 1.0, 0.0])
    first = first - (first @ normal) * normal
    first = first / np.linalg.norm(first)
    return normal, first


@pytest.mark.parametrize(
    ("vectors", "side"),
    [("(0.2 1. 0.)", 1.0), ("(0.2 1. 0.) (1. 0. 0.)", -1.0)],
    ids=["one", "two"],
)
def test_membrane_forces_of_shells_along_a_vector(found, vectors, side):
    """The triangles differ in their own axes, the forces along the vector do not."""
    normal, first = _axes()
    values = found(
        SHELL + f"R = RTEN F M {vectors} ; X1 = MAXI (EXCO 'N11' R) ; X2 = MINI (EXCO 'N11' R) ; "
        "X3 = MAXI (EXCO 'N22' R) ; X4 = MAXI (EXCO 'N12' R) ; X5 = MINI (EXCO 'N12' R) ;",
        "X1", "X2", "X3", "X4", "X5",
    )  # fmt: skip
    one, two, shear = _membrane(first, side * np.cross(normal, first))
    assert values == pytest.approx((one, one, two, shear, shear), rel=1e-9)


@pytest.mark.parametrize(("cell", "element"), [("QUA8", "COQ8"), ("TRI6", "COQ6")])
def test_stresses_of_thick_shells_in_axes_of_their_surface(found, cell, element):
    """A plate across x, stretched and bent along z: cells differ in their own axes."""
    values = found(
        f"OPTI DIME 3 MODE TRID ELEM {cell} ; A = 0. 0. 0. ; B = 0. 2. .3 ; C = 0. 1.7 1.5 ; "
        "D = 0. -.2 1. ; S = DALL (A DROI 2 B) (B DROI 1 C) (C DROI 2 D) (D DROI 1 A) 'PLAN' ; "
        "X Y Z = COOR S ; M = MODE (S ET (INVE (S PLUS (0. 5. 0.)))) MECANIQUE ELASTIQUE "
        f"{element} ; G = MATE M 'YOUN' 2.E4 'NU' .3 'EPAI' .1 ; X Y Z = COOR (EXTR M 'MAIL') ; "
        "U = (NOMC 'UY' ((1.E-3 * Y) + (4.E-4 * Z))) + (NOMC 'UZ' ((2.E-4 * Y) - (5.E-4 * Z))) + "
        "(NOMC 'UX' (1.E-2 * Z * Z)) + (NOMC 'RY' (2.E-2 * Z)) ; T = SIGM M G U ; "
        "R = RTEN T M G (0. 0. 1.) (0. 1. 0.) ; X1 = MAXI (EXCO 'SMSS' R) ; "
        "X2 = MINI (EXCO 'SMSS' R) ; X3 = MAXI (EXCO 'SMST' R) ; X4 = MINI (EXCO 'SMST' R) ; "
        "O = CHAN 'CHAM' (NOMC 'SCAL' ((Y * 0.) + 1.)) M 'STRESSES' 'SCALAIRE' ; "
        "X5 = INTG M O ; X6 = INTG M O G ; X7 = MESU (EXTR M 'MAIL') ;",
        *(f"X{i}" for i in range(1, 8)),
    )  # fmt: skip
    E, area = 2e4 / 0.91, values[-1]
    middle, bent = E * (-5e-4 + 0.3 * 1e-3), E * 2e-2 * 0.05 / np.sqrt(3)
    shear = 2e4 / 2.6 * 6e-4
    expected = (middle + bent, middle - bent, shear, shear, area, 0.1 * area)
    assert values[:-1] == pytest.approx(expected, rel=1e-9)


def test_strains_of_shells_turn_as_tensors(found):
    shear, largest = found(
        SHELL + "E = RTEN (EPSI M MA U) M (1. 0. 0.) ; T = RTEN (EPSI M MA U) M (-1. 0. 0.) ; "
        "X1 = MAXI 'ABS' (E - T) ; X2 = MAXI (EXCO 'EPSS' (RTEN (EPSI M MA U) M (0.2 1. 0.))) ;",
        "X1", "X2",
    )  # fmt: skip
    _, first = _axes()
    assert shear == pytest.approx(0.0, abs=1e-14)
    assert largest == pytest.approx(first @ np.diag([0.01, 0.02, 0.0]) @ first)


def ring_levers(factors=None, bend=0.0):
    """Stress of each force of a ring 0.9 to 1.1, with the factors of straight pipes or bends."""
    area, inertia = np.pi * (1.1**2 - 0.9**2), np.pi / 4 * (1.1**4 - 0.9**4)
    flat = 0.2 * bend / 1.0**2
    bending = np.pi / 4 * (max(1.0, 8 / 9 / flat ** (2 / 3)) if bend else 1.0)
    n, mx, my, mz = factors or (1.0, 3**0.5, bending, bending)
    return {
        "EFFX": n / area,
        "MOMX": mx / (2 * inertia),
        "MOMY": my / inertia,
        "MOMZ": mz / inertia,
    }


SECTION = "SECT 2. INRY 3. INRZ 5. TORS 7. DX 1.1 DY 1.3 DZ 1.7"
RING = "EPAI 0.2 RAYO 1.1"


@together(
    "element, given, levers",
    [
        ("BARR", "SECT 2.", {"EFFX": 0.5}),
        ("POUT", SECTION, {"EFFX": 1 / 2, "MOMX": 1.1 / 7, "MOMY": 1.7 / 3, "MOMZ": 1.3 / 5}),
        ("TIMO", SECTION, {"EFFX": 1 / 2, "MOMX": 1.1 / 7, "MOMY": 1.7 / 3, "MOMZ": 1.3 / 5}),
        ("POUT", SECTION.replace("DY 1.3", ""), {"EFFX": 1 / 2, "MOMX": 1.1 / 7, "MOMY": 1.7 / 3}),
        ("TUYA", RING, ring_levers()),
        ("TUYA", RING + " RACO 3.", ring_levers(bend=3.0)),
        ("TUYA", RING + " CFFX 1.5 CFMX 2. CFMY 1.2 CFMZ 0.7", ring_levers((1.5, 2.0, 1.2, 0.7))),
    ],
)  # fmt: skip
def test_equivalent_stress_of_a_line_is_the_root_of_its_sections_squares(
    found, element, given, levers
):
    forces = {"EFFX": 4.0, "MOMX": 3.0, "MOMY": -2.0, "MOMZ": 5.0}
    for which in (*levers, None):  # each alone, and all of them
        said = " ".join(f"{k} {v}" for k, v in forces.items() if k in levers and which in (k, None))
        script = (
            "OPTI DIME 3 ELEM SEG2 ; L = DROI 2 (0 0 0) (2 1 0) ; "
            f"M = MODE L MECANIQUE ELASTIQUE {element} ; A = MATE M YOUN 1. NU 0.3 {given} ; "
            f"S = MANU 'CHML' M {said} 'TYPE' 'CONTRAINTES' 'STRESSES' ; "
            "V = VMIS M S A ; X = MAXI V ; Y = MINI V ;"
        )
        wanted = sum((forces[k] * v) ** 2 for k, v in levers.items() if which in (k, None)) ** 0.5
        assert found(script, "X", "Y") == pytest.approx((wanted, wanted))
