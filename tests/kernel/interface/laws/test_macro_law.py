"""Macro-elements of footings: against integrals over the bed, closed forms, free rocking."""

from functools import partial

import numpy as np
import pytest
from references import law_points
from references.assembled import Bench
from references.footing import Disc, Strip
from references.law_points import energies
from references.recorder import Recorder, recorded
from references.rocking import macro_element_period
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter
from ssilang.kernel.interface.laws.law_table import LAWS
from ssilang.kernel.interface.laws.macro_law import outline_of
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.statics.stepping import step_statics

STRIP, DISC, SPRINGS = 3, 4, 5
KN = 1e6
parameters = partial(law_points.table_of, KN=KN)


def answer(code, w, p):
    t, _, D = law_points.answer(code, w, np.zeros((1, N_STATE)), p)
    return t[0], D[0]


def bed(code, p, n=1201):
    """Places x, y of equal springs below a footing."""
    b, length, r = p[0, Parameter.LARG], p[0, Parameter.LONG], p[0, Parameter.RAYO]
    b1, b2 = (2 * r, 2 * r) if code == DISC else (b, length or 1.0)
    s = (np.arange(n) + 0.5) / n - 0.5
    x, y = (a.ravel() for a in np.meshgrid(s * b1, s * b2, indexing="ij"))
    if code == SPRINGS:
        return np.array([-0.5, 0.5]) * b, np.zeros(2)
    inside = x**2 + y**2 < r**2 if code == DISC else np.ones_like(x, bool)
    return x[inside], y[inside]


def openings(w, x, y):
    """How far footing and bed are apart at places, below 0 where they are pressed together."""
    return w[1] + w[0] * x if len(w) == 2 else w[2] + w[0] * y - w[1] * x


def bed_forces(code, w, p):
    """Forces by a fine grid of springs."""
    x, y = bed(code, p)
    u = KN / len(x) * np.minimum(openings(w, x, y), 0.0)
    levers = (x,) if len(w) == 2 else (y, -x)
    return np.array([*((u * lever).sum() for lever in levers), u.sum()])


CASES = [
    (STRIP, {"LARG": 4.0}, [[1e-3, -1e-3], [-1e-3, 2e-4], [1e-4, -1e-3], [1e-3, 3e-3]]),
    (DISC, {"RAYO": 2.0}, [[1e-3, -1e-3], [-1e-3, 2e-4], [1e-4, -1e-3], [1e-3, 3e-3]]),
    (DISC, {"RAYO": 2.0}, [[1e-3, 5e-4, -1e-3], [-4e-4, 1e-3, 3e-4], [1e-4, 0.0, -1e-3]]),
    (
        STRIP,
        {"LARG": 4.0, "LONG": 3.0},
        [[1e-3, 5e-4, -1e-3], [-4e-4, 1e-3, 3e-4], [1e-4, 0.0, -1e-3], [3e-3, -2e-3, 1e-3]],
    ),
]


@pytest.mark.parametrize(("code", "given", "jumps"), CASES)
def test_forces_are_those_of_the_bed(code, given, jumps):
    p = parameters(**given)
    for w in jumps:
        np.testing.assert_allclose(
            answer(code, w, p)[0], bed_forces(code, np.array(w), p), rtol=3e-3, atol=1.0
        )


WITH_SPRINGS = [*CASES, (SPRINGS, {"LARG": 3.0}, [*CASES[0][2], [0.0, 1e-3], [0.0, -1e-3]])]


