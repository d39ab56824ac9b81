"""Forces of a free field on a body of springs, by dense algebra."""

import numpy as np
import pytest
from references.assembled import Bench
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.assembly import assemble, field_to_vector
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.waves.free_field_forces import (
    PLASTIC,
    Ground,
    Motion,
    along_columns,
    edge_forces,
    elements_at,
    elements_of,
    layer_forces,
    load_of,
    yielded,
    yielding_at,
    yielding_outside,
)
from ssilang.kernel.waves.resolution import highest_frequency, longest_sides
from tests.kernel.elements.samples import cell_zone

N = 7


@pytest.fixture
def body():
    """A row of masses on springs of two unknowns; inside, a layer of two cells, and beyond."""
    b = Bench()
    b.n = np.array([b.node(float(i), 0.3 * i * i) for i in range(N)])
    rng = np.random.default_rng(3)
    for i in range(N - 1):
        for u in ("UX", "UY"):
            b.spring(rng.uniform(1e3, 4e3), b.n[i], b.n[i + 1], u)
    for n in b.n:
        b.mass(rng.uniform(1, 3), n)
        b.dashpot(rng.uniform(5, 9), n)
    ground = Ground(b.stiffness, b.mass_matrix, b.damping)
    numbering = ground.numbering
    t = np.linspace(0.0, 0.5, 6)
    u, v, a = rng.standard_normal((3, numbering.size, len(t)))
    return b, ground, Motion(t, u, v, a)


def cells(b, pairs):
    return Mesh.of(b.table, "SEG2", b.n[np.array(pairs)])


def dense(b, ground, pairs, alone):
    """K, M, C of the springs between some nodes, masses and dashpots of some nodes."""
    numbering = ground.numbering
    kept = [sorted(b.n[list(p)].tolist()) for p in pairs]

    def part(matrix):
        blocks = tuple(
            x for x in matrix.blocks
            if (sorted(x.nodes[0].tolist()) in kept if x.nodes.shape[1] == 2 else
                int(x.nodes[0, 0]) in b.n[list(alone)])
        )  # fmt: skip
        return assemble(Matrix(matrix.table, blocks, kind=matrix.kind), numbering).toarray()

    return part(ground.stiffness), part(ground.mass), part(ground.damping)


def test_forces_of_a_layer_are_those_that_each_side_lacks_of_the_other(body):
    b, ground, motion = body
    layer = elements_of(ground, cells(b, [[3, 4], [2, 3]]))
    numbering = ground.numbering
    K, M, _ = dense(b, ground, [(2, 3), (3, 4)], [])
    inside = Mesh.of(b.table, "SEG2", b.n[[[0, 1], [1, 2]]])
    found = layer_forces(layer, inside, motion)
    inner = np.isin(numbering.nodes, b.n[[2]])
    outer = np.isin(numbering.nodes, b.n[[3, 4]])
    expected = np.zeros_like(found)
    u = motion.displacement
    expected[outer] = (K @ (u * inner[:, None]))[outer]
    expected[inner] = -(K @ (u * outer[:, None]))[inner]
    np.testing.assert_allclose(found, expected)
    assert not M.any()
    for bad in (cells(b, [[5, 6]]), cells(b, [[0, 1]])):
        with pytest.raises(FieldError, match="layer"):
            layer_forces(elements_of(ground, bad), inside, motion)
    with pytest.raises(FieldError, match="element"):
        elements_of(ground, cells(b, [[0, 2]]))
    motion.velocity[numbering.index_of(int(b.n[3]), "UY"), 2] = np.nan
    with pytest.raises(FieldError, match="UY"):
        layer_forces(layer, inside, motion)
    motion.velocity[:] = 0.0
    motion.displacement[numbering.index_of(int(b.n[6]), "UY")] = np.nan
    layer_forces(layer, inside, motion)  # nobody asks for it there


