"""A calculation that is ended and gone on with is the undisturbed one, to the last bit."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from references.awkward import Awkward
from references.keeper import Ending
from references.recorder import Recorder
from references.rocking_beam import rocking
from references.soil_block import soil_block

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.rows import FrictionRows
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.solvers.factor import Solver
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.stepping import choose
from ssilang.kernel.stepping.choose import only
from ssilang.kernel.stepping.keeping import digest_of, leaves, put_back, rebuilt, stride_of
from ssilang.kernel.stepping.newmark import Scheme, hht
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.run import integrate
from tests.kernel.contact.test_modal import feet
from tests.kernel.stepping.test_choose import masses

PARTS = ("u", "v", "a", "reaction", "w", "t", "state", "contact")
"""A block on 300 jumps and more: factors of the interface are changed, not made anew."""


def oscillator(scheme=None, joint=None, steps=200, push=0.0):
    """A mass on a spring and, if wished, a joint that opens."""
    bench = Bench()
    top = bench.node(0.0, 0.0)
    bench.fix(top, "UY")
    bench.spring(12e6, top, unknown="UX")
    bench.mass(3000.0, top)
    if joint is not None:
        soil = bench.node(-1.0, 0.0)
        bench.fix(soil)
        bench.joint("SEG2", [soil, top], "JOI1", KS=0.0, **joint)
    t = 1.3e-3 * np.arange(steps + 1)
    return bench.problem(
        t,
        bench.load(bench.field((top, "FX", push)), t, np.sin(31.0 * t)) if push else None,
        displacement=bench.field((top, "UX", 0.01)),
        scheme=scheme or Scheme(),
    )


def longer(problem: Problem, steps: int, kinds: int = 1) -> Problem:
    """A problem with more steps, of so many lengths in turn."""
    lengths = 1e-3 * (1.0 + 0.5 * (np.arange(steps) // 5 % kinds))
    return replace(problem, times=np.concatenate([[0.0], np.cumsum(lengths)]))


PENALTY = ContactOptions("PENALITE", 1e7)
CASES = {
    "one mode": ("modes", oscillator),
    "one mode on a joint": ("springs", lambda: oscillator(joint={"KN": 7e6}, push=3e4)),
    "modes, softening": (
        "modes", lambda: oscillator(hht(0.1), {"KN": 7e6, "FU": 2e4, "GF": 150.0}, push=3e4)
    ),
    "springs": ("springs", lambda: rocking(Scheme(), 300)),
    "springs, alpha": ("springs", lambda: rocking(hht(0.1), 300)),
    "modes": ("modes", lambda: longer(masses(3, shear=1e5), 200)),
    "modes, two lengths": ("modes", lambda: longer(masses(3, shear=1e5), 200, 2)),
    "modes of a block": ("modes", lambda: soil_block(90, size=(6, 3, 4))),
    "dashpots, six lengths": ("modes", lambda: longer(masses(3, dashpot=True), 90, 6)),
    "conserving": ("conserving", lambda: longer(masses(3, scheme=Scheme(conserving=True)), 90)),
    "conserving relations": ("conserving", lambda: feet(scheme=Scheme(conserving=True))),
    "conserving penalty": ("conserving", lambda: feet(PENALTY, Scheme(conserving=True))),
    "adaptive": ("adaptive", lambda: longer(masses(3, scheme=Scheme(adaptive=True)), 60)),
    "adaptive relations": ("adaptive", lambda: feet(scheme=Scheme(adaptive=True), steps=80)),
    "full Newton": ("full Newton", lambda: longer(masses(3), 60)),
    "full Newton on relations": ("full Newton", lambda: feet(steps=60)),
    "adaptive, zones of all laws": (
        "adaptive",
        lambda: replace(Awkward(3, tied=False).problem(), scheme=Scheme(adaptive=True)),
    ),
    "dissection, zones of all laws": (
        "dissection", lambda: Awkward(4, scheme=1, steps=90).problem()
    ),
    "conserving, zones of all laws": (
        "conserving", lambda: replace(Awkward(5).problem(), scheme=Scheme(conserving=True)),
    ),
    "relations on modes": ("relations on modes", feet),
    "penalty on modes": ("relations on modes", lambda: feet(PENALTY)),
    "relations": ("condensed", lambda: feet(damping="dashpots", moving=True)),
    "condensed": ("condensed", lambda: soil_block(steps=60, size=(16, 8, 4))),
    "multigrid": (
        "multigrid", lambda: replace(soil_block(45, size=(16, 8, 4)), solver=Solver("multigrid"))
    ),
    "dissection": ("dissection", lambda: soil_block(steps=140, size=(16, 8, 4))),
    "dissection, moving": ("dissection", lambda: soil_block(90, size=(16, 8, 4), moving=True)),
    "dissection, many jumps": ("dissection", lambda: soil_block(60, 5e-3, (100, 8, 80))),
}  # fmt: skip


def run(problem, keeper, full=False):
    """Energies, iterations and instants of a calculation; what came before it was ended."""
    recorder = Recorder(len(problem.times))
    try:
        history = integrate(problem, [recorder], full_newton=full, keeper=keeper)
    except KeyboardInterrupt:
        return None, recorder.snapshots
    return history, recorder.snapshots


def assert_same(history, snapshots, truth, others):
    assert np.array_equal(history.energies, truth.energies)
    assert (history.iterations, history.loop, history.solver) == (
        truth.iterations, truth.loop, truth.solver,
    )  # fmt: skip
    assert history.worst_imbalance == truth.worst_imbalance
    assert [s.step for s in snapshots] == [s.step for s in others]
    for name in PARTS:
        for a, b in zip(snapshots, others, strict=True):
            assert np.array_equal(getattr(a, name), getattr(b, name)), (name, a.step)


@pytest.mark.parametrize("case", CASES)
def test_going_on_leads_to_the_same_bits(case, tmp_path, monkeypatch):
    rule, make = CASES[case]
    rng, full = np.random.default_rng(sum(map(ord, case))), rule == "full Newton"
    if rule in ("dissection", "condensed"):
        monkeypatch.setattr(choose, "RULES", only(rule))
    steps = len(make().times) - 1
    stride = int(rng.integers(3, 40))
    truth, others = run(make(), Ending(tmp_path / "truth", stride), full)
    assert truth.loop == choose.only(rule)[0].loop
    snapshots, history, ended = [], None, 0
    ends = sorted(rng.integers(1, max(2, steps - stride), 2).tolist())  # it is ended twice
    for i, end in enumerate([*ends, None]):
        if history is None:  # else the end lay in its last steps
            keeper = Ending(tmp_path / "ended", stride, end, resume=i > 0)
            history, more = run(make(), keeper, full)
            snapshots += more
            ended += history is None
    assert_same(history, snapshots, truth, others)
    assert ended  # an end may lie in the last steps, which cannot be ended
    near, _ = run(make(), None, full)  # chunks of other lengths: other roundings
    size = np.abs(truth.energies).max()
    assert np.abs(near.energies - truth.energies).max() <= 1e-9 * size


def test_load_steps_of_joints_and_of_relations(tmp_path):
    def still(problem):
        return replace(problem, times=np.linspace(0.0, problem.times[-1], 20))

    for name, make in (("joints", lambda: still(soil_block(steps=20, size=(16, 8, 4)))),
                       ("relations", lambda: still(feet()))):  # fmt: skip

        def stepped(keeper, make=make):
            problem = make()
            recorder = Recorder(len(problem.times))
            try:
                history = step_statics(problem, [recorder], keeper=keeper)
            except KeyboardInterrupt:
                return None, recorder.snapshots
            return history, recorder.snapshots

        truth, others = stepped(Ending(tmp_path / f"{name} truth", 1))
        _, snapshots = stepped(Ending(tmp_path / name, 1, 7))
        assert [s.step for s in snapshots] == list(range(8))
        history, more = stepped(Ending(tmp_path / name, 1, resume=True))
        assert_same(history, snapshots + more, truth, others)


def test_a_stride_ends_at_multiples_of_both_lengths():
    ends, done = [], 0
    while done < 10000:
        done += stride_of(done, unknowns=500, every=1000)
        ends.append(done)
    assert ends == sorted({*range(1000, 10001, 1000), 4096, 8192})
    assert [stride_of(0, n) for n in (1, 10**4, 50_000, 10**5, 3 * 10**5)] == [4096, 256, 64, 16, 1]


def test_records_of_arrays_are_taken_apart_and_made_again():
    problem = masses(2)
    motion = (np.arange(3.0), (np.ones((2, 2)), 4.0), problem.scheme)
    values = leaves(motion)
    again = rebuilt(motion, values)
    assert again[2] == problem.scheme
    assert np.array_equal(again[1][0], motion[1][0])
    assert again[1][1] == 4.0
    motion[0][:] = 0.0
    put_back(motion, values)
    assert np.array_equal(motion[0], np.arange(3.0))


def test_a_digest_tells_every_number_that_steps_depend_on():
    problem = Awkward(3, unilateral=True).problem()
    row = sp.csr_array(np.ones((1, problem.numbering.size)))
    one = np.ones(1)
    rubs = FrictionRows(row, 1, np.array([0]), 0.3 * one, one, 2.0 * row, one)
    problem = replace(problem, contact=replace(problem.contact, friction=rubs))
    held, load, joints, stops = (
        problem.constraints, problem.loading, problem.interface, problem.contact,
    )  # fmt: skip
    held.D = held.D.copy()  # else those of C
    matrices = [problem.K, problem.M, problem.C, held.C, held.D, held.T, joints.J, stops.G,
                rubs.H, rubs.watched]  # fmt: skip
    arrays = [
        problem.numbering.nodes, problem.numbering.codes, load.forces, load.imposed,
        *(x for curve in load.curves for x in curve), problem.u, problem.v, problem.state,
        problem.times, joints.codes, joints.parameters, joints.weights, joints.B, stops.imposed,
        stops.sense, rubs.normal, rubs.coefficient, rubs.constant, rubs.offset,
        *(part for A in matrices for part in (A.data, A.indices, A.indptr)),
    ]  # fmt: skip
    known = digest_of(problem)
    for i, array in enumerate(arrays):
        for place in {0, array.size - 1}:
            was = array.flat[place]
            array.flat[place] = was + 1
            assert digest_of(problem) != known, (i, place)
            array.flat[place] = was
    assert digest_of(problem) == known
    for other in ({"scheme": hht(0.1)}, {"contact_options": PENALTY}):
        assert digest_of(replace(problem, **other)) != known
