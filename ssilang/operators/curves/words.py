"""What operators on curves read: one curve, colours, names of axes."""

import re

from ssilang.io.plots.palette import COLOURS, index_of
from ssilang.kernel.records.signals import constant_step
from ssilang.kernel.waves.shaken import strong_frequency
from ssilang.operators.prelude import *

__all__ = [
    "COLOUR", "CURVE", "LIMITS", "POWER", "RECORD", "axis_name", "check_together", "one_part",
    "read_colour", "read_colours", "shade", "warn_of_damping", "warn_of_motions", "warn_of_order",
    "warn_of_rate", "warn_of_steps", "warned_step",
]  # fmt: skip

CONTENT = 0.99  # of a signal's energy: where it lies below half of what samples show, they do
CURVE = arg("curve", "EVOLUTIO", en="curves")
RECORD = arg("curve", "EVOLUTIO", en="curves", over="s")
COLOUR = choice("colour", COLOURS, en="colour")
POWER = arg("power", "ENTIER", range=between(1, 26), en="2**N1 points")
LIMITS = (
    key(
        "lowest",
        "FMIN",
        arg("lowest", "FLOTTANT", unit="Hz", range=NOT_NEGATIVE),
        default=0.0,
        en="lowest frequency, 0 without it",
    ),
    key(
        "highest",
        "FMAX",
        arg("highest", "FLOTTANT", unit="Hz", range=POSITIVE, above="lowest"),
        default=np.inf,
        en="highest frequency, all without it",
    ),
)
"""Frequencies kept of a spectrum."""


def shade(colour: str | None, default: int) -> int:
    """Index of the colour that `COLOUR` has read."""
    return default if colour is None else index_of(colour)


def one_part(call: Call, curve: Curve) -> CurvePart:
    """The only curve of a curve object."""
    if len(curve.parts) != 1:
        raise call.error("operators.curves.one-curve-wanted", curve, n_parts=len(curve.parts))
    return curve.parts[0]


def warn_of_motions(call: Call, *curves: Curve) -> None:
    """Warn of velocities, displacements or relative motions where accelerations are read."""
    names = {p.ordinate_name.strip().upper() for c in curves for p in c.parts}
    for name in sorted(names & {"VITE", "DEPL"}):
        call.warn("operators.curves.no-accelerations", name=name)
    if any(p.relative for c in curves for p in c.parts):
        call.warn("operators.curves.accelerations-relative")


def warn_of_steps(call: Call, curve: Curve, lowest: float) -> None:
    """Warn of a signal whose steps are longer than half a period of all frequencies asked for."""
    times = curve.parts[0].abscissas
    step = float(np.diff(times).min(initial=np.inf))
    if 0.0 < 0.5 / lowest < step < np.inf:
        call.warn("operators.curves.steps-over-periods", step=step, frequency=lowest)


def warn_of_rate(call: Call, curve: Curve, highest: float) -> None:
    """Warn of frequencies beyond half that of the samples, of a signal that is strong near it."""
    times, values = curve.parts[0].abscissas, curve.parts[0].ordinates
    steps = np.diff(times)
    if len(steps) < 3 or (steps <= 0.0).any():
        return
    most = 0.5 / float(np.median(steps))
    if highest <= most * (1.0 + 1e-6):
        return
    told = {"highest": highest, "most": most, "step": 0.5 / most}
    if count := _left_out(call, times):
        call.warn("operators.curves.spectrum-beyond-kept", **told, count=count, kept=len(times))
    elif strong_frequency(times, values, 0, CONTENT) > 0.5 * most:
        call.warn("operators.curves.spectrum-beyond-sampling", **told)


def _left_out(call: Call, times: FloatArray) -> int:
    """How many instants a motion of the script had, of which these were kept; 0 if none had."""
    for value in call.session.frame.named().values():
        held = value.stand_ins("ACCE") if isinstance(value, LazyRows) else None
        track, kept = (getattr(held[0], "track", None), held[1]) if held else (None, times)
        if track and len(times) == len(kept) < len(track.wanted) and (kept == times).all():
            return len(track.wanted)
    return 0


def warn_of_damping(call: Call, *ratios: float) -> None:
    """Warn of damping ratios that are per cent."""
    if ratios and max(ratios) >= 1.0:
        ratio = max(ratios)
        call.warn("operators.curves.damping-in-per-cent", ratio=ratio, meant=ratio / 100.0)


def check_together(call: Call, first: Curve, second: Curve) -> None:
    """Refuse two components that have not the same instants.

    Raises
    ------
    SsiError
        'operators.curves.components-apart'.
    """
    t, other = first.parts[0].abscissas, second.parts[0].abscissas
    scale = float(np.abs(t).max(initial=1e-300))
    if len(t) != len(other) or float(np.abs(t - other).max(initial=0.0)) > 1e-9 * scale:
        raise call.error(
            "operators.curves.components-apart", second, n_first=len(t), n_second=len(other)
        )


def read_colour(call: Call) -> int | None:
    """Index of the colour word that stands next, None if there is none."""
    word = call.keyword(COLOURS)
    return None if word is None else index_of(word)


def read_colours(call: Call) -> list[int]:
    """Indices of a colour word or of a list of colour words; empty without any."""
    single = read_colour(call)
    if single is not None:
        return [single]
    if call.operands and isinstance(call.operands[0].value, ListMots):
        words = call.operands[0].value.values
        if words and all(w.strip().upper()[:4] in COLOURS for w in words):
            call.used.append(call.operands.pop(0))
            return [index_of(w) for w in words]
    return []


def axis_name(call: Call) -> str:
    """The word that stands next, as the name of an axis; '' if a list stands there.

    `F(T)` without quotes is read as two words, and is one name as it is written.

    Raises
    ------
    SsiError
        'operators.curves.two-axis-names' if several names stand there.
    """
    words: list[Operand] = []
    while call.at_word() and (operand := call.read("MOT")) is not None:
        words.append(operand)
    if len(words) < 2:
        return str(words[0].value).rstrip() if words else ""
    whole = words[0].span.to(words[-1].span)
    if re.fullmatch(r"\w+\(\w+\)", whole.text) is None:
        said = [f"'{str(w.value).rstrip()}'" for w in words]
        raise SsiError("operators.curves.two-axis-names", whole, names=said)
    return whole.text


def warned_step(call: Call, part: CurvePart, points: int, highest: float) -> float:
    """The step of a signal, warned of its cut to so many points, of frequencies above half its."""
    step = constant_step(part.abscissas)
    if len(part.abscissas) > points + 1:  # a last point closes the period
        left = float(part.abscissas[points - 1])
        call.warn(
            "operators.curves.signal-cut", count=len(part.abscissas), points=points, time=left
        )
    if np.isfinite(highest) and highest > 0.5 / step * (1.0 + 1e-6):
        call.warn("operators.curves.beyond-sampling", highest=highest, most=0.5 / step)
    return step


def warn_of_order(call: Call, abscissas: FloatArray) -> None:
    """Warn of abscissas that go back."""
    back = np.flatnonzero(np.diff(abscissas) < 0.0)
    if len(back):
        k = int(back[0])
        call.warn("operators.curves.goes-back", before=abscissas[k], after=abscissas[k + 1])
