"""Fields at nodes and in cells, of numbers and of curves: making, algebra, parts, projections."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from script_runs import finder, ran
from together import together

from ssilang.kernel.fields import node_algebra
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.nodes import NodeTable

LINE = (
    "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 4. 0. ; L = DROI 4 PA PB ; "
    "C = MANU 'CHML' L 'A' 2. 'B' 5. ; S = MANU 'CHML' L 'SCAL' 3. ; "
)


def test_values_of_a_list_are_dealt_out_one_a_cell(found):
    field = found(
        LINE + "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
        "D = MANU 'CHML' MO 'REPA' 'V' (PROG 1. 2. 3.) 'TYPE' 'SCALAIRE' 'GRAVITE' ;",
        "D",
    )
    assert np.ravel(field.blocks[0].components["V"]).tolist() == [1, 2, 3, 1]
    assert field.title == "SCALAIRE"
    assert field.blocks[0].support == "GRAVITE"


def test_support_words_compare_on_their_eight_letters(found):
    field = found(
        LINE + "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
        "D = manu chml MO fx 0. fy -9.81 rigidites type scalaire ;",
        "D",
    )
    assert list(field.blocks[0].components) == ["FX", "FY"]
    assert (field.blocks[0].support, field.title) == ("RIGIDITE", "SCALAIRE")


def test_type_and_constituent_change(found):
    field = found(LINE + "D = CHAN 'CONS' (CHAN 'TYPE' C 'CARACTERISTIQUES') 'AB  ' ;", "D")
    assert field.title == "CARACTERISTIQUES"
    assert field.blocks[0].constituent == "AB"


@together(
    "other, told",
    [("C", []), ("C * 2.", [["A", "B"]]), ("CHAN 'CONS' (C * 2.) 'W'", []), ("S", [])],
)
def test_other_values_of_a_component_in_the_same_cells_are_told(other, told):
    done = ran(f"{LINE}D = C ET ({other}) ;")
    assert [w.data["names"] for w in done.session.warnings] == told


def test_zero_hooke_matrices_make_no_stiffness(found):
    block = found(
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; K = RIGI M (ZERO M 'HOTANGEN') ; ",
        "K",
    ).blocks[0]  # fmt: skip
    assert block.values.shape == (2, 8, 8)
    assert not block.values.any()


def test_a_field_reduced_strictly_is_the_same_without_mixtures(found):
    a, b = found(LINE + "X = REDU 'STRI' C (L ELEM 1) ; Y = REDU C (L ELEM 1) ;", "X", "Y")
    assert a.blocks[0].components.keys() == b.blocks[0].components.keys()
    assert [len(p.cells) for p in a.blocks] == [1]


def table(n):
    made = NodeTable()
    made.add(np.zeros((n, 3)))
    return made


TABLE = table(12)


@st.composite
def fields(draw):
    made = {}
    for name in draw(st.sets(st.sampled_from(["UX", "UY", "T"]), min_size=1)):
        nodes = sorted(draw(st.sets(st.integers(0, 11), min_size=1)))
        values = [draw(st.integers(-9, 9)) for _ in nodes]
        made[name] = NodeValues(np.array(nodes), np.array(values, dtype=float))
    return NodeField(TABLE, made)


def dense(field, name):
    return field.values_at(name, np.arange(12))


@given(fields(), fields())
@settings(max_examples=50)
def test_sum_is_the_sum_of_values_that_count_as_zero_where_absent(a, b):
    made = node_algebra.added(a, b, -2.0)
    for name in ("UX", "UY", "T"):
        np.testing.assert_array_equal(dense(made, name), dense(a, name) - 2 * dense(b, name))
    assert set(made.node_ids) == set(a.node_ids) | set(b.node_ids)


@given(fields(), fields())
@settings(max_examples=50)
def test_scalar_product_is_symmetric_and_that_of_the_vectors(a, b):
    names = ["UX", "UY"]
    x = node_algebra.scalar_product(a, b, names, names).values.sum()
    assert x == node_algebra.scalar_product(b, a, names, names).values.sum()
    assert x == sum(dense(a, n) @ dense(b, n) for n in names)


@given(fields(), st.sets(st.integers(0, 11), min_size=1))
@settings(max_examples=30)
def test_restriction_keeps_values_on_the_nodes_asked_for(a, nodes):
    kept = np.array(sorted(nodes))
    made = node_algebra.restricted(a, kept)
    assert set(made.node_ids) == set(a.node_ids) & nodes
    for name in made.components:
        np.testing.assert_array_equal(made.values_at(name, kept), a.values_at(name, kept))


@together("power, wanted", [("0.5", [0.0, 0.0, 2.0]), ("-1.", [-1.0, 0.0, 0.25])])
def test_values_without_a_power_become_zero_and_are_told(power, wanted):
    text = "OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (0. 0.) (2. 0.) ; "
    text += f"U = (MANU CHPO L 1 UX (PROG -1. 0. 4.)) ** {power} ; X = EXTR U 'VALE' L ; "
    text += f"S = L TRAN 1 (0. 1.) ; M = ((MANU CHML S 'A' 3.) - 4.) ** {power} ; Y = MAXI M ;"
    result = ran(text)
    find = result.session.root.find
    assert sorted(find("X").values) == pytest.approx(sorted(wanted))
    assert find("Y") == pytest.approx(wanted[0])
    told = [w for w in result.session.warnings if w.code == "operators.fields.power-put-to-zero"]
    assert len(told) == (2 if power == "0.5" else 1)


FIELD = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = (DROI 2 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ;
M = MODE S 'MECANIQUE' 'ELASTIQUE' ;
E1 = EVOL 'MANU' 'T' (PROG 0. 1. 3.) 'YOUN' (PROG 2. 4. 5.) ; A = MATE M 'YOUN' E1 'NU' 0.3 ;
"""