@together("code, given, jumps", WITH_SPRINGS)
def test_what_is_told_of_a_footing_is_that_of_the_bed(code, given, jumps):
    """Share in contact, largest opening and pressure; turning both ways, pressed and lifted."""
    p = parameters(**given)
    x, y = bed(code, p, 601)
    for w in [s * np.array(w) for w in jumps for s in (1.0, -1.0)]:
        outline, u = outline_of(LawCode(code), p[0], len(w)), openings(w, x, y)
        area = {STRIP: 4.0 * given.get("LONG", 1.0), DISC: 4.0 * np.pi, SPRINGS: 2.0}[code]
        near = {"rel": 5e-3, "abs": 1e-6}
        assert outline.share(w) == pytest.approx((u < 0.0).mean(), abs=3e-3)
        assert outline.opening(w) == pytest.approx(max(u.max(), 0.0), **near)
        assert outline.pressure(w) == pytest.approx(KN / area * max(-u.min(), 0.0), **near)


@together("code, given, jumps", WITH_SPRINGS)
def test_tangent_and_energy(code, given, jumps):
    p = parameters(**given)
    for w in np.array(jumps, float):
        t, D = answer(code, w, p)
        h = 1e-9
        for j in range(len(w)):
            e = h * np.eye(len(w))[j]
            up, down = answer(code, w + e, p)[0], answer(code, w - e, p)[0]
            np.testing.assert_allclose((up - down) / (2 * h), D[:, j], rtol=1e-4, atol=20.0)
        energy = energies(code, w, t, np.zeros(N_STATE), p[0])[0]
        s = (np.arange(400) + 0.5) / 400
        work = sum(answer(code, x * w, p)[0] @ w for x in s) / 400
        assert energy == pytest.approx(work, rel=1e-5, abs=1e-9)


def footing(mode, law, element_nodes, **p):
    bench = Bench(mode)
    d = mode.dimension
    down = [0.0] * (d - 1) + [-1.0]
    soil, base = bench.node(*down), bench.node(*[0.0] * d)
    bench.fix(soil, *(("UX", "UY", "RZ") if d == 2 else ("UX", "UY", "UZ", "RX", "RY", "RZ")))
    bench.joint("SEG2", [soil, base], "JOI1", law=law, **p)
    return bench, base


def pushed(mode, law, turn, normal, theta, **p):
    """Moment about `turn` for imposed rotations theta under a constant weight."""
    bench, base = footing(mode, law, None, **p)
    vertical = "UY" if mode.dimension == 2 else "UZ"
    held = {2: ("UX",), 3: ("UX", "UY", "RZ", "RX" if turn == "RY" else "RY")}[mode.dimension]
    bench.fix(base, *held)
    row = bench.relate([(1.0, turn, base)])
    times = np.arange(len(theta), dtype=float)
    weight = LoadPart("MECA", bench.field((base, "F" + vertical[1], -normal)))
    one = NodeField.of(bench.table, np.array([row]), {"FLX": np.array([1.0])})
    curve = Curve((CurvePart(times, np.asarray(theta)),))
    recorder = Recorder(len(times))
    step_statics(bench.problem(times, Load((weight, LoadPart("DIMP", one, curve)))), [recorder])
    name = "M" + turn[1]
    return np.array([s.reactions.values_at(name, np.array([base]))[0] for s in recorder.snapshots])


RATIOS = np.array([0.0, 0.5, 1.5, 2.0, 5.0, 10.0])


@together("mode", [Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL])
def test_strip_and_disc_follow_their_closed_forms(mode):
    strip = Strip(4.0, 1.0, 2e7, 6e5)
    disc = Disc(2.0, 2e7, 6e5)
    turn = "RZ" if mode is Mode.PLANE_STRAIN else "RY"
    theta = RATIOS * strip.uplift_rotation
    long = {} if mode is Mode.PLANE_STRAIN else {"LONG": 1.0}
    # in 3D the frame's first axis is X: rotation about Y moves along X, the side LARG
    found = pushed(mode, "MACRO_SEMELLE", turn, 6e5, theta, KN=8e7, KS=1e8, LARG=4.0, **long)
    np.testing.assert_allclose(found[1:], strip.moment(theta)[1:], rtol=1e-10)
    theta = RATIOS * disc.uplift_rotation
    k = 2e7 * np.pi * 4.0
    found = pushed(mode, "MACRO_DISQUE", turn, 6e5, theta, KN=k, KS=1e8, RAYO=2.0)
    exact = np.array([disc.moment(x) for x in theta])
    np.testing.assert_allclose(found[1:], exact[1:], rtol=1e-10)


