"""docs/differences.md: each claim runs here, or names the test that runs it."""

import ast
import re
import tomllib
from pathlib import Path

import pytest
from together import together

from ssilang.cli.main import main
from ssilang.cli.run import run_text

_ROOT = Path(__file__).resolve().parents[2]
_PAGE = (_ROOT / "docs" / "differences.md").read_text(encoding="utf-8")
_MODEL = "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; U = MANU 'CHPO' P 1 'UX' 2. {} ; "

RUNS = {
    "A deck that ends without": [("X = 1 ;", 0, "X", 1)],
    "The exit code": [("FIN ; X = 1 / 0 ;", 0, "X", None), ("X = 1. / 0. ;", 1, "X", None)],
    "The first error ends": [("X = 1 ; X = 1 + VRAI ; X = 2 ;", 1, "X", 1)],
    "Calculation is in double precision": [("X = 3 * (10 ** 30) ;", 0, "X", 3 * 10**30)],
    "What passes the largest real": [
        ("X = 1. / (SINH 1000.) ;", 0, "X", 0.0),
        ("X = VERI (1.E200 * 1.E200) ;", 0, "X", False),
        ("X = 10 ** 4000 ;", 1, "X", None),
    ],
    "A procedure that a deck defines": [
        ("DEBP @VERIFIE A*ENTIER ; FINP (A + 1) ; X = @VERIFIE 2 ;", 0, "X", 3)
    ],
    "Two or three numbers are a point": [
        (
            "OPTI DIME 2 ; T = TABL ; T . 1 = T ; T . 1 . 2 = 3. 5. ; X = TYPE (T . 2) ;",
            0,
            "X",
            "POINT   ",
        )
    ],
    "Names keep 24 characters": [
        (f"{'A' * 24}B = 1 ; {'A' * 24}C = 2 ; X = {'A' * 24}B ;", 0, "X", 2),
        (f"{'A' * 23}B = 1 ; {'A' * 23}C = 2 ; X = {'A' * 23}B ;", 0, "X", 1),
    ],
    "`&name` lives on": [
        ("REPE B 3 ; FIN B ; X = &B ;", 0, "X", 4),
        ("REPE B ; SI (&B > 2) ; QUIT B ; FINSI ; FIN B ; X = &B ;", 0, "X", 3),
    ],
    "An object that is a table's index": [
        ("A = PROG 1. ; B = PROG 1. ; T = TABL ; T . A = 1 ; T . B = 2 ; X = T . A ;", 0, "X", 1)
    ],
    "A string that runs over": [("X = 'AB\nCD' ;", 0, "X", "AB CD")],
    "`EXTR` of a field": [
        (_MODEL.format("") + "X = EXTR U 'UX' Q ;", 0, "X", 0.0),
        (_MODEL.format("'NATURE' 'DISCRET'") + "X = EXTR U 'UX' Q ;", 0, "X", 0.0),
        (_MODEL.format("") + "X = MAXI (EXTR U 'VALE' 'UX' Q 'NOID') ;", 0, "X", 0.0),
    ],
}
"""Beginning of a claim: scripts, their exit code, and what a name holds behind them."""

STAND = {
    "One run at a time": "io/test_run_output.py::test_the_output_folder_is_held_by_one_run",
    "Pictures": "operators/test_drawing_curves.py::"
    "test_only_one_format_on_demand_named_after_the_file",
    "A deck reads files": "cli/test_safety.py::test_reading_outside_is_refused",
    "No link leads": "cli/test_safety.py::test_a_link_that_leads_outside_is_refused",
    "`'VRAI'` and `'FAUX'`": "language/test_entry_checks.py::"
    "test_a_word_for_a_logical_is_told_and_taken_as_it",
    "Under `OPTI 'MODE' 'FREQ'`": "operators/test_frequency_sweep.py::"
    "test_frequencies_of_the_default_sweep_show_the_resonance",
    "Shells DST": "kernel/elements/shells/test_shells.py::"
    "test_plate_bent_to_a_quadratic_surface_has_the_exact_moments",
    "Plastic solids in large": "docs/test_differences.py::test_reactualise_is_half_way",
    "Lines are not echoed": "docs/test_differences.py::test_lines_are_not_echoed",
    "Procedures beside the deck": "docs/test_differences.py::test_procedures_beside_the_deck",
    "Nodes and elements are numbered": "docs/test_differences.py::test_numbers_of_nodes",
    "`OPTI 'UNIT'`": "operators/test_units.py::"
    "test_numbers_in_another_unit_are_told_with_the_unit_they_look_like",
}
"""Beginning of a claim: the test that runs it."""

_NO_RUN = (
    "Solvers and eigenvalue searches", "Largest values of random motions", "Random numbers differ",
)  # fmt: skip
"""Claims that only another program's answers could contradict."""


