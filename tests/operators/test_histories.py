"""Histories that DYNAMIC records at a few nodes against fields of whole bodies."""

import numpy as np
import pytest
import pyvista
from script_runs import finder, ran, refused
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.statics.linear import product
from ssilang.kernel.stepping.node_histories import NodeHistories
from ssilang.kernel.stepping.problem import problem
from ssilang.kernel.stepping.problem.problem import MOST_SMALL

BLOCK = """
OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ;
C = DROI 4 (0. 0.) (1. 0.) ; SOL = C TRAN 2 (0. -1.) ;
A = DROI 4 (0. 0.) (1. 0.) ; BLOC = A TRAN 2 (0. 1.) ;
J = RACC 0.01 A C ; M = MODE (SOL ET BLOC) 'MECANIQUE' 'ELASTIQUE' ;
MA = MATE M 'YOUN' 1.E9 'NU' 0.2 'RHO' 2000. ;
MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ; AJ = MATE MJ 'KN' 1.E8 'KS' 1.E8 ;
B1 = BLOQ 'DEPL' (COTE 3 SOL) ; T = TABL ; T . 'MODELE' = MJ ; T . 'CARACTERISTIQUES' = AJ ;
T . 'RIGI' = (RIGI M MA) ET B1 ; T . 'MASS' = MASS M MA ;
W = (T . 'MASS') * (MANU 'CHPO' BLOC 1 'UY' -9.81) ;
S = (T . 'MASS') * (MANU 'CHPO' BLOC 1 'UX' 90.) ;
T . 'CHAR' = (CHAR 'MECA' W (EVOL MANU (PROG 0. 9.) (PROG 1. 1.))) ET
  (CHAR 'MECA' S (EVOL MANU (PROG 0. 0.01 0.02) (PROG 1. -1. 1.))) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 2.E-4 0.02 ; T . 'PAS_SAUVES' = 3 ;
P = BLOC POIN 'PROC' (0. 1.) ; PM = POIN 2 (EXTR B1 'MAIL' 'MULT') ;
{step}
R1 = DYNAMIC T ;
T . 'MAILLAGE_SAUVE' = (MANU 'POI1' P) ET (EXTR B1 'MAIL' 'MULT') ;
R2 = DYNAMIC T ;
"""
LOOPS = {
    "dissection or modes": "",
    "conserving": "T . 'CONSERVATIF' = VRAI ;",
    "full Newton": "T . 'NEWTON_COMPLET' = VRAI ;",
    "adaptive": "T . 'PAS_ADAPTE' = VRAI ;",
    "reduced": "T . 'REDUCTION' = 1.E-2 ;",
}


YIELDS = """M1 = MODE BLOC 'MECANIQUE' 'ELASTIQUE' ; A1 = MATE M1 'YOUN' 1.E9 'NU' 0.2 'RHO' 2000. ;
M2 = MODE SOL 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' 'PARFAIT' ;
A2 = MATE M2 'YOUN' 1.E9 'NU' 0.2 'RHO' 2000. 'SIGY' 1.E4 ; T . 'MODELE' = MJ ET M2 ;
T . 'CARACTERISTIQUES' = AJ ET A2 ; T . 'RIGI' = (RIGI M1 A1) ET B1 ;
T . 'MASS' = (MASS M1 A1) ET (MASS M2 A2) ;"""


@pytest.mark.parametrize(
    ("step", "most"),
    [*((step, MOST_SMALL) for step in [*LOOPS.values(), YIELDS]), (YIELDS, 0)],
    ids=[*LOOPS, "yielding ground", "yielding ground of many unknowns"],
)
def test_fields_at_a_few_nodes_are_those_of_the_body(step, most, monkeypatch):
    monkeypatch.setattr(problem, "MOST_SMALL", most)
    find = finder(BLOCK.format(step=step))
    whole, few = find("R1"), find("R2")
    node = find("P").node
    places = [i for i, _ in few.items() if type(i) is int]
    assert places == [i for i, _ in whole.items() if type(i) is int] == list(range(1, 36))
    for place in places:
        a, b = whole.get(place), few.get(place)
        assert a.get("TEMP") == b.get("TEMP")
        for index in ("DEPL", "VITE", "ACCE"):
            names = ["UX", "UY", "LX"] if index == "DEPL" else ["UX", "UY"]
            assert sorted(b.get(index).components) == sorted(names)
            for name, part in b.get(index).components.items():
                exact = a.get(index).components[name].at(part.nodes)
                scale = np.abs(a.get(index).components[name].values).max()
                assert np.abs(part.values - exact).max() <= 1e-9 * scale, (index, name)
                assert name == "LX" or part.nodes.tolist() == [node]
        for index in ("SAUTS", "CONTRAINTES", "VARIABLES_INTERNES"):
            for x, y in zip(a.get(index).blocks, b.get(index).blocks, strict=True):
                assert x.components.keys() == y.components.keys()
                for name, values in x.components.items():
                    assert np.array_equal(values, y.components[name]), name


