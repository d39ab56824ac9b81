"""Errors of reading and writing files."""

from __future__ import annotations

from ssilang.kernel.base.errors import KernelError


class OutputError(KernelError):
    """A file or picture cannot be written: wrong objects, forbidden or full place."""


class NoGraphicsError(OutputError):
    """This system has no library that draws in space."""


class InputError(KernelError):
    """A file cannot be read: absent, of another format, or damaged."""
