"""Operators are loaded when they are looked for, and stand as when all are loaded at once."""

import json
import os
import subprocess
import sys

import pytest

# what stands in each table, in order, told by what does not change from process to process
TOLD = """
import sys
from ssilang.language.filled import Filled
from ssilang.operators.loader import load_operators, prepare_operators
from ssilang.language.registry import OPERATORS, keywords_of


def told(value):
    return f"{getattr(value, '__module__', '')}.{getattr(value, '__qualname__', type(value))}"


def whole(found):
    forms = [
        [form.module, told(form.function), str(form.entries and [e.name for e in form.entries])]
        for form in found.forms
    ]
    return [forms, keywords_of(found), found.help.en, found.help.syntax]


def everything():
    kept = {}
    for name, table in sorted(Filled.tables.items()):
        for key in sorted(map(repr, table)):
            value = table[eval(key)]
            kept[f"{name} {key}"] = whole(value) if table is OPERATORS else told(value)
    return kept
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Runs a program in a process of its own, the index being kept in a folder of its own."""
    given = os.environ | {
        "XDG_CACHE_HOME": str(tmp_path_factory.mktemp("cache")),
        "PYTHONPATH": os.pathsep.join(sys.path),
    }

    def action(program):
        done = subprocess.run(
            [sys.executable, "-c", TOLD + program], env=given, capture_output=True, text=True,
            check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    action("prepare_operators(); print(1)")  # makes the index
    return action


@pytest.fixture(scope="module")
def truth(run):
    """All tables after a load of all modules."""
    found = run("import json; load_operators(); print(json.dumps(everything()))")
    assert sum(k.startswith("operators ") for k in found) > 300
    assert sum(k.startswith("rules ") for k in found) > 100
    return found


LATE = """
import json, random
prepare_operators()
loaded = sum(m.startswith("ssilang.operators.") for m in sys.modules)
assert loaded < 10, loaded
import ssilang.operators.dispatch, ssilang.operators.numbers.arithmetic  # they own tables
import ssilang.operators.curves.evol
keys = [(table, key) for table in Filled.tables.values() for key in table._waiting]
random.Random({seed}).shuffle(keys)
for table, key in keys:
    assert table.get(key) is not None, key
print(json.dumps(everything()))
"""


@pytest.mark.parametrize("seed", [1, 2])
def test_all_stands_the_same_in_whatever_order_it_is_looked_for(run, truth, seed):
    found = run(LATE.replace("{seed}", str(seed)))
    assert found.keys() == truth.keys()
    assert {k: v for k, v in found.items() if v != truth[k]} == {}


def test_a_small_script_loads_few_modules_and_finds_what_it_names(run):
    program = """
from ssilang.cli.run import run_text
result = run_text("OPTI DIME 2 ELEM SEG2 ; X1 = 1. + 2. ; MESS X1 ; L = DROI 2 (0. 0.) (1. 0.) ;"
                  "N = NBEL (L ET (L PLUS (5. 0.))) ; E = EXTR (PROG 4. 5.) 2 ;")
assert result.exit_code == 0, result.message
root = result.session.root
loaded = sum(m.startswith("ssilang.operators.") for m in sys.modules)
print([root.find("N"), root.find("E"), loaded])
"""
    cells, item, modules = run(program)
    assert (cells, item) == (4, 5.0)
    assert modules < 60  # of more than 200


def test_an_edited_module_is_looked_at_again(tmp_path):
    """The index holds for the modules that it was made of."""
    from ssilang.operators import loader

    folder = tmp_path / "lists"
    folder.mkdir()
    (tmp_path / "a.py").write_text("A = 1\n")
    (folder / "b.py").write_text("B = 1\n")
    before = list(loader._stamps(str(tmp_path)))
    assert len(before) == 2
    (folder / "b.py").write_text("B = 12\n")
    assert list(loader._stamps(str(tmp_path))) != before


def test_who_imported_operators_before_gets_them_all(run):
    program = """
import ssilang.operators.modal.matrices  # brings forms of RIGI before those of RIGI itself
prepare_operators()
print([len(Filled.index), len(list(OPERATORS))])
"""
    indexed, count = run(program)
    assert indexed == 0
    assert count > 300


SAVED = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ;
MJ = MODE (MANU 'SEG2' P Q) 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
M = MODE (P D 1 Q) CONTACT FROTTANT COULOMB (Q D 1 P) FAIB ; B = MATE M 'MU' 0.3 ;
AJ = MATE MJ 'KN' 4. 'KS' 0. ; N1 = NUAG 'COMP' 'X' 0. 1. ; OPTI SAUV 'kept.sauv' ; SAUV ;
"""
RESTORED = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; OPTI REST 'kept.sauv' ; REST ;
K = RIGI MJ AJ ; MESS (TYPE N1) (MAXI (K * (MANU 'CHPO' Q 1 'UX' 0.5))) (MAXI B) ;
"""


def test_restored_objects_are_what_they_were_though_nothing_made_them(run, tmp_path):
    # 4 N/m pressed by half a metre: 2 N
    told = []
    for script in (SAVED, RESTORED):
        program = f"""
from pathlib import Path
from ssilang.cli.run import RunOptions, run_text
result = run_text({script!r}, Path({str(tmp_path)!r}))
assert result.exit_code == 0, result.message
import json
print(json.dumps(result.output.split()))
"""
        told.append(run(program))
    kind, force, friction = told[1]
    assert (kind, float(force), float(friction)) == ("NUAGE", 2.0, 0.3)
