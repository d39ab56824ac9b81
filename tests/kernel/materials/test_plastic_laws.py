"""Plastic laws at points: consistent tangents, admissible stresses, closed forms, tension tests."""

import math
from dataclasses import replace

import numpy as np
import pytest
from refusing import refusal
from scipy.optimize import brentq
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.materials.plastic import cone
from ssilang.kernel.materials.plastic.backbone import hardening_of
from ssilang.kernel.materials.plastic.held_stress import respond_held
from ssilang.kernel.materials.plastic.laws import (
    DAMAGE_LAWS,
    PLASTIC_LAWS,
    check_parameters,
    law_at,
)
from ssilang.kernel.materials.plastic.response import PointParameters, mises
from ssilang.kernel.plasticity.fibre_points import FibreGroup

M = 60
CURVE = Curve((CurvePart(np.array([0.0, 0.01, 0.1]), np.array([1.0, 2.0, 3.0])),))
GIVEN = {
    "PARFAIT": {"SIGY": 1},
    "ISOTROPE": {},
    "J2": {"SIG0": 1, "SIGI": 2, "KISO": 30, "VELO": 150},
    "CINEMATIQUE": {"SIGY": 1, "H": 100},
    "DRUCKER_PARFAIT": {"LTR": 1, "LCS": 5},
    "DRUCKER_PRAGER": {
        "ALFA": 0.3, "BETA": 1, "K": 1, "ETA": 0.6, "MU": 2, "KL": 4, "H": 50, "GAMM": 0.1,
        "DELT": 1,
    },
    "RH_COULOMB": {"COHE": 1, "PHI": 0.5},
    "IWAN": {},
    "IWAN_PRESSION": {"PREF": 2.0},
    "MAZARS": {
        "KTR0": 1e-3, "ATRA": 0.8, "BTRA": 300, "ACOM": 1.3, "BCOM": 150, "BETA": 1.06
    },
}  # fmt: skip
FIBRES = {
    "PARFAIT_UNI": {"SIGY": 2.0, "H": 100.0},
    "BETON_BAEL": {"FC": 2.0},
    "ACIER_UNI": {
        "STSY": 1, "STSU": 2, "EPSH": 2e-3, "EPSU": 0.02, "ROFA": 20, "BFAC": 0.02, "A1FA": 18,
        "A2FA": 0.15, "FALD": 8, "A6FA": 600, "CFAC": 0.5, "AFAC": 0.006,
    },
    "BETON_UNI": {
        "STFC": 2, "EZER": 4e-3, "STFT": 0.5, "ZETA": 100, "ST85": 0.4, "TRAF": 5, "ALF1": 0,
        "OME1": 0, "FAMX": -1,
    },
}  # fmt: skip
ALL = {**GIVEN, **FIBRES}
LAWS = {**PLASTIC_LAWS, **DAMAGE_LAWS}
SOIL = Curve((CurvePart(np.array([1e-3, 4e-3, 2e-2]), np.array([1.0, 0.7, 0.3])),))


def parameters(name: str, m: int = M) -> PointParameters:
    values = {"YOUN": 1000.0, "NU": 0.3, **ALL[name]}
    arrays = {n: np.full(m, float(v)) for n, v in values.items()}
    which = np.zeros(m, dtype=np.int64)
    return PointParameters(arrays, {"ECRO": ([CURVE], which), "GGAM": ([SOIL], which)})


def steps(seed: int) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    first = 2e-3 * random.normal(size=(M, 6))
    second = 4e-3 * random.normal(size=(M, 6))
    second[:, :3] += 2e-3 * random.normal(size=(M, 1))
    return first, second


HELD = ((), (2,), (1, 2, 3, 4, 5))