def test_forces_at_edges_hold_their_elements_and_feed_the_dampers(body):
    b, ground, motion = body
    edge = Mesh.of(b.table, "POI1", b.n[[[5]]])
    row = elements_at(ground, edge)
    K, M, C = dense(b, ground, [(4, 5), (5, 6)], [5])
    extra = Bench()
    extra.table = b.table
    extra.dashpot(77.0, int(b.n[5]), "UX")
    extra.dashpot(55.0, int(b.n[2]), "UY")
    dampers = extra.damping
    found = edge_forces(row, edge, dampers, motion)
    touched = (np.abs(K) + np.abs(M) + np.abs(C)).sum(axis=0) > 0
    u, v, a = (x * touched[:, None] for x in
               (motion.displacement, motion.velocity, motion.acceleration))  # fmt: skip
    numbering = ground.numbering
    at = np.isin(numbering.nodes, b.n[[5]])
    expected = (M @ a + C @ v + K @ u) * at[:, None]
    expected += assemble(dampers, numbering).toarray() @ motion.velocity
    np.testing.assert_allclose(found, expected)
    assert set(numbering.nodes[row.touched].tolist()) == set(b.n[[4, 5, 6]].tolist())
    motion.velocity[numbering.index_of(int(b.n[2]), "UY")] = np.nan
    with pytest.raises(FieldError, match="UY"):
        edge_forces(row, edge, dampers, motion)


def test_histories_become_few_fields_times_curves(body):
    b, ground, _ = body
    numbering = ground.numbering
    rng = np.random.default_rng(1)
    forces = rng.standard_normal((numbering.size, 3)) @ rng.standard_normal((3, 9))
    forces[4:7] = 0.0
    t = np.linspace(0, 2, 9)
    share, rest = elements_at(ground, Mesh.of(b.table, "POI1", b.n[:2, None])), 0.0 * forces
    moved = np.arange(numbering.size) == 3  # where alone the free field has a velocity
    motion = Motion(t, rest, np.where(moved[:, None], 1.0, rest), rest)
    load = load_of(share, ground.damping, motion, forces)
    assert len(load.parts) == 3
    back = sum(
        np.outer(field_to_vector(p.space, numbering), p.time.parts[0].ordinates) for p in load.parts
    )
    np.testing.assert_allclose(back, forces, atol=1e-12)
    for p in load.parts:
        np.testing.assert_array_equal(p.time.parts[0].abscissas, t)
        assert set(p.space.node_ids) <= set(numbering.nodes[np.abs(forces).sum(axis=1) > 0])
    assert load_of(share, None, motion, 0 * forces).parts == ()
    masses, dampers = (field_to_vector(f, numbering, dual=False) for f in load.parts[0].beside)
    np.testing.assert_array_equal(masses, share.mass.diagonal())
    whole = assemble(ground.damping, numbering).diagonal()
    np.testing.assert_array_equal(dampers, np.where(moved, whole, 0.0))


def test_heights_beyond_a_column_are_refused():
    column = np.array([1.0, 4.0, 2.0])
    for heights, match in (([0.5], "0.5"), ([2.0, 4.5], "4.5")):
        with pytest.raises(FieldError, match=match):
            along_columns(np.array(heights), column)
    with pytest.raises(FieldError, match="column"):
        along_columns(np.array([1.0]), column[:1])


def test_the_highest_frequency_is_that_of_the_velocity_that_counts():
    t = 0.01 * np.arange(400)
    slow, fast = (np.sin(2 * np.pi * f * t) * 2 * np.pi * f for f in (2.5, 12.5))
    both = 1e-5 * np.stack([slow, slow + 0.1 * fast])
    assert highest_frequency(t, both) == pytest.approx(12.5, rel=2e-2)
    assert highest_frequency(t, 0 * both) == 0.0


