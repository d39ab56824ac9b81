"""Footings: what rigid ones carry against statics by hand, and which joints are one."""

import numpy as np
import numpy.typing as npt
import pytest
from references.assembled import Bench
from references.recorder import Recorder
from together import together

from ssilang.kernel.interface.footing import Footing, Loads, footings_of
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.stepping import node_histories
from ssilang.kernel.stepping.node_histories import FootingHistories, footing_histories
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.run import integrate

K = 2e7
WIDTH, LENGTH = 4.0, 6.0
FLAT = np.eye(3)


def problem_of(bench: Bench) -> Problem:
    for node in range(len(bench.table.coordinates)):
        bench.mass(1.0, node, ("UX", "UY", "UZ")[: bench.mode.dimension])
        bench.spring(1.0, node)
    return bench.problem(np.array([0.0, 1e-3]))


def strip(
    cells: int = 16, left: float = -WIDTH / 2, bench: Bench | None = None, width: float = WIDTH
) -> Bench:
    """A line of joints in three zones, upper side first, walked so that it opens upwards."""
    bench = Bench() if bench is None else bench
    s = np.linspace(0.0, 1.0, cells + 1)
    x = left + width * (s + 0.05 * s * (s - 1.0))
    upper = [bench.node(v, 0.0) for v in x]
    lower = [bench.node(v, 0.0) for v in x]
    sides = [[upper[i], upper[i + 1], lower[i], lower[i + 1]] for i in range(cells)]
    for some in (sides[:1], sides[1 : cells // 2], sides[cells // 2 :]):
        bench.joint("RAC2", some, "JOI2", KN=K, KS=K)
    return bench


def raft(cells: int = 24, soil_first: bool = False, turn: npt.NDArray[np.float64] = FLAT) -> Bench:
    """A rectangle of joints, WIDTH along x and LENGTH along y, then turned; the structure above."""
    bench = Bench(Mode.THREE_DIMENSIONAL)
    x = np.linspace(-WIDTH / 2, WIDTH / 2, cells + 1)
    y = np.linspace(-LENGTH / 2, LENGTH / 2, 5)
    sides = [[[bench.node(*turn @ (a, b, 0.0)) for b in y] for a in x] for _ in range(2)]
    joints = [
        [s[i + a][j + b] for s in sides for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for i in range(cells)
        for j in range(len(y) - 1)
    ]
    if soil_first:  # walked the other way round, the normal points down
        joints = [[*c[:4][::-1], *c[4:][::-1]] for c in joints]
    bench.joint("LIA4", joints, "JOI4", KN=K, KS=K)
    return bench


def structure_of(problem: Problem) -> npt.NDArray[np.int64]:
    """Nodes of the side that moves: the one above."""
    raw = np.concatenate([j.zone.cells.raw for j in problem.interface.joints])
    first, second = np.split(raw, 2, axis=1)
    down = problem.interface.joints[0].frames[0, 0, -1, -1] < 0.0
    return np.unique(second if down else first)


def turned(problem: Problem, lift: float, about_y: float, about_z: float = 0.0) -> Loads:
    """Loads of the only footing under a rigid motion of its upper side on springs."""
    interface = problem.interface
    (footing,) = footings_of(interface, problem.numbering)
    x = footing.places[:, 0]
    w = np.zeros((1, interface.n_points, interface.dimension))
    w[0, footing.points, -1] = lift + x * (about_z - about_y)
    t = np.where(w < 0.0, K * w, 0.0)
    u = np.zeros(problem.numbering.size)
    table, structure = problem.numbering.table, structure_of(problem)
    names = np.array(problem.numbering.unknowns)[problem.numbering.codes]
    up = names == ("UY" if interface.dimension == 2 else "UZ")
    up &= np.isin(problem.numbering.nodes, structure)
    u[up] = lift + table.coordinates[problem.numbering.nodes[up], 0] * (about_z - about_y)
    return footing.loads(w, t, u[footing.unknowns][None])


@together("ratio", [0.5, 1.5, 2.0, 5.0, 10.0])
def test_a_rigid_strip_that_lifts_off(ratio: float) -> None:
    """theta_u = 2 N/(k B^2); beyond it the contact is B sqrt(theta_u/theta) wide."""
    N = 6e5
    theta = ratio * 2.0 * N / (K * WIDTH**2)
    contact = min(1.0, ratio**-0.5)
    if contact < 1.0:
        lift = theta * (WIDTH / 2 - contact * WIDTH)
        moment = N * WIDTH / 6.0 * (3.0 - 2.0 / ratio**0.5)
        toe = 2.0 * N / (contact * WIDTH)
    else:
        lift, moment = -N / (K * WIDTH), N * WIDTH / 6.0 * ratio
        toe = N / WIDTH * (1.0 + ratio)
    # it is pressed on its left, where x < 0, by a rotation that lifts the right
    found = turned(problem_of(strip()), lift, about_y=0.0, about_z=theta)
    assert found.rotation[0] == pytest.approx([theta], rel=1e-12)
    # the ends are exact, force and moment but for the cell where contact ends
    assert found.share[0] == pytest.approx(contact, abs=1e-12)
    assert found.pressure[0] == pytest.approx(toe, rel=1e-12)
    assert found.opening[0] == pytest.approx(
        max(0.0, theta * WIDTH * (1.0 - contact)), rel=1e-12, abs=1e-15
    )
    assert found.force[0] == pytest.approx(N, rel=3e-3)
    assert found.moment[0] == pytest.approx([moment], rel=3e-3)


def test_a_cell_half_open_says_the_pressure_of_its_points() -> None:
    theta, shut = 1e-3, 0.65  # the bed is pressed from the left over this width
    found = turned(problem_of(strip(4)), theta * (WIDTH / 2 - shut), 0.0, about_z=theta)
    first = 0.5 * WIDTH * (0.25 - 0.05 * 0.25 * 0.75) * (1.0 - 3**-0.5)
    assert found.pressure[0] == pytest.approx(K * theta * (shut - first))


@together("soil_first", [False, True])
def test_a_raft_in_space_turned_about_y(soil_first: bool) -> None:
    """The same per unit length, times its length; nothing about x."""
    N, ratio = 6e5 * LENGTH, 4.0
    theta = ratio * 2.0 * N / (K * LENGTH * WIDTH**2)
    problem = problem_of(raft(soil_first=soil_first))
    (footing,) = footings_of(problem.interface, problem.numbering)
    assert footing.area == pytest.approx(WIDTH * LENGTH)
    assert footing.normal == pytest.approx([0, 0, 1], abs=1e-15)
    np.testing.assert_allclose(footing.axes, [[1, 0, 0], [0, 1, 0]], atol=1e-15)
    found = turned(problem, lift=0.0, about_y=theta)  # half of it in contact
    np.testing.assert_allclose(found.rotation[0], [0.0, theta], atol=1e-12 * theta)
    assert found.share[0] == pytest.approx(0.5)
    assert found.force[0] == pytest.approx(N, rel=1e-3)
    moment = N * WIDTH / 6.0 * (3.0 - 2.0 / ratio**0.5)
    np.testing.assert_allclose(found.moment[0], [0.0, moment], rtol=1e-3, atol=1e-3)
    assert found.pressure[0] == pytest.approx(2.0 * N / (0.5 * WIDTH * LENGTH), rel=0.02)


def test_joints_that_share_no_node_are_different_footings() -> None:
    """The largest is first; two points beside them are a third, and every point belongs to one."""
    bench = strip(8, bench=strip(4, left=10.0, width=2.0))
    bench.joint("SEG2", [[bench.node(-9.0, -1.0), bench.node(-9.0, 0.0)]], "JOI1", KN=K, KS=K)
    problem = problem_of(bench)
    found = footings_of(problem.interface, problem.numbering)
    assert [len(f.points) for f in found] == [16, 8, 1]
    assert [f.centre[0] for f in found] == pytest.approx([0.0, 11.0, -9.0], abs=1e-12)
    assert sorted(np.concatenate([f.points for f in found])) == list(range(25))


TURNS = {
    "flat": FLAT,
    "a wall": np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]]),
    "another wall": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "a slope": np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]]),
}


