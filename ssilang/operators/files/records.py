"""LIRE: ground motions as evolutions in time."""

from ssilang.io.ground_motions.formats import read_cosmos, read_esm, read_peer, read_titled
from ssilang.io.ground_motions.record import G, GroundMotion
from ssilang.operators.files.outputs import file_to_read
from ssilang.operators.files.reading import LIRE
from ssilang.operators.prelude import *

_ENTRIES: tuple[Entry, ...] = (
    lead("file", "MOT", en="file"),
    opt(
        "factor",
        "FLOTTANT",
        en="factor of the values: 9.81 makes m/s2 of g, 0.01 of cm/s2",
        range=NOT_ZERO,
    ),
    flag("in_si", "SI", en="metres and seconds, by the unit that the file names"),
)
"""What every format of records reads: file, then a factor or 'SI'."""


@LIRE.form(said("PEER"), *_ENTRIES)
def _peer(call: Call, file: str, factor: float | None, in_si: bool) -> Curve:
    record = read_peer(file_to_read(call, str(file), ".AT2"))
    return _curve(call, "PEER", file, [record], factor, in_si)


@LIRE.form(said("ESM"), *_ENTRIES)
def _esm(call: Call, file: str, factor: float | None, in_si: bool) -> Curve:
    record = read_esm(file_to_read(call, str(file), ".ASC"))
    return _curve(call, "ESM", file, [record], factor, in_si)


@LIRE.form(
    said("COSMOS"),
    *_ENTRIES,
    key(
        "number",
        "CANAL",
        "ENTIER",
        range=NOT_NEGATIVE,
        default=0,
        en="which record of a file that has several",
    ),
)
def _cosmos(call: Call, file: str, factor: float | None, in_si: bool, number: int) -> Curve:
    found = read_cosmos(file_to_read(call, str(file), ".V2"))
    if number > len(found):
        raise call.error("operators.files.no-such-channel", number, count=len(found))
    if not number and len(found) > 1:
        call.warn("operators.files.several-channels", file=file, count=len(found))
    record = found[max(number - 1, 0)]
    return _curve(call, "COSMOS", file, [record], factor, in_si)


@LIRE.form(said("SIGNAL"), *_ENTRIES)
def _signal(call: Call, file: str, factor: float | None, in_si: bool) -> Curve:
    found = read_titled(file_to_read(call, str(file), ".csv"))
    return _curve(call, "SIGNAL", file, found, factor, in_si)


def _curve(
    call: Call,
    kind: str,
    file: str,
    records: list[GroundMotion],
    factor: float | None,
    in_si: bool,
) -> Curve:
    """The curve of records; a unit that is not SI, or that the file does not name, is told.

    Raises
    ------
    SsiError
        If SI is asked for together with a factor, or of a record without a unit.
    """
    if in_si and factor is not None:
        raise call.error("operators.files.factor-and-si", factor)
    nameless = [r for r in records if not r.has_unit]
    if in_si and nameless:
        units = [r.unit for r in nameless if r.unit]
        raise call.error("operators.files.si-without-unit", file, kind=kind, file=file, units=units)
    if factor is None and not in_si:
        foreign = next((r for r in records if r.in_si != 1.0), None)
        if foreign is not None:
            call.warn(
                "operators.files.record-not-in-si", file=file, unit=foreign.unit.lower(),
                factor=foreign.in_si, kind=kind,
            )  # fmt: skip
        elif nameless:
            call.warn("operators.files.record-without-unit", file=file, kind=kind)
    for column, record in enumerate(records):
        for code, value, most in _odd(record, factor):
            call.warn(code, file=file, value=value, most=most)
        if record.left_out:
            call.warn(
                "operators.files.record-longer", file=file, count=len(record.values),
                left_out=record.left_out,
            )  # fmt: skip
        workspace(call.session).keep_record(str(file), column, record.times, record.values)
    parts = tuple(_part(call, r, factor, in_si) for r in records)
    return Curve(parts, records[0].event[:72])


_SLOW, _GAP, _STRONG = 0.2, 10.0, 50.0
"""Longest step of a record (s), longest over the median step, largest acceleration (m/s2)."""
_BEGUN, _FEW = 0.3, 50
"""Largest first value, over the largest of all, of a record of more values than these few."""
_ALONE = 3.0  # times all others, and those beside it: no value of a motion
_ROUNDED = 2e-3  # g is 9.80665, 9.81 or 9.8
_FACTORS = (G, 0.01, 0.001)
"""What makes m/s2 of other units; a factor of 1 leaves a record as it is."""


def _odd(record: GroundMotion, factor: float | None) -> Iterator[tuple[str, float, float]]:
    """What no ground motion shows: codes with a value and the most, or least, that is usual."""
    steps, peak = np.diff(record.times), record.in_si * float(np.abs(record.values).max())
    usual, longest = (float(np.median(steps)), float(steps.max())) if steps.size else (0.0, 0.0)
    if usual > _SLOW:
        yield "operators.files.record-slow", usual, _SLOW
    elif longest > _GAP * usual:
        yield "operators.files.record-gap", longest, usual
    if record.has_unit and record.quantity == "ACCE" and peak > _STRONG:
        yield "operators.files.record-strong", peak, _STRONG
    begun = float(abs(record.values[0])) / (float(np.abs(record.values).max()) or 1.0)
    if record.quantity == "ACCE" and begun > _BEGUN and len(record.values) > _FEW:
        yield "operators.files.record-begun", begun, _BEGUN
    size = np.abs(record.values)
    marks = size == size.max()
    others, beside = size[~marks], np.maximum(np.append(size[1:], 0.0), np.append(0.0, size[:-1]))
    alone = len(size) > _FEW and 0.0 < _ALONE * others.max(initial=0.0) < size.max()
    if alone and beside[marks].max() < size.max() / _ALONE:
        yield "operators.files.record-marked", record.values[marks][0], record.times[marks][0]
    near = [f for f in _FACTORS if factor is not None and abs(factor / f - 1.0) < _ROUNDED]
    if near and record.has_unit and abs(near[0] / record.in_si - 1.0) > _ROUNDED:
        yield "operators.files.record-other-factor", near[0], record.in_si


def _part(call: Call, record: GroundMotion, factor: float | None, in_si: bool) -> CurvePart:
    """A record's curve; it says its units where they are those of the deck."""
    by = record.in_si if in_si else 1.0 if factor is None else factor
    part = CurvePart(record.times, by * record.values, "TEMP", record.quantity, record.event[:40])
    unit = {"ACCE": "m/s2", "VITE": "m/s", "DEPL": "m"}[record.quantity]
    system = workspace(call.session).units
    if not (in_si or (factor is None and record.has_unit and record.in_si == 1.0)):
        in_g = by == 1.0 and record.has_unit and record.unit.strip().lower() == "g"
        return part.measured("s", "g") if in_g else part
    if system is None or system.factor(unit) == 1.0:
        return part.measured("s", unit)
    call.warn(
        "operators.files.record-in-other-units", system=system.name, unit=unit,
        needed=system.written(unit), factor=1.0 / system.factor(unit),
    )  # fmt: skip
    return part
