"""Plastic bodies in calculations: limit loads, convergence of Newton, energy, elastic limit."""

from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from references.recorder import Recorder
from script_runs import ran, refused
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.plasticity.bulk import bulk_of, without_stiffness
from ssilang.kernel.plasticity.newton import BulkSolver
from ssilang.kernel.plasticity.points import PointState, plastic_zones
from ssilang.kernel.plasticity.run import BulkRun, integrate_bulk, step_bulk_statics
from ssilang.kernel.plasticity.zone_points import plastic_points
from ssilang.kernel.stepping.newmark import generalised_alpha, hht, newmark
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem
from ssilang.kernel.stepping.state import DAMPED, ELASTIC, EXTERNAL, KINETIC, LOST, STORED
from tests.kernel.elements.samples import cell_zone, line_zone, material, tilted_plate

TUBE = """
OPTI DIME 2 ELEM QUA8 MODE AXIS ;
S = (DROI 6 (1 0) (2 0)) TRAN 1 (0 .2) ;
M = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' Q8RI ;
A = MATE M 'YOUN' 2.E5 'NU' 0.3 'SIGY' 240. ;
P = PRES 'MASS' M 1. (COTE 4 S) ;
T = TABLE ; T.MODELE = M ; T.CARACTERISTIQUES = A ; T.BLOCAGES_MECANIQUES = BLOQ S UZ ;
"""


def values(script: str, tmp_path: Path, code: int = 0) -> dict:
    result = run_text(script, output_directory=tmp_path)
    assert result.exit_code == code, result.output
    return result


def at(result, name: str):
    return result.session.root.find(name)


def tube(pressure: float) -> str:
    return TUBE + (
        f"T.CHARGEMENT = CHAR 'MECA' P (EVOL MANU (PROG 0. 1.) (PROG 0. {pressure})) ; "
        "T.TEMPS_CALCULES = PROG 0. PAS .2 1. ; PASAPAS T ; "
        "U = EXTR (T.DEPLACEMENTS . 5) UR (S POIN PROC (2. 0.)) ; "
        "E = MAXI (T.VARIABLES_INTERNES . 5) ; "
    )


LIMIT = 2 / np.sqrt(3) * 240 * np.log(2)
"""Pressure at which a tube held along its axis is plastic all through."""


def test_thick_tube_carries_its_limit_pressure_and_no_more(tmp_path: Path) -> None:
    result = ran(tube(0.995 * LIMIT), output_directory=tmp_path)
    assert at(result, "E") > 1e-3
    assert "no equilibrium" in refused(tube(1.01 * LIMIT), tmp_path)


def test_thick_tube_with_a_plastic_ring(tmp_path: Path) -> None:
    """Hill's solution for Tresca's limit k = SIGY / sqrt 3 and elastic-plastic radius c."""
    c, k = 1.5, 240 / np.sqrt(3)
    pressure = k * (2 * np.log(c) + 1 - c**2 / 4)
    result = ran(tube(pressure), output_directory=tmp_path)
    nu, E = 0.3, 2e5
    outside = 2 * (1 - nu**2) * k * c**2 / (E * 4) * 2
    # Hill's axial stress is the middle one but not half the sum: 1 % on the displacement
    assert at(result, "U") == pytest.approx(outside, rel=0.01)


YIELDING = {
    "solid": lambda: cell_zone("QUA8", Mode.PLANE_STRAIN),
    "plane stress": lambda: cell_zone("TRI6", Mode.PLANE_STRESS),
    "bars": lambda: line_zone("BARR", [(0, 0, 0), (1, 2, 0), (2, 2, 3)], Mode.THREE_DIMENSIONAL),
    "thick shell": lambda: cell_zone("COQ8", Mode.THREE_DIMENSIONAL),
    "layers": lambda: tilted_plate("DKT"),
}


