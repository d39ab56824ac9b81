"""Calls of the user's procedures from a calculation (PERSO1)."""

from ssilang.language.run.procedures import call_procedure
from ssilang.operators.prelude import *


class StopCalculation(Exception):
    """The user's procedure set ARRET: results so far stand."""


def call_user(call: Call, name: str, *values: Any) -> list[Any]:
    """Call a procedure of the script by name; its results in order.

    Raises
    ------
    SsiError
        If there is no such procedure.
    """
    session = call.session
    procedure = session.frame.find(name) or session.library.find(name)
    if not isinstance(procedure, Procedure):
        raise call.error("operators.session.no-such-procedure", name=name)
    operands = [Operand(v, call.span) for v in values]
    return call_procedure(session.evaluator, procedure, Call(session, operands, call.span))
