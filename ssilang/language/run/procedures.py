"""Calls of procedures and methods written in the language."""

from collections.abc import Callable
from typing import Any

from ssilang.language.run.call import Call
from ssilang.language.run.jumps import LeaveProcedure
from ssilang.language.run.scopes import Frame
from ssilang.language.run.session import Runner
from ssilang.language.say.errors import Interrupted, SsiError, interruption
from ssilang.language.text.tree import Parameter, heading
from ssilang.language.values import ANNULE, Objet, Procedure, Table, type_of
from ssilang.language.vocabulary.entry_checks import check_tables


class BoundMethod(Procedure):
    """A procedure with the object that it runs on."""

    __slots__ = ("target",)

    def __init__(self, procedure: Procedure, target: Objet) -> None:
        super().__init__(procedure.name, procedure.definition, procedure.origin)
        self.target = target


def method_of(holder: Objet, name: str | int) -> BoundMethod | None:
    """A method of an object, ready to be called."""
    found = holder.methods.get(str(name))
    return None if found is None else BoundMethod(found, holder)


def call_procedure(evaluator: Runner, procedure: Procedure, call: Call) -> list[Any]:
    """Run a procedure on the operands of a phrase; returns its results in order.

    Raises
    ------
    SsiError
        'missing-argument' for a mandatory argument, 'recursion' past the limit, or whatever its
        statements raise, with the chain of calls.
    """
    session = call.session
    caller = session.frame
    limit = session.limits.recursion
    if caller.depth >= limit:
        raise SsiError("recursion", call.span, limit=limit)
    call.name = procedure.name
    call.used = []
    frame = Frame(caller, procedure.name, call, procedure.origin == "stdlib")
    for parameter in procedure.definition.parameters:
        frame.assign(parameter.name, _argument(parameter, call, procedure))
    if frame.library:
        check_tables(session, procedure.name, frame, call.span)
    if isinstance(procedure, BoundMethod):
        frame.object = procedure.target
    place = call.span
    session.frame = frame
    try:
        try:
            evaluator.run(procedure.definition.body)
        except LeaveProcedure as jump:
            if jump.name != procedure.name:
                raise
        results = [o.value for o in evaluator.operands_of(procedure.definition.results)]
        if session.options.get("LOCA") is True and procedure.origin != "stdlib":
            own = {n: v for n, v in frame.variables.items() if v is not ANNULE}
            caller.assign(f"&{procedure.name}", Table.of(own))
        return [*frame.results, *(r for r in results if r is not ANNULE)]
    except SsiError as error:
        if error.span is None:
            error.span = evaluator.current_span
        error.calls.append((procedure.name, place))
        raise
    except KeyboardInterrupt as stop:
        where = interruption(stop, evaluator.current_span)
        where.calls.append((procedure.name, place))
        raise Interrupted(where) from None
    finally:
        session.frame = caller


def _argument(parameter: Parameter, call: Call, procedure: Procedure) -> Any:
    saved = list(call.operands)
    operand = call.read(parameter.type or "*")
    if operand is not None and parameter.subtype:
        value = operand.value
        if not isinstance(value, Table) or value.subtype != parameter.subtype:
            call.operands[:] = saved
            operand = None
    if operand is not None:
        return operand.value
    if parameter.optional:
        return ANNULE
    raise missing_parameter(procedure, parameter, call, type_of)


def missing_parameter(
    procedure: Procedure, parameter: Parameter, call: Call, kind_of: Callable[[Any], str]
) -> SsiError:
    """The error of an argument that is not there, pointing at what stands instead."""
    wrong = call.operands[0] if call.operands else None
    told = {"procedure": procedure.name, "parameter": parameter.name}
    told |= {"expected": parameter.type or "any object", "heading": heading(procedure.definition)}
    told |= {"found": kind_of(wrong.value) if wrong else "nothing"}
    return SsiError("missing-parameter", wrong.span if wrong else call.span, **told)