@together("kind", YIELDING)
def test_a_state_is_read_back_from_what_fields_show_of_it(kind: str) -> None:
    zone = replace(YIELDING[kind](), behaviour=("ELASTIQUE", "PLASTIQUE", "CINEMATIQUE"))
    zone.options.update(INTEGRE=5)
    points = plastic_points(
        zone, material(zone, YOUN=2e5, NU=0.3, SIGY=9.0, H=7.0, EPAI=0.4, SECT=2.5)
    )
    rng = np.random.default_rng(4)
    shape = (points.weights.shape[0], len(points.components), points.weights.shape[1])
    stress, plastic = (points.spread(rng.standard_normal(shape)) for _ in range(2))
    none = np.zeros((points.count, 6))
    variables = rng.standard_normal((points.count, len(points.law.variables)))
    state = PointState(stress, plastic, none, variables, 0.0)
    blocks = (points.stress_block(state), points.variable_block(state), points.plastic_block(state))
    given = tuple(b and CellField((b,)) for b in blocks)
    found, known = points.restored(PointState(none, none, none, 0.0 * variables, 0.0), given)
    assert known
    np.testing.assert_allclose(found.stress, stress)
    np.testing.assert_allclose(found.variables, variables)
    if blocks[2] is not None:
        np.testing.assert_allclose(found.plastic, plastic)


