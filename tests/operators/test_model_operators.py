"""MODE MATE CARA VALE and what they refuse, through scripts; parts of models, sizes of cells."""

import io

import numpy as np
import pytest
from script_runs import ran
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


MODELS = (
    "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 4. 0. ; PC = 4. 3. ; L = DROI 4 PA PB ; "
    "K = DROI 2 PB PC ; M1 = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
    "M2 = MODE K 'MECANIQUE' 'ELASTIQUE' 'POUT' ; MO = M1 ET M2 ; "
)


def test_internal_variables_of_a_model_are_named(found):
    """Those of a law once, in the order of its field; none of an elastic body."""
    script = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = ((0. 0.) D 2 (1. 0.)) TRAN 1 (0. 1.) ; "
        "A = MODE (S ELEM 1) MECANIQUE ELASTIQUE PLASTIQUE CINEMATIQUE ; "
        "B = MODE (S ELEM 2) MECANIQUE ELASTIQUE PLASTIQUE PARFAIT ; "
        "X = EXTR (A ET B) 'VARI' ; Y = EXTR B 'VARI' ; "
        "Z = EXTR (MODE S MECANIQUE ELASTIQUE) 'VARI' ; "
    )
    both, one, none = (list(v.values) for v in found(script, "X", "Y", "Z"))
    axes = ["ALXX", "ALYY", "ALZZ", "ALXY", "ALXZ", "ALYZ"]
    assert [str(n).rstrip() for n in both] == ["EPSE", *axes]
    assert [str(n).rstrip() for n in one] == ["EPSE"]
    assert none == []


def test_single_value_stands_where_it_is_put(found, refused):
    words = "'TYPE' 'SCALAIRE' 'POSI' 'GRAVITE'"
    field = found(MODELS + f"C = MANU 'CHAM' MO {words} 'V' 2 1 7. ;", "C")
    assert np.ravel(field.blocks[0].components["V"]).tolist() == [0, 7, 0, 0]
    assert field.title == "SCALAIRE"
    assert "4 cells" in refused(MODELS + "C = «MANU» 'CHAM' MO 'V' 9 1 7. ;")


def test_an_elastic_body_has_none_of_the_internal_variables(found, refused):
    """REDU gives what is there of them, nothing, and ET counts on; other fields are refused."""
    script = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = ((0. 0.) D 2 (1. 0.)) TRAN 1 (0. 1.) ; "
        "G = S ELEM 1 ; H = S ELEM 2 ; A = MODE G MECANIQUE ELASTIQUE ; "
        "B = MODE H MECANIQUE ELASTIQUE PLASTIQUE PARFAIT ; M = A ET B ; "
        "C = (MATE A YOUN 1. NU 0.) ET (MATE B YOUN 1. NU 0. SIGY 0.1) ; "
        "D = BLOQ UX UY S ; T = TABL ; T . MODELE = M ; T . CARACTERISTIQUES = C ; "
        "X = COOR 1 S ; T . BLOCAGES_MECANIQUES = D ; "
        "T . CHARGEMENT = CHAR DIMP (DEPI D (NOMC UX X)) (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ; "
        "T . TEMPS_CALCULES = PROG 1. ; PASAPAS T ; V = T . VARIABLES_INTERNES . 1 ; "
    )
    of_elastic = "E = REDU V G ; F = REDU V A ; "
    both = "N = EXTR (E ET F) NBZO ; P = MAXI (E ET (REDU V H)) ; Q = MAXI V ; "
    n, p, q = found(script + of_elastic + both, "N", "P", "Q")
    assert (n, p) == (0, q)
    assert q > 0.5
    assert "no cell" in refused(script + "E = REDU (REDU (T . CONTRAINTES . 1) H) G ;")


def test_a_mode_of_the_plane_gives_way_in_space():
    result = ran("OPTI 'DIME' 3 'ELEM' CUB8 'MODE' 'PLAN' ; M = VALE 'MODE' ;")
    assert result.session.root.find("M") == "TRID"
    assert [w.code for w in result.session.warnings] == ["operators.session.mode-in-space"]


@together("word, told", [("JAUMANN", 1), ("'QUAD'", 1), ("LINEAIRE", 0)])
def test_a_measure_of_strains_that_changes_nothing_is_told(word, told):
    warnings = ran(f"OPTI EPSILON {word} ;").session.warnings
    assert [w.code for w in warnings] == ["operators.session.strain-measure-without-effect"] * told
