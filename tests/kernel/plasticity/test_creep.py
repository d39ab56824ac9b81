"""Norton's creep: constant and relaxing stresses, steps, tangents."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.materials.plastic.creep import norton
from ssilang.kernel.materials.plastic.response import PointParameters

SQUARE = """
OPTI DIME 2 MODE {mode} ELEM QUA4 ;
L = DROI 1 (0. 0.) (1. 0.) ; S = L TRAN 1 (0. 1.) ; LX = COTE S 4 ; LR = COTE S 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'FLUAGE' 'NORTON' ;
MA = MATE MO 'YOUN' 1.E5 'NU' 0.3 'AF1' {a} 'AF2' {n} 'AF3' {m} 'SMAX' 100. ;
B = (BLOQ 'UX' LX) ET (BLOQ 'UY' (POIN LX 1)) ; BR = BLOQ 'UX' LR ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ; T . 'TEMPS_CALCULES' = {times} ;
"""
HELD = """
T . 'BLOCAGES_MECANIQUES' = B ET BR ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI BR 1.E-3)
  (EVOL 'MANU' (PROG 0. 1.E-6 1.E6) (PROG 0. 1. 1.)) ;
PASAPAS T ;
"""
PULLED = """
T . 'BLOCAGES_MECANIQUES' = B ;
T . 'CHARGEMENT' = CHAR 'MECA' (PRES 'MASS' MO LR -50.)
  (EVOL 'MANU' (PROG 0. 1.E-6 1.E6) (PROG 0. 1. 1.)) ;
