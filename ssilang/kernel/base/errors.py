"""Errors raised by the kernel: a code and data; `ssilang.messages` has the sentences."""

from ssilang.messages.message import Refusal


class KernelError(Refusal):
    """An input or a state that the kernel cannot work with."""


class NoResultError(KernelError, ArithmeticError):
    """A sign between two values that have no result: the values are at fault, not the sign."""


class MeshError(KernelError):
    """A mesh operation that has no meaning for the meshes given."""


class FieldError(KernelError):
    """Fields whose supports or components do not fit the operation."""


class MaterialError(KernelError):
    """A missing, unknown or inadmissible material parameter."""

    names: tuple[str, ...] = ()
    """Parameters that it is about, where its data do not name one."""

    def about(self, *names: str) -> "MaterialError":
        """The same error, about these parameters."""
        self.names = names
        return self


class LostSolverError(KernelError):
    """The program beside us that solves has ended, in the middle of what it was asked."""


class SingularMatrixError(KernelError):
    """The system has a free rigid-body motion or mechanism; `hint` names its unknowns."""


class ConvergenceError(KernelError):
    """An iteration did not converge; the message says at which time and with which residual."""


class SingularFactorError(Exception):
    """A backend met an exactly zero pivot; `inverse.py` turns it into a message."""
