"""Time stepping on modes: order of the schemes, energy, shocks and friction in closed form."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.modal import link_laws as law
from ssilang.kernel.modal.explicit import (
    SCHEMES,
    ModalProblem,
    ModalState,
    ModalSteps,
    integrate_modes,
)
from ssilang.kernel.modal.link_laws import plastic_force
from ssilang.kernel.modal.links import Link, link_arrays

ONE = np.eye(1)


def axis(n=1, i=0):
    rows = np.zeros((3, n))
    rows[0, i] = 1.0
    return rows


def run(M, C, K, q, v, h, steps, links=(), scheme="DE_VOGELAERE", force=None, every=1, **start):
    q, v = np.atleast_1d(np.array(q, float)), np.atleast_1d(np.array(v, float))
    n = len(q)
    spaces = np.zeros((0, n)) if force is None else np.eye(n)[:1]
    half = np.arange(2 * steps + 1) * 0.5 * h
    amplitudes = np.zeros((0, len(half))) if force is None else force(half)[None]
    state = ModalState(0.0, q, v, None, None, None)
    problem = ModalProblem(M, C, K, spaces, amplitudes, link_arrays(links, n))
    return integrate_modes(problem, state, ModalSteps(h, steps, every, scheme))


def error(scheme, steps, xi):
    w, T, v0 = 2.0, 2.0, 0.0 if scheme == "FOX_GOODWIN" else 0.5
    out = run(ONE, 2 * xi * w * ONE, w**2 * ONE, 1.0, v0, T / steps, steps, scheme=scheme)
    wd = w * np.sqrt(1.0 - xi**2)
    exact = np.exp(-xi * w * T) * (np.cos(wd * T) + (v0 + xi * w) / wd * np.sin(wd * T))
    return abs(out.values[-1, 0, 0] - exact)


@together(
    "scheme, xi, order",
    [(s, xi, 2) for s in SCHEMES[1:3] for xi in (0.0, 0.1)]
    + [("DE_VOGELAERE", 0.0, 4), ("DE_VOGELAERE", 0.1, 4), ("FOX_GOODWIN", 0.0, 4)],
)
def test_error_falls_with_the_order_of_the_scheme(scheme, xi, order):
    ratio = error(scheme, 40, xi) / error(scheme, 80, xi)
    assert 2 ** (order - 0.4) < ratio < 2 ** (order + 0.7)


@together("scheme", SCHEMES)
def test_work_of_forces_is_the_change_of_kinetic_energy(scheme):
    M, K = np.diag([1.0, 2.0]), np.array([[9.0, -1.0], [-1.0, 5.0]])
    out = run(M, 0.1 * K, K, [0.0, 0.1], [1.0, 0.0], 1e-3, 1000, scheme=scheme, force=np.cos)
    v = out.values[:, 1]
    kinetic = 0.5 * np.einsum("ti,ij,tj->t", v, M, v)
    np.testing.assert_allclose(out.values[:, 6:8].sum(axis=(1, 2)), kinetic - kinetic[0], atol=1e-5)


@together("scheme", SCHEMES)
def test_shock_gives_the_velocity_back(scheme):
    k, gap = 1e4, 0.01
    wall = Link(law.PLANE, axis(), axis(), {law.NX: 1.0, law.GAP: gap, law.STIFF: k})
    out = run(ONE, 0 * ONE, 0 * ONE, 0.0, 1.0, 1e-5, 6000, [wall], scheme)
    duration = np.pi / np.sqrt(k)
    assert np.count_nonzero(out.links[:, 0, law.FN]) * 1e-5 == pytest.approx(duration, rel=2e-3)
    assert out.links[:, 0, law.FN].min() == pytest.approx(-np.sqrt(k), rel=1e-4)
    assert out.values[-1, 1, 0] == pytest.approx(-1.0, rel=1e-3)


def test_circle_holds_a_point_inside_and_outside():
    inside = {law.NZ: 1.0, law.GAP: 0.1, law.STIFF: 1e5}
    rows = np.zeros((3, 2))
    rows[0, 0] = rows[1, 1] = 1.0
    out = run(np.eye(2), 0 * np.eye(2), 0 * np.eye(2), [0, 0.03], [1.0, 0.4], 1e-5, 60000,
              [Link(law.CIRCLE, rows, rows, inside)], every=100)  # fmt: skip
    q, v = out.values[:, 0], out.values[:, 1]
    assert np.hypot(*q.T).max() < 0.1 + 1.1 * np.sqrt(1.16 / 1e5)
    spin = q[:, 0] * v[:, 1] - q[:, 1] * v[:, 0]
    np.testing.assert_allclose(spin, spin[0], rtol=1e-6)  # a central force keeps it
    away = {**inside, law.OUTSIDE: 1.0, law.EX: 1.0}
    out = run(np.eye(2), 0 * np.eye(2), 0 * np.eye(2), [0, 0], [1.0, 0.0], 1e-4, 12000,
              [Link(law.CIRCLE, rows, rows, away)], every=10)  # fmt: skip
    assert out.values[:, 0, 0].max() == pytest.approx(0.9 + 1 / np.sqrt(1e5), rel=1e-3)


def pressed(stiffness, damping):
    """A mass of one on a plane, pressed by 10 N, sliding along y at 2 m/s."""
    rows = np.zeros((3, 2))
    rows[0, 0] = rows[1, 1] = 1.0
    numbers = {law.NX: 1.0, law.STIFF: 1e6, law.FRICTION: 1.0, law.SLIDE: 0.4, law.STICK: 0.5,
               law.TANGENT: stiffness, law.TANGENT_DAMP: damping}  # fmt: skip
    return run(np.eye(2), 0 * np.eye(2), 0 * np.eye(2), [1e-5, 0.0], [0.0, 2.0], 1e-5, 80000,
               [Link(law.PLANE, rows, rows, numbers)], every=100,
               force=lambda t: np.full(len(t), 10.0))  # fmt: skip


def test_friction_brings_a_sliding_mass_to_rest():
    out = pressed(1e6, 20.0)
    t, v = out.times, out.values[:, 1, 1]
    np.testing.assert_allclose(v[t < 0.3], (2.0 - 4.0 * t)[t < 0.3], atol=5e-3)
    assert abs(v[t > 0.7]).max() < 2e-2
    assert out.values[-1, 0, 1] == pytest.approx(2.0**2 / 8.0, rel=1e-2)


def test_regularised_friction_brings_it_to_rest_too():
    out = pressed(-1.0, 1e-2)
    assert out.values[-1, 0, 1] == pytest.approx(0.5, rel=1e-2)
    assert out.links[50, 0, law.WEAR] == pytest.approx(10.0 * out.values[50, 1, 1], rel=1e-3)


LAW = np.array([[0.0, 0.0], [1.0, 10.0], [3.0, 14.0], [5.0, 16.0]])


def path(points, **options):
    row, state = np.zeros(law.COLUMNS), np.zeros(law.STATES)
    for name, value in options.items():
        row[getattr(law, name)] = value
    return [plastic_force(x, row, LAW, len(LAW), state) for x in points]


def test_plastic_spring_follows_its_law_and_unloads_elastically():
    forces = path([0.5, 1.0, 2.0, 4.0, 3.9], PERMANENT=1.0)
    np.testing.assert_allclose(forces, [5.0, 10.0, 12.0, 15.0, 14.0], atol=1e-9)


def test_hardening_is_isotropic_or_kinematic_and_contact_does_not_pull():
    down = [3.0, 3.0 - 2.8]
    kin = path([3.0, 3.0 - 2.0 - 0.5], PERMANENT=1.0, KINEMATIC=1.0)
    assert path(down, PERMANENT=1.0)[1] == pytest.approx(-14.0)
    assert path([3.0, 0.2, 0.15], PERMANENT=1.0)[2] == pytest.approx(-14.05)  # slope 1 goes on
    assert kin[1] == pytest.approx(14.0 - 20.0 - 0.5 * 2.0)
    there_and_back = path([4.0, -4.0, 4.0, -4.0], PERMANENT=1.0, KINEMATIC=1.0)
    assert there_and_back == pytest.approx([15.0, -15.0, 15.0, -15.0])
    assert path([3.0, 0.0])[1] == 0.0


def test_link_acts_only_while_the_other_pushes():
    first = Link(law.PLANE, axis(2), axis(2), {law.NX: 1.0, law.STIFF: 1.0})
    pull = {law.FACTOR: 3.0, law.EXPONENT: 1.0}
    for wanted, mover in ((True, 1.0), (False, -1.0)):
        second = Link(law.POWER, axis(2, 1), axis(2), pull, conditions={0: wanted})
        free, both = (np.eye(2), 0 * np.eye(2), 0 * np.eye(2)), [first, second]
        still = run(*free, [-mover, 0], [0, 0], 0.1, 1, both)
        moved = run(*free, [mover, 0], [0, 0], 0.1, 1, both)
        assert still.values[0, 4, 1] == 0.0
        assert moved.values[0, 4, 1] == pytest.approx(3.0 * mover)


def test_run_goes_on_where_it_stopped():
    wall = Link(law.PLANE, axis(), axis(), {law.NX: 1.0, law.GAP: 0.2, law.STIFF: 50.0})
    whole = run(ONE, 0.1 * ONE, ONE, 0.0, 1.0, 0.01, 200, [wall])
    part = run(ONE, 0.1 * ONE, ONE, 0.0, 1.0, 0.01, 120, [wall])
    arrays = link_arrays([wall], 1)
    still = ModalProblem(ONE, 0.1 * ONE, ONE, np.zeros((0, 1)), np.zeros((0, 161)), arrays)
    for _ in range(2):  # what it goes on from stays as it is
        rest = integrate_modes(still, part.last, ModalSteps(0.01, 80))
    np.testing.assert_allclose(rest.values[:, :2], whole.values[120:, :2], atol=1e-12)
    assert rest.times[0] == pytest.approx(1.2)


@together("scheme", ["DE_VOGELAERE", "DIFFERENCES_CENTREES", "FOX_GOODWIN"])
def test_step_too_long_is_refused(scheme):
    with pytest.raises(KernelError, match="too long"):
        run(ONE, 0 * ONE, 100.0 * ONE, 1.0, 0.0, 0.3, 10, scheme=scheme)
    assert run(ONE, 0 * ONE, ONE, 1.0, 0.0, 0.3, 10, scheme=scheme).times[-1] == pytest.approx(3.0)
    with pytest.raises(KernelError, match="diverges"):  # driven, by short steps
        run(ONE, -20.0 * ONE, ONE, 1.0, 0.0, 0.01, 5000, scheme=scheme)


@together(
    "scheme, limit",
    [("DE_VOGELAERE", 8**0.5), ("DIFFERENCES_CENTREES", 2.0), ("FOX_GOODWIN", 6**0.5)],
)
@together("w", [0.05, 1.0, 40.0])
def test_the_longest_step_is_a_number_over_the_highest_frequency(scheme, limit, w):
    """Slow modes take long steps; the limits of the schemes for undamped oscillators."""
    stiffness = np.diag([w**2, 0.25 * w**2])
    both = (np.eye(2), np.zeros((2, 2)), stiffness, [1.0, 1.0], [0.0, 0.0])
    run(*both, 0.99 * limit / w, 5, scheme=scheme)
    with pytest.raises(KernelError, match="too long"):
        run(*both, 1.01 * limit / w, 5, scheme=scheme)
