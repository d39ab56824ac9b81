"""Steps with unilateral relations by multipliers: bodies that only they hold."""

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder
from together import together

from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.statics.stepping import step_statics

METHODS = ["LAGRANGE", "AUGMENTE", "UZAWA"]


@together("method", METHODS)
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
