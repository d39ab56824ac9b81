"""Numbers of materials that are unusual: by themselves, beside others, in the deck's units."""

from ssilang.kernel.elements.catalog import LOCKING
from ssilang.language.vocabulary import Quantity
from ssilang.language.vocabulary.unit_systems import MATTER, likely_units
from ssilang.operators.prelude import *
from ssilang.operators.vocabulary import words

Given = tuple[NDArray[Any], Any]
_CODE = "operators.models.unusual-value"
THICKER = "operators.models.thicker-than-large"
COMPRESSIBLE = 0.49
"""Poisson's ratio beyond which linear cells are told: a punch on QUA4 is 4 % too stiff there, by
27 % at 0.499; on CUB8 by 43 % and three times."""
_PURE = (None, "", "deg", "rad")  # the same in any system
THICK = {"EPAI": (1, 1.0), "SECT": (2, 10.0)}
"""Parameters that are lengths of a section: their power, how many times the size of a zone."""
_SOLID, _STOUT = Range(0.01, 10.0), 0.2
"""Moments of area over the square of the area, of sections with walls; a radius of gyration over
the length of its beams, from which on such a section is no lattice."""
_SIZES = Range(high=5000.0)  # m; what soil and structures measure across at most


def warn_of_units(call: Call, zone: Zone, given: Mapping[str, Given]) -> None:
    """Warn of parameters out of what is usual, by their unit in the deck's; nought is one in any.

    The library's own procedures give numbers that are no material's, and stay unheard.

    Parameters
    ----------
    given : mapping of str to (array, object)
        Parameters of the zone: their values, and what the script gave for them.
    """
    session, system = call.session, workspace(call.session).units
    ours = session.in_library
    if not ours and (meant_in := system or _of_matter(call, given)) is not None:
        _warn_of_size(call, zone, meant_in)
    for name, (array, said) in given.items():
        meant = words.parameter(name, zone)
        ends = _ends(array) if meant is not None and array.dtype == float else ()
        if meant is None or not ends or (ours and name != "FROT"):
            continue
        here = 0.0 if system is None or meant.unit in _PURE else system.factor(meant.unit or "")
        unusual = next((v for v in ends if here and v * here not in meant.usual), None)
        for code, told in _odd(zone, meant, ends, {n: v for n, (v, _) in given.items()}):
            if unusual is None or code != THICKER:  # one mistake is told once
                call.warn(code, said, name=name, **told, meaning=meant.meaning(session.language))
        if unusual is not None and system is not None and not ours:
            _warn(call, meant, unusual, said, system)


_HARD, _SOFT = Range(2300.0, 2800.0), Range(1e6, 1e8)
"""Densities (kg/m3) of concrete and rock, and moduli (Pa) that neither has."""


def _of_matter(call: Call, given: Mapping[str, Given]) -> UnitSystem | None:
    """The system in which a modulus and a density belong together; warn where there is none."""
    known = {n: _ends(a) for n, (a, _) in given.items() if n in MATTER[0] and a.dtype == float}
    if len(known) < len(MATTER[0]) or not all(known.values()):
        return None
    fits = [all(v in usual[n] for n in usual for v in known[n]) for usual in MATTER]
    told = {n.lower(): max(ends) for n, ends in known.items()}
    if not any(fits):
        call.warn("operators.models.no-units", given["RHO"][1], **told)
    hard = all(v in _HARD for v in known["RHO"]) and all(v in _SOFT for v in known["YOUN"])
    if hard and fits[0]:
        call.warn("operators.models.soft-for-its-density", given["YOUN"][1], **told)
    first = next((s for s, there in zip(SYSTEMS.values(), fits, strict=False) if there), None)
    return first if sum(fits) == 1 else None


def _warn_of_size(call: Call, zone: Zone, system: UnitSystem) -> None:
    """Warn, once, of a body of some kilometres: millimetres of a drawing, most often."""
    here, code = system.factor("m"), "operators.models.unusual-size"
    size = _size(zone)
    if size * here in _SIZES or call.session.warned(code):
        return
    told = {"size": size, "unit": system.written("m"), "system": system.name}
    call.warn(code, likely=list(likely_units(size, "m", _SIZES, system)), **told)


