"""Objects of scripts in Python, against what the deck says in closed form."""

import doctest
import importlib
import pickle
import pkgutil
import re
from pathlib import Path

import numpy as np
import pytest
from together import together

import ssilang
import ssilang.api
from ssilang.api.fields import CellFieldView
from ssilang.api.html import html_of
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock


def exact(t):
    """Of the oscillator: 10 rad/s, let go at 0.2 m."""
    return 0.2 * np.cos(10.0 * t)


@pytest.mark.parametrize("point", ["P1", "POIN 2 L", 2, (1.0, 0.0), np.array([1.0, 0.0, 0.0])])
def test_a_history_at_a_point_by_name_number_and_place(swing, point):
    u = swing.history("DEPL", "UX", point)
    assert len(u.x) == 51
    assert u.y == pytest.approx(exact(u.x), abs=4e-4)  # steps of a 314th of the period
    assert u.units == ("s", "m")
    assert u.names == ("UX P1",)
    assert u.series().loc[0.5] == pytest.approx(exact(0.5), abs=4e-4)


def test_a_mesh_gives_a_curve_a_node(swing):
    both = swing.history("VITE", "UX", swing["L"], table="T2")
    assert len(both) == 2
    frame = both.frame()
    assert frame.shape == (51, 2)
    assert abs(frame["UX P1"]).max() == pytest.approx(2.0, rel=2e-3)
    assert abs(frame["UX P0"]).max() == 0.0


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (("DEPL", "UX", (1.0, 0.1)), "the nearest is 2 (1. 0.), at a distance of 0.1"),
        (("DEPL", "UX", 9), "there is no node 9: they are counted from 1 to 6"),
        (("DEPL", "UX", "P2"), "P2"),
        (("DEPL", "UW", "P1"), "there are UX, UY"),
        (("DEPL", "UW", (1.0, 0.0)), "there are UX, UY"),
        (("DEPO", "UX", "P1"), "did you mean 'DEPL'?"),
        (("DEPL", "UX", {}), "a dict is no point"),
        (("DEPL", "UX", "P1", "T1"), "no table of results"),
    ],
)
def test_what_is_not_there_is_refused_with_what_is_near(swing, asked, said):
    with pytest.raises(ssilang.Error) as caught:
        swing.history(*asked)
    assert said in str(caught.value)


def test_an_error_comes_whole_from_another_process():
    with pytest.raises(ssilang.Error) as caught:
        ssilang.run("X = PROG 1. ; Y = MAXI (X + 'a') ;")
    error = pickle.loads(pickle.dumps(caught.value))
    assert (type(error), str(error)) == (ssilang.Error, str(caught.value))
    assert (error.code, error.line, error.column, error.result) == ("no-rule", 1, 25, None)


@together("tables, said", [(0, "no table of results"), (1, ""), (2, "T1 and T2")])
def test_results_that_are_meant_are_the_only_ones(tables, said):
    text = "T{0} = TABL ; T{0} . 'TEMPS' = TABL ; T{0} . 'TEMPS' . 0 = 0. ; "
    for word in ("DEPLACEMENTS", "VITESSES"):
        text += f"T{{0}} . '{word}' = TABL ; T{{0}} . '{word}' . 0 = MANU 'CHPO' P 1 'UX' 7. ; "
    r = ssilang.run("OPTI DIME 2 ; P = 1. 0. ; " + "".join(map(text.format, (1, 2)[:tables])))
    if not said:
        assert r.history("DEPL", "UX", "P").y.tolist() == [7.0]
        return
    with pytest.raises(ssilang.Error, match=said):
        r.history("DEPL", "UX", "P")