@together("name, held", [*((n, h) for n in GIVEN for h in HELD), *((n, ()) for n in FIBRES)])
def test_tangent_is_the_derivative_of_the_stress(name: str, held: tuple[int, ...]) -> None:
    p = parameters(name)
    law = law_at(LAWS[name], p)
    first, second = steps(3)
    blank = np.zeros((M, len(law.variables)))
    start, _ = respond_held(law, p, np.zeros((M, 6)), first, blank, held)
    after, _ = respond_held(law, p, start.stress, second, start.variables, held)
    if name in FIBRES:  # elastic here, yielding or open there
        assert np.ptp(after.tangent[:, 0, 0]) > 500.0
    else:
        assert (after.variables[:, 0] > start.variables[:, 0]).mean() > 0.2
    h = 1e-8
    for j in set(range(6)) - set(held):
        shift = np.zeros((M, 6))
        shift[:, j] = h
        ends = [
            respond_held(law, p, start.stress, second + s * shift, start.variables, held)[0].stress
            for s in (1, -1)
        ]
        # central differences at 1e-8 of stresses near 1 in moduli of 1000: 1e-8 relative
        wanted = (ends[0] - ends[1]) / (2 * h)
        assert np.abs(after.tangent[:, :, j] - wanted).max() < 1e-4
    if law.symmetric:
        turned = after.tangent.transpose(0, 2, 1)
        np.testing.assert_allclose(after.tangent, turned, atol=1e-9)


def test_every_law_of_solids_and_of_fibres_is_tested() -> None:
    elsewhere = {"CAM_CLAY"}  # has a test of its own: its elasticity is not that of YOUN and NU
    assert {*GIVEN, *FIBRES, *elsewhere, "SECTION"} == {*LAWS}


@together("strain, a, b", [(4e-3, 0.8, 300.0), (4e-3, -1.0, 300.0), (4e-3, -20.0, 6e-3),
                          (8e-3, -20.0, 6e-3), (-2e-2, 0.8, 300.0)])  # fmt: skip
def test_concrete_cracks_along_the_curves_of_mazars(strain: float, a: float, b: float) -> None:
    """Simple tension and compression by steps, then unloading: the secant of the damage."""
    p, law = parameters("MAZARS"), LAWS["MAZARS"]
    p = PointParameters({**p.values, "ATRA": np.full(M, a), "BTRA": np.full(M, b)}, {})
    state = np.zeros((M, 6)), np.zeros((M, 2))
    for _ in range(8):
        step = strain / 8 * np.eye(6)[[0] * M]
        found, _ = respond_held(law, p, state[0], step, state[1], (1, 2, 3, 4, 5))
        state = found.stress, found.variables
    k, e = 1e-3, strain if strain > 0 else -0.3 * math.sqrt(2) * strain
    if strain < 0:
        left = k * (1 - 1.3) / e + 1.3 * math.exp(150 * (k - e))
    elif a > 0:
        left = k * (1 - a) / e + a * math.exp(b * (k - e))
    else:
        left = k / e * (math.exp(b * (k - e)) if a > -10 else max(b - e, 0.0) / (b - k))
    assert np.abs(found.stress[:, 0] - 1e3 * strain * left).max() < 1e-6
    assert law.locked is not None
    energy = p.elastic_energy(found.stress) + law.locked(p, found.stress, found.variables)
    assert np.abs(energy - 500 * strain**2 * left).max() < 1e-9
    back, _ = respond_held(law, p, *state[:1], -step, state[1], (1, 2, 3, 4, 5))
    assert np.abs(back.stress[:, 0] * 8 / 7 - found.stress[:, 0]).max() < 1e-6
    np.testing.assert_array_equal(back.variables, state[1])  # none sinks


@together("size", [1.0, 1e3, 1e6])
def test_held_stresses_are_found_in_few_turns_however_far_it_flows(size: float) -> None:
    """Plane stress: what is left of a stress that returned from far is rounding of where it was."""
    p, turns = parameters("PARFAIT"), []
    law = replace(PLASTIC_LAWS["PARFAIT"], respond=lambda *a: turns.append(1) or perfect(*a))
    perfect, strain = PLASTIC_LAWS["PARFAIT"].respond, size * steps(3)[1]
    found, taken = respond_held(law, p, np.zeros((M, 6)), strain, np.zeros((M, 1)), (2,))
    assert len(turns) <= 16
    q = mises(found.stress)[0]
    # rounding of the elastic stress from which a point returns, in moduli of 1000
    assert np.abs(q[q > 0.9] - 1.0).max() <= 1e-12 * max(1.0, 1e3 * np.abs(taken).max())


