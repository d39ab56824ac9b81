"""Joints through scripts: rules, states and energies in results, parameters refused early."""

import numpy as np
import pytest
from references.small_motions import HOPPER
from script_runs import finder, ran

from ssilang.cli.run import run_text

STRIP = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;
A = DROI 4 (-2. 0.) (2. 0.) ; B = A PLUS (0. 0.) ; J = RACC 1.E-6 A B ;
"""


# --- integration --------------------------------------------------------------------------------


def test_strip_footing_with_sixteen_joints_and_lobatto_points(found):
    text = f"""{STRIP.replace("DROI 4", "DROI 16")}
    M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'LOBATTO' ; C = MATE M 'KN' 2.E7 'KS' 2.E7 ;
    G = A POIN 'PROC' (-2. 0.) ; D = A POIN 'PROC' (2. 0.) ;
    BLO = (BLOQ 'UX' 'UY' B) ET (BLOQ 'UX' A) ET (RELA 0.25 'UY' D - 0.25 'UY' G) ;
    TURN = RELA 0.25 'UY' D - 0.25 'UY' G ;
    BLO = (BLOQ 'UX' 'UY' B) ET (BLOQ 'UX' A) ET TURN ;
    REPE I (NBNO A) ; P = A POIN &I ; X = COOR 1 P ; S = (X + 2.) / 4. ; R = 1. - S ;
      SI ((NEG P G) ET (NEG P D)) ;
        BLO = BLO ET (RELA 'UY' P - R 'UY' G - S 'UY' D) ;
      FINSI ;
    FIN I ;
    T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = C ; T . 'BLOCAGES_MECANIQUES' = BLO ;
    EV = EVOL 'MANU' (PROG 0. 1.) (PROG 1. 1.) ; EW = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;
    T . 'CHARGEMENT' = (CHAR 'MECA' (FORC (0. -6.E5) (A POIN 'PROC' (0. 0.))) EV)
      ET (CHAR 'DIMP' (DEPI TURN 0.0375) EW) ;
    T . 'TEMPS_CALCULES' = PROG 0.5 1. ; PASAPAS T ;
    R = T . 'REACTIONS' . 2 ; Z = XTY (NOMC 'SCAL' (COOR 1 B)) (EXCO 'FY' (REDU R B) 'SCAL')
      (MOTS 'SCAL') (MOTS 'SCAL') ;
    """
    # theta_u = 2 N/(k0 B^2) = 0.00375, theta = 10 theta_u: M = (3 - 2 sqrt(1/10)) N B/6
    exact = (3 - 2 * np.sqrt(0.1)) * 6e5 * 4 / 6
    assert abs(found(text, "Z")) == pytest.approx(exact, rel=1e-2)


# --- linear springs beside a law ------------------------------------------------------------------


POINTS = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; A = 0. 0. ; B = 0. 0. ; J = MANU 'SEG2' B A ; Q = A ;
"""
LINES = STRIP.replace("DROI 4", "DROI 1") + "Q = A POIN 1 ;"
PLACES = {  # of a mass: mesh, words of the element, length that it stands on
    "points": (POINTS, {"element": "'JOI1'", "axis": "'DIRECTION' (0. 1.)", "turn": "'RZ'"}, 1.0),
    "lines": (LINES, {"element": "'JOI2'", "axis": "", "turn": ""}, 2.0),
}
SPRUNG = """
MJ = MODE J 'MECANIQUE' 'ELASTIQUE' {law} {element} ;
ML = MODE J 'MECANIQUE' 'ELASTIQUE' {element} ; M = MASS 'DEPL' 1.E3 A ;
AJ = MATE MJ 'KN' 3.E6 'KS' 3.E6 {axis} ; AL = MATE ML 'KN' 5.E6 'KS' 1.E6 {axis} ;
K = {matrices} ET (BLOQ 'DEPL' {turn} B) ET (BLOQ 'UX' {turn} A) ;
W = M * (MANU 'CHPO' A 1 'UY' -10.) ; T = TABL ;
T . 'RIGI' = K ; T . 'MASS' = M ; T . 'MODELE' = MJ ; T . 'CARACTERISTIQUES' = AJ ; U = RESO K W ;
T . 'DEPL' = U ; T . 'CHAR' = CHAR 'MECA' W ; T . 'VITE' = MANU 'CHPO' A 1 'UY' 1.E-2 ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-4 0.1 ; R = DYNAMIC T ;
X = EXTR (EVOL 'TEMP' R 'DEPL' 'UY' Q) 'ORDO' ; S = EXTR U 'UY' Q ;
"""


