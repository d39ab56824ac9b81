"""Bearings of isolated structures: closed forms of their loops, derivatives, turned axes."""

import math
from itertools import pairwise

import numpy as np
import pytest
from references.law_points import answer, energies, table_of
from scipy.integrate import solve_ivp
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode
from ssilang.kernel.interface.laws.law_table import LAWS

KN, KS, KPOS, QD = 1e9, 1.1e7, 1e6, 2e5
UY = QD / (KS - KPOS)
RADIUS, MU = 2.0, 0.06
LEAD = {"KN": KN, "KS1": KS, "KS2": KS, "QD": QD, "KPOS": KPOS, "ETA": 1.0, "BETA": 0.5}
BOWL = {"KN": KN, "KS1": KS, "KS2": KS, "RAYO": RADIUS, "FROT": MU}


def step(code, p, w, state):
    """Force, state and tangent at a jump."""
    t, new, D = answer(code, w, state, p)
    return t[0], new, D[0]


def along(code, p, path):
    """Forces on a path of jumps, and what was stored and lost at its end."""
    state, out = np.zeros((1, N_STATE)), []
    for w in path:
        t, state, _ = step(code, p, w, state)
        out.append(t)
    last = np.asarray(path[-1], float)
    return np.array(out), energies(int(code), last, out[-1], state[0], p[0])


def through(corners, n):
    return np.concatenate([np.linspace(a, b, n)[1:] for a, b in pairwise(corners)])


def plane(u, normal=0.0):
    return np.column_stack([u, np.full(len(u), normal)])


def test_core_yields_by_an_exponential_as_steps_grow_small():
    u = 3 * UY
    exact = KPOS * u + QD * (1 - math.exp(-u / UY))
    errors = []
    for n in (100, 200, 400):
        found = along(LawCode.LEAD, table_of(**LEAD), plane(np.linspace(0, u, n + 1)[1:]))[0]
        errors.append(abs(found[-1, 0] - exact) / QD)
        # backward Euler of dz = (1 - z) du / uy in closed form
        euler = 1 - (1 + u / UY / n) ** -n
        assert found[-1, 0] == pytest.approx(KPOS * u + QD * euler, rel=1e-12)
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.05)
    assert errors[1] / errors[2] == pytest.approx(2, rel=0.05)


def test_a_steady_loop_has_the_closed_form_of_bouc_and_wen():
    """beta 0.5: from -z1 at -a elastic up to z = 0, then 1 - exp: the loop's ends and area."""
    a, n = 5 * UY, 4000
    u = through(np.array([0, a, -a, a]), n)
    t, (stored, lost) = along(LawCode.LEAD, table_of(**LEAD), plane(u))
    z1 = t[-1, 0] / QD - KPOS * a / QD
    # one half cycle: z1 = 1 - exp(-(2 a - z1 uy) / uy)
    wanted = 1.0
    for _ in range(50):
        wanted = 1 - math.exp(-(2 * a - wanted * UY) / UY)
    assert z1 == pytest.approx(wanted, rel=1e-4)  # the error falls with a step of UY / 800
    loop = slice(2 * n - 3, None)
    area = np.sum(0.5 * (t[loop, 0][1:] + t[loop, 0][:-1]) * np.diff(u[loop]))
    # half a loop: z du up to 0 gives -z1^2 uy / 2, then the integral of 1 - exp
    reach = 2 * a - wanted * UY
    half = QD * (-(wanted**2) * UY / 2 + reach - UY * wanted)
    assert area == pytest.approx(half, rel=1e-3)
    assert stored > 0
    assert lost > 0


@pytest.mark.parametrize(("beta", "eta"), [(0.5, 1.0), (0.7, 1.0), (0.9, 2.0), (1.0, 3.5)])
def test_beta_is_that_of_wen_s_term_in_the_absolute_velocity(beta, eta):
    """Wen (1976): uy z' = u' - beta |u'| z |z|^(eta-1) - gamma u' |z|^eta, there and back."""
    gamma, corners = 1.0 - beta, UY * np.array([0.0, 2.5, -1.0, 0.7])
    z = 0.0
    for start, end in pairwise(corners):
        way = end - start

        def rate(_, z, way=way):
            size = np.abs(z)
            return (way - beta * abs(way) * z * size ** (eta - 1) - gamma * way * size**eta) / UY

        z = solve_ivp(rate, (0, 1), [z], rtol=1e-10, atol=1e-12).y[0, -1]
    path = plane(through(corners, 8_000))
    t, _ = along(LawCode.LEAD, table_of(**{**LEAD, "BETA": beta, "ETA": eta}), path)
    assert (t[-1, 0] - KPOS * corners[-1]) / QD == pytest.approx(z, abs=5e-4)


