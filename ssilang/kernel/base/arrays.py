"""Types of arrays."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

IntArray = NDArray[np.int64]
FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
ComplexArray = NDArray[np.complex128]
SINGLE: Any = np.float32  # of arrays whose numbers are read more often than they need digits