@together("name", ["PARFAIT", "ISOTROPE", "J2", "DRUCKER_PRAGER"])
def test_flow_is_found_in_few_turns_however_little_it_is(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    law, p, turns = PLASTIC_LAWS[name], parameters(name), []
    assert law.cone is not None
    rows, strength = law.cone.rows(p), cone.strength_at.py_func
    given = rows.rows[rows.of[0]]
    alpha, beta = given[cone.ConeColumn.ALPHA], given[cone.ConeColumn.BETA]
    monkeypatch.setattr(cone, "strength_at", lambda *a: turns.append(1) or strength(*a))
    for size in np.logspace(-13, 1, 29):
        for before in np.linspace(0.0, 0.3, 23):
            q = (1.0 + size) * strength(rows, rows.of[0], before)[0] / (beta + 0.37 * alpha)
            count = len(turns)
            cone._multiplier.py_func(rows, rows.of[0], 0.37 * q, q, before, 1.1)
            assert len(turns) - count <= 12


@together("size", [10, 2e3])
@together("name", ["PARFAIT", "ISOTROPE", "DRUCKER_PARFAIT", "RH_COULOMB"])
def test_stress_is_admissible(name: str, size: float) -> None:
    law, p = PLASTIC_LAWS[name], parameters(name)
    first, second = steps(5)
    blank = np.zeros((M, len(law.variables)))
    start = law.respond(p, np.zeros((M, 6)), first, blank)
    found = law.respond(p, start.stress, size * second, start.variables)
    told = np.isfinite(found.stress).all(axis=1)  # NaN: not found, the step is cut
    assert told.mean() > (0.9 if size > 10 else 0.999)
    assert excess(name, p, found.stress[told], found.variables[told]).max() < 1e-9 * size


def excess(name: str, p: PointParameters, stress: np.ndarray, variables: np.ndarray) -> np.ndarray:
    """The yield functions, written again from their definitions."""
    q, _ = mises(stress)
    trace = stress[:, :3].sum(axis=1)
    if name == "PARFAIT":
        return q - 1
    if name == "ISOTROPE":
        return q - np.interp(variables[:, 0], [0, 0.01, 0.1], [1, 2, 3])
    if name == "DRUCKER_PARFAIT":
        return (4 / 6) * trace + q - 10 / 6
    tensors = stress[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)
    s = np.linalg.eigvalsh(tensors)
    phi = 0.5
    # the rounded surface lies inside Mohr and Coulomb's
    return (s[:, 2] - s[:, 0]) / 2 + (s[:, 2] + s[:, 0]) / 2 * np.sin(phi) - np.cos(phi)


def test_rounded_surface_meets_coulomb_away_from_edges_and_tip() -> None:
    law = PLASTIC_LAWS["RH_COULOMB"]
    p = parameters("RH_COULOMB", 1)
    strain = np.zeros((1, 6))
    strain[0, 3] = 0.5  # shear, from a strong pressure: Lode's angle near 0, far from the tip
    pressure = np.zeros((1, 6))
    pressure[0, :3] = -50.0
    found = law.respond(p, pressure, strain, np.zeros((1, 1)))
    q = np.linalg.eigvalsh(found.stress[0, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(3, 3))
    value = (q[2] - q[0]) / 2 + (q[2] + q[0]) / 2 * np.sin(0.5)
    assert value == pytest.approx(np.cos(0.5), abs=2e-3)  # the tip's hyperbola, at 50 cohesions


@together("most", [1.0, 8.0])
def test_parts_of_a_step_are_those_of_so_many_steps(most: float) -> None:
    """One local iteration does for no part that flows: all are as short as they may be."""
    p = parameters("RH_COULOMB")
    once = PLASTIC_LAWS["RH_COULOMB"]
    p.values.update({n: np.full(M, v) for n, v in (("NSUB", most), ("NITE", 1.0))})
    law, (first, _) = law_at(once, p), steps(7)
    stress, variables = np.zeros((M, 6)), np.zeros((M, 1))
    for _ in range(int(most)):
        part = once.respond(p, stress, 3 * first / most, variables)
        stress, variables = part.stress, part.variables
    blank = np.zeros((M, len(law.variables)))
    found = law.respond(p, np.zeros((M, 6)), 3 * first, blank)
    np.testing.assert_allclose(found.stress, stress, atol=1e-9)
    np.testing.assert_allclose(found.variables[:, 0], variables[:, 0], atol=1e-12)
    moved = law.respond(p, np.zeros((M, 6)), 3 * first + 1e-7 * np.eye(6)[0], blank)
    slope = (moved.stress - found.stress) / 1e-7
    np.testing.assert_allclose(found.tangent[:, :, 0], slope, atol=0.1)


def uniaxial(name: str, path: list[float], young: float = 1000.0) -> list[float]:
    """Stresses of a bar along a path of strains."""
    law, p = PLASTIC_LAWS[name], parameters(name, 1)
    p.values["YOUN"][:] = young
    stress, variables, last, out = np.zeros((1, 6)), np.zeros((1, len(law.variables))), 0.0, []
    for strain in path:
        step = np.zeros((1, 6))
        step[0, 0] = strain - last
        answer, _ = respond_held(law, p, stress, step, variables, (1, 2, 3, 4, 5))
        stress, variables, last = answer.stress, answer.variables, strain
        out.append(float(stress[0, 0]))
    return out


def test_perfect_bar_cycles_between_its_limits() -> None:
    found = uniaxial("PARFAIT", [0.0005, 0.01, 0.009, -0.01, 0.0])
    assert found == pytest.approx([0.5, 1.0, 0.0, -1.0, 1.0])


def test_kinematic_bar_keeps_twice_its_limit_between_yields() -> None:
    # E = 1000, H = 100: slope E H / (E + H) beyond yield; yield again 2 SIGY below
    slope = 1000 * 100 / 1100
    top = 1 + slope * (0.011 - 0.001)
    found = uniaxial("CINEMATIQUE", [0.011, 0.010, 0.009, 0.0])
    bottom = top - 2 - slope * (0.009 - 0.0)
    assert found == pytest.approx([top, top - 1, top - 2, bottom])


def test_isotropic_bar_follows_its_curve_and_grows_both_ways() -> None:
    strain = 0.005 + 1.5 / 1000  # plastic strain 0.005 on the first branch: stress 1.5
    found = uniaxial("ISOTROPE", [strain, strain - 3e-3, strain - 3e-3 - 0.005 - 0.5e-3])
    assert found == pytest.approx([1.5, -1.5, -2.0])


def test_saturating_bar_follows_simo_and_hughes_and_grows_both_ways() -> None:
    def strength(p: float) -> float:
        return 1.0 + 30.0 * p + (2.0 - 1.0) * (1.0 - math.exp(-150.0 * p))

    first = brentq(lambda p: strength(p) - 1000.0 * (0.012 - p), 0.0, 0.012)
    second = brentq(lambda p: -strength(p) - 1000.0 * (-0.008 - (2 * first - p)), first, 0.05)
    found = uniaxial("J2", [0.0005, 0.012, -0.008])
    assert found == pytest.approx([0.5, strength(first), -strength(second)], rel=1e-9)


def test_a_saturation_that_sinks_is_refused_and_none_that_never_comes() -> None:
    given = parameters("J2", 1)
    sinking = PointParameters({**given.values, "SIGI": np.array([0.0])}, given.curves)
    with refusal(MaterialError, "kernel.materials.saturation-sinks"):
        check_parameters(PLASTIC_LAWS["J2"], sinking)
    check_parameters(
        PLASTIC_LAWS["J2"], replace(sinking, values={**sinking.values, "VELO": np.zeros(1)})
    )


def test_drucker_bar_has_the_strengths_given() -> None:
    assert uniaxial("DRUCKER_PARFAIT", [0.004]) == pytest.approx([1.0])
    assert uniaxial("DRUCKER_PARFAIT", [-0.04]) == pytest.approx([-5.0])


def test_pure_tension_ends_at_the_tip_of_the_cone() -> None:
    law, p = PLASTIC_LAWS["DRUCKER_PARFAIT"], parameters("DRUCKER_PARFAIT", 1)
    strain = np.array([[0.01, 0.01, 0.011, 0.0, 0.0, 0.0]])
    found = law.respond(p, np.zeros((1, 6)), strain, np.zeros((1, 1)))
    tip = (10 / 6) / (4 / 6) / 3
    assert found.stress[0] == pytest.approx([tip, tip, tip, 0, 0, 0])


@together(
    "slope, limit, wanted",
    [(0, 3.0, 3.0), (0, 9.0, 4.1), (2.0, 3.0, 3.0), (-90.0, 3.0, 3.0), (-90.0, 4.1, 0.0)],
)
def test_drucker_cone_ends_at_the_ultimate_one(slope: float, limit: float, wanted: float) -> None:
    """Equal strain in a plane under zero stress across: s = strength / (2 alpha + beta)."""
    given = {"ALFA": 0.4, "BETA": 1, "K": 4.1, "ETA": 0.4, "MU": 1, "KL": limit, "H": slope,
             "GAMM": 0.4, "DELT": 1, "YOUN": 1e3, "NU": 0.2}  # fmt: skip
    p = PointParameters({n: np.full(1, float(v)) for n, v in given.items()}, {})
    strain = np.array([[0.1, 0.1, 0.0, 0.0, 0.0, 0.0]])
    law = PLASTIC_LAWS["DRUCKER_PRAGER"]
    found, _ = respond_held(law, p, np.zeros((1, 6)), strain, np.zeros((1, 1)), (2,))
    assert found.stress[0, :2] == pytest.approx(wanted / 1.8, rel=1e-12)


@together("share", [0.6, 0.99, 1.01, 1.6])
@together("delta", [0.4, 1.0, 2.5])
def test_flow_along_its_own_cone_ends_at_the_tip_only_where_the_deviator_is_used_up(
    delta: float, share: float
) -> None:
    """One step without hardening: `x = f / (3 G beta delta + 9 B alpha gamma)`, and the deviator
    falls by `3 G delta x`: by `share` of what it was."""
    alpha, beta, strength, gamma = 0.3, 1.2, 2.0, 0.2
    given = {"ALFA": alpha, "BETA": beta, "K": strength, "ETA": alpha, "MU": beta, "KL": strength,
             "H": 0, "GAMM": gamma, "DELT": delta, "YOUN": 1e3, "NU": 0.25}  # fmt: skip
    p = PointParameters({n: np.full(1, float(v)) for n, v in given.items()}, {})
    shear, bulk = 400.0, 1000 / 1.5
    q = 3.0
    x = share * q / (3 * shear * delta)
    over = x * (3 * shear * beta * delta + 9 * bulk * alpha * gamma)
    trace = (over + strength - beta * q) / alpha
    # q of shear alone is sqrt(3) s, s = G g
    strain = np.array([[*[trace / (9 * bulk)] * 3, q / np.sqrt(3) / shear, 0.0, 0.0]])
    found = PLASTIC_LAWS["DRUCKER_PRAGER"].respond(p, np.zeros((1, 6)), strain, np.zeros((1, 1)))
    stress = found.stress[0]
    if share < 1:
        assert stress[:3].sum() == pytest.approx(trace - 9 * bulk * gamma * x, rel=1e-12)
        assert np.sqrt(3) * stress[3] == pytest.approx((1 - share) * q, rel=1e-11)
        assert found.variables[0, 0] == pytest.approx(x * np.sqrt(delta**2 + 2 * gamma**2))
    else:
        assert stress == pytest.approx([*[strength / alpha / 3] * 3, 0, 0, 0], abs=1e-12)


def test_concrete_unloads_and_loads_again_along_its_first_slope() -> None:
    """Parabola FC x (2 - x), x = -e / 0.002; what it left behind stays while it is unloaded."""
    E, path = 2000.0, [-1e-3, -0.9e-3, -0.95e-3, 1e-4, -0.5e-3, -3e-3, -2.5e-3, -2.1e-3]
    found = uniaxial("BETON_BAEL", path, E)
    left = -1e-3 + 1.5 / E  # the peak of the first loading is FC 0.5 1.5 = 1.5
    wanted = [-1.5, -1.5 + E * 1e-4, -1.5 + E * 0.5e-4, 0.0, E * (-0.5e-3 - left), -2.0]
    wanted += [-2.0 + E * 0.5e-3, -2.0 + E * 0.9e-3]
    assert found == pytest.approx(wanted, abs=1e-12)


@together("name", ["RH_COULOMB", "PARFAIT", "IWAN"])
def test_cumulated_strain_is_the_norm_of_the_plastic_tensor(name: str) -> None:
    """EPSE grows by sqrt(2/3 ep : ep), all six components counted as a tensor's."""
    p = parameters(name)
    law = law_at(LAWS[name], p)
    first, _ = steps(7)
    blank = np.zeros((M, len(law.variables)))
    after = law.respond(p, np.zeros((M, 6)), 3 * first, blank)
    E, nu = 1000.0, 0.3
    s = after.stress
    elastic = (1 + nu) / E * s
    elastic[:, :3] -= nu / E * s[:, :3].sum(axis=1, keepdims=True)
    elastic[:, 3:] *= 2.0  # engineering shears
    plastic = 3 * first - elastic
    tensor = np.zeros((M, 3, 3))
    for k, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]):
        tensor[:, i, j] = tensor[:, j, i] = plastic[:, k] * (1.0 if i == j else 0.5)
    wanted = np.sqrt(2 / 3 * np.einsum("mij,mij->m", tensor, tensor))
    assert (wanted > 1e-4).mean() > 0.5
    np.testing.assert_allclose(after.variables[:, 0], wanted, rtol=1e-6, atol=1e-12)


