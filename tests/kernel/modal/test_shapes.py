"""Shapes of a body: projections, conditions and matrices on them, against dense products."""

import numpy as np
import pytest
from references.assembled import Bench

from ssilang.kernel.base.errors import KernelError, MaterialError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.assembly import assemble, constraint_matrix, numbering_of
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.modal.basis import (
    combined,
    projected_matrix,
    projected_relations,
    reduced_problem,
    static_complement,
    work,
)
from ssilang.kernel.modal.shape_models import is_shape, shape_matrix, shape_points


@pytest.fixture
def body():
    """Four masses on unlike springs; two conditions, of which no shape touches the second."""
    b = Bench()
    b.n = [b.node(float(i), 0.0) for i in range(4)]
    for i, k in enumerate((3.0, 5.0, 2.0)):
        b.spring(k, b.n[i], b.n[i + 1])
        b.mass(1.0 + i, b.n[i])
    b.spring(7.0, b.n[0], unknown="UX")
    b.tie = b.relate([(2.0, "UY", b.n[1]), (-1.0, "UX", b.n[0])], sense=-1)
    b.idle = b.relate([(1.0, "UX", b.n[3])])
    b.shapes = [
        b.field((b.n[0], "UX", 1.0), (b.n[1], "UY", -2.0), (b.n[2], "UY", 0.5)),
        b.field((b.n[3], "UY", 3.0), (b.n[0], "UY", 1.0)),
    ]
    b.marks = np.array([b.node(0.0, 9.0), b.node(1.0, 9.0)])
    return b


def columns(b, numbering):
    X = np.zeros((numbering.size, 2))
    for j, shape in enumerate(b.shapes):
        for name, part in shape.components.items():
            for node, value in zip(part.nodes, part.values, strict=True):
                X[numbering.index_of(int(node), name), j] = value
    return X


def test_matrices_and_conditions_are_projected(body):
    K = body.stiffness
    numbering = numbering_of(K)
    X = columns(body, numbering)
    made = projected_matrix(K, body.shapes, body.marks, ("ALFA", "BETA"), ("FALF", "FBET"))
    (block,) = made.blocks
    expected = X.T @ assemble(K, numbering).toarray() @ X
    np.testing.assert_allclose(block.values[0], expected)
    assert (block.unknowns, block.duals) == (("ALFA", "BETA"), ("FALF", "FBET"))
    assert block.nodes.tolist() == [body.marks.tolist()]
    rows = constraint_matrix(projected_relations(K, body.shapes, body.marks, ("ALFA", "BETA")))
    np.testing.assert_allclose(rows.C.toarray(), [[2.0 * -2.0 - 1.0]])
    assert rows.multipliers.tolist() == [body.tie]
    assert rows.sense.tolist() == [-1]


@pytest.mark.parametrize("size", [1e-13, 1e6])
def test_conditions_are_projected_in_whatever_size_the_shapes_have(body, size):
    shapes = [combined([size], [s]) for s in body.shapes]
    found = constraint_matrix(projected_relations(body.stiffness, shapes, body.marks, ("A", "B")))
    np.testing.assert_allclose(found.C.toarray(), [[-5.0 * size]])


def test_work_and_combinations_take_what_both_have(body):
    force = body.field((body.n[0], "FX", 5.0), (body.n[1], "FY", 3.0), (body.n[3], "FY", 2.0))
    one, two = body.shapes
    assert work(force, one) == 5.0 - 6.0
    assert work(one, one, same_names=True) == 1 + 4 + 0.25
    with_lx = NodeField(one.table, dict(one.components) | {
        "LX": NodeValues(np.array([1]), np.array([9.0]))})  # fmt: skip
    assert work(with_lx, with_lx, same_names=True) == work(one, one, same_names=True)
    made = combined([2.0, -1.0], [one, two])
    np.testing.assert_allclose(made.values_at("UY", np.array(body.n)), [-1, -4, 1, -3])
    np.testing.assert_allclose(made.values_at("UX", np.array(body.n[:1])), [2])
    left = static_complement(one, [two, one], [6.0, 2.0], [3.0, 8.0])
    np.testing.assert_allclose(left.values_at("UY", np.array(body.n)), [-2, -1.5, 0.375, -6])