@together(
    "said, run, plain",
    [
        ("A * 2.", lambda y: 2 * y, 0.6),
        ("3 - A", lambda y: 3 - y, 2.7),
        ("A / 4", lambda y: y / 4, 0.075),
        ("1. / A", lambda y: 1 / y, 1 / 0.3),
        ("A ** 2", lambda y: y**2, 0.09),
        ("A + 1.", lambda y: y + 1, 1.3),
        ("ASIH A", np.arcsinh, np.arcsinh(0.3)),
        ("ABS (-1. * A)", np.abs, 0.3),
    ],
)
def test_curves_in_cells_go_with_numbers(said, run, plain, tmp_path):
    script = FIELD + f"B = {said} ; C = EXTR B 'YOUN' 1 2 1 ; X = EXTR B 'NU' 1 1 1 ; "
    find = finder(script + "Y = EXTR C 'ORDO' ; Z = EXTR C 'ABSC' ;", tmp_path)
    np.testing.assert_allclose(find("Y").values, run(np.array([2.0, 4.0, 5.0])))
    np.testing.assert_allclose(find("Z").values, [0.0, 1.0, 3.0])
    assert find("X") == pytest.approx(plain)


@together("cells, element", [("TRI3", "DKT"), ("TRI3", "COQ3"), ("QUA4", "COQ4")])
def test_least_squares_on_shells_keep_means_and_what_is_linear(cells, element, tmp_path):
    find = finder(
        f"""
        OPTI DIME 3 MODE TRID ELEM {cells} ; U = (2. 0. 1.) ; V = (0. 3. 0.) ; O = (0. 0. 0.) ;
        S = (DROI 6 O U) TRAN 6 V ; M = MODE S 'MECANIQUE' 'ELASTIQUE' '{element}' ;
        T = (DROI 2 O U) TRAN 3 V ; N = MODE T 'MECANIQUE' 'ELASTIQUE' '{element}' ;
        X Y Z = COOR S ; L = (2. * X) - (3. * Y) + (4. * Z) + 1. ;
        A = PROI 'MINI' N (CHAN 'CHAM' L M) ;
        XT YT ZT = COOR T ; LT = (2. * XT) - (3. * YT) + (4. * ZT) + 1. ;
        D = MAXI (A - (CHAN 'CHAM' LT N)) 'ABS' ;
        C = CHAN 'CHAM' (X * X) M ; B = PROI 'MINI' N C 4 ;
        I1 = INTG N B ; I2 = INTG M C ;
        """,
        tmp_path,
    )
    assert find("D") < 1e-9
    assert find("I1") == pytest.approx(find("I2"), rel=2e-2)


