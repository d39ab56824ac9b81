"""ssilang: a Gibiane interpreter for soil-structure interaction with foundation uplift."""

from ssilang.late_imports import load_late
from ssilang.threads import one_blas_thread

__version__ = "0.1.0"

one_blas_thread()
load_late()
