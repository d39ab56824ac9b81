"""MODE MATE CARA and what they refuse, through scripts."""

import io

import pytest
from together import together

from ssilang.cli.run import RunOptions, run_source
from ssilang.language.text.source import Source

SQUARE = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; P1 = 0. 0. ; P2 = 2. 0. ; L = DROI 2 P1 P2 ; "
    "S = TRAN 2 L (0. 1.) ; C = COTE 3 S ; "
)


@pytest.fixture
def run(tmp_path):
    def go(text):
        out, err = io.StringIO(), io.StringIO()
        options = RunOptions(output_directory=tmp_path)
        result = run_source(Source("script", text), options, out, err)
        return result, err.getvalue()

    return go


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
        ("OPTI MODE AXIS ; M = MODE L MECANIQUE ELASTIQUE ;", "COQ2"),
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


def test_vibr_tells_of_a_mass_of_both_signs_and_refuses_one_that_is_negative(run, refused):
    spring = "OPTI DIME 2 ; P = 0. 0. ; K = APPU 'DEPL' 4. P ; "
    result, _ = run(
        spring + "G = (MASS 'UX' 1. P) ET (MASS 'UY' -2. P) ; T = VIBR 'SIMU' 0. 1 K G ;"
    )
    (said,) = [w for w in result.session.warnings if w.code.endswith("mass-of-both-signs")]
    assert said.data["value"] == -2.0
    assert "negative: -2" in refused(spring + "T = «VIBR» 'SIMU' 0. 1 K (MASS 'DEPL' -2. P) ;")


@together("asked", ["«RIGI» M A", "«MASS» M A", "«EPSI» M U", "«INTG» M C"])
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
