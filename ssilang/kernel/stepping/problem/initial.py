"""Initial state of a motion: velocity that the supports allow, acceleration in equilibrium."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import ConvergenceError, KernelError, SingularFactorError
from ssilang.kernel.base.scientific import sp, spla
from ssilang.kernel.contact.rows import TOUCHING, BoolArray, ContactRows
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.response import interface_energies, interface_forces, local_jumps
from ssilang.kernel.solvers.active_set.complementarity import ContactProblem, solve_contact
from ssilang.kernel.solvers.active_set.coulomb import CoulombProblem, solve_coulomb
from ssilang.kernel.solvers.backends import factorise, goes_to_petsc
from ssilang.kernel.solvers.multigrid.multigrid import conjugate_gradients
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import Motion

MANY = 150_000  # heavy unknowns from which their accelerations are iterated, never factorised
SOME = 20_000  # from which those of one force are: the factor takes minutes at 80 000 of a solid
# of that iteration: solids take 50 turns; curved shells, whose rotations about the normal have
# hardly any mass, 400 with 16 cells to a quarter of a circle, more with more
EXACT, MOST_TURNS = 1e-14, 5000


@dataclass(eq=False)
class JointState:
    """Jumps delta (size,), forces f (size,), local w, t (n_points, d), state; all converged."""

    delta: FloatArray
    f: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray
    D: FloatArray


def joint_state(problem: Problem, u: FloatArray | None = None) -> JointState:
    """Joints at the initial displacement, or at another one, from the problem's state."""
    joints = problem.interface
    n, d = joints.n_points, joints.dimension
    delta = joints.J @ (problem.u if u is None else u)
    w, t, D = np.zeros((n, d)), np.zeros((n, d)), np.zeros((n, d, d))
    state, f = np.zeros_like(problem.state), np.zeros(joints.size)
    if joints:  # without them nothing compiled is loaded
        local_jumps(joints.points, delta, w)
        respond(joints.codes, w, problem.state, joints.parameters, t, state, D)
        interface_forces(joints.points, t, f)
    return JointState(delta, f, w, t, state, D)


def motion_at_rest(problem: Problem) -> Motion:
    """The motion of a problem that begins without velocity, whatever its `v`."""
    joints, zero = joint_state(problem), np.zeros(problem.numbering.size)
    return Motion(
        problem.u.copy(), zero, zero.copy(), joints.delta, joints.f, joints.w, joints.t,
        joints.state, zero.copy(), initial_energies(problem, zero, joints),
        np.zeros(problem.contact.size),
    )  # fmt: skip


def admissible_velocity(problem: Problem) -> FloatArray:
    """The initial velocity, with that of supports that do not move set to zero."""
    rows = problem.constraints.C
    if rows.shape[0] == 0:
        return problem.v.copy()
    factors = problem.loading.at(problem.times[:2])
    moving = (problem.loading.imposed @ (factors[1] - factors[0])) != 0.0
    wanted = np.where(moving, rows @ problem.v, 0.0)
    excess = rows @ problem.v - wanted
    if not excess.any():
        return problem.v.copy()
    return problem.v - problem.constraints.particular(excess)


def initial_acceleration(problem: Problem, v: FloatArray, joints: JointState) -> FloatArray:
    """`M a = F - K u - C v - J^T f` on the motions that the supports leave.

    Motions without mass get none: their equilibrium is that of the next step.
    """
    load = problem.loading.forces @ problem.loading.at(problem.times[:1])[0]
    rest = load - problem.K @ problem.u - problem.C @ v
    return accelerated(problem, rest - problem.interface.J.T @ joints.f)


