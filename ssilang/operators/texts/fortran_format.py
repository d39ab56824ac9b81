"""Numbers written by a Fortran format such as `(F6.2)` or `(SP,1PE10.3)`."""

import math
import re

from ssilang.kernel.base.errors import KernelError

DEFAULT_FORMAT = "(1PE12.5)"

_ITEM = re.compile(
    r"(?P<repeat>\d*)(?P<kind>ES|EN|[FEDGIAL])(?P<width>\d*)(?:\.(?P<digits>\d+))?(?:E(?P<exp>\d+))?$"
)
_SCALE = re.compile(r"([+-]?\d+)P,?")


def formatted(text: str, value: object) -> str:
    """A value written by a Fortran format.

    Raises
    ------
    KernelError
        If the format is not one of A, I, F, E, D, ES, G, L with X, P, SP and literal texts.
    """
    body = text.strip()
    if not (body.startswith("(") and body.endswith(")")):
        raise KernelError("operators.texts.format-without-brackets", text=text)
    out, used, sign, scale = "", False, "", 0
    for part in _parts(body[1:-1]):
        said = part.strip().upper()
        if part.strip()[:1] in ("'", '"'):
            out += part.strip()[1:-1]
        elif said in ("SP", "SS", "S", "BN", "BZ", ""):
            sign = "+" if said == "SP" else ""
        elif re.fullmatch(r"\d*X", said):
            out += " " * int(said[:-1] or 1)
        else:
            found = _SCALE.match(said)
            if found:
                scale, said = int(found.group(1)), said[found.end() :]
            if not said:
                continue
            if used:
                break
            out += _item(said, value, sign, scale, text)
            used = True
    return out


def _parts(body: str) -> list[str]:
    return re.findall(r"\s*(?:'[^']*'|\"[^\"]*\"|[^,'\"]+)\s*", body) if body.strip() else []


def _item(said: str, value: object, sign: str, scale: int, text: str) -> str:
    found = _ITEM.fullmatch(said)
    if found is None:
        raise KernelError("operators.texts.bad-format", text=text)
    kind = found["kind"]
    width, digits = int(found["width"] or 0), int(found["digits"] or 0)
    if kind == "A":
        return str(value)[:width].rjust(width) if width else str(value)
    if kind == "I":
        return _fit(f"{int(float(str(value))):{sign}d}", width)
    return _real(float(str(value)), kind, width, digits, sign, scale)


def _real(x: float, kind: str, width: int, digits: int, sign: str, scale: int) -> str:
    if not math.isfinite(x):
        return _fit("NaN" if math.isnan(x) else ("Infinity" if x > 0 else "-Infinity"), width)
    if kind == "G":
        small = x != 0 and not 0.1 <= abs(x) < 10.0**digits
        if not small:
            before = len(str(int(abs(x)))) if abs(x) >= 1 else 0
            return _fit(f"{x:{sign}.{max(digits - before, 0)}f}", max(width - 4, 0)) + " " * 4
        kind = "E"
    if kind == "F":
        text = f"{x * 10.0**scale:{sign}.{digits}f}"
        if digits == 0:
            text += "."
        if width and len(text) > width:
            text = re.sub(r"^([+-]?)0\.", r"\1.", text)
        return _fit(text, width)
    return _fit(_exponential(x, kind, digits, sign, 1 if kind == "ES" else scale), width)


def _exponential(x: float, kind: str, digits: int, sign: str, scale: int) -> str:
    decimals = digits if scale >= 1 else digits - 1
    mantissa, exponent = f"{x:{sign}.{max(decimals, 0)}e}".split("e")
    power = int(exponent)
    if scale < 1:
        head = mantissa[0] if mantissa[0] in "+-" else ""
        mantissa = head + "0." + mantissa.lstrip("+-").replace(".", "")
        power = power + 1 if x != 0 else 0
    letter = "D" if kind == "D" else "E"
    mark = "-" if power < 0 else "+"
    tail = f"{abs(power):03d}" if abs(power) > 99 else f"{letter}{mark}{abs(power):02d}"
    return mantissa + (mark + tail if abs(power) > 99 else tail)


def _fit(text: str, width: int) -> str:
    if not width:
        return text
    return "*" * width if len(text) > width else text.rjust(width)
