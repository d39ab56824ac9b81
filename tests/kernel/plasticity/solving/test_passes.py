"""Small models with dense matrices, Cholesky and LU, compiled passes: the same steps."""

from pathlib import Path

import numpy as np
import pytest
from references.keeper import Ending
from references.tower_on_clay import stepped_tower, tower_on_clay
from together import together

from ssilang.kernel.base.sparse import assemble_triplets, sp
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.materials.plastic.backbone import hyperbola
from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS, PlasticLaw, law_at
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.plasticity import newton, run
from ssilang.kernel.plasticity.points import PointState
from ssilang.kernel.plasticity.solving import dense
from ssilang.kernel.plasticity.solving.dense import places_of
from ssilang.kernel.plasticity.solving.positive import Pattern, PositiveFactors
from ssilang.kernel.plasticity.zone_points import zone_pass

M = 900
RANGES = {
    "PARFAIT": {"SIGY": (1, 2)},
    "ISOTROPE": {},
    "CINEMATIQUE": {"SIGY": (1, 2), "H": (0, 300)},
    "J2": {"SIG0": (1, 2), "SIGI": (2, 3), "KISO": (0, 100), "VELO": (0, 1000)},
    "DRUCKER_PARFAIT": {"LTR": (0.2, 1), "LCS": (1, 3)},
    "DRUCKER_PRAGER": {
        "ALFA": (0.1, 0.3), "BETA": (0.5, 1), "K": (1, 2), "ETA": (0.1, 0.3), "MU": (0.5, 1),
        "KL": (0.5, 3), "H": (-100, 100), "GAMM": (0, 0.2), "DELT": (0.5, 1),
    },
    "IWAN": {},
    "IWAN_PRESSION": {"PREF": (1, 2)},
}  # fmt: skip
CURVES = [
    Curve((CurvePart(np.array([0.0, 1e-3, 1e-2]), np.array([1.0, 2.0, 2.5])),)),
    Curve((CurvePart(np.array([0.0, 0.1]), np.array([1.5, 3.0])),)),
]


class Points:
    """Elements of one point whose strains are their unknowns."""

    def __init__(self, law: PlasticLaw, parameters: PointParameters) -> None:
        self.law, self.parameters, self.held = law, parameters, ()
        self.B = np.tile(np.eye(6)[None, :, None, :], (M, 1, 1, 1))
        self.weights, self.components = np.full((M, 1), 2.0), (0, 1, 2, 3, 4, 5)


def state_of(rng: np.random.Generator, law: PlasticLaw, nested: bool) -> PointState:
    """Bodies that have flowed; nested surfaces begin under a pressure alone."""
    variables, stress = np.zeros((M, len(law.variables))), rng.normal(size=(M, 6)) * 0.5
    if nested:
        stress[:] = [-1.0, -1.0, -1.0, 0.0, 0.0, 0.0]
        return PointState(stress, np.zeros((M, 6)), np.zeros((M, 6)), variables)
    variables[:, 0] = rng.uniform(0, 0.01, M) * (rng.uniform(size=M) > 0.3)
    if variables.shape[1] > 1:
        centre = rng.normal(size=(M, 6)) * 0.2
        centre[:, :3] -= centre[:, :3].mean(axis=1)[:, None]
        variables[:, 1:] = centre
    return PointState(stress, rng.normal(size=(M, 6)), np.zeros((M, 6)), variables)


