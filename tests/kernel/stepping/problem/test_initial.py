"""Accelerations and reactions of the first instant against the conditions that define them."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.stepping.problem import initial
from ssilang.kernel.stepping.problem.initial import (
    accelerated,
    closed_at_start,
    initial_energies,
    joint_state,
    with_contact,
)

COUNT, ROWS = 5, 4


@together("seed", range(6))
def test_what_touches_is_pushed_apart_or_opens(seed):
    """Reactions push, nothing accelerates through, and what opens is not pushed."""
    rng = np.random.default_rng(seed)
    bench = Bench()
    nodes = [bench.node(float(i), 0.0) for i in range(COUNT)]
    masses, loads = rng.uniform(1.0, 9.0, COUNT), rng.normal(size=COUNT)
    rows, senses = rng.normal(size=(ROWS, COUNT)), rng.choice([-1, 1], ROWS)
    rows[rng.random(rows.shape) < 0.4] = 0.0
    rows[:, 0] += 0.3
    for mass, node in zip(masses, nodes, strict=True):
        bench.mass(mass, node, ("UX",))
        bench.spring(1.0, node, unknown="UX")
    for row, sense in zip(rows, senses, strict=True):
        bench.relate([(c, "UX", n) for c, n in zip(row, nodes, strict=True) if c], int(sense))
    load = bench.load(bench.field(*((n, "FX", f) for n, f in zip(nodes, loads, strict=True))))
    problem = bench.problem(np.array([0.0, 0.1]), load)
    at = [problem.numbering.index_of(n, "UX") for n in nodes]
    free = np.zeros(len(problem.u))
    free[at] = loads / masses
    touching = closed_at_start(problem)
    a, pushing = with_contact(problem, problem.v, free, touching)
    signed = senses[:, None] * rows
    opens = signed @ a[at]
    assert touching.all()
    assert (pushing > 1e-9).any() == (signed @ free[at] < 0.0).any()
    assert pushing.min() >= 0.0
    assert opens.min() > -1e-9
    np.testing.assert_allclose(pushing * opens, 0.0, atol=1e-9)
    np.testing.assert_allclose(masses * a[at] - loads, signed.T @ pushing, atol=1e-9)
    still, none = with_contact(problem, problem.v, free, ~touching)
    assert (still is free, none.tolist()) == (True, [0.0] * ROWS)
    u, v = rng.normal(size=(2, len(problem.u)))
    pressed = replace(problem, u=u, contact_options=ContactOptions("PENALITE", 7.0))
    found = initial_energies(pressed, v, joint_state(pressed))
    stored = u[at] @ u[at] + 7.0 * (np.minimum(signed @ u[at], 0.0) ** 2).sum()
    np.testing.assert_allclose(found, [0.5 * masses @ v[at] ** 2, 0.5 * stored, 0, 0, 0, 0])
    rigid = replace(pressed, contact_options=ContactOptions("LAGRANGE", 7.0))
    assert initial_energies(rigid, v, joint_state(rigid))[1] == pytest.approx(0.5 * u[at] @ u[at])


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # of conjugate gradients on their way
def test_the_least_motion_is_taken_where_a_mass_is_singular(monkeypatch):
    """One mass on the sum of two motions; a motion has no mass where it leaves the sum alone."""
    bench = Bench()
    for i in range(6):
        bench.spring(1.0, bench.node(float(i), 0.0), unknown="UX")
    problem = bench.problem(np.array([0.0, 0.1]))
    M = np.diag([0.0, 0.0, 5.0, 0.0, 0.0, 0.0])
    M[np.ix_([0, 3], [0, 3])], M[np.ix_([1, 4], [1, 4])] = 4.0, [[1, -2], [-2, 4]]
    problem = replace(problem, M=sp.csr_array(M))
    forces = np.random.default_rng(3).normal(size=(6, 2))
    heavy = replace(problem, M=sp.csr_array(M + np.diag(np.arange(1.0, 7.0))))
    for some in (initial.SOME, 1):
        monkeypatch.setattr(initial, "SOME", some)
        for one in (problem, heavy):
            for force in (forces, forces[:, 0]):
                least = np.linalg.pinv(one.M.toarray()) @ force
                np.testing.assert_allclose(accelerated(one, force), least, atol=1e-12)
    monkeypatch.setattr(initial, "MANY", 1)
    with pytest.raises(KernelError):
        accelerated(problem, forces)
