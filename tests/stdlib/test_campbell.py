"""A mass on bearings, a disc on a shaft: BALOURD and CAMPBELL against closed forms."""

import numpy as np
import pytest
from script_runs import found, ran

from ssilang.cli.run import run_text
from ssilang.language.values import Mot

INERTIA, POLAR, STIFFNESS = 2.0, 3.0, 800.0
SPEEDS = np.array([0.0, 10.0, 40.0])
DISC = (
    "OPTI DIME 3 ; P1 = 0. 0. 0. ; N = MOTS 'RX' 'RY' ; T = TABL ;"
    f"K1 = APPU 'RX' 'RY' {STIFFNESS} P1 ; M1 = MASS 'RX' 'RY' {INERTIA} P1 ;"
    f"G1 = MANU 'RIGI' 'TYPE' 'AMORTISS' P1 N 'ANTI' (PROG 0. {POLAR} 0.) ;"
    "B1 = VIBR 'SIMU' 1. 2 K1 M1 ; T . 'MASSE' = M1 ; T . 'RIGIDITE' = K1 ;"
)


def rows(script):
    table = found(script, "T")
    return [table.get(i) for i in (1, 2, 3, 4)]


def ordinates(row, name):
    from ssilang.language.values import Mot

    return np.asarray(row.get(Mot(name)).parts[0].ordinates)


BY_BASIS = "T . 'BASE_MODALE' = B1 ; T . 'GYROSCOPIQUE' = G1 ;"
PROJECTED = (
    "T . 'BASE_MODALE' = B1 ; T . 'GYRO_PROJ' = 0.75 * (PJBA B1 G1) ; "
    "T . 'CORI_PROJ' = 0.25 * (PJBA B1 G1) ; T . 'MASS_PROJ' = PJBA B1 M1 ; "
    "T . 'RIGI_PROJ' = PJBA B1 K1 ; T . 'MASSE' = 9. * M1 ; T . 'RIGIDITE' = 9. * K1 ;"
)
AT_EACH_SPEED = "T . 'NMODES' = 2 ; T . 'FREQ_PROCHE' = 1. ; T . 'GYROSCOPIQUE' = G1 ;"


@pytest.mark.parametrize("way", [BY_BASIS, PROJECTED, AT_EACH_SPEED])
def test_gyroscopic_coupling_splits_the_frequencies(way):
    found = rows(DISC + way + "CAMPBELL T (PROG 0. 10. 40.) ;")
    half = SPEEDS * POLAR / INERTIA / 2
    root = np.sqrt(half**2 + STIFFNESS / INERTIA)
    exact = np.array([-root - half, -root + half, root - half, root + half]) / (2 * np.pi)
    for row, frequencies in zip(found, exact, strict=True):
        np.testing.assert_allclose(ordinates(row, "FREQUENCE_REELLE"), frequencies, rtol=1e-8)
        np.testing.assert_allclose(ordinates(row, "FREQUENCE_IMAGINAIRE"), 0, atol=1e-8)
        np.testing.assert_allclose(ordinates(row, "FREQUENCE_MODULE"), np.abs(frequencies))


@pytest.mark.parametrize("projected", [False, True])
def test_rotating_damping_makes_the_shaft_unstable(projected):
    """With damping c and the circulation w c, decay turns to growth above w = sqrt(k/m)."""
    script = (
        DISC
        + BY_BASIS.replace("T . 'GYROSCOPIQUE' = G1 ;", "")
        + (
            "C1 = 0.004 ; T . 'AMORTISSEMENT' = CHAN 'TYPE' (K1 * C1) 'AMORTISS' ;"
            f"T . 'KROTATIF' = MANU 'RIGI' P1 N 'ANTI' (PROG 0. {0.004 * STIFFNESS} 0.) ;"
            + projected
            * (
                "T . 'AMOR_PROJ' = PJBA B1 (T . 'AMORTISSEMENT') ; "
                "T . 'KROT_PROJ' = PJBA B1 (T . 'KROTATIF') ; T . 'KROTATIF' = 9. * K1 ; "
            )
            + "CAMPBELL T (PROG 0. 19. 21.) ;"
        )
    )
    least = np.min([ordinates(row, "AMORTISSEMENT") for row in rows(script)], axis=0)
    assert least[0] == pytest.approx(0.004 * 20 / 2)
    assert least[1] > 0 > least[2]