OTHER_CURVE = Curve((CurvePart(np.array([0.0, 0.004, 0.05]), np.array([1.5, 1.9, 4.0])),))
OTHER_SOIL = Curve((CurvePart(np.array([5e-4, 3e-3, 1e-2]), np.array([1.0, 0.8, 0.5])),))


def unlike(name: str, m: int) -> PointParameters:
    """Points of which each has its own parameters, and one of two curves, in no order."""
    random = np.random.default_rng(11)
    values = {"YOUN": 1000.0, "NU": 0.3, **ALL[name]}
    arrays = {n: float(v) * random.uniform(0.95, 1.05, m) for n, v in values.items()}
    which = np.array([1, 0, 0, 1, 0] * m)[:m]
    # all points of nested surfaces have as many
    soils = [SOIL, OTHER_SOIL]
    return PointParameters(arrays, {"ECRO": ([CURVE, OTHER_CURVE], which), "GGAM": (soils, which)})


@together("name", list(ALL))
def test_points_have_each_their_own_answer(name: str) -> None:
    m = 7
    p = unlike(name, m)
    law = law_at(LAWS[name], p)
    stress, variables = np.zeros((m, 6)), np.zeros((m, len(law.variables)))
    alone = [(np.zeros((1, 6)), variables[:1])] * m
    for step in (*steps(7), *steps(8)):
        given = (stress, step[:m], variables)
        kept = [x.copy() for x in given]
        found = law.respond(p, *given)
        for x, before in zip(given, kept, strict=True):
            np.testing.assert_array_equal(x, before)
        if name in FIBRES:  # elastic shear beside them, nothing else
            sheared = stress[:, 3:5] + p.values["YOUN"][:, None] / 2.0 / (
                1.0 + p.values["NU"][:, None]) * step[:m, 3:5]  # fmt: skip
            np.testing.assert_allclose(found.stress[:, 3:5], sheared, rtol=1e-12)
            assert not found.stress[:, [1, 2, 5]].any()
        for i in range(m):
            one = p.at(np.array([i]))
            alike = law_at(LAWS[name], one)
            own = alike.respond(one, alone[i][0], step[i : i + 1], alone[i][1])
            alone[i] = (own.stress, own.variables)
            np.testing.assert_allclose(found.stress[i], own.stress[0], rtol=1e-9, atol=1e-12)
            np.testing.assert_allclose(found.variables[i], own.variables[0], rtol=1e-9, atol=1e-12)
            np.testing.assert_allclose(found.tangent[i], own.tangent[0], rtol=1e-6, atol=1e-6)
        stress, variables = found.stress, found.variables
    assert (variables[:, 0] != 0).any()