def test_two_nodes_at_one_place_are_told_apart():
    deck = "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 0. 0. ; "
    deck += "U = MANU 'CHPO' (P ET Q) 1 'UX' 1. ; T = TABL ; T . 1 = TABL ; "
    deck += "T . 1 . 'TEMP' = 0. ; T . 1 . 'DEPL' = U ;"
    r = ssilang.run(deck)
    with pytest.raises(ssilang.Error, match=r"several nodes stand there: 1 .* and 2 "):
        r.history("DEPL", "UX", (0.0, 0.0))
    assert r.history("DEPL", "UX", 2).y.tolist() == [1.0]
    for more, said in ((" V = TABL ; V . 1 = T . 1 ;", "T and V"), (" OUBL T ;", "no table")):
        with pytest.raises(ssilang.Error, match=said):
            ssilang.run(deck + more).history("DEPL", "UX", 2)


def test_tables_of_results_are_made_as_far_as_they_are_asked_for(oscillator):
    table = ssilang.run(oscillator, A0=0.2)["T2"]
    assert len(table) == 51
    assert list(table)[:2] == [1, 2]
    assert table.held.rows.keys() == set(range(1, 52))
    assert table[6]["TEMP"] == pytest.approx(0.1)
    assert table[6]["DEPL"]["UX"][1] == pytest.approx(exact(0.1), abs=4e-4)
    assert set(range(1, 52)) - table.held.rows.keys() == {6}
    with pytest.raises(KeyError, match="no index 'DEPO'"):
        table[6]["DEPO"]
    assert 52 not in table
    held = ssilang.run("OPTI DIME 2 ; T = TABL ; T . (0 0) = 1. ; T . 'B' = 2. ; T . 3 = 4. ;")["T"]
    with pytest.raises(KeyError, match="there are 'B' and 3"):  # points are no words to try
        held["C"]
    many = ssilang.run("T = TABL ; REPE B 21 ; T . &B = &B ; FIN B ;")["T"]
    assert repr(many) == "<TABLE 21: 1, 2, 3, 4, 5, 6, 7, 8, ...>"
    with pytest.raises(KeyError, match=r"19 and 20(\D|$)"):
        many["C"]


@pytest.mark.parametrize("touched", [False, True])
def test_all_values_in_time_as_xarray(oscillator, touched):

    r = ssilang.run(oscillator)
    if touched:
        r["T2"][3]["DEPL"]
    u = r["T2"].xarray("DEPL")
    assert u.dims == ("time", "node", "component")
    at = u.sel(node=2, component="UX")
    assert at.values == pytest.approx(0.5 * exact(u.time.values), abs=2e-4)
    assert u.x.values.tolist() == [0.0, 1.0]
    v = r["T2"].xarray("VITE").sel(node=2, component="UX")
    assert v.values == pytest.approx(r.history("VITE", "UX", 2).y, rel=1e-12)
    slope = np.gradient(at.values, u.time.values)[1:-1]
    assert slope == pytest.approx(v.values[1:-1], abs=0.02 * float(np.abs(v).max()))


def test_results_of_pasapas_are_read_in_the_same_way():
    deck = """OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P0 = 0. 0. ; P1 = 1. 0. ; L = P0 D 1 P1 ;
    MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
    MA = MATE MO 'YOUN' 100. 'NU' 0. 'SECT' 1. 'RHO' 0. ;
    T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' P0) ET (BLOQ 'UY' P1) ;
    EV = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ;
    T . 'CHARGEMENT' = CHAR 'MECA' (FORC (5. 0.) P1) EV ;
    T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.25 1. ; PASAPAS T ;"""
    r = ssilang.run(deck)
    exact = 0.05 * np.linspace(0.0, 1.0, 5)  # F L / (E A)
    assert r.history("DEPL", "UX", (1.0, 0.0)).y == pytest.approx(exact)
    u = r["T"].xarray("DEPLACEMENTS")
    assert u.sel(node=2, component="UX").values == pytest.approx(exact)
    with pytest.raises(KeyError, match="the table of results has no 'VITE'"):
        r.history("VITE", "UX", "P1")


