"""PART and CCON: zones of lines, surfaces and volumes; @ISOSURF."""

import pytest
from script_runs import found, ran, refused
from together import together

from ssilang.cli.run import run_text

STAR = (
    "OPTI DIME 2 ELEM SEG2 ; O = 0. 0. ; L = (DROI 2 O (1. 0.)) ET (DROI 3 O (0. 1.)) "
    "ET (DROI 4 O (-1. 0.)) ET (DROI 5 (3. 0.) (4. 0.)) ; "
)
SHEETS = (
    "OPTI DIME 3 ELEM QUA4 ; O = 0. 0. 0. ; Y = DROI 3 O (0. 3. 0.) ; A = Y TRAN 2 (1. 0. 0.) ; "
    "B = Y TRAN 4 (0. 0. 1.) ; "
)


def cells_of(script: str) -> list[int]:
    """Numbers of cells of the zones of T."""
    table = found(script, "T")
    return [mesh.n_cells for index, mesh in table.items() if index != "SOUSTYPE"]


@together(
    "phrase, expected",
    [
        ("PART 'CONN' L", [9, 5]),
        ("CCON L", [9, 5]),
        ("PART 'SEPA' L 'LIGN'", [2, 3, 4, 5]),
        ("CCON 'STR1' L", [2, 3, 4, 5]),
        ("PART 'NESC' 'SEPA' L 'MAIL' (MANU 'POI1' (L POIN 'PROC' (3.4 0.)))", [9, 2, 3]),
    ],
)
def test_lines(phrase: str, expected: list[int]) -> None:
    assert cells_of(STAR + f"T = {phrase} ;") == expected


@together(
    "phrase, expected",
    [
        ("PART 'CONN' (A ET B)", [18]),
        ("PART 'SEPA' (A ET B) 'FACE'", [18]),  # two cells an edge: nothing separates
        ("PART 'SEPA' (A ET B ET (Y TRAN 1 (-1. 0. 0.))) 'FACE'", [6, 12, 3]),
        ("PART 'SEPA' (A ET B) 'MAIL' Y", [6, 12]),
        ("PART 'SEPA' (A ET B) 'ANGL'", [6, 12]),
        ("PART 'SEPA' (A ET B) 'ANGL' 100.", [18]),
        ("PART 'SEPA' (A ET (INVE (Y TRAN 1 (-1. 0. 0.)))) 'ANGL'", [9]),
    ],
)
def test_surfaces(phrase: str, expected: list[int]) -> None:
    assert cells_of(SHEETS + f"T = {phrase} ;") == expected


def test_volumes_on_both_sides_of_a_surface() -> None:
    script = SHEETS + "OPTI ELEM CUB8 ; V = A VOLU 'TRAN' 4 (0. 0. 2.) ; F = FACE 2 V ; "
    script += "W = F VOLU 'TRAN' 1 (0. 0. 1.) ; T = PART 'SEPA' (V ET W) 'MAIL' F ;"
    assert cells_of(script) == [24, 6]


def test_sub_type_is_for_parallel_runs_only() -> None:
    result = run_text(STAR + "A = PART 'CONN' L ; B = PART 'NESC' 'CONN' L ; C = CCON L ;")
    assert [result.session.root.find(n).subtype for n in "ABC"] == ["ESCLAVE", "", ""]


def test_lines_of_several_values() -> None:
    result = ran(
        "OPTI DIME 2 ELEM TRI3 ; S = (DROI 3 (0. 0.) (1. 0.)) TRAN 3 (0. 2.) ; "
        "M C = @ISOSURF S (PROG 0.25 0.5 7.) (COOR 1 S) ; L = MESU M ; A = MINI C ; B = MAXI C ; "
        "E = MAXI ((COOR 1 M) - C) 'ABS' ;"
    )
    values = [result.session.root.find(n) for n in "LABE"]
    assert values == pytest.approx([4.0, 0.25, 0.5, 0.0])


@together(
    "phrase, expected",
    [
        ("PART 'ARLE' L 4", [4, 4, 3, 3]),
        ("PART 'OPTI' L", [7, 7]),
        ("PART 'OPTI' 4 L", [4, 3, 4, 3]),
    ],
)
def test_parts_of_equal_sizes_and_their_union(phrase: str, expected: list[int]) -> None:
    script = STAR + f"T = {phrase} ; M = ETG T ; N = NBEL (DIFF M L) ; K = NBEL M ;"
    assert sorted(cells_of(script)) == sorted(expected)
    root = run_text(script).session.root
    assert (root.find("N"), root.find("K")) == (0, 14)


def test_union_of_a_table_of_numbers_and_of_no_parts() -> None:
    result = ran(
        "T = TABL 'ESCLAVE' ; T . 1 = PROG 1. ; T . 2 = PROG 2. 3. ; X = ETG T ; "
        "Y = INTE X (PROG 3. 1. 7.) ;"
    )
    assert result.session.root.find("X").values.tolist() == [1.0, 2.0, 3.0]
    assert result.session.root.find("Y").values.tolist() == [1.0, 3.0]
    assert "sub-type" in refused("T = TABL ; T . 1 = 2 ; X = ETG T ;")