@pytest.mark.parametrize(
    ("law", "matrices"),
    [
        ("'JOINT_SDM'", "(RIGI MJ AJ) ET (RIGI ML AL)"),
        ("'JOINT_SDM'", "(RIGI ML AL) ET (RIGI MJ AJ)"),
        ("", "(RIGI ML AL) ET (RIGI MJ AJ)"),  # a law that is linear, too
    ],
)
@pytest.mark.parametrize("place", PLACES)
def test_a_spring_on_the_cell_of_a_joint_acts_beside_it(law, matrices, place, tmp_path):
    """Both carry the weight, and the mass swings on their sum, as RESO and VIBR have it."""
    mesh, words, length = PLACES[place]
    text = mesh + SPRUNG.format(**words, law=law, matrices=matrices)
    result = run_text(text, output_directory=tmp_path)
    assert (result.errors, result.session.warnings) == ([], [])
    moved, rest = result.session.root.find("X").values, result.session.root.find("S")
    stiffness, t = 8e6 * length, np.linspace(0.0, 0.1, len(moved))
    assert rest == pytest.approx(-1e4 / stiffness, rel=1e-9)
    omega, way = np.sqrt(stiffness / 1e3), 1e-2 / np.sqrt(stiffness / 1e3)
    assert moved == pytest.approx(rest + way * np.sin(omega * t), abs=1e-3 * way)


def test_an_elastic_body_in_the_cells_of_one_that_yields_bears_its_part(found):
    rests = """
    OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = DROI 1 (0. 0.) (1. 0.) ; S = TRAN 1 L (0. 1.) ;
    MP = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' ;
    ME = MODE S 'MECANIQUE' 'ELASTIQUE' ; A = MATE MP 'YOUN' 3.E6 'NU' 0. 'SIGY' 1.E5 ;
    AE = MATE ME 'YOUN' 5.E6 'NU' 0. ;
    Q = (COTE 3 S) POIN 1 ; M = MASS 'DEPL' 1.E3 (COTE 3 S) ; W = M * (MANU 'CHPO' S 1 'UY' -10.) ;
    K = (RIGI ME AE) ET (RIGI MP A) ET (BLOQ 'DEPL' L) ET (BLOQ 'UX' S) ; T = TABL ; U = RESO K W ;
    T . 'RIGI' = K ; T . 'MASS' = M ; T . 'MODELE' = MP ; T . 'CARACTERISTIQUES' = A ;
    T . 'DEPL' = U ; T . 'CHAR' = CHAR 'MECA' W ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.1 ;
    R = DYNAMIC T ; X = EXTR (EVOL 'TEMP' R 'DEPL' 'UY' Q) 'ORDO' ;
    """
    assert found(rests, "X").values == pytest.approx(-1e4 / (8e6 / 2.0), rel=1e-9)


# --- states and energies ------------------------------------------------------------------------


def test_dynamic_gives_state_and_energies_of_each_point(found):
    table = found(HOPPER + "T1 . 'PAS_SAUVES' = 'TOUS' ; T2 = DYNAMIC T1 ;", "T2")
    for i in (1, 50, 120, 300):
        at = table.get(i)
        variables = at.get("VARIABLES_INTERNES").blocks[0].components
        u = at.get("DEPL").components["UY"].values.min(initial=0.0)
        jump = at.get("SAUTS").blocks[0].components["EXX"][0, 0]
        assert variables["ETAT"][0, 0] == (1.0 if jump <= 0 else variables["ETAT"][0, 0])
        assert (variables["ETAT"][0, 0] > 2.0) == (jump > 0)
        assert variables["ESTO"][0, 0] == pytest.approx(500 * min(jump, 0.0) ** 2, abs=1e-15)
        assert variables["EPER"][0, 0] == 0.0
        assert u <= 0.0


