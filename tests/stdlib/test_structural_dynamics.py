"""CINIMOD NEWMARK M_DAMPIN M_DAMP_K TRANSFER FRONABS FLAMBAGE against closed forms."""

import itertools

import numpy as np
import pytest
from script_runs import found
from together import together

TWO_MASSES = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P1 = 0. 0. ; P2 = 1. 0. ; P3 = 2. 0. ;"
    "G1 = MANU 'SEG2' P1 P2 ; G2 = MANU 'SEG2' P2 P3 ;"
    "E1 = MOTS 'UX' ; K1 = (MANU 'RIGI' G1 E1 (PROG 900. -900. 900.)) ET "
    "(MANU 'RIGI' G2 E1 (PROG 400. -400. 400.)) ET (BLOQ 'UX' P1) ;"
    "M1 = (MASS 'UX' 3. P2) ET (MASS 'UX' 2. P3) ;"
    "T1 = VIBR 'SIMU' 1. 2 K1 M1 ;"
)
K = np.array([[1300.0, -400], [-400, 400]])
M = np.diag([3.0, 2.0])


def test_newmark_step_is_that_of_average_acceleration():
    dt, c = 0.05, 0.004
    values = found(
        TWO_MASSES
        + f"DT = {dt} ; C1 = {c} * (EXTR K1 'RIGI' 'NOMU') ;"
        "KD = K1 ET (C1 * (2. / DT)) ET (M1 * (4. / DT / DT)) ;"
        "U = MANU 'CHPO' (P1 ET P2 ET P3) 1 'UX' (PROG 0. 0.1 0.3) ;"
        "V = MANU 'CHPO' (P1 ET P2 ET P3) 1 'UX' (PROG 0. -2. 1.) ;"
        "F0 = MANU 'CHPO' P3 1 'FX' 7. 'NATURE' 'DISCRET' ; F1 = F0 * 2. ;"
        "REPE B 3 ; U V = NEWMARK U V KD K1 M1 F0 F1 DT ; F0 = F1 ; FIN B ;"
        "A = EXTR U 'UX' P2 ; B = EXTR U 'UX' P3 ; C = EXTR V 'UX' P2 ; D = EXTR V 'UX' P3 ;",
        "A", "B", "C", "D",
    )  # fmt: skip
    u, v = np.array([0.1, 0.3]), np.array([-2.0, 1])
    damping = c * K
    forces = [np.array([0, 7.0]), np.array([0, 14.0]), np.array([0, 14.0]), np.array([0, 14.0])]
    for before, after in itertools.pairwise(forces):
        a = np.linalg.solve(M, before - damping @ v - K @ u)
        left = M + dt / 2 * damping + dt**2 / 4 * K
        right = after - damping @ (v + dt / 2 * a) - K @ (u + dt * v + dt**2 / 4 * a)
        new = np.linalg.solve(left, right)
        u = u + dt * v + dt**2 / 4 * (a + new)
        v = v + dt / 2 * (a + new)
    np.testing.assert_allclose(values, (*u, *v), rtol=1e-9)


def test_modal_damping_gives_each_mode_its_own():
    script = TWO_MASSES + "C1 = M_DAMPIN T1 (PROG 2. 7.) K1 ; C2 = M_DAMP_K T1 (PROG 2. 7.) K1 ;"
    names = [f"{c}{i}" for c in "XY" for i in (1, 2)] + ["X12", "Y12"]
    for i in (1, 2):
        script += f"F{i} = T1 . 'MODES' . {i} . 'DEFORMEE_MODALE' ;"
        script += f"D{i} = 4. * PI * (T1 . 'MODES' . {i} . 'FREQUENCE')"
        script += f" * (T1 . 'MODES' . {i} . 'MASSE_GENERALISEE') ;"
        script += f"X{i} = (XTMX F{i} C1) / D{i} ; Y{i} = (XTMX F{i} C2) / D{i} ;"
    script += "X12 = YTMX F1 F2 C1 ; Y12 = YTMX F1 F2 C2 ;"
    values = found(script, *names)
    np.testing.assert_allclose(values[:4], (0.02, 0.07) * 2, rtol=1e-9)
    np.testing.assert_allclose(values[4:], 0, atol=1e-9)


