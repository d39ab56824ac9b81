"""Loads that a function or the script's CHARMECA finds where the bodies are."""

import numpy as np
import pytest
from script_runs import finder
from together import together

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.plasticity.added_load import Added, loaded_bulk
from ssilang.kernel.plasticity.bulk import Bulk
from ssilang.kernel.plasticity.driven_load import HALVINGS, _towards


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