def test_energies_of_points_add_up_to_those_of_the_table(found):
    text = f"""{STRIP}
    M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
    C = MATE M 'KN' 1.E9 'KS' 1.E9 'FU' 1.E5 'GF' 20. ;
    D = BLOQ 'UY' A ; T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = C ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' 'UY' B) ET (BLOQ 'UX' A) ET D ;
    T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI D 4.E-4) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
    T . 'TEMPS_CALCULES' = PROG 0.25 'PAS' 0.25 1. ; PASAPAS T ;
    V = T . 'VARIABLES_INTERNES' . 4 ; S = INTG M (EXCO 'ESTO' V) ; P = INTG M (EXCO 'EPER' V) ;
    E = MAXI (EXCO 'ETAT' V) ; XI = MAXI (EXCO 'SAUT' V) ;
    SJ = EXTR (T . 'ENERGIES' . 'JOINTS') 5 ; PJ = EXTR (T . 'ENERGIES' . 'DISSIPEE') 5 ;
    """
    s, p, sj, pj, state, xi = found(text, "S", "P", "SJ", "PJ", "E", "XI")
    assert state == 4.0
    assert p == pytest.approx(pj, rel=1e-12)
    assert s == pytest.approx(sj, rel=1e-12)
    assert p == pytest.approx(4 * 20 * (1 - np.exp(-1e5 * xi / 20)), rel=1e-7)


BESIDE = """
L9 = DROI 1 (5. 0.) (6. 0.) ; M9 = MODE L9 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' 'BARR' ;
A9 = MATE M9 'YOUN' 7. 'NU' 0. 'SIGY' 1. 'SECT' 2. 'RHO' 1. ; B9 = BLOQ 'DEPL' L9 ;
T1 . 'MODELE' = (T1 . 'MODELE') ET M9 ; T1 . 'RIGI' = (T1 . 'RIGI') ET (RIGI M9 A9) ET B9 ;
T1 . 'CARACTERISTIQUES' = (T1 . 'CARACTERISTIQUES') ET A9 ; T1 . 'MASS' = (T1 . 'MASS') ET
(MASS M9 A9) ;
"""


@pytest.mark.parametrize("beside", ["", BESIDE])
def test_vtk_without_mesh_takes_that_of_the_model_and_shows_states(tmp_path, beside):
    import meshio

    text = "T1 . 'PAS_SAUVES_VTK' = 100 ; T1 . 'FICHIER_VTK' = 'hop' ; T2 = DYNAMIC T1 ;"
    ran(HOPPER + beside + text, output_directory=tmp_path)
    files = sorted(tmp_path.rglob("hop*.vtu"))
    assert len(files) == 6
    for file in files:
        read = meshio.read(file)
        (opening,) = read.cell_data["opening"][0].ravel()[:1]
        state = read.cell_data["joint_state"][0][0]
        assert (state > 2) == (opening > 0)
        pressed = read.cell_data["traction"][0].ravel()[0]
        assert pressed == pytest.approx(1000 * min(opening, 0.0), abs=1e-9)
        stored = read.cell_data["stored_energy"][0][0]
        assert stored == pytest.approx(500 * min(opening, 0.0) ** 2, abs=1e-12)
        assert read.cell_data["lost_energy"][0][0] == 0.0


# --- parameters ---------------------------------------------------------------------------------


def test_mate_waits_for_parameters_that_come_later(found):
    text = f"""{STRIP}
    M = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
    C = (MATE M 'FU' 1.E5 'GF' 100.) ET (MATE M 'KN' 1.E9 'KS' 1.) ; K1 = RIGI M C ;
    K2 = RIGI M (MATE M 'KN' 1.E9 'KS' 1. 'FU' 1.E5 'GF' 100.) ;
    """
    later, at_once = found(text, "K1", "K2")
    assert later.blocks[0].values.any()
    np.testing.assert_array_equal(later.blocks[0].values, at_once.blocks[0].values)


