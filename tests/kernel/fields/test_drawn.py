"""Arrows, deformed shapes, proper orthogonal modes: against small sums and decompositions."""

import numpy as np
import pytest
from scipy import sparse
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields import deformed, proper_orthogonal
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


@pytest.fixture
def table():
    made = NodeTable()
    made.add(np.array([[0, 0, 0], [4, 0, 1], [4, 3, 0], [0, 3, 2], [8, 1, 0.0]]))
    return made


@pytest.fixture
def cells(table):
    return CellBlock.make(table, "TRI3", np.array([[0, 1, 2], [1, 4, 2]]))


def test_arrows_stand_at_nodes_that_have_some_component(table):
    field = NodeField(table, {
        "FX": NodeValues(np.array([1, 3]), np.array([2.0, -1.0])),
        "FZ": NodeValues(np.array([3, 4]), np.array([5.0, 7.0])),
    })  # fmt: skip
    (part,) = deformed.arrows_at_nodes(field, ("FX", "FY", "FZ"), 0.3, 4).parts
    assert part.nodes.tolist() == [1, 3, 4]
    np.testing.assert_allclose(part.vectors, [[2, 0, 0], [-1, 0, 5], [0, 0, 7]])
    np.testing.assert_allclose(part.origins, table.coordinates[[1, 3, 4]])
    assert (part.scale, part.colour, part.name, part.heads) == (0.3, 4, "FX FZ", True)


def test_arrows_in_cells_are_means_in_their_middles(cells):
    values = {"A": np.array([[1.0, 3.0], [2.0, 6.0]]), "B": np.array([[5.0]])}
    field = CellField(
        (CellFieldBlock(cells, {"C": np.ones((2, 1))}), CellFieldBlock(cells, values))
    )
    (part,) = deformed.arrows_in_cells(field, ("B", "", "A"), 2.0, 3).parts
    np.testing.assert_allclose(part.vectors, [[5, 0, 2], [5, 0, 4]])
    np.testing.assert_allclose(part.origins, cells.coordinates.mean(axis=1))
    assert (part.name, part.nodes) == ("B A", None)
    with pytest.raises(FieldError, match="component"):
        deformed.arrows_in_cells(field, ("X", "Y", "Z"))


def symmetric(rng):
    a = rng.standard_normal((2, 3, 3))
    return a + np.swapaxes(a, 1, 2)


@pytest.mark.parametrize("given", ["SM", "polar", "principal"])
@pytest.mark.parametrize("chosen", [(), ("SI11", "SI33")])
def test_strokes_are_principal_values_along_their_directions(cells, given, chosen):
    T = symmetric(np.random.default_rng(3))
    values, ways = np.linalg.eigh(T)
    if given == "principal":
        parts = {}
        for i in range(3):  # in another order
            parts[f"SI{i + 1}{i + 1}"] = values[:, [i]]
            for a, axis in enumerate("XYZ"):
                parts[f"CO{axis}{i + 1}"] = ways[:, a, i, None]
    else:
        axes, names = (
            ("XYZ", "XX YY ZZ XY XZ YZ") if given == "SM" else ("RZT", "RR ZZ TT RZ RT ZT")
        )
        parts = {}
        for name in names.split():
            i, j = (axes.index(c) for c in name)
            parts["SM" + name] = T[:, i, j, None] + np.array([[-1.0, 1.0]])  # means count
    field = CellField((CellFieldBlock(cells, parts),))
    found = deformed.principal_strokes(field, 1.5, chosen, (7,)).parts
    names = chosen or ("SI11", "SI22", "SI33")
    assert [p.name for p in found] == list(names)
    colours = {"SI11": 7, names[1]: 4} | ({"SI33": 1} if not chosen else {})
    assert {p.name: p.colour for p in found} == colours
    for p in found:
        rank = 2 - ("SI11", "SI22", "SI33").index(p.name)
        for k in range(2):
            expected = values[k, rank] * ways[k, :, rank]
            assert np.abs(np.abs(p.vectors[k] @ expected)) == pytest.approx(expected @ expected)
            np.testing.assert_allclose(np.cross(p.vectors[k], expected), 0, atol=1e-9)
        assert not p.heads
    with pytest.raises(FieldError, match="principal"):
        deformed.principal_strokes(CellField((CellFieldBlock(cells, {"A": np.ones((2, 1))}),)))