@pytest.mark.parametrize("name", list(GIVEN))
def test_work_is_stored_or_lost_and_never_won(name: str) -> None:
    """Elastic and locked energy grow by no more than the work, at each fine step of any path."""
    m, fine = 20, 60
    p = unlike(name, m)
    law = law_at(LAWS[name], p)
    stress, variables = np.zeros((m, 6)), np.zeros((m, len(law.variables)))

    def stored() -> np.ndarray:
        own = p.elastic_energy(stress)
        return own if law.locked is None else own + law.locked(p, stress, variables)

    before, lost, moved = stored(), np.zeros(m), np.zeros(m)
    for step in (*steps(1), *(-1.4 * s for s in steps(2)), *steps(4)):
        step = step[:m]
        for _ in range(fine):
            found = law.respond(p, stress, step / fine, variables)
            work = 0.5 * np.vecdot(found.stress + stress, step / fine)
            stress, variables = found.stress, found.variables
            after = stored()
            gone = work - (after - before)
            moved += np.abs(work)
            assert (gone >= -2e-4 * moved - 1e-12).all()
            before, lost = after, lost + gone
    assert (lost > 0.05 * moved).mean() > 0.3


def test_fibres_yield_by_the_shear_that_they_have_a_share_of() -> None:
    """Far beyond yield along y they stay elastic: of that shear no part is theirs."""
    values = {"YOUN": np.full(1, 200.0), "NU": np.full(1, 0.25), "SIGY": np.ones(1)}
    law, shares = PLASTIC_LAWS["PARFAIT"], np.array([[0.0, 0.5]])
    group = FibreGroup(None, law, PointParameters(values, {}), shares)  # type: ignore[arg-type]
    strain = np.array([[[2e-3, 0, 0, 1.0, 3e-3, 0]]])
    blank = np.zeros((1, 1, len(law.variables)))
    after, _, tangent = group.respond(np.zeros((1, 1, 6)), strain, blank)
    assert after[0, 0] == pytest.approx([0.4, 0, 0, 0, 0.5 * 80.0 * 3e-3, 0], abs=1e-12)
    slopes = np.diag([200.0, 0, 0, 0, 0.5 * 80.0, 0])
    np.testing.assert_allclose(tangent[0, 0], slopes, atol=1e-12)
    along = group.along(np.full(1, 0.1), np.full(1, 2e-3), blank[0])
    assert (along.stress[0], along.slope[0]) == pytest.approx((0.5, 200.0))


