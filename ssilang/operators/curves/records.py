"""FILT of a record, TOUR of two components, ZOND for a spectrum, ONDE: its wavelets."""

from ssilang.kernel.base.arrays import ComplexArray
from ssilang.kernel.records import signals
from ssilang.kernel.records.filters import butterworth
from ssilang.kernel.records.matching import matched
from ssilang.operators.curves.signals import filt
from ssilang.operators.curves.words import *
from ssilang.operators.mesh.copies.images import tour
from ssilang.operators.prelude import *


@filt.form()
def filtered_records(
    call: Call,
    curve: Curve = CURVE,
    order: int = Key("ORDR", "ENTIER", range=POSITIVE, default=4, en="order, 4 without it"),
    low: float | None = Key(
        "PHAU", "FLOTTANT", range=POSITIVE, unit="Hz", en="slower is taken off"
    ),
    high: float | None = Key(
        "PBAS", "FLOTTANT", range=POSITIVE, unit="Hz", en="faster is taken off"
    ),
    causal: bool = Flag("CAUS", en="one pass, as a device does"),
) -> Curve:
    """Filter records."""
    if low is None and high is None:
        raise call.error("operators.curves.filter-without-corner")
    parts = [
        replace(
            p,
            ordinates=butterworth(
                p.ordinates, signals.constant_step(p.abscissas), order, low, high, causal=causal
            ),
        )
        for p in curve.parts
    ]
    return Curve(tuple(parts), curve.title, curve.kind)


@tour.form(gives=("EVOLUTIO", "EVOLUTIO"))
def turned_components(
    call: Call,
    first: Curve = Arg("EVOLUTIO", en="component along x", over="s"),
    second: Curve = Arg("EVOLUTIO", en="component along y", over="s"),
    angle: float = Arg("FLOTTANT", "ENTIER", en="angle", unit="deg", range=ANY_NUMBER),
) -> tuple[Curve, Curve]:
    """Turn two components."""
    x, y = one_part(call, first), one_part(call, second)
    check_together(call, first, second)
    a, b = signals.turned(x.ordinates, y.ordinates, angle)
    return (
        Curve((replace(x, ordinates=a),), first.title),
        Curve((replace(y, ordinates=b),), second.title),
    )


@operator("ZOND", family="signals", gives=("EVOLUTIO", "FLOTTANT"))
def zond(
    call: Call,
    record: Curve = Arg("EVOLUTIO", en="acceleration", over="s"),
    target: Curve = Arg("EVOLUTIO", en="pseudo-accelerations over Hz", over="Hz"),
    damping: float = Key(
        "AMOR", "FLOTTANT", range=NOT_NEGATIVE, usual=BELOW_CRITICAL, default=0.05, en="damping"
    ),
    tolerance: float = Key(
        "TOLE", "FLOTTANT", range=POSITIVE, default=0.05, en="largest misfit, 0.05 without it"
    ),
) -> tuple[Curve, float]:
    """Match a record."""
    part, wanted = one_part(call, record), one_part(call, target)
    found = matched(
        part.abscissas, part.ordinates, wanted.abscissas, wanted.ordinates, damping, tolerance
    )
    made = replace(part, ordinates=found.values)
    return Curve((made,), record.title), found.misfit


@operator(
    "ONDE",
    family="signals",
    full_name="ONDE",
    gives=by("form", dict.fromkeys(("REIM", "MOPH"), ("CHPOINT", "MAILLAGE")), "EVOLUTIO"),
)
def onde(
    call: Call,
    power: int = Arg("ENTIER", range=between(1, 20), en="2**N1 points"),
    curve: Curve = CURVE,
    form: str = Choice(
        ("CRMO", "CRPH", "REIM", "MOPH"),
        default="CRMO",
        en="ridge by the modulus (default) or by the phase, or the transform as a field",
    ),
    lowest: float = Key(
        "FMIN",
        arg("lowest", "FLOTTANT", range=NOT_NEGATIVE, unit="Hz"),
        default=0.0,
        en="lowest frequency",
    ),
    highest: float = Key(
        "FMAX", "FLOTTANT", range=POSITIVE, unit="Hz", default=0.0, en="highest frequency"
    ),
    count: tuple[str, float] = Key(
        ("NFRQ", "DFRQ"),
        "FLOTTANT",
        range=POSITIVE,
        default=("NFRQ", 50.0),
        en="number of frequencies, 50 without it",
    ),
    turn: float = Key(
        "EPSI",
        "FLOTTANT",
        range=POSITIVE,
        default=1e-4,
        en="tolerance of the phase, 1.E-4 without it",
    ),
    pulsation: float = Key(
        "PULS", "FLOTTANT", range=POSITIVE, default=5.0, en="pulsation of the wavelet, 5 without it"
    ),
    colour: str | None = COLOUR,
) -> Any:
    """Wavelet transform."""
    part, rows = one_part(call, curve), int(count[1])
    if not 0.0 < lowest < highest or rows < 1:
        raise call.error("operators.curves.frequencies-must-increase", fmin=lowest, fmax=highest)
    n = 2**power
    if n * (rows + 1) > 20_000_000:
        raise call.error("operators.curves.transform-too-large")
    step = warned_step(call, part, n, highest)
    scale = signals.scales(lowest, highest, rows, pulsation)
    found = signals.transform(part.ordinates, step, n, scale, pulsation)
    times = part.abscissas[0] + step * np.arange(n)
    if form in ("REIM", "MOPH"):
        return _square(call, times, found, scale, form)
    if form == "CRMO":
        t, f, size = signals.modulus_ridge(times, found, scale, pulsation)
    else:
        t, f, size = signals.phase_ridge(times, found, scale, pulsation, turn)
    index = shade(colour, 0)
    parts = (
        CurvePart(t, f, "TEMPS", "FREQ (HZ)", "FREQUENCE", index),
        CurvePart(t, size, "TEMPS", "MODULE", "MODULE", index),
    )
    return Curve(parts, curve.title)


def _square(
    call: Call, times: FloatArray, found: ComplexArray, scale: FloatArray, form: str
) -> tuple[NodeField, Mesh]:
    ws = workspace(call.session)
    rows, n = found.shape
    if ws.dimension < 2:
        raise call.error("operators.curves.two-dimensions-wanted")
    xy = np.zeros((rows * n, ws.dimension))
    xy[:, 0] = np.tile(np.linspace(0.0, 1.0, n), rows)
    xy[:, 1] = np.repeat(np.linspace(1.0, 0.0, rows), n)
    ids = ws.nodes.add(xy, ws.density)
    grid = np.asarray(ids).reshape(rows, n)
    corners = (grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:], grid[:-1, :-1])
    cells = np.stack([c.ravel() for c in corners], axis=1)
    mesh = Mesh.of(ws.nodes, "QUA4", cells, ws.colour)
    inside = np.array([signals.settled(times, float(a)) for a in scale])
    values = np.where(inside, found, 0.0).ravel()
    if form == "REIM":
        pair = {"PREE": values.real.copy(), "PIMA": values.imag.copy()}
    else:
        pair = {"MODU": np.abs(values), "PHAS": np.degrees(np.angle(values))}
    return NodeField.of(ws.nodes, np.asarray(ids), pair, "DIFFUS"), mesh