def claims() -> list[str]:
    """First lines of what the page lists as differing; what ssilang adds has pages of its own."""
    differing = _PAGE.split("## What ssilang adds")[0]
    return re.findall(r"^- (.*)$", differing, re.MULTILINE)


@together("claim", claims())
def test_each_claim_is_run(claim):
    known = [k for k in (*RUNS, *STAND, *_NO_RUN) if claim.startswith(k)]
    assert len(known) == 1


def test_no_claim_is_kept_that_the_page_does_not_make():
    listed = re.findall(r"^- (.*)$", _PAGE, re.MULTILINE)
    assert [k for k in (*RUNS, *STAND) if not any(c.startswith(k) for c in listed)] == []


@together("place", STAND.values())
def test_the_tests_named_exist(place):
    path, _, name = place.partition("::")
    text = (_ROOT / "tests" / path).read_text(encoding="utf-8")
    if path.endswith(".toml"):
        assert name in tomllib.loads(text)["frequency_sweep"]
        return
    tree = ast.parse(text)
    assert name in {n.name for n in tree.body if isinstance(n, ast.FunctionDef)}


@together(
    "text, code, name, value",
    [case for cases in RUNS.values() for case in cases],
)
def test_the_page_tells_what_happens(text, code, name, value, tmp_path):
    result = run_text(text, output_directory=tmp_path)
    assert result.exit_code == code, result.message
    assert result.session.root.find(name) == value


_NOTHING_TO_RUN = frozenset(
    re.findall(
        r"\S+",
        "@ORTHO CONTINU DECONV3D DFOU DYNE ELAS EVOL HBM HOOK LIRE OPTI PSMO RECO SAUV SEIS SISSIB "
        "TEMP TRAC VIBC",
    )
)
"""Names in partly.txt whose gaps are objects or files that nothing makes here, or many entries."""


def test_what_is_partly_built_is_run():
    listed = set(re.findall(r"^([@A-Z*][^:]*):", (_ROOT / "docs/partly.txt").read_text(), re.M))
    forms = (_ROOT / "tests/operators/drawn_forms/partly.forms").read_text()
    run = set(re.findall(r"^=== ([^:]*):", forms, re.M))
    assert listed == run | _NOTHING_TO_RUN
    assert not run & _NOTHING_TO_RUN


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        ("X = FLUX 1 2 ;", 0, "FLUX is a Cast3M operator (heat), out of ssilang's scope"),
        (
            "X = VARI 'PSATT' 300. ;",
            1,
            "VARI PSATT is a Cast3M operator (fluids), out of ssilang's scope",
        ),
        ("X = FLUX 1 2 ; MESS X ;", 1, "X, which it should give, is read at line 1"),
        ("FLUX 1 2 ;", 1, "out of ssilang's scope"),
    ],
)
def test_what_is_out_of_scope_stops_where_it_is_read(text, code, said, tmp_path, capsys):
    deck = tmp_path / "deck.ssi"
    deck.write_text(text, encoding="utf-8")
    assert main(["run", str(deck), "--out", str(tmp_path / "out")]) == code
    shown = capsys.readouterr()
    assert said in shown.out + shown.err
    assert main(["check", "--syntax-only", str(deck)]) == 0


def test_lines_are_not_echoed(tmp_path):
    assert run_text("OPTI ECHO 1 ; X = 1 ;\nMESS X ;", output_directory=tmp_path).output == "1\n"


def test_procedures_beside_the_deck(tmp_path):
    for name in ("@mine", "mine"):
        (tmp_path / f"{name}.ssi").write_text(f"DEBP {name.upper()} ; FINP 7 ;\n", encoding="utf-8")
    deck = tmp_path / "deck.ssi"
    deck.write_text("X = @MINE ; ERRE (CHAI X) ;", encoding="utf-8")
    found = [main(["run", str(deck), "--out", str(tmp_path / "out")])]
    deck.write_text("X = @MINE ;", encoding="utf-8")
    found.append(main(["run", str(deck), "--out", str(tmp_path / "out")]))
    deck.write_text("X = MINE 1 ;", encoding="utf-8")
    found.append(main(["run", str(deck), "--out", str(tmp_path / "out")]))
    assert found == [1, 0, 1]


def test_numbers_of_nodes(tmp_path):
    text = "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; B = 1. 0. ; L = DROI 3 A B ; X = COOR 1 (NOEU 3) ;"
    result = run_text(text, output_directory=tmp_path)
    assert result.session.root.find("X") == pytest.approx(1 / 3)


def test_reactualise_is_half_way():
    result = run_text("X = 1 ;")
    entry = result.session.library.declared("PASAPAS").at(("TAB1",), "LAGRANGIEN")
    assert (entry.word("REACTUALISE"), entry.fallback) == ("MI_PAS", "MI_PAS")
