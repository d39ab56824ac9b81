"""How templates are filled."""

import os
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from together import together

import ssilang
from ssilang.kernel.base.errors import MeshError
from ssilang.messages.message import Sentence, filled, find, hint, sentence


@together(
    "template, data, language, told",
    [
        ("{x:.3g} of {name!r}", {"x": 2.0, "name": "A"}, "en", "2 of 'A'"),
        ("{n} {n:node|nodes}", {"n": 1}, "en", "1 node"),
        ("{n} {n:node|nodes}", {"n": 0}, "en", "0 nodes"),
        ("{n} {n:noeud|noeuds}", {"n": 0}, "fr", "0 noeud"),
        ("{n} {n:noeud|noeuds}", {"n": np.int64(2)}, "fr", "2 noeuds"),
        ("{names:it has|they have} {names}", {"names": ("A", "B")}, "en", "they have A, B"),
        ("{names:and}", {"names": ["A", "B", "C"]}, "fr", "A, B et C"),
        ("{names:or}", {"names": ["A"]}, "en", "A"),
        ("{names:words}", {"names": {"A": 1, "B": 2}}, "en", "A B"),
        ("{values:and .2g}", {"values": np.array([1.0, 0.12345])}, "en", "1 and 0.12"),
        ("x{near:? like {near}}", {"near": "Y"}, "en", "x like Y"),
        ("x{near:? like {near}}", {"near": ""}, "en", "x"),
        ("{known:?there {known:is|are} {known}|none}", {"known": ["A"]}, "en", "there is A"),
        ("{known:?there is {known}|none}", {"known": ()}, "en", "none"),
        ("{{{x}}}", {"x": 1}, "en", "{1}"),
        ("{known:?there is {known:g}|none}", {"known": np.zeros(1)}, "en", "there is 0"),
        ("{known:?there is {known:g}|none}", {"known": np.zeros(0)}, "en", "none"),
        ("{x:.3g}", {"x": "w" * 50}, "en", "w" * 40),
        ("{path}", {"path": Path("a\nb")}, "en", "a\\nb"),
    ],
)
def test_templates(template, data, language, told):
    assert filled(template, data, language) == told


@together("spec", ["{x:.3g}", "{x:g}", "{xs:.2g}", "{xs:words .3g}"])
@together("value", [4.905e-8, 0.125, 2.5, 1e300, 0.0, -1.5e-5])
def test_no_digit_that_is_told_hangs_on_rounding(spec, value):
    """Half an ulp up or down, and a thousand of them, make the same text."""
    said = {
        filled(spec, {"x": x, "xs": [x]}, "en")
        for x in (value, *(value * (1.0 + k * 2.0**-53) for k in (-2000, -2, 2, 2000)))
    }
    assert len(said) == 1


@together(
    "spec, count, end",
    [("", 3000, "n19, ... (+2980)"), (":and", 61, "n19, ... (+41)"),
     (":words", 99, "n19 ... (+79)"), (":and", 60, "n58 and n59"), ("", 60, "n58, n59")],
)  # fmt: skip
def test_long_collections_are_told_by_their_first_words_and_how_many_more(spec, count, end):
    told = filled(f"{{names{spec}}}", {"names": [f"n{k}" for k in range(count)]}, "en")
    assert told.endswith(end)
    assert told.startswith("n0")


def test_an_error_inside_of_another_is_told_in_the_language_asked_for():
    inner = Sentence("recursion", limit=3)
    assert filled("at 2: {problem}", {"problem": inner}, "en").startswith("at 2: procedures call")
    assert filled("à 2 : {problem}", {"problem": inner}, "fr").startswith("à 2 : les procédures")
    assert filled("{problem!h}", {"problem": inner}, "fr").startswith("cherchez")


def test_the_speaker_is_named_first():
    assert sentence("interrupted", {"speaker": "DYNAMIC"}, "en") == "DYNAMIC: interrupted"
    assert sentence("interrupted", {"speaker": "DYNAMIC"}, "fr") == "DYNAMIC : interrompu"


def test_an_unknown_code_is_a_defect():
    with pytest.raises(LookupError, match=r"no message has the code 'kernel\.mesh\.nothing'"):
        find("kernel.mesh.nothing")


def test_errors_keep_code_and_data_between_processes():
    error = pickle.loads(pickle.dumps(MeshError("recursion", limit=3)))
    assert (error.code, error.data) == ("recursion", {"limit": 3})
    assert "3 levels" in str(error)


def test_scripts_are_told_what_to_write_and_python_is_not():
    code, data = "kernel.mesh.contour-not-closed-line", {"nodes": (1, 2)}
    assert str(MeshError(code, **data)).endswith("at nodes 1, 2")
    assert "ELIM" not in MeshError(code, **data).hint
    assert "ELIM" in hint(code, data, "en", script=True)
    assert "ELIM" in hint(
        "kernel.statics.at-load-step", {"failure": MeshError(code, **data)}, "fr", script=True
    )


def test_a_refused_entry_is_told_with_its_reason():
    data = {"speaker": "DYNAMIC", "index": "'PAS'", "problem": Sentence("loop-name")}
    told = sentence("refused-entry", data, "fr")
    assert told == "DYNAMIC : 'PAS' est refusé : REPE demande un nom de boucle"


def test_a_run_without_refusals_loads_no_catalogue(tmp_path):
    program = (
        "import sys; from ssilang.cli.run import run_text; from pathlib import Path\n"
        "text = 'OPTI DIME 2 ELEM QUA4 ; P1 = 0. 0. ; L1 = DROI 2 P1 (1. 0.) ;'\n"
        "done = run_text(text, Path('out'))\n"
        "assert done.exit_code == 0\n"
        "from ssilang.messages.message import _room\n"
        "print(_room.cache_info().currsize)"
    )
    root = str(Path(ssilang.__file__).parents[1])
    found = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path, check=True,
        env={**os.environ, "PYTHONPATH": root},
    )  # fmt: skip
    assert found.stdout.strip() == "0"


def test_a_line_end_in_a_name_begins_no_line():
    """Another group's name, or a deck's, would else tell an error of its own."""
    data = {"name": "A\nerror: B", "names": ["C\nD"], "value": "two\nlines"}
    assert filled("{name}; {names}; {value}", data, "en") == "A\\nerror: B; C\\nD; two\nlines"