PASAPAS T ;
"""
TIMES = "PROG 0. 1.E-6 1. 3. 10."


def run(text, tmp_path, **words):
    words = {"mode": "PLAN CONT", "times": TIMES, "a": "1.E-7", "n": "2.", "m": "0.5", **words}
    return ran(text.format(**words), output_directory=tmp_path).session.root.find


@pytest.mark.parametrize(("power", "age"), [(2.0, 0.5), (2.0, 1.2), (1.0, 1.0), (1.5, 0.8)])
def test_a_constant_stress_creeps_by_the_law_whatever_the_steps(power, age, tmp_path):
    find = run(SQUARE + PULLED, tmp_path, a=1e-7 * 50.0 ** (2.0 - power), n=power, m=age)
    for number, time in ((2, 1.0), (4, 10.0)):
        found = find("T").get("VARIABLES_INTERNES").get(number).blocks[0].components["EPSE"]
        assert found == pytest.approx(1e-7 * 50.0**2 * time**age, rel=1e-3)
        moved = find("T").get("DEPLACEMENTS").get(number).components["UX"].values.max()
        assert moved == pytest.approx(50.0 / 1e5 + 1e-7 * 50.0**2 * time**age, rel=1e-3)
    strains = find("T").get("DEFORMATIONS_INELASTIQUES").get(4).blocks[0].components
    assert strains["EIYY"] == pytest.approx(-0.5 * strains["EIXX"], rel=1e-6)


def test_relaxation_converges_with_the_step(tmp_path):
    # AF3 = 1: E A q^n = -q'  ->  q^(1-n) = q0^(1-n) + (n-1) E A t
    exact = (100.0**-2 + 2 * 1e5 * 1e-8 * 2.0) ** -0.5
    errors = []
    for step in (0.2, 0.1, 0.05):
        times = f"(PROG 0. 1.E-6) ET (PROG {step} 'PAS' {step} 2.)"
        find = run(SQUARE + HELD, tmp_path, times=times, a="1.E-8", n="3.", m="1.")
        last = len(find("T").get("TEMPS").items()) - 1
        stress = find("T").get("CONTRAINTES").get(last).blocks[0].components["SMXX"]
        errors.append(abs(stress.max() - exact))
    assert errors[0] > 1.7 * errors[1] > 1.7**2 * errors[2]
    assert errors[2] < 0.04 * exact


@together("age", [0.6, 1.2, 2.5])
def test_the_tangent_is_the_derivative(age):
    rng = np.random.default_rng(1)
    m = 4
    values = {"YOUN": 1e5, "NU": 0.3, "AF1": 1e-7, "AF2": 2.5, "AF3": age, "DT": 2.0}
    parameters = PointParameters({k: np.full(m, v) for k, v in values.items()}, {})
    stress, strain = 50 * rng.normal(size=(m, 6)), 1e-3 * rng.normal(size=(m, 6))
    before = np.array([[0.0], [1e-4], [1e-3], [1e-2]])
    found = norton(parameters, stress, strain, before)
    for j in range(6):
        h = np.zeros(6)
        h[j] = 1e-8
        slopes = [norton(parameters, stress, strain + s * h, before).stress for s in (1, -1)]
        np.testing.assert_allclose(
            found.tangent[:, :, j], (slopes[0] - slopes[1]) / 2e-8, rtol=1e-5, atol=1.0
        )


def test_a_calculation_goes_on(tmp_path):
    again = "T2 = COPI T ; T2 . 'REPRISE' = 1. ; PASAPAS T2 ;"
    find = run(SQUARE + HELD + again, tmp_path, mode="PLAN DEFO")
    first, second = (
        find(n).get("CONTRAINTES").get(4).blocks[0].components["SMXX"] for n in ("T", "T2")
    )
    assert second == pytest.approx(first, rel=1e-9)
    assert (
        first.max() < 0.9 * find("T").get("CONTRAINTES").get(1).blocks[0].components["SMXX"].max()
    )


PLATE = """
OPTI DIME 3 MODE TRID ELEM TRI3 ;
S = (DROI 1 (0. 0. 0.) (1. 0. 0.)) TRAN 1 (0. 1. 0.) ; LX = COTE S 4 ; LR = COTE S 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'FLUAGE' 'NORTON' {element} ;
MA = MATE MO 'YOUN' 1.E5 'NU' 0.3 'AF1' {a} 'AF2' {n} 'AF3' {m} 'SMAX' 100. 'EPAI' 0.1 ;
B = (BLOQ 'UZ' 'RX' 'RY' 'RZ' S) ET (BLOQ 'UX' LX) ET (BLOQ 'UY' (S POIN 'PROC' (0. 0. 0.))) ;
BR = BLOQ 'UX' LR ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ; T . 'TEMPS_CALCULES' = {times} ;
"""


@together("element", ["'DKT'", "'COQ3'", "'DKT' 'INTEGRE' 3"])
@together("age", [0.5, 1.2])
def test_a_stretched_plate_relaxes_as_a_body_in_plane_stress(element, age, tmp_path):
    words = {"element": element, "m": age, "a": "1.E-6"}
    forces = []
    for number, model in enumerate((SQUARE, PLATE)):
        find = run(model + HELD, tmp_path / str(number), **words)
        reactions = find("T").get("REACTIONS").items()
        right = [r.values_at("FX", find("LR").node_ids).sum() for _, r in reactions]
        forces.append(np.array(right))
    assert forces[0][2:] == pytest.approx(10.0 * forces[1][2:], rel=1e-6)
    assert abs(forces[0][-1]) < 0.9 * abs(forces[0][1])


STRIP = """
OPTI DIME 2 MODE {mode} ELEM SEG2 ; S = DROI 3 (0. 0.) (2. 0.) ;
A = S POIN 'INIT' ; E = S POIN 'FINA' ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'FLUAGE' 'NORTON' 'COQ2' ;
MA = MATE MO 'YOUN' 1.E5 'NU' 0.3 'AF1' {a} 'AF2' {n} 'AF3' {m} 'SMAX' 100. 'EPAI' 0.1 ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ; T . 'TEMPS_CALCULES' = {times} ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' 'ROTA' A ;
T . 'CHARGEMENT' = CHAR 'MECA' ({load}) (EVOL 'MANU' (PROG 0. 1.E-6 1.E6) (PROG 0. 1. 1.)) ;
PASAPAS T ; Q = MAXI (VMIS MO (T . 'CONTRAINTES' . 4) MA) ;
X = EXTR (T . 'DEPLACEMENTS' . 4) '{what}' E ;
"""


@together(
    "load, what, force, soft",
    [("FORC E 'FX' 5.", "UX", 5.0, 1e5 * 0.1), ("MOME 'MZ' 0.08 E", "RZ", 0.08, 1e5 * 1e-3 / 12)],
)
def test_a_strip_pulled_or_bent_takes_the_power_of_its_equivalent_stress(
    load, what, force, soft, tmp_path
):
    """Its creep p under q flows so that the force times the flow is q h p: 2 m of strip here."""
    find = run(STRIP, tmp_path, load=load, what=what)
    q = find("Q")
    assert q == pytest.approx(50.0 if what == "UX" else q)
    creep = 1e-7 * q**2 * 10.0**0.5
    assert abs(find("X")) == pytest.approx(2.0 * (force / soft + q * 0.1 * creep / force), rel=1e-3)
