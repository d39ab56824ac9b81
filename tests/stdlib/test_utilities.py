"""CONVT @PALETTE CHPR0 @EXCEL1 PECHE."""

import pytest
from script_runs import found, ran, refused
from together import together


@together("count", range(21))
def test_palette_has_different_colours_that_the_picture_knows(count):
    colours = [str(c).strip() for c in found(f"L = @PALETTE {count} ;", "L").values]
    assert len(set(colours)) == len(colours) == count


def test_palette_colours_curves_and_ends_at_twenty():
    script = "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ; F = VIDE 'EVOLUTIO' ; "
    script += "REPE A 20 ; F = F ET E ; FIN A ; G = COUL F (@PALETTE 20) ; N = DIME G ;"
    assert found(script, "N") == 20
    assert "between 0 and 20" in refused("L = @PALETTE 21 ;")


def test_field_values_follow_the_mesh():
    script = "OPTI DIME 2 ELEM SEG2 ; L = (0. 0.) DROI 4 (2. 0.) ; K = L ELEM (LECT 1 2) ; "
    script += "A = CHPR0 ((COOR 1 K) + 1.) (INVE L) ;"
    assert list(found(script, "A").values) in ([1.0, 1.5, 2.0, 0.0, 0.0], [0.0, 0.0, 2.0, 1.5, 1.0])


def test_curve_goes_to_a_file_of_two_columns(tmp_path):
    result = ran(
        "E = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 4.) ; @EXCEL1 E 'curve.csv' ; MESS 'after' ;",
        output_directory=tmp_path,
    )
    assert result.output.split()[-1] == "after"
    lines = next(tmp_path.rglob("curve.csv")).read_text().split("\n")
    rows = [[float(v) for v in line.split(";")] for line in lines if line.strip()]
    assert rows == [[0.0, 0.0], [1.0, 1.0], [2.0, 4.0]]


_RUN = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = ((0. 0.) DROI 1 (1. 0.)) TRAN 1 (0. 1.) ; "
    "MO = MODE S MECANIQUE ELASTIQUE ; B = BLOQ 'DEPL' (COTE 1 S) ; T = TABL ; "
    "T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MATE MO YOUN 10. NU 0. ; "
    "T . 'BLOCAGES_MECANIQUES' = B ; T . 'TEMPS_CALCULES' = PROG 0. 0.5 2. ; "
    "F = FORC (0. 1.) (COTE 3 S) ; "
    "T . 'CHARGEMENT' = CHAR 'MECA' F (EVOL 'MANU' (PROG 0. 2.) (PROG 0. 2.)) ; PASAPAS T ; "
)


@together(
    "call, value", [("", 0.2), ("2.", 0.2), ("0.5", 0.05), ("1.4 'IPOL'", 0.14), ("0. 'IPOL'", 0.0)]
)
def test_results_are_fished_at_a_time(call, value):
    script = _RUN + f"X = MAXI (EXCO 'UY' (PECHE T 'DEPLACEMENTS' {call})) ;"
    # two nodes share a unit force; the plate of modulus 10 stretches by 2 F / (E L) * t / 2
    assert found(script, "X") == pytest.approx(value, rel=1e-9)


def test_stresses_are_fished_too():
    script = _RUN + "X = MAXI (PECHE T 'CONTRAINTES' 1. 'IPOL') ;"
    assert found(script, "X") == pytest.approx(1.0, rel=1e-9)


def test_times_without_result_are_refused():
    assert "add IPOL" in refused(_RUN + "X = PECHE T 'DEPLACEMENTS' 1.4 ;")
    assert "not between" in refused(_RUN + "X = PECHE T 'DEPLACEMENTS' 3. 'IPOL' ;")
    assert "no index" in refused(_RUN + "X = PECHE T 'NONSENSE' ;")
