"""Fields in cells: making, algebra, components, masks."""

from script_runs import ran
from together import together

LINE = (
    "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 4. 0. ; L = DROI 4 PA PB ; "
    "C = MANU 'CHML' L 'A' 2. 'B' 5. ; S = MANU 'CHML' L 'SCAL' 3. ; "
)


@together(
    "other, told",
    [("C", []), ("C * 2.", [["A", "B"]]), ("CHAN 'CONS' (C * 2.) 'W'", []), ("S", [])],
)
def test_other_values_of_a_component_in_the_same_cells_are_told(other, told):
    done = ran(f"{LINE}D = C ET ({other}) ;")
    assert [w.data["names"] for w in done.session.warnings] == told