@pytest.mark.parametrize("round_body", [False, True])
def test_deformed_shapes_move_by_their_own_axes(table, round_body):
    names = ("UR", "UZ") if round_body else ("UX", "UZ")
    parts = {n: NodeValues(np.array([1, 2]), v) for n, v in zip(names, ([0.1, 0.2], [0.3, -0.4]),
                                                                strict=True)}  # fmt: skip
    field = NodeField(table, {k: NodeValues(v.nodes, np.array(v.values)) for k, v in parts.items()})
    moved = deformed.displacements(field)
    expected = np.zeros((5, 3))
    expected[1:3, 0] = [0.1, 0.2]
    expected[1:3, 1 if round_body else 2] = [0.3, -0.4]
    np.testing.assert_allclose(moved, expected)
    mesh = Mesh.of(table, "TRI3", np.array([[0, 1, 2]]))
    largest = np.hypot(0.2, 0.4)
    wanted = 0.1 * 4.0 / largest  # 0.894
    assert deformed.automatic_scale(mesh, field) == pytest.approx(0.5)
    assert wanted == pytest.approx(0.894, abs=1e-3)
    still = NodeField(table, {"UX": NodeValues(np.array([1]), np.zeros(1))})
    assert deformed.automatic_scale(mesh, still) == 1.0
    assert deformed.automatic_scale(Mesh(table, ()), field) == 1.0


@together("x, found", [(1.0, 1.0), (4.99, 2.0), (0.05, 0.05), (730.0, 500.0)])
def test_scales_are_rounded_down_to_one_two_five(x, found):
    assert deformed.round_down(x) == pytest.approx(found)


@together("by_snapshots", [False, True])
@together("weighted", [False, True])
def test_modes_are_those_of_singular_values(by_snapshots, weighted):
    rng = np.random.default_rng(1)
    series = rng.standard_normal((4, 6)) @ np.diag([3, 1, 2, 0.5, 1, 1.5])
    series[3] = series[0] - 2 * series[1]  # one mode has no energy
    A = rng.standard_normal((6, 6))
    W = A @ A.T + 6 * np.eye(6) if weighted else np.eye(6)
    L = np.linalg.cholesky(W)
    _, s, rows = np.linalg.svd(series @ L, full_matrices=False)
    metric = sparse.csr_array(W) if weighted else None
    found, values = proper_orthogonal.modes(series, 9, by_snapshots, metric)
    np.testing.assert_allclose(values, s[:3] ** 2 / 4)
    expected = rows[:3] @ np.linalg.inv(L)
    peak = expected[np.arange(3), np.abs(expected).argmax(axis=1)]
    np.testing.assert_allclose(found, expected / peak[:, None], atol=1e-8)
    assert len(proper_orthogonal.modes(series, 2, by_snapshots, metric)[1]) == 2
    with pytest.raises(FieldError, match="energy"):
        proper_orthogonal.modes(0 * series, 2, by_snapshots, metric)


def test_fields_are_stacked_by_component_and_come_back(table):
    def field(k):
        return NodeField(table, {
            "UY": NodeValues(np.array([0, 2]), np.array([1.0, 2.0]) * k),
            "LX": NodeValues(np.array([4]), np.array([9.0])),
            "UX": NodeValues(np.array([1, 2, 3]), np.array([3.0, 4.0, 5.0]) + k),
        })  # fmt: skip

    fields = [field(1), field(2)]
    rows, places = proper_orthogonal.stacked(fields)
    np.testing.assert_allclose(rows, [[1, 2, 4, 5, 6], [2, 4, 5, 6, 7]])
    back = proper_orthogonal.as_fields(rows, places, fields[0])
    for one, made in zip(fields, back, strict=True):
        assert list(made.components) == ["UY", "UX"]
        for name, part in made.components.items():
            assert part.nodes.tolist() == one.components[name].nodes.tolist()
            np.testing.assert_allclose(part.values, one.components[name].values)
        assert made.nature == "DIFFUS"
    back[0].components["UY"].values[0] = 99.0
    assert rows[0, 0] == 1.0
    only, _ = proper_orthogonal.stacked(fields, ["UX", "XX"])
    np.testing.assert_allclose(only, rows[:, 2:])
    with pytest.raises(FieldError, match="decompose"):
        proper_orthogonal.stacked(fields, ["LX"])
