"""Phrases: operands in a pile, the first unread word tried as an operator; errors there."""

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from numpy.linalg import LinAlgError

from ssilang.language.registry import OF_MODELS, Operator, find_operator, keywords_of
from ssilang.language.run.binding import run_operator
from ssilang.language.run.call import Call, Operand
from ssilang.language.run.jumps import Jump, StopRun
from ssilang.language.run.operands import OperandReader
from ssilang.language.run.procedures import call_procedure
from ssilang.language.run.scopes import PREDEFINED
from ssilang.language.run.session import Session
from ssilang.language.say.errors import ReaderLeft, SeveralErrors, SsiError
from ssilang.language.search import nearest
from ssilang.language.text import tree
from ssilang.language.text.parser import parse_statements
from ssilang.language.text.source import Source, Span
from ssilang.language.values import (
    MAY_BE_EMPTY,
    LazyRows,
    LazyTable,
    Mot,
    Procedure,
    Texte,
    is_empty,
    normalised,
    type_of,
)
from ssilang.messages.message import Said, Sentence


def tell_held_word(error: SsiError, operand: Operand) -> None:
    """Add the word to an error of its operator if the script holds it and does not write it."""
    written = operand.span.text
    if PREDEFINED.get(written.upper()) == operand.value:
        return
    if not operand.result and written.strip("'").upper()[:4] != str(operand.value).upper()[:4]:
        note = Sentence("held-word", word=str(operand.value), holder=written)
        error.data.setdefault("held_word", note)


def tell_unread_word(error: SsiError, left: Sequence[Operand], found: Operator) -> None:
    """Add that a word which the operator left unread looks like a keyword of its own."""
    if "." not in error.code:  # of the language itself: it looks at words already
        return
    written = next((o for o in left if o.span.text[:1] == "'" and isinstance(o.value, Mot)), None)
    if written is None:
        return
    word = str(written.value)
    near = nearest(word, keywords_of(found))
    if near and near != word.rstrip().upper():
        error.data.setdefault("unread_word", Sentence("unread-word", word=word, near=near))


def tell_quoted_operator(error: SsiError, items: Sequence[tree.Item]) -> None:
    """Add that a quoted word ran as the operator of that name, if it is all that stands there."""
    if len(items) == 1 and isinstance(items[0], tree.Quoted):
        note = Sentence("quoted-operator", word=items[0].text)
        error.data.setdefault("quoted_operator", note)


def name_as_word(code: str, words: Sequence[Operand], held: object) -> SsiError | None:
    """The error `code` for a word that is also the name of an object, `SI 'VRAI'`; else None."""
    if len(words) != 1 or held is None or isinstance(held, Mot):
        return None
    return SsiError(code, words[0].span, found="MOT", word=str(words[0].value))


def tell_line_begun(error: SsiError, operand: Operand) -> None:
    """Add that the operator begins a line if what stands on the lines before it is in its way."""
    span, wrong = operand.span, error.span
    if error.code not in _IN_THE_WAY or wrong is None or wrong.source is not span.source:
        return
    line, column = span.source.position(span.start)
    if operand.result or span.source.line(line)[: column - 1].strip() or wrong.start >= span.start:
        return
    first = span.source.position(wrong.start)[0]
    if first < line:
        word = span.text.strip("'")
        note = Sentence("statement-goes-on", word=word, line=line, first=first)
        error.data.setdefault("begins_line", note)


_IN_THE_WAY = frozenset({"wrong-argument", "excess", "no-result"})


def unended(targets: Sequence[tree.Item]) -> Span | None:
    """The statement that lost its `;` before an assignment, None if there is none.

    It is what stands left of =, where the last name alone is on a later line than the rest.
    """
    if len(targets) < 2:
        return None
    *before, last = (t.span for t in targets)
    line = last.source.position(last.start)[0]
    if last.source.position(before[-1].start)[0] == line:
        return None
    return before[0].to(before[-1])


def no_result(
    targets: Sequence[tree.Item], target: tree.Item, count: int, wanted: str = ""
) -> SsiError:
    """The error of a name on the left of = that gets nothing."""
    statement = unended(targets)
    if statement is not None:
        last = targets[-1].span
        line = last.source.position(last.start)[0]
        return SsiError("unended-statement", statement, name=last.text, line=line)
    return SsiError("no-result", target.span, count=count, wanted=wanted, name=target.span.text)


