"""BALOURD: a mass on bearings turning about x, solved by hand."""

import numpy as np
import pytest
from script_runs import ran

from ssilang.cli.run import run_text
from ssilang.language.values import Mot

MASS, KY, KZ, DAMPING, COUPLING, ROTATING = 4.0, 400.0, 900.0, 6.0, 0.3, 0.8
SPEEDS = np.array([5.0, 9.5, 14.0])
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

    u = np.array([exact(w, -1 if way == "axis" else 1) for w in SPEEDS])
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
