"""ZBIL: what @BILANSSI found, for the summary and the report of a run."""

from ssilang.io.recording import thinned_drawing
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.stepping.problem.bodies import held
from ssilang.kernel.waves.shaken import ground_along
from ssilang.messages.message import teller
from ssilang.operators.files.outputs import run_output
from ssilang.operators.prelude import *

QUANTITIES = (
    "PART", "PRESSION", "TAUX", "OUVERTURE", "MOMENT", "ROTATION", "ENFONCEMENT", "RENVERSEMENT",
    "GLISSEMENT",
)  # fmt: skip
_NAMES = {
    "PRESSION": "report.toe-pressure",
    "OUVERTURE": "report.verdict-uplift",
    "ENFONCEMENT": "report.verdict-settlement",
    "RENVERSEMENT": "report.verdict-overturning",
    "GLISSEMENT": "report.verdict-sliding",
}
"""How curves are called."""
_DRAWN = (
    ("report.toe-pressure", " (Pa)", ("PRESSION",)),
    ("report.motions", "", ("OUVERTURE", "ENFONCEMENT")),
    ("report.factors", "", ("RENVERSEMENT", "GLISSEMENT")),
)
"""Pictures: title, unit, curves."""
LEFT = ("ROTATION", "ENFONCEMENT")
LATE = 0.1  # of a run, in which what is left should stand still
STILL = 0.1  # of the largest rotation
LIKE = 0.5  # correlation, ratio of sizes: less is another motion
_TOP = 1000.0
"""Value at which @BILANSSI cuts its factors: there is no moment or shear."""


@operator("ZBIL", family="dynamics")
def zbil(
    call: Call,
    given: Table = Arg("TABLE", en="what @BILANSSI was given"),
    found: Table = Arg("TABLE", en="what it found"),
) -> None:
    """Keep a verdict."""
    session = call.session
    for code, doubt in _doubts(given, found):
        call.warn(code, **doubt)
    peaks = cast(Table, found.get("PICS"))
    told: dict[str, Any] = {
        "area": found.get("AIRE"),
        "capacity": given.get("CAPACITE") if given.has("CAPACITE") else None,
        "friction": given.get("FROTTEMENT") if given.has("FROTTEMENT") else None,
        "peaks": {
            name: {"value": peak.get("VALEUR"), "time": peak.get("TEMPS")}
            for name in QUANTITIES
            if peaks.has(name) and (peak := cast(Table, peaks.get(name)))
        },
        "left": {name: cast(Table, found.get("RESIDUS")).get(name) for name in LEFT},
        "floors": _floors(given, found),
    }
    session.statistics.setdefault("verdicts", []).append(told)
    recording = run_output(session).recording
    if recording is not None:
        recording.judge(_pictures(given, found, teller(session.language)))


def _doubts(given: Table, found: Table) -> Iterator[tuple[str, dict[str, Any]]]:
    """Floors whose accelerations lack the ground's, rotations left while the footing rocks."""
    results = given.get("RESULTATS")
    recorded = results.stand_ins("ACCE") if isinstance(results, LazyRows) else None
    if recorded is None:  # load steps
        return
    still = list[bool]()
    for number, floor, *_ in _each_floor(given, found):
        name, point = str(floor.get("COMPOSANTE")), cast(Point, floor.get("POINT"))
        track = getattr(recorded[0], "track", None)
        if track:
            still.append(held(track.problem)[track.problem.numbering.index_of(point.node, name)])
        base, told = floor.get("ACCELERATION_BASE"), {"floor": number, "component": name}
        if not track or not (ground := ground_along(track.problem, name)).any():
            continue
        if not isinstance(base, Curve):
            yield "operators.dynamics.floor-relative", told
            continue
        values = np.interp(track.problem.times, base.parts[0].abscissas, base.parts[0].ordinates)
        like, times = values @ ground, float(np.ptp(values) / np.ptp(ground))
        alike = LIKE * float(np.linalg.norm(values) * np.linalg.norm(ground))
        if like < alike or not LIKE < times < 1.0 / LIKE:
            told |= {"given": np.abs(values).max(), "ground": np.abs(ground).max()}
            yield "operators.dynamics.base-of-another", told | {"turned": bool(like < -alike)}
    if still and all(still):
        yield "operators.dynamics.floors-held", {"count": len(still)}
    histories = cast(Table, found.get("HISTOIRES"))
    t, turn = (cast(ListReel, histories.get(n)).values for n in ("TEMPS", "ROTATION"))
    swing = float(np.ptp(turn[t >= t[-1] - LATE * (t[-1] - t[0])]))
    if not given.has("RESIDU") and swing > STILL * np.abs(turn).max():
        left = cast(Table, found.get("RESIDUS")).get("ROTATION")
        yield "operators.dynamics.still-rocks", {"swing": swing, "left": left}


