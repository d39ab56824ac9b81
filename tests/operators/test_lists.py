"""Making, searching, sorting and changing lists and tables against Python's own."""

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from script_runs import found, ran
from together import together

from ssilang.cli.run import run_text
from ssilang.language.values import Table
from ssilang.operators.lists import progressions

INTEGERS = st.lists(st.integers(-99, 99), min_size=1, max_size=15)
WORDS = st.lists(st.text("ABCab", min_size=1, max_size=4), min_size=1, max_size=10)


def value(script):
    return ran(f"X = {script} ;").session.root.find("X")


def items(script):
    made = value(script).values
    return made.tolist() if isinstance(made, np.ndarray) else [str(w) for w in made]


def lect(numbers):
    return "(LECT " + " ".join(str(n) for n in numbers) + ")"


def mots(words):
    return "(MOTS " + " ".join(f"'{w}'" for w in words) + ")"


@together("steps", ["0. PAS -1. 5.", "5. PAS 1. 0.", "0. PAS 0. 1.",
                                   "0. PAS -1. GEOM 2. 8."])  # fmt: skip
def test_steps_that_never_reach_their_end_leave_start_and_end(steps):
    start, end = steps.split()[0], steps.split()[-1]
    result = run_text(f"L = PROG {steps} 7. ;")
    assert list(result.session.root.find("L").values) == [float(start), float(end), 7.0]
    assert [w.code for w in result.session.warnings] == ["operators.lists.steps-left-out"]


@given(INTEGERS)
@settings(max_examples=25, deadline=None)
def test_sorting_agrees_with_python(numbers):
    assert items(f"ORDO {lect(numbers)}") == sorted(numbers)
    assert items(f"ORDO {lect(numbers)} 'DECR'") == sorted(numbers, reverse=True)
    assert items(f"ORDO {lect(numbers)} 'ABSO'") == sorted(numbers, key=abs)
    assert items(f"ORDO {lect(numbers)} 'UNIQ'") == sorted(set(numbers))
    assert items(f"UNIQ {lect(numbers)}") == list(dict.fromkeys(numbers))
    assert items(f"INVE {lect(numbers)}") == numbers[::-1]


@given(WORDS)
@settings(max_examples=25, deadline=None)
def test_sorting_of_words_puts_capitals_first_unless_told(words):
    assert items(f"ORDO {mots(words)}") == sorted(words)
    assert items(f"ORDO {mots(words)} 'NOCA'") == sorted(words, key=str.upper)


def test_ten_thousand_appends():
    script = "L = PROG ; M = MOTS ; REPE B 10000 ; L = L ET 1. ; M = M ET 'UX' ; FIN B ;"
    result = run_text(script)
    assert len(result.session.root.find("L")) == len(result.session.root.find("M")) == 10000


@together(
    "phrase",
    ["PROG 3. 6 * 1.", "PROG 3. PAS 1. 9.", "PROG 3. PAS 1. NPAS 6", "LECT 6 * 1", "MOTS 6 * 'a'",
     "ENUM 6 * 1", "L «ET» L", "L «ET» (LECT 1 2)", "I «ET» I", "I ET 1 ET 2", "W «ET» W",
     "(ENUM L L) «ET» (ENUM L L L L)", "(SUIT U U U) «ET» (SUIT U U U)", "CHAI 'abc' 1234",
     "CHAI 'ab' >6 'c'"],
)  # fmt: skip
def test_lists_and_words_that_would_fill_the_memory_are_refused(refused, monkeypatch, phrase):
    before = "L = PROG 1. 2. 3. 4. ; I = LECT 1 2 3 4 ; W = MOTS 'a' 'b' 'c' ; "
    before += "U = MANU CHPO (0. 0.) 1 UX 1. ; "
    monkeypatch.setattr(progressions, "LONGEST", 5)
    assert "too long, the limit is 5" in refused(f"OPTI DIME 2 ; {before}Z = {phrase} ;")


def test_several_empty_objects_in_a_table(found):
    made = found("T = VIDE 'TABU' (MOTS 'UX' 'UY') 'LISTENTI'*2 ;", "T")
    assert isinstance(made, Table)
    assert [str(i) for i, _ in made.items()] == ["UX", "UY"]


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