def test_fields_at_nodes_and_in_cells(swing):
    u, s = swing["U0"], swing["SIG"]
    assert u["UX"] == pytest.approx([0.0, 0.05])  # F L / (E A)
    assert u.points[:, 0].tolist() == [0.0, 1.0]
    assert u.frame().loc[2, "UX"] == pytest.approx(0.05)
    assert float(u.xarray()["UX"].sel(node=2)) == pytest.approx(0.05)
    assert s["EFFX"].ravel() == pytest.approx(5.0)
    assert s.frame().loc[(1, 1, 1), "EFFX"] == pytest.approx(5.0)
    assert s.points().mean() == pytest.approx(0.5 / 3.0)
    with pytest.raises(KeyError, match="no component 'UZ'"):
        u["UZ"]
    with pytest.raises(KeyError, match="no zone 2"):
        s.values("EFFX", 2)


def test_meshes_and_their_fields_as_grids_of_pyvista(swing):
    grid = swing["L"].pyvista(u=swing["U0"], s=swing["SIG"])
    assert grid.n_cells == 1
    assert grid.length == pytest.approx(1.0)
    assert grid.point_data["u"][:, 0] == pytest.approx([0.0, 0.05])
    assert len(grid.cell_data.keys()) >= 1
    r = ssilang.run(
        "OPTI DIME 3 ELEM CUB8 ; L = DROI 2 (0. 0. 0.) (2. 0. 0.) ; "
        "S = L TRAN 3 (0. 3. 0.) ; V = S VOLU 1 'TRAN' (0. 0. 4.) ;"
    )
    assert r["V"].pyvista().volume == pytest.approx(24.0)
    assert r["V"].cells["CUB8"].shape == (6, 8)


def test_curves_of_several_parts_say_which(swing):
    r = ssilang.run(
        "E = EVOL 'MANU' 'LEGE' 'a' (PROG 0. 1.) (PROG 1. 2.) ; "
        "F = EVOL 'MANU' 'LEGE' 'b' (PROG -1. 2.) (PROG 3. 4.) ; EF = E ET F ;"
    )
    both = r["EF"]
    assert both.names == ("a", "b")
    with pytest.raises(ssilang.Error, match="2 curves, not one"):
        both.x  # noqa: B018
    assert both[1].y.tolist() == [3.0, 4.0]
    assert np.isnan(both.frame().loc[2.0, "a"])
    assert both.frame().index.tolist() == [-1.0, 0.0, 1.0, 2.0]
    assert both._repr_png_()[:4] == b"\x89PNG"


def test_phrases_are_evaluated_with_objects_of_python_and_leave_no_names(swing):
    assert swing.evaluate("MAXI ((EXCO 'UX' U) * K)", U=swing["U0"], K=2) == pytest.approx(0.1)
    assert swing.evaluate("NEW = 3 ; NEW * 2") == 6
    assert "NEW" not in swing
    with pytest.raises(ssilang.Error, match="<python>:1:"):
        swing.evaluate("MAXI ABSENT")


@pytest.mark.parametrize(
    ("given", "kind", "phrase", "value"),
    [
        (np.float32(0.5), "FLOTTANT", "X + 0.", 0.5), (np.float64(2.0), "FLOTTANT", "X + 0.", 2.0),
        (np.int16(-3), "ENTIER", "X + 0", -3), (np.bool_(True), "LOGIQUE", "X ET VRAI", True),
        (np.bool_(False), "LOGIQUE", "X OU FAUX", False),
        (np.str_("ab"), "MOT", "CHAI X 'c'", "abc"),
        ([1, 2.5], "LISTREEL", "EXTR X 2", 2.5), ([2.5, 1], "LISTREEL", "EXTR X 2", 1.0),
        ([np.float32(1.5), 2], "LISTREEL", "EXTR X 1", 1.5), ((3, 4), "LISTENTI", "EXTR X 1", 3),
        (np.arange(3, dtype=np.uint8), "LISTENTI", "EXTR X 3", 2),
        (range(5, 1, -2), "LISTENTI", "EXTR X 2", 3), (["b", "a"], "LISTMOTS", "EXTR X 2", "a"),
        ([np.str_("b"), "a"], "LISTMOTS", "EXTR X 1", "b"), ([], "LISTREEL", "DIME X", 0),
    ],
)  # fmt: skip
def test_python_s_values_are_the_language_s(swing, given, kind, phrase, value):
    assert str(swing.evaluate("TYPE X", X=given)).strip() == kind
    found = swing.evaluate(phrase, X=given)
    assert (type(found), found) == (type(value), value)