@together("turn", TURNS.values())
def test_axes_lie_in_the_base_and_a_rigid_rotation_is_read_about_them(turn) -> None:
    problem = problem_of(raft(2, turn=turn))
    (footing,) = footings_of(problem.interface, problem.numbering)
    n = turn[:, 2]
    np.testing.assert_allclose(footing.normal, n, atol=1e-12)
    np.testing.assert_allclose(footing.axes @ n, 0.0, atol=1e-12)
    np.testing.assert_allclose(footing.axes @ footing.axes.T, np.eye(2), atol=1e-12)
    np.testing.assert_allclose(np.cross(*footing.axes), n, atol=1e-12)
    omega, at = np.array([2e-3, -1e-3, 5e-4]), footing.unknowns
    numbering = problem.numbering
    x = numbering.table.coordinates[numbering.nodes[at]]
    moved = np.cross(omega, x) + np.array([3e-3, 1e-3, -2e-3])
    axis = np.array(["XYZ".index(name[1]) for name in numbering.unknowns])[numbering.codes[at]]
    u = moved[np.arange(len(at)), axis]
    np.testing.assert_allclose(footing.turn @ u, footing.axes @ omega, atol=1e-15)


def test_a_ring_does_not_turn() -> None:
    bench = strip(4, left=1.0, bench=Bench(Mode.AXISYMMETRIC))
    problem = problem_of(bench)
    (footing,) = footings_of(problem.interface, problem.numbering)
    assert footing.axes.shape == (0, 3)
    assert footing.turn.shape[0] == 0