@together("code, given", [(LawCode.LEAD, LEAD), (LawCode.PENDULUM, BOWL)])
def test_axes_that_turn_do_not_matter(code, given):
    p, rng = table_of(**given), np.random.default_rng(1)
    path = np.cumsum(rng.normal(size=(40, 3)) * [UY, UY, 0], axis=0)
    path[:, 2] = -1e-4
    c, s = math.cos(0.7), math.sin(0.7)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    plain, turned = along(code, p, path)[0], along(code, p, path @ turn.T)[0]
    np.testing.assert_allclose(turned, plain @ turn.T, atol=1e-9 * np.abs(plain).max())


def test_a_plane_bearing_is_the_one_in_space_that_moves_along_one_axis():
    u = 3 * UY * np.sin(np.linspace(0, 6, 50))
    for code, given in ((LawCode.LEAD, LEAD), (LawCode.PENDULUM, BOWL)):
        flat = along(code, table_of(**given), plane(u, -1e-4))[0]
        space = along(code, table_of(**given), np.column_stack([u, 0 * u, np.full(50, -1e-4)]))[0]
        np.testing.assert_allclose(space[:, [0, 2]], flat, rtol=1e-12)


def test_a_slider_feels_its_bowl_and_friction_by_the_normal_force():
    """N u / R + mu N while it slides, the bowl alone where it does not slip, nothing lifted off."""
    u, press = 0.2, -1e-3
    path = [[u / 10 * i, press + (u / 10 * i) ** 2 / (2 * RADIUS)] for i in range(1, 11)]
    t, _ = along(LawCode.PENDULUM, table_of(**BOWL), path)
    force = -KN * press
    np.testing.assert_allclose(t[:, 1], -force, rtol=1e-12)
    u = np.array(path)[:, 0]
    np.testing.assert_allclose(t[:, 0], force * u / RADIUS + MU * force, rtol=1e-12)
    lifted, _ = along(LawCode.PENDULUM, table_of(**BOWL), [*path, [0.2, 0.02]])
    np.testing.assert_array_equal(lifted[-1], 0.0)


def test_a_bowl_without_friction_loses_nothing():
    p = table_of(**{**BOWL, "FROT": 0.0})
    corners = np.array([[0, 0, -1e-3], [0.2, 0.1, 0.01], [-0.1, 0.2, 0.05], [0, 0, -1e-3]])
    path = through(corners, 1000)
    t, (stored, lost) = along(LawCode.PENDULUM, p, path)
    mean, moved = 0.5 * (t[1:] + t[:-1]), np.diff(path, axis=0)
    assert lost == 0.0
    assert stored == pytest.approx(0.5 * KN * 1e-6)
    assert abs((mean * moved).sum()) < 1e-3 * np.abs(mean * moved).sum()


@together(
    "name, change, wrong",
    [
        ("APPUI_PLOMB", {"KPOS": 2 * KS}, "KPOS"),
        ("APPUI_PLOMB", {"QD": 0.0}, "QD"),
        ("APPUI_PLOMB", {"ETA": 0.5}, "ETA"),
        ("APPUI_PLOMB", {"BETA": 0.3}, "BETA"),
        ("APPUI_PLOMB", {"KS2": 0.5 * KS}, "KS2"),
        ("APPUI_PENDULE", {"RAYO": 0.0}, "RAYO"),
        ("APPUI_PENDULE", {"FROT": -1.0}, "FROT"),
    ],
)
def test_bearings_without_a_law_are_refused(name, change, wrong):
    given = LEAD if name == "APPUI_PLOMB" else BOWL
    check = LAWS[name].check
    check(table_of(**given))
    with pytest.raises(MaterialError) as caught:
        check(table_of(**{**given, **change}))
    assert caught.value.data["name"] == wrong
