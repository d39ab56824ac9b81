"""scipy.sparse under the name `sp`, loaded when it is first used.

Loading it takes 0.2 s, which a script without matrices does not need.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import scipy.sparse as sp
else:

    class _Deferred:
        def __getattr__(self, name: str) -> Any:
            import scipy.sparse

            value = getattr(scipy.sparse, name)
            setattr(self, name, value)
            return value

    sp = _Deferred()

__all__ = ["for_products", "sp"]

SMALL = 160
"""Rows and columns up to which a dense product takes less than scipy's call of a sparse one.

Seven diagonals: 8.3 us sparse and 3.8 dense at 160, 5.4 and 12.5 at 240.
"""


def for_products(A: Any) -> Any:
    """A sparse matrix that multiplies many vectors: a dense array where it is small."""
    return A.toarray() if max(A.shape) <= SMALL else sp.csr_array(A)
