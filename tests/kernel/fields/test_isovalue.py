"""ISOV's cuts: level sets of linear fields, degenerate places; fields older than merged nodes."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.isovalue import isovalue
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.queries.measure import total_measure


def field_on(mesh: Mesh, values: np.ndarray) -> CellField:
    """A field given by its value at every node of the table."""
    blocks = (CellFieldBlock(b, {"SCAL": values[b.connectivity]}) for b in mesh.blocks)
    return CellField(tuple(blocks))


def kinds(mesh: Mesh) -> dict[str, int]:
    return {b.cell_type: len(b) for b in mesh.blocks}


def two_tetrahedra() -> tuple[Mesh, NodeTable]:
    table = NodeTable()
    table.add(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.0]]))
    return Mesh.of(table, "TET4", np.array([[3, 1, 2, 0], [4, 1, 2, 3]])), table


def bricks(n: int) -> tuple[Mesh, NodeTable]:
    table = NodeTable()
    grid = np.stack(np.meshgrid(*[np.linspace(0, 1, n + 1)] * 3, indexing="ij"), -1)
    ids = table.add(grid.reshape(-1, 3)).reshape(n + 1, n + 1, n + 1)
    low, high = slice(None, -1), slice(1, None)
    ring = [(low, low), (high, low), (high, high), (low, high)]
    corners = [ids[(*xy, z)].ravel() for z in (low, high) for xy in ring]
    return Mesh.of(table, "CUB8", np.stack(corners, axis=1)), table


@together("level", [0.1, 0.5, 1.0, 1.7, 2.6])
def test_plane_through_bricks_has_its_area_and_volume(level: float) -> None:
    mesh, table = bricks(3)
    field = field_on(mesh, table.coordinates.sum(axis=1))
    below, above = isovalue(field, level, -1), isovalue(field, level, 1)
    # corner tetrahedra of x + y + z <= level, by inclusion and exclusion at the cube's corners
    corners = [(max(level - k, 0.0), s) for k, s in ((0, 1), (1, -3), (2, 3))]
    volume = sum(s * h**3 for h, s in corners) / 6
    area = sum(s * h**2 for h, s in corners) * np.sqrt(3) / 2
    assert total_measure(below) == pytest.approx(volume, abs=1e-14)
    assert total_measure(above) == pytest.approx(1 - volume, abs=1e-14)
    assert total_measure(isovalue(field, level)) == pytest.approx(area, abs=1e-14)


def test_neighbours_share_the_nodes_of_the_cut() -> None:
    mesh, table = bricks(2)
    cut = isovalue(field_on(mesh, table.coordinates @ [1.0, 0.3, 0.2]), 0.6)
    places = table.coordinates[cut.sorted_node_ids].round(12)
    assert len(np.unique(places, axis=0)) == len(places)


@together(
    "signs, equal, below, above",
    [
        ([0, -1, -1, -1, 0], {"POI1": 2}, {"TET4": 2}, {"POI1": 2}),
        ([0, 0, 1, 1, 0], {"SEG2": 2}, {"SEG2": 2}, {"TET4": 2}),
        ([0, 0, 0, -1, 0], {"TRI3": 2}, {"TET4": 2}, {"TRI3": 2}),
        ([1, 0, 0, 0, -1], {"TRI3": 1}, {"TET4": 1}, {"TET4": 1}),
        ([0, 0, 0, 0, 0], {"TET4": 2}, {"TET4": 2}, {"TET4": 2}),
        ([1, 1, 1, 1, 1], {}, {}, {"TET4": 2}),
    ],
)
def test_what_touches_the_value_gives_what_touches(
    signs: list[int], equal: dict[str, int], below: dict[str, int], above: dict[str, int]
) -> None:
    mesh, _ = two_tetrahedra()
    field = field_on(mesh, np.array(signs) + 5 / 3)
    assert kinds(isovalue(field, 5 / 3)) == equal
    assert kinds(isovalue(field, 5 / 3, -1)) == below
    assert kinds(isovalue(field, 5 / 3, 1)) == above


def test_existing_nodes_on_the_value_are_kept() -> None:
    table = NodeTable()
    line = Mesh.of(table, "SEG2", np.column_stack([np.arange(3), np.arange(1, 4)]))
    table.add(np.linspace(0, 1, 4)[:, None])
    for size in (1.0, 1e-20):
        field = field_on(line, size * table.coordinates[:, 0])
        assert isovalue(field, size / 3).node_ids.tolist() == [1]
    (made,) = isovalue(field, size * (1 / 3 - 1e-10)).node_ids
    assert made > 3


def test_pieces_have_the_colour_of_their_cell_and_new_nodes_the_size_between() -> None:
    """Two cells of each kind side by side along x, each with a colour of its own."""
    table = NodeTable()
    grid = np.array([[x, y, z] for x in (0.0, 1, 2) for y in (0.0, 1) for z in (0.0, 1)])
    ids = table.add(grid, 1.0 + grid[:, 0]).reshape(3, 2, 2)
    low, high = ids[:-1], ids[1:]
    bricks = np.stack([x[:, i, j] for j in (0, 1) for x, i in ((low, 0), (high, 0), (high, 1),
                                                               (low, 1))], axis=1)  # fmt: skip
    kinds = {"SEG2": bricks[:, :2], "TRI3": bricks[:, :3], "QUA4": bricks[:, :4], "CUB8": bricks}
    for kind, cells in kinds.items():
        mesh = Mesh.of(table, kind, cells, np.array([3, 5], np.int8))
        field = field_on(mesh, table.coordinates[:, 0] + 0.25 * table.coordinates[:, 1])
        for side, level in ((0, 0.5), (0, 1.7), (1, 0.5), (-1, 1.5)):
            found = isovalue(field, level, side)
            for block in found.blocks:
                middle = block.coordinates.mean(axis=1)[:, 0]
                assert block.colours.tolist() == np.where(middle < 1.0, 3, 5).tolist(), kind
            at = table.coordinates[found.sorted_node_ids]
            np.testing.assert_allclose(table.density[found.sorted_node_ids], 1.0 + at[:, 0])


def test_wrong_fields_are_refused() -> None:
    with pytest.raises(MeshError, match="empty"):
        isovalue(CellField(()), 0.0)
    mesh, _ = two_tetrahedra()
    block = mesh.blocks[0]
    ones = np.ones((2, 4))
    with pytest.raises(MeshError, match="components A B"):
        isovalue(CellField((CellFieldBlock(block, {"A": ones, "B": ones}),)), 0.0)
    with pytest.raises(MeshError, match="at nodes"):
        isovalue(CellField((CellFieldBlock(block, {"A": ones}, "STRESSES"),)), 0.0)


def two_lines(nature: str = "") -> tuple[NodeTable, NodeField, NodeField]:
    table = NodeTable()
    first, second = table.add(np.zeros((3, 2))), table.add(np.zeros((3, 2)))
    a = NodeField.of(table, first, {"UX": np.array([1.0, 2, 3])}, nature)  # type: ignore[arg-type]
    b = NodeField.of(table, second, {"UX": np.array([10.0, 20, 30])}, nature)  # type: ignore[arg-type]
    table.merge(first, second)
    return table, a, b


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