def test_symmetric_friction_finds_the_same_slip(found):
    text = f"""{STRIP}
    DEBP SLIDE MO*MMODEL ;
      C = MATE MO 'KN' 1.E8 'KS' 1.E8 'FROT' 0.5 ; D = BLOQ 'UX' A ;
      T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = C ;
      KE = APPUI 'DEPL' 'UY' 1.E6 A ; T . 'RIGIDITE_CONSTANTE' = KE ;
      T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' 'UY' B) ET D ;
      E1 = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 1. 1. 0.4) ;
      E2 = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. -1.) ;
      T . 'CHARGEMENT' = (CHAR 'MECA' (FORC (0. -1.E4) A) E1) ET (CHAR 'DIMP' (DEPI D 1.E-3) E2) ;
      T . 'TEMPS_CALCULES' = PROG 0.25 'PAS' 0.25 2. ; PASAPAS T ;
    FINP (T . 'CONTRAINTES' . 8) (T . 'VARIABLES_INTERNES' . 8) ;
    M1 = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
    M2 = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'FROTTEMENT_SYMETRIQUE' ;
    S1 V1 = SLIDE M1 ; S2 V2 = SLIDE M2 ;
    """
    s1, s2, v1, v2 = found(text, "S1", "S2", "V1", "V2")
    for one, two in ((s1, s2), (v1, v2)):
        for name, values in one.blocks[0].components.items():
            scale = np.abs(values).max()
            np.testing.assert_allclose(
                two.blocks[0].components[name], values, rtol=0, atol=1e-9 * scale
            )
    shear, normal = (s1.blocks[0].components[n] for n in ("SMSN", "SMN"))
    np.testing.assert_allclose(np.abs(shear), 0.5 * np.abs(normal), rtol=1e-9)  # it slides


# --- persistent contact -------------------------------------------------------------------------

