"""Unilateral relations in time: velocity corrections, methods, modified mass."""

from types import SimpleNamespace

import numpy as np
import pytest
from references.assembled import Bench
from references.oscillators import MASS, STRUCTURE_STIFFNESS, ClubA
from references.recorder import recorded
from together import together

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.impact import ImpactRule
from ssilang.kernel.contact.modified_mass import without_contact_mass
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.solvers.active_set.contact_methods import METHODS


def club_a(steps: int, options: ContactOptions, duration: float = 0.4, **joint):
    """The oscillator above a rigid stop (a relation MINI, or a joint)."""
    bench = Bench()
    top = bench.node(0.0, 0.0)
    bench.spring(STRUCTURE_STIFFNESS, top, unknown="UX")
    bench.mass(MASS, top)
    bench.fix(top, "UY")
    if joint:
        soil = bench.node(-1.0, 0.0)
        bench.fix(soil)
        bench.joint("SEG2", [soil, top], "JOI1", KS=0.0, **joint)
    else:
        bench.relate([(1.0, "UX", top)], sense=1)
    dt = 0.1 / steps
    problem = bench.problem(
        np.arange(round(duration / dt) + 1) * dt,
        displacement=bench.field((top, "UX", 0.01)),
        contact_options=options,
    )
    recorder, history = recorded(problem)
    return problem.times, recorder.of("u")[:, problem.numbering.index_of(top, "UX")], history


def energies(history):
    return history.energies[:, :2].sum(axis=1)


def test_uncorrected_multipliers_gain_energy():
    _, _, history = club_a(101, ContactOptions())
    assert energies(history).max() > 1.2 * energies(history)[0]


@pytest.mark.parametrize("correction", ["MASSE", "RIGIDITE"])
def test_corrected_impact_keeps_the_energy_on_open_steps(correction):
    times, u, history = club_a(1009, ContactOptions(correction=correction))
    total = energies(history)
    opened = u > 1e-12
    np.testing.assert_allclose(total[opened], total[0], rtol=1e-10)
    exact, _ = ClubA().motion(times)
    assert np.abs(u - exact).max() < 0.1 * 0.01  # each impact comes late by less than a step


K, BY_MASS = 200 * STRUCTURE_STIFFNESS, ContactOptions(correction="MASSE")


@pytest.mark.parametrize(
    ("options", "other", "joint", "tolerance"),
    [
        (ContactOptions(correction="RIGIDITE"), BY_MASS, {}, 1e-10),
        (ContactOptions("AUGMENTE", correction="MASSE"), BY_MASS, {}, 1e-9),
        (ContactOptions("UZAWA", correction="MASSE"), BY_MASS, {}, 1e-9),
        (ContactOptions("PENALITE", K), ContactOptions(), {"KN": K}, 1e-12),  # 3e-13 found
    ],
)
def test_ways_to_the_same_motion_agree(options, other, joint, tolerance):
    """Both corrections of one degree of freedom, all methods, a joint and the penalty."""
    steps = 401 if joint else 211
    _, one, _ = club_a(steps, options)
    _, two, _ = club_a(steps, other, **joint)
    assert np.abs(one - two).max() < tolerance * 0.01


def test_resolved_joint_keeps_energy_where_an_unresolved_one_does_not():
    k = 1e4 * STRUCTURE_STIFFNESS
    contact_time = np.pi * np.sqrt(MASS / k)
    fine = int(np.ceil(0.1 / (contact_time / 32)))
    _, _, resolved = club_a(fine, ContactOptions(), KN=k)
    _, _, coarse = club_a(53, ContactOptions(), KN=k)
    drift = [np.abs(h.imbalance).max() / h.energies[0, 1] for h in (resolved, coarse)]
    assert drift[0] < 5e-3
    assert drift[1] > 0.5


def test_moving_stop_throws_the_mass_at_twice_its_speed():
    bench = Bench()
    body = bench.node(0.0, 0.0)
    bench.mass(2.0, body)
    bench.spring(1e-9, body, unknown="UX")
    bench.fix(body, "UY")
    row = bench.relate([(1.0, "UX", body)], sense=1)
    from ssilang.kernel.fields.node_field import NodeField

    imposed = NodeField.of(bench.table, np.array([row]), {"FLX": np.array([1.0])})
    load = bench.load(imposed, [0.0, 1.0], [-0.5005, 0.4995])
    problem = bench.problem(
        np.arange(101) * 0.01, load, contact_options=ContactOptions(correction="MASSE")
    )
    recorder, _ = recorded(problem)
    assert recorder.of("v")[-1, 0] == pytest.approx(2.0, rel=1e-6)


@together("method", list(METHODS))
def test_methods_on_a_random_contact_problem(method):
    rng = np.random.default_rng(2)
    A = rng.standard_normal((8, 8))
    W, q = A @ A.T / 8 + 0.2 * np.eye(8), rng.standard_normal(8)
    found = METHODS[method](W, q, 1e9 if method == "PENALITE" else None, None)
    gap = q + W @ found.p
    within = 1e-7 if method == "PENALITE" else 1e-11
    assert (gap > -within).all()
    assert np.abs(gap * found.p).max() < within * found.p.max()
    assert (found.p >= 0).all()
    assert (found.p > 0).sum() in range(1, 8)


def test_what_sticks_has_no_slip_and_the_smallest_change_of_the_mass_else():
    """The first and third of four places slide; two directions each, masses unlike."""
    random = np.random.default_rng(3)
    mass, H = random.uniform(1.0, 5.0, 12), random.normal(size=(8, 12))
    stick = np.array([False, True, False, True])
    rule = ImpactRule.__new__(ImpactRule)
    friction = SimpleNamespace(H=sp.csr_array(H), width=2)
    rule.contact = SimpleNamespace(friction=friction, sticking=lambda forces, u: stick)
    rule._slips = H.T / mass[:, None]
    rates = random.normal(size=(2, 12))
    motion = SimpleNamespace(u=None, contact=None, v=rates[0].copy(), a=rates[1].copy())
    rule._hold(motion)
    held = H[np.repeat(stick, 2)]
    for before, after in zip(rates, (motion.v, motion.a), strict=True):
        pushes = np.linalg.solve(held @ (held.T / mass[:, None]), held @ before)
        np.testing.assert_allclose(after, before - held.T @ pushes / mass, atol=1e-12)


def test_mass_is_taken_off_all_that_touches_and_goes_by_statics_to_its_neighbours():
    """A chain of springs whose second and fourth masses touch, and a mass that no spring holds."""
    k = np.array([3.0, 5.0, 2.0, 7.0])
    D = np.diff(np.eye(5, 6), axis=0)
    V = np.random.default_rng(1).random((6, 6))
    G = np.array([[0, 2.0, 0, 0, 0, 0], [0, -1.0, 0, 3.0, 0, 0], [0, 0, 0, 1.0, 0, 1.0]])
    T = np.eye(6)
    T[1] = np.array([k[0], 0, k[1], 0, 0, 0]) / (k[0] + k[1])
    T[3] = np.array([0, 0, k[2], 0, k[3], 0]) / (k[2] + k[3])
    given = (sp.csr_array(A) for A in (V @ V.T, D.T * k @ D, G))
    np.testing.assert_allclose(without_contact_mass(*given).toarray(), T.T @ V @ V.T @ T)