@together("element, longest", [("QUA4", 2.0), ("CUB8", 3.0), ("TRI3", 5**0.5)])
def test_the_longest_side_of_an_oblong_cell_and_no_diagonal(element, longest):
    zone = cell_zone(element, Mode.THREE_DIMENSIONAL if element == "CUB8" else Mode.PLANE_STRAIN)
    nodes, whole = REFERENCE_CELLS[element].nodes, 1.0 if element == "TRI3" else 2.0
    x = zone.cells.nodes.coordinates
    x[:, : nodes.shape[1]] = nodes * np.array([1.0, 2.0, 3.0])[: nodes.shape[1]] / whole
    np.testing.assert_allclose(longest_sides(zone), longest)


def test_cells_that_yield_are_told_where_they_touch_an_edge_or_lie_beyond_the_ground():
    """Of two zones of joints of which one is linear, beside a plastic one: first place, count."""
    b = Bench()
    n = [b.node(float(i), 0.0) for i in range(9)]
    for law, k in (("JOINT_SDM", 0), ("ELASTIQUE", 2)):
        b.joint("SEG2", [[n[k], n[k + 1]], [n[k + 1], n[k + 2]]], "JOI1", law, KN=1.0, KS=1.0)
    cells = CellBlock.make(b.table, "SEG2", np.array([n[4:6], n[5:7], n[6:8]]))
    b.zones.append(Zone(cells, "MECANIQUE", ("ELASTIQUE", "PLASTIQUE", "PARFAIT"), "BARR", b.mode))
    edge = Mesh.of(b.table, "POI1", np.array([[n[5]], [n[3]], [n[0]]]))
    found = yielding_at(b.model, edge)
    assert (found.count, found.behaviour) == (3, ("ELASTIQUE", "JOINT_SDM"))
    assert found.place[0] == 0.5
    assert yielding_at(b.model, Mesh.of(b.table, "POI1", np.array([[n[3]], [n[8]]]))) is None
    inside = Mesh.of(b.table, "SEG2", np.array([[n[1], n[0]], n[4:6], n[2:4], n[6:8]]))
    found = yielding_outside(b.model, inside)
    assert (found.count, found.place[0]) == (2, 1.5)


def test_cells_that_are_kept_keep_their_own_matrices():
    table, random = NodeTable(), np.random.default_rng(6)
    nodes = table.add(random.normal(size=(4, 2)))[np.array([[0, 1], [1, 2], [2, 3]])]
    values, names = random.normal(size=(3, 2, 2)), (("UX",) * 2, ("FX",) * 2)
    block = ElementMatrices(table, nodes, np.arange(2), *names, values)
    kept = block.some(np.array([False, True, True]))
    np.testing.assert_array_equal(kept.raw_nodes, nodes[1:])
    np.testing.assert_array_equal(kept.values, values[1:])


@together("axis, wanted", [(None, (0.2, 1.5, 3)), (0, (0.3, 2.5, 3))])
def test_cells_that_have_yielded_count_where_the_nodes_take_their_motion(axis, wanted):
    """Those of these nodes alone, or those at their heights, whatever nodes they have."""
    b = Bench()
    n = [b.node(float(i), 0.0) for i in range(5)]
    cells = CellBlock.make(b.table, "SEG2", np.array([n[:2], n[1:3], n[2:4], n[3:]]))
    strain = np.array([[0.1, 0.0], [0.0, 0.2], [0.3, 0.0], [0.9, 0.9]])
    others, less = (CellBlock.make(b.table, "SEG2", np.array([n[k : k + 2]])) for k in (0, 1))
    blocks = (
        CellFieldBlock(others, {"VAIR": np.ones((1, 2))}, "STRESSES", "BARR"),
        CellFieldBlock(cells, {PLASTIC: strain}, "STRESSES", "BARR"),
        CellFieldBlock(less, {PLASTIC: np.full((1, 2), 0.05)}, "STRESSES", "BARR"),
    )
    nodes = np.array(n[:3]) if axis is None else np.array([n[1], n[3]])
    found = yielded(CellField(blocks), nodes, axis)
    assert (found.strain, found.place[0], found.count) == pytest.approx(wanted)
    nothing = CellField((CellFieldBlock(cells, {PLASTIC: 0.0 * strain}, "STRESSES", "BARR"),))
    assert yielded(nothing, nodes, axis) is None
