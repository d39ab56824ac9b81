"""Modules of scipy under short names, each loaded when something in it is used.

Loading them takes 0.04 to 0.3 s, which a script without matrices does not need.
"""

from typing import TYPE_CHECKING

from ssilang.late_imports import Late

if TYPE_CHECKING:
    from scipy import fft, interpolate, optimize, signal, spatial, special, stats
    from scipy import linalg as la
    from scipy import sparse as sp
    from scipy.sparse import csgraph
    from scipy.sparse import linalg as spla
else:
    fft = Late("scipy.fft")
    interpolate = Late("scipy.interpolate")
    la = Late("scipy.linalg")
    optimize = Late("scipy.optimize")
    signal = Late("scipy.signal")
    sp = Late("scipy.sparse")
    csgraph = Late("scipy.sparse.csgraph")
    spla = Late("scipy.sparse.linalg")
    spatial = Late("scipy.spatial")
    special = Late("scipy.special")
    stats = Late("scipy.stats")

__all__ = [
    "csgraph", "fft", "interpolate", "la", "optimize", "signal", "sp", "spatial", "special",
    "spla", "stats",
]  # fmt: skip
