"""QUIT ITER FIN ASSI ARGU RESP COMM: where statements go on; INFO NOTI AIDE SOUC: what is told."""

from ssilang.language.registry import OPERATORS
from ssilang.language.run.jumps import LeaveLoop, LeaveProcedure, NextTurn, StopRun
from ssilang.language.run.library import standard_procedures
from ssilang.language.say import reference
from ssilang.operators.prelude import *
from ssilang.operators.vocabulary.pages import help_text, near_name


@operator("QUIT", gives=(), family="control", full_name="QUITTER")
def quitter(session: Session, name: str = Name(en="loop or procedure to leave")) -> NoReturn:
    """Leave a loop or a procedure."""
    if session.frame.procedure == name:
        raise LeaveProcedure(name)
    raise LeaveLoop(name)


@operator("ITER", gives=(), family="control", full_name="ITERER")
def iterer(name: str = Name(en="loop that goes on")) -> NoReturn:
    """Go to the end of the turn."""
    raise NextTurn(name)


ASSI = shared("ASSI", "control", full_name="ASSISTANT")


@ASSI.form(
    said("TOUS"), gives=ANY, by_hand="the phrase is run once for each object of the tables in it"
)
def assi_all(call: Call, word: str) -> tuple[Table, ...] | None:
    """Run the phrase for all objects of its tables."""
    phrase = list(call.operands)
    del call.operands[:]
    tables = [o.value for o in phrase if isinstance(o.value, Table) and o.value.subtype == _SLAVE]
    if not tables:
        raise call.error("operators.session.no-slave-table")
    indices = _indices(tables[0])
    if any(len(_indices(t)) != len(indices) or not all(map(t.has, indices)) for t in tables):
        raise call.error("operators.session.slave-indices")
    made: tuple[Table, ...] | None = None
    for index in indices:
        operands = [
            replace(o, value=o.value.get(index)) if any(o.value is t for t in tables) else o
            for o in phrase
        ]
        results = call.session.evaluator.reduced(operands, call.span)
        if made is None:
            made = tuple(Table(_SLAVE) for _ in results)
        if len(results) != len(made):
            raise call.error("operators.session.slave-results", index=index)
        for table, value in zip(made, results, strict=True):
            table.set(index, value)
    return made or None


_SLAVE = "ESCLAVE"


def _indices(table: Table) -> list[Any]:
    """Indices of the objects of a table ESCLAVE."""
    return [i for i, _ in table.items() if i != "SOUSTYPE"]


@ASSI.form(gives=())
def assi(
    number: int | None = Opt("ENTIER", en="assistant, changes nothing", range=ANY_NUMBER),
) -> None:
    """The phrase goes on."""


@operator("FIN", gives=(), family="control")
def fin() -> NoReturn:
    """End the run."""
    raise StopRun


@operator("COMM", family="control", full_name="COMMENTAIRE")
def comm(text: tuple[Any, ...] = Many("*", "TEXTE", en="whatever is said")) -> None:
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


@operator("RESP", family="control", full_name="RESPRO")
def resp(session: Session, results: tuple[Any, ...] = Many(en="results, in order")) -> None:
    """Queue results."""
    session.frame.results.extend(r for r in results if r is not ANNULE)


@operator("INFO", family="session", full_name="INFORMATION")
def info(call: Call, said: str = Arg("MOT", en="operator, procedure or word")) -> None:
    """Print the page of the word that follows."""
    text = help_text(said, call.session.language)
    if not text:
        near = near_name(said)
        raise call.error("operators.session.no-help", said, said=said.upper(), near=near)
    call.session.print(text)


@operator("NOTI", family="session", full_name="NOTICE")
def noti(session: Session, said: str | None = Opt("MOT", en="changes nothing")) -> None:
    """Print the overview; the word that may follow chooses nothing here."""
    session.print(reference.overview(standard_procedures().values(), session.language))


@operator("AIDE", family="session")
def aide(session: Session, said: str = Arg("MOT", en="text looked for")) -> ListMots:
    """Search the help in both languages, whatever the case."""
    pages = [reference.operator_page(o) for n, o in sorted(OPERATORS.items()) if n == o.name]
    pages += [reference.procedure_page(p) for p in standard_procedures().values()]
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


@SOUC.form()
def _raise_flag(
    session: Session,
    level: int = Arg("ENTIER", en="level, 0 to lower the flag", range=NOT_NEGATIVE),
) -> None:
    if level:
        session.doubt(level)
    else:
        session.options["SOUC"] = 0


@SOUC.form()
def _is_raised(session: Session) -> bool:
    return bool(session.options.get("SOUC", 0))
