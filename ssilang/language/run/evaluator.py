"""Runs statements and blocks: assignments, conditions, loops, definitions."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ssilang.language.cast3m import find_cast3m_word
from ssilang.language.run import phrases
from ssilang.language.run.call import Call, Operand
from ssilang.language.run.fast import Slow, Value, compile_phrase
from ssilang.language.run.jumps import Jump, LeaveLoop, NextTurn
from ssilang.language.run.leftovers import is_call, leftover_error
from ssilang.language.run.not_built import put_off
from ssilang.language.run.session import LoopObserver, Session
from ssilang.language.say.diagnostics import suggestion
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Span
from ssilang.language.values import ANNULE, Mot, Objet, Procedure, Table, Texte, type_of
from ssilang.language.vocabulary.entries import is_declared_value
from ssilang.messages.message import Sentence

DIRECTIVES = frozenset(
    ["QUIT", "ITER", "MESS", "ERRE", "LIST", "TRAC", "DESS", "OPTI", "MENA", "SAUT", "RESP", "TITR"]
)
"""Operators that give nothing, so that none of them can be a part of a condition."""


_GO_ON = frozenset({"IGNORE", "CONTROLE"})
_NOTHING_TO_READ = frozenset({"wrong-argument", "missing-argument", "missing-keyword"})


def _behind_condition(items: Sequence[tree.Item]) -> tree.Item | None:
    """The directive that follows a parenthesised condition, if one does."""
    if len(items) < 2 or not isinstance(items[0], tree.Paren):
        return None
    word = items[1]
    said = isinstance(word, tree.Name | tree.Quoted) and word.text[:4] in DIRECTIVES
    return word if said else None


class Evaluator(phrases.PhraseRunner):
    """Executes the nodes of parsed scripts in a session, whose evaluator it is from now on."""

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        session.evaluator = self
        self.statement_count = 0
        self._compiled: dict[tree.Statement | tree.Paren, Value | None] = {}
        self._warned: set[tree.Statement] = set()  # statements warned of
        self._run_node: dict[type, Callable[[Any], None]] = {
            tree.Statement: self._tolerant,
            tree.If: self._if,
            tree.Loop: self._loop,
            tree.Definition: self._define,
        }

    # ---- blocks ----------------------------------------------------------------------------

    def run(self, nodes: Sequence[tree.Node]) -> None:
        """Run nodes in order."""
        run_node = self._run_node
        for node in nodes:
            run_node[type(node)](node)

    def _if(self, node: tree.If) -> None:
        statement = node.condition
        self._begin(statement.span)
        value = self.scalar(statement)
        if type(value) is bool:
            self.run(node.then if value else node.otherwise)
            return
        items = statement.items
        if unread := _behind_condition(items):
            # SI ends its statement: what stands there for want of a ; is not run
            items = items[:1]
            self._warn_once(statement, "behind-condition", unread.span, name=unread.span.text)
        results = self.phrase(items, statement.span)
        if len(results) != 1 or not isinstance(results[0].value, bool):
            raise self._unfit("condition", results, statement.span)
        self.run(node.then if results[0].value else node.otherwise)

    def _warn_once(
        self, statement: tree.Statement, code: str, span: Span | None, **data: object
    ) -> None:
        if statement not in self._warned:
            self._warned.add(statement)
            self.session.warn(code, span, **data)

    def _loop(self, node: tree.Loop) -> None:
        limit = self._count(node)
        observer = self.session.loops
        if observer is None:
            self._turns(node, limit, None)
            return
        observer.enter(node.name, limit)
        try:
            self._turns(node, limit, observer)
        finally:
            observer.leave()

    def _turns(self, node: tree.Loop, limit: int | None, observer: LoopObserver | None) -> None:
        counters = {("&" + node.name)[:n] for n in (8, 24)}  # seven letters do
        variables = self.session.frame.variables
        turn = 1
        while limit is None or turn <= limit:
            variables.update(dict.fromkeys(counters, turn))
            if observer is not None:
                observer.turn(turn)
            self._begin(node.span)
            try:
                self.run(node.body)
            except NextTurn as jump:
                if jump.name != node.name:
                    raise
            except LeaveLoop as jump:
                if jump.name != node.name:
                    raise
                return
            turn += 1
        variables.update(dict.fromkeys(counters, turn))

    def _count(self, node: tree.Loop) -> int | None:
        if not node.count:
            return None
        self.current_span = node.span
        results = self.phrase(node.count, node.span)
        value = results[0].value if len(results) == 1 else None
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if not isinstance(value, int) or isinstance(value, bool):
            raise self._unfit("loop-count", results, node.count[0].span)
        return None if value < 0 else value

    def _unfit(self, code: str, results: Sequence[Operand], span: Span) -> SsiError:
        """The error for a condition or a count of another type than it must have."""
        if not results:
            return SsiError(code, span, found="nothing")
        words = [o for o in results if isinstance(o.value, Mot) and not o.name and not o.result]
        if words:
            error = phrases.name_as_word(code, words, self.session.frame.find(str(words[0].value)))
            error = error or leftover_error(words, self.session.assignments)
            if error is not None:
                return error
        return SsiError(code, results[0].span, found=type_of(results[0].value))

    def _define(self, node: tree.Definition) -> None:
        if self.session.library.is_own(node.name):
            place = Span(node.span.source, node.span.start, node.span.start + len("DEBP"))
            self.session.warn("overrides-procedure", place, name=node.name)
        self.session.frame.assign(node.name, Procedure(node.name, node))

    # ---- statements ------------------------------------------------------------------------

    def _tolerant(self, statement: tree.Statement) -> None:
        """Run a statement; under OPTI ERRE IGNORE, CONTROLE errors are shown and the run goes on.

        It goes on too behind an operator of Cast3M that is not built, until its result is read.
        """
        try:
            self._statement(statement)
        except SsiError as error:
            if self.session.options.get("ERRE") in _GO_ON:
                if error.span is None:
                    error.span = statement.span
                self.session.report(error)
                for target in statement.targets:  # they hold nothing, whatever they held
                    if isinstance(target, tree.Name):
                        self.store(target, ANNULE)
                return
            later = put_off(statement, error, self.known_names())
            if later is None:
                raise
            self._warn_once(statement, "not-built-yet", error.span, **error.data)
            for target in statement.targets:
                self.store(target, later)

    def _begin(self, span: Span) -> None:
        """Note the place and count what is run, conditions and turns of loops included."""
        self.current_span = span
        self.statement_count += 1
        limit = self.session.limits.statements
        if limit is not None and self.statement_count > limit:
            raise SsiError("statement-limit", span, limit=limit)

    def _statement(self, statement: tree.Statement) -> None:
        self._begin(statement.span)
        if len(statement.targets) == 1:
            value = self.scalar(statement)
            if value is not None:
                self.store(statement.targets[0], value)
                return
        if not statement.targets and not (statement := self._spelled_out(statement)).targets:
            self._unnamed(statement)
            return
        one = len(statement.targets) == 1
        try:
            left = self.phrase(statement.items, statement.span, one_name=one)
        except SsiError as error:
            word = self.word_of_entry(statement, error)
            if word is None:
                if error.code in _NOTHING_TO_READ:
                    phrases.tell_quoted_operator(error, statement.items)
                raise
            left = [word]
        self._assign(statement, left)

    def _spelled_out(self, statement: tree.Statement) -> tree.Statement:
        """The statement, or what a TEXTE alone runs whose text gives names to results."""
        first = statement.items[0] if len(statement.items) == 1 else None
        text = self.session.frame.find(first.text.upper()) if isinstance(first, tree.Name) else None
        if not isinstance(text, Texte) or not text.targets:
            return statement
        return tree.Statement(text.targets, text.items, statement.span, assigns=True)

    def word_of_entry(self, statement: tree.Statement, error: SsiError) -> Operand | None:
        """The word that a table's entry is given, where it also names an operator.

        `T . 'VITEUNIL' = 'MASSE'`: the operator finds nothing to read, and an entry of that index
        is declared to take the word.
        """
        if error.code not in _NOTHING_TO_READ or not statement.targets or len(statement.items) != 1:
            return None
        target, item = statement.targets[0], statement.items[0]
        said = item.text if isinstance(item, tree.Quoted | tree.Name) else ""
        held = error.data.get("held_word")
        word = str(held.data["word"]) if isinstance(held, Sentence) else said
        index = target.indices[-1] if isinstance(target, tree.Path) else None
        if not word or not isinstance(index, tree.Quoted | tree.Name):
            return None
        if not is_declared_value(index.text.rstrip(), word.upper().rstrip()):
            return None
        return Operand(Mot(word), item.span, result=True)

    def _unnamed(self, statement: tree.Statement, asked: bool = False) -> list[Operand]:
        """Run a statement without names; results that nobody takes, or asked for, are dropped."""
        left = self.phrase(statement.items, statement.span, one_name=True)
        if error := self.unread(statement, left):
            if asked or not error.warns:
                raise error
            if statement not in self._warned:
                self._warned.add(statement)
                self.session.report(error)
        return left

    def values_of(self, statement: tree.Statement) -> list[Any]:
        """Results of a statement without names on its left, or the object it names."""
        self.current_span = statement.span
        items = statement.items
        if len(items) == 1 and isinstance(items[0], tree.Name | tree.Path | tree.Number):
            operands = self.operands_of(items)
            if not isinstance(operands[0].value, Mot | Texte | Procedure):
                return [o.value for o in operands]
        return [o.value for o in self._unnamed(statement, asked=True)]

    def reduced(self, operands: Sequence[Operand], span: Span) -> list[Any]:
        """Values that a phrase of these operands leaves."""
        call = Call(self.session, list(operands), span)
        self._reduce(call)
        self.refuse_leftovers([o for o in call.operands if not o.result])
        return [o.value for o in call.operands]

    def run_top(self, nodes: Sequence[tree.Node]) -> None:
        """Run nodes that stand outside of any procedure.

        Raises
        ------
        SsiError
            'no-such-loop' for a QUIT or ITER that names nothing open, besides what nodes raise.
        """
        self._overflowed = False
        try:
            with np.errstate(over="call", call=self._note_overflow):
                self.guarded(lambda: self._run_all(nodes), self.current_span, "")
        except Jump as jump:
            raise SsiError("no-such-loop", self.current_span, name=jump.name) from None

    def _note_overflow(self, kind: str, flags: int) -> None:
        self._overflowed = True

    def _run_all(self, nodes: Sequence[tree.Node]) -> None:
        try:
            self.run(nodes)
        except RecursionError:
            raise SsiError("nesting", self.current_span) from None

    def scalar(self, statement: tree.Statement | tree.Paren) -> Any:
        """Value of a phrase of scalars by the short way, None if it is not one."""
        try:
            compiled = self._compiled[statement]
        except KeyError:
            # who is told of the forms that run is told of signs too
            short = self.session.on_form is None
            compiled = compile_phrase(statement.items) if short else None
            self._compiled[statement] = compiled
        if compiled is None:
            return None
        try:
            return compiled(self.session.frame)
        except Slow:
            return None

    def _assign(self, statement: tree.Statement, left: list[Operand]) -> None:
        if len(left) == len(statement.targets) == 1 and not is_call(left):
            if left[0].refusal:
                raise left[0].refusal
            self.store(statement.targets[0], left[0].value)
            return
        targets = self._typed_targets(statement.targets)
        self.refuse_leftovers(left[:1] if is_call(left) else [])
        taken = []
        for target, wanted in targets:
            at = 0
            if wanted:
                at = next((i for i, o in enumerate(left) if type_of(o.value) == wanted), -1)
            if at < 0 or at >= len(left):
                error = phrases.no_result(statement.targets, target, len(targets), wanted)
                if self._silent is not None:
                    phrases.tell_held_word(error, self._silent)
                    phrases.tell_line_begun(error, self._silent)
                raise error
            taken.append(left.pop(at))
            self.store(target, taken[-1].value)
        if left:
            self.refuse_leftovers(left, taken)

    @staticmethod
    def _typed_targets(items: Sequence[tree.Item]) -> list[tuple[tree.Item, str]]:
        targets: list[tuple[tree.Item, str]] = []
        i = 0
        while i < len(items):
            wanted = ""
            if i + 2 < len(items) and isinstance(sign := items[i + 1], tree.Symbol):
                kind = items[i + 2]
                if sign.text == "*" and isinstance(kind, tree.Name | tree.Quoted):
                    targets.append((items[i], kind.text.upper().rstrip()))
                    i += 3
                    continue
            targets.append((items[i], wanted))
            i += 1
        return targets

    def store(self, target: tree.Item, value: Any) -> None:
        """Give a value to a target: name, table access or attribute."""
        if isinstance(target, tree.Name):
            given = self.session.given
            if target.text in given and self.session.frame is self.session.root:
                said = given.pop(target.text)
                value = float(said) if isinstance(value, float) and type(said) is int else said
            self.session.frame.variables[target.text] = value
        elif isinstance(target, tree.Path):
            holder = self.single(target.base)
            for index in target.indices[:-1]:
                holder = self.element(holder, index, target, "no-inner-table")
            if not isinstance(holder, Table | Objet):
                raise self.no_table(holder, target, target.indices[-1])
            put = holder.set if isinstance(holder, Table) else holder.attributes.__setitem__
            put(self.single(target.indices[-1]), value)
        elif isinstance(target, tree.Attribute):
            self.object_of(target).attributes[target.name] = value
        else:
            raise SsiError("target", target.span)

    def known_names(self) -> set[str]:
        """Names that have a value, and those of procedures."""
        return {*self.session.frame.names(), *self.session.library.standard_names}

    def unread(self, statement: tree.Statement, left: Sequence[Operand]) -> SsiError | None:
        """The error for what nothing reads in a statement without names.

        It warns where the statement is one word or one value, which Cast3M drops (`STOP ;`), but
        for a word that is misspelt or that Cast3M has.
        """
        error = leftover_error([o for o in left if not o.result], self.session.assignments)
        alone = len(statement.items) == 1
        if error is not None and alone and error.code in ("excess", "unknown-operator"):
            word = str(left[0].value)
            error.warns = not suggestion(error, self.known_names()) and not find_cast3m_word(word)
        return error

    def refuse_leftovers(self, left: Sequence[Operand], taken: Sequence[Operand] = ()) -> None:
        """Raise the error for operands that nothing read, behind those taken, if there are any."""
        error = leftover_error(left, self.session.assignments, taken)
        if error is not None:
            raise error
