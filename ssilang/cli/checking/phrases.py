"""Reading a phrase with types in place of values, as the evaluator reads it with values."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise, takewhile
from typing import Any

from ssilang.cli.checking.kinds import (
    ANY_WORD,
    SOMETHING,
    UNKNOWN,
    Ambiguous,
    AnyWord,
    Scope,
    kind_word,
    known_model,
    one_of,
    typed,
)
from ssilang.language import registry, vocabulary
from ssilang.language.run.binding import Bound, bind_operator
from ssilang.language.run.call import Call, Operand, Seen, accepts, name_of
from ssilang.language.run.leftovers import is_call, is_operator
from ssilang.language.run.not_built import NotBuilt
from ssilang.language.run.procedures import missing_parameter
from ssilang.language.run.results import Results, annotated, results_of
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Span
from ssilang.language.values import Mot, Procedure
from ssilang.operators.dispatch import WORDS_OF_UNION, joining
from ssilang.operators.numbers.arithmetic import RULES, SIGNS

Report = Callable[[SsiError], None]

_COMPARISONS = frozenset({"EGA", "NEG", ">", "<", ">EG", "<EG"})
_SCALARS = frozenset({"ENTIER", "FLOTTANT"})
_NEVER = frozenset({"LOGIQUE", "MOT", "LISTMOTS", "MAILLAGE"})  # no signs on these


class AbstractCall(Call):
    """A call whose operands may be stand-ins: refuses to guess about unknown ones."""

    def _read(self, types: Sequence[str], after: int) -> Operand | None:
        for operand in self.operands:
            if operand.value is SOMETHING and types == ("PROCEDUR",):
                continue
            if operand.value is UNKNOWN or operand.value is SOMETHING:
                raise Ambiguous
            late = after < 0 or operand.span.start >= after
            if (late and accepts(types, operand.value)) or isinstance(
                operand.value, Mot | Procedure
            ):
                break
        return super()._read(types, after)

    def readable(self, *types: str) -> list[int]:
        self._all_known()
        return super().readable(*types)

    def wordless(self) -> bool:
        return False  # what is unknown may be a word

    def seen(self) -> Seen | None:
        return None  # what stands there is looked at form by form, unknown ones are refused

    def stands(self, *types: str) -> bool:
        self._all_known()
        return super().stands(*types)

    def take_name(self, optional: bool = False) -> str:
        if self.operands and not name_of(self.operands[0]):
            raise Ambiguous
        return super().take_name(optional)

    met: registry.When | None = None  # condition that the session is taken to meet

    def meets(self, when: registry.When) -> bool:
        return when is self.met

    def main_operand(self, *types: str) -> int | None:
        self._all_known()
        return super().main_operand(*types)

    def _all_known(self) -> None:
        if any(o.value is UNKNOWN or o.value is SOMETHING for o in self.operands):
            raise Ambiguous

    def word_index(self) -> int | None:
        for i, operand in enumerate(self.operands):
            if operand.value is UNKNOWN or isinstance(operand.value, AnyWord):
                raise Ambiguous
            if isinstance(operand.value, Mot | Procedure):
                return i
        return None


class PhraseReader:
    """Reads phrases of one script; `report` gets what is certainly wrong."""

    def __init__(self, session: Session, report: Report) -> None:
        self.session = session
        self.report = report

    def read(
        self, items: Sequence[tree.Item], scope: Scope, span: Span, one_name: bool = True
    ) -> list[Operand] | None:
        """What a phrase leaves, None where that cannot be known."""
        if items and isinstance(items[0], tree.Name | tree.Quoted):
            word = items[0].text.upper()[:4]
            if word == "TEXT" and items[0].text.upper() not in scope.values:
                return [Operand(UNKNOWN, span, result=True)]
        items = self.session.library.called(items)
        found: list[Operand] = []
        for item in items:
            found += self._operand(item, scope)
        call = AbstractCall(self.session, found, span)
        try:
            while self._step(call):
                pass
            return self._finish(call, scope, one_name)
        except Ambiguous:
            return None

    # ---- operators -----------------------------------------------------------------------------

    def _step(self, call: AbstractCall) -> bool:
        """Run one operator or procedure; False when the phrase is at its end."""
        procedure = call.read("PROCEDUR")
        if procedure is not None:
            self._procedure(procedure.value, procedure.span, call)
            raise Ambiguous  # its results are not known
        if len(call.operands) > 2 and call.operands[0].value is ANY_WORD and call.operands[0].name:
            word = call.operands[1]  # a word is read as an operator, and comparisons are not
            if isinstance(word.value, Mot) and not word.result and str(word.value) in _COMPARISONS:
                self.session.evaluator.refuse_leftovers(call.operands)
        i = call.word_index()
        if i is None:
            return False
        operand = call.operands[i]
        if operand.result and len(call.operands) == 1:
            return False
        found = registry.find_operator(str(operand.value).rstrip())
        if found is None:
            return False
        del call.operands[i]
        call.span, call.name, call.used = operand.span, found.full_name, []
        self._operate(found, operand, call)
        return not found.terminal

    def _operate(self, found: registry.Operator, operand: Operand, call: AbstractCall) -> None:
        if found.name in SIGNS.split() or found.name in _COMPARISONS:
            self._sign(found.name, operand, call)
            return
        if found.name == "ET" and self._joined(call):
            return
        if found.name in _GUESSED:
            _GUESSED[found.name](self, call)
        bound = self._bound(found, call)
        results = results_of(bound.form, bound.values)
        if bound.form.by_hand:
            self._free(results, operand, call, frozenset(registry.keywords_of(found)))
            return
        self._push(results, operand.span, call)
        foresee = _FORESEEN.get(found.name)
        if foresee is not None:
            foresee(self, bound.values, call)

    def _model(self, values: Mapping[str, Any], call: AbstractCall) -> None:
        """The words of MODE go on to MATE: they say the law."""
        from ssilang.operators.models.foreseen import refuse_words

        words = tuple(str(word) for word in values.get("said", ()))  # not every form has them
        if ANY_WORD not in words:
            self.trial(call, lambda: refuse_words(call, words))
        if "mesh" in values:  # not of contacts
            call.operands[0].value = known_model(words)

    def _word(self, values: Mapping[str, Any], call: AbstractCall) -> None:
        """MOT gives the word itself."""
        call.operands[0].value = values["text"]

    def _material(self, values: Mapping[str, Any], call: AbstractCall) -> None:
        """Let the law of the model look at the numbers of MATE, as a run does."""
        from ssilang.operators.models.foreseen import foreseen_zone, refuse_constants

        words = getattr(values["model"], "words", None)
        zone = None if words is None else foreseen_zone(call, words)
        if zone is None:
            return
        pairs = [(str(name), value) for name, value in values["pairs"]]
        self.trial(call, lambda: refuse_constants(call, zone, pairs))

    def trial(self, call: AbstractCall, action: Callable[[], None]) -> None:
        """Report what a part of an operator refuses and warns of, as a run does."""
        before = len(self.session.warnings)
        try:
            self.session.evaluator.guarded(action, call.span, call.name)
        except SsiError as error:
            self.report(error)
        for warning in self.session.warnings[before:]:
            self.report(warning)
        del self.session.warnings[before:]

    @staticmethod
    def _bound(found: registry.Operator, call: AbstractCall) -> Bound:
        """The form meant. What the session meets is not known: all that fits must do the same."""
        whens = tuple({id(f.when): f.when for f in found.forms if f.when is not None}.values())
        start, problem = list(call.operands), None
        outcomes: list[tuple[Results | None, list[Operand], Bound]] = []
        for call.met in whens or (None,):
            call.operands[:], call.used = start, []
            try:
                bound = bind_operator(found, call)
            except SsiError as error:
                problem = error if problem is None or problem.code == "form-condition" else problem
                continue
            outcomes.append((results_of(bound.form, bound.values), list(call.operands), bound))
        if problem is not None and not outcomes:
            raise problem
        results, left, bound = outcomes[0]
        if any(r != results or [*map(id, o)] != [*map(id, left)] for r, o, _ in outcomes):
            raise Ambiguous
        call.operands[:] = left
        return bound

    def _free(
        self, results: Results | None, operand: Operand, call: AbstractCall, own: frozenset[str]
    ) -> None:
        """An operator that reads for itself, with words of its own: known if no other follows."""
        for other in call.operands:
            if other.value is UNKNOWN or isinstance(other.value, Procedure | AnyWord):
                raise Ambiguous
            ours = isinstance(other.value, Mot) and str(other.value).upper()[:4] in own
            if (
                isinstance(other.value, Mot)
                and not ours
                and registry.find_operator(str(other.value))
            ):
                raise Ambiguous
        if not results:
            raise Ambiguous  # what it leaves unread is not known
        call.operands.clear()
        self._push(results, operand.span, call)

    @staticmethod
    def _push(results: Results | None, span: Span, call: AbstractCall) -> None:
        """Put stand-ins for the results in front; () where there are none."""
        if results is None:
            call.operands.insert(0, Operand(SOMETHING, span, result=True))
            return
        made = [Operand(one_of(word), span, result=True) for word in results]
        call.operands[:0] = made

    def _sign(self, sign: str, word: Operand, call: AbstractCall) -> None:
        pair = [o for o in call.operands[:2] if not isinstance(o.value, Mot | Procedure)]
        if len(pair) < 2:
            if any(isinstance(o.value, Mot | Procedure) for o in call.operands):
                raise Ambiguous
            raise SsiError("two-operands", word.span, operator=sign)
        left, right = pair
        kinds = kind_word(left.value), kind_word(right.value)
        if "" in kinds:
            raise Ambiguous
        behind = kind_word(call.operands[2].value) if len(call.operands) > 2 else ""
        told = sign in ("EGA", "NEG") and behind in _SCALARS
        del call.operands[: 2 + told]  # with a tolerance
        span = left.span.to(right.span)
        if sign in _COMPARISONS:
            call.operands.insert(0, Operand(typed("LOGIQUE"), span, result=True))
            return
        if (sign, *kinds) not in RULES:
            if _NEVER.isdisjoint(kinds):
                raise Ambiguous  # the operator may have a way of its own for them
            raise SsiError("no-rule", span, operator=sign, left=kinds[0], right=kinds[1])
        call.operands.insert(
            0, Operand(self._value(sign, left.value, right.value, span), span, result=True)
        )

    def _joined(self, call: AbstractCall) -> bool:
        """Whether the types of two objects tell what ET makes of them, which then stands there."""
        pair, behind = call.operands[:2], call.operands[2:]
        kinds = [kind_word(o.value) for o in pair]
        words = {str(o.value).upper()[:4] for o in call.operands if isinstance(o.value, Mot)}
        if len(pair) < 2 or {"", "LOGIQUE"} & {*kinds} or words & {*WORDS_OF_UNION}:
            return False
        rule = joining(kinds[0], kinds[1])
        if rule is None:
            self.session.evaluator.refuse_leftovers(
                [o for o in pair if isinstance(o.value, Mot) and not o.name and not o.result]
            )
            return False
        if any(isinstance(o.value, Mot | Procedure) for o in (*pair, *behind)):
            return False
        results = annotated(rule)
        if results is None:
            return False
        call.operands[:] = behind
        self._push(results, pair[0].span.to(pair[1].span), call)
        return True

    def _value(self, sign: str, a: Any, b: Any, span: Span) -> Any:
        """Value of a sign on two operands, as far as it is known."""
        if type(a) in (int, float) and type(b) in (int, float):
            try:
                value = registry.SCALAR_RULES[sign](a, b)
            except (ArithmeticError, ValueError, TypeError):
                return UNKNOWN
            if sign == "/" and type(value) is int and b and a % b:
                self.report(
                    SsiError("integer-division", span, left=a, right=b, value=value, exact=a / b)
                )
            return value
        kinds = {kind_word(a), kind_word(b)}
        if kinds <= _SCALARS:
            return typed("ENTIER" if kinds == {"ENTIER"} else "FLOTTANT")
        return typed(kinds.pop()) if len(kinds) == 1 else UNKNOWN

    # ---- procedures ----------------------------------------------------------------------------

    def _procedure(self, procedure: Procedure, span: Span, call: AbstractCall) -> None:
        call.name, call.used, call.span = procedure.name, [], span
        for p in procedure.definition.parameters:
            if p.subtype:
                raise Ambiguous
            if call.read(p.type or "*") is None and not p.optional:
                raise missing_parameter(procedure, p, call, kind_word)

    # ---- end of a phrase -----------------------------------------------------------------------

    def _finish(self, call: AbstractCall, scope: Scope, one_name: bool) -> list[Operand]:
        left = call.operands
        if any(o.value in (SOMETHING, UNKNOWN) for o in left):
            if one_name:
                self.session.evaluator.refuse_leftovers(
                    [o for o in left if isinstance(o.value, Mot) and not o.name and not o.result]
                )
            if len(left) > 1:
                raise Ambiguous
        numbers = [o for o in left if kind_word(o.value) in _SCALARS]
        if one_name and len(numbers) == len(left) and len(numbers) in (2, 3):
            span = numbers[0].span.to(numbers[-1].span)
            if scope.dimension is None:
                return [Operand(UNKNOWN, span, result=True)]
            if len(numbers) < scope.dimension:
                raise SsiError("third-coordinate", span)
            if len(numbers) == scope.dimension:
                return [Operand(typed("POINT"), span, result=True)]
        return left

    # ---- operands ------------------------------------------------------------------------------

    def _operand(self, item: tree.Item, scope: Scope) -> list[Operand]:
        if isinstance(item, tree.Number):
            return [Operand(item.value, item.span)]
        if isinstance(item, tree.Quoted | tree.Symbol):
            return [Operand(Mot(item.text), item.span)]
        if isinstance(item, tree.Name):
            return [self._name(item, scope)]
        if isinstance(item, tree.Paren):
            return self._paren(item, scope)
        if isinstance(item, tree.Path):
            return self._path(item, scope)
        if item.base is not None:
            self._operand(item.base, scope)
        return [Operand(UNKNOWN, item.span)]

    def _name(self, item: tree.Name, scope: Scope) -> Operand:
        value = scope.values.get(item.text)
        if type(value) is NotBuilt:
            self.report(value.refusal(item.span))
            value = UNKNOWN
        if value is not None:
            return Operand(value, item.span, item.text)
        procedure = self.session.library.find(item.text)
        if procedure is not None:
            return Operand(procedure, item.span, item.text)
        if scope.open and registry.find_operator(item.text) is None:
            return Operand(UNKNOWN, item.span, item.text)
        return Operand(Mot(item.word), item.span)

    def _paren(self, item: tree.Paren, scope: Scope) -> list[Operand]:
        if not item.items:
            return []
        try:
            left = self.read(item.items, scope, item.span)
            if left is not None:
                if is_call(left):
                    self.session.evaluator.refuse_leftovers(left)
                if len(left) > 1:
                    self.session.evaluator.refuse_leftovers(
                        [o for o in left[1:] if not o.result] or left[1:], left[:1]
                    )
        except SsiError as error:
            self.report(error)
            left = None
        if left is None:
            return [Operand(UNKNOWN, item.span)]
        # a word in parentheses is a value, and no operator to be
        return [
            Operand(
                ANY_WORD if o.result and isinstance(o.value, Mot) else o.value, item.span, o.name
            )
            for o in left[:1]
        ]

    def _path(self, item: tree.Path, scope: Scope) -> list[Operand]:
        base = item.base
        if isinstance(base, tree.Name) and not scope.open:
            value = self._name(base, scope).value
            known = kind_word(value)
            if known and known not in ("TABLE", "OBJET") and value is not ANY_WORD:
                if isinstance(value, Mot) and base.text not in scope.values:
                    raise SsiError("undefined-table", base.span, name=base.text)
                refused = SsiError("not-a-table", base.span, found=known, name=base.span.text)
                behind = self._operand(item.indices[0], scope)
                if known not in ("ENTIER", "FLOTTANT") or any(
                    isinstance(o.value, Mot) and not is_operator(item.indices[0], o.value)
                    for o in behind
                ):
                    raise refused
                self.report(SsiError("dot-of-number", base.span, **refused.data))
                if len(item.indices) == 1:
                    behind = [replace(o, refusal=refused) for o in behind]
                    return [Operand(value, base.span, base.text), *behind]
        elif not isinstance(base, tree.Name):
            self._operand(base, scope)
        for index in item.indices:
            if isinstance(index, tree.Paren):
                self._paren(index, scope)
        return [Operand(UNKNOWN, item.span)]


def _only_unknown_is_mesh(reader: PhraseReader, call: AbstractCall) -> None:
    """MODE cannot do without a mesh: where none is known, the one unknown operand is it.

    Where others are unknown, the words that stand before any keyword say the law nevertheless.
    """
    from ssilang.operators.models.foreseen import refuse_words

    unknown = [o for o in call.operands if o.value is UNKNOWN]
    meshes = [o for o in call.operands if kind_word(o.value) in ("MAILLAGE", "POINT")]
    if len(unknown) == 1 and not meshes:
        unknown[0].value = typed("MAILLAGE")
    elif unknown:
        keys = _keywords("MODE")
        first = unknown[0] if meshes else unknown[1]  # without a known mesh one of them is it
        own = call.operands[: call.operands.index(first)]
        call.used = [o for o in own if isinstance(o.value, Mot)]
        words = takewhile(
            lambda w: w is not ANY_WORD and str(w)[:4] not in keys, (o.value for o in call.used)
        )
        reader.trial(call, lambda: refuse_words(call, map(str, words)))


def _keywords(operator: str) -> set[str]:
    return {word[:4].rstrip() for word in registry.keywords_of(registry.OPERATORS[operator])}


def _unknown_is_value(reader: PhraseReader, call: AbstractCall) -> None:
    """What stands behind a word of MATE that is neither keyword nor operator is a value."""
    keywords = _keywords("MATE")
    for name, operand in pairwise(call.operands):
        if operand.value is not UNKNOWN or not isinstance(name.value, Mot) or name.result:
            continue
        word = str(name.value).upper().rstrip()
        own = word in vocabulary.names("parameter") or registry.find_operator(word) is None
        if own and name.value is not ANY_WORD and word[:4] not in keywords:
            operand.value = typed("FLOTTANT")


_GUESSED = {"MODE": _only_unknown_is_mesh, "MATE": _unknown_is_value}
"""What unknown operands of an operator can only be."""

_FORESEEN: Mapping[str, Callable[[PhraseReader, Mapping[str, Any], AbstractCall], None]] = {
    "MODE": PhraseReader._model,
    "MATE": PhraseReader._material,
    "MOT": PhraseReader._word,
}
"""Operators of whose results, or values, more is known before a run than types."""
