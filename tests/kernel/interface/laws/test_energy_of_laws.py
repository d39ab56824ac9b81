"""Every law along irregular paths: work is what is stored and lost; bonded joints, outlines."""

import itertools

import numpy as np
import pytest
from references.law_points import energies, table_of
from together import together

from ssilang.kernel.interface.laws.columns import N_PARAMETERS, N_STATE, LawCode, Parameter
from ssilang.kernel.interface.laws.macro_law import outline_of
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.point_state import energies_of_points

FINE = 400
KN, KS = 3e8, 1.1e8
LAWS = {
    "elastic": (LawCode.ELASTIC, {}),
    "opens": (LawCode.SDM, {"FU": 0.0, "FC": 0.0, "FROT": -1.0}),
    "bonded": (LawCode.SDM, {"FU": 2e4, "GF": 15.0, "FC": -1e4, "FROT": -1.0}),
    "bonded, rubs": (LawCode.SDM, {"FU": 1e4, "GF": 20.0, "FC": -2e4, "FROT": 0.7}),
    "rubs": (LawCode.SDM, {"FU": 0.0, "FC": 0.0, "FROT": 0.4}),
    "Mohr": (LawCode.MOHR, {"TPHI": 0.6, "TPSI": 0.2, "COHE": 1e4, "FTRC": 5e3}),
    "Mohr, dilatant": (LawCode.MOHR, {"TPHI": 0.6, "TPSI": 0.5, "COHE": 5e4, "FTRC": 5e3}),
    "Mohr, crushed": (
        LawCode.MOHR,
        {"TPHI": 0.6, "TPSI": 0.4, "COHE": 1e4, "FTRC": 5e3, "FNE": 2e4, "QT": 0.3 * KN},
    ),
    "Mohr, two slopes": (LawCode.MOHR, {"TPHI": 0.5, "COHE": 1e4, "ECN": 6e-5, "EF": 2.5 * KN}),
    "lead": (LawCode.LEAD, {"QD": 3e4, "KPOS": 6e6, "ETA": 1.0, "BETA": 0.5}),
    "sharp lead": (LawCode.LEAD, {"QD": 3e4, "KPOS": 6e6, "ETA": 3.5, "BETA": 0.5}),
    "strip": (LawCode.STRIP, {"LARG": 0.8, "LONG": 0.5}),
    "slider": (LawCode.PENDULUM, {"RAYO": 2.0, "FROT": 0.06}),
}
# the shear of bonded faces falls to the cone at once where they come to be pressed
ALL = LAWS | {"bonded, rubs": (LawCode.SDM, {"FU": 2e4, "GF": 15.0, "FC": -1e4, "FROT": 0.7})}


