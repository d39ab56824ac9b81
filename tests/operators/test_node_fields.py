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