def tension(strain, stress):
    return Curve((CurvePart(np.array(strain, float), np.array(stress, float)),))


def test_plastic_strain_is_total_less_elastic():
    """YOUN 200: at the strain 0.05 under 6 the elastic part is 0.03."""
    (found,) = hardening_of(tension([0, 0.02, 0.05, 0.1], [0, 4.0, 6.0, 6.0]), 200.0).parts
    np.testing.assert_allclose(found.abscissas, [0.0, 0.02, 0.07], atol=1e-15)
    np.testing.assert_allclose(found.ordinates, [4.0, 6.0, 6.0])


@together("slope", [198.1, 201.9])
def test_a_first_slope_within_a_hundredth_of_youn_is_taken(slope):
    (found,) = hardening_of(tension([0, 0.02, 0.05], [0, 0.02 * slope, 5.0]), 200.0).parts
    assert found.abscissas[0] == 0.0


@together(
    "strain, stress, code",
    [
        ([0.01, 0.02], [0.0, 4.0], "trac-begins-zero-stress"),
        ([0.0, 0.02], [1.0, 4.0], "trac-begins-zero-stress"),
        ([0.0], [0.0], "trac-begins-zero-stress"),
        ([0.0, 0.0], [0.0, 4.0], "trac-begins-zero-stress"),
        ([0.0, 0.02], [0.0, 0.02 * 197.0], "first-slope-trac-youn"),
        ([0.0, 0.02], [0.0, 0.02 * 203.0], "first-slope-trac-youn"),
        ([0.0, 0.02, 0.03], [0.0, 4.0, 6.1], "trac-rises-more-youn"),
    ],
)
def test_other_curves_are_refused(strain, stress, code):
    with pytest.raises(MaterialError, check=lambda e: e.code == f"kernel.materials.{code}"):
        hardening_of(tension(strain, stress), 200.0)
