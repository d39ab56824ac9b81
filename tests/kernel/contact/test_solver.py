"""Steps with unilateral relations by multipliers: bodies that only they hold, joints beside."""

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder

from ssilang.kernel.contact import solver
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem
from ssilang.kernel.stepping.run import integrate

METHODS = ["LAGRANGE", "AUGMENTE", "UZAWA"]


@pytest.mark.parametrize("method", METHODS)
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
    problem = make_problem(
        Inputs(
            bench.stiffness,
            np.array([0.0, 1.0, 2.0]),
            load=bench.load(
                bench.field((middle, "FY", -2e3), (tops[0], "FY", -1e3)), [0, 1, 2], [0, 1, 2]
            ),
            contact_options=ContactOptions(method),
        )
    )
    recorder = Recorder(3)
    step_statics(problem, [recorder])
    u, pushed = recorder.of("u"), recorder.of("contact")
    shares = np.array([2e3, 1e3])  # on the left and on the right foot
    at = [problem.numbering.index_of(n, "UY") for n in (*feet, *tops, middle)]
    for k in (1, 2):
        np.testing.assert_allclose(pushed[k][:2], k * shares, rtol=1e-6)
        down = -k * shares / 2e5
        wanted = [0.0, 0.0, *down, down.mean()]
        np.testing.assert_allclose(u[k][at], wanted, rtol=1e-6, atol=1e-12)


def test_a_joint_that_stays_closed_is_its_spring_beside_a_stop(monkeypatch):
    """A mass on a pressed joint and one on a spring above it, which meets a ceiling."""
    taken = []
    with_joints = solver.ContactSolver._with_joints

    def counted(self, *given):
        taken.append(1)
        return with_joints(self, *given)

    monkeypatch.setattr(solver.ContactSolver, "_with_joints", counted)
    found = [motion_below_a_ceiling(by_joint) for by_joint in (True, False)]
    assert taken
    (u, pushed), (wanted, pushes) = found
    assert wanted[:, 0].max() < 0.0  # the joint stays pressed
    assert (pushes > 0).any()
    assert (pushes == 0).any()
    np.testing.assert_allclose(u, wanted, atol=1e-8 * np.abs(wanted).max())
    np.testing.assert_allclose(pushed, pushes, atol=1e-6 * pushes.max())


def motion_below_a_ceiling(by_joint):
    bench = Bench()
    soil, low, high = (bench.node(0.0, y) for y in (-1.0, 0.0, 1.0))
    bench.fix(soil)
    for a in (low, high):
        bench.fix(a, "UX")
    if by_joint:
        bench.joint("SEG2", [soil, low], "JOI1", KN=2e6, KS=0.0)
    else:
        bench.spring(2e6, soil, low)
    bench.spring(3e5, low, high)
    bench.mass(30.0, low)
    bench.mass(20.0, high)
    bench.relate([(1.0, "UY", high)], sense=-1)
    times = np.arange(301) * 5e-4
    factors = 1.0 + 0.6 * np.sin(60.0 * times)
    problem = make_problem(
        Inputs(
            bench.stiffness,
            times,
            bench.mass_matrix,
            load=bench.load(bench.field((low, "FY", -9e4), (high, "FY", 2e3)), times, factors),
            displacement=bench.field((low, "UY", -8.8e4 / 2e6), (high, "UY", -1e-2)),
            model=bench.model,
            characteristics=bench.characteristics,
        )
    )
    recorder = Recorder(len(times))
    integrate(problem, [recorder])
    at = [problem.numbering.index_of(n, "UY") for n in (low, high)]
    return recorder.of("u")[:, at], recorder.of("contact")
