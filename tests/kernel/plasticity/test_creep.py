"""Norton's creep: stresses, steps, tangents; loads that a function or CHARMECA finds."""

import numpy as np
import pytest
from script_runs import finder, ran
from together import together

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.materials.plastic.creep import norton
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.plasticity.added_load import Added, loaded_bulk
from ssilang.kernel.plasticity.bulk import Bulk
from ssilang.kernel.plasticity.driven_load import HALVINGS, _towards

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


@together("element", ["'DKT'", "'COQ3'", "'DST'", "'DKT' 'INTEGRE' 3"])
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


@together("n", [20, 200])
def test_tangent_of_a_load_on_neighbours(n):
    rng = np.random.default_rng(n)
    after = np.roll(np.arange(n), -1)
    size = rng.uniform(1, 2, n) * (np.arange(n) >= n // 4)  # the first ones are not loaded

    def law(time, u):
        return Added(time * size * u * u[after])

    rows, columns = np.concatenate([np.arange(n)] * 2), np.concatenate([np.arange(n), after])
    half = sp.csr_array((np.ones(2 * n), (rows, columns)), shape=(n, n))
    pattern = sp.csr_array((half + half.T) > 0)
    u, shifts = rng.uniform(1, 2, n), 1e-6 * rng.uniform(0.5, 2, n)
    bulk = loaded_bulk(Bulk((), (), n), law, shifts, 1e-6, pattern, "")
    answer = bulk.respond(bulk.begin((), u, 2.0), np.zeros(n), 2.0)
    exact = np.zeros((n, n))
    exact[np.arange(n), np.arange(n)] = -2 * size * u[after]
    exact[np.arange(n), after] += -2 * size * u
    np.testing.assert_allclose(answer.tangent.toarray(), exact, atol=1e-4)
    np.testing.assert_allclose(answer.force, -law(2.0, u).force)
    np.testing.assert_allclose(answer.rate, -law(1.0, u).force, rtol=1e-6)
    given = loaded_bulk(Bulk((), (), n), lambda *_: Added(size, half), np.ones(n), 1.0, pattern, "")
    tangent = given.respond(given.begin((), u, 2.0), np.zeros(n), 2.0).tangent
    assert (tangent != half).nnz == 0
    if n > 30:
        assert len(bulk._groups(np.arange(n))) < 10  # not one by one


@together("halvings", [0, 3, HALVINGS, HALVINGS + 1])
def test_a_step_of_time_is_halved_until_it_leads_somewhere(halvings):
    tried = []

    class Path:
        def step(self, known, change, control, share, now, most):
            tried.append((share, now, most, *known))
            return 0.25 if share == 0.5**halvings else None

    given = Path(), np.array([1.0, 2.0]), np.array([4.0, -2.0]), None, 0.5, np.array([10.0, 12.0])
    if halvings <= HALVINGS:
        assert _towards(*given) == 0.75
    else:
        with pytest.raises(ConvergenceError, check=lambda e: e.data["now"] == 11.0):
            _towards(*given)
    shares = 0.5 ** np.arange(min(halvings, HALVINGS) + 1)
    assert tried == [(share, 11.0, 0.5, 3.0, 1.0) for share in shares]


SPRING = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
DEBP CHARMECA T1*TABLE T*FLOTTANT ;
  UX = EXTR T1 . 'ESTIMATION' . 'DEPLACEMENTS' 'UX' P2 ;
  R = TABL ; R . 'ADDI_SECOND' = MANU 'CHPO' P2 'FX' ((-50. * UX * UX) + (10. * T)) ;
FINP R ;
P1 = 0. 0. ; P2 = 1. 0. ; L = DROI 4 P1 P2 ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; MA = MATE MO 'YOUN' 100. 'NU' 0. 'SECT' 1. ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' P1) ET (BLOQ 'UY' L) ;
T . 'CHARGEMENT' = CHAR 'MECA' (FORC (10. 0.) P2) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; T . 'PROCEDURE_CHARMECA' = VRAI ;
PASAPAS T ;
"""


def test_an_elastic_body_is_held_by_a_spring_that_hardens(tmp_path):
    find = finder(SPRING, tmp_path)
    node = np.array([find("P2").node])
    ux = find("T").get("DEPLACEMENTS").get(10).values_at("UX", node)[0]
    assert 100 * ux + 50 * ux**2 == pytest.approx(20.0, rel=1e-10)
    # the spring's force and the load's work stand on one side, the bar's energy on the other
    energies = find("T").get("ENERGIES")
    assert energies.get("ELASTIQUE").values[-1] == pytest.approx(50 * ux**2, rel=1e-9)
    assert energies.get("EXTERIEURE").values[-1] == pytest.approx(50 * ux**2, rel=1e-3)


FOLLOWER = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
P1 = 0. 0. ; P2 = 10. 0. ; L1 = DROI 10 P1 P2 ;
MO = MODE L1 'MECANIQUE' 'ELASTIQUE' {element} ;
MA = MATE MO 'YOUN' 1.E7 'NU' 0. {section} ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' 'ROTA' P1 ; T . 'GRANDS_DEPLACEMENTS' = VRAI ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.25 1. ;
"""
TURNING = """
DEBP CHARMECA T1*TABLE T*FLOTTANT ;
  RZ = (EXTR T1 . 'ESTIMATION' . 'DEPLACEMENTS' 'RZ' P2) * 180. / PI ;
  FX = T * -3.E3 * (SIN RZ) ; FY = T * 3.E3 * (COS RZ) ;
  R = TABL ; R . 'ADDI_SECOND' = MANU 'CHPO' P2 2 'FX' FX 'FY' FY ;
FINP R ;
T . 'PROCEDURE_CHARMECA' = VRAI ;
PASAPAS T ;
"""


def tip(find):
    field, node = find("T").get("DEPLACEMENTS").get(4), np.array([find("P2").node])
    return [field.values_at(c, node)[0] for c in ("UX", "UY", "RZ")]


def test_a_force_that_turns_with_the_end_equals_a_dead_one_turned_as_far(tmp_path):
    beam = FOLLOWER.format(element="POUT", section="'SECT' 1. 'INRZ' 1.E-2")
    first = tip(finder(beam + TURNING, tmp_path))
    assert first[2] > 0.8
    dead = f"FORC ({-3e3 * np.sin(first[2]):.16g} {3e3 * np.cos(first[2]):.16g}) P2"
    dead = f"T . 'CHARGEMENT' = CHAR 'MECA' ({dead}) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;"
    assert tip(finder(beam + dead + "PASAPAS T ;", tmp_path)) == pytest.approx(first, rel=1e-8)


PRESSURE = """
DEBP CHARMECA T1*TABLE T*FLOTTANT ;
  R = TABL ; R . 'ADDI_SECOND' = PRES 'COQU' MO (MANU 'CHPO' L1 1 'P' (T * 300.)) 'NORM' ;
FINP R ;
T . 'PROCEDURE_CHARMECA' = VRAI ;
PASAPAS T ;
R = T . 'REACTIONS' . 4 ; FX = EXTR R 'FX' P1 ; FY = EXTR R 'FY' P1 ;
"""


def test_pressure_stands_on_the_shell_where_it_is(tmp_path):
    find = finder(FOLLOWER.format(element="COQ2", section="'EPAI' 0.5") + PRESSURE, tmp_path)
    ux, uy, turn = tip(find)
    assert abs(turn) > 0.3
    # a pressure p on a line pulls p times its chord, a quarter turn further
    chord = np.array([10.0 + ux, uy])
    pull = 300.0 * np.array([-chord[1], chord[0]])
    side = np.sign(find("FY") * -pull[1])
    assert [find("FX"), find("FY")] == pytest.approx(list(-side * pull), rel=1e-6)
    # nodes are back where they were
    assert find("P2").coordinates[0] == pytest.approx(10.0, abs=1e-14)
