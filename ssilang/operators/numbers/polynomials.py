"""Roots of polynomials: RACP, DEG3 of the third degree."""

from ssilang.kernel.base.arrays import ComplexArray
from ssilang.operators.prelude import *

RACP = shared("RACP", "numbers", full_name="RACPOL")
_POLYNOMIAL = (
    flag("bairstow", "BAIR", en="changes nothing"),
    opt("listed", "LISTREEL", en="coefficients by power", range=ANY_NUMBER),
    many("numbers", "FLOTTANT", en="coefficients, else", range=ANY_NUMBER),
)


@RACP.form(said("IMAG"), *_POLYNOMIAL)
def _all_roots(
    call: Call, bairstow: bool, listed: ListReel | None, numbers: tuple[float, ...]
) -> tuple[ListReel, ListReel]:
    roots = _roots(call, listed, numbers)
    return ListReel(roots.real), ListReel(roots.imag)


@RACP.form(
    said("INTE"),
    arg("low", "FLOTTANT", en="one end of an interval", range=ANY_NUMBER),
    arg("high", "FLOTTANT", en="the other end", range=ANY_NUMBER),
    *_POLYNOMIAL,
    gives="FLOTTANT|MOT",
)
def _root_within(
    call: Call,
    low: float,
    high: float,
    bairstow: bool,
    listed: ListReel | None,
    numbers: tuple[float, ...],
) -> float | Mot:
    real = _real_roots(_roots(call, listed, numbers))
    inside = real[(real >= min(low, high)) & (real <= max(low, high))]
    return float(inside[0]) if len(inside) else Mot("VIDE")


@RACP.form(*_POLYNOMIAL)
def _roots_of(
    call: Call, bairstow: bool, listed: ListReel | None, numbers: tuple[float, ...]
) -> ListReel:
    return ListReel(_real_roots(_roots(call, listed, numbers)))


def _roots(call: Call, listed: ListReel | None, numbers: tuple[float, ...]) -> ComplexArray:
    """Roots of a polynomial, by real and then by imaginary part."""
    coefficients = listed.values if listed is not None else np.asarray(numbers)
    trimmed = np.trim_zeros(np.asarray(coefficients, dtype=float), "b")
    if len(trimmed) < 2:
        raise call.error("operators.numbers.constant-polynomial")
    roots = np.roots(trimmed[::-1]).astype(complex)
    return roots[np.lexsort((roots.imag, roots.real))]


def _real_roots(roots: ComplexArray) -> FloatArray:
    # a real double root comes out of the companion matrix with an imaginary part of order
    # sqrt(machine precision)
    real = roots.real[np.abs(roots.imag) <= 1e-7 * np.maximum(np.abs(roots), 1e-12)]
    return np.sort(real)


@operator("DEG3", family="numbers")
def deg3(
    call: Call,
    a0: float = Arg("FLOTTANT", en="constant term", range=ANY_NUMBER),
    a1: float = Arg("FLOTTANT", en="factor of X", range=ANY_NUMBER),
    a2: float = Arg("FLOTTANT", en="factor of X**2", range=ANY_NUMBER),
    a3: float = Arg("FLOTTANT", en="factor of X**3", range=ANY_NUMBER),
) -> tuple[float, float, float, float, float, float]:
    """Roots as eigenvalues of the companion matrix."""
    if a3 == 0.0 or not np.isfinite([a0, a1, a2, a3]).all():
        raise call.error("operators.numbers.not-third-degree")
    roots = np.roots([a3, a2, a1, a0])
    small = 1e-12 * np.abs(roots).max(initial=0.0)
    pairs = [(float(r.real), float(r.imag) if abs(r.imag) > small else 0.0) for r in roots]
    pairs.sort(key=lambda p: (p[1] != 0.0, p[0], p[1]))
    first, second, third = pairs
    return (*first, *second, *third)