def test_reduced_matrices_are_those_of_the_motions_left(body):
    body.dashpot(4.0, body.n[1])
    C = body.damping
    p = reduced_problem(body.stiffness, body.mass_matrix, C)
    T = p.T.toarray()
    rows = constraint_matrix(body.stiffness, p.numbering)
    np.testing.assert_allclose(rows.C @ T, 0.0, atol=1e-12)
    assert p.size == p.numbering.size - 2
    assert np.linalg.matrix_rank(T) == p.size
    for made, whole in ((p.K, body.stiffness), (p.M, body.mass_matrix), (p.C, C)):
        np.testing.assert_allclose(made.toarray(), T.T @ assemble(whole, p.numbering).toarray() @ T)
    kept = np.array([2, 0, 3])
    part = p.restricted(kept)
    for name in ("K", "M", "C"):
        whole = getattr(p, name).toarray()[np.ix_(kept, kept)]
        np.testing.assert_allclose(getattr(part, name).toarray(), whole)
    np.testing.assert_allclose(part.T.toarray(), T[:, kept])
    u = T @ np.arange(1.0, p.size + 1)
    out = p.mass @ u * 3.0 - p.stiffness @ u
    lam = p.reactions(u, 3.0)
    rest = out - rows.C.T @ lam
    own = ~np.isin(np.arange(len(u)), np.flatnonzero(np.abs(rows.C.toarray()).sum(axis=0)))
    np.testing.assert_allclose(rest[own], out[own])
    at = p.numbering.index_of(body.n[3], "UX")
    assert lam[rows.multipliers.tolist().index(body.idle)] == pytest.approx(out[at])
    with pytest.raises(KernelError, match="empty"):
        reduced_problem(Bench().stiffness, Bench().mass_matrix)


def shape_zone(b, node, kind, **given):
    block = CellBlock.make(b.table, "POI1", np.array([[node]]))
    zone = Zone(block, "MECANIQUE", ("ELASTIQUE", "MODAL"), kind, Mode.PLANE_STRAIN)
    values = {k: np.array([[v]], object if isinstance(v, NodeField) else float)
              for k, v in given.items()}  # fmt: skip
    return zone, CellFieldBlock(block, values, "RIGIDITE", kind)


def test_modes_and_static_shapes_make_one_matrix_with_their_couplings(body):
    """Two modes, two static shapes: products by K and M of what each was made with."""
    numbering = numbering_of(body.stiffness, body.mass_matrix)
    K, M = (assemble(m, numbering).toarray() for m in (body.stiffness, body.mass_matrix))
    rng = np.random.default_rng(1)
    pairs = list(
        zip(numbering.nodes, (numbering.unknowns[c] for c in numbering.codes), strict=True)
    )

    def field(vector, dual=False):
        return body.field(*((int(n), ("F" + u[1:]) if dual else u, x)
                            for (n, u), x in zip(pairs, vector, strict=True)))  # fmt: skip

    X = rng.standard_normal((len(K), 4))
    kinds = ("MODAL", "STATIQUE", "MODAL", "STATIQUE")
    zones, blocks = [], []
    for j, kind in enumerate(kinds):
        given = {"DEFO": field(X[:, j])}
        if kind == "MODAL":
            given |= {"FREQ": 1.5 + j, "MASS": 2.0 + j, "AMOR": 0.3 * (j + 1)}
        else:
            given |= {"RIDE": field(K @ X[:, j], True), "MADE": field(M @ X[:, j], True)}
        zone, block = shape_zone(body, body.marks[0] + j, kind, **given)
        zones.append(zone)
        blocks.append(block)
        if j < 2:
            body.node(5.0, float(j))
    material = CellField(tuple(blocks), "")
    stiff = shape_matrix(tuple(zones), material, "RIGIDITE").values[0]
    mass = shape_matrix(tuple(zones), material, "MASSE").values[0]
    damp = shape_matrix(tuple(zones), material, "AMORTISSEMENT")
    k, m = X.T @ K @ X, X.T @ M @ X
    for i, j in np.ndindex(4, 4):
        both = kinds[i] == kinds[j] == "MODAL"
        if both:
            own = (2.0 + i) * (i == j)
            assert mass[i, j] == own
            assert stiff[i, j] == pytest.approx(own * (2 * np.pi * (1.5 + i)) ** 2)
        else:
            assert stiff[i, j] == pytest.approx(k[i, j])
            assert mass[i, j] == pytest.approx(m[i, j])
    # AMOR m w: of static shapes, that have none here, AMOR sqrt(k m)
    own = 2 * np.pi * np.array([0.3 * 2.0 * 1.5, 0, 0.9 * 4.0 * 3.5, 0])
    np.testing.assert_allclose(damp.values[0], np.diag(own))
    assert damp.unknowns == ("ALFA", "BETA", "ALFA", "BETA")
    assert damp.kind == "AMORTISSEMENT"
    points = shape_points(tuple(zones), material)
    assert [p.node for p in points] == [int(z.cells.connectivity[0, 0]) for z in zones]
    assert all(map(is_shape, zones))
    assert shape_matrix((), material, "MASSE") is None
    zone, block = shape_zone(body, body.n[0], "MODAL", FREQ=1.0)
    with pytest.raises(MaterialError, match="DEFO"):
        shape_points((zone,), CellField((block,), ""))
    many = CellBlock.make(body.table, "POI1", np.array([[0], [1]]))
    zone = Zone(many, "MECANIQUE", ("ELASTIQUE", "MODAL"), "MODAL", Mode.PLANE_STRAIN)
    with pytest.raises(MaterialError, match="2"):
        shape_points((zone,), material)
