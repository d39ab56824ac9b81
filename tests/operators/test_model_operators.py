"""MODE MATE CARA and what they refuse, through scripts."""

import io

import pytest

from ssilang.cli.run import RunOptions, run_source
from ssilang.language.text.source import Source

SQUARE = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; P1 = 0. 0. ; P2 = 2. 0. ; L = DROI 2 P1 P2 ; "
    "S = TRAN 2 L (0. 1.) ; C = COTE 3 S ; "
)
ELASTIC = SQUARE + "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 1.E3 'NU' 0.25 'RHO' 3. ; "


@pytest.fixture
def run(tmp_path):
    def go(text):
        out, err = io.StringIO(), io.StringIO()
        options = RunOptions(output_directory=tmp_path)
        result = run_source(Source("script", text), options, out, err)
        return result, err.getvalue()

    return go


def value(run, text, name="X"):
    result, err = run(text)
    assert result.exit_code == 0, err
    return result.session.root.find(name)


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("M = MODE S MECANIQUE PLASTIQUE HUJEUX ;", "HUJEUX is out of ssilang's scope"),
        ("M = MODE S MECANIQUE ELASTIQUE PLASTIQUE TUYAU_FISSURE ;", "TUYAU_FISSURE is out of"),
        ("M = MODE S MECANIQUE ELASTIQUE PLASTIQUE DRUCKER_PRAGER_2 ;", "gives no equation"),
        ("M = MODE S MECANIQUE ELASTIQUE PLASTIQUE AMADEI ;", "FIMU SGMT I0"),
        ("M = MODE S MECANIQUE ELASTIQUE JOINT_SDM ;", "for joints only"),
        ("M = MODE S THERMIQUE ;", "THERMIQUE (heat) is out of ssilang's scope"),
        ("M = MODE S MECANIQUE ELASTIQUE ISOTORPE ;", "ISOTROPE"),
        ("OPTI MODE AXIS ; M = MODE L MECANIQUE ELASTIQUE ;", "name one of"),
        ("M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YONG' 3. ;", "YOUN"),
        ("M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'SECT' 3. ;", "SECT"),
        ("M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' (0. 1.) ;", "number"),
        ("M = MODE S MECANIQUE ELASTIQUE ; K = RIGI M (MATE M 'YOUN' 3.) ;", "NU is missing"),
        ("M = MODE S MECANIQUE ELASTIQUE ; K = RIGI M (MATE M 'YOUN' 3. 'NU' 0.6) ;", "0.6"),
        ("M = MODE S ;", "formulation"),
        ("M = MODE S MECANIQUE QUA8 ;", "QUA8 does not stand on QUA4"),
        ("M = MODE S MECANIQUE ; F = CNEQ M (MANU 'CHPO' S 1 'UX' 1.) ;", "FX FY"),
        ("M = MODE S MECANIQUE ; C = AMOR M (MATE M 'YOUN' 1. 'NU' 0.) ;", "VISQ is missing"),
        ("F = MOME (0. 1.) P1 ;", "no moment in the plane"),
        ("OPTI MODE AXIS ; M = MODE L MECANIQUE ELASTIQUE POUT ;", "AXIS"),
    ],
)
def test_wrong_models_and_parameters_are_refused_with_the_reason(run, statement, said):
    result, err = run(SQUARE + statement)
    assert result.exit_code == 1
    assert said in err


def test_components_of_a_model(run):
    text = ELASTIC + "X = EXTR M 'CONT' ; Y = EXTR M 'DEFO' ; Z = EXTR M 'FORC' ;"
    assert value(run, text).values == ["SMXX", "SMYY", "SMZZ", "SMXY"]
    assert value(run, text, "Y").values == ["EPXX", "EPYY", "EPZZ", "GAXY"]
    assert value(run, text, "Z").values == ["FX", "FY"]


def test_parameters_from_a_field_serve_their_own_cells(run):
    text = ELASTIC + (
        "E = MANU 'CHML' M 'REPA' 'SCAL' (PROG 1. 2. 3. 4.) ; B = MATE M 'YOUN' E 'NU' 0. ; "
        "X = EXTR B 'YOUN' 1 3 1 ;"
    )
    assert value(run, text) == 3.0