def test_cells_of_a_series_have_what_is_their_own(tmp_path):
    """Joints have tractions, the block its stresses, ground that yields those of its law."""
    step = "T . 'MODELE' = MJ ET M1 ET M2 ; T . 'CARACTERISTIQUES' = AJ ET A1 ET A2 ; "
    step += "T . 'PAS_SAUVES_VTK' = 20 ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 2.E-4 0.004 ;"
    script = BLOCK.format(step=YIELDS + step).partition("T . 'MAILLAGE_SAUVE'")[0]
    script += "R = R1 . (DIME R1) ; S = SIGM M1 A1 (R . 'DEPL') ; "
    root = ran(script, tmp_path).session.root
    ground, joints = root.find("R").get("CONTRAINTES").blocks
    shown = pyvista.read(tmp_path / "dynamic.0002.vtu").cell_data

    def means(block, *names):
        return np.stack([block.components[n].mean(axis=1) for n in names], axis=1)

    stresses = [means(b, "SMXX", "SMYY", "SMXY") for b in (root.find("S").blocks[0], ground)]
    np.testing.assert_allclose(shown["traction"][:4, :2], means(joints, "SMN", "SMSN"))
    np.testing.assert_allclose(shown["stress"][4:, [0, 1, 3]], np.concatenate(stresses))
    assert np.isnan(shown["traction"][4:]).all()
    assert np.isnan(shown["stress"][:4]).all()


NAMED = """T . 'RELATIONS_SAUVEES' = TABL ; T . 'RELATIONS_SAUVEES' . 'BASE' = B1 ; """


RUBBED = LOOPS | {
    "friction": "T . 'CARACTERISTIQUES' = MATE MJ 'KN' 1.E8 'KS' 1.E8 'FROT' 0.1 ;",
    "friction, full Newton": "T . 'CARACTERISTIQUES' = MATE MJ 'KN' 1.E8 'KS' 1.E8 'FROT' 0.1 ; "
    "T . 'NEWTON_COMPLET' = VRAI ;",
    "a procedure's loads": "T . 'CHAR' = CHAR 'MECA' W (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ; "
    "T . 'CHARMECA' = VRAI ; DEBP CHARMECA T0*TABLE TI*FLOTTANT ; TC = TABL ; "
    "TC . 'ADDI_FNL' = (1. - (200. * (MINI (PROG TI 0.01))) "
    "+ (200. * (MAXI (PROG (TI - 0.01) 0.)))) * S ; FINP TC ; ",
}


@pytest.mark.parametrize("loop", RUBBED)
def test_forces_of_a_named_support_are_what_moves_the_whole_body(loop):
    find = finder(BLOCK.format(step=RUBBED[loop] + NAMED))
    mass, whole = find("T").get("MASS"), find("R1")
    rows = [whole.get(i) for i in range(1, 36)]
    pushed = [product(mass, row.get("ACCE")).components for row in rows]
    times = np.array([row.get("TEMP") for row in rows])
    curve = np.interp(times, [0.0, 0.01, 0.02], [1.0, -1.0, 1.0])
    if loop == "conserving":  # accelerations and reactions are means over a step
        before = np.interp(times - 2e-4, [0.0, 0.01, 0.02], [1.0, -1.0, 1.0])
        curve = np.where(times > 0.0, 0.5 * (before + curve), curve)
    loads = {
        "FX": find("S").components["FX"].values.sum() * curve,
        "FY": find("W").components["FY"].values.sum() * np.ones(35),
    }
    found = find("T").get("RESULTATS_RELATIONS").get("BASE")
    assert [str(i).rstrip() for i, _ in found.items()] == ["TEMP", "FX", "FY"]
    assert np.array_equal(found.get("TEMP").values, times)
    near = 1e-2 if loop == "reduced" else 1e-9  # the tolerance of the basis
    for name, load in loads.items():
        exact = np.array([p[name].values.sum() for p in pushed]) - load
        difference = np.abs(found.get(name).values - exact).max()
        assert difference <= near * np.abs(exact).max(), name


