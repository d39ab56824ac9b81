"""Fields at nodes: making, components, algebra, union, restriction, measures."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from script_runs import ran

from ssilang.kernel.fields import node_algebra
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.nodes import NodeTable

LINE = "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 1. 2. ; L = DROI 4 PA PB ; X Y = COOR L ; "
POINT = "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; C = MANU 'CHPO' (P ET Q) 'UX' 3. 'UY' 4. ; "


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


def test_product_by_a_scalar_field_lives_where_both_are(found):
    size, top = found(
        LINE + "C = MANU 'CHPO' (PA ET PB) 'UX' 3. 'UY' 4. ; D = C * Y ; "
        "N = NBNO (EXTR D 'MAIL') ; M = MAXI D ;",
        "N", "M",
    )  # fmt: skip
    assert (size, top) == (2, 8.0)


def test_product_by_names_makes_the_named_components(found):
    fx, fy, names = found(
        POINT + "K = MANU 'CHPO' (P ET Q) 'KX' 10. 'KYX' 2. ; "
        "F = K * C (MOTS 'KX' 'KYX') (MOTS 'UX' 'UX') (MOTS 'FX' 'FY') 'NATURE' 'DISCRET' ; "
        "FX = EXTR F 'FX' P ; FY = EXTR F 'FY' Q ; N = EXTR F 'NATU' ;",
        "FX", "FY", "N",
    )  # fmt: skip
    assert (fx, fy, names) == (30.0, 6.0, "DISCRET")


@pytest.mark.parametrize(
    ("left", "right", "expected"),
    [
        ("DIFFUS", "DIFFUS", "DIFFUS"),
        ("DIFFUS", "DISCRET", "DISCRET"),
        ("DIFFUS", "INDETER", "INDETERMINE"),
        ("DISCRET", "INDETER", "INDETERMINE"),
    ],
)
def test_nature_of_a_product(left, right, expected, found):
    assert (
        found(
            POINT + "S = EXCO 'UX' C ; "
            f"A = CHAN 'ATTRIBUT' S 'NATURE' '{left}' ; B = CHAN S 'ATTRIBUT' 'NATURE' '{right}' ; "
            "N = EXTR (A * B) 'NATU' ;",
            "N",
        )
        == expected
    )


def test_union_adds_discrete_values_and_wants_diffuse_ones_to_agree(found, refused):
    natures = POINT + (
        "D = CHAN 'ATTRIBUT' C 'NATURE' 'DISCRET' ; E = CHAN 'ATTRIBUT' C 'NATURE' 'DIFFUS' ; "
    )
    a, b, c = found(
        natures + "A = EXTR (D ET D) 'UX' P ; B = EXTR (E ET E) 'UX' P ; "
        "F = E ET (E * 2.) 'NOER' ; C = EXTR F 'UX' P ;",
        "A", "B", "C",
    )  # fmt: skip
    assert (a, b, c) == (6.0, 3.0, 3.0)
    assert "3 in one field and 6 in the other" in refused(natures + "F = E «ET» (E * 2.) ;")
    assert "natures" in refused(natures + "F = E «ET» D ;")


def test_component_is_taken_under_the_name_scal_or_a_new_one(found, refused):
    a, b = found(
        POINT + "A = EXTR (EXCO 'UY' C) 'SCAL' P ; B = EXTR (EXCO 'UY' C 'T') 'T' P ;", "A", "B"
    )
    assert (a, b) == (4.0, 4.0)
    assert "components are: UX UY" in refused(POINT + "A = «EXCO» 'UZ' C ;")
    assert found(POINT + "E = VIDE (EXCO 'UZ' 'NOID' C) ;", "E") is True


def test_values_come_in_the_order_of_the_points_asked_for(found):
    one, both = found(
        LINE + "M = MANU 'POI1' PB PA ; A = EXTR Y 'VALE' M ; C = NOMC 'T' Y ; "
        "D = C ET (NOMC 'S' X) ; B = EXTR D 'VALE' (MOTS 'S' 'T') PB ;",
        "A", "B",
    )  # fmt: skip
    assert one.values.tolist() == [2.0, 0.0]
    assert both.values.tolist() == [1.0, 2.0]


def test_list_of_values_on_points(found):
    a, b = found(
        LINE + "M = CHAN 'POI1' L ; N = NBNO M ; C = MANU 'CHPO' M 'T' (PROG 1. 2. 3. 4. 5.) ; "
        "A = MAXI C ; P = POIN (EXTR C 'MAIL') 1 ; B = EXTR (RESU C) 'T' P ;",
        "A", "B",
    )  # fmt: skip
    assert (a, b) == (5.0, 15.0)


def test_repeated_points_sum_up_in_a_discrete_field(found, refused):
    script = "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; M = MANU 'POI1' P Q P ; "
    top = found(
        script + "C = MANU 'CHPO' M 'FX' (PROG 1. 2. 3.) 'NATURE' 'DISCRET' ; X = EXTR C 'FX' P ;",
        "X",
    )
    assert top == 4.0
    assert "twice" in refused(
        script + "C = «MANU» 'CHPO' 'NATURE' 'DIFFUS' M 'T' (PROG 1. 2. 3.) ;"
    )


def test_products_norms_and_combinations(found):
    values = found(
        POINT + "LM = MOTS 'UX' 'UY' ; A = XTY C C LM LM ; B = XTX C ; "
        "D = EXTR (PSCA C C LM LM) 'SCAL' Q ; E = XTX 2. C -1. C ; "
        "F = EXTR (COLI C 2. C 3.) 'UX' P ; T = TABL ; T . P = C ; T . Q = C * 10. ; "
        "W = MANU 'CHPO' P 'ALFA' 2. ; G = EXTR (COMB W T) 'UX' P ; LC = SUIT C (C * 2.) ; "
        "H = EXTR (XTY LC LC LM LM) 2 ; I = EXTR (COLI LC (PROG 1. -1.)) 'UX' P ;",
        "A", "B", "D", "E", "F", "G", "H", "I",
    )  # fmt: skip
    assert values == (50.0, 50.0, 25.0, 50.0, 15.0, 6.0, 200.0, -3.0)


def test_restriction_to_points_and_to_where_another_field_is_not_zero(found):
    a, b = found(
        LINE + "A = NBNO (EXTR (REDU Y PB) 'MAIL') ; B = NBNO (EXTR (REDU Y X) 'MAIL') ;", "A", "B"
    )
    assert (a, b) == (1, 4)


def test_forces_are_zero_where_none_acts(found, refused):
    start = POINT + "R = 5. 5. ; F = FORC (3. 4.) P ; "
    values = found(
        start + "X1 = EXTR F 'FX' R ; X2 = EXTR F 'FX' P ; "
        "X3 = EXTR (EXTR C 'VALE' 'UX' R 'NOID') 1 ; X4 = EXTR (EXTR C 'VALE' 'UY' (P ET R)) 2 ;",
        "X1", "X2", "X3", "X4",
    )  # fmt: skip
    assert values == (0.0, 3.0, 0.0, 0.0)
    assert "RZ" in refused(start + "X = «EXTR» C 'RZ' R ;")


@pytest.mark.parametrize(
    ("power", "wanted"), [("0.5", [0.0, 0.0, 2.0]), ("-1.", [-1.0, 0.0, 0.25])]
)
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


def test_vector_product_in_3d_is_orthogonal_to_both_factors(found):
    values = found(
        "OPTI DIME 3 ; P = 0. 0. 0. ; L = MOTS 'X' 'Y' 'Z' ; "
        "A = MANU 'CHPO' P 3 'X' 1. 'Y' 2. 'Z' -3. ; B = MANU 'CHPO' P 3 'X' 0. 'Y' 5. 'Z' 7. ; "
        "C = PVEC A B L L L ; D = XTY A C L L ; E = XTY B C L L ; F = EXTR C 'X' P ;",
        "D", "E", "F",
    )  # fmt: skip
    assert values == (0.0, 0.0, 2 * 7 + 3 * 5)


def test_number_raised_to_the_values_of_a_field(found, refused):
    assert found(POINT + "A = MAXI (2. ** C) ; B = MINI (2 ** C) ;", "A", "B") == (16.0, 8.0)
    assert "powers of a field" in refused(POINT + "A = -2. «**» C ;")


def test_inverse_of_a_field_is_one_over_its_values(found, refused):
    field = found(POINT + "D = INVE C ;", "D")
    for name, expected in (("UX", 1 / 3), ("UY", 0.25)):
        np.testing.assert_allclose(field.components[name].values, expected)
    assert "UX is 0 at (0, 0" in refused(POINT + "D = INVE «(MANU 'CHPO' P 'UX' 0.)» ;")


@pytest.mark.parametrize("phrase", ["A ET B 'NOER'", "A ET 'NOER' B", "ET 'NOER' A B"])
def test_diffuse_fields_that_differ_are_joined_where_it_is_said(found, refused, phrase):
    fields = "OPTI DIME 2 ; P = 0. 0. ; A = MANU 'CHPO' P 'T' 3. 'NATU' 'DIFFUS' ; B = A + 1. ; "
    assert found(fields + f"X = EXTR ({phrase}) 'T' P ;", "X") == 3.0
    assert "T" in refused(fields + "X = A «ET» B ;")
