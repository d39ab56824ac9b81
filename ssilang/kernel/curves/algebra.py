"""Sums, products, integrals and interpolation of curves; complex curves are pairs of parts."""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.scientific import interpolate
from ssilang.kernel.curves.curve import Curve, CurvePart

_COMPLEX = {"PREE": "PIMA", "MODU": "PHAS"}


def is_complex(curve: Curve) -> bool:
    """Whether the parts are pairs: real and imaginary, or modulus and phase."""
    return (
        bool(curve.parts)
        and len(curve.parts) % 2 == 0
        and all(
            _COMPLEX.get(a.kind) == b.kind
            for a, b in zip(curve.parts[::2], curve.parts[1::2], strict=True)
        )
    )


def complex_values(real: CurvePart, imaginary: CurvePart) -> Any:
    """Complex ordinates of a pair of parts; phases are in degrees."""
    if real.kind == "MODU":
        return real.ordinates * np.exp(1j * np.radians(imaginary.ordinates))
    return real.ordinates + 1j * imaginary.ordinates


def complex_parts(like: tuple[CurvePart, CurvePart], values: Any) -> tuple[CurvePart, CurvePart]:
    """A pair of parts with other complex ordinates, in the form (PREE or MODU) of `like`."""
    if like[0].kind == "MODU":
        two = np.abs(values), np.degrees(np.angle(values))
    else:
        two = values.real, values.imag
    return (
        dataclasses.replace(like[0], ordinates=two[0]),
        dataclasses.replace(like[1], ordinates=two[1]),
    )


def check_increasing(x: FloatArray) -> None:
    """Refuse abscissas that go back."""
    if len(x) > 1 and np.any(np.diff(x) < 0):
        k = int(np.flatnonzero(np.diff(x) < 0)[0])
        raise FieldError("kernel.curves.abscissas-must-increase-follows", x=x[k + 1], x_2=x[k])


def sampled(part: CurvePart, x: FloatArray) -> FloatArray:
    """Ordinates at `x`, linear between the points of the curve, constant outside."""
    check_increasing(part.abscissas)
    return np.interp(x, part.abscissas, part.ordinates)


def _same_abscissas(a: CurvePart, b: CurvePart) -> bool:
    return len(a.abscissas) == len(b.abscissas) and bool(
        np.allclose(a.abscissas, b.abscissas, rtol=1e-10, atol=1e-300)
    )


def _on_common_domain(a: CurvePart, b: CurvePart, run: Callable[[Any, Any], Any]) -> CurvePart:
    if _same_abscissas(a, b):
        return dataclasses.replace(a, ordinates=run(a.ordinates, b.ordinates))
    low = max(a.abscissas.min(), b.abscissas.min())
    high = min(a.abscissas.max(), b.abscissas.max())
    if low > high:
        raise FieldError("kernel.curves.two-curves-no-abscissa")
    x = np.union1d(a.abscissas, b.abscissas)
    x = x[(x >= low) & (x <= high)]
    return dataclasses.replace(a, abscissas=x, ordinates=run(sampled(a, x), sampled(b, x)))


def combined(a: Curve, b: Curve, sign: str, run: Callable[[Any, Any], Any]) -> Curve:
    """Curve by curve: sums over the common domain, products and quotients on equal abscissas.

    Raises
    ------
    FieldError
        If the numbers of curves, the kinds or the abscissas do not fit.
    """
    if len(a.parts) != len(b.parts):
        raise FieldError(
            "kernel.curves.objects-curves", n_parts=len(a.parts), n_parts_2=len(b.parts)
        )
    if is_complex(a) != is_complex(b):
        raise FieldError("kernel.curves.real-curve-complex-cannot")
    if is_complex(a):
        return _combined_complex(a, b, run)
    parts = []
    for x, y in zip(a.parts, b.parts, strict=True):
        if sign in "*/" and not _same_abscissas(x, y):
            raise FieldError("kernel.curves.curves-multiplied-same-abscissas")
        if sign == "/" and np.any(y.ordinates == 0):
            raise FieldError("kernel.curves.ordinate-divisor-zero")
        parts.append(_on_common_domain(x, y, run))
    return Curve(tuple(parts), a.title, a.kind)


def _combined_complex(a: Curve, b: Curve, run: Callable[[Any, Any], Any]) -> Curve:
    parts: list[CurvePart] = []
    for i in range(0, len(a.parts), 2):
        mine, other = (a.parts[i], a.parts[i + 1]), (b.parts[i], b.parts[i + 1])
        if not _same_abscissas(mine[0], other[0]):
            raise FieldError("kernel.curves.complex-curves-must-same")
        parts += complex_parts(mine, run(complex_values(*mine), complex_values(*other)))
    return Curve(tuple(parts), a.title, a.kind)