def test_layers_of_each_point_have_its_strain_and_its_own_height_times_its_curvature() -> None:
    zone = replace(tilted_plate("DKT"), behaviour=("ELASTIQUE", "PLASTIQUE", "PARFAIT"))
    zone.options.update(INTEGRE=3)
    points = plastic_points(zone, material(zone, YOUN=2e5, NU=0.3, SIGY=9.0, EPAI=0.4))
    own = np.random.default_rng(4).standard_normal((2, 6, points.weights.shape[1] // 3))
    heights = 0.2 * np.polynomial.legendre.leggauss(3)[0]
    wanted = own[:, :3, :, None] + heights * own[:, 3:, :, None]
    found = points.gathered(points.spread(own))
    np.testing.assert_allclose(found, wanted.reshape(2, 3, -1))


STRIP = """
OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ;
PE = 1 0 ; B = DROI (0 0) PE DINI .25 DFIN .03 ; B2 = DROI PE (5 0) DINI .03 DFIN .8 ;
S = (B ET B2) TRAN (0 -4) DINI .06 DFIN .8 ;
M = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' 'ICQ4' ;
A = MATE M 'YOUN' 1.E4 'NU' 0.48 'SIGY' (3. ** 0.5) ;
X = COOR 1 S ; Y = COOR 2 S ;
SIDES = BLOQ UX ((X POIN EGAL 0.) ET (X POIN EGAL 5.)) ;
BAS = BLOQ UX UY (Y POIN EGAL -4.) ; HEAD = BLOQ UY B ; ROUGH = BLOQ UX B ;
T = TABLE ; T.MODELE = M ; T.CARACTERISTIQUES = A ;
T.BLOCAGES_MECANIQUES = SIDES ET BAS ET HEAD ET ROUGH ;
T.CHARGEMENT = CHAR 'DIMP' (DEPI HEAD -0.02) (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ;
T.TEMPS_CALCULES = PROG 0. PAS .1 1. ; PASAPAS T ;
R = MAXI (RESU (REAC HEAD (T.DEPLACEMENTS . 10))) 'AVEC' (MOTS FY) 'ABS' ;
R0 = MAXI (RESU (REAC HEAD (T.DEPLACEMENTS . 9))) 'AVEC' (MOTS FY) 'ABS' ;
"""


def test_strip_footing_collapses_at_prandtls_load(tmp_path: Path) -> None:
    """(2 + pi) c on clay of shear strength 1; coarse elements at the edge carry a little more."""
    result = ran(STRIP, output_directory=tmp_path)
    load, before = at(result, "R"), at(result, "R0")
    assert load == pytest.approx(before, rel=0.01)  # it has collapsed
    assert 1.0 < load / (2 + np.pi) < 1.12


@together(
    "line, law, more",
    [("DROI 3 (0 0) (3 0)", "BARR", "'SECT' 0.1"), ("(DROI 2 (0 0) (3 0)) TRAN 1 (0 1)", "", "")],
)
def test_a_state_goes_through_its_fields_and_back(line: str, law: str, more: str) -> None:
    result = ran(
        f"OPTI DIME 2 ELEM {'SEG2' if law else 'QUA4'} MODE PLAN DEFO ; S = {line} ; "
        f"M = MODE S MECANIQUE ELASTIQUE PLASTIQUE CINEMATIQUE {law} ; "
        f"A = MATE M YOUN 2.E5 NU .3 SIGY 100. H 1.E3 {more} ;"
    )
    points = plastic_points(at(result, "M").zones[0], at(result, "A"))
    random, n = np.random.default_rng(7), points.count
    stress, plastic = np.zeros((2, n, 6))
    strains = points.B.shape[1]
    stress[:, points.components[:strains]] = random.normal(size=(n, strains))
    plastic[:, points.components[:strains]] = random.normal(size=(n, strains))
    variables = random.normal(size=(n, len(points.law.variables)))
    state = PointState(stress, plastic, np.zeros((n, 6)), variables)
    blank = PointState(*np.zeros((3, n, 6)), np.zeros_like(variables))
    blocks = points.stress_block(state), points.variable_block(state), points.plastic_block(state)
    assert len(points.law.variables) > 1
    given = tuple(CellField((block,)) for block in blocks)
    back, known = points.restored(blank, given)
    assert known
    for name in ("stress", "plastic", "variables"):
        np.testing.assert_allclose(getattr(back, name), getattr(state, name), rtol=1e-12)
    assert points.restored(blank, (None, *given[1:]))[1]
    assert not points.restored(blank, (None, None, None))[1]


def test_newton_converges_quadratically() -> None:
    result = ran(
        "OPTI DIME 2 ELEM QUA8 MODE PLAN CONT ; S = (DROI 6 (0 0) (3 0)) TRAN 3 (0 1) ; "
        "M = MODE S MECANIQUE ELASTIQUE PLASTIQUE ISOTROPE ; "
        "A = MATE M YOUN 1.E3 NU .3 ECRO (EVOL MANU (PROG 0. 1.) (PROG 1. 101.)) ; "
        "B = BLOQ UX UY (COTE 4 S) ; F = FORC FY -.3 (COTE 2 S) ; "
        "C = CHAR MECA F (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ;"
    )
    model, material = at(result, "M"), at(result, "A")
    zones = plastic_zones(model)
    support = at(result, "B")
    stiffness = Matrix(support.table, tuple(without_stiffness(z) for z in zones), support.relations)
    inputs = Inputs(stiffness, np.linspace(0, 1, 2), load=at(result, "C"))
    problem = make_problem(inputs)
    bulk = bulk_of(zones, material, problem.numbering)
    run = BulkRun(problem, bulk, bulk.unloaded())
    step_bulk_statics(run)
    r = np.array(run.residuals[-1])
    assert len(r) <= 12
    near = [i for i in range(1, len(r) - 1) if 1e-7 < r[i] < 1e-2]
    assert near
    i = near[-1]
    assert r[i + 1] < 1e-10 or np.log(r[i + 1]) / np.log(r[i]) > 1.6


@together("sense", ["", "'MINI'"])
@together("down", [-0.01, 0.02])
def test_supports_that_move_are_met_before_the_first_turn(sense: str, down: float) -> None:
    """Nothing yields, joints stay closed: what the tangents of the start predict is the answer."""
    result = ran(
        "OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ; S = (DROI 4 (0 0) (3 0)) TRAN 2 (0 1) ; "
        "M = MODE S MECANIQUE ELASTIQUE PLASTIQUE PARFAIT ; A = MATE M YOUN 1.E3 NU .3 SIGY 1.E6 ; "
        "G = (COTE 4 S) PLUS (0. 0.) ; J = RACC 1.E-6 (COTE 4 S) G ; "
        "MJ = MODE J MECANIQUE ELASTIQUE JOINT_SDM CISAILLEMENT_ELASTIQUE ; "
        "AJ = MATE MJ KN 3.E3 KS 5.E2 ; V = BLOQ UX G ; H = BLOQ UY ((COTE 3 S) ET G) ; "
        f"B = (BLOQ UX (COTE 2 S)) ET (BLOQ UY {sense} (COTE 1 S)) ET H ET V ; "
        f"F = (DEPI H {down}) ET (DEPI V 0.08) ; E = EVOL MANU (PROG 0. 1.) (PROG 0. 1.) ; "
        "C = CHAR DIMP F E ;"
    )
    zones, support = plastic_zones(at(result, "M")), at(result, "B")
    stiffness = Matrix(support.table, tuple(without_stiffness(z) for z in zones), support.relations)
    joints = {"model": at(result, "MJ"), "characteristics": at(result, "AJ")}
    problem = make_problem(Inputs(stiffness, np.linspace(0, 1, 3), load=at(result, "C"), **joints))
    bulk = bulk_of(zones, at(result, "A"), problem.numbering)
    run = BulkRun(problem, bulk, bulk.unloaded())
    run.observers = [recorder := Recorder(3)]
    step_bulk_statics(run)
    assert len(run.residuals[0]) <= 2
    assert run.residuals[0][0] < 1e-9
    top = problem.numbering.where("UY")
    top = top[problem.numbering.table.coordinates[problem.numbering.nodes[top], 1] == 1.0]
    np.testing.assert_allclose(recorder.of("u")[-1, top], down, rtol=1e-12)


BAR = """
OPTI DIME 2 ELEM SEG2 MODE PLAN CONT ;
L = DROI 1 (0 0) (1 0) ; Q = POIN L 'FINAL' ;
M = MODE L 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' BARR ;
A = MATE M 'YOUN' 100. 'NU' 0.3 'SIGY' 1. 'SECT' 2. RHO 0. ;
B = (BLOQ UX (POIN L 'INITIAL')) ET (BLOQ UY L) ; MA = MASS 'UX' 1. Q ;
T = TABLE ; T.MODELE = M ; T.CARACTERISTIQUES = A ; T.RIGI = (RIGI M A) ET B ; T.MASS = MA ;
T.TEMPS_CALCULES = PROG 0. PAS .005 1. ; T.TEMPS_SAUVES = PROG 1. ;
"""


def test_mass_on_a_plastic_bar_stops_where_its_energy_is_spent(tmp_path: Path) -> None:
    """v = 1: SIGY SECT x = 1/2 less the elastic energy; it stays there but for elastic ringing."""
    result = ran(
        BAR + "T.VITE = MANU CHPO Q 1 UX 1. ; T2 = DYNAMIC T ; "
        "EC = MAXI (T.ENERGIES.ECART) 'ABS' ; P = MAXI (T2 . (DIME T2) . VARIABLES_INTERNES) ; "
        "S = MAXI (T2 . (DIME T2) . CONTRAINTES) 'ABS' ; ",
        output_directory=tmp_path,
    )
    assert at(result, "EC") < 1e-10
    plastic = (0.5 - 0.5 * 2**2 / 200) / 2  # plastic lengthening of a bar of length 1
    assert at(result, "P") == pytest.approx(plastic, rel=1e-3)  # error of dt = 0.005
    assert at(result, "S") <= 2 + 1e-9
    told = result.session.statistics["calculations"][-1]["loop"]
    assert told == "full Newton (plastic bodies: PARFAIT)"


def test_strong_material_moves_as_the_linear_calculation(tmp_path: Path) -> None:
    script = BAR.replace("'SIGY' 1.", "'SIGY' 1.E9") + (
        "T.VITE = MANU CHPO Q 1 UX 1. ; T2 = DYNAMIC T ; U = EXTR (T2 . (DIME T2) . DEPL) UX Q ; "
        "T.MODELE = VIDE MMODEL ; OUBL T MODELE ; T3 = DYNAMIC T ; "
        "V = EXTR (T3 . (DIME T3) . DEPL) UX Q ;"
    )
    result = ran(script, output_directory=tmp_path)
    assert at(result, "U") == pytest.approx(at(result, "V"), rel=1e-8)


@together(
    "load", ["'T' (MANU CHPO L 1 'T' 1.)", "'DEFI' (MANU CHML M EPSS 1.E-3 TYPE DEFORMATIONS)"]
)
def test_expansion_held_beyond_yield_leaves_the_limit_stress(tmp_path: Path, load: str) -> None:
    script = (
        BAR.split("T = TABLE")[0].replace("'RHO'", "RHO")
        + "A = A ET (MATE M ALPH 1.E-3) ; B = BLOQ UX UY L ; "
        "T = TABLE ; T.MODELE = M ; T.CARACTERISTIQUES = A ; T.BLOCAGES_MECANIQUES = B ; "
        f"T.CHARGEMENT = CHAR {load} "
        "(EVOL MANU (PROG 0. 1. 2.) (PROG 0 30. 0)) ; "
        "T.TEMPS_CALCULES = PROG 0. 1. 2. ; PASAPAS T ; "
        "S1 = MAXI (T.CONTRAINTES . 1) 'ABS' ; S2 = MAXI (T.CONTRAINTES . 2) ; "
        "I1 = MAXI (T.'DEFORMATIONS_INELASTIQUES' . 1) 'ABS' ;"
    )
    result = ran(script, output_directory=tmp_path)
    assert at(result, "S1") == pytest.approx(2.0)  # SIGY SECT, in compression
    assert at(result, "I1") == pytest.approx(0.03 - 0.01)
    assert at(result, "S2") == pytest.approx(2.0)  # and in tension when cold again


def test_calculation_goes_on_from_its_own_results(tmp_path: Path) -> None:
    once = tube(0.9 * LIMIT)
    twice = once.replace(
        "PASAPAS T ;",
        "T.TEMPS_CALCULES = PROG 0. .2 .4 ; PASAPAS T ; "
        "T.TEMPS_CALCULES = PROG .6 .8 1. ; PASAPAS T ;",
    )
    ends = []
    for script in (once, twice):
        result = ran(script, output_directory=tmp_path)
        ends.append((at(result, "U"), at(result, "E")))
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)


def test_a_beam_pushed_at_one_node_reaches_its_plastic_moment_in_long_steps(tmp_path) -> None:
    script = """
    OPTI DIME 2 ELEM QUA8 MODE PLAN CONT ;
    S = (DROI 20 (0. -0.1) (2. -0.1)) TRAN 4 (0. 0.2) ;
    MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' ;
    MA = MATE MO 'YOUN' 2.E11 'NU' 0.3 'SIGY' 2.5E8 ;
    TIP = (COTE 2 S) POIN 'PROC' (2. 0.) ; PUSH = BLOQ 'UY' TIP ;
    T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' (COTE 4 S)) ET PUSH ;
    T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI PUSH -0.08) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
    T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.2 1. ;
    PASAPAS T ;
    F = EXTR (REAC PUSH (T . 'DEPLACEMENTS' . 5)) 'FY' TIP ;
    """
    force = at(values(script, tmp_path), "F")
    # M_p / L; the clamped edge is held across too: at most 2 / sqrt 3 more
    plastic = 2.5e8 * 0.2**2 / 4 / 2.0
    assert plastic < -force < 2 / 3**0.5 * plastic


LAWS = {
    "PARFAIT": "SIGY 1.",
    "ISOTROPE": "ECRO (EVOL MANU (PROG 0. 1.) (PROG 1. 51.))",
    "CINEMATIQUE": "SIGY 1. H 40.",
    "J2": "SIG0 1. SIGI 1.5 KISO 20. VELO 300.",
    "DRUCKER_PARFAIT": "LTR 1. LCS 4.",
    "DRUCKER_PRAGER": "ALFA 0.2 BETA 1. K 1. ETA 0.2 MU 1. KL 1.2 H 30. GAMM 0.1 DELT 1.",
    "RH_COULOMB": "COHE 1. PHI 0.35",
    "IWAN": "GGAM (EVOL MANU (PROG 1.E-5 1.E-3 4.E-3 2.E-2) (PROG 1. 0.7 0.4 0.1))",
}
SCHEMES = {
    "loads": None, "newmark": newmark(), "hht": hht(0.1), "alpha": generalised_alpha(0.6),
    "damped": newmark(0.3025, 0.6),
}  # fmt: skip


@cache
def plate(law: str):
    """A tied plate that is pushed while its side moves."""
    kind = ("QUA4", "TRI3", "QUA8")[list(LAWS).index(law) % 3]
    return ran(f"""
    OPTI DIME 2 ELEM {kind} MODE PLAN DEFO ;
    S = (DROI 2 (0 0) (3 0)) TRAN 1 (0.4 1.5) ;
    M = MODE S MECANIQUE ELASTIQUE PLASTIQUE {law} ;
    A = MATE M YOUN 1.E3 NU .3 RHO 20. {LAWS[law]} ;
    L1 = COTE 1 S ; L3 = COTE 3 S ; P1 = L3 POIN INIT ; P2 = L3 POIN FINA ;
    B = BLOQ UX UY L1 ; H = BLOQ UY L3 ; R = RELA UX P1 - UX P2 ;
    B = B ET H ET R ; D = DEPI H 0.008 ; F = FORC FX 0.2 ((COTE 2 S) POIN 'PROC' (3.2 0.75)) ;
    C = (CHAR DIMP D (EVOL MANU (PROG 0. 1. 2.) (PROG 0. 1. -.3))) ET
    (CHAR MECA F (EVOL MANU (PROG 0. 0.5 2.) (PROG 0. 1.4 -1.))) ;
    MA = MASS M A ; AM = (MA * 0.6) ET ((RIGI M A) * 0.01) ;
    """)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_work_of_loads_and_of_supports_is_stored_and_lost(law: str, scheme: str) -> None:
    """Work from instants alone, in fine steps."""
    result = plate(law)
    zones, support = plastic_zones(at(result, "M")), at(result, "B")
    stiffness = Matrix(support.table, tuple(without_stiffness(z) for z in zones), support.relations)
    times, rule = np.linspace(0.0, 2.0, 61), SCHEMES[scheme]
    moving = {"mass": at(result, "MA"), "damping": at(result, "AM"), "scheme": rule} if rule else {}
    p = make_problem(Inputs(stiffness, times, load=at(result, "C"), **moving))
    bulk = bulk_of(zones, at(result, "A"), p.numbering)
    run = BulkRun(p, bulk, bulk.unloaded())
    run.observers = [recorder := Recorder(len(times))]
    energies = (step_bulk_statics if rule is None else integrate_bulk)(run).energies
    u, v, pushed = (recorder.of(name) for name in ("u", "v", "reaction"))
    F = p.loading.at(times) @ p.loading.forces.T
    rows = p.constraints.C.toarray()
    step, force = np.diff(u, axis=0), F + pushed @ np.linalg.pinv(rows) @ rows
    work = np.cumsum(0.5 * np.vecdot(step, force[1:] + force[:-1]))
    assert np.ptp(u @ rows.T, axis=0).max() > 5e-3  # supports did move
    size, energies = np.abs(work).max(), energies[-len(work) :]
    np.testing.assert_allclose(energies[:, EXTERNAL], work, atol=1e-8 * size)
    damped = np.cumsum(0.5 * np.vecdot(step @ p.C, v[1:] + v[:-1])) if rule else 0.0 * work
    np.testing.assert_allclose(energies[:, DAMPED], damped, atol=1e-8 * size)
    kinetic = 0.5 * np.vecdot(v @ p.M, v)[1:] if rule else 0.0 * work
    np.testing.assert_allclose(energies[:, KINETIC], kinetic, atol=1e-8 * size)
    kept = energies[:, [KINETIC, ELASTIC, STORED, DAMPED, LOST]].sum(axis=1)
    loss, conserving = (work - kept) / size, scheme in ("loads", "newmark")
    # others lose more, and lend in turns, at any length of step, up to 2.6 % (alpha)
    assert loss.min() > (-0.02 if conserving else -0.028)
    assert loss.max() < (0.02 if conserving else 0.2)
    assert energies[-1, LOST] > 0.05 * size
    assert (np.diff(energies[:, LOST]) >= -1e-3 * size).all()


@together(
    "searched, contact, sizes, tried",
    [
        (True, None, [3, 3, 3, 3], [2, 1.5, 1.25, 1.125]),
        (True, None, [3, 1, 0], [2, 1.5]),
        (False, None, [3, 0], [2]),
        (True, "rows", [3, 0], [2]),
    ],
)
def test_steps_that_make_it_worse_are_halved_but_of_large_displacements_and_contact(
    searched, contact, sizes, tried
):
    seen, left = [], iter(sizes)

    def trial(motion, r, du, pushed):
        seen.append(du)
        return SimpleNamespace(du=du, size=next(left), residual=1.0)

    solver = SimpleNamespace(bulk=SimpleNamespace(searched=searched), contact=contact, _trial=trial)
    now = SimpleNamespace(du=1.0, size=2.0)
    found = BulkSolver._searched(solver, None, None, now, 1.0, None)
    assert seen == tried
    assert found.du == tried[-1]
