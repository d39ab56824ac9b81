"""Small loops for compiled code: what numba makes of whole arrays takes it seconds to compile."""

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast, compiled_threaded


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


@compiled_fast
def add_product(factor: float, A: FloatArray, x: FloatArray, y: FloatArray) -> None:
    """y += factor A x, four rows at a time: x is read as many times less."""
    whole = len(A) // 4 * 4
    for i in range(0, whole, 4):
        a, b, c, d = A[i], A[i + 1], A[i + 2], A[i + 3]
        ax, bx, cx, dx = 0.0, 0.0, 0.0, 0.0
        for j in range(len(x)):
            ax += a[j] * x[j]
            bx += b[j] * x[j]
            cx += c[j] * x[j]
            dx += d[j] * x[j]
        y[i] += factor * ax
        y[i + 1] += factor * bx
        y[i + 2] += factor * cx
        y[i + 3] += factor * dx
    for i in range(whole, len(A)):
        y[i] += factor * dot(A[i], x)


@compiled_threaded
def add_symmetric_product(A: FloatArray, x: FloatArray, y: FloatArray) -> None:
    """y += A x of a symmetric A, of which half is read."""
    for i in range(0, len(A) - 1, 2):
        a, b, xa, xb = A[i], A[i + 1], x[i], x[i + 1]
        ax, bx = a[i] * xa + a[i + 1] * xb, b[i] * xa + b[i + 1] * xb
        for j in range(i):
            ax += a[j] * x[j]
            bx += b[j] * x[j]
            y[j] += a[j] * xa + b[j] * xb
        y[i] += ax
        y[i + 1] += bx
    for i in range(len(A) // 2 * 2, len(A)):
        for j in range(i):
            y[j] += A[i, j] * x[i]
        y[i] += dot(A[i], x)


@compiled
def largest(v: FloatArray) -> float:
    """The largest absolute value of a vector, 0 of an empty one."""
    top = 0.0
    for i in range(v.shape[0]):
        top = max(top, abs(v[i]))
    return top
