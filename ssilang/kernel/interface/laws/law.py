"""What is known of a joint's law beside its equations, as each law's file declares it.

Parameters of the joint laws: defaults, columns, refusals.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.laws.columns import LawCode, Parameter, Variable

Point = Callable[
    [int, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray], None
]
Energy = Callable[[int, FloatArray, FloatArray, FloatArray, FloatArray], float]


@dataclass(frozen=True)
class Law:
    """A law: its equations at one point, compiled, and what is known beside them.

    Attributes
    ----------
    code : int
        Number that compiled code knows it by.
    point : callable
        `point(code, w, state, p, t, new, D)`: traction t, new state and tangent D of a jump w,
        written in place.
    energy : callable
        `energy(code, w, t, state, p)`: stored energy per unit area at the point's own state.
    required, optional : tuple of str
        Parameters as scripts name them (KS stands for KS1 and KS2).
    check : callable or None
        Refuses inadmissible parameters (n, N_PARAMETERS).
    linear : bool
        True if the elastic stiffness says all.
    angles : dict
        Parameters in degrees, with the columns that take their tangents.
    variables : dict
        Internal variables that results show, with their columns of the state, whose sum they are.
    opposite : dict
        Further ones, each another variable with its sign changed.
    rocking : callable or None
        For a whole footing at a joint of two points, whose jumps are rotations and opening: its
        stiffness in full contact about t1 and t2, each (n,), from the parameters; `turning` has
        what counts in the plane.
    in_space : tuple of str or None
        Parameters that it needs in three dimensions beside; None if it is plane.
    two_points : bool
        Stands between two points alone (JOI1).
    opens : bool
        False if it pulls as it presses: what stands on it cannot lift.
    """

    code: LawCode
    point: Point
    energy: Energy
    required: tuple[str, ...]
    optional: tuple[str, ...] = ()
    check: Callable[[FloatArray], None] | None = None
    linear: bool = False
    angles: dict[str, tuple[str, ...]] = field(default_factory=dict)
    variables: dict[str, tuple[Variable, ...]] = field(default_factory=dict)
    opposite: dict[str, str] = field(default_factory=dict)
    rocking: Callable[[FloatArray], tuple[FloatArray, FloatArray]] | None = None
    in_space: tuple[str, ...] | None = ()
    two_points: bool = False
    opens: bool = True

    @property
    def macro(self) -> bool:
        """True for a whole footing."""
        return self.rocking is not None

    def turning(self, p: FloatArray, dimension: int) -> tuple[FloatArray, FloatArray]:
        """Stiffness (n,) of a whole footing about t1 and t2; in the plane about t2 alone, twice.

        The plane has the side LARG, along t1; LONG is how far the footing goes on behind it.
        """
        assert self.rocking is not None
        about_1, about_2 = self.rocking(p)
        return (about_2 if dimension == 2 else about_1), about_2


SLIPS: dict[str, tuple[Variable, ...]] = {"GLI1": (Variable.SLIP1,), "GLI2": (Variable.SLIP2,)}


DEFAULTS: dict[str, float] = {"FROT": -1.0, "ETA": 1.0, "BETA": 0.5}
"""What laws take for the parameters that are not given, if not 0: a joint without tension, the
plainest hysteresis."""


def columns_of(parameters: FloatArray) -> dict[str, FloatArray]:
    """Parameters (n,) by name, of a table (n, N_PARAMETERS).

    Raises
    ------
    MaterialError
        If one is no finite number.
    """
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite")
    return {p.name: parameters[:, p] for p in Parameter}


def refuse(wrong: np.ndarray, values: FloatArray, name: str, wanted: str) -> None:
    """Refuse the first value of a parameter that is `wrong`: it must be as `wanted`."""
    if wrong.any():
        told = {"name": name, "values": values[wrong][0], "wanted": wanted}
        raise MaterialError("kernel.interface.joint-parameter-must", **told)
