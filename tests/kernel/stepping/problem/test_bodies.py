"""Which bodies nothing but joints holds: several on one joint, one held by a spring or support."""

import numpy as np
from references.assembled import Bench
from together import together

from ssilang.kernel.stepping.problem.bodies import full_uplift, loose_bodies


@together("first", [0, 1])
def test_each_body_at_a_joint_counts_the_points_that_touch_it(first):
    """Two joints on three nodes above ground: two bodies meet on the first, one of them has mass.

    A third, at a joint of two points, stands on a spring as well.
    """
    bench = Bench()
    x = [0.0, 1.0, 2.5]
    above, below = ([bench.node(v, 0.0) for v in x] for _ in range(2))
    cells = [[above[k], above[k + 1], below[k], below[k + 1]] for k in (0, 1)]
    bench.joint("RAC2", cells, "JOI2", KN=3e6, KS=1e6)
    foot, head = bench.node(5.0, -1.0), bench.node(5.0, 0.0)
    bench.joint("SEG2", [foot, head], "JOI1", KN=3e6, KS=1e6)
    for node in (*below, foot):
        bench.fix(node)
    bench.spring(2e5, head)
    bench.relate([(1.0, "UY", above[1]), (-1.0, "UY", above[2])])  # the second body
    heavy = above[:1] if first == 0 else above[1:]
    for node in heavy:
        bench.mass(7.0, node)
    problem = bench.problem(np.array([0.0, 1e-3]))
    joints = problem.interface
    tractions = np.zeros((joints.n_points, 2))
    tractions[:, -1] = -1.0
    line = np.flatnonzero((joints.B[:, -1] != 0.0).sum(axis=1) > 1)
    assert len(line) == 4
    tractions[line[:2], -1] = 0.0  # the first joint is open
    one, two = sorted(loose_bodies(problem, tractions), key=lambda b: b.node)
    assert (one.node, one.open_points, one.points) == (above[0], 2, 2)
    assert (two.open_points, two.points) == (2, 4)
    assert two.node == above[1]
    masses = [7.0, 0.0] if first == 0 else [0.0, 14.0]
    assert [one.mass, two.mass] == masses
    assert (full_uplift(problem, tractions) or one) == one
    assert (full_uplift(problem, tractions) is None) == (first == 0)
    assert full_uplift(problem, 0.0 * tractions).node == (above[1] if first == 0 else above[0])
    assert loose_bodies(problem, np.abs(tractions))[0].open_points == 2