def _size(zone: Zone) -> float:
    """What a zone measures across, along an axis."""
    corners = zone.cells.coordinates
    return float(np.ptp(corners.reshape(-1, corners.shape[2]), axis=0).max())


def _odd(
    zone: Zone, meant: Quantity, ends: tuple[float, float], given: Mapping[str, NDArray[Any]]
) -> Iterator[tuple[str, dict[str, Any]]]:
    """What is unusual in any system of units, codes with data: numbers by themselves, by their
    sign, ratios to others of the same unit, incompressible matter in elements that lock."""
    name, (low, high) = meant.name, ends
    if name == "FROT" and low < 0.0 and low != -1.0:  # which says that nothing slides
        yield "operators.models.friction-negative", {"value": low}
    elif meant.unit in _PURE and (low not in meant.usual or high not in meant.usual):
        if name in ("FROT", "MU"):
            tangent = float(np.tan(np.radians(min(high, 89.0))))
            yield (
                "operators.models.friction-as-angle",
                {"value": high, "tangent": tangent, "degrees": high < 90.0},
            )
        else:
            value = low if low not in meant.usual else high
            yield (
                "operators.models.unusual-number",
                {"value": value, "range": meant.usual.text(name)},
            )
    for other, usual in meant.beside.items():
        base = given.get(other.removesuffix("**2"), np.empty(0))
        if base.dtype != float or not base.size or not base.all():
            continue
        solid = other.endswith("**2") and float(base.min()) / high**2 in _SOLID  # if exchanged
        if solid and high > (_STOUT * _size(zone)) ** 2 * float(base.max()):
            usual = Range(usual.low, _SOLID.high * 10.0)
        base = base ** (1 + other.endswith("**2"))
        ratios = (abs(float(ratio)) for ratio in (low / np.max(base), high / np.min(base)))
        if (ratio := next((r for r in ratios if r not in usual), None)) is not None:
            told = {"other": other, "range": usual.text(f"{name}/{other}")}
            yield "operators.models.unusual-ratio", {"value": high, "ratio": ratio, **told}
            break
    power, times = THICK.get(name, (1, np.inf))
    if (across := low ** (1.0 / power)) > times * (size := _size(zone)) > 0.0:
        thick: dict[str, Any] = {"value": low, "size": size, "across": across}
        yield THICKER, thick | {"shell": power == 1}
    mean = None if zone.mode is Mode.PLANE_STRESS else LOCKING.get(zone.element)
    if name == "NU" and high > COMPRESSIBLE and mean is not None:
        yield "operators.models.locks", {"value": high, "mean": mean, "element": zone.element}


def _ends(array: NDArray[Any]) -> tuple[float, float] | tuple[()]:
    """The least and the largest finite number, none where all are nought."""
    numbers = array[np.isfinite(array) & (array != 0.0)]
    return (float(numbers.min()), float(numbers.max())) if numbers.size else ()


def _warn(call: Call, meant: Quantity, value: float, said: Any, system: UnitSystem) -> None:
    """Say it where the value stands, once for each place and parameter."""
    unit, low, high = meant.unit or "", meant.usual.low, meant.usual.high
    here, likely = system.factor(unit), likely_units(value, unit, meant.usual, system)
    warning = call.error(
        _CODE, said, name=meant.name, value=value, unit=system.written(unit),
        small=abs(value) * here < min(abs(low), abs(high)), system=system.name, low=low / here,
        high=high / here, meaning=meant.meaning(call.session.language), likely=list(likely),
        written=[f"{v:g}" for v in likely.values()],
    )  # fmt: skip
    warning.warns = True
    before = [w for w in call.session.warnings if w.code == _CODE and w.span == warning.span]
    if not any(w.data["name"] == meant.name for w in before):
        call.session.report(warning)
