"""Arrows, tags, views and what stands at nodes, as numbers: no picture is drawn."""

import numpy as np
import pytest
from together import together

from ssilang.io.plots.annotations import arrow_ends
from ssilang.io.plots.bands import choose_levels
from ssilang.io.plots.labels import Annotation, Category, Tag, draw_tags, formatted
from ssilang.io.plots.palette import shade
from ssilang.io.plots.values import VON_MISES, _nodal, component_names, to_nodes
from ssilang.io.plots.view import Plane, plane_view, view_along
from ssilang.kernel.elements.catalog import ELEMENTS, support_rule
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.deformed import ArrowPart
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable

ORIGINS = np.array([[1.0, 2, 0], [0, 0, 7], [5, 6, 0]])
VECTORS = np.array([[3.0, 4, 0], [0.01, 0, 0], [0, 2, 1]])  # the second is too short to be seen
SEEN = [0, 2]


@together("heads", [True, False])
@together("scale", [2.0, -2.0, None])
@together("follows", [True, False])
def test_arrows_begin_and_end_where_they_say(heads, scale, follows):
    nodes = np.array([3, 1, 0])
    part = ArrowPart(ORIGINS, VECTORS, nodes, scale, heads=heads)
    positions = np.arange(12.0).reshape(4, 3) if follows else None
    tails, steps = arrow_ends(part, 10.0, positions)
    at = (ORIGINS if positions is None else positions[nodes])[SEEN]
    # an eighth of the size for the longest, rounded down: 0.12 x 10 / 5
    length = (0.2 if scale is None else abs(scale)) * VECTORS[SEEN]
    if not heads:
        np.testing.assert_allclose(tails + steps / 2, at)
        np.testing.assert_allclose(np.abs(steps), np.abs(length))
        return
    np.testing.assert_allclose(steps, length)
    np.testing.assert_allclose(tails + (steps if (scale or 1) < 0 else 0), at)


class Sheet:
    """What is written."""

    def annotate(self, text, point, place, **said):
        self.__dict__ |= {"text": text, "point": point, "place": place, **said}


@together("place, distance, to, sides", [
        ("NO", 0.5, (3.5, 7.5), ("right", "bottom")), ("SE", None, (4.4, 6.6), ("left", "top")),
        ("S", 1.0, (4.0, 6.0), ("center", "top")), ("E", 2.0, (6.0, 7.0), ("left", "center")),
        ("C", 1.0, (4.0, 7.0), ("center", "center")),
    ])  # fmt: skip
def test_a_tag_stands_beside_its_point(place, distance, to, sides):
    table, sheet = NodeTable(), Sheet()
    node = int(table.add([[4.0, 7.0, 9.0]])[0])
    tag = Tag(Point(table, node), "top", 2, place, distance, place != "S")
    draw_tags(sheet, plane_view(), Annotation(tags=(tag,)), 8.0)
    assert (sheet.text, sheet.point) == ("top", (4.0, 7.0))
    assert sheet.place == pytest.approx(to)
    assert ((sheet.ha, sheet.va), sheet.color) == (sides, shade(2))
    assert (sheet.arrowprops is None) == (place in "CS")


def test_annotations_join_in_order():
    first, other = Annotation((Category(1, "a"),)), Annotation((Category(2, "b"),), ())
    assert [c.text for c in first.joined(other).categories] == ["a", "b"]


@together(
    "descriptor, value, text",
    [
        ("I5", 2.6, "3"), ("(F8.2)", 3.14159, "3.14"), ("E12.3", 1234.56, "1.235E+03"),
        ("1PE10.2", 0.5, "5.00E-01"), ("G10.3", 1234.5, "1.23E+03"), (" d9.1 ", -20, "-2.0E+01"),
        ("F5", 2.7, "3"), ("G9", 0.26, "0.3"),
    ],
)  # fmt: skip
def test_numbers_by_their_descriptor(descriptor, value, text):
    assert formatted(descriptor, value) == text


def test_views_turn_what_is_upright_upwards():
    for direction, up in (((1, 2, 3), (0, 0, 1)), ((0, 0, -2), (0, 1, 0)), ((3, -1, 0), (0, 0, 1))):
        for given in (None, np.array([1.0, 1.0, 0.5])):
            axes = view_along(np.array(direction, float), given).axes
            np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
            assert np.linalg.det(axes) == pytest.approx(1.0)
            np.testing.assert_allclose(axes[2], direction / np.linalg.norm(direction))
            upright = np.array(up if given is None else given, float)
            assert axes[0] @ upright == pytest.approx(0.0, abs=1e-12)
            assert axes[1] @ upright > 0.0
    plane = Plane.through(*np.array([[0.0, 0, 2], [3, 0, 2], [0, 1, 2]]))
    assert plane.height(np.array([[5.0, 1, 5], [0, 0, 0]])).tolist() == [3.0, -2.0]


@together("value", [-2.0, 5.0])
def test_one_value_lies_in_the_middle_of_its_band(value):
    bounds = choose_levels(np.full(5, value)).bounds
    assert bounds == pytest.approx([value - abs(value) / 1e3, value + abs(value) / 1e3], rel=1e-12)


@together(
    "element, cells",
    [("TRI3", "TRI3"), ("QUA4", "QUA4"), ("QUA8", "QUA8"), ("TRI6", "TRI6"), ("CUB8", "CUB8"),
     ("TET4", "TET4"), ("PRI6", "PRI6")],
)  # fmt: skip
def test_values_of_a_linear_field_come_to_the_nodes(element, cells):
    points = support_rule(element, "STRESSES").points
    nodes = ELEMENTS[element].reference_cell.nodes
    slopes = np.arange(2.0, 2.0 + nodes.shape[1])
    spread = to_nodes(element, "STRESSES", cells)
    if len(points) > 1:
        found = spread @ (3 + points @ slopes)
        np.testing.assert_allclose(found, 3 + nodes @ slopes, atol=1e-12)


@together("names", ["SMXX SMYY SMZZ SMXY SMXZ SMYZ", "SMRR SMZZ SMTT SMRZ SMRT SMZT"])
def test_von_mises_is_that_of_the_tensor(names):
    table = NodeTable()
    nodes = table.add(np.eye(3))
    mesh = Mesh.of(table, "TRI3", nodes[None])
    s = np.array([[3.0, -1, 4], [1, 5, -9], [2, 6, 5], [3, 5, 8], [9, -7, 9], [3, 2, 3]])
    held = {n: s[i][None] for i, n in enumerate(names.split())}
    block = CellFieldBlock(mesh.blocks[0], held, "NOEUD", "TRI3")
    assert component_names(CellField((block,), "CONTRAINTES"))[0] == VON_MISES
    wanted = []
    for a, b, c, ab, ac, bc in s.T:
        tensor = np.array([[a, ab, ac], [ab, b, bc], [ac, bc, c]])
        deviator = tensor - np.trace(tensor) / 3 * np.eye(3)
        wanted.append(np.sqrt(1.5 * (deviator**2).sum()))
    np.testing.assert_allclose(_nodal(block, VON_MISES), [wanted])
