"""DEDU without keyword: meshes that follow; RAFF of lists."""

import numpy as np
import pytest
from script_runs import found, ran
from together import together


@together(
    "body",
    [
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (2. 0.)) TRAN 3 (0.5 1.) ; C = CONT S ; "
        "D = C AFFI 3. (0. 0.) (1. 1.) ; T = S AFFI 3. (0. 0.) (1. 1.) ;",
        "OPTI DIME 2 ELEM TRI3 ; C = CERC 20 'ROTA' 360. (1. 0.) (0. 0.) 'ELIM' ; S = SURF C ; "
        "D = C AFFI 2. (0. 0.) (1. 0.) ; T = S AFFI 2. (0. 0.) (1. 0.) ;",
        "OPTI DIME 3 ELEM CUB8 ; S = ((0. 0. 0.) DROI 3 (1. 0. 0.)) TRAN 3 (0. 1. 0.) ; "
        "S = VOLU 3 S 'TRAN' (0. 0. 1.) ; C = ENVE S ; D = C AFFI 2. (0. 0. 0.) (1. 1. 1.) ; "
        "T = S AFFI 2. (0. 0. 0.) (1. 1. 1.) ;",
    ],
)
def test_homogeneous_move_of_the_boundary_is_followed_exactly(body):
    script = body + (
        " R = DEDU S C D ; E = MAXI (ABS (T MOIN R)) ; N = (NBNO R) - (NBNO S) ; "
        "M = NBNO ((CHAN 'POI1' R) ET (CHAN 'POI1' D)) ; A = MESU R ; B = MESU T ;"
    )
    error, same, together, a, b = found(script, "E", "N", "M", "A", "B")
    assert error == pytest.approx(0.0, abs=1e-10)
    assert same == 0
    assert a == pytest.approx(b)
    assert together == found(script + " K = NBNO R ;", "K")


def test_inner_nodes_go_to_the_middle_of_their_neighbours():
    """One inner node pulled aside comes back to the middle; the contour's nodes stay themselves."""
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 2 (0. 2.) ; P = S POIN "
        "'PROC' (1. 1.) ; "
        "DEPL P 'PLUS' (0.4 0.3) ; C = CONT S ; {} Q = R POIN 'PROC' (1. 1.) ; X Y = COOR Q ; "
        "N = NBNO ((CHAN 'POI1' C) ET (CHAN 'POI1' R)) ; XP = COOR 1 P ;"
    )
    x, y, count, kept = found(script.format("R = S DEDU C C 'REGU' ;"), "X", "Y", "N", "XP")
    assert (x, y, count, kept) == pytest.approx((1.0, 1.0, 9, 1.4))
    assert found(script.format("R = DEDU S C C ;"), "X") == pytest.approx(1.4)


def test_refined_intervals_of_different_sizes_grade_into_each_other():
    values = np.asarray(found("L = RAFF (PROG 0. 1. 9.) -4 ;", "L").values)
    steps = np.diff(values)
    assert set(np.round([0.0, 1.0, 9.0], 9)) <= set(np.round(values, 9))
    assert (steps > 0).all()
    ratios = steps[1:] / steps[:-1]
    assert ratios.max() < 2.0
    assert steps[-1] > 3.0 * steps[0]


def test_raff_cuts_cells_and_ties_what_hangs():
    text = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
        "T = RAFF S (0.6 + (COOR 1 S)) ; H = T ELEM 'SURE' ; "
        "MO = MODE T 'MECANIQUE' 'ELASTIQUE' ; MESS (NBEL T) ' ' (NBEL H) ' ' (DIME (RELA MO)) "
        "' ' (NBEL (EXTR MO 'MAIL')) ;"
    )
    result = ran(text)
    # mean sizes 1.1 and 2.1: nothing is cut but the first square when sizes are halved
    assert result.output.split() == ["2", "0", "0", "2"]
    result = ran(text.replace("0.6 +", "0.3 +"))
    assert result.output.split()[:2] == ["6", "1"]
    assert result.output.split()[3] == "5"


@together("mesh, size", [
        ("OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = (DROI 4 (0. 0.) (4. 0.)) TRAN 3 (0. 3.) ;",
         "(0.15 + (0.4 * (COOR 1 S)))"),
        ("OPTI DIME 2 ELEM TRI3 MODE PLAN DEFO ; S = (DROI 3 (0. 0.) (4. 0.)) TRAN 2 (1. 3.) ;",
         "(0.2 + (0.4 * (COOR 2 S)))"),
        ("OPTI DIME 3 ELEM CUB8 ; S = (DROI 2 (0. 0. 0.) (4. 0. 0.)) TRAN 2 (0. 3. 0.) ; "
         "S = S VOLU 2 'TRAN' (0. 0. 2.) ;", "(0.3 + (0.5 * (COOR 1 S)))"),
    ])  # fmt: skip
def test_a_mesh_refined_before_is_refined_as_in_one_go(mesh, size):
    """Each division has its cause in the sizes, whenever it is made."""
    script = (
        f"{mesh} FIRST = RAFF S (2. * {size}) ; ONCE = RAFF S {size} ; "
        f"AGAIN = RAFF FIRST {size.replace(' S)', ' FIRST)')} ;"
    )
    first, once, again = found(script, "FIRST", "ONCE", "AGAIN")
    assert any(b.cell_type.startswith("SURE") for b in first.blocks)

    def cells(mesh):
        places = np.round(mesh.nodes.coordinates, 9)
        return {
            (b.cell_type, *sorted(tuple(places[n]) for n in c))
            for b in mesh.blocks
            for c in b.connectivity
        }

    assert len(cells(first)) < len(cells(once))
    assert cells(again) == cells(once)
    assert len(np.unique(np.round(again.nodes.coordinates[again.node_ids], 9), axis=0)) == len(
        again.node_ids
    )  # no node twice at a place


def test_ties_are_named_kept_in_saves_and_left_out_of_pictures(tmp_path):
    text = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = (DROI 4 (0. 0.) (4. 0.)) TRAN 4 (0. 4.) ; "
        "T = RAFF S (0.3 + (COOR 1 S)) ; MO = MODE T 'MECANIQUE' 'ELASTIQUE' ; "
        "N = DIME (RELA MO) ; LIST (ELEM T 'TYPE') ; OPTI SAUV 'x' ; SAUV MO T ; "
        "OUBL MO ; OPTI REST 'x' ; REST ; M = DIME (RELA MO) ; OPTI SORT 'v' ; SORT 'VTK' T ; "
        "OPTI SORT 'w' ; SORT 'AVS' T ;"
    )
    result = ran(text, output_directory=tmp_path)
    assert result.output.split()[-2:] == ["QUA4", "SURE"]
    root = result.session.root
    assert root.find("N") == root.find("M") > 0
    assert (tmp_path / "v.vtu").exists()
    assert len((tmp_path / "w.inp").read_text().split("\n")) > 20
