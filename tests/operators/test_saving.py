"""SAUV and REST: a calculation goes on in another run."""

import zipfile
from pathlib import Path

import numpy as np
import pytest
from script_runs import ran

from ssilang.cli.run import RunOptions, run_file, run_text
from ssilang.language.run.scopes import Frame
from ssilang.language.values import type_of

FIRST = """
OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ;
L = DROI 4 (0. 0.) (2. 0.) ; S = TRAN L 2 (0. 1.) ; P = S POIN 'PROC' (2. 1.) ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 1.E9 'NU' 0.3 ;
K = (RIGI MO MA) ET (BLOQ 'DEPL' L) ; F = FORC 'FY' 1.E6 P ; U = RESO K F ;
E = EVOL 'MANU' 't' (PROG 0. 1.) 'f' (PROG 0. 2.) ; C = CHAR 'MECA' F E ;
LR = PROG 1. 2. 3. ; LE = LECT 4 5 ; LM = MOTS 'AB' 'CD' ; LC = SUIT U U ;
T = TABL 'KIND' ; T . 1 = S ; T . 'me' = T ; T . 2.5 = TABL ; T . 2.5 . VRAI = LR ;
TX = TEXTE 'LIST 3' ; W = MOT 'hello' ; I = 7 ; R = 0.1 ; B = FAUX ;
D = DEFO S U ; V = VECT U 'DEPL' ; A = ANNO 'CATE' 'ROUG' 'soil' ;
DEBM ADD K*ENTIER ; FINM (%V + K) ; DEBM MADE N*ENTIER ; %V = N ; %METHODE SUM ADD ; FINM ;
OB = OBJE MADE 5 ; DEBP TWICE X*FLOTTANT ; Y = 2. * X ; FINP Y ;
OPTI SAUV 'state' ;
"""
OBJECTS = "L S P MO MA K F U E C LR LE LM LC T TX W I R B D V A TWICE OB"
NAMES = OBJECTS.split()


def test_everything_with_a_name_comes_back(tmp_path: Path) -> None:
    first = ran(FIRST + "SAUV ;", tmp_path)
    second = ran(
        "OPTI REST 'state' ; REST ; Z = TWICE 4. ; O = OB%SUM 3 ; DI = VALE 'DIME' ;", tmp_path
    )
    old, new = first.session.root, second.session.root
    assert [type_of(new.find(n)) for n in NAMES] == [type_of(old.find(n)) for n in NAMES]
    assert [new.find(n) for n in "WIRB"] == ["hello", 7, 0.1, False]
    assert [new.find(n) for n in ("Z", "O", "DI")] == [8.0, 8, 2]
    table = new.find("T")
    assert table.get("me") is table
    assert table.get(1) is new.find("S")
    assert table.get(2.5).get(True) is new.find("LR")
    assert table.subtype == "KIND"


def test_the_solution_goes_on_from_the_saved_matrix(tmp_path: Path) -> None:
    assert run_text(FIRST + "SAUV K F U ;", tmp_path).exit_code == 0
    again = ran(
        "OPTI DIME 2 ; X0 = 9. 9. ; OPTI REST 'state' ; REST ; "
        "D = (RESO K F) - U ; E = MAXI 'ABS' D 'AVEC' (MOTS 'UX' 'UY') ; S2 = S ; "
        "G = EXTR F 'FY' P ;",
        tmp_path,
    )
    assert again.session.root.find("E") == pytest.approx(0.0, abs=1e-15)
    # the mesh was not an operand, but the matrix stands on it, and on the point
    assert type_of(again.session.root.find("S2")) == "MAILLAGE"
    assert again.session.root.find("G") == 1e6


def test_labels_and_present_state_of_lists(tmp_path: Path) -> None:
    text = "X = PROG 1. 2. ; OPTI SAUV 'l' ; SAUV 'LABEL' 'one' X ; REMP X 1 5. ; SAUV X ;"
    assert run_text(text, tmp_path).exit_code == 0

    def restored(words: str) -> Frame:
        return ran(f"OPTI REST 'l' ; REST {words} ;", tmp_path).session.root

    assert np.array_equal(restored("'LABEL' 'one'").find("X").values, [1.0, 2.0])
    assert np.array_equal(restored("").find("X").values, [5.0, 2.0])


def test_procedures_and_objects_keep_working_after_two_savings(tmp_path: Path) -> None:
    text = "OPTI SAUV 'a' ; SAUV TWICE ; OPTI REST 'a' ; REST ; OPTI SAUV 'b' ; SAUV TWICE ;"
    assert run_text(FIRST + text, tmp_path).exit_code == 0
    again = run_text("OPTI REST 'b' ; REST ; Z = TWICE 3. ;", tmp_path)
    assert again.session.root.find("Z") == 6.0


def test_a_mesh_and_its_named_parts_go_through_a_file(tmp_path: Path) -> None:
    ran(FIRST + "Q = 7. 7. ; OPTI SORT 'mesh' ; SORT S 'NOOP' ;", tmp_path)
    again = ran("OPTI DIME 2 ; X0 = 9. 9. ; OPTI LECT 'mesh' ; LIRE S ;", tmp_path)
    root = again.session.root
    assert [type_of(root.find(n)) for n in ("S", "L", "P")] == ["MAILLAGE", "MAILLAGE", "POINT"]
    assert root.find("Q") is None
    assert np.isin(root.find("L").sorted_node_ids, root.find("S").sorted_node_ids).all()
    assert np.array_equal(root.find("P").coordinates[:2], [2.0, 1.0])
    wrong = run_text("OPTI LECT 'mesh' ; LIRE MAILLAGE ;", tmp_path)
    assert "holds no mesh 'MAILLAGE'" in wrong.message
    ran(FIRST + "OPTI SORT 'mesh' ; SORT (S ELEM 'QUA4') 'NOOP' ;", tmp_path)
    root = ran("OPTI DIME 2 ; OPTI LECT 'mesh' ; LIRE MAILLAGE ;", tmp_path).session.root
    assert np.array_equal(root.find("P").coordinates[:2], [2.0, 1.0])
    assert len(root.find("MAILLAGE").sorted_node_ids) == 15