def test_modes_left_out_are_damped_by_stiffness_only_with_m_damp_k():
    script = TWO_MASSES + (
        "C1 = M_DAMPIN T1 (PROG 2.) K1 ; C2 = M_DAMP_K T1 (PROG 2.) K1 ;"
        "F2 = T1 . 'MODES' . 2 . 'DEFORMEE_MODALE' ; W1 = T1 . 'MODES' . 1 . 'FREQUENCE' ;"
        "W2 = T1 . 'MODES' . 2 . 'FREQUENCE' ; G2 = T1 . 'MODES' . 2 . 'MASSE_GENERALISEE' ;"
        "X = XTMX F2 C1 ; Y = (XTMX F2 C2) / (4. * PI * W2 * G2) ;"
    )
    x, y, w1, w2 = found(script, "X", "Y", "W1", "W2")
    assert x == pytest.approx(0, abs=1e-9)
    assert y == pytest.approx(0.02 * w2 / w1)


def direct(f, force, ground=False):
    """Answer of the two masses, modal damping (2, 7) per cent, by solving the full system."""
    squares, shapes = np.linalg.eig(np.linalg.solve(M, K))
    order = np.argsort(squares)
    squares, shapes = squares[order], shapes[:, order]
    w = np.sqrt(squares)
    masses = np.diag(shapes.T @ M @ shapes)
    damping = M @ shapes @ np.diag(2 * np.array([0.02, 0.07]) * w / masses) @ shapes.T @ M
    p = 2j * np.pi * f
    return np.linalg.solve(p**2 * M + p * damping + K, -M @ np.ones(2) if ground else force)


@together("word, power", [("DEPL", 0), ("VITE", 1), ("ACCE", 2)])
def test_transfer_function_to_a_force(word, power):
    e, m = found(
        TWO_MASSES + f"E = TRANSFER T1 (PROG 0.02 0.07) 'UX' P3 'UX' P2 '{word}' "
        f"(PROG 1. 2.5 6.) 'REIM' ; M = TRANSFER T1 (PROG 0.02 0.07) 'UX' P3 'UX' P2 '{word}' "
        "(PROG 1. 2.5 6.) 'MOPH' 'ROUG' ;",
        "E", "M",
    )  # fmt: skip
    exact = np.array([(2j * np.pi * f) ** power * direct(f, [0, 1.0])[0] for f in (1, 2.5, 6)])
    value = np.asarray(e.parts[0].ordinates) + 1j * np.asarray(e.parts[1].ordinates)
    np.testing.assert_allclose(value, exact, rtol=1e-9)
    polar = np.asarray(m.parts[0].ordinates) * np.exp(
        1j * np.radians(np.asarray(m.parts[1].ordinates))
    )
    np.testing.assert_allclose(polar, exact, rtol=1e-9)


def test_transfer_function_to_the_ground_is_absolute_in_acceleration():
    d, a = found(
        TWO_MASSES
        + "D = TRANSFER T1 (PROG 0.02 0.07) 'SEISME' 'UX' 'UX' P3 'DEPL' (PROG 0. 2.) 'REIM' ;"
        "A = TRANSFER T1 (PROG 0.02 0.07) 'SEISME' 'UX' 'UX' P3 'ACCE' (PROG 0. 2.) 'REIM' ;",
        "D", "A",
    )  # fmt: skip
    relative = direct(2.0, None, ground=True)[1]
    assert d.parts[0].ordinates[1] == pytest.approx(relative.real)
    assert d.parts[1].ordinates[1] == pytest.approx(relative.imag)
    absolute = 1 - (4 * np.pi) ** 2 * relative
    np.testing.assert_allclose(a.parts[0].ordinates, (1, absolute.real), rtol=1e-9)
    np.testing.assert_allclose(a.parts[1].ordinates, (0, absolute.imag), atol=1e-9)


SOIL = (
    "T = TABL ; T . 'MASSE_VOLUMIQUE' = 2000. ; T . 'POISSON' = 0.25 ; T . 'YOUNG' = 5.E8 ;"
    "T . 'FRONTIERE' = L ;"
)
SHEAR = np.sqrt(2e8 * 2000)
PRIMARY = np.sqrt(6e8 * 2000)


