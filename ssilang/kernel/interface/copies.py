"""Small loops for compiled code: what numba makes of whole arrays takes it seconds to compile."""

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast


@compiled
def clear(matrix: FloatArray) -> None:
    """Zeros into a matrix."""
    for i in range(matrix.shape[0]):
        for j in range(matrix.shape[1]):
            matrix[i, j] = 0.0


@compiled
def copy_state(source: FloatArray, target: FloatArray) -> None:
    """A vector into another."""
    for i in range(source.shape[0]):
        target[i] = source[i]


@compiled
def copy_rows(source: FloatArray, target: FloatArray) -> None:
    """A matrix into another."""
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[i, j] = source[i, j]


@compiled
def is_equal(A: FloatArray, B: FloatArray) -> bool:
    """Whether two matrices hold the same numbers; NaN is equal to nothing."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            if A[i, j] != B[i, j]:
                return False
    return True


@compiled_fast
def dot(a: FloatArray, b: FloatArray) -> float:
    """Scalar product of two vectors."""
    total = 0.0
    for i in range(len(a)):
        total += a[i] * b[i]
    return total


@compiled
def largest(v: FloatArray) -> float:
    """The largest absolute value of a vector, 0 of an empty one."""
    top = 0.0
    for i in range(v.shape[0]):
        top = max(top, abs(v[i]))
    return top
