"""Relations of two sides against sums over many points, with meshes that do not match."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.contact.unilateral import METHODS, Rubbing, contact_relations
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

NAMES = ("UX", "UY", "UZ")
MU, COHESION, DISTANCE = 0.3, 70.0, 0.011
LOW, HIGH = np.array([-1.0, 0.2, 0.9, 2.3]), np.array([-1.4, -0.3, 0.35, 1.1, 1.9])
MANY = 50_000


def products(rows, u):
    """Rows times displacements (nodes, dim)."""
    terms = rows.coefficients * u[rows.nodes, [NAMES.index(n) for n in rows.unknowns]]
    return np.add.reduceat(terms, rows.row_start[:-1])


def two_lines(lean):
    """One along x, one above it that leans, both turned; nodes and cells stand in no order."""
    c, s = np.cos(0.4), np.sin(0.4)
    table, R = NodeTable(), np.array([[c, -s], [s, c]])
    high, low = np.empty(5, int), np.empty(4, int)
    high[[2, 0, 4, 1, 3]] = table.add(
        np.column_stack([HIGH + 4.0, 0.1 + lean * HIGH])[[2, 0, 4, 1, 3]] @ R.T
    )
    low[[3, 1, 0, 2]] = table.add(np.column_stack([LOW + 4.0, 0.0 * LOW])[[3, 1, 0, 2]] @ R.T)
    # outer normals are to the right of the travel
    master = Mesh.of(table, "SEG2", np.column_stack([low[1:], low[:-1]])[[1, 0, 2]])
    slave = Mesh.of(table, "SEG2", np.column_stack([high[:-1], high[1:]])[[3, 0, 2, 1]])
    return table, R, low, high, master, slave


def weights_of(method, nodes, cells, x, own, other):
    """Points x of a side (nodes at `own`) that face the other, weights of their rows, areas."""
    if method in ("MESC", "SYME"):
        x, half = own, 0.5 * np.diff(own)
        rows, areas = np.eye(len(own)), np.r_[half, 0.0] + np.r_[0.0, half]
        rows, areas = rows[np.argsort(nodes)], areas[np.argsort(nodes)]
    elif method == "FAIB":
        rows = np.eye(len(own) - 1)[:, np.searchsorted(own, x) - 1][cells]
    else:
        rows = np.array([np.interp(x, own, e) for e in np.eye(len(own))])[np.argsort(nodes)]
    rows = rows * ((x >= other[0]) & (x <= other[-1]))
    if method in ("FAIB", "MORT"):
        areas = rows.sum(axis=1) * (own[-1] - own[0]) / len(x)
    kept = rows.any(axis=1)
    return x, rows[kept] / rows[kept].sum(axis=1, keepdims=True), areas[kept]


@together("method, lean", [*((m, 0.0) for m in METHODS), ("MESC", 0.04)])
def test_rows_are_means_of_what_one_side_does_over_the_other(method, lean):
    table, R, low, high, master, slave = two_lines(lean)
    u = np.random.default_rng(4).standard_normal((len(table), 2))
    rub = Rubbing(MU, COHESION, True)
    made = contact_relations(table, NAMES[:2], master, slave, method, DISTANCE, rub)
    sides = [(low, LOW, high, HIGH, [3, 0, 2, 1], R[:, 1])]
    if method == "SYME":
        sides.append((high, HIGH, low, LOW, [1, 0, 2], -R[:, 1]))
    found, areas, gaps, radii = [], [], [], []
    for faced, there, nodes, own, cells, n in sides:
        x = own[0] + (own[-1] - own[0]) * (np.arange(MANY) + 0.5) / MANY
        x, rows, area = weights_of(method, nodes, cells, x, own, there)
        jump = [np.interp(x, own, v) - np.interp(x, there, w)
                for v, w in zip(u[nodes].T, u[faced].T, strict=True)]  # fmt: skip
        found.append(rows @ np.transpose(jump) @ np.transpose([n, [-n[1], n[0]]]))
        areas.append(area * np.hypot(1.0, lean))
        gaps.append(rows @ (0.1 + lean * x))
        height = (0.1 + lean * x) * (own is HIGH)
        radii.append(rows @ (np.column_stack([x + 4.0, height]) @ R.T)[:, 0])
    area, radius = np.concatenate(areas), np.concatenate(radii)
    near = {"rtol": 0.0, "atol": 1e-12 if len(x) < MANY else 1e-4}
    jumps = np.concatenate(found)
    np.testing.assert_allclose(products(made.relations, u), jumps[:, 0], **near)
    np.testing.assert_allclose(products(made.friction.slip, u), jumps[:, 1], **near)
    np.testing.assert_allclose(made.distances, DISTANCE - np.concatenate(gaps), **near)
    np.testing.assert_allclose(made.friction.constant, COHESION * 2 * np.pi * area * radius, 1e-3)
    assert (made.relations.sense == 1).all()
    assert (made.friction.coefficient == MU).all()
    assert (made.friction.normals == made.relations.multipliers).all()
    flat = contact_relations(table, NAMES[:2], master, slave, method, 0.0, Rubbing(MU, 1.0))
    np.testing.assert_allclose(flat.friction.constant, area, 1e-4)
    away = contact_relations(table, NAMES[:2], slave, slave, method)
    assert away is None  # nothing faces itself


@together("method", METHODS)
def test_rows_in_space_keep_what_is_linear(method):
    """Triangles on quadrangles, all turned: of an affine field a row has what its points have."""
    rng = np.random.default_rng(8)
    R = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    R *= np.linalg.det(R)
    table, gap = NodeTable(), 0.07
    grid = np.array([(x, y) for y in (0.0, 0.7, 1.9) for x in (0.0, 1.1, 1.7)])
    flat = np.column_stack([grid, 0.0 * grid[:, 0]])
    low = table.add(flat @ R.T)
    over = np.array([[0.3, 0.2], [1.4, 0.1], [1.5, 1.6], [0.2, 1.2], [0.8, 0.9]])
    high = table.add(np.column_stack([over, np.full(5, gap)]) @ R.T)
    quads = [[0, 1, 4, 3], [1, 2, 5, 4], [4, 5, 8, 7], [3, 4, 7, 6]]
    master = Mesh.of(table, "QUA4", low[quads])
    slave = Mesh.of(table, "TRI3", high[[[4, 1, 0], [4, 2, 1], [4, 3, 2], [4, 0, 3]]])
    made = contact_relations(table, NAMES, master, slave, method, 0.0, Rubbing(MU, COHESION))
    H, x = rng.standard_normal((3, 3)), table.coordinates
    u, n = x @ H.T + [1.0, -2.0, 3.0], R[:, 2]
    moved = gap * H @ n  # a point against its foot, whichever side it is of
    n_rows = {"MESC": 5, "SYME": 5 + 1, "FAIB": 4, "MORT": 5}[method]  # one node lies under cells
    np.testing.assert_allclose(products(made.relations, u), np.full(n_rows, n @ moved))
    np.testing.assert_allclose(made.distances, -gap)
    slips = products(made.friction.slip, u).reshape(-1, 2)
    across = moved - n * (n @ moved)
    np.testing.assert_allclose(np.linalg.norm(slips, axis=1), np.linalg.norm(across))
    turned = products(made.friction.slip, u @ np.cross(np.eye(3), n).T).reshape(-1, 2)
    np.testing.assert_allclose(np.vecdot(slips, turned), 0.0, atol=1e-9)  # axes at right angles
    area = 0.5 * abs(sum(a[0] * b[1] - b[0] * a[1]
                         for a, b in zip(over[:4], over[[1, 2, 3, 0]], strict=True)))  # fmt: skip
    share = made.friction.constant[:5] / COHESION
    if method in ("MESC", "SYME"):
        assert share[4] == pytest.approx(area / 3)
    assert share.sum() == pytest.approx(area)