@pytest.mark.parametrize(
    "way",
    [
        AT_EACH_SPEED.replace("T . 'GYROSCOPIQUE' = G1 ;", "")
        + "T . 'KCENT' = K1 * -1.E-4 ; T . 'KSIGMA' = K1 * 3.E-4 ; ",
        "T . 'BASE_MODALE' = B1 ; T . 'KCEN_PROJ' = PJBA B1 (K1 * -1.E-4) ; "
        "T . 'KSIG_PROJ' = PJBA B1 (K1 * 3.E-4) ; ",
    ],
)
def test_centrifugal_stiffness_goes_with_the_square_of_the_speed(way):
    script = DISC + way + "CAMPBELL T (PROG 0. 10. 40.) ;"
    exact = np.sqrt(STIFFNESS / INERTIA * (1 + 2e-4 * SPEEDS**2)) / (2 * np.pi)
    np.testing.assert_allclose(ordinates(rows(script)[3], "FREQUENCE_REELLE"), exact)


PLANE = DISC.replace("'RX' 'RY'", "'UX' 'UY'")


@pytest.mark.parametrize("axis", [1.0, -1.0])
def test_forward_and_backward_whirl_are_told_apart(axis):
    """z = x + i y of m z'' - i a w z' + k z = 0 turns at (a w +- sqrt(a^2 w^2 + 4 k m)) / 2 m."""
    found = rows(
        PLANE + f"{BY_BASIS} T . 'CLASSEMENT' = VRAI ; T . 'AXE_DIRECT' = 0. 0. {axis} ; "
        "CAMPBELL T (PROG 10. 40.) ; "
    )
    sign = np.sign(
        run_text(PLANE + "V = EXTR (G1 * (MANU 'CHPO' P1 1 'UX' 1.)) 'FY' P1 ;").session.root.find(
            "V"
        )
    )
    half = -sign * SPEEDS[1:] * POLAR / INERTIA / 2  # [0 a; -a 0]: a in the row of x is positive
    root = np.sqrt(half**2 + STIFFNESS / INERTIA)
    turning = axis * np.array([half + root, half - root]) / (2 * np.pi)
    low, high = np.sort(turning, axis=0)
    for row, frequencies in zip(found, [low, low, high, high], strict=True):
        np.testing.assert_allclose(ordinates(row, "FREQUENCE_REELLE"), frequencies, rtol=1e-8)


