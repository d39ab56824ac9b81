"""Modules of scipy under short names, and pyvista: each loaded when something in it is used.

Loading them takes 0.04 to 0.3 s, which a script without matrices does not need.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pyvista
    from scipy import interpolate, optimize, signal, spatial, special, stats
    from scipy import linalg as la
    from scipy import sparse as sp
    from scipy.sparse import csgraph
    from scipy.sparse import linalg as spla
else:

    class _Deferred:
        def __init__(self, module: str) -> None:
            self._module = module

        def __getattr__(self, name: str) -> Any:
            value = getattr(import_module(self._module), name)
            setattr(self, name, value)
            return value

    interpolate = _Deferred("scipy.interpolate")
    la = _Deferred("scipy.linalg")
    optimize = _Deferred("scipy.optimize")
    signal = _Deferred("scipy.signal")
    sp = _Deferred("scipy.sparse")
    csgraph = _Deferred("scipy.sparse.csgraph")
    spla = _Deferred("scipy.sparse.linalg")
    spatial = _Deferred("scipy.spatial")
    special = _Deferred("scipy.special")
    stats = _Deferred("scipy.stats")
    pyvista = _Deferred("pyvista")

__all__ = [
    "csgraph", "interpolate", "la", "optimize", "pyvista", "signal", "sp", "spatial", "special",
    "spla", "stats",
]  # fmt: skip
