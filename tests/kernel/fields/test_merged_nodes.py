"""Nodal fields made before nodes were merged."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.node_algebra import added, restricted
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.nodes import NodeTable


def two_lines(nature: str = "") -> tuple[NodeTable, NodeField, NodeField]:
    table = NodeTable()
    first, second = table.add(np.zeros((3, 2))), table.add(np.zeros((3, 2)))
    a = NodeField.of(table, first, {"UX": np.array([1.0, 2, 3])}, nature)  # type: ignore[arg-type]
    b = NodeField.of(table, second, {"UX": np.array([10.0, 20, 30])}, nature)  # type: ignore[arg-type]
    table.merge(first, second)
    return table, a, b


def test_fields_on_merged_nodes_meet() -> None:
    _, a, b = two_lines()
    sum_ = added(a, b).components["UX"]
    assert np.array_equal(sum_.nodes, [0, 1, 2])
    assert np.array_equal(sum_.values, [11, 22, 33])


def test_a_field_is_found_on_the_surviving_nodes() -> None:
    _, _, b = two_lines()
    assert np.array_equal(restricted(b, np.array([1])).components["UX"].values, [20.0])


def test_discrete_values_of_one_node_add_up_and_others_must_agree() -> None:
    table, _, _ = two_lines()
    for nature, second, expected in (
        ("DIFFUS", [5.0, 6, 7], [5.0, 6, 7]),
        ("DISCRET", [8.0, 9, 10], [13.0, 15, 17]),
        ("DIFFUS", [5.0, 6, 7.1], None),
        ("", [5.0, 6.1, 7], None),
    ):
        values = np.concatenate([[5.0, 6, 7], second])
        given = NodeField.of(table, np.arange(6), {"FX": values}, nature)  # type: ignore[arg-type]
        if expected is None:
            with pytest.raises(FieldError, match="ELIM made one") as caught:
                _ = given.components
            k = int(second[1] == 6) + 1
            told = {"values": k + 5.0, "values_2": second[k], "both": table.told(k)}
            assert told.items() <= caught.value.data.items()
        else:
            assert np.array_equal(given.components["FX"].values, expected)


def test_a_field_without_merged_nodes_is_itself() -> None:
    _, a, _ = two_lines()
    assert a.components["UX"] is a.components["UX"]