def test_stops_push_with_what_moves_the_mass_and_touch_alone():
    """A mass that falls on a stop from 1 mm and bounces: no force on its ways."""
    find = finder("""
OPTI DIME 2 ELEM SEG2 MODE PLAN CONT ; P = 0. 0. ; T = TABL ;
STOP = BLOQ 'MINI' 'UY' P ; SIDE = BLOQ 'UX' P ; K = APPUI 'UY' 1.E4 P ;
T . 'RIGI' = K ET STOP ET SIDE ; T . 'MASS' = MASS 'DEPL' 10. P ; T . 'AMOR' = 0.1 * K ;
T . 'CHAR' = (CHAR 'MECA' (FORC (3. -100.) P)) ET
  (CHAR 'DIMP' (DEPI STOP -1.E-3) (EVOL MANU (PROG 0. 9.) (PROG 1. 1.))) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.1 ; T . 'PAS_SAUVES' = 'TOUS' ;
T . 'VITEUNIL' = FAUX ;
T . 'RELATIONS_SAUVEES' = TABL ; T . 'RELATIONS_SAUVEES' . 'STOP' = STOP ;
T . 'RELATIONS_SAUVEES' . 'BOTH' = STOP ET SIDE ; R = DYNAMIC T ;
""")
    found, steps, p = find("T").get("RESULTATS_RELATIONS"), find("R"), [find("P").node]
    y, v, a = (
        np.array([steps.get(i).get(w).components["UY"].at(p)[0] for i in range(1, 102)])
        for w in ("DEPL", "VITE", "ACCE")
    )
    force = found.get("STOP").get("FY").values
    exact = 10.0 * a + 1e4 * y + 1e3 * v + 100.0
    assert np.abs(force - exact).max() < 1e-9 * np.abs(exact).max()
    assert not force[y > -1e-3 + 1e-9].any()
    assert np.count_nonzero(force) > 3
    assert found.get("STOP").get("FX") is None
    assert np.array_equal(found.get("BOTH").get("FY").values, force)
    assert np.allclose(found.get("BOTH").get("FX").values, -3.0, rtol=1e-12)


@together(
    "relations, code",
    [("BLOQ 'UX' P", "relations-not-in-stiffness"), ("RIGI M MA", "no-relations")],
)
def test_relations_that_the_stiffness_has_not_are_refused_by_name(relations, code):
    more = f"T . 'RELATIONS_SAUVEES' = TABL ; T . 'RELATIONS_SAUVEES' . 'TOP' = {relations} ; "
    result = run_text(BLOCK.format(step=more))
    assert result.exit_code == 1
    assert [e.code for e in result.errors] == [f"operators.dynamics.{code}"]
    assert "TOP" in result.message


CURVES = {
    "word behind": ("'DEPL' P 'UX'", lambda s, f: s.get("DEPL").components["UX"].at([f("P").node])),
    "displacement": (
        "'DEPL' 'UY' P",
        lambda s, f: s.get("DEPL").components["UY"].at([f("P").node]),
    ),
    "velocity": ("'VITE' 'UX' P", lambda s, f: s.get("VITE").components["UX"].at([f("P").node])),
    "reaction": ("'DEPL' 'LX' PM", lambda s, f: s.get("DEPL").components["LX"].at([f("PM").node])),
    "jump": ("'SAUTS' 'DRN' 1 3 2", lambda s, f: s.get("SAUTS").blocks[0].components["DRN"][2, 1:]),
    "traction": (
        "'CONTRAINTES' 'SMN' 1 1 1",
        lambda s, f: s.get("CONTRAINTES").blocks[0].components["SMN"][0, :1],
    ),
    "state": (
        "'VARIABLES_INTERNES' 'ESTO' 1 4 2",
        lambda s, f: s.get("VARIABLES_INTERNES").blocks[0].components["ESTO"][3, 1:],
    ),
    "law": (
        "'VARIABLES_INTERNES' 'SAUT' 1 1 9",
        lambda s, f: s.get("VARIABLES_INTERNES").blocks[0].components["SAUT"][0, 1:],
    ),
}


def test_curves_in_time_read_rows_without_making_fields(monkeypatch):
    made, given = [], NodeHistories.node_field
    monkeypatch.setattr(
        NodeHistories, "node_field", lambda s, row, name: made.append(row) or given(s, row, name)
    )
    asked = [(table, name) for table in ("R1", "R2") for name in CURVES]
    curves = (f"E{i} = EVOL 'TEMP' {t} {CURVES[name][0]} ; " for i, (t, name) in enumerate(asked))
    find = finder(BLOCK.format(step="") + "".join(curves))
    assert set(made) <= {0}  # the first says what components there are
    for i, (table, name) in enumerate(asked):
        curve, value = find(f"E{i}").parts[0], CURVES[name][1]
        rows = [find(table).get(k) for k in range(1, 36)]
        assert np.array_equal(curve.abscissas, [row.get("TEMP") for row in rows]), (table, name)
        exact = np.array([float(value(row, find)[0]) for row in rows])
        assert np.abs(exact).max() > 0.0, (table, name)
        difference = np.abs(curve.ordinates - exact).max()
        assert difference <= 1e-12 * np.abs(exact).max(), (table, name)


