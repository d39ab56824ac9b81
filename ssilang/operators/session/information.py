"""INFO, NOTI, AIDE: help during a session; SOUC: the flag of doubts."""

from __future__ import annotations

from ssilang.language.registry import OPERATORS
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.reference import (
    operator_page,
    overview,
    procedure_page,
)
from ssilang.operators.prelude import *
from ssilang.operators.vocabulary.pages import help_text, near_name


@operator(
    "INFO",
    arg("said", "MOT", en="operator, procedure or word"),
    family="session",
    full_name="INFORMATION",
)
def info(call: Call, said: str) -> None:
    """Print the page of the word that follows."""
    text = help_text(said, call.session.language)
    if not text:
        near = near_name(said)
        raise call.error("operators.session.no-help", said, said=said.upper(), near=near)
    call.session.print(text)


@operator("NOTI", opt("said", "MOT", en="changes nothing"), family="session", full_name="NOTICE")
def noti(session: Session, said: str | None) -> None:
    """Print the overview; the word that may follow chooses nothing here."""
    session.print(overview(standard_procedures().values(), session.language))


@operator("AIDE", arg("said", "MOT", en="text looked for"), family="session")
def aide(session: Session, said: str) -> ListMots:
    """Search the help in both languages, whatever the case."""
    pages = [operator_page(o) for n, o in sorted(OPERATORS.items()) if n == o.name]
    pages += [procedure_page(p) for p in standard_procedures().values()]
    wanted = said.upper()
    found = [
        p.name
        for p in pages
        if wanted in " ".join((p.name, p.full_name, p.title, p.help.en, p.help.fr)).upper()
    ]
    if found:
        session.print(" ".join(found))
    return ListMots(found)


SOUC = shared("SOUC", "session", full_name="SOUCI")


@SOUC.form(arg("level", "ENTIER", en="level, 0 to lower the flag", range=NOT_NEGATIVE))
def _raise_flag(session: Session, level: int) -> None:
    if level:
        session.doubt(level)
    else:
        session.options["SOUC"] = 0


@SOUC.form()
def _is_raised(session: Session) -> bool:
    return bool(session.options.get("SOUC", 0))
