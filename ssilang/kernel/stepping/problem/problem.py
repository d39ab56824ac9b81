"""A time-stepping problem: linear matrices, conditions, loads, joints, initial state, times.

Forces of the conditions at instants of a motion, from its balance; closed joints' stiffness.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.modified_mass import without_contact_mass
from ssilang.kernel.contact.rows import ContactRows, Friction, split_rows
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.elements.families import stiffness as zone_stiffness
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.family import JointFamily, rotational_stiffness
from ssilang.kernel.interface.interface import (
    Interface,
    interface_of,
    joint_zones,
    nonlinear_blocks,
    parted,
    state_from_field,
    without_zones,
)
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.solvers.factor import FIRST_FIT, Solver
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.problem.constraints import Constraints, check_values, constraints_of
from ssilang.kernel.stepping.problem.loading import Loading, loading_of
from ssilang.kernel.stepping.state import Motion, Recorder
from ssilang.kernel.waves.matched_layer import HISTORIES, refuse_parts_of_layer

SMALL = 160
"""Motions that supports leave, up to which all modes are made and loops on them are used."""
MOST_SMALL = 1000
"""Unknowns in all, held ones too, of such a problem."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What a time integration needs, all on one numbering."""

    numbering: assembly.Numbering
    K: sp.csr_array  # (n, n) stiffness without the joints that a law replaces
    M: sp.csr_array  # (n, n) mass
    C: sp.csr_array  # (n, n) damping
    constraints: Constraints
    multipliers: IntArray  # (n_rows,) multiplier nodes of the conditions
    loading: Loading
    interface: Interface
    u: FloatArray  # (n,) initial displacement
    v: FloatArray  # (n,) initial velocity
    state: FloatArray  # (n_points, N_STATE) initial state of the joints
    times: FloatArray  # (n_steps + 1,) strictly increasing, the initial time first
    contact: ContactRows  # unilateral relations
    scheme: Scheme = field(default_factory=Scheme)
    contact_options: ContactOptions = field(default_factory=ContactOptions)
    solver: Solver = FIRST_FIT  # which solver takes the systems of its steps

    @property
    def small(self) -> bool:
        """Whether the compiled loops on all modes serve."""
        few = self.numbering.size <= MOST_SMALL and self.constraints.T.shape[1] <= SMALL
        return few and not self.contact and self.constraints.associated


@dataclass(frozen=True, eq=False)
class Inputs:
    """A problem as a script gives it.

    `model` and `characteristics` hold the joints whose law replaces their linear stiffness;
    other zones of the model are ignored (their matrices are in `stiffness`). `variables` are the
    joints' internal variables at the start, `inside` their inelastic jumps and tractions, where
    these say more than the displacement; `friction` that of unilateral relations and cables.
    """

    stiffness: Matrix
    times: FloatArray
    mass: Matrix | None = None
    damping: Matrix | None = None
    load: Load | None = None
    displacement: NodeField | None = None
    velocity: NodeField | None = None
    model: Model | None = None
    characteristics: CellField | None = None
    scheme: Scheme = field(default_factory=Scheme)
    contact_options: ContactOptions = field(default_factory=ContactOptions)
    variables: CellField | None = None
    friction: tuple[Friction, ...] = ()
    solver: Solver = FIRST_FIT
    inside: tuple[CellField | None, CellField | None] | None = None


def make_problem(inputs: Inputs) -> Problem:
    """Number, assemble and check a problem.

    Raises
    ------
    KernelError
        If times do not increase, joints with a law stand in the stiffness alone, values are not
        finite, a mass is negative, or matrices of a matched layer are missing.
    """
    times = _checked_times(inputs.times)
    refuse_parts_of_layer(inputs.stiffness, inputs.mass, inputs.damping)
    given_zones = () if inputs.model is None else joint_zones(inputs.model)
    zones = tuple(z for z in given_zones if not law_of(z.behaviour).linear)
    matrices = _matrices(inputs, given_zones, zones)
    stiffness = matrices["K"]
    given = tuple(m for m in matrices.values() if m is not None)
    assert stiffness is not None
    numbering = assembly.numbering_of(*given)
    relations = tuple(r for m in given for r in m.relations)
    rows = assembly.constraint_matrix(Matrix(stiffness.table, (), relations), numbering)
    loading = loading_of(inputs.load, numbering, rows.multipliers)
    rows, imposed, contact = split_rows(rows, loading.imposed, inputs.friction, numbering)
    loading = replace(loading, imposed=imposed)
    constraints = constraints_of(rows, numbering.size <= SMALL)
    check_values(constraints, loading.imposed, numbering)
    interface = interface_of(zones, inputs.characteristics, numbering)
    assembled = {k: _assembled(m, numbering) for k, m in matrices.items()}
    for name, matrix in assembled.items():
        if not np.isfinite(matrix.data).all():
            raise KernelError("kernel.stepping.matrix-values-not-finite", name=name)
    for _, ordinates in loading.curves:
        if not np.isfinite(ordinates).all():
            raise FieldError("kernel.stepping.load-curve-values-not")
    assembly.refuse_negative_mass(assembled["M"], numbering, HISTORIES)
    if contact and inputs.contact_options.modified_mass:
        assembled["M"] = without_contact_mass(assembled["M"], assembled["K"], contact.G)
    u, v = (_start(field, numbering) for field in (inputs.displacement, inputs.velocity))
    state = interface.initial_state()
    if interface and inputs.variables is not None:
        state = state_from_field(interface, inputs.variables)
    if interface and inputs.inside is not None:
        interface = parted(interface, state, interface.jumps(u), inputs.inside)
    return Problem(
        numbering, assembled["K"], assembled["M"], assembled["C"], constraints, rows.multipliers,
        loading, interface, u, v, state, times, contact,
        inputs.scheme, inputs.contact_options, inputs.solver,
    )  # fmt: skip


