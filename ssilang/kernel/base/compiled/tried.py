"""With which Python, numba, LLVM and numpy the ways into numba's insides were tried.

Elsewhere plain numba compiles: the same answers, later. Who has tried further versions (the tests
of this folder with SSILANG_PLAIN_NUMBA=0 in the environment) adds them here.
"""

import re
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np

TRIED = {
    "Python": ("3.11", "3.12", "3.13", "3.14"),
    "numba": ("0.68",),
    "llvmlite": ("0.50",),
    "numpy": ("2.0", "2.1", "2.2", "2.3", "2.4"),
}
"""First parts of versions."""

_VERSION = re.compile(r"""version(?:_version)?"?\s*[:=]\s*["']([^"']+)["']""")


def untried() -> str:
    """What was not tried, '' if all was: 'numba 0.70.0', or the kind of interpreter."""
    if sys.implementation.name != "cpython":
        return sys.implementation.name
    if is_free_threaded():
        return "a free-threaded Python"
    if hasattr(sys, "gettotalrefcount"):
        return "a debug build of Python"
    for name, tried in TRIED.items():
        version = version_of(name)
        if not any(f"{version}.".startswith(f"{known}.") for known in tried):
            return f"{name} {version or '?'}"
    return ""


def is_free_threaded() -> bool:
    """Whether Python is built without its lock: objects are laid out in another way."""
    if hasattr(sys, "abiflags"):
        return "t" in sys.abiflags
    import sysconfig

    return bool(sysconfig.get_config_var("Py_GIL_DISABLED"))


def version_of(name: str) -> str:
    """A library's version, '' if it does not say; numba and llvmlite are not imported for it."""
    if name == "Python":
        return "{}.{}.{}".format(*sys.version_info)
    if name == "numpy":
        return np.__version__
    spec = find_spec(name)
    if spec is None or spec.origin is None:
        return ""
    try:
        text = Path(spec.origin).with_name("_version.py").read_text(encoding="utf-8")
    except OSError:
        return ""
    found = _VERSION.search(text)
    return found[1] if found is not None else ""
