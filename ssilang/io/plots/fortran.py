"""Numbers written by a Fortran edit descriptor: '(F5.1)', '(I4)', '(1PE12.5)', '(G10.2)'."""

from __future__ import annotations

import re

from ssilang.io.errors import OutputError

_DESCRIPTOR = re.compile(r"\(?\s*(?:1P)?([IFEDG])(\d+)(?:\.(\d+))?(?:E\d+)?\s*\)?$", re.IGNORECASE)


def formatted(descriptor: str, value: float) -> str:
    """`value` as the descriptor writes it, without leading blanks.

    Raises
    ------
    OutputError
        For a descriptor that is not one of I, F, E, D, G.
    """
    match = _DESCRIPTOR.match(descriptor.strip())
    if match is None:
        raise OutputError("io.no-number-format", descriptor=descriptor)
    kind = match.group(1).upper()
    digits = int(match.group(3) or 0)
    if kind == "I":
        return str(round(value))
    if kind == "F":
        return f"{value:.{digits}f}"
    if kind == "G":
        return f"{value:.{max(digits, 1)}G}"
    return f"{value:.{digits}E}"