def integral_along(part: CurvePart, first: int, last: int, absolute: bool = False) -> float:
    """Integral by trapezes from one point to another (0-based), in the order of the points.

    Abscissas may go back, as on the loops of a force against its displacement: the integral of
    a closed one is the area inside, negative where it is turned around anticlockwise. `first`
    behind `last` changes the sign.
    """
    if first > last:
        return -integral_along(part, last, first, absolute)
    y = np.abs(part.ordinates) if absolute else part.ordinates
    span = slice(first, last + 1)
    return float(np.trapezoid(y[span], part.abscissas[span]))


def integral(part: CurvePart, low: float, high: float, absolute: bool = False) -> float:
    """Integral from abscissa `low` to `high` by trapezes, exact for a curve linear between points.

    The abscissas of the curve increase or decrease. With `absolute`, of the absolute value of
    the ordinates at the points.
    """
    if low > high:
        return -integral(part, high, low, absolute)
    order = -1 if len(part.abscissas) and part.abscissas[0] > part.abscissas[-1] else 1
    x, ordinates = part.abscissas[::order], part.ordinates[::order]
    check_increasing(x)
    y = np.abs(ordinates) if absolute else ordinates
    inside = (x > low) & (x < high)
    ends = np.interp([low, high], x, y)
    points = np.concatenate(([low], x[inside], [high]))
    values = np.concatenate((ends[:1], y[inside], ends[1:]))
    return float(np.trapezoid(values, points))


def primitive(part: CurvePart) -> CurvePart:
    """Running integral by trapezes, zero at the first abscissa."""
    steps = np.diff(part.abscissas) * (part.ordinates[1:] + part.ordinates[:-1]) / 2
    return dataclasses.replace(part, ordinates=np.concatenate(([0.0], np.cumsum(steps))))


def spline(
    x: FloatArray, y: FloatArray, at: FloatArray, left: float | None, right: float | None
) -> FloatArray:
    """Cubic spline at `at`: natural ends, or given first derivatives."""
    if len(x) < 2:
        raise FieldError("kernel.curves.spline-needs-two-points", n_x=len(x))
    if len(x) != len(y):
        raise FieldError("kernel.curves.spline-many-abscissas-values", n_x=len(x), n_y=len(y))
    order = slice(None, None, -1) if x[0] > x[-1] else slice(None)
    ends: Any = ((2, 0.0) if left is None else (1, left), (2, 0.0) if right is None else (1, right))
    if np.any(np.diff(x[order]) <= 0):
        raise FieldError("kernel.curves.abscissas-spline-must-increase")
    return interpolate.CubicSpline(x[order], y[order], bc_type=ends)(at)


def interpolated(x: FloatArray, y: FloatArray, at: FloatArray) -> FloatArray:
    """Linear interpolation; abscissas increase or decrease, not both; constant outside."""
    if len(x) != len(y):
        raise FieldError("kernel.curves.abscissas-ordinates", n_x=len(x), n_y=len(y))
    if len(x) == 0:
        raise FieldError("kernel.curves.no-point-interpolate-between")
    steps = np.diff(x)
    if np.all(steps <= 0) and np.any(steps < 0):
        x, y = x[::-1], y[::-1]
    elif np.any(steps < 0):
        raise FieldError("kernel.curves.abscissas-must-increase-decrease")
    return np.interp(at, x, y)


def beyond(x: FloatArray, y: FloatArray, at: FloatArray) -> float | None:
    """The value of `at` that is farthest outside of a curve, where that does not end flat."""
    order = np.argsort(x, kind="stable")
    x, y = x[order], y[order]
    if len(x) < 2 or not np.size(at):
        return None
    slack = 1e-9 * (x[-1] - x[0])
    low, high = float(np.min(at)), float(np.max(at))
    below = x[0] - low if y[1] != y[0] else 0.0
    above = high - x[-1] if y[-2] != y[-1] else 0.0
    return None if max(below, above) <= slack else low if below > above else high


def crossings(x: FloatArray, y: FloatArray, at: float) -> FloatArray:
    """All ordinates of a line of points where its abscissa is `at`."""
    found: list[float] = []
    for i in range(len(x) - 1):
        a, b = x[i], x[i + 1]
        if a == b == at:
            found += [float(y[i]), float(y[i + 1])]
        elif min(a, b) <= at <= max(a, b) and a != b:
            found.append(float(y[i] + (y[i + 1] - y[i]) * (at - a) / (b - a)))
    kept = [v for i, v in enumerate(found) if i == 0 or not np.isclose(v, found[i - 1])]
    return np.asarray(kept)
