"""QUIT ITER FIN ASSI ARGU RESP COMM: where statements go on, what procedures read and give."""

from __future__ import annotations

from typing import Any, NoReturn

from ssilang.language.registry import Help, flag, many, named, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.run.jumps import LeaveLoop, LeaveProcedure, NextTurn, StopRun
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.values import ANNULE
from ssilang.language.vocabulary.terms import ANY_NUMBER


@operator(
    "QUIT",
    named("name", en="loop or procedure to leave"),
    gives=(),
    family="control",
    full_name="QUITTER",
    help=Help(
        en="Leaves the named loop (an outer one too) or the running procedure.",
        syntax="QUIT NOM1 ;",
    ),
)
def quitter(session: Session, name: str) -> NoReturn:
    """Leave a loop or a procedure."""
    if session.frame.procedure == name:
        raise LeaveProcedure(name)
    raise LeaveLoop(name)


@operator(
    "ITER",
    named("name", en="loop that goes on"),
    gives=(),
    family="control",
    full_name="ITERER",
    help=Help(en="Goes on with the next turn of the named loop.", syntax="ITER NOM1 ;"),
)
def iterer(name: str) -> NoReturn:
    """Go to the end of the turn."""
    raise NextTurn(name)


@operator(
    "ASSI",
    flag("every", "TOUS", en="not available"),
    opt("number", "ENTIER", en="assistant, changes nothing", range=ANY_NUMBER),
    gives=(),
    family="control",
    full_name="ASSISTANT",
    help=Help(
        en="Has an assistant carry out the phrase that follows: here one process does all, so the "
        "phrase simply runs.",
        syntax="OBJ1 ... = ASSI N1 PHRASE ;",
    ),
)
def assi(call: Call, every: bool, number: int | None) -> None:
    """The phrase goes on."""
    if every:
        raise call.error("operators.session.all-assistants")


@operator(
    "FIN",
    gives=(),
    family="control",
    help=Help(
        en="Ends the run; with a name, ends the block that REPE opened.", syntax="FIN ; FIN NOM1 ;"
    ),
)
def fin() -> NoReturn:
    """End the run."""
    raise StopRun


@operator(
    "COMM",
    many("text", "*", "TEXTE", en="whatever is said"),
    family="control",
    full_name="COMMENTAIRE",
    help=Help(
        en="A comment up to the end of the statement; a line with * in column 1 is one too.",
        syntax="COMM ... ;",
    ),
)
def comm(text: tuple[Any, ...]) -> None:
    """Swallow the statement."""


# ---- procedures --------------------------------------------------------------------------------


def _argument_marks(call: Call) -> list[tuple[str, bool, str, Any]]:
    """Names, whether mandatory, types and places of what ARGU is asked to read."""
    found: list[tuple[str, bool, str, Any]] = []
    while call.operands:
        span = call.operands[0].span
        name = call.take_name()
        mandatory, kind = True, ""
        if call.operands and call.operands[0].span.text in ("*", "/"):
            mandatory = call.operands.pop(0).span.text == "*"
            kind = call.take_name()[:8].rstrip()
        found.append((name, mandatory, kind, span))
    return found


@operator(
    "ARGU",
    family="control",
    full_name="ARGUMENT",
    help=Help(
        en="Inside a procedure: reads further arguments. NOM1*TYPE1 is mandatory, NOM1/TYPE1 "
        "optional; without type any object is taken.",
        syntax="ARGU NOM1*TYPE1 NOM2/TYPE2 ... ;",
    ),
    reads_itself="its items are names and types, with * or / between",
)
def argu(call: Call) -> None:
    """Read from the caller's operands."""
    frame = call.session.frame
    wanted = _argument_marks(call)
    if frame.pending is None:
        raise call.error("operators.session.no-procedure-runs")
    for name, mandatory, kind, span in wanted:
        operand = frame.pending.read(kind or "*")
        if operand is None and mandatory and kind:
            left = frame.pending.operands
            raise SsiError(
                "missing-parameter",
                span,
                procedure=frame.procedure,
                parameter=name,
                expected=kind,
                found="nothing" if not left else str(left[0].value),
            )
        frame.assign(name, ANNULE if operand is None else operand.value)


@operator(
    "RESP",
    many("results", en="results, in order"),
    family="control",
    full_name="RESPRO",
    help=Help(
        en="Inside a procedure: gives results, delivered before those of FINP.",
        syntax="RESP OBJ1 OBJ2 ... ;",
    ),
)
def resp(session: Session, results: tuple[Any, ...]) -> None:
    """Queue results."""
    session.frame.results.extend(r for r in results if r is not ANNULE)
