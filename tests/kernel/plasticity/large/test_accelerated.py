"""Steps that keep their factor against Newton's method on all unknowns."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from references.keeper import Ending
from references.recorder import Recorder

from ssilang.kernel import elements
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.relations import Term, relation_rows
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.plasticity.bulk import bulk_of, without_stiffness
from ssilang.kernel.plasticity.large import accelerated
from ssilang.kernel.plasticity.large.accelerated import Acceleration
from ssilang.kernel.plasticity.run import run_bulk
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem

STEPS, DT = 56, 1e-2
CLAY = {"YOUN": 2e7, "NU": 0.4, "RHO": 1900.0}
LAWS = {
    "J2": {"SIG0": 6e4, "SIGI": 6e4, "KISO": 5e5, "VELO": 0.0},
    "DRUCKER_PARFAIT": {"LTR": 1e4, "LCS": 4e4},
    "DRUCKER_PRAGER": {
        "ALFA": 0.1, "BETA": 1.0, "K": 3e4, "ETA": 0.1, "MU": 1.0, "KL": 3e4, "H": 0.0,
        "GAMM": 0.0, "DELT": 1.0,
    },
}  # fmt: skip


def grid(table: NodeTable, x0: float, y0: float, nx: int, ny: int) -> np.ndarray:
    X, Y = np.meshgrid(x0 + np.arange(nx + 1.0), y0 + np.arange(ny + 1.0), indexing="ij")
    return table.add(np.column_stack([X.ravel(), Y.ravel()])).reshape(nx + 1, ny + 1)


def zone(table, ids, law: tuple[str, ...], data: dict[str, float]) -> tuple[Zone, CellField]:
    cells = np.stack([ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]], -1).reshape(-1, 4)
    block = CellBlock.make(table, "QUA4", cells)
    values = {name: np.full((len(block), 1), v) for name, v in data.items()}
    field = CellField((CellFieldBlock(block, values, "STRESSES", "QUA4"),))
    return Zone(
        block, "MECANIQUE", ("ELASTIQUE", "ISOTROPE", *law), "QUA4", Mode.PLANE_STRAIN
    ), field


def tower_on_clay(law: str = "J2", steps: int = STEPS):
    """Problem, plastic bodies: an elastic tower of 4 x 10 rocks on a box of 32 x 16 that yields."""
    table = NodeTable()
    soil, tower = grid(table, 0, -16, 32, 16), grid(table, 14, 0, 4, 10)
    clay, clay_field = zone(table, soil, ("PLASTIQUE", law), CLAY | LAWS[law])
    stiff, stiff_field = zone(table, tower, (), {"YOUN": 1e9, "NU": 0.2, "RHO": 1000.0})
    pairs = np.column_stack([soil[14:19, -1], tower[:, 0]])
    block, one = CellBlock.make(table, "SEG2", pairs), np.ones((5, 1))
    names = {"KN": 1e8 * one, "KS": 5e7 * one, "V1X": 0 * one, "V1Y": one}
    joints = Zone(
        block, "MECANIQUE", ("ELASTIQUE", "JOINT_SDM", "CISAILLEMENT_ELASTIQUE"), "JOI1",
        Mode.PLANE_STRAIN,
    )  # fmt: skip
    base = soil[:, 0]
    held = [relation_rows(table, [Term(1.0, u, base)], 0) for u in ("UX", "UY")]
    K = Matrix(
        table, (without_stiffness(clay), elements.stiffness(stiff, stiff_field)), tuple(held)
    )
    lumped = (elements.mass(clay, clay_field, True), elements.mass(stiff, stiff_field, True))
    M = Matrix(table, lumped, kind="MASSE")
    numbering = numbering_of(K, M)
    mass = assemble(M, numbering).diagonal()
    shake, weight = np.zeros(numbering.size), np.zeros(numbering.size)
    along_x, along_y = numbering.where("UX"), numbering.where("UY")
    shake[along_x] = -mass[along_x]
    heavy = along_y[np.isin(numbering.nodes[along_y], tower)]
    weight[heavy] = -9.81 * mass[heavy]
    shake[along_x[np.isin(numbering.nodes[along_x], tower)]] *= 3.0  # it is pushed over, too
    times = DT * np.arange(steps + 1)
    sine = Curve((CurvePart(times, 6.0 * np.sin(2 * np.pi * 2.5 * times)),))
    load = Load(
        (
            LoadPart("MECA", vector_to_field(weight, numbering, dual=True)),
            LoadPart("MECA", vector_to_field(shake, numbering, dual=True), sine),
        )
    )
    field = CellField((CellFieldBlock(block, names, "STRESSES", "JOI1"),))
    inputs = Inputs(K, times, M, None, load, model=Model((joints,)), characteristics=field)
    problem = make_problem(inputs)
    return problem, bulk_of((clay,), clay_field, numbering)


def stepped(law: str = "J2", keeper=None, steps: int = STEPS, full: bool = False):
    """History, and displacements and last plastic strains, of a run."""
    problem, bulk = tower_on_clay(law, steps)
    seen = Recorder(steps + 1)
    history = run_bulk(problem, bulk, bulk.unloaded(), [seen], None, True, keeper, full)
    strain = seen.snapshots[-1].bulk_state[0].variables[:, 0]
    return history, seen.of("u"), strain, seen.of("w")[..., -1]


@pytest.fixture(scope="module")
def newton():
    """The run by Newton's method, asked for."""
    return stepped(full=True)


