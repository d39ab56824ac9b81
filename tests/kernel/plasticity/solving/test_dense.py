"""Small models with dense matrices against the same steps with sparse ones."""

from pathlib import Path

import numpy as np
import pytest
from references.keeper import Ending
from references.tower_on_clay import stepped_tower

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.plasticity import run
from ssilang.kernel.plasticity.solving import dense
from ssilang.kernel.plasticity.solving.dense import places_of
from ssilang.kernel.plasticity.solving.positive import Pattern

STEPS = 40


def stepped(law: str = "J2", keeper=None):
    """History, displacements and energies of a tower of one cell's width on clay."""
    history, seen, strain = stepped_tower(law, STEPS, 1, keeper)
    return history, seen.of("u"), strain


@pytest.mark.parametrize("law", ["J2", "CINEMATIQUE", "DRUCKER_PRAGER"])
def test_dense_matrices_lead_to_the_same_steps(law: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Compiled laws on one side, arrays of all points on the other."""
    history, u, strain = stepped(law)
    assert history.solver == "LAPACK"
    assert np.mean(strain > 0) > 0.1
    monkeypatch.setattr(dense, "FEW", 0)
    monkeypatch.setattr(run, "WORTH", 10**9)
    monkeypatch.setattr(run._BulkLoop, "_guess", lambda self, dt: None)
    sparse, expected, strains = stepped(law)
    assert sparse.solver == "SuperLU"
    assert history.iterations <= sparse.iterations
    assert np.abs(u - expected).max() <= 1e-8 * np.abs(expected).max()
    assert np.abs(strain - strains).max() <= 1e-8 * strains.max()
    assert np.abs(history.energies - sparse.energies).max() <= 1e-8 * sparse.energies.max()


def test_a_run_that_was_ended_goes_on_to_the_last_bit(tmp_path: Path) -> None:
    whole = stepped()
    with pytest.raises(KeyboardInterrupt):
        stepped(keeper=Ending(tmp_path, 4, 12))
    resumed = stepped(keeper=Ending(tmp_path, 4, resume=True))
    assert np.array_equal(resumed[0].energies, whole[0].energies)
    assert np.array_equal(resumed[1][-12:], whole[1][-12:])
    assert np.array_equal(resumed[2], whole[2])


def test_terms_go_where_the_conditions_put_them() -> None:
    rng = np.random.default_rng(5)
    K = sp.csr_array(sp.random_array((9, 9), density=0.5, rng=rng))
    V, T = (sp.csr_array(sp.random_array((9, 5), density=0.4, rng=rng)) for _ in range(2))
    K.sort_indices()
    placed = places_of(Pattern(K.indptr, K.indices, ()), V, T, 0.7)
    expected = 0.7 * (V.T @ K @ T).toarray()
    assert np.allclose((placed @ K.data).reshape(5, 5), expected, rtol=0, atol=1e-15)
