"""Supports beside their body, bodies apart, cells twice, hinges, free motions: what is told."""

from dataclasses import replace

import numpy as np
import pytest
from together import together

from ssilang.kernel.elements import families
from ssilang.kernel.interface import family as _joints  # noqa: F401
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.relations import Term, relation_rows
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.statics.doubled import (
    bodies_apart,
    doubled_supports,
    repeated_blocks,
    repeated_cells,
)
from ssilang.kernel.statics.linear_motion import named_motions, rigid_motions, tied
from ssilang.kernel.statics.swapped_joints import hinges, swapped_joints
from tests.kernel.elements.samples import ELASTIC, material

SOLID = {"YOUN": 3e7, "NU": 0.2}
BEAM = SOLID | {"SECT": 0.1, "INRY": 2e-3, "INRZ": 3e-3, "TORS": 1e-3}
SHELL = SOLID | {"EPAI": 0.1}


class Place:
    """A table of nodes, and matrices of cells on it."""

    def __init__(self, *points, mode=Mode.THREE_DIMENSIONAL):
        self.table, self.mode = NodeTable(), mode
        self.ids = self.table.add(np.array(points, float))
        self.blocks, self.relations, self.zones = [], [], []

    def cells(self, kind, cells, element, **given):
        block = CellBlock.make(self.table, kind, self.ids[np.array(cells)])
        zone = Zone(block, "MECANIQUE", ELASTIC, element, self.mode)
        self.zones.append(zone)
        self.blocks.append(families.stiffness(zone, material(zone, **given)))
        return self

    def hold(self, *terms):
        rows = [Term(c, u, self.ids[[n]]) for c, u, n in terms]
        self.relations.append(relation_rows(self.table, rows, 0))
        return self

    @property
    def matrix(self):
        return Matrix(self.table, tuple(self.blocks), tuple(self.relations))


BOX = [[x, y, z] for z in (0, 1.0) for x, y in ((0, 0), (2.0, 0), (2.0, 1), (0, 1))]


def on_box(*more):
    """A brick and nodes."""
    return Place(*BOX, *more).cells("CUB8", [range(8)], "CUB8", **SOLID)


def test_held_nodes_beside_those_of_the_body_are_found_unless_they_are_meant():
    place = on_box([2, 0, 0], [0, 1, 1], [5, 5, 5])
    place.hold((1.0, "UX", 8)).hold((1.0, "UY", 9)).hold((1.0, "UZ", 10)).hold((1.0, "UX", 3))
    found = doubled_supports(place.matrix)
    pairs = set(zip(found.held.tolist(), found.body.tolist(), strict=True))
    assert pairs == {(place.ids[8], place.ids[1]), (place.ids[9], place.ids[7])}
    assert doubled_supports(place.matrix, place.ids[[8]]).held.tolist() == [place.ids[9]]
    place.hold((1.0, "UX", 9), (-1.0, "UX", 2))
    assert doubled_supports(place.matrix).held.tolist() == [place.ids[8]]
    assert doubled_supports(on_box().matrix) is None
    assert doubled_supports(Place(*BOX).hold((1.0, "UX", 0)).matrix) is None


def test_bodies_at_one_place_with_nothing_between_are_found():
    lid = [[x, y, z + 1] for x, y, z in BOX]
    place = on_box(*lid).cells("CUB8", [range(8, 16)], "CUB8", **SOLID)
    found = bodies_apart(place.matrix)
    at = place.table.coordinates[found]
    assert len(found) == 4
    np.testing.assert_allclose(at[:, 2], 1.0)
    joint = Zone(CellBlock.make(place.table, "SEG2", place.ids[[[4, 8]]]), "MECANIQUE", ELASTIC,
                 "JOI1", Mode.THREE_DIMENSIONAL)  # fmt: skip
    assert not len(bodies_apart(place.matrix, [joint]))
    place.hold((1.0, "UZ", 5), (-1.0, "UZ", 9))
    assert not len(bodies_apart(place.matrix))
    assert not len(bodies_apart(on_box().matrix))


@together("apart", [0.0, 0.03])
@together("points", [False, True])
def test_joints_with_their_bodies_the_wrong_way_round(points, apart):
    """Squares above each other; the last joint of the zone has no body beside it."""
    place = Place([0, -1], [1, -1], [0, 0], [1, 0], [0, -apart], [1, -apart], [0, 1], [1, 1],
                  [3, 0], [3, -apart], mode=Mode.PLANE_STRAIN)  # fmt: skip
    place.cells("QUA4", [[0, 1, 3, 2], [4, 5, 7, 6]], "QUA4", **SOLID)

    def found(cells, way):
        kind, element = ("SEG2", "JOI1") if points else ("RAC2", "JOI2")
        block = CellBlock.make(place.table, kind, place.ids[cells])
        zone = Zone(block, "MECANIQUE", ("ELASTIQUE", "JOINT_SDM"), element, place.mode)
        field = material(zone, KN=1e9, KS=1e8, **({"V1X": 0, "V1Y": way} if points else {}))
        return swapped_joints(place.matrix, Model((zone,)), field)

    up = [[2, 4], [8, 9], [3, 5]] if points else [[4, 5, 2, 3], [5, 9, 3, 8]]
    down = up if points else [c[2:] + c[:2] for c in up]
    if not apart:
        assert found(up, 1.0) == ()
    (one,) = found(down, -1.0)
    assert (one.points, one.overlap) == (points, pytest.approx(apart))
    np.testing.assert_allclose(one.middle, [4 / 3, -apart, 0] if points else [5 / 4, 0, 0])
    assert found(down[1:2], -1.0) == ()