RESTING = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
* two masses joined by a spring on a rigid floor, the lower one touching it with a small velocity
P1 = 0. 0. ; P2 = 0. 1. ; L = DROI 1 P1 P2 ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; MA = MATE MO 'YOUN' 400. 'NU' 0. 'SECT' 1. ;
T1 = TABL ;
T1 . 'RIGI' = (RIGI MO MA) ET (BLOQ 'UX' L) ET (BLOQ 'MINI' 'UY' P1) ;
T1 . 'MASS' = (MASS 'DEPL' 3. P1) ET (MASS 'DEPL' 1. P2) ;
T1 . 'CHAR' = CHAR 'MECA' ((FORC (0. -30.) P1) ET (FORC (0. -10.) P2)) ;
T1 . 'VITE' = MANU 'CHPO' P1 1 'UY' -1.E-4 ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 5.E-4 1. ; T1 . 'PAS_SAUVES' = 'TOUS' ;
T1 . 'VITEUNIL' = FAUX ;
"""
READ = """
T2 = DYNAMIC T1 ;
EV = EVOL 'TEMP' T2 'VITE' 'UY' P1 ; V1 = EXTR EV 'ORDO' ; T = EXTR EV 'ABSC' ;
U1 = EXTR (EVOL 'TEMP' T2 'DEPL' 'UY' P1) 'ORDO' ;
U2 = EXTR (EVOL 'TEMP' T2 'DEPL' 'UY' P2) 'ORDO' ;
"""


def test_persistent_contact_stops_the_alternating_velocity(found):
    names = ("T", "U1", "V1", "U2")
    rings = [x.values for x in found(RESTING + READ, *names)]
    rests = [x.values for x in found(RESTING + "T1 . 'CONTACT_PERSISTANT' = VRAI ;" + READ, *names)]
    # it stays in contact: the upper mass swings on its spring, w = 20 rad/s, g = 10 m/s2
    t, u1, v1, u2 = rests
    assert np.abs(u1).max() < 1e-15
    exact = -10.0 / 400 * (1 - np.cos(20.0 * t))
    assert np.abs(u2 - exact).max() < 1e-4 * 0.05
    assert np.abs(v1[1:]).max() < 1e-16
    # C u_1 = C u_0 alone turns the velocity's sign at each step; the acceleration grows by
    # 4 V/dt a step until the mass is thrown off
    first = rings[2][:10]
    np.testing.assert_allclose(np.abs(first), 1e-4, rtol=1e-6)
    assert (first[1:] * first[:-1] < 0).all()
    assert rings[1].max() > 1e-3


def test_body_at_rest_on_a_relation_has_no_acceleration(found):
    text = f"""{RESTING.replace("-1.E-4", "0.")}
    T2 = DYNAMIC T1 ; A = EXTR (EVOL 'TEMP' T2 'ACCE' 'UY' P1) 'ORDO' ;
    """
    # beside the other mass, which swings with 10 m/s2: the step adds up what rounding leaves of
    # the velocities of the modes
    assert np.abs(found(text, "A").values).max() < 1e-7 * 10.0


@pytest.mark.parametrize("place", ["NOEUD", "STRESSES"])
def test_stiffness_given_at_nodes_is_the_mean_of_both_sides(place):
    """Below 1E6 (1 + x), above 3E6: a rigid opening w meets `w int (4E6 + 1E6 x) / 2 dx`."""
    find = finder(f"""OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
        L1 = DROI 3 (0. 0.) (2. 0.) ; L2 = DROI 3 (0. 0.) (2. 0.) ; J = RACC 1.E-6 L1 L2 ;
        MO = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
        LOW = NOMC 'SCAL' ((1.E6 * (COOR 1 L1)) + (MANU 'CHPO' L1 1 'SCAL' 1.E6)) ;
        KN = LOW ET (MANU 'CHPO' L2 1 'SCAL' 3.E6) ;
        MA = MATE MO 'KN' (CHAN 'CHAM' KN MO '{place}') 'KS' 0. ;
        W = MANU 'CHPO' L2 1 'UY' 1.E-3 ; F = (RIGI MO MA) * W ;
        TOTAL = MAXI (RESU (REDU F L2)) ;
        RIGHT = XTY F (NOMC 'UY' (COOR 1 L2)) (MOTS 'FY') (MOTS 'UY') ;
        """)
    assert find("TOTAL") == pytest.approx(1e-3 * (4e6 * 2 + 1e6 * 2) / 2)
    assert find("RIGHT") == pytest.approx(1e-3 * (4e6 * 2 + 1e6 * 8 / 3) / 2)


@pytest.mark.parametrize("dimension", [2, 3])
def test_anisotropic_joint_of_two_points_gives_its_matrix_times_the_jump(dimension, tmp_path):
    """A joint turned in space: stresses `D e` in its axes, forces `R^T D R u`."""
    size = 6 if dimension == 3 else 3
    random = np.random.default_rng(5)
    root = random.normal(size=(size, size))
    D = root @ root.T + np.eye(size)
    terms = " ".join(f"'D{i + 1}{j + 1}' {D[i, j]:.15E}" for i in range(size) for j in range(i + 1))
    if dimension == 3:
        axes, names = "'DIRECTION' (0. 0. 1.) (0. 1. 0.)", ("UX", "UY", "UZ", "RX", "RY", "RZ")
        frame = np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]])  # rows: normal, t1, t2 = n x t1
        turn = np.kron(np.eye(2), frame)
        ends = "P = 0. 0. 0. ; Q = 0. 0. 0.1 ;"
    else:
        axes, names = "'DIRECTION' (0. 1.)", ("UX", "UY", "RZ")
        turn = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])
        ends = "P = 0. 0. ; Q = 0. 0.1 ;"
    u = random.normal(size=size)
    given = " ".join(f"'{n}' {v:.15E}" for n, v in zip(names, u, strict=True))
    duals = {"UX": "FX", "UY": "FY", "UZ": "FZ", "RX": "MX", "RY": "MY", "RZ": "MZ"}
    coefficients = {3: ("ALP1", "ALP2", "ALQ3")}.get(
        size, ("ALP1", "ALP2", "ALP3", "ALQ1", "ALQ2", "ALQ3")
    )
    grown = random.normal(size=size)
    rates = " ".join(f"'{n}' {v:.15E}" for n, v in zip(coefficients, grown, strict=True))
    read = " ".join(f"F{i} = EXTR F '{duals[n]}' Q ;" for i, n in enumerate(names))
    find = finder(
        f"OPTI DIME {dimension} ELEM SEG2 ; {ends} L = MANU 'SEG2' P Q ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'ANISOTROPE' 'JOI1' ; "
        f"A = MATE M {terms} {axes} ; U = MANU 'CHPO' Q {given} ; F = (RIGI M A) * U ; "
        f"N = EXTR (SIGM M A U) 'EFFX' 1 1 1 ; B = MAXI (ABS (F - (BSIG M (SIGM M A U) A))) ; "
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "
        "T . 'TEMPS_CALCULES' = PROG 1. ; "
        "T . 'CHARGEMENT' = CHAR 'MECA' F (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; "
        "T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' 'ROTA' P ; PASAPAS T ; "
        "V = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' P)) F ; "
        "C = MAXI (ABS ((SIGM M A V) - (T . 'CONTRAINTES' . 1))) ; "
        "G = MAXI (ABS (F - ((KTAN M (SIGM M A U) (ZERO M 'VARINTER') A) * U))) ; "
        f"R = MATE M {terms} {axes} {rates} ; "
        "H = THET M R (MANU 'CHML' M 'T' 2. 'STRESSES') ; LC = EXTR M 'CONT' ; "
        + " ".join(f"H{i} = EXTR H (EXTR LC {i + 1}) 1 1 1 ;" for i in range(size))
        + f"{read}",
        tmp_path,
    )
    strain = turn @ u
    np.testing.assert_allclose(
        [find(f"F{i}") for i in range(size)], turn.T @ D @ strain, rtol=1e-12, atol=1e-12
    )
    assert find("N") == pytest.approx((D @ strain)[0])
    np.testing.assert_allclose([find(f"H{i}") for i in range(size)], 2.0 * D @ grown, rtol=1e-12)
    assert max(find("B"), find("G")) < 1e-12
    assert find("C") < 1e-9


SHEARED = """
OPTI DIME 3 ELEM QUA4 MODE TRID ;
P = 0. 0. 0. ; UP = P DROI 1 (1. 0. 0.) TRAN 1 (0. 1. 0.) ;
DOWN = (0. 0. 0.) DROI 1 (1. 0. 0.) TRAN 1 (0. 1. 0.) ;
OPTI ELEM CUB8 ; BODY = UP VOLU 1 TRAN (0. 0. 1.) ;
OPTI ELEM LIA4 ; J = LIAI 1.E-3 UP DOWN ;
M = (MODE BODY 'MECANIQUE' 'ELASTIQUE')
    ET (MODE J 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'COULOMB' 'JOI4') ;
