"""Shells with points across the thickness that yield and creep: thin, and COQ6 and COQ8."""

import numpy as np
import pytest
from script_runs import ran

STRIP = """
OPTI DIME 3 ELEM {cell} ;
L = DROI 3 (0. 0. 0.) (10. 0. 0.) ; S = L TRAN 1 (0. 1. 0.) ;
L1 = COTE S 4 ; L2 = COTE S 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' {law} {element} ;
MA = MATE MO 'YOUN' 2.E11 'NU' {nu} {strength} 'EPAI' 0.5 ;
B1 = BLOQ 'UX' 'UZ' 'RY' 'RX' L1 ; B2 = BLOQ '{what}' L2 ; B3 = BLOQ 'UY' (POIN L1 1) ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = B1 ET B2 ET B3 ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI B2 {size}) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 0.1 'PAS' 0.1 1. ;
PASAPAS T ;
R = RESU (REDU (T . 'REACTIONS' . 10) L2) ; F = EXTR R '{dual}' (POIN L2 1) ;
"""
YIELDS = {"law": "'PLASTIQUE' 'PARFAIT'", "strength": "'SIGY' 1.E8", "nu": "0.3"}
TRAC = "'TRAC' (EVOL 'MANU' (PROG 0. 5.E-4 5.E-3) (PROG 0. 1.E8 {}))"
HARDENS = {"law": "'PLASTIQUE' 'ISOTROPE'", "strength": TRAC.format("1.9E8")}
SHELLS = [("QUA8", "COQ8"), ("TRI6", "COQ6")]


def run(tmp_path, cell, element, more="", **words):
    text = STRIP.format(cell=cell, element=element, **{**YIELDS, **words}) + more
    return ran(text, output_directory=tmp_path).session.root.find


@pytest.mark.parametrize(("cell", "element"), SHELLS)
def test_below_the_limit_the_shell_is_the_elastic_one(tmp_path, cell, element):
    """Bent by a force across, with its shear stresses; and again from the state it kept."""
    elastic = f"""
        ME = MODE S 'MECANIQUE' 'ELASTIQUE' {element} ;
        AE = MATE ME 'YOUN' 2.E11 'NU' 0.3 'EPAI' 0.5 ;
        U = RESO ((RIGI ME AE) ET B1 ET B2 ET B3) (DEPI B2 1.E-3) ; V = T . 'DEPLACEMENTS' . 10 ;
        A = (MAXI 'ABS' (V - U)) / (MAXI 'ABS' U) ; SE = SIGM ME AE U ;
        SP = T . 'CONTRAINTES' . 10 ; C = MAXI 'ABS' (EXCO 'SMSN' SE) ;
        B = MAXI 'ABS' ((EXCO 'SMSN' (CHAN 'CHPO' MO SP)) - (EXCO 'SMSN' (CHAN 'CHPO' ME SE))) ;
        T . 'TEMPS_CALCULES' = PROG 2. ; PASAPAS T ;
        D = (MAXI 'ABS' ((T . 'DEPLACEMENTS' . 11) - U)) / (MAXI 'ABS' U) ;
    """
    find = run(tmp_path, cell, element, elastic, what="UZ", dual="FZ", size="1.E-3")
    assert find("C") > 1e3
    assert find("A") < 1e-9
    assert find("B") < 1e-6 * find("C")
    assert find("D") < 1e-9


@pytest.mark.parametrize(("cell", "element"), SHELLS)
def test_a_pulled_strip_bears_its_strength_times_its_section(tmp_path, cell, element):
    """All of it yields at 0.005: the slope of 2.E8, a thousandth, says where it lengthens."""
    words = {**HARDENS, "strength": TRAC.format("1.009E8")}
    find = run(tmp_path, cell, element, what="UX", dual="FX", size="0.0054", **words)
    assert find("F") == pytest.approx((1e8 + 2e8 * 4e-5) * 0.5, rel=1e-6)


def test_a_strip_hardens_along_its_curve(tmp_path):
    """Slope 2.E10 behind 1.E8: of the strain 1.E-3, beyond 5.E-4 the stress grows by a tenth."""
    find = run(tmp_path, "QUA8", "COQ8", what="UX", dual="FX", size="0.01", **HARDENS)
    assert find("F") == pytest.approx((1e8 + 2e10 * 5e-4) * 0.5, rel=1e-6)


@pytest.mark.parametrize(("cell", "element"), SHELLS)
def test_the_moment_of_two_points_across(tmp_path, cell, element):
    """Two forces S h / 2 at h / sqrt(12) from the middle: S h^2 / (2 sqrt(3))."""
    find = run(tmp_path, cell, element, what="RY", dual="MY", size="0.1", nu="0.")
    # triangles do not bend alike at all their points
    margin = {"COQ6": 1e-2, "COQ8": 1e-4}[element]
    assert abs(find("F")) == pytest.approx(1e8 * 0.25 / np.sqrt(12), rel=margin)


