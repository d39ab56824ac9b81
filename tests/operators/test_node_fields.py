"""Fields at nodes: making, components, algebra, union, restriction, measures."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from script_runs import ran
from together import together

from ssilang.kernel.fields import node_algebra
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.nodes import NodeTable

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


def test_forces_are_zero_where_none_acts(found, refused):
    start = POINT + "R = 5. 5. ; F = FORC (3. 4.) P ; "
    values = found(
        start + "X1 = EXTR F 'FX' R ; X2 = EXTR F 'FX' P ; "
        "X3 = EXTR (EXTR C 'VALE' 'UX' R 'NOID') 1 ; X4 = EXTR (EXTR C 'VALE' 'UY' (P ET R)) 2 ;",
        "X1", "X2", "X3", "X4",
    )  # fmt: skip
    assert values == (0.0, 3.0, 0.0, 0.0)
    assert "RZ" in refused(start + "X = «EXTR» C 'RZ' R ;")


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


@pytest.mark.parametrize("phrase", ["A ET B 'NOER'", "A ET 'NOER' B", "ET 'NOER' A B"])
def test_diffuse_fields_that_differ_are_joined_where_it_is_said(found, refused, phrase):
    fields = "OPTI DIME 2 ; P = 0. 0. ; A = MANU 'CHPO' P 'T' 3. 'NATU' 'DIFFUS' ; B = A + 1. ; "
    assert found(fields + f"X = EXTR ({phrase}) 'T' P ;", "X") == 3.0
    assert "T" in refused(fields + "X = A «ET» B ;")
