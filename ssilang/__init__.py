"""ssilang: a Gibiane interpreter for soil-structure interaction with foundation uplift.

`run`, `check` and `sweep` run scripts from Python; what they give, and `Error`, stand in
`ssilang.api`, which is imported when one of these names is first used.
"""

import ssilang.search_path  # noqa: F401  before anything else is imported

# isort: split
from importlib import import_module
from typing import Any

from ssilang.late_imports import load_late
from ssilang.threads import one_blas_thread

__version__ = "0.1.0"

_WHERE = {
    "Builder": "building",
    "Error": "errors",
    "MissingKey": "errors",
    "Notice": "errors",
    "Result": "result",
    "check": "running",
    "run": "running",
    "sweep": "sweeps",
}
"""Names of the way in from Python, by the module of `ssilang.api` that has them."""

one_blas_thread()
load_late()


def __getattr__(name: str) -> Any:
    """What `ssilang.api` has, imported now; its types stand in `__init__.pyi`."""
    if name in _WHERE:
        return getattr(import_module(f"ssilang.api.{_WHERE[name]}"), name)
    raise AttributeError(f"module 'ssilang' has no attribute '{name}'", name=name, obj=None)


def __dir__() -> list[str]:
    return sorted({*globals(), *_WHERE})
