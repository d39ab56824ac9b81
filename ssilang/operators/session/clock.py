"""TEMP DATE: time used, date and hour."""

import time
from datetime import datetime

from ssilang.operators.prelude import *

_MONTHS = (
    "janvier", "février", "mars", "avril", "mai", "juin", "juillet", "août", "septembre",
    "octobre", "novembre", "décembre",
)  # fmt: skip
_WIDTH = 32  # of the words of DATE, blanks included


def _clocks(session: Session) -> dict[str, tuple[float, float]]:
    return session.statistics.setdefault(
        "clocks", {"zero": (session.started, 0.0), "last": (session.started, 0.0)}
    )


TEMP = shared("TEMP", "session", full_name="TEMPS")
_REST = many("rest", "*", "TEXTE", en="changes nothing")


def _read_clocks(session: Session) -> tuple[tuple[float, float], tuple[int, int]]:
    """Seconds, wall and processor, since TEMP was called last; milliseconds since ZERO."""
    clocks = _clocks(session)
    now = (time.perf_counter(), time.process_time())
    (wall, cpu), last = clocks["zero"], clocks["last"]
    clocks["last"] = now
    since_zero = round(1000 * (now[0] - wall)), round(1000 * (now[1] - cpu))
    return (now[0] - last[0], now[1] - last[1]), since_zero


@TEMP.form(said("ZERO"))
def _restart(session: Session) -> None:
    _read_clocks(session)
    clocks = _clocks(session)
    clocks["zero"] = clocks["last"]
    session.calls.clear()


@TEMP.form(said("CPU", "HORL"))
def _elapsed(session: Session, word: str) -> int:
    return _read_clocks(session)[1][word == "CPU"]


@TEMP.form(said("NOEC"))
def _tabulated(session: Session) -> Table:
    last, _ = _read_clocks(session)
    now = _clocks(session)["last"]
    begun = now[0] - session.started, now[1]
    made: dict[str, object] = {}
    for name, since, before in zip(("TEMPS_HORLOGE", "TEMPS_CPU"), begun, last, strict=True):
        times = {"INITIAL": round(1000 * since), "DERNIER_APPEL": round(1000 * before)}
        made[name] = Table.of(times)
    return Table.of(made | {"APPELS": Table.of({k: ListEnti(v) for k, v in session.calls.items()})})


@TEMP.form(said("SGAC"))
def _print_all(
    session: Session, printed: bool = Key("IMPR", optional=False), rest: tuple[Any, ...] = _REST
) -> None:
    _print_clocks(session, None, rest)


@TEMP.form(said("SGAC"))
def _garbage(session: Session) -> tuple[int, int]:
    _read_clocks(session)
    return 0, 0


@TEMP.form(said("IMPR"))
def _print_counts(
    session: Session,
    counts: bool = Flag("APPE", en="calls of each operator"),
    rest: tuple[Any, ...] = _REST,
) -> None:
    if not counts:
        _print_clocks(session, None, rest)
        return
    for name, count in sorted(session.calls.items(), key=lambda call: (call[1], call[0])):
        session.print(f" {name:<8} {count:>12}")


@TEMP.form()
def _print_clocks(
    session: Session,
    what: str | None = Choice(("PLAC",), en="the time that has passed is printed"),
    rest: tuple[Any, ...] = _REST,
) -> None:
    wall, cpu = _read_clocks(session)[0]
    session.print(" " + session.told("operators.session.clocks", wall=wall, cpu=cpu))


@operator("DATE", family="session")
def date(
    call: Call,
    letters: bool = Flag("LETT"),
    part: str | None = Choice(("CONV", "EPOC", "ANNE", "MOIS", "JOUR", "HEUR", "MINU", "SECO")),
    seconds: float | None = Opt("FLOTTANT", range=NOT_NEGATIVE),
) -> Any:
    """Tell the date."""
    now = datetime.now()
    if part == "EPOC":
        return time.time()
    if part == "CONV":
        if seconds is None:
            raise call.missing(("FLOTTANT",))
        minutes, rest = divmod(seconds, 60.0)
        hours, minutes = divmod(int(minutes), 60)
        days, hours = divmod(hours, 24)
        return Mot(f"{days:9d}J {hours:02d}H {minutes:02d}min {rest:6.3f}sec".ljust(_WIDTH))
    if part is not None:
        if part == "MOIS" and letters:
            return Mot(_MONTHS[now.month - 1])
        values = (now.year, now.month, now.day, now.hour, now.minute, now.second)
        return values[("ANNE", "MOIS", "JOUR", "HEUR", "MINU", "SECO").index(part)]
    said = now.strftime("%d/%m/%Y - %H:%M:%S")
    if letters:
        said = f"{now.day} {_MONTHS[now.month - 1]} {now.year} - {now.hour:02d}H{now.minute:02d}min"
    return Mot(said.ljust(_WIDTH))