def _checked_times(times: FloatArray) -> FloatArray:
    times = np.asarray(times, dtype=float)
    if len(times) < 2 or not np.isfinite(times).all() or not (np.diff(times) > 0).all():
        raise KernelError("kernel.stepping.times-calculation-must-least")
    shortest = float(np.diff(times).min())
    if shortest**2 < np.finfo(float).tiny:  # accelerations are divided by its square
        raise KernelError("kernel.stepping.step-too-short", step=shortest)
    return times


def _matrices(
    inputs: Inputs, joints_given: tuple[Zone, ...], zones: tuple[Zone, ...]
) -> dict[str, Matrix | None]:
    """K without the joints of `zones`, M, C, and the joints' unknowns under 'joints'.

    Joints whose law is linear stand in K, from their characteristics.
    """
    if joints_given and inputs.characteristics is None:
        raise KernelError("kernel.stepping.joints-need-parameters")
    stiffness = without_zones(inputs.stiffness, joints_given)
    linear = tuple(z for z in joints_given if z not in zones)
    if joints_given and inputs.characteristics is not None:
        turning = (rotational_stiffness(z, inputs.characteristics) for z in zones)
        blocks = tuple(zone_stiffness(z, inputs.characteristics) for z in linear)
        blocks += tuple(b for b in turning if b is not None)
        stiffness = replace(stiffness, blocks=(*stiffness.blocks, *blocks), cache={})
    if nonlinear_blocks(stiffness):
        raise KernelError("kernel.stepping.stiffness-holds-joints-whose")
    damping = None if inputs.damping is None else without_zones(inputs.damping, zones)
    joints = _unknowns_of(zones, stiffness) if zones else None
    return {"K": stiffness, "M": inputs.mass, "C": damping, "joints": joints}


def _unknowns_of(zones: tuple[Zone, ...], like: Matrix) -> Matrix:
    """A matrix of zeros that has the joints' unknowns."""
    blocks = []
    for zone in zones:
        layout = JointFamily().layout(zone)
        k = len(layout.unknowns)
        zeros = np.zeros((len(layout.raw_nodes), k, k))
        blocks.append(
            ElementMatrices(
                layout.table, layout.raw_nodes, layout.local, layout.unknowns, layout.duals, zeros
            )
        )
    return Matrix(like.table, tuple(blocks))


def _assembled(matrix: Matrix | None, numbering: assembly.Numbering) -> sp.csr_array:
    n = numbering.size
    return sp.csr_array((n, n)) if matrix is None else assembly.assemble(matrix, numbering)


def _start(given: NodeField | None, numbering: assembly.Numbering) -> FloatArray:
    if given is None:
        return np.zeros(numbering.size)
    values = assembly.field_to_vector(given, numbering, dual=False)
    if not np.isfinite(values).all():
        raise FieldError("kernel.stepping.initial-field-values-not")
    return values


def reactions(
    problem: Problem, u: FloatArray, v: FloatArray, a: FloatArray, t: FloatArray, loads: FloatArray
) -> FloatArray:
    """`M a + C v + K u + J^T f - F` of several instants, one a row."""
    p = problem
    total: FloatArray = (p.M @ a.T + p.C @ v.T + p.K @ u.T).T - loads
    return total + joint_forces(p.interface, t) @ p.interface.J if p.interface else total


def joint_forces(joints: Interface, t: FloatArray) -> FloatArray:
    """Forces (n_rows, q) on the jumps of the interface from tractions (n_rows, n_points, d)."""
    d, x = joints.dimension, joints.points
    local = np.einsum("p,rpi,pik->rpk", x.weights, t, x.B)
    places = (x.pairs[:, :, None] * d + np.arange(d)).reshape(len(x.pairs), -1)
    f = np.zeros((len(t), joints.size))
    np.add.at(f, (np.arange(len(t))[:, None, None], places[None]), local)
    return f


def closed_stiffness(problem: Problem) -> sp.csr_array:
    """The stiffness (n_y, n_y) with closed joints on the motions that the supports leave."""
    T = problem.constraints.T
    return sp.csr_array(T.T @ closed_forces(problem, T))


def closed_forces(problem: Problem, motions: Any) -> Any:
    """What stiffness and closed joints hold motions (n, ...) with, sparse as they are."""
    forces, joints = problem.K @ motions, problem.interface
    if not joints:
        return forces
    return forces + joints.J.T @ (joints.closed_stiffness() @ (joints.J @ motions))


# Supports that do not move take no part in loops on coordinates; their reactions follow.


def supports_are_still(problem: Problem) -> bool:
    """Whether no support moves, now or later, and the motions left are orthonormal."""
    C, T = problem.constraints.C, problem.constraints.T
    still = not problem.loading.imposed.any() and not np.any(C @ problem.u)
    return still and np.allclose((T.T @ T).toarray(), np.eye(T.shape[1]), atol=1e-13)


def keep_reactions(problem: Problem, factors: FloatArray, kept: Recorder) -> None:
    """Reactions of kept instants, from equilibrium."""
    if len(kept.u):
        loads = factors[1:][kept.row >= 0] @ problem.loading.forces.T
        kept.reaction[:] = reactions(problem, kept.u, kept.v, kept.a, kept.t, loads)


def react(problem: Problem, m: Motion, factors: FloatArray) -> None:
    """Reactions of the motion at load factors (k,), from equilibrium."""
    loads = problem.loading.forces @ factors
    now = (x[None] for x in (m.u, m.v, m.a, m.t, loads))
    m.reaction[:] = reactions(problem, *now)[0]