@pytest.mark.parametrize("given", [["a", 1], [1, "a"], [None], np.eye(2), [1j], {"a": 1}, None])
def test_what_the_language_has_no_object_for_is_refused(swing, given):
    with pytest.raises(ssilang.Error, match=f"takes no {type(given).__name__} of Python"):
        swing.evaluate("TYPE X", X=given)


def test_lists_of_a_table_as_a_frame():
    r = ssilang.run("T = TABL ; T . 'A' = PROG 1. 2. ; T . 'B' = LECT 3 4 ; T . 'C' = 1 ;")
    assert r["T"].frame().to_dict("list") == {"A": [1.0, 2.0], "B": [3, 4]}
    assert repr(r["T"]) == "<TABLE 3: 'A', 'B', 'C'>"


def modules():
    names = [m.name for m in pkgutil.iter_modules(ssilang.api.__path__)]
    return [importlib.import_module(f"ssilang.api.{name}") for name in names]


@together("module", modules())
def test_examples_in_docstrings_run(module):
    tried = doctest.testmod(module)
    assert tried.failed == 0


SHOWN = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; P = 2. 3. ; L = DROI 2 (0. 0.) (4. 0.) ;
S = TRAN 3 L (0. 3.) ; S = S ET (MANU 'TRI3' (0. 0.) (1. 0.) P) ;
M = MODE S 'MECANIQUE' 'ELASTIQUE' ; U = COOR 1 S ;
C = (MANU 'CHML' M 'A' 2.) ET (MANU 'CHML' M 'B' 3.) ; R = PROG 3. -1.25 ; W = MOTS 'one' 'two' ;
E = EVOL 'MANU' 't' (PROG 1. 3.) 'y' (PROG 5. 0.25) ; T = TABL 'KIND' ; T . 7 = R ; T . 'x' = VRAI ;
T . 2.5 = 'word' ; T . P = -3 ; K = RIGI M (MATE M 'YOUN' 1. 'NU' 0.) ; V = TABL ; F = SUIT U U ;
"""


@together(
    "name, shown, cells",
    [
        ("P", r"<POINT .*\(2\. 3\.\)>", None),
        ("S", "<MAILLAGE 6 QUA4, 1 TRI3, 15 nodes>", None),
        ("U", "<CHPOINT SCAL, 15 nodes>", ["", "x", "y", "z", "SCAL"]),
        ("C", "<MCHAML .*A B, 7 cells>", None),
        ("E", r"<EVOLUTION y \(2\)>", None),
        ("T", "<TABLE KIND, 5: 'SOUSTYPE', 7, 'x', 2.5, <POINT .*>>",
         ["KIND", "", "'SOUSTYPE'", "KIND", "7", "LISTREEL (2)", "'x'", "VRAI", "2.5", "word",
          "POINT", "-3"]),
        ("K", "<RIGIDITE>", None),
        ("V", "<TABLE 0: >", ["TABLE", ""]),
    ],
)  # fmt: skip
def test_objects_show_what_they_are(name, shown, cells):
    root = ssilang.run(SHOWN)
    value = root[name]
    assert re.fullmatch(shown, repr(value)), repr(value)
    assert f"{name}, " in repr(root) or name in list(root)[12:]
    html = getattr(value, "_repr_html_", str)()
    found = re.findall("<t[hd]>(.*?)</t[hd]>", html)
    assert cells is None or found[: len(cells)] == [c.replace("'", "&#x27;") for c in cells]


def test_views_give_numbers_in_their_own_order():
    r = ssilang.run(SHOWN)
    assert (r["P"].node, r["P"].coordinates.tolist()) == (1, [2.0, 3.0, 0.0])
    assert np.asarray(r["P"]).tolist() == [2.0, 3.0, 0.0]
    assert (len(r["S"]), len(r["F"]), len(list(r)), len(r)) == (7, 2, 13, 13)
    assert r["F"][1]["SCAL"].tolist() == r["U"].points[:, 0].tolist()
    assert np.asarray(r["E"]).tolist() == [5.0, 0.25]
    assert sorted(r["C"].mesh.cells) == ["QUA4", "TRI3"]
    assert len(r["C"].mesh) == 7
    assert r["C"].values("B", 2).tolist() == [[3.0]]
    with pytest.raises(ssilang.Error, match="component"):
        r["C"].values("Q", 2)
    assert r["R"].tolist() == [3.0, -1.25]
    assert r.evaluate("S POIN 'PROC' (4. 0.)").node == 3
    alone = r.evaluate("MANU 'CHML' (MODE (MANU 'TRI3' (0. 0.) (1. 0.) P) 'MECANIQUE') 'A' 2.")
    assert {*alone.mesh.cells} == {"TRI3"}
    assert html_of(Curve(())) == ""
    html = r._repr_html_()
    assert f"{r.seconds:.2f} s</th>" in html
    rows = re.findall("<tr><td>(.*?)</td><td>(.*?)</td></tr>", html)
    assert [name for name, _ in rows] == list(r)
    assert (dict(rows)["P"], dict(rows)["E"]) == ("POINT", "EVOLUTIO")
    assert ssilang.api.objects.held(Path("a") / "b") == "a/b"


def test_what_is_written_into_numbers_seen_leaves_the_script_as_it_is():
    r = ssilang.run(SHOWN + "N = LECT 4 7 ;")
    ways = [
        lambda: r["R"], lambda: r["N"], lambda: r["E"].x, lambda: r["E"].y, lambda: r["U"]["SCAL"],
        lambda: r["P"].coordinates, lambda: r["S"].points, lambda: r["U"].points,
        lambda: r["C"].values("B", 2), lambda: r["T"][7],
    ]  # fmt: skip
    for seen in ways:
        before = seen().tolist()
        seen()[...] = 99
        assert seen().tolist() == before


MIXED = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; Z = 9. 9. ; A = 0. 0. ; B = 4. 0. ; C = 4. 2. ; D = 0. 2. ;
E = 7. 0. ; F = 7. 2. ; Q = MANU 'QUA4' A B C D ; R = MANU 'TRI3' B E C ; S = Q ET R ;
S2 = R ET Q ET (MANU 'TRI3' E F C) ; M = (MODE Q 'MECANIQUE') ET (MODE R 'MECANIQUE') ;
U = (MANU 'CHPO' (E ET B) 1 'UX' (PROG 3. 5.)) ET (MANU 'CHPO' (B ET C) 1 'UY' (PROG -1. 2.)) ;
K = (NOMC 'A' (CHAN 'CHAM' (COOR 1 S) M)) ET (MANU 'CHML' (MODE R 'MECANIQUE') 'B' 6. 'NOEUD') ;
G = TABL ; G . 'TEMPS' = TABL ; G . 'DEPLACEMENTS' = TABL ; G . 'VITESSES' = TABL ; T = TABL ;
G . 'TEMPS' . 1 = 2. ; G . 'TEMPS' . 0 = 0.5 ; G . 'DEPLACEMENTS' . 1 = 4. * U ;
G . 'VITESSES' . 0 = U ; G . 'DEPLACEMENTS' . 0 = EXCO 'UX' U 'UX' ; G . 'VITESSES' . 1 = U - 1. ;
REPE W 20 ; T . &W = &W * &W ; FIN W ;
"""