def test_a_deck_goes_on_from_the_output_of_the_deck_before(tmp_path: Path) -> None:
    for name, text in (("one", "X = 4 ; OPTI SAUV 'x.sauv' ; SAUV X ;"),
                       ("two", "OPTI REST 'x.sauv' ; REST ; Y = X + 1 ;")):  # fmt: skip
        (tmp_path / "decks").mkdir(exist_ok=True)
        deck = tmp_path / "decks" / f"{name}.dgibi"
        deck.write_text(text)
        options = RunOptions(output_directory=tmp_path / "results" / name, summary=True)
        result = run_file(deck, options)
        assert result.exit_code == 0, result.message
    assert result.session.root.find("Y") == 5
    assert [w.code for w in result.session.warnings] == ["other-case"]


def test_named_unknowns_come_back(tmp_path: Path) -> None:
    text = (
        "OPTI INCO 'PP' 'PQ' ; OPTI INCO (MOTS 'AA') (MOTS 'BB') ; OPTI SAUV 's' ; X = 1 ; SAUV ;"
    )
    assert run_text(text, tmp_path).exit_code == 0
    second = ran(
        "OPTI INCO 'CC' 'DD' ; OPTI REST 's' ; REST ; LP LD = VALE 'INCO' ;"
        "PP = POSI (MOTS 'PP' 'AA' 'CC' 'UX') 'DANS' LP ;"
        "PD = POSI (MOTS 'PQ' 'BB' 'DD' 'FX') 'DANS' LD ; OK = EGA PP PD ;",
        tmp_path,
    )
    root = second.session.root
    assert root.find("OK")
    assert 0 not in root.find("PP").values


def test_results_of_dynamic_are_saved_with_all_their_instants(tmp_path):
    result = ran(
        """OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
        P1 = 0. 0. ; P2 = 4. 0. ; L = DROI 4 P1 P2 ;
        MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'POUT' ;
        MA = MATE MO 'YOUN' 3.E10 'NU' 0.2 'RHO' 0. 'SECT' 1. 'INRY' 0.1 'INRZ' 0.1 ;
        T1 = TABL ; T1 . 'RIGI' = (RIGI MO MA) ET (BLOQ 'UX' 'UY' 'RZ' P1) ;
        T1 . 'MASS' = MASS 'DEPL' 2.E3 L ;
        T1 . 'CHAR' = CHAR 'MECA' (MANU 'CHPO' P2 1 'FY' 1.E5) ;
        T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 'NPAS' 20 ; T1 . 'PAS_SAUVES' = 5 ;
        T2 = DYNAMIC T1 ; BEFORE = EXTR (EVOL 'TEMP' T2 'DEPL' 'UY' P2) 'ORDO' ;
        OPTI SAUV 'x.sauv' ; SAUV T2 P2 ; OPTI REST 'x.sauv' ; REST ;
        AFTER = EXTR (EVOL 'TEMP' T2 'DEPL' 'UY' P2) 'ORDO' ; T3 = T2 . 3 ; TIME = T3 . 'TEMP' ;""",
        output_directory=tmp_path,
    )
    before, after = (result.session.root.find(name).values for name in ("BEFORE", "AFTER"))
    assert len(before) == 5
    assert before.any()
    assert before.tolist() == after.tolist()
    assert result.session.root.find("TIME") == pytest.approx(0.01)


def _edited(path: Path, edit) -> None:
    """The archive with the text of its objects changed."""
    with zipfile.ZipFile(path) as read:
        parts = {name: read.read(name) for name in read.namelist()}
    parts["objects.json"] = edit(parts["objects.json"].decode()).encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in parts.items():
            made.writestr(name, content)


def test_numbers_that_are_not_finite_are_told_by_the_names_that_hold_them(tmp_path: Path) -> None:
    """Saved after a division by zero, or written by hand: a real, a whole number, a list."""
    saved = ran(
        "OPTI DIME 2 ELEM QUA4 ; R = 0.125 ; N = 4444 ; SOUND = PROG 1. 2. ; T = TABL ; "
        "T . 1 = 3. ; L = (PROG 1. 0.) / (PROG 0. 1.) ; C = EVOL 'MANU' (PROG 0. 1.) L ; "
        "P = 0. 0. ; F = MANU 'CHPO' P 1 'UX' 1. ; OPTI SAUV 'state' ; SAUV ;",
        tmp_path,
    )
    assert np.isinf(saved.session.root.find("L").values[0])
    path = next(tmp_path.rglob("state"))
    _edited(path, lambda text: text.replace("0.125", "NaN").replace("4444", "9" * 400))
    again = ran(f"OPTI DIME 2 ; OPTI REST '{path}' ; REST ;", tmp_path)
    assert [w.code for w in again.session.warnings] == ["operators.files.not-finite-numbers"]
    assert again.session.warnings[0].data["names"] == ["C", "L", "N", "R"]
    sound = ran("X = PROG 1.E300 -1.E300 ; N = 2147483647 ; OPTI SAUV 'b' ; SAUV ;", tmp_path)
    path = next(tmp_path.rglob("b"))
    assert not sound.session.warnings
    assert not ran(f"OPTI REST '{path}' ; REST ;", tmp_path).session.warnings