@together("element", ["SEG2", "SEG3"])
def test_dampers_of_a_wall_and_of_a_base(element):
    values = found(
        f"OPTI DIME 2 MODE PLAN DEFO ELEM {element} ;"
        "LA = DROI 3 (5. 0.) (5. 4.) ; LB = DROI 2 (5. 4.) (2. 4.) ; L = LA ET LB ;"
        + SOIL
        + "C = FRONABS T ; U = MANU 'CHPO' L 2 'UX' 1. 'UY' 0. ; F = C * U ;"
        "FX = MAXI (RESU (EXCO 'FX' F)) ; G = C * (MANU 'CHPO' L 2 'UX' 0. 'UY' 1.) ;"
        "GY = MAXI (RESU (EXCO 'FY' G)) ; H = MAXI (ABS (EXCO 'FY' F)) ; E = VALE 'ELEM' ;",
        "FX", "GY", "H", "E",
    )  # fmt: skip
    assert values[0] == pytest.approx(4 * PRIMARY + 3 * SHEAR)
    assert values[1] == pytest.approx(4 * SHEAR + 3 * PRIMARY)
    assert values[2] == pytest.approx(0, abs=1e-6 * SHEAR)
    assert str(values[3]) == element


def test_shear_wave_leaves_a_column_through_its_boundary():
    """A column shaken at its top by a short pulse is at rest once the wave is gone."""
    script = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM QUA8 ; L0 = DROI 1 (0. 0.) (1. 0.) ;"
        "S = TRAN 40 L0 (0. -20.) ; L = COTE 3 S ; MO = MODE S 'MECANIQUE' 'ELASTIQUE' ;"
        "MA = MATE MO 'YOUN' 5.E8 'NU' 0.25 'RHO' 2000. ;"
        + SOIL
        + "C = FRONABS T ; LT = PROG 0. PAS 0.001 0.15 ;"
        "LF = (1. - (COS (LT * (360. / 0.03)))) * (LT MASQ 'INFERIEUR' 0.03) ;"
        "D = TABL ; D . 'RIGI' = (RIGI MO MA) ET (BLOQ 'UY' S) ; D . 'MASS' = MASS MO MA ;"
        "D . 'AMOR' = C ; D . 'TEMPS_CALCULES' = LT ; D . 'PAS_SAUVES' = 'TOUS' ;"
        "D . 'CHAR' = CHAR 'MECA' (FORC (1.E6 0.) (POIN 1 L0)) (EVOL 'MANU' LT LF) ;"
        "R = DYNAMIC D ; VM = 0. ; REPE B 151 ; V = ABS (EXTR (R . &B . 'VITE') 'UX' (POIN 1 L)) ;"
        "SI (V > VM) ; VM = V ; FINSI ; FIN B ;"
        "VF = MAXI (ABS (EXCO 'UX' (R . 151 . 'VITE'))) ;"
    )
    largest, left = found(script, "VM", "VF")
    assert largest == pytest.approx(2e6 / SHEAR, rel=0.02)
    assert left < 0.01 * largest


@pytest.mark.parametrize("count", [3, 2])
def test_coordinates_of_a_motion_on_modes(count):
    """Three masses in a row: all modes give the motion back, two its nearest in mass."""
    k, m, u = np.array([900.0, 700.0, 500.0]), np.array([2.0, 1.5, 1.0]), np.array([0.3, -0.2, 0.7])
    chain = "OPTI DIME 2 ELEM SEG2 ; P0 = 0. 0. ; " + " ".join(
        f"P{i + 1} = {i + 1}. 0. ; E = MANU 'SEG2' P{i} P{i + 1} ; "
        f"K{i} = MANU 'RIGIDITE' E (MOTS 'UX') (PROG {k[i]} {-k[i]} {k[i]}) ; "
        f"M{i} = MANU 'RIGIDITE' 'TYPE' 'MASSE' P{i + 1} (MOTS 'UX') (PROG {m[i]}) ; "
        f"U{i} = MANU 'CHPO' P{i + 1} 1 'UX' {u[i]} 'NATURE' 'DIFFUS' ; "
        for i in range(3)
    )
    chain += (
        "K = K0 ET K1 ET K2 ET (BLOQ 'UX' P0) ; M = M0 ET M1 ET M2 ; "
        f"B = VIBR 'SIMUL' 0.5 {count} K M ; Q = CINIMOD B M (U0 ET U1 ET U2) ; U = RECO Q B ; "
        "X1 = EXTR U 'UX' P1 ; X2 = EXTR U 'UX' P2 ; X3 = EXTR U 'UX' P3 ; "
    )
    values = found(chain, "X1", "X2", "X3")
    stiffness = np.diag(k) + np.diag([*k[1:], 0.0]) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    _, modes = np.linalg.eigh(stiffness / np.sqrt(np.outer(m, m)))
    modes = (modes / np.sqrt(m)[:, None])[:, :count]  # of unit mass
    nearest = modes @ (modes.T @ (m * u))
    np.testing.assert_allclose(values, nearest, rtol=1e-6)
    assert (np.abs(nearest - u).max() < 1e-9) == (count == 3)
