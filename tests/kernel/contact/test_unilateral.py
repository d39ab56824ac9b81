"""Relations of two sides against sums over many points; rows, multipliers, noses of projectiles."""

from types import SimpleNamespace

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder
from together import together

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.rows import ContactRows
from ssilang.kernel.contact.solver import ContactForces
from ssilang.kernel.contact.touching import Nose
from ssilang.kernel.contact.unilateral import METHODS, ContactOptions, Rubbing, contact_relations
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.statics.stepping import step_statics

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


def test_work_energies_and_multipliers_of_two_rows_that_push_elsewhere_and_rub():
    random = np.random.default_rng(5)
    G, D, H, watched = (sp.csr_array(random.normal(size=(m, 4))) for m in (2, 2, 3, 2))
    sense, imposed = np.array([1.0, -1.0]), random.normal(size=(2, 3))
    friction = SimpleNamespace(H=H, watched=watched, offset=np.array([0.5, -2.0]))
    rows = ContactRows(G, sense, np.arange(2), imposed, D, friction)  # type: ignore[arg-type]
    dc, u = random.normal(size=3), random.normal(size=4)
    forces = np.array([3.0, 0.0, 1.0, -2.0, 4.0])
    du = np.linalg.lstsq(G.toarray(), imposed @ dc, rcond=None)[0]
    np.testing.assert_allclose(rows.gaps(u + du, 2.0 * dc), rows.gaps(u, dc))  # they stay closed
    pushed = rows.pushing.T @ forces
    # what they do to the structure is what moving stops give and friction takes
    given = rows.work(forces, du, dc) - rows.rubbed(forces, du)
    assert pushed @ du == pytest.approx(given)
    assert rows.rubbed(forces, -du) == -rows.rubbed(forces, du) != 0.0
    assert rows.closed(forces).tolist() == [True, False]
    np.testing.assert_allclose((sense[:, None] * G).T @ rows.lagrange(forces), -G.T @ forces[:2])
    step = rows.at_rest(u, rows.gaps(u, dc)) + rows.seen @ du
    wanted = [rows.gaps(u + du, dc), H @ du, friction.offset + watched @ (u + du)]
    np.testing.assert_allclose(step, np.concatenate(wanted))
    assert rows.penalty_energy(np.array([-0.2, 0.3]), 5.0) == pytest.approx(0.1)
    assert rows.penalty_energy(np.array([-0.2, 0.3]), None) == 0.0


@together("slip, rubbed", [(1e-4, -0.4), (9e-4, -0.3 * 5.0)])
def test_a_penalty_stands_in_series_with_the_flexibility_below_a_place_that_rubs(slip, rubbed):
    """A gap that closes by 3e-3 on 1e-4 + 1 / 2 000; a slip that is held, and one that is not."""
    friction = SimpleNamespace(
        width=1, normal=np.zeros(1, int), coefficient=np.array([0.3]), constant=np.zeros(1)
    )

    class Place:
        def __len__(self):
            return 1

    place = Place()
    place.friction = friction
    forces = ContactForces(place, ContactOptions("PENALITE", 2e3))
    W = np.array([[1e-4, 0.0], [0.0, 2.5e-4], [0.0, 0.0]])  # the last: nothing is watched
    found = forces.held(W, np.array([-3e-3, slip, 0.0]))
    np.testing.assert_allclose(found, [5.0, rubbed], rtol=1e-9)
    assert W[0, 0] == 1e-4


SOLVERS = ["LAGRANGE", "AUGMENTE", "UZAWA"]


@together("method", SOLVERS)
def test_a_body_comes_to_rest_on_its_stops(method):
    """A bar on two stops at different heights, free but for them, and pressed off its middle."""
    bench = Bench()
    feet = [bench.node(float(x), 0.0) for x in (0.0, 1.0)]
    tops = [bench.node(float(x), 1.0) for x in (0.0, 1.0)]
    for foot, top in zip(feet, tops, strict=True):
        bench.spring(2e5, foot, top)
        bench.relate([(1.0, "UY", foot)], sense=1)
    # the bar is rigid: its middle, pressed at a quarter of its length
    middle = bench.node(0.5, 1.0)
    bench.relate([(1.0, "UY", middle), (-0.5, "UY", tops[0]), (-0.5, "UY", tops[1])])
    problem = bench.problem(
        np.array([0.0, 1.0, 2.0]),
        bench.load(bench.field((middle, "FY", -2e3), (tops[0], "FY", -1e3)), [0, 1, 2], [0, 1, 2]),
        contact_options=ContactOptions(method),
    )
    recorder = Recorder(3)
    history = step_statics(problem, [recorder])
    u, pushed = recorder.of("u"), recorder.of("contact")
    shares = np.array([2e3, 1e3])  # on the left and on the right foot
    at = [problem.numbering.index_of(n, "UY") for n in (*feet, *tops, middle)]
    for k in (1, 2):
        np.testing.assert_allclose(pushed[k][:2], k * shares, rtol=1e-6)
        down = -k * shares / 2e5
        wanted = [0.0, 0.0, *down, down.mean()]
        np.testing.assert_allclose(u[k][at], wanted, rtol=1e-6, atol=1e-12)
        kept = 0.5 * k * shares @ -down  # in the springs
        assert history.energies[k, 1] == pytest.approx(kept, rel=1e-6)
        assert history.imbalance[k] == pytest.approx(0.0, abs=1e-6 * kept)


def outline(shape, size, angle):
    """Points of a nose whose foremost one is the origin, out of it along x."""
    s = np.linspace(-1.0, 1.0, 20001)
    if shape == "HEMI":
        return size * np.column_stack([np.cos(1.5 * s) - 1.0, np.sin(1.5 * s)])
    y = 0.5 * size * s
    return np.column_stack([-np.abs(y) / np.tan(angle) if shape == "CONE" else 0.0 * y, y])


@together("shape, angle", [("HEMI", 0.0), ("PLAT", 0.0), ("CONE", 0.5)])
def test_gaps_and_normals_are_those_of_the_nearest_point_of_the_outline(shape, angle):
    """Turned, seen from both sides of its axis and of its outline."""
    size, turn = 2.0, 0.7
    to = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    places = np.array([[0.1, 0.3], [-0.1, -0.4], [-0.45, 0.35], [0.05, -0.6]])
    ways = places[:, None] - outline(shape, size, angle)
    way = ways[np.arange(4), np.linalg.norm(ways, axis=2).argmin(axis=1)]
    x, y = places.T
    inner = {"HEMI": np.hypot(x + size, y) < size, "PLAT": x < 0.0,
             "CONE": x < -np.abs(y) / np.tan(angle or 1.0)}[shape]  # fmt: skip
    signs = np.where(inner, -1.0, 1.0)
    normals, gaps = Nose(shape, to[:, 0], size, angle).touched(places @ to.T)
    np.testing.assert_allclose(gaps, signs * np.hypot(*way.T), atol=1e-6)
    np.testing.assert_allclose(normals * gaps[:, None], way @ to.T, atol=2e-4)
    far = np.array([[-0.1, 1.3], [-3.0, 0.1]])[: 1 + (shape == "HEMI")]
    beside = np.isinf(Nose(shape, to[:, 0], size, angle).touched(far @ to.T)[1])
    assert beside.tolist() == ([False, True] if shape == "HEMI" else [True])
