"""Bodies in finite displacements: turned without stress, tangents, patch states."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from script_runs import ran
from together import together

from ssilang.kernel.plasticity.finite import finite_zone
from ssilang.kernel.plasticity.finite_space_beam import finite_beam, finite_space_beam
from ssilang.kernel.plasticity.large.finite_plate import finite_plate

MESH = {
    "plane": "OPTI DIME 2 MODE PLAN DEFO ELEM QUA8 ; S = TRAN 1 (DROI 1 (0 0) (1 0)) (0.3 1.) ;",
    "membrane": "OPTI DIME 2 MODE PLAN CONT ELEM TRI3 ; S = TRAN 1 (DROI 1 (0 0) (1 0)) (0.3 1.) ;",
    "ring": "OPTI DIME 2 MODE AXIS ELEM QUA4 ; S = TRAN 1 (DROI 1 (1 0) (2 0)) (0.3 1.) ;",
    "space": "OPTI DIME 3 ELEM CUB8 ; "
    "S = VOLU 1 (TRAN 1 (DROI 1 (0 0 0) (1 0 0)) (0 1 0)) 'TRAN' (0.2 0 1) ;",
    "BARR": "OPTI DIME 3 ELEM SEG2 ; S = DROI 2 (0 0 0) (1 2 0.5) ;",
    **dict.fromkeys(("beam of the plane", "sheared"), "OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; "
    "S = DROI 3 (0 0) (3 4) ;"),
    "POUT": "OPTI DIME 3 ELEM SEG2 ; S = DROI 3 (0 0 0) (3 4 2) ;",
    **dict.fromkeys(("DKT", "COQ3"), "OPTI DIME 3 ELEM TRI3 ; "
    "S = (DROI 1 (0 0 0) (1 0.2 0.1)) TRAN 1 (0.1 0.8 0.3) ;"),
}  # fmt: skip
SECTION = "'SECT' 0.1 'INRY' 1.E-2 'INRZ' 3.E-2 'TORS' 2.E-2"
# word of MODE, parameters, maker, rotations of a node
SLIM = {
    "BARR": ("BARR", "'SECT' 0.1", finite_zone, 0),
    "beam of the plane": ("POUT", "'SECT' 0.1 'INRZ' 3.E-2", lambda z, a: finite_beam(z, a, 2), 1),
    "sheared": ("TIMO", "'SECT' 0.1 'INRZ' 3.E-2", lambda z, a: finite_beam(z, a, 1), 1),
    "POUT": ("POUT", SECTION, lambda z, a: finite_space_beam(z, a, 2), 3),
    **{n: (n, "'EPAI' 0.1", lambda z, a: finite_plate(z, a, 3), 3) for n in ("DKT", "COQ3")},
}


def zone_of(name):
    """A zone, places (n, nodes, d) of its cells, and zeros (n, nodes, unknowns of a node)."""
    word, section, make, rotations = SLIM.get(name, ("ELASTIQUE", "", finite_zone, 0))
    text = f"{MESH[name]} M = MODE S MECANIQUE {word} ; A = MATE M 'YOUN' 5. 'NU' 0.3 {section} ;"
    result = ran(text)
    zone = result.session.root.find("M").zones[0]
    cells = zone.cells.nodes.coordinates[zone.cells.connectivity][..., : zone.mode.dimension]
    rest = np.zeros((*cells.shape[:2], zone.mode.dimension + rotations))
    return make(zone, result.session.root.find("A")), cells, rest


def moved(rest, amount=0.3, seed=3):
    return amount * np.random.default_rng(seed).standard_normal(rest.shape).reshape(len(rest), -1)


@together("amount", [0.01, 0.1])
@together("name", MESH)
def test_tangent_is_the_derivative_of_the_forces(name, amount):
    zone, _, rest = zone_of(name)
    u, du = moved(rest, amount), moved(rest, 1.0, 4)
    given = zone.shown(moved(rest, 0.05, 5))
    zone = zone.stressed(given, u)
    h = 1e-6
    slope = (zone.forces(u + h * du) - zone.forces(u - h * du)) / (2 * h)
    np.testing.assert_allclose(
        np.einsum("nab,nb->na", zone.tangent(u), du), slope, atol=2e-8 * np.abs(slope).max()
    )


@together("name", MESH)
def test_forces_are_the_derivative_of_the_energy(name):
    zone, _, rest = zone_of(name)
    u, du, h = moved(rest, 0.1), moved(rest, 1.0, 4), 1e-6
    for now in (zone, zone.stressed(zone.shown(moved(rest, 0.05, 5)), u)):
        slope = (now.stored(u + h * du) - now.stored(u - h * du)) / (2 * h)
        assert np.sum(now.forces(u) * du) == pytest.approx(slope, rel=1e-6)


@together("name", [n for n in MESH if n != "ring"])
@together("v", [[0, 0, 2.1], [0, 0, 0.5], [-2.5, 1.0, 2.0]])
def test_a_turned_body_has_no_stress(name, v):
    zone, cells, rest = zone_of(name)
    d = cells.shape[-1]
    v = np.array(v) * ([0, 0, 1] if d == 2 else 1)
    turn = Rotation.from_rotvec(v).as_matrix()[:d, :d]
    rest[..., :d] = cells @ turn.T - cells
    rest[..., d:] = (v[-1:] if d == 2 else v)[: rest.shape[-1] - d]
    u = rest.reshape(len(rest), -1)
    np.testing.assert_allclose(zone.shown(u), 0.0, atol=1e-13)
    np.testing.assert_allclose(zone.forces(u), 0.0, atol=1e-13)


@together("name", MESH)
def test_given_stresses_are_shown_at_their_displacement(name):
    zone, _, rest = zone_of(name)
    given, u = zone.shown(moved(rest, 0.05, 5)), moved(rest, 0.1)
    np.testing.assert_allclose(zone.stressed(given, u).shown(u), given, atol=1e-12)


def test_a_long_cantilever_follows_the_elastica():
    """End load P L^2 / E I = 2: the tip of the elastica moves 0.4935 L down and 0.1606 L back."""
    result = ran("""
    OPTI DIME 2 MODE PLAN CONT ELEM QUA8 ;
    L = DROI 1 (0. 0.) (0. 1.) ; S = TRAN 20 L (40. 0.) ; M = MODE S MECANIQUE ELASTIQUE ;
    A = MATE M 'YOUN' 1.2E4 'NU' 0. ; C = BLOQ 'DEPL' L ; P = S POIN 'PROC' (40. 0.5) ;
    T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'BLOCAGES_MECANIQUES' = C ;
    T . 'GRANDS_DEPLACEMENTS' = VRAI ;
    T . 'CHARGEMENT' = CHAR 'MECA' (FORC 'FY' -1.25 P) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
    T . 'TEMPS_CALCULES' = PROG 0. PAS 0.2 1. ; PASAPAS T ; U = T . 'DEPLACEMENTS' . 5 ;
    X = EXTR U P 'UX' ; Y = EXTR U P 'UY' ;
    """)
    assert result.session.root.find("Y") == pytest.approx(-0.4935 * 40, rel=3e-3)
    assert result.session.root.find("X") == pytest.approx(-0.1606 * 40, rel=6e-3)


@pytest.mark.parametrize("kind", ["QUA4", "TRI6"])
def test_a_cycle_of_large_displacements_gives_the_work_back(kind):
    """Pushed aside by a support and a force along curves of their own, in fine steps, and back."""
    result = ran(f"""
    OPTI DIME 2 MODE PLAN DEFO ELEM {kind} ;
    S = (DROI 2 (0. 0.) (1. 0.)) TRAN 3 (0.2 2.) ; M = MODE S MECANIQUE ELASTIQUE ;
    A = MATE M 'YOUN' 50. 'NU' 0.2 ; H = BLOQ 'UX' (COTE 3 S) ;
    T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' (COTE 1 S)) ET H ; T . 'GRANDS_DEPLACEMENTS' = VRAI ;
    T . 'CHARGEMENT' =
    (CHAR 'DIMP' (DEPI H 0.9) (EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 0.))) ET
    (CHAR 'MECA' (FORC 'FY' 3. (COTE 3 S)) (EVOL 'MANU' (PROG 0. 0.5 2.) (PROG 0. 1. 0.))) ;
    T . 'TEMPS_CALCULES' = PROG 0. PAS 0.04 2. ; PASAPAS T ;
    """)
    energies = result.session.root.find("T").get("ENERGIES")
    stored, lost, work = (energies.get(n).values for n in ("ELASTIQUE", "DISSIPEE", "EXTERIEURE"))
    size = stored.max()
    assert size > 0.5
    np.testing.assert_allclose(stored, work, atol=1e-3 * size)
    np.testing.assert_allclose(lost, 0.0, atol=1e-3 * size)
    assert abs(stored[-1]) < 1e-9 * size