def path_of(seed, d, pressed):
    """Opening and closing, sliding both ways, unequal along t1 and t2; or pressed all the time."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(-1.0, 1.0, (7, d)) * [*(4e-4, 1.7e-3)[: d - 1], 2.3e-4]
    corners[0] = 0.0
    corners[:, -1] -= 4e-5
    corners[0, -1] = 0.0
    if pressed:
        corners[1:, -1] = -1e-4
        corners[1, :-1] = 0.0
    part = np.linspace(0.0, 1.0, FINE + 1)[1:, None]
    return np.vstack([a + part * (b - a) for a, b in itertools.pairwise(corners)])


class Points:
    """Points of a law side by side: their states, tractions and energies after each jump."""

    def __init__(self, name, d, ratios=(0.4,)):
        code, given = ALL[name]
        n = len(ratios)
        self.codes = np.full(n, int(code))
        self.p = table_of(n, **{"KN": KN, "KS1": KS, "KS2": KS * np.array(ratios), **given})
        self.state, self.d = np.zeros((n, N_STATE)), d

    def to(self, w):
        """Tractions (n, d), energies stored and lost (2, n) at jumps (n, d)."""
        t, new = np.zeros(w.shape), np.zeros_like(self.state)
        respond(self.codes, w, self.state, self.p, t, new, np.zeros((*w.shape, self.d)))
        self.state = new
        return t, energies_of_points(self.codes, w, t, new, self.p)


@together("name, d", itertools.product(LAWS, [2, 3]), by=lambda case: case[0])
def test_work_is_stored_and_lost(name, d):
    """Of three points, each on a path of its own."""
    points = Points(name, d, (0.4, 2.2, 0.4))
    before, push = np.zeros((3, d)), np.zeros((3, d))
    work, moved, lost = np.zeros(3), np.zeros(3), np.zeros(3)
    for w in np.stack([path_of(seed, d, name == "slider") for seed in (1, 2, 3)], axis=1):
        t, (stored, gone) = points.to(w)
        done = 0.5 * np.vecdot(push + t, w - before)
        assert (gone >= lost - 1e-9 * moved).all()
        before, push, work, moved, lost = w, t, work + done, moved + abs(done), gone
    assert (abs(stored + lost - work) <= 3e-3 * moved).all()
    assert (moved > 0.0).all()


@together("d", [2, 3])
@together("name", ALL)
def test_the_same_jump_again_changes_nothing(name, d):
    """Whatever a large step did, on cones, caps and their edges at once: its end is admissible."""
    rng = np.random.default_rng(5)
    point = Points(name, d)
    for w in rng.uniform(-1.0, 1.0, (150, 1, d)) * [*(1e-3, 8e-4)[: d - 1], 3e-4]:
        t, energies = point.to(w)
        state = point.state
        again, same = point.to(w)
        np.testing.assert_allclose(again, t, atol=1e-9 * KN * 1e-3)
        np.testing.assert_allclose(point.state, state, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(same, energies, atol=1e-9 * KN * 1e-6)


@together("d", [2, 3])
@together("name", ALL)
def test_all_that_is_answered_is_written_and_the_tangent_is_its_slope(name, d):
    """Nothing of what stood there stays; slopes are compared where both sides agree."""
    point, codes = Points(name, d), np.array([int(ALL[name][0])] * 2)
    size = np.array([*(1e-3, 8e-4)[: d - 1], 3e-4])
    rng, compared = np.random.default_rng(8), 0

    def answers(w, fill):
        t, new, D = (np.full(s, fill) for s in ((2, d), (2, N_STATE), (2, d, d)))
        state = np.concatenate([0 * point.state, point.state])  # not the first of its table
        respond(codes, np.stack([0 * w, w]), state, np.repeat(point.p, 2, 0), t, new, D)
        return t[1], new[1], D[1]

    for w in rng.uniform(-1.0, 1.0, (60, d)) * size:
        clean, filled = answers(w, 0.0), answers(w, np.nan)
        for a, b in zip(clean, filled, strict=True):
            np.testing.assert_array_equal(a, b)
        h = 1e-6 * size
        slopes = np.zeros((2, d, d))
        for j in range(d):
            e = h * np.eye(d)[j]
            ends = answers(w + e, 0.0)[0], answers(w - e, 0.0)[0]
            slopes[:, :, j] = (ends[0] - clean[0]) / h[j], (clean[0] - ends[1]) / h[j]
        if np.abs(slopes[0] - slopes[1]).max() < 1e-4 * KN:
            np.testing.assert_allclose(clean[2], slopes.mean(axis=0), atol=1e-5 * KN)
            compared += 1
        point.to(w[None])
    assert compared > 25


@together("d", [2, 3])
def test_a_bonded_joint_is_its_springs(d):
    rng = np.random.default_rng(4)
    springs = {"KS1": 3e8, "KS2": 5e8, "KN": 7e8}
    p = np.zeros((20, N_PARAMETERS))
    for name, value in springs.items():
        p[:, Parameter[name]] = value
    k = np.array([3e8, 7e8] if d == 2 else [3e8, 5e8, 7e8])
    w = rng.uniform(-1e-3, 1e-3, (20, d))
    t, new, D = np.ones((20, d)), np.ones((20, N_STATE)), np.ones((20, d, d))
    state = np.zeros((20, N_STATE))
    respond(np.full(20, int(LawCode.ELASTIC)), w, state, p, t, new, D)
    np.testing.assert_allclose(t, k * w, rtol=1e-15)
    np.testing.assert_allclose(D, np.tile(np.diag(k), (20, 1, 1)), rtol=1e-15)
    np.testing.assert_array_equal(new, state)
    stored, lost = energies(int(LawCode.ELASTIC), w[0], t[0], new[0], p[0])
    assert stored == pytest.approx(0.5 * k @ w[0] ** 2, rel=1e-14)
    assert lost == 0.0


BED = 3e8
SHAPES = {
    "strip": (LawCode.STRIP, 2, {"LARG": 1.4}),
    "strip of a length": (LawCode.STRIP, 2, {"LARG": 1.4, "LONG": 3.0}),
    "rectangle": (LawCode.STRIP, 3, {"LARG": 1.4, "LONG": 3.0}),
    "disc": (LawCode.DISC, 3, {"RAYO": 0.8}),
    "springs": (LawCode.SPRINGS, 2, {"LARG": 1.4}),
}
AREAS = {"strip": 1.4, "strip of a length": 4.2, "rectangle": 4.2, "disc": np.pi * 0.64}


def places_of(name):
    """Equal parts of the base: places (n, d - 1) along t1 and t2."""
    s = (np.arange(400) + 0.5) / 200 - 1
    if name == "springs":
        return np.array([[-0.7], [0.7]])
    if name.startswith("strip"):
        return 0.7 * s[:, None]
    x, y = np.meshgrid(*((0.7 * s, 1.5 * s) if name == "rectangle" else (0.8 * s, 0.8 * s)))
    places = np.column_stack([x.ravel(), y.ravel()])
    return places if name == "rectangle" else places[np.hypot(*places.T) < 0.8]


@pytest.mark.parametrize("name", SHAPES)
def test_contact_pressure_and_opening_are_those_of_the_plane(name):
    code, d, given = SHAPES[name]
    p = np.zeros(N_PARAMETERS)
    for parameter, value in (given | {"KN": BED}).items():
        p[Parameter[parameter]] = value
    outline, places = outline_of(code, p, d), places_of(name)
    area = AREAS.get(name, 1.0)
    stiffness = 0.5 * BED if name == "springs" else BED / area
    assert outline.area == pytest.approx(area)
    assert outline.stiffness == pytest.approx(stiffness)
    w = np.random.default_rng(3).uniform(-1.0, 1.0, (40, d)) * [*(2e-3, 1e-3)[: d - 1], 1.5e-3]
    w[:6] = 0.0
    w[1, -1], w[2, -1], w[3, 0], w[4, -2] = 1e-3, -1e-3, 1e-3, -1e-3
    w[5, 0], w[5, -1] = 1e-3, 2e-4
    turns = w[:, :1] * places.T if d == 2 else w[:, :1] * places[:, 1] - w[:, 1:2] * places[:, 0]
    opened = w[:, -1:] + turns
    share = outline.share(w)
    np.testing.assert_allclose(share[1:], (opened < 0.0).mean(axis=1)[1:], atol=6e-3)
    assert np.ptp(share) == 1.0
    edge = 2e-5 if name != "springs" else 1e-15
    np.testing.assert_allclose(outline.opening(w), np.maximum(opened.max(axis=1), 0.0), atol=edge)
    pressed = stiffness * np.maximum(-opened.min(axis=1), 0.0)
    np.testing.assert_allclose(outline.pressure(w), pressed, atol=stiffness * edge)