def closed_at_start(problem: Problem) -> BoolArray:
    """Unilateral rows that touch in the initial state."""
    contact = problem.contact
    gaps = contact.gaps(problem.u, problem.loading.at(problem.times[:1])[0])
    # gaps of a body at rest on rigid ground are rounding of its own displacements
    codes, of_gaps = problem.numbering.codes, np.unique(contact.G.indices)
    alike = np.abs(problem.u[np.isin(codes, codes[of_gaps])]).max(initial=0.0)
    size = abs(contact.G).sum(axis=1).max(initial=0.0) * alike + np.abs(gaps).max(initial=0.0)
    return gaps <= TOUCHING * size


def with_contact(
    problem: Problem, v: FloatArray, a: FloatArray, touching: BoolArray
) -> tuple[FloatArray, FloatArray]:
    """Initial acceleration and reactions (m,) of the unilateral relations that touch.

    They push where the bodies would accelerate through them: a body at rest on its support has
    no acceleration, and none rings on from step to step. Rows that open, rows of penalty and
    rows without mass have no reaction yet. Friction brakes what slides, and holds what rests.

    Parameters
    ----------
    a : array (n,)
        Acceleration without contact.
    touching : array (m,)
    """
    contact = problem.contact
    none = np.zeros(contact.size)
    if not contact or problem.contact_options.method == "PENALITE":
        return a, none
    factors = problem.loading.at(problem.times[:2])
    rate = contact.imposed @ (factors[1] - factors[0]) / (problem.times[1] - problem.times[0])
    speed = contact.G @ v - rate
    chosen = np.flatnonzero(touching & (speed <= 1e-12 * np.abs(v).max(initial=0.0)))
    if contact.friction:
        return _with_friction(problem, contact, v, a, chosen)
    G, D = contact.G[chosen], contact.pushing[chosen]
    moved = accelerated(problem, D.T.toarray())
    W = G @ moved
    heavy = np.diag(W) > 1e-12 * np.diag(W).max(initial=0.0)
    chosen, moved, W = chosen[heavy], moved[:, heavy], W[np.ix_(heavy, heavy)]
    if len(chosen) == 0:
        return a, none
    nothing = np.zeros((len(chosen), 0))
    try:
        found = solve_contact(
            ContactProblem(
                W, contact.G[chosen] @ a, nothing, nothing, np.zeros(0), np.zeros(len(chosen), bool)
            )
        )
    except ConvergenceError:  # opposite stops on both sides: the first step finds its own way
        return a, none
    none[chosen] = np.maximum(found.p, 0.0)
    return a + moved @ none[chosen], none


def _with_friction(
    problem: Problem, contact: ContactRows, v: FloatArray, a: FloatArray, chosen: IntArray
) -> tuple[FloatArray, FloatArray]:
    """As `with_contact` with friction at the chosen rows: slips of an instant decide its sense."""
    friction, m = contact.friction, len(contact)
    forces = np.zeros(contact.size)
    row = np.full(m + 1, -1)  # the last one is that of places without a row
    row[chosen] = np.arange(len(chosen))
    places = np.flatnonzero((friction.normal < 0) | (row[friction.normal] >= 0))
    if len(chosen) == 0 and len(places) == 0:
        return a, forces
    slips = (places[:, None] * friction.width + np.arange(friction.width)).ravel()
    pushing = contact.pushing[np.concatenate([chosen, m + slips])]
    watched = friction.watched[places]
    seen = sp.vstack([contact.G[chosen], friction.H[slips], watched]).tocsr()
    moved = accelerated(problem, pushing.T.toarray())
    instant = 1e-6 * float(problem.times[1] - problem.times[0])
    q = seen @ a
    q[len(chosen) : len(chosen) + len(slips)] += friction.H[slips] @ v / instant
    q[len(chosen) + len(slips) :] = friction.offset[places] + watched @ problem.u
    W = np.asarray(seen @ moved)
    W[len(chosen) + len(slips) :] = 0.0
    none = np.zeros((len(q), 0))
    try:
        found = solve_coulomb(
            CoulombProblem(
                W, q, none, none[: pushing.shape[0]], np.zeros(0), len(chosen), friction.width,
                row[friction.normal[places]], friction.coefficient[places],
                friction.constant[places],
            )
        )  # fmt: skip
    except ConvergenceError:  # the first step finds its own way
        return a, forces
    forces[np.concatenate([chosen, m + slips])] = found.forces
    return a + moved @ found.forces, forces