def test_cells_and_blocks_that_are_there_twice():
    place = on_box([4, 0, 0], [4, 1, 0], [4, 1, 1], [4, 0, 1])
    place.cells("CUB8", [[1, 8, 9, 2, 5, 11, 10, 6]], "CUB8", **SOLID)
    assert not len(repeated_cells(place.matrix))
    place.cells("CUB8", [[8, 9, 2, 1, 11, 10, 6, 5]], "CUB8", **SOLID)
    assert repeated_cells(place.matrix).tolist() == [place.ids[8]]
    stiffer = on_box().cells("CUB8", [range(8)], "CUB8", **SOLID | {"YOUN": 6e7})
    assert not len(repeated_cells(stiffer.matrix))  # two matters in one place are meant
    heavy = replace(
        stiffer.blocks[0], zone=None, kind="MASSE", values=np.diag([1.0, 0, 0] * 8)[None]
    )
    across = replace(heavy, values=np.diag([0.0, 1, 0] * 8)[None])
    assert not len(repeated_cells(replace(stiffer.matrix, blocks=(heavy, across))))
    assert len(repeated_cells(replace(stiffer.matrix, blocks=(heavy, replace(heavy)))))
    assert repeated_blocks(place.matrix) == []
    place.blocks.append(place.blocks[0])
    assert repeated_blocks(place.matrix) == [place.blocks[0]]


MAST = [[2, 1, 3], [2, 1, 5], [3, 2, 1]]


def test_a_beam_on_one_node_of_a_solid_turns_there_unless_it_is_held():
    def mast(*cells):
        return on_box(*MAST).cells("SEG2", cells, "POUT", **BEAM)

    place = mast([6, 8], [8, 9])
    found = hinges(place.matrix)
    assert (found.nodes.tolist(), found.shell) == ([place.ids[6]], False)
    assert set(found.rotations) == {"RX", "RY", "RZ"}
    place.hold((1.0, "RX", 6)).hold((2.0, "RZ", 6), (1.0, "UX", 5))
    assert hinges(place.matrix).rotations == ("RY",)
    place.hold((1.0, "RY", 6))
    assert hinges(place.matrix) is None
    assert hinges(mast([6, 8], [6, 10]).matrix) is None  # two beams hold each other
    assert hinges(mast([5, 6], [6, 8]).matrix) is None  # one lies on the solid
    assert hinges(mast([8, 9]).matrix) is None
    assert hinges(on_box().matrix) is None
    joints = Zone(CellBlock.make(place.table, "SEG2", place.ids[[[6, 10]]]), "MECANIQUE",
                  ELASTIC, "JOI1", Mode.THREE_DIMENSIONAL)  # fmt: skip
    assert hinges(mast([6, 8]).matrix, [joints]) is None
    wall = on_box(*MAST).cells("TRI3", [[6, 8, 10], [8, 9, 10]], "DKT", **SHELL)
    found = hinges(wall.matrix)
    assert (found.nodes.tolist(), found.shell) == ([wall.ids[6]], True)


def said(sentences):
    return [(s.code.rpartition(".")[2], s.data) for s in sentences]


def test_free_motions_are_named_by_their_body_axis_and_point():
    """A beam in space that turns about a line through a point, a second one that slides."""
    place = Place([1, 2, 0], [3, 2, 0], [4, 2, 0], [10, 0, 0], [10, 3, 0])
    place.cells("SEG2", [[0, 1], [1, 2]], "POUT", **BEAM).cells("SEG2", [[3, 4]], "POUT", **BEAM)
    numbering = numbering_of(place.matrix)
    centre = np.array([3.5, 2.0, 0.0])
    motions = rigid_motions(numbering, centre)
    x = numbering.table.coordinates[numbering.nodes]
    for turn in range(3):
        w = np.eye(3)[turn]
        for name, axis in (("UX", 0), ("UY", 1), ("UZ", 2)):
            at = numbering.where(name)
            np.testing.assert_allclose(motions[at, 3 + turn], np.cross(w, x[at] - centre)[:, axis])
            np.testing.assert_allclose(motions[at, turn], float(axis == turn))
        at = numbering.where("R" + "XYZ"[turn])
        np.testing.assert_allclose(motions[at, 3 + turn], 1.0)
    bodies = tied(numbering, assemble(place.matrix, numbering))
    first = bodies == bodies[numbering.index_of(int(place.ids[0]), "UX")]
    assert first.sum() == 18
    assert (bodies == bodies[numbering.index_of(int(place.ids[4]), "RZ")]).sum() == 12
    free = np.column_stack([motions[:, 5] * first, motions[:, 1] * ~first])
    parts = said(named_motions(numbering, free, bodies))
    assert [code for code, _ in parts] == ["motions-of-body"] * 2
    by_nodes = {data["n_nodes"]: data for _, data in parts}
    np.testing.assert_allclose(by_nodes[2]["place"], [10, 1.5, 0])
    assert said(by_nodes[2]["motions"]) == [("translation", {"axis": "Y"})]
    ((code, data),) = said(by_nodes[3]["motions"])
    assert (code, data["axis"]) == ("rotation-around", "Z")
    np.testing.assert_allclose(data["place"], centre, atol=1e-9)
    whole = said(named_motions(numbering, rigid_motions(numbering)[:, [0, 4]]))
    assert whole[0][0] == "motions"
    assert said(whole[0][1]["motions"]) == [
        ("translation", {"axis": "X"}),
        ("rotation", {"axis": "Y"}),
    ]
