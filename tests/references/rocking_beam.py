"""A heavy beam on springs that only push."""

from dataclasses import replace

import numpy as np

from references.assembled import Bench
from ssilang.kernel.stepping.newmark import Scheme

COUNT = 14


def rocking(scheme: Scheme, steps: int = 1500):
    """A heavy beam on springs that only push, a mass above, shaken until its ends lift."""
    bench, feet = Bench(), []
    for x in np.linspace(-2.0, 2.0, COUNT):
        ground, foot = bench.node(x, -1.0), bench.node(x, 0.0)
        bench.fix(ground)
        bench.fix(foot, "UX")
        bench.mass(500.0, foot)
        bench.joint("SEG2", [ground, foot], "JOI1", KN=2e6, KS=0.0)
        bench.spring(1e4, foot, unknown="UY")
        if feet:
            bench.spring(5e7, feet[-1], foot, unknown="UY")
        feet.append(foot)
    weight = bench.field(*((n, "FY", -4905.0) for n in feet))
    arm = bench.field(
        *((n, "FY", 9e3 * x) for n, x in zip(feet, np.linspace(-1, 1, COUNT), strict=True))
    )
    times = 1e-3 * np.arange(steps + 1)
    shake = bench.load(arm, times, np.sin(11.0 * times) * np.minimum(times / 0.3, 1.0))
    load = bench.load(weight, times, np.ones(len(times)))
    return bench.problem(times, replace(load, parts=(*load.parts, *shake.parts)), scheme=scheme)