def test_pairs_on_a_line_turn_about_the_line_across() -> None:
    """In space they have one axis, whichever side of a pair is named first."""
    for first, side in ((0, 1.0), (1, 1.0), (0, -1.0)):
        bench = Bench(Mode.THREE_DIMENSIONAL)
        places = ((-3.0, -4.0 * side), (0.0, 0.0), (6.0, 8.0 * side))
        pairs = [[bench.node(*p, z) for z in (-1.0, 0.5)] for p in places]
        bench.joint("SEG2", [p[::-1] if first else p for p in pairs], "JOI1", KN=K, KS=K)
        problem = problem_of(bench)
        (footing,) = footings_of(problem.interface, problem.numbering)
        np.testing.assert_allclose(footing.centre, [1.0, 4 / 3 * side, 0.5], atol=1e-12)
        np.testing.assert_allclose(np.abs(footing.axes), [[0.8, 0.6, 0.0]], atol=1e-12)
        assert side * footing.axes[0, 0] * footing.axes[0, 1] < 0.0
        moved = np.cross(footing.axes[0], footing.places - footing.centre)[:, 2]
        u = np.zeros(len(footing.unknowns))
        up = np.array(problem.numbering.unknowns)[problem.numbering.codes[footing.unknowns]] == "UZ"
        u[up] = moved
        np.testing.assert_allclose(footing.turn @ u, [1.0])
        w, t = np.zeros((2, 1, 3, 3))
        t[0, footing.points, 2] = [-5.0, 0.0, -2.0]
        loads = footing.loads(w, t, np.zeros((1, len(footing.unknowns))))
        about = 5.0 * (-5.0 - 5 / 3) + 2.0 * (10.0 - 5 / 3)  # forces upwards times arms
        assert abs(loads.moment[0, 0]) == pytest.approx(abs(about))


def test_a_macro_element_tells_its_law() -> None:
    bench = Bench()
    ends = [bench.node(0.0, -1.0), bench.node(0.0, 0.0)]
    bench.joint("SEG2", [ends], "JOI1", law="MACRO_SEMELLE", KN=K, KS=K, LARG=WIDTH)
    for node in ends:
        bench.spring(1.0, node, unknown="RZ")
    problem = problem_of(bench)
    (footing,) = footings_of(problem.interface, problem.numbering)
    loads = footing.loads(np.array([[[2e-3, -1e-3]]]), np.array([[[-7e3, -9e4]]]), np.zeros((1, 0)))
    assert (loads.force[0], loads.moment[0], loads.rotation[0]) == (9e4, -7e3, 2e-3)
    assert (loads.share[0], loads.opening[0]) == pytest.approx((0.625, 3e-3))
    assert loads.pressure[0] == pytest.approx(K / WIDTH * 5e-3)
    space = Bench(Mode.THREE_DIMENSIONAL)
    ends = [space.node(0.0, 0.0, 0.0), space.node(0.36, 0.48, 0.8)]
    space.joint("SEG2", [ends], "JOI1", law="MACRO_DISQUE", KN=K, KS=K, RAYO=WIDTH)
    for node in ends:
        space.mass(1.0, node, ("UX", "UY", "UZ", "RX", "RY", "RZ"))
    problem = space.problem(np.array([0.0, 1e-3]))
    (footing,) = footings_of(problem.interface, problem.numbering)
    np.testing.assert_allclose(footing.axes @ [0.36, 0.48, 0.8], 0.0, atol=1e-15)
    np.testing.assert_allclose(footing.axes @ footing.axes.T, np.eye(2), atol=1e-15)