def test_a_model_reduced_to_a_part_takes_the_parameters_of_the_whole(run):
    text = ELASTIC + (
        "S2 = ELEM S 'APPU' 'STRI' (ELEM S 1) ; M2 = REDU M S2 ; X = INTG M2 (REDU A M2) 'YOUN' ;"
    )
    assert value(run, text) == pytest.approx(500.0)


def test_weight_of_a_plate_by_mass_and_by_volume_force(run):
    text = ELASTIC + (
        "G = MANU 'CHPO' S 2 'UX' 0. 'UY' -10. 'NATURE' 'DIFFUS' ; W = (MASS M A) * G ; "
        "D = CNEQ M (MANU 'CHPO' S 2 'FX' 0. 'FY' -30. 'NATURE' 'DIFFUS') ; "
        "X = MAXI 'ABS' (RESU (EXCO 'FY' W)) ; Y = MAXI 'ABS' (W - D) ;"
    )
    assert value(run, text) == pytest.approx(60.0)
    assert value(run, text, "Y") == pytest.approx(0.0, abs=1e-12)


def test_pulled_plate_has_the_stress_and_the_energy_of_the_bar(run):
    text = ELASTIC + (
        "K = (RIGI M A) ET (BLOQ 'UX' (COTE 4 S)) ET (BLOQ 'UY' P1) ; "
        "F = PRES 'MASS' M -5. (COTE 2 S) ; U = RESO K F ; SG = SIGM M A U ; "
        "X = MAXI (EXCO 'SMXX' SG) ; Y = INTG M (ENER M SG (EPSI M U)) ; Z = MAXI (VMIS M SG) ; "
        "T = MAXI 'ABS' ((BSIG M SG) - ((RIGI M A) * U)) ; V = YTMX U U (RIGI M A) ;"
    )
    assert value(run, text) == pytest.approx(5.0)
    assert value(run, text, "Y") == pytest.approx(2.0 * 25.0 / 1e3)
    assert value(run, text, "Z") == pytest.approx(5.0)
    assert value(run, text, "T") == pytest.approx(0.0, abs=1e-10)
    assert value(run, text, "V") == pytest.approx(2.0 * 25.0 / 1e3)


def test_hooke_matrices_replace_the_parameters(run):
    text = ELASTIC + (
        "H = HOOK M A ; U = NOMC 'UX' (COOR 1 S) ; "
        "X = MAXI 'ABS' ((SIGM M H U) - (SIGM M A U)) ; "
        "Y = (XTMX U (RIGI M H)) - (XTMX U (RIGI M A)) ;"
    )
    assert value(run, text) == pytest.approx(0.0, abs=1e-10)
    assert value(run, text, "Y") == pytest.approx(0.0, abs=1e-9)


def test_stress_fields_and_parameters_may_come_in_any_order(run):
    text = ELASTIC + (
        "U = NOMC 'UX' (COOR 1 S) ; SG = SIGM U M A ; "
        "X = MAXI 'ABS' ((VMIS M A SG) - (VMIS M SG)) ;"
    )
    assert value(run, text) == pytest.approx(0.0, abs=1e-12)


def test_additional_springs_masses_and_dashpots_stand_at_every_node(run):
    text = SQUARE + (
        "U = MANU 'CHPO' L 2 'UX' 1. 'UY' 2. ; X = XTMX U (RIGI 'DEPL' 3. L) ; "
        "Y = XTMX U (MASS 'UY' 3. L) ; Z = XTMX U (AMOR UX 3. P1) ;"
    )
    assert value(run, text) == pytest.approx(3 * 3.0 * 5.0)
    assert value(run, text, "Y") == pytest.approx(3 * 3.0 * 4.0)
    assert value(run, text, "Z") == pytest.approx(3.0)