def test_turns_too_large_for_one_step_are_cut():
    """From far on one side to far on the other in one step, where Newton alone flies off."""
    strip = Strip(4.0, 1.0, 2e7, 6e5)
    theta = np.array([0.0, 5.0, 0.0, -10.0, 10.0, -0.5]) * strip.uplift_rotation
    found = pushed(Mode.PLANE_STRAIN, "MACRO_SEMELLE", "RZ", 6e5, theta, KN=8e7, KS=1e8, LARG=4.0)
    exact = np.sign(theta) * strip.moment(np.abs(theta))
    np.testing.assert_allclose(found[1:], exact[1:], rtol=1e-9, atol=1e-9 * strip.uplift_moment)


def test_two_springs_carry_a_constant_moment_once_lifted():
    theta = np.array([0.0, 1e-3, 0.05, 0.1])
    found = pushed(Mode.PLANE_STRAIN, "MACRO_RESSORTS", "RZ", 6e5, theta, KN=8e7, KS=1e8, LARG=3.0)
    assert found[1] == pytest.approx(8e7 * 1.5**2 * 1e-3)
    np.testing.assert_allclose(found[2:], 6e5 * 1.5, rtol=1e-10)


def test_free_rocking_period():
    strip, inertia, amplitude = Strip(4.0, 1.0, 2e7, 6e5), 5e5, 4e-3 * 3
    bench, base = footing(Mode.PLANE_STRAIN, "MACRO_SEMELLE", None, KN=8e7, KS=1e8, LARG=4.0)
    bench.fix(base, "UX")
    bench.mass(inertia, base, ("RZ",))
    bench.mass(1e-3, base, ("UY",))
    exact = macro_element_period(strip, inertia, amplitude)
    lift = float(strip.lift(np.array(amplitude)))
    times = np.linspace(0.0, 3 * exact, 6001)
    problem = bench.problem(
        times,
        bench.load(bench.field((base, "FY", -strip.normal))),
        displacement=bench.field((base, "RZ", amplitude), (base, "UY", lift)),
    )
    recorder, _ = recorded(problem)
    theta = recorder.of("u")[:, problem.numbering.index_of(base, "RZ")]
    down = np.flatnonzero((theta[:-1] > 0) & (theta[1:] <= 0))
    assert (times[down[2]] - times[down[0]]) / 2 == pytest.approx(exact, rel=1e-3)


def test_footing_without_a_size_is_refused():
    with pytest.raises(MaterialError, match="LONG"):
        pushed(
            Mode.THREE_DIMENSIONAL, "MACRO_SEMELLE", "RY", 1.0, [0.0, 1.0], KN=1.0, KS=1.0, LARG=1.0
        )


def test_rocking_in_full_contact_is_that_of_the_bed_below():
    """Turned a little while pressed, a footing answers as the integral of its springs does."""
    p = parameters(LARG=4.0, LONG=3.0, RAYO=2.0)
    for name, code in (("MACRO_SEMELLE", STRIP), ("MACRO_DISQUE", DISC)):
        about_1, about_2 = (float(k[0]) for k in LAWS[name].rocking(p))
        for axis, stiffness in ((0, about_1), (1, about_2)):
            w = np.array([0.0, 0.0, -1e-2])
            w[axis] = 1e-4
            assert bed_forces(code, w, p)[axis] == pytest.approx(1e-4 * stiffness, rel=3e-3)
    square = parameters(LARG=4.0)
    assert LAWS["MACRO_SEMELLE"].rocking(square)[0] == pytest.approx(KN * 16.0 / 12)
    # two springs of KN / 2 at LARG / 2 from the middle
    assert LAWS["MACRO_RESSORTS"].rocking(square)[1] == pytest.approx(KN * 2.0**2)
