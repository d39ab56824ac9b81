"""ORDO with its keywords first, of tables and of meshes."""

import itertools

import numpy as np
from script_runs import found
from together import together

LISTS = "L = PROG 3. -1. 2. ; E = LECT 30 10 20 ; C = PROG 5. 1. 2. 1. 5. 3. 2. 2. 9. ; "


@together("phrase", ["'COUT' C L E", "L E 'COUT' C", "'COUT' C 'HONG' L E", "L 'COUT' C 'COMP' E"])
def test_the_least_cost_is_that_of_all_permutations(phrase):
    text = f"{LISTS} X A B = ORDO {phrase} ;"
    costs, rows = np.array([[5, 1, 2], [1, 5, 3], [2, 2, 9.0]]), [0, 1, 2]
    totals = {p: costs[rows, list(p)].sum() for p in itertools.permutations(rows)}
    best = min(totals, key=totals.__getitem__)
    assert found(text, "X") == totals[best]
    assert list(found(text, "A").values) == [np.array([3.0, -1.0, 2.0])[i] for i in best]
    assert list(found(text, "B").values) == [np.array([30, 10, 20])[i] for i in best]


@together("phrase", ["T E 'DECR'", "'DECR' T E"])
def test_a_list_beside_the_table_sorts_those_of_its_length(phrase):
    text = f"{LISTS} T = TABL ; T . 'A' = L ; T . 1 = MOTS 'x' 'y' 'z' ; T . 2 = PROG 8. 7. ; "
    text += f"X = ORDO {phrase} ; A = X . 'A' ; B = X . 1 ; D = X . 2 ;"
    assert list(found(text, "A").values) == [3, 2, -1]
    assert [str(w) for w in found(text, "B").values] == ["x", "z", "y"]
    assert list(found(text, "D").values) == [8, 7]


@together("kind, size", [("QUA4", (4, 3)), ("TRI3", (3, 2))])
def test_each_cell_of_an_ordered_surface_has_a_neighbour_before_it(kind, size):
    text = (
        f"OPTI DIME 2 ELEM {kind} ; S = (DROI {size[0]} (0. 0.) (3. 0.)) TRAN {size[1]} (0. 1.) ; "
        "N = NBEL S ; A = S ELEM 1 ; REPE B (N - 1) ; A = (S ELEM (&B + 1)) ET A ; FIN B ; "
        "X = ORDO A ; OPTI ELEM QUA4 ; T = (DROI 1 (9. 9.) (10. 9.)) TRAN 1 (0. 1.) ; "
    )
    (block,) = found(text, "X").blocks
    (before,) = found(text, "A").blocks
    assert sorted(map(tuple, block.raw.tolist())) == sorted(map(tuple, before.raw.tolist()))
    assert block.raw[0].tolist() == before.raw[0].tolist()
    seen: set[int] = set(block.raw[0].tolist())
    for cell in block.raw[1:].tolist():
        assert len(seen & {*cell}) >= 2
        seen |= {*cell}