A = MATE M 'YOUN' 100. 'NU' 0. 'KS' 100. 'KN' 100. 'EF' 150. 'ECN' 0.05 'COHE' 2. 'FRIC' 45. ;
PUSH = BLOQ 'UX' UP ;
T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' DOWN) ET PUSH ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI PUSH 0.1) (EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1. 2. ;
T . 'MES_SAUVEGARDES' = TABL ; T . 'MES_SAUVEGARDES' . 'DEFTO' = VRAI ;
"""


def test_a_sheared_dilatant_joint_lifts_what_stands_on_it(found):
    """Shear at the cohesion, slip of 0.1 - 2/100 at 45 degrees: lifted by 0.08, no pressure.

    All of the slip and all of the lift are plastic; the words of tables are written bare, as
    published scripts write them, longer than a name may be.
    """
    names = found(
        SHEARED + "PASAPAS T ; U = EXTR (T . deplacements . 2) 'UZ' P ;\n"
        "S = T . contraintes . 2 ; D = T . deformations_inelastiques . 2 ;\n"
        "E = T . deformations . 2 ; S1 = EXTR S 'SMN' 2 1 1 ; S2 = EXTR S 'SMS1' 2 1 1 ;\n"
        "D1 = EXTR (REDU D J) 'FRN' 1 1 1 ; D2 = EXTR (REDU D J) 'FRS1' 1 1 1 ;\n"
        "E1 = EXTR (REDU E J) 'DRS1' 1 1 1 ; E2 = MAXI 'ABS' (EXCO 'EPXX' E) ;",
        *("U", "S1", "S2", "D1", "D2", "E1", "E2"),
    )
    expected = [0.08, 0.0, 2.0, 0.08, 0.08, 0.1, 0.0]
    np.testing.assert_allclose(np.abs(names), expected, rtol=1e-9, atol=1e-9)


NEAR, FAR, DASH, MASS, TURN = 4.0e8, 6.0e8, 8.0e6, 1.0e5, 2.0e5
FAR_FIELD = f"""
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; PS = 0. 0. ; PC = 0. 0.001 ; N0 = 1.E6 ; T = TABL ;
M = MODE (MANU 'SEG2' PS PC) 'MECANIQUE' 'ELASTIQUE' 'MACRO_SEMELLE' 'JOI1' ;
T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = MATE M 'KN' {NEAR} 'KS' 1.E8 'LARG' 4. {{ground}} ;
T . 'RIGI' = (APPU 'UY' {FAR} PS) ET (APPU 'RZ' {FAR} PS) ET (BLOQ 'UX' (PS ET PC)) ;
T . 'AMOR' = (APPU 'UY' {DASH} PS) ET (APPU 'RZ' {DASH} PS) ;
T . 'MASS' = (MASS 'DEPL' {MASS} PC) ET (MASS 'ROTA' {TURN} PC) ;
V0 = 1.E6 / {NEAR} ; V1 = 1.E6 / {FAR} ;
T . 'CHAR' = CHAR 'MECA' (FORC (0. -1.E6) PC) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'DEPL' = (MANU 'CHPO' PC 2 'UY' (-1. * (V0 + V1)) 'RZ' 0.) ET
 (MANU 'CHPO' PS 2 'UY' (-1. * V1) 'RZ' 0.) ;