def test_lumped_mass_keeps_the_mass(run):
    text = ELASTIC + (
        "U = MANU 'CHPO' S 1 'UX' 1. ; X = XTMX U (LUMP M A) ; Y = XTMX U (LUMP (MASS M A)) ;"
    )
    assert value(run, text) == pytest.approx(6.0)
    assert value(run, text, "Y") == pytest.approx(6.0)


def test_hand_made_matrix_from_its_lower_triangle(run):
    text = SQUARE + (
        "E = MANU 'SEG2' P1 P2 ; K = MANU 'RIGIDITE' E (MOTS 'UX') (PROG 3. -3. 3.) ; "
        "U = (MANU 'CHPO' P1 'UX' 1.) ET (MANU 'CHPO' P2 'UX' 3.) ; X = XTMX U K ;"
    )
    assert value(run, text) == pytest.approx(12.0)


def test_shells_beams_and_bars_share_a_model_list(run):
    text = (
        "OPTI DIME 3 ELEM SEG2 ; P = 0. 0. 0. ; Q = 1. 0. 0. ; L = DROI 2 P Q ; "
        "M = (MODE L MECANIQUE BARRE) ET (MODE L MECANIQUE TIMO) ; "
        "X = DIME (EXTR M 'CONT') ; Z = EXTR M 'ZONE' ; Y = DIME Z ;"
    )
    assert value(run, text) == 6
    assert value(run, text, "Y") == 4


def test_pressure_model_gives_the_same_forces_as_a_pressure_on_sides(run):
    text = ELASTIC + (
        "F1 = PRES 'MASS' M 5. C ; MP = MODE C 'CHARGEMENT' 'PRESSION' ; "
        "F2 = BSIG MP (PRES MP 'PRES' 5.) ; X = MAXI 'ABS' (F1 - F2) ; "
        "CP = MANU 'CHPO' C 1 'P' 5. ; F3 = PRES 'MASS' M (CHAN 'CHAM' CP M) ; "
        "Y = MAXI 'ABS' (F1 - F3) ; Z = MAXI 'ABS' (RESU F1) ; "
        "T = MAXI 'ABS' (SIGM (M ET MP) A (MANU 'CHPO' S 1 'UX' 0.)) ;"
    )
    assert value(run, text) == pytest.approx(0.0, abs=1e-12)
    assert value(run, text, "Y") == pytest.approx(0.0, abs=1e-12)
    assert value(run, text, "Z") == pytest.approx(10.0)
    assert value(run, text, "T") == 0.0


def test_the_harmonic_in_force_counts_not_that_of_the_model(run):
    text = (
        "OPTI DIME 2 MODE FOUR 0 ELEM QUA4 ; P1 = 1. 0. ; P2 = 2. 0. ; L = DROI 1 P1 P2 ; "
        "S = TRAN 1 L (0. 1.) ; M = MODE S MECANIQUE ; A = MATE M 'YOUN' 1. 'NU' 0. ; "
        "U = MANU 'CHPO' S 1 'UR' 1. ; X = XTMX U (RIGI M A) ; OPTI MODE FOUR 1 ; "
        "V = MANU 'CHPO' S 2 'UR' 1. 'UT' -1. ; Y = XTMX V (RIGI M A) ;"
    )
    assert value(run, text) > 0.1
    assert value(run, text, "Y") == pytest.approx(0.0, abs=1e-12)  # a rigid translation


def test_field_of_revolution_in_space(run):
    text = (
        "OPTI DIME 2 MODE AXIS ELEM SEG2 ; L = DROI 2 (1. 0.) (1. 1.) ; "
        "U = MANU 'CHPO' L 2 'UR' 2. 'UZ' 3. 'NATURE' 'DIFFUS' ; T = CREER_3D L U 360. 8 0 ; "
        "G = T . 'MAILLAGE' ; D = T . 'DEPLACEMENT' ; "
        "X = MAXI 'ABS' ((EXCO 'UY' D) - (2. * (COOR 2 G))) ; Y = MINI (EXCO 'UZ' D) ; "
        "Z = NBNO G ;"
    )
    assert value(run, text) == pytest.approx(0.0, abs=1e-12)
    assert value(run, text, "Y") == pytest.approx(3.0)
    assert value(run, text, "Z") == 24