def test_two_pairs_of_points_are_one_footing_and_a_pair_alone_does_not_rock() -> None:
    def pairs(*places: float) -> Footing:
        bench = Bench()
        cells = [[bench.node(x, -1.0), bench.node(x, 0.0)] for x in places]
        bench.joint("SEG2", cells, "JOI1", KN=K, KS=0.0)
        problem = problem_of(bench)
        (found,) = footings_of(problem.interface, problem.numbering)
        return found

    two, one = pairs(-1.5, 1.5), pairs(0.0)
    w = np.array([[[0.0, -0.003], [0.0, 0.001]]])
    t = np.array([[[0.0, -K * 0.003], [0.0, 0.0]]])
    loads = two.loads(w, t, np.zeros((1, len(two.unknowns))))
    assert loads.share[0] == 0.5
    assert loads.force[0] == pytest.approx(K * 0.003)
    assert loads.moment[0, 0] == pytest.approx(1.5 * K * 0.003)  # it turns to the left
    assert loads.opening[0] == 0.001
    assert len(one.axes) == 0


def test_a_track_goes_on_from_what_it_held(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = problem_of(strip(8, bench=strip(4, left=10.0, width=2.0)))
    wanted = np.ones(2, bool)
    first, again = footing_histories(problem, wanted), footing_histories(problem, wanted)
    assert isinstance(first, FootingHistories)
    assert isinstance(again, FootingHistories)
    first.instants.append(np.array([0.5]))
    for number in range(2):
        parts = (np.array([10.0 * number + i]) for i in range(len(Loads._fields)))
        first.kept[number].append(Loads(*parts))
    again.restore([np.array(x) for x in first.content()])
    assert again.times.tolist() == [0.5]
    for number in range(2):
        for mine, other in zip(again.found(number), first.found(number), strict=True):
            np.testing.assert_array_equal(mine, other)
    empty = footing_histories(problem, wanted)
    assert isinstance(empty, FootingHistories)
    again.restore(empty.content())
    assert len(again.times) == 0
    assert again.kept == [[], []]
    monkeypatch.setattr(node_histories, "MOST", 1)
    few = footing_histories(problem, wanted)
    assert isinstance(few, FootingHistories)
    assert ([f.area for f in few.footings], few.left_out) == ([empty.footings[0].area], 1)
    assert empty.left_out == 0


@together("wanted", [[0, 1, 2, 3, 4], [1, 3]])
def test_loads_in_time_are_those_of_the_motion_that_is_seen(wanted: list[int]) -> None:
    """Of two footings that move unlike each other, the larger first."""
    bench = strip(8)
    strip(4, 10.0, bench, 2.0)
    number = len(bench.table.coordinates)
    forces = [(node, "FY", -1e3 * (1 + node % 7)) for node in range(number)]
    for node in range(number):
        bench.mass(1.0 + node % 3, node)
        bench.spring(1e5, node)
        bench.spring(1e5, node, unknown="UX")
    times = 1e-3 * np.arange(5)
    problem = bench.problem(times, bench.load(bench.field(*forces), times, np.sin(2e3 * times)))
    seen, at = Recorder(5), np.isin(np.arange(5), wanted)
    followed = footing_histories(problem, at)
    assert followed is not None
    integrate(problem, [seen, followed])
    np.testing.assert_allclose(followed.times, times[wanted])
    u, w, t = (seen.of(name)[wanted] for name in ("u", "w", "t"))
    for k, footing in enumerate(footings_of(problem.interface, problem.numbering)):
        expected = footing.loads(w, t, u[:, footing.unknowns])
        for mine, other in zip(followed.found(k), expected, strict=True):
            np.testing.assert_allclose(mine, other, rtol=1e-9, atol=1e-9 * np.abs(other).max())
    assert np.abs(followed.found(1).force).max() > 1.0