def test_shear_across_counts_in_the_criterion(tmp_path):
    """All rotations held: the shear of the law, up to S / sqrt(3), times the root of 5/6."""
    more = "B1 = BLOQ 'UX' 'UY' 'ROTA' S ; B3 = BLOQ 'UZ' L1 ; "
    text = STRIP.format(
        cell="QUA8", element="COQ8", what="UZ", dual="FZ", size="0.1", **YIELDS
    ).replace("T = TABL ;", more + "T = TABL ;")
    find = ran(text, output_directory=tmp_path).session.root.find
    assert find("F") == pytest.approx(np.sqrt(5 / 6) * 1e8 / np.sqrt(3) * 0.5, rel=1e-6)


@pytest.mark.parametrize(("cell", "element"), SHELLS)
def test_a_pulled_strip_creeps(tmp_path, cell, element):
    """Norton: s / E + AF1 s^AF2 t of a constant stress."""
    text = STRIP.format(
        cell=cell, element=element, what="UX", dual="FX", size="0.", law="'FLUAGE' 'NORTON'",
        nu="0.3", strength="'AF1' 1.E-28 'AF2' 3. 'AF3' 1."
    ).replace("B1 ET B2 ET B3", "B1 ET B3").replace(
        "CHAR 'DIMP' (DEPI B2 0.) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.))",
        "CHAR 'MECA' (PRES 'COQU' MO L2 1.) (EVOL 'MANU' (PROG 0. 2.) (PROG 1. 1.))",
    )  # fmt: skip
    # the forces of an elastic strip of the same stress
    text = text.replace("PRES 'COQU' MO L2 1.", "F1").replace(
        "T = TABL ;",
        f"ME = MODE S 'MECANIQUE' 'ELASTIQUE' {element} ; C1 = B1 ET B2 ET B3 ; T = TABL ; "
        "AE = MATE ME 'YOUN' 2.E11 'NU' 0.3 'EPAI' 0.5 ; K = RIGI ME AE ; "
        "F1 = REAC B2 (RESO (K ET C1) (DEPI B2 5.E-3)) ; ",
    )
    text = text.split("R = RESU")[0] + "U = EXTR (T . 'DEPLACEMENTS' . 10) 'UX' (POIN L2 2) ;"
    find = ran(text, output_directory=tmp_path).session.root.find
    stress = 1e8
    assert find("U") == pytest.approx(10 * (stress / 2e11 + 1e-28 * stress**3), rel=1e-6)


def test_stresses_turn_about_the_normal(tmp_path):
    """Of a strip pulled at 30 degrees of its axes; so do its plastic strains."""
    find = run(
        tmp_path, "QUA8", "COQ8",
        """
        SI = T . 'CONTRAINTES' . 10 ; V = (COS 30.) (SIN 30.) 0. ; X = RTEN SI MO V MA ;
        A = EXTR X 'SMSS' 1 1 1 ; B = EXTR X 'SMTT' 1 1 1 ; C = EXTR X 'SMST' 1 1 1 ;
        D = T . 'DEFORMATIONS_INELASTIQUES' . 10 ;
        E = EXTR (RTEN D MO (0. 1. 0.) MA) 'EISS' 1 1 1 ;
        G = EXTR (RTEN D MO (1. 0. 0.) MA) 'EISS' 1 1 1 ;
        """,
        what="UX", dual="FX", size="0.01", **HARDENS,
    )  # fmt: skip
    cos, sin = np.cos(np.pi / 6), 0.5
    assert [abs(find(n)) for n in "ABC"] == pytest.approx(
        [1.1e8 * cos**2, 1.1e8 * sin**2, 1.1e8 * sin * cos], rel=1e-6
    )
    assert find("G") == pytest.approx(1e-3 - 1.1e8 / 2e11, rel=1e-5)
    assert find("E") == pytest.approx(-0.5 * find("G"), rel=1e-5)


PLATE = """
OPTI DIME 3 ELEM TRI3 ;
L = DROI 3 (0. 0. 0.) (10. 0. 0.) ; S = L TRAN 1 (0. 1. 0.) ;
L1 = COTE S 4 ; L2 = COTE S 2 ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' {law} DKT 'INTEGRE' {layers} ;
MA = MATE MO 'YOUN' 2.E11 'NU' {nu} {strength} 'EPAI' 0.5 'ALPH' 1.E-5 ;
TE = MANU 'CHPO' S 3 'TINF' 1. 'T' 3. 'TSUP' 8. ;
B1 = BLOQ 'UX' 'UZ' 'RY' L1 ; B2 = BLOQ '{what}' L2 ; B3 = BLOQ 'UY' (POIN L1 1) ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = B1 ET B2 ET B3 ;
T . 'CHARGEMENT' = (CHAR 'DIMP' (DEPI B2 {size}) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.))) {heat} ;
T . 'TEMPS_CALCULES' = PROG 0. 0.1 'PAS' 0.1 1. ;
PASAPAS T ;
R = T . 'REACTIONS' . 10 ; F = EXTR (RESU (REDU R L2)) '{dual}' (POIN L2 1) ;
"""
PERFECT = {"law": "PARFAIT", "strength": "'SIGY' 1.E8"}