def _floors(given: Table, found: Table) -> list[dict[str, Any]]:
    """Peaks of the floors' spectra, a row for each floor and damping."""
    rows = []
    values = cast(ListReel, found.get("ACCELERATIONS", ListReel(())))
    largest = dict(enumerate(values.values.tolist(), 1))
    for number, floor, spectra, _ in _each_floor(given, found):
        for part in spectra.parts:
            top, x, y = int(np.argmax(part.ordinates)), part.abscissas, part.ordinates
            row = {"floor": number, "component": str(floor.get("COMPOSANTE"))}
            row |= {"damping": part.legend, "acceleration": float(y[top])}
            row |= {"frequency": float(x[top]), "largest": largest.get(number)}
            row |= {"frequencies": x, "accelerations": y}
            rows.append(row)
    return rows


def figures_of(verdicts: Sequence[dict[str, Any]]) -> dict[str, float]:
    """Peaks by name, floors' largest accelerations as PLANCHER_1; a second footing's end in _2."""
    found: dict[str, float] = {}
    for number, verdict in enumerate(verdicts, 1):
        end = f"_{number}" if number > 1 else ""
        named = {name: peak["value"] for name, peak in verdict["peaks"].items()}
        named |= {f"PLANCHER_{f['floor']}": f["largest"] for f in verdict["floors"]}
        found |= {f"{name}{end}": float(v) for name, v in named.items() if v is not None}
    return found


def _each_floor(given: Table, found: Table) -> list[tuple[int, Table, Curve, Curve]]:
    """Number, description, spectra and broadened spectra of the floors."""
    if not found.has("SPECTRES"):
        return []
    floors, plain, wide = (
        cast(Table, t)
        for t in (given.get("PLANCHERS"), found.get("SPECTRES"), found.get("SPECTRES_ELARGIS"))
    )
    return [
        (i, cast(Table, floors.get(i)), cast(Curve, plain.get(i)), cast(Curve, wide.get(i)))
        for i in range(1, len(plain) + 1)
    ]


def _pictures(given: Table, found: Table, told: Teller) -> list[dict[str, Any]]:
    """Pictures of a verdict: pressure and capacity, motions, factors, floors.

    Contact, moment and rotation stand in the report beside it, with those of all footings.
    """
    histories = cast(Table, found.get("HISTOIRES"))
    t = cast(ListReel, histories.get("TEMPS")).values
    time = f"{told('report.time')} (s)"
    made = []
    for code, unit, names in _DRAWN:
        lines = [
            _line(told(_NAMES[n]), t, _known(n, cast(ListReel, histories.get(n)).values))
            for n in names
            if histories.has(n)
        ]
        lines = [line for line in lines if not np.isnan(line["y"]).all()]
        if code == "report.toe-pressure" and given.has("CAPACITE"):
            level = np.full(len(t), float(cast(float, given.get("CAPACITE"))))
            lines.append(_line(told("report.capacity"), t, level))
        if lines:
            made.append(_picture(told(code), time, told(code) + unit, lines))
    for number, floor, plain, wide in _each_floor(given, found):
        title = told("report.floor", number=number, component=floor.get("COMPOSANTE"))
        lines = [_spectrum(p, p.legend) for p in plain.parts]
        for part, raw in zip(wide.parts, plain.parts, strict=True):
            lines.append(_spectrum(part, f"{raw.legend}, {told('report.broadened')}"))
        axis = f"{told('report.acceleration')} (m/s2)"
        made.append(
            {**_picture(title, told("report.frequency"), axis, lines), "log": [True, False]}
        )
    return made


def _known(name: str, values: FloatArray) -> FloatArray:
    """Factors where there is one; other values as they are."""
    if name not in ("RENVERSEMENT", "GLISSEMENT"):
        return values
    return np.where(values >= _TOP, np.nan, values)


def _line(name: str, x: FloatArray, y: FloatArray) -> dict[str, Any]:
    return {"name": name, "x": x, "y": y}


def _spectrum(part: CurvePart, name: str) -> dict[str, Any]:
    return _line(name, part.abscissas, part.ordinates)


def _picture(title: str, x: str, y: str, lines: list[dict[str, Any]]) -> dict[str, Any]:
    told = {"title": title, "x": x, "y": y, "log": [False, False], "files": []}
    return thinned_drawing(told, lines)
