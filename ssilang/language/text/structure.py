"""Nesting of statements into blocks, by their first word, as the language skips branches."""

from dataclasses import dataclass, field, replace

from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text import tree
from ssilang.language.text.parser import decimal_commas, end_of_run, parse_statements
from ssilang.language.text.source import Source, Span
from ssilang.late_imports import without_collections

_OPENS = {"SI": "FINSI", "SINO": "FINSI", "REPE": "FIN", "DEBP": "FINP", "DEBM": "FINM"}


def control_word(statement: tree.Statement) -> str:
    """The control word that a statement begins with, '' if none."""
    word = statement.first_word[:4].rstrip()
    return word if word in _STEPS else ""


@dataclass
class _Open:
    """A block under construction."""

    kind: str
    statement: tree.Statement | None
    body: list[tree.Node] = field(default_factory=list)
    name: str = ""
    then: tuple[tree.Node, ...] = ()
    unnamed: bool = False  # its name is missing: any end fits


def parse(source: Source) -> tree.Script:
    """Parse and structure a script.

    Raises
    ------
    SeveralErrors
        With all syntax errors, then all errors of nesting.
    """
    with without_collections():
        try:
            statements = parse_statements(source)
        except SeveralErrors:
            end = end_of_run(source)
            if end is None or not source.code[end:].strip():
                raise
            statements = parse_statements(source, end)
        commas = decimal_commas(source)
        if any(not c.warns for c in commas):
            raise SeveralErrors(commas)
        script = structure(statements, source)
        return replace(script, warnings=(*commas, *script.warnings)) if commas else script


def structure(statements: list[tree.Statement], source: Source) -> tree.Script:
    """Nest a flat list of statements; see `parse`."""
    errors: list[SsiError] = []
    stack = [_Open("", None)]
    strays: list[SsiError] = []
    crossed: set[str] = set()  # openers that were taken as closed: their late ends are forgiven
    named = {t.text for s in statements for t in s.targets if isinstance(t, tree.Name)}
    for statement in map(_without_strays, statements):
        strays += [e for e in _inside(stack, statement) if str(e.data["word"]).upper() not in named]
        word = control_word(statement)
        if word == "FIN" and not any(getattr(i, "items", i) for i in statement.items[1:]):
            word = ""  # FIN alone stops the run, with empty parentheses, too
            statement = tree.Statement((), statement.items[:1], statement.span)
        try:
            _STEPS.get(word, _plain)(stack, statement)
        except SsiError as error:
            if error.code == "crossed-blocks":
                crossed.add(str(error.data["missing"]))
            late = error.code == "stray-block-end" and str(error.data["word"])[:4] in {
                c[:4] for c in crossed
            }
            if error.code == "stray-block-end" and word == "FINS" and not late:
                # with no SI open in its block it ends nothing
                strays.append(SsiError("finsi-without-si", error.span, **error.data))
                strays[-1].warns = True
            elif not late:
                errors.append(error)
    unclosed = [_unclosed(left) for left in reversed(stack[1:]) if not left.unnamed]
    if errors or (unclosed and not _ends_run(stack)):
        inside = [s for s in strays if s.code == "block-word-inside"]
        raise SeveralErrors(errors + unclosed + inside)
    for left in unclosed:
        left.warns = True
    while len(stack) > 1:
        top = stack[-1]
        if top.kind == "REPE":
            stack.pop()
            stack[-1].body.append(_loop(top, statements[-1]))
        else:
            _finsi(stack, statements[-1])
    whole = Span(source, 0, len(source.text))
    return tree.Script(tuple(stack[0].body), whole, tuple(unclosed), tuple(strays))


def _ends_run(stack: list[_Open]) -> bool:
    """Whether what is left open ends the run: FIN alone in the innermost of loops and branches."""
    return not any(left.kind[:3] == "DEB" for left in stack) and any(
        isinstance(node, tree.Statement) and control_word(node) == "FIN" for node in stack[-1].body
    )


