"""DIAD LTL CVOL FONC ZLEG: lists of reals as samples, special functions, quadrature."""

from ssilang.kernel.base.scientific import special
from ssilang.operators.prelude import *


@operator("DIAD", family="lists")
def diad(
    way: str = Choice(
        ("DIRE", "INVE", "IVIN"), default="DIRE", en="halved, or doubled with zeros or with means"
    ),
    values: ListReel = Arg("LISTREEL", en="samples", range=ANY_NUMBER),
) -> ListReel:
    """Halve or double the sampling."""
    y = values.values
    if way == "DIRE":
        return ListReel(y[::2].copy())
    made = np.zeros(2 * len(y) - len(y) % 2)
    made[::2] = y
    if way == "IVIN" and len(y):
        after = np.append(y[1:], y[-1])  # behind the last value stands nothing: the same again
        made[1::2] = 0.5 * (y + after)[: len(made) // 2]
    return ListReel(made)


@operator("LTL", family="lists")
def ltl(
    call: Call,
    first: ListReel = Arg("LISTREEL", en="first list", range=ANY_NUMBER),
    second: ListReel | None = Opt("LISTREEL", en="second one, else the first", range=ANY_NUMBER),
    a: float = Opt("FLOTTANT", default=1.0, en="factor", range=ANY_NUMBER),
    b: float = Opt("FLOTTANT", default=1.0, en="second factor", range=ANY_NUMBER),
) -> float:
    """Dot product."""
    other = first if second is None else second
    if len(first) != len(other):
        raise call.error("operators.lists.dot-product", n_first=len(first), n_other=len(other))
    return float(a * b * (first.values @ other.values))


@operator("CVOL", family="signals")
def cvol(
    call: Call,
    signal: ListReel = Arg("LISTREEL", en="signal", range=ANY_NUMBER),
    response: ListReel = Arg("LISTREEL", en="response", range=ANY_NUMBER),
    before: int | None = Key(
        "NPNE",
        "ENTIER",
        range=NOT_NEGATIVE,
        en="number of its values before 0; by default it is symmetric",
    ),
    ends: str = Choice(
        ("SYME", "PADD"), default="SYME", en="beyond its ends the signal is mirrored, or zero"
    ),
) -> ListReel:
    """Convolution."""
    samples, kernel, mirrored = signal.values, response.values, ends == "SYME"
    if before is None:
        before = len(kernel) - 1
        kernel = np.concatenate([kernel[:0:-1], kernel])
    after = len(kernel) - 1 - before
    if len(kernel) == 0 or before < 0 or after < 0:
        raise call.error(
            "operators.lists.response-too-short", n_response=len(kernel), before=before
        )
    if mirrored and max(before, after) > len(samples) - 1:
        raise call.error(
            "operators.lists.signal-too-short", n_signal=len(samples), before=max(before, after)
        )
    # value k needs the signal from k - after to k + before
    padded = np.pad(samples, (after, before), "reflect" if mirrored else "constant")
    return ListReel(np.convolve(padded, kernel, "valid"))


def _special(kind: str, name: str, x: NDArray[np.float64]) -> NDArray[np.float64]:
    if kind == "BESS":
        found = {"J0": special.j0, "J1": special.j1, "Y0": special.y0, "Y1": special.y1}[name](x)
    elif kind == "FRES":
        sine, cosine = special.fresnel(np.sqrt(2.0 * x / np.pi))
        found = cosine if name == "CX" else sine
    else:
        found = special.gamma(x)
    return np.asarray(found, dtype=float)


@operator("FONC", family="lists", full_name="FONCTION")
def fonc(
    call: Call,
    function: Chosen = Cases(
        {
            "BESSEL": [choice("name", ("J0", "J1", "Y0", "Y1"), optional=False)],
            "FRESNEL": [choice("name", ("CX", "SX"), optional=False)],
            "GAMMA": [],
        },
        optional=False,
        en="which function",
    ),
    values: ListReel = Arg("LISTREEL", en="arguments", range=ANY_NUMBER),
) -> ListReel:
    """Special functions."""
    kind, name = function.word[:4], function.values.get("name", "")
    x = values.values
    bad = {"FRES": x < 0.0, "GAMM": (x <= 0.0) & (x == np.round(x))}.get(kind, np.zeros(0, bool))
    if name in ("Y0", "Y1"):
        bad = x <= 0.0
    if bad.any():
        raise call.error("operators.lists.function-undefined", x=x[bad][0])
    return ListReel(_special(kind, name, x))


@operator("ZLEG", family="lists")
def zleg(
    degree: int = Arg("ENTIER", en="degree", range=between(1, 500)),
) -> tuple[ListReel, ListReel]:
    """Lobatto's quadrature."""
    legendre = np.polynomial.legendre.Legendre.basis(degree)
    inner = np.sort(legendre.deriv().roots().real) if degree > 1 else np.zeros(0)
    x = np.concatenate([[-1.0], inner, [1.0]])
    w = 2.0 / (degree * (degree + 1) * legendre(x) ** 2)
    return ListReel(x), ListReel(w)