# operators whose operands must stay as written
_RAW_ITEMS = frozenset({"TEXT"})
MADE_LISTS = {
    "LISTREEL": "PROG", "LISTENTI": "LECT", "LISTMOTS": "MOTS", "LISTCHPO": "SUIT",
    "LISTOBJE": "ENUM",
}  # fmt: skip
"""Types whose first four letters are an operator's, with the operators that make them."""
_SIGNS = frozenset({"+", "-", "*", "/", "ET", "OU"})
_PASSED = (SsiError, SeveralErrors, StopRun, Jump, ReaderLeft)
"""What errors and jumps of scripts are."""
# how numpy begins to refuse an array that no memory holds
_BEYOND_MEMORY = ("array is too big", "Maximum allowed")
_PART = 255  # operands of a long chain `a + b + c ...` that are run together, an odd number


class PhraseRunner(OperandReader):
    """The part of the evaluator that runs phrases; the rest runs statements and blocks."""

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        self.current_span: Span | None = None
        self._silent: Operand | None = None  # the word of an operator that gave nothing
        self._overflowed = False  # an array operation had a result past all reals

    @abstractmethod
    def run(self, nodes: Sequence[tree.Node]) -> None:
        """Run the statements of a procedure."""

    def phrase(
        self, items: Sequence[tree.Item], span: Span, one_name: bool = True
    ) -> list[Operand]:
        """Run a phrase; returns the operands that are left: results first."""
        if items and isinstance(first := items[0], tree.Name | tree.Quoted):
            word = first.text.upper()[:4]
            if word in _RAW_ITEMS and self.session.frame.find(word) is None:
                return [Operand(self._texte(items[1:]), span, result=True)]
        self._silent = None
        call = Call(self.session, self.operands_of(self.session.library.called(items)), span)
        self._reduce(call)
        if one_name and call.operands:
            self._implicit_point(call)
        return call.operands

    def _texte(self, items: Sequence[tree.Item]) -> Texte:
        parts: list[tree.Item] = []
        targets: list[tree.Item] = []
        for item in items:
            value = self._spelled(item)
            if isinstance(value, Mot):
                words, names = _words_of(tree.Quoted(str(value), item.span))
                parts.extend(words)
                targets.extend(names)
            elif value is not None:
                parts.append(tree.Number(value, item.span))
            else:
                parts.append(item)
        return Texte(tuple(parts), tuple(targets))

    def _spelled(self, item: tree.Item) -> Any:
        """What a part of a TEXTE says now: a quoted word, the value of a word or a number."""
        if isinstance(item, tree.Quoted):
            return Mot(item.text)
        if isinstance(item, tree.Name | tree.Path):
            operands = self._operand[type(item)](item)
            value = operands[0].value if len(operands) == 1 else None
            unnamed = (
                isinstance(value, Mot) and isinstance(item, tree.Name) and not operands[0].name
            )
            if type(value) in (int, float) or (isinstance(value, Mot) and not unnamed):
                return value
        return None

    def _reduce(self, call: Call) -> None:
        while len(call.operands) > 2 * _PART and _begins_long_chain(call.operands):
            # what stands behind a sign is never reached from before it: the part runs by itself,
            # and the rest of the chain does not move at each sign
            part = Call(self.session, call.operands[:_PART], call.span)
            self._reduce(part)
            call.operands[:_PART] = part.operands
        while (i := call.word_index()) is not None:
            operand = call.operands[i]
            if isinstance(operand.value, Procedure):
                del call.operands[i]
                call.span = operand.span
                self._push(
                    call, call_procedure(self.session.evaluator, operand.value, call), operand.span
                )
                continue
            found = None
            if not operand.result or len(call.operands) > 1:
                found = find_operator(operand.value.rstrip())
            if found is None:
                return
            del call.operands[i]
            self._operate(found, operand, call)
            if found.terminal:
                return

    def _operate(self, found: Operator, operand: Operand, call: Call) -> None:
        if found.name == "LIST" and (word := operand.value.rstrip().upper()) in MADE_LISTS:
            raise SsiError("type-for-operator", operand.span, word=word, maker=MADE_LISTS[word])
        call.span, call.name, call.used = operand.span, found.full_name, []
        try:
            results = self.guarded(lambda: run_operator(found, call), operand.span, found.full_name)
        except SsiError as error:
            tell_held_word(error, operand)
            tell_line_begun(error, operand)
            tell_unread_word(error, call.operands, found)
            if error.code == "internal":
                # Refuse the operand that an operator failed over: NaN, or nothing in it.
                wrong, code = self._not_finite(call.used), "operand-not-finite"
                if wrong is None:
                    wrong, code = next(_empty_ones(call.used), None), "operand-holds-nothing"
                if wrong is not None:
                    raise SsiError(
                        code, wrong.span, operator=found.full_name, operand=wrong.span.text[:40]
                    ) from error
            raise
        if not found.empties:
            self._tell_empty(call.used, found.full_name)
        if found.family in OF_MODELS:
            for value in self.session.apart([o.value for o in call.used]):
                call.warn("operand-apart", value, operand=call.place_of(value).text[:40])
        self.session.follow(call, found.name, results)
        span = operand.span
        if self._overflowed:
            self._overflowed = False
            # Tell of results with infinite numbers made of finite ones.
            made = results if isinstance(results, tuple) else (results,)
            infinite = any(self.session.flaw_of(r) == "entry-not-finite" for r in made)
            if infinite and self._not_finite(call.used) is None:
                call.warn("operators.numbers.past-reals", sign=found.full_name)
        self._silent = operand if results is None else None
        if isinstance(results, tuple):
            self._push(call, list(results), span)
        elif results is not None:
            call.operands.insert(0, Operand(normalised(results), span, result=True))

    def guarded(self, action: Callable[[], Any], span: Span | None, name: str) -> Any:
        """Run what an operator does; whatever it raises becomes an error of the script."""
        try:
            result = action()
        except KeyboardInterrupt:
            self.session.was_interrupted()  # it is seen
            raise
        except _PASSED:
            raise
        except RecursionError:
            raise SsiError("recursion", span, limit=self.session.limits.recursion) from None
        except MemoryError:
            raise SsiError("memory", span, operator=name) from None
        except OverflowError:
            raise SsiError("number-too-large", span, operator=name) from None
        except LinAlgError as problem:  # of numbers that a script gives
            raise SsiError("unsolvable", span, operator=name, reason=str(problem)) from problem
        except Exception as problem:
            if self.session.was_interrupted():  # it fails over what it swallowed
                raise KeyboardInterrupt from problem
            if isinstance(problem, ValueError) and str(problem).startswith(_BEYOND_MEMORY):
                raise SsiError("memory", span, operator=name) from None
            if not isinstance(problem, Said):
                told = {"kind": type(problem).__name__, "reason": str(problem)}
                raise SsiError("internal", span, operator=name, **told) from problem
            raise SsiError.of(problem, span, operator=name) from problem
        if self.session.was_interrupted():
            raise KeyboardInterrupt
        return result

    def _tell_empty(self, operands: Sequence[Operand], name: str) -> None:
        """Tell of operands that hold nothing, where the script itself calls."""
        session = self.session
        for operand in _empty_ones(operands):
            if session.frame.procedure not in session.library.standard_names:
                told = {"operator": name, "operand": operand.span.text[:40]}
                session.warn("operand-empty", operand.span, found=type_of(operand.value), **told)

    def _not_finite(self, operands: Sequence[Operand]) -> Operand | None:
        """The first operand that holds NaN or an infinite number: what an operator failed over."""
        flaw_of = self.session.flaw_of
        return next((o for o in operands if flaw_of(o.value) == "entry-not-finite"), None)

    @staticmethod
    def _push(call: Call, results: Sequence[Any], span: Span) -> None:
        call.operands[:0] = [Operand(normalised(r), span, result=True) for r in results]

    def _implicit_point(self, call: Call) -> None:
        if len(call.operands) < 2:
            return
        numbers = [o for o in call.operands if type(o.value) in (int, float)]
        if len(numbers) != len(call.operands):
            return
        dimension = self.session.dimension()
        if dimension not in (2, 3) or self.session.make_point is None:
            return
        span = numbers[0].span.to(numbers[-1].span)
        if len(numbers) < dimension:
            raise SsiError("third-coordinate", span)
        if len(numbers) == dimension:
            make = self.session.make_point
            point = self.guarded(lambda: make([float(o.value) for o in numbers]), span, "POINT")
            call.operands[:] = [Operand(point, span, result=True)]


