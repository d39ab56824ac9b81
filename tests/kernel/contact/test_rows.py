"""Unilateral rows of a problem: their work, energies and multipliers from what these mean."""

from types import SimpleNamespace

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.rows import ContactRows
from ssilang.kernel.contact.solver import ContactForces
from ssilang.kernel.contact.unilateral import ContactOptions


def test_work_energies_and_multipliers_of_two_rows_that_push_elsewhere_and_rub():
    random = np.random.default_rng(5)
    G, D, H, watched = (sp.csr_array(random.normal(size=(m, 4))) for m in (2, 2, 3, 2))
    sense, imposed = np.array([1.0, -1.0]), random.normal(size=(2, 3))
    friction = SimpleNamespace(H=H, watched=watched, offset=np.array([0.5, -2.0]))
    rows = ContactRows(G, sense, np.arange(2), imposed, friction, D)  # type: ignore[arg-type]
    dc, u = random.normal(size=3), random.normal(size=4)
    forces = np.array([3.0, 0.0, 1.0, -2.0, 4.0])
    du = np.linalg.lstsq(G.toarray(), imposed @ dc, rcond=None)[0]
    np.testing.assert_allclose(rows.gaps(u + du, 2.0 * dc), rows.gaps(u, dc))  # they stay closed
    pushed = rows.pushing.T @ forces
    # what they do to the structure is what moving stops give and friction takes
    given = rows.work(forces, du, dc) - rows.rubbed(forces, du)
    assert pushed @ du == pytest.approx(given)
    assert rows.rubbed(forces, -du) == -rows.rubbed(forces, du) != 0.0
    assert rows.closed(forces).tolist() == [True, False]
    np.testing.assert_allclose((sense[:, None] * G).T @ rows.lagrange(forces), -G.T @ forces[:2])
    step = rows.at_rest(u, rows.gaps(u, dc)) + rows.seen @ du
    wanted = [rows.gaps(u + du, dc), H @ du, friction.offset + watched @ (u + du)]
    np.testing.assert_allclose(step, np.concatenate(wanted))
    assert rows.penalty_energy(np.array([-0.2, 0.3]), 5.0) == pytest.approx(0.1)
    assert rows.penalty_energy(np.array([-0.2, 0.3]), None) == 0.0


@together("slip, rubbed", [(1e-4, -0.4), (9e-4, -0.3 * 5.0)])
def test_a_penalty_stands_in_series_with_the_flexibility_below_a_place_that_rubs(slip, rubbed):
    """A gap that closes by 3e-3 on 1e-4 + 1 / 2 000; a slip that is held, and one that is not."""
    friction = SimpleNamespace(
        width=1, normal=np.zeros(1, int), coefficient=np.array([0.3]), constant=np.zeros(1)
    )

    class Place:
        def __len__(self):
            return 1

    place = Place()
    place.friction = friction
    forces = ContactForces(place, ContactOptions("PENALITE", 2e3))
    W = np.array([[1e-4, 0.0], [0.0, 2.5e-4], [0.0, 0.0]])  # the last: nothing is watched
    found = forces.held(W, np.array([-3e-3, slip, 0.0]))
    np.testing.assert_allclose(found, [5.0, rubbed], rtol=1e-9)
    assert W[0, 0] == 1e-4
