"""Footings: what rigid ones carry against statics by hand, and which joints are one."""

import numpy as np
import numpy.typing as npt
import pytest
from references.assembled import Bench

from ssilang.kernel.interface.footing import Footing, Loads, footings_of
from ssilang.kernel.interface.interface import Interface
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.stepping.node_track import FootingTrack, footing_track
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem

K = 2e7
WIDTH, LENGTH = 4.0, 6.0


def problem_of(bench: Bench) -> Problem:
    for node in range(len(bench.table.coordinates)):
        bench.mass(1.0, node, ("UX", "UY", "UZ")[: bench.mode.dimension])
        bench.spring(1.0, node)
    return make_problem(
        Inputs(
            bench.stiffness, np.array([0.0, 1e-3]), bench.mass_matrix,
            model=bench.model, characteristics=bench.characteristics,
        )
    )  # fmt: skip


def strip(cells: int = 16, left: float = -WIDTH / 2, bench: Bench | None = None) -> Bench:
    """A line of joints, upper side first, walked so that it opens upwards."""
    bench = Bench() if bench is None else bench
    x = np.linspace(left, left + WIDTH, cells + 1)
    upper = [bench.node(v, 0.0) for v in x]
    lower = [bench.node(v, 0.0) for v in x]
    sides = [[upper[i], upper[i + 1], lower[i], lower[i + 1]] for i in range(cells)]
    bench.joint("RAC2", sides, "JOI2", KN=K, KS=K)
    return bench


def raft(cells: int = 24, soil_first: bool = False) -> Bench:
    """A rectangle of joints, WIDTH along x and LENGTH along y; its structure is above."""
    bench = Bench(Mode.THREE_DIMENSIONAL)
    x = np.linspace(-WIDTH / 2, WIDTH / 2, cells + 1)
    y = np.linspace(-LENGTH / 2, LENGTH / 2, 5)
    sides = [[[bench.node(a, b, 0.0) for b in y] for a in x] for _ in range(2)]
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
    (zone,) = [j.zone for j in interface_of(problem).joints]
    first, second = np.split(zone.cells.raw, 2, axis=1)
    down = interface_of(problem).joints[0].frames[0, 0, -1, -1] < 0.0
    return np.unique(second if down else first)


def turned(problem: Problem, lift: float, about_y: float, about_z: float = 0.0) -> Loads:
    """Loads of the only footing under a rigid motion of its upper side on springs."""
    interface = problem.interface
    assert interface is not None
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


@pytest.mark.parametrize("ratio", [0.5, 1.5, 2.0, 5.0, 10.0])
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


@pytest.mark.parametrize("soil_first", [False, True])
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


def interface_of(problem: Problem) -> Interface:
    assert problem.interface is not None
    return problem.interface


def test_joints_that_share_no_node_are_different_footings() -> None:
    bench = strip(4, left=10.0, bench=strip(8))
    problem = problem_of(bench)
    found = footings_of(interface_of(problem), problem.numbering)
    assert [len(f.points) for f in found] == [16, 8]
    assert [f.centre[0] for f in found] == pytest.approx([0.0, 12.0], abs=1e-12)
    assert np.intersect1d(found[0].points, found[1].points).size == 0


def test_two_pairs_of_points_are_one_footing_and_a_pair_alone_does_not_rock() -> None:
    def pairs(*places: float) -> Footing:
        bench = Bench()
        cells = [[bench.node(x, -1.0), bench.node(x, 0.0)] for x in places]
        bench.joint("SEG2", cells, "JOI1", KN=K, KS=0.0)
        problem = problem_of(bench)
        (found,) = footings_of(interface_of(problem), problem.numbering)
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


def test_a_track_goes_on_from_what_it_held() -> None:
    problem = problem_of(strip(4, left=10.0, bench=strip(8)))
    wanted = np.ones(2, bool)
    first, again = footing_track(problem, wanted), footing_track(problem, wanted)
    assert isinstance(first, FootingTrack)
    assert isinstance(again, FootingTrack)
    first.instants.append(np.array([0.5]))
    for number in range(2):
        parts = (np.array([10.0 * number + i]) for i in range(len(Loads._fields)))
        first.kept[number].append(Loads(*parts))
    again.restore([np.array(x) for x in first.content()])
    assert again.times.tolist() == [0.5]
    for number in range(2):
        for mine, other in zip(again.found(number), first.found(number), strict=True):
            np.testing.assert_array_equal(mine, other)
    empty = footing_track(problem, wanted)
    assert isinstance(empty, FootingTrack)
    again.restore(empty.content())
    assert len(again.times) == 0
    assert again.kept == [[], []]