def test_a_kept_factor_leads_to_newtons_answer(newton) -> None:
    """Both end each step at 1e-10 of the forces; the model yields, lifts and comes down again."""
    history, u, strain, _ = stepped()
    assert history.loop.startswith("kept factor")
    assert newton[0].loop.startswith("full Newton")
    assert np.mean(strain > 0) > 0.2
    opens = newton[3][1:] > 0
    assert opens.any()
    assert (opens[:-1] & ~opens[1:]).any()
    assert np.abs(u - newton[1]).max() <= 1e-8 * np.abs(newton[1]).max()
    assert np.abs(strain - newton[2]).max() <= 1e-8 * newton[2].max()
    imbalance = np.abs(history.energies - newton[0].energies).max()
    assert imbalance <= 1e-8 * np.abs(newton[0].energies).max()


def test_renewed_factors_lead_there_too(newton, monkeypatch: pytest.MonkeyPatch) -> None:
    made = []
    make = accelerated.AcceleratedSolver._factorised
    monkeypatch.setattr(
        accelerated.AcceleratedSolver, "_factorised",
        lambda self, tangent: made.append(0) or make(self, tangent),
    )  # fmt: skip
    monkeypatch.setattr(accelerated, "PATIENCE", 4)
    history, u, _, _ = stepped(steps=20)
    assert len(made) > 3
    assert history.loop.startswith("kept factor")
    assert np.abs(u - newton[1][:21]).max() <= 1e-8 * np.abs(newton[1]).max()


def test_newtons_method_goes_on_where_the_iteration_leads_nowhere(
    newton, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(accelerated, "PATIENCE", 2)
    monkeypatch.setattr(accelerated, "RENEWALS", 1)
    _, u, _, _ = stepped(steps=14)
    assert np.abs(u - newton[1][:15]).max() <= 1e-8 * np.abs(newton[1]).max()


def test_runs_repeat_to_the_last_bit_and_go_on_to_it(tmp_path: Path) -> None:
    whole, resumed = stepped(steps=24), None
    with pytest.raises(KeyboardInterrupt):
        stepped(keeper=Ending(tmp_path, 4, 12), steps=24)
    resumed = stepped(keeper=Ending(tmp_path, 4, resume=True), steps=24)
    assert np.array_equal(resumed[0].energies, whole[0].energies)
    assert np.array_equal(resumed[1][-12:], whole[1][-12:])
    assert np.array_equal(resumed[2], whole[2])


def test_perfect_plasticity_keeps_a_factor_and_unsymmetric_flow_does_not() -> None:
    assert stepped("DRUCKER_PARFAIT", steps=3)[0].loop.startswith("kept factor")
    assert stepped("DRUCKER_PRAGER", steps=3)[0].loop.startswith("full Newton")


def test_acceleration_solves_a_linear_problem_in_as_many_turns_as_it_has_unknowns() -> None:
    rng = np.random.default_rng(3)
    A, b = 2.0 * rng.normal(size=(6, 6)), rng.normal(size=6)  # p -> A p + b grows without end
    p, step = np.zeros(6), Acceleration(6)
    for _ in range(8):
        p = step.next(p, A @ p + b)
    exact = np.linalg.solve(np.eye(6) - A, b)
    assert np.abs(p - exact).max() <= 1e-8 * np.abs(exact).max()