MASS, KY, KZ, DAMPING, COUPLING, ROTATING = 4.0, 400.0, 900.0, 6.0, 0.3, 0.8
PULSATIONS = np.array([5.0, 9.5, 14.0])
ROTOR = (
    "OPTI DIME 3 ; P1 = 0. 0. 0. ; N = MOTS 'UY' 'UZ' ; T = TABL ;"
    f"K1 = (APPU 'UY' {KY} P1) ET (APPU 'UZ' {KZ} P1) ; M1 = MASS 'UY' 'UZ' {MASS} P1 ;"
    f"T . 'RIGIDITE' = K1 ; T . 'MASSE' = M1 ;"
    f"T . 'AMORTISSEMENT' = CHAN 'TYPE' (APPU 'UY' 'UZ' {DAMPING} P1) 'AMORTISS' ;"
    f"T . 'GYROSCOPIQUE' = MANU 'RIGI' 'TYPE' 'AMORTISS' P1 N 'ANTI' (PROG 0. {COUPLING} 0.) ;"
    f"T . 'KROTATIF' = MANU 'RIGI' P1 N 'ANTI' (PROG 0. {ROTATING} 0.) ;"
    "R = TABL ; T . 'REPONSE' = R ; R . 1 = TABL ; R . 1 . 'POINT' = P1 ; LW = PROG 5. 9.5 14. ;"
)
WAYS = {
    "physical": "T . 'FBALOURD' = FORC 'FY' 2.E-3 P1 ;",
    "parts": "T . 'FBALREEL' = FORC 'FY' 2.E-3 P1 ; T . 'FBALIMAG' = FORC 'FZ' -2.E-3 P1 ;",
    "axis": "T . 'FBALOURD' = FORC 'FY' 2.E-3 P1 ; T . 'VROTATION' = MANU 'CHPO' P1 1 'RX' -1. ;",
    "modes": "T . 'FBALOURD' = FORC 'FY' 2.E-3 P1 ; T . 'BASE_MODALE' = VIBR 'SIMU' 1. 2 K1 M1 ;",
    "projected": "B = VIBR 'SIMU' 1. 2 K1 M1 ; T . 'BASE_MODALE' = B ; "
    "T . 'FBAR_PROJ' = PJBA B (FORC 'FY' 2.E-3 P1) ; "
    "T . 'FBAI_PROJ' = PJBA B (FORC 'FZ' -2.E-3 P1) ; "
    + "".join(
        f"T . '{name[:4]}_PROJ' = PJBA B (T . '{name}') ; T . '{name}' = 9. * (T . '{name}') ; "
        for name in ("RIGIDITE", "MASSE", "AMORTISSEMENT", "GYROSCOPIQUE", "KROTATIF")
    ),
}


def sign_of_coupling():
    """Row y, column z of MANU 'RIGI' 'ANTI' (PROG 0. a 0.), read from the matrix itself."""
    result = run_text(ROTOR + "F = (T . 'KROTATIF') * (MANU 'CHPO' P1 2 'UY' 0. 'UZ' 1.) ;")
    field = result.session.root.find("F")
    point = result.session.root.find("P1")
    return field.values_at("FY", np.array([point.node]))[0] / ROTATING


def exact(w, sense=1):
    a = sign_of_coupling() * np.array([[0, 1], [-1, 0]])
    stiffness = np.diag([KY, KZ]) + w * ROTATING * a - w**2 * MASS * np.eye(2)
    damping = DAMPING * np.eye(2) + w * COUPLING * a
    return np.linalg.solve(stiffness + 1j * w * damping, w**2 * 2e-3 * np.array([1, -1j * sense]))


@pytest.mark.parametrize("way", WAYS)
def test_answer_of_a_mass_on_bearings(way):
    result = ran(ROTOR + WAYS[way] + "T . 'SAUVDEFO' = VRAI ; BALOURD T LW ;")
    table = result.session.root.find("R").get(1)

    def ordinates(name):
        return np.asarray(table.get(Mot(name)).parts[0].ordinates)

    u = np.array([exact(w, -1 if way == "axis" else 1) for w in PULSATIONS])
    found = ordinates("UYREEL") + 1j * ordinates("UYIMAG")
    np.testing.assert_allclose(found, u[:, 0], rtol=1e-8)
    np.testing.assert_allclose(ordinates("UZ"), np.abs(u[:, 1]), rtol=1e-8)
    t = np.linspace(0, 2 * np.pi, 20001)
    path = (u[:, :, None] * np.exp(1j * t)).real
    radius = np.linalg.norm(path, axis=1)
    np.testing.assert_allclose(ordinates("GAXE"), radius.max(axis=1), rtol=1e-6)
    np.testing.assert_allclose(ordinates("PAXE"), radius.min(axis=1), rtol=1e-5)
    furthest = path[np.arange(len(u)), :, radius.argmax(axis=1)]
    axis = np.degrees(np.arctan2(furthest[:, 1], furthest[:, 0]))
    off = (ordinates("ANGLEGAXE") - axis + 90.0) % 180.0 - 90.0  # an axis has no sense
    np.testing.assert_allclose(off, 0.0, atol=0.1)
    saved = result.session.root.find("T").get(Mot("SAUVDEFO")).get(2)
    assert saved.get(Mot("FREQROTA")) == 9.5
