"""Time schemes of the Newmark family: four numbers, and all that a step makes of them.

`M a_m + C v_f + K u_f + f_f = F_f` with `x_m = (1 - alpha_m) x_1 + alpha_m x_0` and
`x_f = (1 - alpha_f) x_1 + alpha_f x_0`, and Newmark's

    u_1 = u_0 + dt v_0 + dt^2 ((1/2 - beta) a_0 + beta a_1)
    v_1 = v_0 + dt ((1 - gamma) a_0 + gamma a_1)

(Newmark 1959; Chung and Hulbert 1993.) No other file combines the four numbers: loops take the
record `Newmark` and the verbs `advanced` and `from_past`, compiled in `verbs`.
"""

from dataclasses import dataclass
from typing import NamedTuple, TypeVar

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError

Quantity = TypeVar("Quantity", float, FloatArray)


@dataclass(frozen=True)
class Scheme:
    """A scheme: `alpha_m`, `alpha_f`, `beta`, `gamma`.

    `conserving` is the midpoint rule with forces of joints and relations that are means over the
    step (`MIDPOINT`; for linear systems the average acceleration), and gives mean accelerations and
    reactions; `adaptive` halves steps in which joints open or close.
    """

    alpha_m: float = 0.0
    alpha_f: float = 0.0
    beta: float = 0.25
    gamma: float = 0.5
    conserving: bool = False
    adaptive: bool = False

    @property
    def average_acceleration(self) -> bool:
        """True for the scheme that keeps the energy of linear systems."""
        return (self.alpha_m, self.alpha_f, self.beta, self.gamma) == (0.0, 0.0, 0.25, 0.5)


MIDPOINT = (0.0, 0.5, 0.5, 1.0)
"""The four numbers of the midpoint rule: equilibrium of mean forces, `a = (v_1 - v_0)/dt`."""


def newmark(beta: float = 0.25, gamma: float = 0.5) -> Scheme:
    """Newmark's scheme; the default is the average acceleration.

    Raises
    ------
    KernelError
        If it is not implicit and unconditionally stable (gamma >= 1/2, beta >= gamma / 2).
    """
    if not (gamma >= 0.5 and beta >= gamma / 2 - 1e-15):
        raise KernelError("kernel.stepping.newmark-scheme-beta-gamma", beta=beta, gamma=gamma)
    return Scheme(0.0, 0.0, beta, gamma)


def hht(alpha: float) -> Scheme:
    """Hilber, Hughes and Taylor (1977): damps high frequencies, second order.

    Parameters
    ----------
    alpha : float
        0 (average acceleration) to 1/3; the older writing from -1/3 to 0 is taken too.
    """
    size = abs(alpha)
    if size > 1 / 3 + 1e-12:
        raise KernelError("kernel.stepping.hht-parameter-range", alpha=alpha)
    return Scheme(0.0, size, (1 + size) ** 2 / 4, 0.5 + size)


def generalised_alpha(rho_inf: float) -> Scheme:
    """Chung and Hulbert (1993), from the spectral radius at infinite frequency, 0 to 1."""
    if not 0 <= rho_inf <= 1:
        raise KernelError("kernel.stepping.spectral-radius-range", rho_inf=rho_inf)
    alpha_m = (2 * rho_inf - 1) / (rho_inf + 1)
    alpha_f = rho_inf / (rho_inf + 1)
    return Scheme(alpha_m, alpha_f, (1 - alpha_m + alpha_f) ** 2 / 4, 0.5 - alpha_m + alpha_f)


class Newmark(NamedTuple):
    """The coefficients of a scheme's steps of length dt.

    Attributes
    ----------
    start, end : float
        Weights of the forces at both ends of a step, `alpha_f` and `1 - alpha_f`.
    inertia_start, inertia_end : float
        Those of the inertia, `alpha_m` and `1 - alpha_m`.
    before : float
        Weight of the start in the reactions that are kept: 0, or 1/2 where they are means.
    v_du, v_v, v_a : float
        `v_1 = v_du du + v_v v_0 + v_a a_0`.
    a_du, a_a : float
        `a_1 = a_du (du - dt v_0) + a_a a_0`.
    mass, damping : float
        The step's matrix is `A = mass M + damping C + end K`.
    m_v, m_a, c_v, c_a : float
        The past on the right-hand side: `M (m_v v_0 + m_a a_0) - C (c_v v_0 + c_a a_0)`.
    u_a0, u_a1, v_a0, v_a1 : float
        By accelerations: `u_1 = u_0 + dt v_0 + u_a0 a_0 + u_a1 a_1`, `v_1 = v_0 + v_a0 a_0 +
        v_a1 a_1`.
    """

    dt: float
    start: float
    end: float
    inertia_start: float
    inertia_end: float
    before: float
    v_du: float
    v_v: float
    v_a: float
    a_du: float
    a_a: float
    mass: float
    damping: float
    m_v: float
    m_a: float
    c_v: float
    c_a: float
    u_a0: float
    u_a1: float
    v_a0: float
    v_a1: float


def newmark_of(scheme: Scheme, dt: float) -> Newmark:
    """The coefficients of a scheme for steps of length dt."""
    am, af, beta, gamma = scheme.alpha_m, scheme.alpha_f, scheme.beta, scheme.gamma
    if scheme.conserving:
        am, af, beta, gamma = MIDPOINT
    v_du, v_v, v_a = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    a_du, a_v, a_a = 1 / (beta * dt**2), 1 / (beta * dt), 1 - 0.5 / beta
    return Newmark(
        dt=dt, start=af, end=1 - af, inertia_start=am, inertia_end=1 - am,
        before=0.5 * scheme.conserving,
        v_du=v_du, v_v=v_v, v_a=v_a, a_du=a_du, a_a=a_a,
        mass=(1 - am) * a_du, damping=(1 - af) * v_du,
        m_v=(1 - am) * a_v, m_a=-(1 - am) * a_a - am, c_v=(1 - af) * v_v + af, c_a=(1 - af) * v_a,
        u_a0=(0.5 - beta) * dt**2, u_a1=beta * dt**2, v_a0=(1 - gamma) * dt, v_a1=gamma * dt,
    )  # fmt: skip


def advanced(n: Newmark, du: Quantity, v: Quantity, a: Quantity) -> tuple[Quantity, Quantity]:
    """Velocity and acceleration at the end of a step from its increment of displacement.

    The formulas are linear: products of a matrix with du, v and a advance alike.
    """
    return n.v_du * du + n.v_v * v + n.v_a * a, n.a_du * (du - n.dt * v) + n.a_a * a


def from_past(n: Newmark, Mv: Quantity, Ma: Quantity, Cv: Quantity, Ca: Quantity) -> Quantity:
    """What inertia and damping of the step's start bring to its right-hand side."""
    return n.m_v * Mv + n.m_a * Ma - (n.c_v * Cv + n.c_a * Ca)