PLANE = (
    "OPTI DIME 2 MODE {mode} ELEM {kind} ; L = DROI {n} (0. 0.) (2. 0.) ; S = L TRAN {m} (0. 1.) ; "
    "OPTI ELEM QUA4 ; R = (DROI 1 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
    "M1 = MODE S 'MECANIQUE' 'ELASTIQUE' ; M2 = MODE R 'MECANIQUE' 'ELASTIQUE' ; "
    "X Y = COOR S ; "
)


def projected(text, kind="QUA4", mode="PLAN DEFO", n=8, m=4):
    result = ran(PLANE.format(kind=kind, mode=mode, n=n, m=m) + text)
    (block,) = result.session.root.find("P").blocks
    return block.cells.coordinates[0], block.components["SCAL"][0]


@together("kind", ["QUA4", "TRI3", "QUA8"])
@together("mode", ["PLAN DEFO", "AXIS"])
def test_what_the_coarse_cell_can_hold_is_found_again(kind, mode):
    x, values = projected(
        "C = CHAN 'CHAM' (NOMC 'SCAL' (1. + (2. * X) - Y)) M1 ; P = PROI M2 C 'MINI' ;", kind, mode
    )
    np.testing.assert_allclose(values, 1 + 2 * x[:, 0] - x[:, 1], atol=1e-10)


@together("points, n", [("", 16), (" 8", 64)])
def test_a_parabola_becomes_its_best_line(points, n):
    """Least squares of x^2 on [0, 2]: 2 x - 2/3; in axisymmetry the weight x makes 2.4 x - 1.2."""
    text = f"C = CHAN 'CHAM' (NOMC 'SCAL' (X * X)) M1 ; P = PROI M2 C 'MINI'{points} ;"
    x, values = projected(text, "QUA8", n=n)
    np.testing.assert_allclose(values, 2 * x[:, 0] - 2 / 3, atol=1e-9)
    x, values = projected(text, "QUA8", "AXIS", n=n)
    np.testing.assert_allclose(values, 2.4 * x[:, 0] - 1.2, atol=1e-9)


def test_the_integral_of_a_rough_field_is_kept_as_points_grow():
    """A step at x = 1: its mean 0.5 and its first moment are those of the projection."""
    text = (
        "OPTI ELEM QUA4 ; A = (DROI 1 (1. 0.) (2. 0.)) TRAN 1 (0. 1.) ; MA = MODE A 'MECANIQUE' "
        "'ELASTIQUE' ; C = MANU 'CHML' MA 'SCAL' 1. 'NOEUD' ; P = PROI M2 C 'MINI' 60 ;"
    )
    x, values = projected(text)
    # best line of the step on [0, 2]: 0.5 + 0.75 (x - 1)
    np.testing.assert_allclose(values, 0.5 + 0.75 * (x[:, 0] - 1), atol=2e-3)


@together("place, count, code", [
        ("(MANU 'POI1' (0.5 0.5)) ET (MANU 'POI1' (2.5 0.5)) ET (MANU 'POI1' (3. 0.))", 2,
         "projected-nowhere-outside"),
        ("M2", 2, "projected-zero-outside"),
        ("M2 'MINI'", 3, "projected-zero-outside"),
    ])  # fmt: skip
@together("tolerance, told", [("1.E-5", True), ("9.", False)])
def test_points_outside_are_told_and_raise_the_flag(place, count, code, tolerance, told):
    """M2 is twice as long as the field's mesh."""
    text = (
        "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; S = (DROI 4 (0. 0.) (2. 0.)) TRAN 2 (0. 1.) ; "
        "R = (DROI 1 (0. 0.) (4. 0.)) TRAN 1 (0. 1.) ; M2 = MODE R 'MECANIQUE' 'ELASTIQUE' ; "
        "C = CHAN 'CHAM' (NOMC 'SCAL' (1. + (0. * (COOR 1 S)))) S ; "
    )
    words = place.replace("M2 'MINI'", "M2 C 'MINI'")
    call = f"PROI {words} {tolerance}" if "MINI" in words else f"PROI ({words}) C {tolerance}"
    result = ran(text + f"P = {call} ; Z = SOUC ;")
    assert result.session.root.find("Z") is told
    found = [(w.code.rpartition(".")[2], w.data["count"]) for w in result.session.warnings]
    assert found == ([(code, count)] if told else [])