@together("name", RANGES)
def test_a_pass_gives_what_the_law_does(name: str) -> None:
    """Three steps: with strains that need no stress, back, and forth again."""
    rng, nested = np.random.default_rng(0), name.startswith("IWAN")
    ranges = {"YOUN": (1e3, 2e3), "NU": (0.1, 0.45)} | RANGES[name]
    values = {k: rng.uniform(*given, M) for k, given in ranges.items()}
    which, soils = rng.integers(0, 2, M), [hyperbola(1e-3), hyperbola(5e-3, 12)]
    parameters = PointParameters(values, {"ECRO": (CURVES, which), "GGAM": (soils, which)})
    law = law_at(PLASTIC_LAWS[name], parameters)
    points, places = Points(law, parameters), np.arange(6 * M, dtype=np.int32).reshape(M, 6)
    zone = zone_pass(points, places)  # type: ignore[arg-type]
    assert zone is not None
    pattern = Pattern.of(assemble_triplets([places], [np.ones((M, 6, 6))], 6 * M), [places])
    old, way = state_of(rng, law, nested), rng.normal(size=(M, 6)) * 2e-3
    for turn, size in enumerate((1.0, -1.5, 1.3)):
        strain, freed = size * way, np.zeros((0, 6)) if turn else rng.normal(size=(M, 6)) * 2e-4
        own = strain if turn else strain - freed
        found = law.respond(parameters, old.stress, own, old.variables)
        force, flow, data = np.zeros(6 * M), np.zeros(6 * M), pattern.blank()
        new = zone.respond(old, strain.ravel(), freed, force)
        flows = found.variables[:, 0] > old.variables[:, 0]
        assert flows.mean() > 0.05
        clear = np.abs(new.beyond) > 1e-9  # of the tip of a cone, where rounding decides
        assert clear.mean() > 0.9
        assert np.array_equal(
            (new.beyond == 1.0 if nested else new.beyond > 0)[clear], flows[clear]
        )
        largest = np.abs(found.stress).max()
        assert np.allclose(new.stress, found.stress, rtol=0, atol=1e-13 * largest)
        assert np.allclose(new.variables, found.variables, rtol=0, atol=1e-13 * largest)
        assert np.allclose(force.reshape(M, 6), 2 * found.stress, rtol=0, atol=1e-12 * largest)
        elastic = np.einsum("mij,mj->mi", parameters.compliance, found.stress - old.stress)
        assert np.allclose(new.plastic, old.plastic + own - elastic, rtol=0, atol=3e-15)
        mean = 0.5 * (old.stress + found.stress)
        assert new.work == pytest.approx(2 * np.sum(mean * own), rel=1e-11)
        zone.add_tangent(old, strain.ravel(), freed, pattern.slots[0], data)
        tangents = data.reshape(M, 6, 6) / 2
        steep = 1e-12 * np.abs(found.tangent).max()
        assert np.allclose(tangents, found.tangent, rtol=0, atol=steep)
        some = np.sort(rng.permutation(M)[:300])
        zone.of(some).flow(old, own.ravel(), flow)
        without = old.stress + np.einsum("mij,mj->mi", parameters.moduli, own)
        taken = np.zeros((M, 6))
        taken[some] = 2 * (found.stress - without)[some]
        assert np.allclose(flow.reshape(M, 6), taken, rtol=0, atol=1e-12 * largest)
        old = PointState(new.stress, new.plastic, old.free, new.variables)
        density = parameters.elastic_energy(old.stress)
        if law.locked is not None:
            density = density + law.locked(parameters, old.stress, old.variables)
        assert zone.stored(old) == pytest.approx(2 * density.sum(), rel=1e-11)


def test_only_cones_have_rows() -> None:
    laws = {name for name, law in PLASTIC_LAWS.items() if law.cone is not None}
    assert laws == {name for name in RANGES if not name.startswith("IWAN")}


def test_terms_stay_where_the_assembly_puts_them() -> None:
    rng, n = np.random.default_rng(1), 40
    places = [rng.permuted(np.tile(np.arange(n), (30, 1)), axis=1)[:, :k] for k in (4, 3)]
    places = [p.astype(np.int32) for p in places]
    shapes = [(len(p), p.shape[1], p.shape[1]) for p in places]
    pattern = Pattern.of(assemble_triplets(places, [np.ones(s) for s in shapes], n), places)
    values = [rng.normal(size=s) for s in shapes]
    data = pattern.blank()
    for block, matrices in enumerate(values):
        pattern.add(data, block, matrices)
    whole = assemble_triplets(places, values, n)
    assert np.allclose(pattern.matrix(data).toarray(), whole.toarray(), rtol=0, atol=1e-14)


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


TURNS = 12


class Listening(PositiveFactors):
    """Notes which of its solves succeed."""

    solved: list[bool]

    def solve(self, *given):
        found = super().solve(*given)
        self.solved.append(found is not None)
        return found


def turned(solved: list[bool], monkeypatch: pytest.MonkeyPatch) -> np.ndarray:
    """Displacements; whether Cholesky factors solved, each time that they were asked."""
    Listening.solved = solved
    monkeypatch.setattr(newton, "PositiveFactors", Listening)
    history, seen, strain = stepped_tower("J2", TURNS, full=True)
    assert history.solver == ("nested dissection" if solved else "SuperLU")
    assert (strain > 0).any()
    return seen.of("u")


def test_both_lead_to_the_same_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    none, solved = [], []
    monkeypatch.setattr(newton, "dissection_pays", lambda n: True)
    found = turned(solved, monkeypatch)
    monkeypatch.setattr(newton, "dissection_pays", lambda n: False)
    expected = turned(none, monkeypatch)
    assert not none
    assert len(solved) > 2 * TURNS
    assert all(solved)
    assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()


def test_what_is_not_positive_or_not_symmetric_is_left_to_others() -> None:
    problem, _ = tower_on_clay("J2", 1)
    n = problem.numbering.size
    factors, load = PositiveFactors(problem), np.ones(n)
    none, A = sp.csr_array((n, n)), sp.csr_array(sp.eye_array(n))
    T = problem.constraints.T
    assert np.allclose(factors.solve(A, none, load), T @ (T.T @ load))
    assert factors.solve(-A, none, load) is None
    rubs = sp.csr_array(([1.0], ([0], [1])), shape=(n, n))
    assert factors.solve(A, rubs, load) is None