def test_curves_follow_what_a_script_put_into_the_table():
    change = "A1 = R2 . 4 ; A1 . 'DEPL' = 2. * (A1 . 'DEPL') ; "
    ask = "E{i} = EVOL 'TEMP' R2 'DEPL' 'UY' P ; "
    find = finder(BLOCK.format(step="") + ask.format(i=1) + change + ask.format(i=2))
    before, after = (find(name).parts[0].ordinates for name in ("E1", "E2"))
    ratio = np.ones(35)
    ratio[3] = 2.0
    assert np.allclose(after, ratio * before, rtol=1e-14)


@pytest.mark.parametrize(
    ("step", "asked"),
    [("", "R2 'DEPL' 'UY' (C POIN 'PROC' (0. 0.))"), (YIELDS, "R1 'DEPL' (0. 9.) 'UY'")],
)
def test_a_node_that_is_not_kept_is_told_with_the_nearest_one(step, asked):
    result = run_text(BLOCK.format(step=step) + f"E = EVOL 'TEMP' {asked} ;")
    assert [e.code for e in result.errors] == ["operators.curves.no-value-at-node"]
    assert "0. 1." in result.message


def test_lists_and_their_file_hold_the_same_values(tmp_path):
    more = "T . 'PAS_SAUVES_CSV' = 3 ; T . 'MAILLAGE_CSV' = MANU 'POI1' P ; R3 = DYNAMIC T ;"
    find = finder(BLOCK.format(step="") + more)
    lists, node = find("T").get("RESULTATS_CSV"), find("P").node + 1
    names = [str(i).rstrip() for i, _ in lists.items()]
    kinds = [f"{w}_{c}_{node}" for w in ("DEPL", "VITE", "ACCE") for c in ("UX", "UY")]
    assert names[0] == "TEMP"
    assert sorted(names[1:]) == sorted(kinds)
    rows = [find("R2").get(i) for i in range(1, 36)]
    exact = [float(r.get("ACCE").components["UX"].values[0]) for r in rows]
    assert np.array_equal(lists.get(f"ACCE_UX_{node}").values, exact)


def test_a_parquet_file_holds_the_lists_with_their_units(tmp_path):
    pq = pytest.importorskip("pyarrow.parquet")
    more = (
        "T . 'PAS_SAUVES_CSV' = 3 ; T . 'MAILLAGE_CSV' = MANU 'POI1' P ; "
        "T . 'FICHIER_CSV' = '{name}' ; R3 = DYNAMIC T ; "
    )
    text = "OPTI 'UNIT' 'KN-M' ; " + BLOCK.format(step="")
    for name in ("corner.parquet", "corner"):
        text += more.format(name=name)
    find = finder(text, tmp_path)
    lists = find("T").get("RESULTATS_CSV")
    table = pq.read_table(tmp_path / "corner.parquet")
    assert table.column_names == [str(i).rstrip() for i, _ in lists.items()]
    units = [field.metadata[b"unit"].decode() for field in table.schema]
    assert units == ["s", "m", "m", "m/s", "m/s", "m/s2", "m/s2"]
    for name, values in lists.items():
        assert np.array_equal(table[str(name).rstrip()].to_numpy(), values.values)
    lines = (tmp_path / "corner.csv").read_text().splitlines()
    assert lines[0].split(";")[:2] == ["TEMP (s)", f"{table.column_names[1]} (m)"]
    rows = np.array([[float(x) for x in line.split(";")] for line in lines[1:]])
    exact = np.column_stack([c.to_numpy() for c in table.columns])
    assert np.abs(rows - exact).max() <= 1e-11 * np.abs(exact).max()


def test_a_parquet_file_without_pyarrow_is_refused(monkeypatch):
    monkeypatch.setattr("ssilang.operators.dynamics.motion_files.is_there", lambda: False)
    more = (
        "T . 'PAS_SAUVES_CSV' = 3 ; T . 'MAILLAGE_CSV' = P ; "
        "T . 'FICHIER_CSV' = 'corner.parquet' ; R3 = DYNAMIC T ;"
    )
    assert "pip install" in refused(BLOCK.format(step="") + more)
