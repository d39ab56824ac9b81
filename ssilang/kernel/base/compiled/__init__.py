"""Compiled code: decorators, where it is kept, functions that callers reach by address.

With SSILANG_PLAIN_NUMBA=1 the environment turns all that is ours off here: functions `apart` are
compiled into their callers and code is kept only where NUMBA_CACHE_DIR says. Answers are the same,
starts take longer. So it is by itself with versions of Python, numba, llvmlite and numpy that were
not tried (`tried`), where numba keeps code as it does; SSILANG_PLAIN_NUMBA=0 tries them.
"""

import os
import sys
import warnings

from ssilang.kernel.base.compiled.tried import untried

if os.path.isfile(".numba_config.yaml") and "numba" not in sys.modules:
    # it may be anybody's, and turns compiling off: settings come by the environment alone
    yaml = sys.modules.get("yaml")
    sys.modules["yaml"] = None  # type: ignore[assignment]  # numba finds no reader
    with warnings.catch_warnings(action="ignore"):
        from numba.core import config
    config._config_fname = os.devnull  # each compilation looks
    del sys.modules["yaml"]
    if yaml is not None:
        sys.modules["yaml"] = yaml

UNTRIED = untried()
"""What of these versions was not tried, '' if all was."""

_SAID = os.environ.get("SSILANG_PLAIN_NUMBA", "")
PLAIN = bool(UNTRIED) if _SAID == "" else _SAID != "0"
"""Plain numba compiles."""

UNCOMPILED = os.environ.get("NUMBA_DISABLE_JIT", "") not in ("", "0")
"""Functions run as Python has them."""

ALLOWED: set[str] = set()
"""What this process may start: `beside`, a second one that compiles."""