def test_views_of_mixed_data_keep_what_belongs_together():
    r = ssilang.run(MIXED)
    u, k, mesh = r["u"], r["K"], r["S2"]
    assert u.nodes.tolist() == [3, 4, 6]
    np.testing.assert_equal(np.asarray(u), [[5, -1], [np.nan, 2], [3, np.nan]])
    assert u.points[:, 0].tolist() == u.frame()["x"].tolist() == [4, 4, 7]
    assert u.frame().loc[4].tolist()[1:] == pytest.approx([2, 0, np.nan, 2], nan_ok=True)
    assert (u.xarray().sel(node=6).UX, u.xarray().sel(node=6).y) == (3, 0)
    assert mesh.nodes.tolist() == [2, 3, 4, 5, 6, 7]
    assert mesh.points[:, 0].tolist() == [0, 4, 4, 0, 7, 7]
    assert mesh.cells["QUA4"].tolist() == [[0, 1, 2, 3]]
    assert sorted(mesh.cells["TRI3"].tolist()) == [[1, 4, 2], [4, 5, 2]]
    assert k.values("A", 2).tolist() == [[4, 7, 4]]
    assert k.points(2)[0, :, 0].tolist() == [4, 7, 4]
    assert set(k["B"].ravel()) == {6}
    assert k.frame().loc[(2, 1, 2), "A"] == 7
    assert k.frame()["A"].max() == 7
    with pytest.raises(ssilang.Error, match="zone"):
        k["A"]
    for zone in (0, k.zones + 1):
        with pytest.raises(ssilang.Error, match="zone"):
            k.values("A", zone)
    held = {
        "A": np.array([[1.0, 2.0, 3.0]]),
        "B": np.array([[7.0]]),
        "P": np.array([[r["A"].held]]),
    }
    both = CellFieldView(CellField((CellFieldBlock(r["Q"].held.blocks[0], held),)), "en").frame()
    assert both.to_dict("list") == {"A": [1, 2, 3], "B": [7, 7, 7]}
    assert both.index.tolist() == [(1, 1, 1), (1, 1, 2), (1, 1, 3)]
    assert "u" in r
    assert "NONE" not in r
    two = r.evaluate("ORDO (PROG 3. 1.) (LECT 7 8)")
    assert [v.tolist() for v in two] == [[1, 3], [8, 7]]
    html = r["T"]._repr_html_()
    assert re.findall("<td>(.*?)</td>", html)[14:18] == ["8", "64", "13", "169"]
    assert "... 4 ..." in html
    shown = re.findall("<td>(.*?)</td>", r.evaluate("U / 3.")._repr_html_())
    assert shown[:6] == ["3", "4", "0", "0", "1.66667", "-0.333333"]
    assert shown[6:] == ["4", "4", "2", "0", "", "0.666667", "6", "7", "0", "0", "1", ""]


