"""ENTI FLOT VERI: conversions between integers, reals and words."""

from ssilang.kernel.fields import node_algebra
from ssilang.operators.prelude import *


def nearest(x: Any) -> Any:
    """Nearest integer; halves go away from zero."""
    return np.sign(x) * np.floor(np.abs(x) + 0.5)


_ROUNDINGS: dict[str, Callable[[Any], Any]] = {
    "TRONCATURE": np.trunc, "INFERIEUR": np.floor, "SUPERIEUR": np.ceil, "PROCHE": nearest,
}  # fmt: skip


def number_in(call: Call, word: str) -> float:
    """The number that a word says, in any usual way of writing it."""
    try:
        return float(str(word).strip().upper().replace("D", "E"))
    except ValueError:
        raise call.error("operators.numbers.not-number", word, word=word) from None


def _whole(call: Call, values: Any) -> Any:
    if np.any(~np.isfinite(values)) or np.any(np.abs(values) >= 2.0**63):
        raise call.error("operators.numbers.integer-too-large")
    return values.astype(np.int64)


@operator("ENTI", gives="ENTIER|LISTENTI|CHPOINT", family="numbers", full_name="ENTIER")
def enti(
    call: Call,
    way: str = Choice(tuple(_ROUNDINGS), default="TRONCATURE", en="cut, below, above or nearest"),
    value: Any = Arg(
        "ENTIER",
        "FLOTTANT",
        "LISTREEL",
        "LISTENTI",
        "CHPOINT",
        "LISTMOTS",
        "MOT",
        en="numbers, or words that say them",
        range=CARRIED,
    ),
) -> Any:
    """Round."""
    rounding = _ROUNDINGS[way]
    if isinstance(value, NodeField):
        return node_algebra.applied(value, rounding)
    if isinstance(value, str):
        value = number_in(call, value)
    elif isinstance(value, ListMots):
        value = ListReel([number_in(call, w) for w in value.values])
    if isinstance(value, int | float):
        return int(_whole(call, np.asarray(rounding(float(value)))))
    return ListEnti(_whole(call, rounding(value.values.astype(float))))


@operator("FLOT", gives="FLOTTANT|LISTREEL", family="numbers", full_name="FLOTTANT")
def flot(
    call: Call,
    value: Any = Arg(
        "FLOTTANT",
        "LISTREEL",
        "LISTENTI",
        "LISTMOTS",
        "MOT",
        en="numbers, or words that say them",
        range=CARRIED,
    ),
) -> Any:
    """Convert to reals."""
    if isinstance(value, str):
        return number_in(call, value)
    if isinstance(value, ListMots):
        return ListReel([number_in(call, w) for w in value.values])
    return value if isinstance(value, float) else ListReel(value.values)


@operator("VERI", family="numbers")
def veri(value: Any = Arg("FLOTTANT", "CHPOINT", en="what is tested", range=CARRIED)) -> bool:
    """Test for numbers."""
    if isinstance(value, float):
        return bool(np.isfinite(value))
    return all(bool(np.all(np.isfinite(v.values))) for v in value.components.values())