def _unclosed(left: _Open) -> SsiError:
    assert left.statement is not None
    return SsiError(
        "unclosed-block",
        left.statement.span,
        word=left.statement.first_word,
        missing=_OPENS[left.kind] + (f" {left.name}" if left.kind == "REPE" else ""),
    )


def _without_strays(statement: tree.Statement) -> tree.Statement:
    """`3 SINON ;` is SINON: numbers in front of the word are operands that nothing reads."""
    items = statement.items
    if len(items) < 2 or statement.assigns or not isinstance(items[0], tree.Number):
        return statement
    at = next((i for i, item in enumerate(items) if not isinstance(item, tree.Number)), 0)
    rest = tree.Statement((), items[at:], statement.span)
    return rest if at and control_word(rest) in ("SINO", "FINS") else statement


def _inside(stack: list[_Open], statement: tree.Statement) -> list[SsiError]:
    """Words of blocks that a statement takes as operands, as its own end is missing."""
    found, loops = [], {opened.name for opened in stack[1:]}
    of_loops = ("FIN", "QUIT", "ITER")[: 1 if control_word(statement) == "SI" else 3]
    for item, after in zip(statement.items[1:], (*statement.items[2:], None), strict=False):
        word = item.text[:4].rstrip() if isinstance(item, tree.Name) else ""
        of_loop = word in of_loops and getattr(after, "text", "").upper() in loops
        of_loop |= word == "FIN" and after is None and not statement.assigns  # the run's
        if word in ("SINO", "FINS", "FINP", "FINM") or of_loop:
            found.append(SsiError("block-word-inside", item.span, word=item.span.text))
            found[-1].warns = True
    return found


def _plain(stack: list[_Open], statement: tree.Statement) -> None:
    stack[-1].body.append(statement)


def _si(stack: list[_Open], statement: tree.Statement) -> None:
    stack.append(_Open("SI", statement))


def _sinon(stack: list[_Open], statement: tree.Statement) -> None:
    top = stack[-1]
    if any(isinstance(item, tree.Paren) for item in statement.items):
        raise SsiError("sinon-condition", statement.span)
    if top.kind == "SINO" and top.statement is not None:
        line = top.statement.span.source.position(top.statement.span.start)[0]
        raise SsiError("second-sinon", statement.span, line=line)
    if top.kind != "SI":
        raise _stray(stack, statement, "SI")
    top.then, top.body, top.kind = tuple(top.body), [], "SINO"


def _finsi(stack: list[_Open], statement: tree.Statement) -> None:
    top = stack[-1]
    if top.kind not in ("SI", "SINO") or top.statement is None:
        raise _stray(stack, statement, "SI")
    stack.pop()
    body = tuple(top.body)
    then, otherwise = (body, ()) if top.kind == "SI" else (top.then, body)
    span = top.statement.span.to(statement.span)
    rest = tree.Statement((), top.statement.items[1:], top.statement.span)
    stack[-1].body.append(tree.If(rest, then, otherwise, span))


def _repe(stack: list[_Open], statement: tree.Statement) -> None:
    rest = list(statement.items[1:])
    at = next((i for i, item in enumerate(rest) if isinstance(item, tree.Name | tree.Quoted)), None)
    if at is None:
        stack.append(_Open("REPE", statement, unnamed=True))
        raise SsiError("loop-name", statement.span)
    item = rest.pop(at)
    assert isinstance(item, tree.Name | tree.Quoted)
    opened = _Open("REPE", tree.Statement((), (statement.items[0], *rest), statement.span))
    opened.name = item.text.upper()
    stack.append(opened)


def _fin(stack: list[_Open], statement: tree.Statement) -> None:
    item = statement.items[1]
    name = item.text.upper() if isinstance(item, tree.Name | tree.Quoted) else ""
    top = stack[-1]
    if top.kind != "REPE" or top.statement is None:
        raise _crossed(stack, statement, name) or _stray(stack, statement, "REPE")
    stack.pop()
    if name != top.name and not top.unnamed:
        stack[-1].body.append(_loop(top, statement))
        raise SsiError("wrong-loop-name", item.span, expected=top.name, found=name)
    stack[-1].body.append(_loop(top, statement))