def _begins_long_chain(operands: Sequence[Operand]) -> bool:
    """Whether a long phrase begins with values and signs in turn, a sign behind the first part."""
    return all(
        isinstance(o.value, Mot) and o.value in _SIGNS for o in operands[1 : _PART + 1 : 2]
    ) and not any(isinstance(o.value, Mot | Procedure | Texte) for o in operands[:_PART:2])


def _empty_ones(operands: Iterable[Operand]) -> Iterator[Operand]:
    """Operands that hold nothing; tables that are made when they are asked for hold something."""
    for operand in operands:
        value = operand.value
        if type_of(value) not in MAY_BE_EMPTY or isinstance(value, LazyTable | LazyRows):
            continue
        if is_empty(value):
            yield operand


def _words_of(item: tree.Quoted) -> list[list[tree.Item]]:
    """Items of the text of a quoted part of a TEXTE, and the names in front of its `=`."""
    # behind a blank: a sign * in the first column would begin a comment
    source = Source(item.span.source.name, " " + item.text + ";")
    try:
        statements = parse_statements(source)
    except SeveralErrors as several:
        for error in several.errors:
            error.span = item.span
        raise
    parts = ([s.items for s in statements], [s.targets for s in statements])
    return [[tree.placed(i, item.span) for items in part for i in items] for part in parts]