T . 'VITE' = MANU 'CHPO' PC 2 'UY' 0. 'RZ' {{speed}} ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 2.E-4 0.2 ; T . 'PAS_SAUVES' = 1 ; R = DYNAMIC T ;
TC = EXTR (EVOL 'TEMP' R 'DEPL' 'RZ' PC) 'ORDO' ; TS = EXTR (EVOL 'TEMP' R 'DEPL' 'RZ' PS) 'ORDO' ;
FN = EXTR (EVOL 'TEMP' R 'CONTRAINTES' 'EFFX' M 1 1 1) 'ORDO' ; E = T . 'ENERGIES' ;
VS = EXTR (EVOL 'TEMP' R 'VITE' 'RZ' PS) 'ORDO' ;
MZ = EXTR (EVOL 'TEMP' R 'CONTRAINTES' 'MOMZ' M 1 1 1) 'ORDO' ;
"""


def far_field(speed, ground="", more=""):
    """Rotations of footing and ground, force between them, energies, of a footing thrown over."""
    find = finder(FAR_FIELD.format(speed=speed, ground=ground))
    energies = {str(k): np.array(v.values) for k, v in find("E").items() if str(k) != "TEMPS"}
    return [np.array(find(name).values) for name in ["TC", "TS", "FN", *more.split()]], energies


def test_dashpots_below_the_ground_of_a_footing_in_full_contact():
    """A spring below a mass, in line with a spring and a dashpot: three exponentials."""
    (turn, ground, _), energies = far_field(0.05)
    k = NEAR * 4.0**2 / 12
    A = np.array([[0, 1, 0], [-k / TURN, 0, k / TURN], [k / DASH, 0, -(k + FAR) / DASH]])
    rates, shapes = np.linalg.eig(A)
    parts = np.linalg.solve(shapes, np.array([0.0, 0.05, 0.0]).astype(complex))
    exact = (shapes @ (parts[:, None] * np.exp(rates[:, None] * np.arange(1001) * 2e-4))).real
    np.testing.assert_allclose(turn, exact[0], atol=2e-4 * np.abs(exact[0]).max())
    np.testing.assert_allclose(ground, exact[2], atol=2e-4 * np.abs(exact[2]).max())
    rate = (k * exact[0] - (k + FAR) * exact[2]) / DASH
    assert energies["AMORTIE"][-1] == pytest.approx(DASH * np.trapezoid(rate**2) * 2e-4, rel=1e-3)


def test_dashpots_below_the_ground_brake_no_footing_that_has_left_it():
    (turn, below, force), energies = far_field(0.8)
    flying = (force[1:-1] == 0.0) & (force[:-2] == 0.0) & (force[2:] == 0.0)
    assert flying.sum() > 400
    bend = np.abs(np.diff(turn, 2))
    assert bend[flying].max() < 1e-9 * bend.max()
    free = below[1:-1][flying][:20]  # the ground alone goes back: K theta + C theta' = 0
    np.testing.assert_allclose(np.log(free[1:] / free[:-1]) / 2e-4, -FAR / DASH, rtol=1e-3)
    assert np.abs(energies["ECART"]).max() < 1e-3 * energies["AMORTIE"][-1]


def test_dashpots_below_ground_that_yields_carry_what_it_carries():
    (_, below, _, rate, moment), energies = far_field(0.8, "'COHE' 2.E5", "VS MZ")
    np.testing.assert_allclose(
        moment[1:], (FAR * below + DASH * rate)[1:], atol=1e-6 * np.abs(moment).max()
    )
    assert energies["DISSIPEE"][-1] > energies["AMORTIE"][-1] > 1e3
    assert np.abs(energies["ECART"]).max() < 1e-3 * energies["AMORTIE"][-1]