def _crossed(stack: list[_Open], statement: tree.Statement, name: str) -> SsiError | None:
    """FIN of a loop inside of which other blocks are open: these are taken as closed."""
    at = next((i for i, o in enumerate(stack) if o.kind == "REPE" and o.name == name), 0)
    if not at:
        return None
    inner, top = stack[-1], stack[at]
    assert inner.statement is not None
    del stack[at:]
    stack[-1].body.append(_loop(top, statement))
    line = inner.statement.span.source.position(inner.statement.span.start)[0]
    told = {"inside": inner.statement.first_word, "line": line, "missing": _OPENS[inner.kind]}
    return SsiError("crossed-blocks", statement.span, name=name, **told)


def _loop(top: _Open, end: tree.Statement) -> tree.Loop:
    assert top.statement is not None
    count = top.statement.items[1:]
    return tree.Loop(top.name, count, tuple(top.body), top.statement.span.to(end.span))


def _debp(stack: list[_Open], statement: tree.Statement) -> None:
    kind = control_word(statement)
    if len(statement.items) < 2 or not isinstance(statement.items[1], tree.Name | tree.Quoted):
        stack.append(_Open(kind, statement))
        raise SsiError("procedure-name", statement.span)
    opened = _Open(kind, statement)
    opened.name = statement.items[1].text.upper()
    stack.append(opened)


def _finp(stack: list[_Open], statement: tree.Statement) -> None:
    kind = "DEBP" if control_word(statement) == "FINP" else "DEBM"
    at = next((i for i in reversed(range(len(stack))) if stack[i].kind == kind), 0)
    top = stack[at]
    if top.statement is None:
        raise _stray(stack, statement, kind)
    inner = stack[at + 1 :]  # what the procedure's end finds open was never closed
    del stack[at:]
    parts = _parameters(top.statement.items[2:]), tuple(top.body), statement.items[1:]
    whole = top.statement.span.to(statement.span)
    stack[-1].body.append(tree.Definition(top.name, *parts, kind == "DEBM", whole))
    if inner and not inner[0].unnamed:
        raise _unclosed(inner[0])


def _parameters(items: tuple[tree.Item, ...]) -> tuple[tree.Parameter, ...]:
    found: list[tree.Parameter] = []
    i = 0
    while i < len(items):
        item = items[i]
        if not isinstance(item, tree.Name | tree.Quoted):
            raise SsiError("parameter", item.span)
        name, span, optional, types = item.text.upper(), item.span, False, []
        i += 1
        while (
            i + 1 < len(items) and isinstance(sign := items[i], tree.Symbol) and sign.text in "*/"
        ):
            kind = items[i + 1]
            if not isinstance(kind, tree.Name | tree.Quoted):
                raise SsiError("parameter", kind.span)
            optional = optional or sign.text == "/"
            types.append(kind.text.upper()[:8].rstrip())  # type words have 8 letters
            span = span.to(kind.span)
            i += 2
        if i < len(items) and isinstance(items[i], tree.Number | tree.Symbol):
            raise SsiError("parameter", items[i].span)
        kinds = [*types, "", ""]
        found.append(tree.Parameter(name, kinds[0], optional, kinds[1], span))
    return tuple(found)


def _stray(stack: list[_Open], statement: tree.Statement, opener: str) -> SsiError:
    opened, told = stack[-1].statement, {"inside_name": stack[-1].name, "inside": "", "line": 0}
    if opened is not None:
        line = opened.span.source.position(opened.span.start)[0]
        told |= {"inside": opened.first_word, "line": line}
    word = statement.first_word
    return SsiError("stray-block-end", statement.span, word=word, opener=opener, **told)


_STEPS = {
    "SI": _si,
    "SINO": _sinon,
    "FINS": _finsi,
    "REPE": _repe,
    "FIN": _fin,
    "DEBP": _debp,
    "DEBM": _debp,
    "FINP": _finp,
    "FINM": _finp,
}