def run_thin(tmp_path, more="", **words):
    words = {"layers": 7, "nu": "0.", "heat": "", **PERFECT, **words}
    return ran(PLATE.format(**words) + more, output_directory=tmp_path).session.root.find


@pytest.mark.parametrize("layers", [2, 5])
def test_below_the_limit_the_thin_shell_is_the_elastic_one(tmp_path, layers):
    """Bent, and heated on one side more than on the other."""
    elastic = (
        "MO = MODE S 'MECANIQUE' 'ELASTIQUE' DKT ; MA = MATE MO 'YOUN' 2.E11 'NU' 0.3 'EPAI' 0.5 "
        "'ALPH' 1.E-5 ; H = THET MO MA TE ; U = RESO ((RIGI MO MA) ET B1 ET B2 ET B3) "
        "((DEPI B2 1.E-3) ET (BSIG MO MA H)) ; A = (T . 'DEPLACEMENTS' . 10) - U ; "
        "D = MAXI 'ABS' (EXCO 'UX' A) ; A = MAXI 'ABS' (EXCO 'UZ' A) ; "
        "SI0 = (SIGM MO MA U) - H ; SI1 = T . 'CONTRAINTES' . 10 ; "
        "B = MAXI 'ABS' (SI1 - SI0) ; C = MAXI 'ABS' (EXCO 'M11' SI0) ;"
    )
    heat = "ET (CHAR 'T' TE (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)))"
    words = {"what": "UZ", "dual": "FZ", "size": "1.E-3", "nu": "0.3", "heat": heat}
    find = run_thin(tmp_path, elastic, layers=layers, **words)
    assert find("A") < 1e-12
    assert find("D") < 1e-12
    assert find("B") < 1e-8 * find("C")


def test_a_pulled_strip_yields_at_once_across(tmp_path):
    find = run_thin(tmp_path, what="UX", dual="FX", size="0.0054")  # yields at 0.005
    assert find("F") == pytest.approx(1e8 * 0.5, rel=1e-8)


def test_bending_moment_follows_the_elastic_core(tmp_path):
    # the end turns: the moment is the same everywhere
    find = run_thin(tmp_path, what="RY", dual="MY", size="0.1", layers=15)
    kappa, h, yield_strain = 0.1 / 10, 0.5, 1e8 / 2e11
    core = 2 * yield_strain / kappa
    exact = 1e8 * h**2 / 4 * (1 - (core / h) ** 2 / 3)
    assert abs(find("F")) == pytest.approx(exact, rel=1e-2)
    inner = find("T").get("VARIABLES_INTERNES").get(10).blocks[0].components
    assert inner["EPSE"].shape[1] == 3 * 15
    s, t, st = (inner[k] for k in ("SMSS", "SMTT", "SMST"))
    assert np.sqrt(s**2 + t**2 - s * t + 3 * st**2).max() == pytest.approx(1e8, rel=1e-8)
    found = find("T").get("CONTRAINTES").get(10).blocks[0].components
    moments = found["M11"] + found["M22"]  # in the frame of each cell
    assert np.abs(moments) == pytest.approx(np.full(moments.shape, abs(find("F"))), rel=1e-6)


def test_a_calculation_goes_on_from_its_layers(tmp_path):
    again = (
        "T2 = COPI T ; T2 . 'REPRISE' = 0.5 ; PASAPAS T2 ; "
        "A = MAXI 'ABS' (EXCO 'EPSE' ((T . 'VARIABLES_INTERNES' . 10) - "
        "(T2 . 'VARIABLES_INTERNES' . 10))) ; R2 = T2 . 'REACTIONS' . 10 ; "
        "F2 = EXTR (RESU (REDU R2 L2)) 'MY' (POIN L2 1) ;"
    )
    hardening = {"law": "ISOTROPE", "strength": "'ECRO' (EVOL 'MANU' 'EPS' (PROG 0. 0.1) "
                 "'SIG' (PROG 1.E8 4.E8))"}  # fmt: skip
    find = run_thin(tmp_path, again, what="RY", dual="MY", size="0.1", **hardening)
    assert find("F2") == pytest.approx(find("F"), rel=1e-8)
    assert find("A") < 1e-10
