"""Time schemes of the Newmark family, as four numbers.

`M a_m + C v_f + K u_f + f_f = F_f` with `x_m = (1 - alpha_m) x_1 + alpha_m x_0` and
`x_f = (1 - alpha_f) x_1 + alpha_f x_0`, and Newmark's

    u_1 = u_0 + dt v_0 + dt^2 ((1/2 - beta) a_0 + beta a_1)
    v_1 = v_0 + dt ((1 - gamma) a_0 + gamma a_1)
"""

from __future__ import annotations

from dataclasses import dataclass

from ssilang.kernel.base.errors import KernelError


@dataclass(frozen=True)
class Scheme:
    """A scheme: `alpha_m`, `alpha_f`, `beta`, `gamma`; `conserving` takes mean tractions.

    `adaptive` halves steps in which joints open or close.
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
