"""Errors raised by the kernel: data first, one sentence made from it last."""

from __future__ import annotations


class KernelError(Exception):
    """An input or a state that the kernel cannot work with.

    Parameters
    ----------
    message : str
        What is wrong, in one sentence, with the figures that show it.
    hint : str, optional
        What to change to get further.
    """

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint


class MeshError(KernelError):
    """A mesh operation that has no meaning for the meshes given."""


class FieldError(KernelError):
    """Fields whose supports or components do not fit the operation."""


class MaterialError(KernelError):
    """A missing, unknown or inadmissible material parameter."""


class SingularMatrixError(KernelError):
    """The system has a free rigid-body motion or mechanism; `hint` names its unknowns."""


class ConvergenceError(KernelError):
    """An iteration did not converge; the message says at which time and with which residual."""


class SingularFactorError(Exception):
    """A backend met an exactly zero pivot; `inverse.py` turns it into a message."""
