"""Whether the system has what scenes in space are drawn with; found apart from what is tested."""

import sys
from ctypes import CDLL
from functools import cache

import pytest


@cache
def can_draw() -> bool:
    """Whether EGL or OSMesa is installed; elsewhere than on Linux VTK brings what it needs."""
    if not sys.platform.startswith("linux"):
        return True
    for name in ("libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so.6"):
        try:
            CDLL(name)
        except OSError:
            continue
        return True
    return False


needs_window = pytest.mark.skipif(not can_draw(), reason="no EGL and no OSMesa")
