"""Making, searching, sorting and changing lists against Python's own lists."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
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