def test_results_by_hand_are_in_the_order_of_time():
    r = ssilang.run(MIXED)
    found = r["G"].xarray("DEPL")
    assert found.time.values.tolist() == [0.5, 2]
    assert found.sel(component="UX", node=6).values.tolist() == [3, 12]
    assert found.sel(component="UY", node=4).values.tolist() == pytest.approx(
        [np.nan, 8], nan_ok=True
    )
    assert found.x.values.tolist() == [4, 4, 7]
    for point in ("E", 6, (7.0, 0.0), r["E"]):
        assert r.history("VITE", "UX", point).y.tolist() == [3, 2]
    assert [c.names for c in r.history("VITE", "UX", r.evaluate("E ET B"))] == [
        ("UX E",), ("UX B",)
    ]  # fmt: skip


@together(
    "given, values",
    [
        (np.arange(3), [0, 1, 2]), ((0.5, "a", True), [0.5, "a", True]), ("ab", ["ab"]),
        (Path("a") / "b", ["a/b"]), ([Path("c"), np.float64(2.5)], ["c", 2.5]), (7, [7]),
        (np.bool_(False), [False]), (range(2), [0, 1]),
    ],
)  # fmt: skip
def test_values_of_a_sweep_are_plain(given, values):
    found = ssilang.api.sweeps._axis("X", given, "en")
    assert [(type(v), v) for v in found] == [(type(v), v) for v in values]