def accelerated(problem: Problem, force: FloatArray) -> FloatArray:
    """Accelerations (n,) or (n, k) that forces give to the motions that have mass."""
    T, V = problem.constraints.T, problem.constraints.V
    mass = sp.csr_array(V.T @ problem.M @ T)
    if not problem.constraints.associated:
        return np.asarray(T @ _least_squares(mass, V.T @ force))
    heavy = np.flatnonzero(np.abs(mass.diagonal()) > 0.0)
    q = np.zeros((T.shape[1], *force.shape[1:]))
    if len(heavy):
        q[heavy] = _solved(problem, sp.csc_array(mass[heavy][:, heavy]), (T.T @ force)[heavy])
    if not np.isfinite(q).all():
        raise KernelError("kernel.stepping.mass-matrix-singular-no")
    return T @ q


def _solved(problem: Problem, mass: sp.csc_array, force: FloatArray) -> FloatArray:
    """q of `mass q = force`, the least one where a mass is singular."""
    own = mass.diagonal()
    if np.count_nonzero(mass.data) == len(own):
        return np.asarray((force.T / own).T)

    try:
        if goes_to_petsc(problem.solver, len(own)):
            return factorise(sp.csr_array(mass), True, problem.solver).solve(force)
        if len(own) >= (SOME if force.ndim == 1 else MANY):
            try:
                return _of_heavy(mass, force)
            except KernelError:
                if len(own) >= MANY:
                    raise
        return np.asarray(spla.splu(mass).solve(force))
    except (RuntimeError, SingularFactorError):
        return np.asarray(np.linalg.lstsq(mass.toarray(), force, rcond=1e-12)[0], float)


def _of_heavy(mass: sp.csc_array, force: FloatArray) -> FloatArray:
    """Accelerations (n,) or (n, k) by conjugate gradients: memory would hold no factor."""
    diagonal, columns = mass.diagonal(), force.reshape(len(force), -1).T
    found = [
        conjugate_gradients(
            lambda x: mass @ x, lambda r: r / diagonal, np.ascontiguousarray(b),
            EXACT * float(np.linalg.norm(b)), MOST_TURNS,
        )
        for b in columns
    ]  # fmt: skip
    if not all(x.converged for x in found):
        raise KernelError("kernel.stepping.mass-matrix-singular-no")
    return np.column_stack([x.x for x in found]).reshape(force.shape)


def _least_squares(mass: sp.csr_array, force: FloatArray) -> FloatArray:
    """Least q with `mass q = force` as nearly as can be, for a mass that is not symmetric."""
    if mass.nnz == 0:
        return np.zeros((mass.shape[1], *force.shape[1:]))
    columns = force.reshape(len(force), -1)
    found = np.column_stack([spla.lsqr(mass, b, 0.0, 1e-15, 1e-15)[0] for b in columns.T])
    return found.reshape(mass.shape[1], *force.shape[1:])


def initial_energies(problem: Problem, v: FloatArray, joints: JointState) -> FloatArray:
    """Energies at the start, in the order of `state` (no work done yet)."""
    stored = lost = 0.0
    if p := problem.interface:
        stored, lost = interface_energies(p.points, joints.w, joints.t, joints.state)
    kinetic = 0.5 * v @ (problem.M @ v)
    elastic = 0.5 * problem.u @ (problem.K @ problem.u)
    contact, options = problem.contact, problem.contact_options
    if options.method == "PENALITE":
        gaps = contact.gaps(problem.u, problem.loading.at(problem.times[:1])[0])
        elastic += contact.penalty_energy(gaps, options.coefficient)
    return np.array([kinetic, elastic, stored, lost, 0.0, 0.0])
