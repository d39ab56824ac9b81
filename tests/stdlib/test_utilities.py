"""CONVT @PALETTE CHPR0 @EXCEL1 PECHE."""

from script_runs import found, ran
from together import together


@together("count", range(21))
def test_palette_has_different_colours_that_the_picture_knows(count):
    colours = [str(c).strip() for c in found(f"L = @PALETTE {count} ;", "L").values]
    assert len(set(colours)) == len(colours) == count


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
