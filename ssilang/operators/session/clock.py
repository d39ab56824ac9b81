"""TEMP DATE: time used, date and hour."""

from __future__ import annotations

import time
from datetime import datetime
from typing import Any

from ssilang.language.registry import Help, choice, flag, key, many, operator, opt, said, shared
from ssilang.language.run.call import Call
from ssilang.language.run.session import Session
from ssilang.language.values import Mot, Table

_MONTHS = (
    "janvier", "février", "mars", "avril", "mai", "juin", "juillet", "août", "septembre",
    "octobre", "novembre", "décembre",
)  # fmt: skip


def _clocks(session: Session) -> dict[str, tuple[float, float]]:
    found: dict[str, tuple[float, float]] = session.statistics.setdefault(
        "clocks", {"zero": (session.started, 0.0), "last": (session.started, 0.0)}
    )
    return found


TEMP = shared(
    "TEMP",
    "session",
    Help(
        en="Prints the time passed since TEMP was called last. 'ZERO' starts the count again; "
        "'HORL' and 'CPU' give wall and processor time in milliseconds since ZERO; 'NOEC' gives a "
        "table with both.",
        fr="Affiche le temps écoulé depuis le dernier appel. 'ZERO' remet à zéro ; 'HORL' et 'CPU' "
        "rendent les temps horloge et processeur en millisecondes depuis ZERO ; 'NOEC' rend une "
        "table des deux.",
        syntax="TEMP ('ZERO' | 'IMPR' | 'PLAC') ; N1 = TEMP 'CPU' | 'HORL' ; TAB1 = TEMP 'NOEC' ;",
        examples=(
            "TEMP 'ZERO' ; N = TEMP 'HORL' ;",
            ("T = TEMP 'NOEC' ; LIST (TYPE T) ; TEMP 'SGAC' 'IMPR' ; TEMP 'SGAC' ;\nTEMP 'IMPR' ;"),
        ),
    ),
    full_name="TEMPS",
)
_REST = many("rest", "*", "TEXTE", en="changes nothing", fr="sans effet")


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


@TEMP.form(said("CPU", "HORL"))
def _elapsed(session: Session, word: str) -> int:
    return _read_clocks(session)[1][word == "CPU"]


@TEMP.form(said("NOEC"))
def _tabulated(session: Session) -> Table:
    wall, cpu = _read_clocks(session)[1]
    made = Table()
    made.set(Mot("TEMPS_HORLOGE"), wall)
    made.set(Mot("TEMPS_CPU"), cpu)
    return made


@TEMP.form(said("SGAC"), key("printed", "IMPR", optional=False), _REST)
def _print_all(session: Session, printed: bool, rest: tuple[Any, ...]) -> None:
    _print_clocks(session, None, rest)


@TEMP.form(said("SGAC"))
def _garbage(session: Session) -> tuple[int, int]:
    _read_clocks(session)
    return 0, 0


@TEMP.form(
    choice(
        "what",
        ("PLAC", "IMPR", "EFFI", "APPE"),
        en="the time that has passed is printed",
        fr="le temps écoulé est affiché",
    ),
    _REST,
)
def _print_clocks(session: Session, what: str | None, rest: tuple[Any, ...]) -> None:
    wall, cpu = _read_clocks(session)[0]
    session.print(" " + session.told("operators.session.clocks", wall=wall, cpu=cpu))


@operator(
    "DATE",
    flag("letters", "LETT"),
    choice("part", ("CONV", "EPOC", "ANNE", "MOIS", "JOUR", "HEUR", "MINU", "SECO")),
    opt("seconds", "FLOTTANT"),
    family="session",
    help=Help(
        en="Date and hour as a word, or one part of it; 'EPOCH': seconds, to measure by "
        "difference; 'CONVERSION': seconds written as days, hours, minutes and seconds.",
        fr="Date et heure en un mot, ou une seule partie ; 'EPOCH' : secondes, pour mesurer par "
        "différence ; 'CONVERSION' : secondes écrites en jours, heures, minutes, secondes.",
        syntax="MOT1 = DATE ('LETTRE') ; N1 = DATE 'ANNEE' | 'MOIS' | 'JOUR' | 'HEURE' | 'MINUTE' "
        "| 'SECONDE' ; X1 = DATE 'EPOCH' ; MOT1 = DATE 'CONVERSION' X1 ;",
        examples=("LIST (DATE 'CONVERSION' 123456.789) ;",),
    ),
)
def date(call: Call, letters: bool, part: str | None, seconds: float | None) -> Any:
    """Tell the date."""
    now = datetime.now()
    if part == "EPOC":
        return time.time()
    if part == "CONV":
        if seconds is None:
            raise call.missing(("FLOTTANT",))
        return Mot(converted(seconds))
    if part is not None:
        if part == "MOIS" and letters:
            return Mot(_MONTHS[now.month - 1])
        values = (now.year, now.month, now.day, now.hour, now.minute, now.second)
        return values[("ANNE", "MOIS", "JOUR", "HEUR", "MINU", "SECO").index(part)]
    if letters:
        said = f"{now.day} {_MONTHS[now.month - 1]} {now.year} - {now.hour:02d}H{now.minute:02d}min"
        return Mot(said)
    return Mot(now.strftime("%d/%m/%Y - %H:%M:%S"))


def converted(seconds: float) -> str:
    """Seconds as days, hours, minutes and seconds."""
    minutes, rest = divmod(seconds, 60.0)
    hours, minutes = divmod(int(minutes), 60)
    days, hours = divmod(hours, 24)
    return f"{days}J {hours:02d}H {minutes:02d}min {rest:6.3f}sec"
