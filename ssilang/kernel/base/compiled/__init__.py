"""Compiled code: decorators, where it is kept, functions that callers reach by address.

With SSILANG_PLAIN_NUMBA=1 the environment turns all that is ours off here: functions `apart` are
compiled into their callers and code is kept only where NUMBA_CACHE_DIR says. Answers are the same,
starts take longer; for a numba whose insides `apart` does not know.
"""

from __future__ import annotations

import os

PLAIN = os.environ.get("SSILANG_PLAIN_NUMBA", "") not in ("", "0")

UNCOMPILED = os.environ.get("NUMBA_DISABLE_JIT", "") not in ("", "0")
"""Functions run as Python has them."""

ALLOWED: set[str] = set()
"""What this process may start: `beside`, a second one that compiles."""