def test_vibr_takes_a_mass_of_both_signs_for_a_buckling_load(run):
    text = (
        "OPTI DIME 2 ; P = 0. 0. ; K = MANU 'RIGIDITE' P (MOTS 'UX' 'UY') (PROG 4. 0. 9.) ; "
        "G = MANU 'RIGIDITE' 'TYPE' 'MASSE' P (MOTS 'UX' 'UY') (PROG 1. 0. -1.) ; "
        "T = VIBR 'PROC' (PROG 0.) K G ; X = (2. * PI * (T . 'MODES' . 1 . 'FREQUENCE')) ** 2 ;"
    )
    assert value(run, text) == pytest.approx(4.0)


def test_vibr_tells_of_a_mass_of_both_signs_and_refuses_one_that_is_negative(run, refused):
    spring = "OPTI DIME 2 ; P = 0. 0. ; K = APPU 'DEPL' 4. P ; "
    result, _ = run(
        spring + "G = (MASS 'UX' 1. P) ET (MASS 'UY' -2. P) ; T = VIBR 'SIMU' 0. 1 K G ;"
    )
    (said,) = [w for w in result.session.warnings if w.code.endswith("mass-of-both-signs")]
    assert said.data["value"] == -2.0
    assert "negative: -2" in refused(spring + "T = «VIBR» 'SIMU' 0. 1 K (MASS 'DEPL' -2. P) ;")


@pytest.mark.parametrize("asked", ["«RIGI» M A", "«MASS» M A", "«EPSI» M U", "«INTG» M C"])
def test_an_element_for_pressures_has_no_stiffness(refused, asked):
    told = refused(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; M = MODE L MECANIQUE ELASTIQUE SEG2 ;"
        "C = CHAN 'CHAM' (COOR 1 L) M 'STRESSES' ; A = MATE M YOUN 1. NU 0. RHO 1. ; "
        f"U = MANU 'CHPO' L 2 'UX' 1. 'UY' 0. ; X = {asked} ;"
    )
    assert "element SEG2 carries fields and pressures, it has no stiffness" in told
    assert "BARR, POUT, TIMO" in told
    assert "M1D2" not in told


@pytest.mark.parametrize("mode", ["DIME 2 MODE PLAN CONT", "DIME 2 MODE PLAN DEFO", "DIME 3"])
def test_lines_without_an_element_are_bars_in_plane_and_space(run, mode):
    end = "(3. 4. 0.)" if "3" in mode else "(3. 4.)"
    start = "(0. 0. 0.)" if "3" in mode else "(0. 0.)"
    result, err = run(
        f"OPTI {mode} ELEM SEG2 ; L = DROI 1 {start} {end} ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' ; E = EXTR M 'CONT' ; "
        "A = MATE M 'YOUN' 10. 'NU' 0. 'SECT' 2. ; U = (NOMC 'UX' ((COOR 1 L) * 0.03)) ET "
        "(NOMC 'UY' ((COOR 2 L) * 0.03)) ; N = MAXI (EXCO 'EFFX' (SIGM M A U)) ;"
    )
    assert result.exit_code == 0, err
    assert list(result.session.root.find("E").values) == ["EFFX"]
    assert result.session.root.find("N") == pytest.approx(10.0 * 2.0 * 0.03)


def test_a_yielding_line_without_an_element_is_a_bar_and_no_joint(run):
    result, err = run(
        "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = DROI 1 (0. 0.) (1. 0.) ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' ; E = EXTR M 'MATE' ;"
    )
    assert result.exit_code == 0, err
    assert "SIGY" in result.session.root.find("E").values


def test_lines_of_bodies_of_revolution_still_want_an_element(run):
    result, err = run(
        "OPTI DIME 2 MODE AXIS ELEM SEG2 ; L = DROI 1 (1. 0.) (2. 0.) ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' ;"
    )
    assert result.exit_code == 1
    assert "COQ2" in err
