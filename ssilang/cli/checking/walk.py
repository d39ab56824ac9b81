"""Walks a script, statement after statement, and collects what is certainly wrong or doubtful."""

import re
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from ssilang.cli.checking.kinds import SOMETHING, UNKNOWN, Scope, assigned_names, kind_word, typed
from ssilang.cli.checking.phrases import PhraseReader
from ssilang.cli.checking.sound import SoundStatements, Values
from ssilang.cli.checking.tables import doubtful_entries
from ssilang.cli.checking.usage import (
    bare_names,
    crossed_words,
    left_to_right,
    misspelt_names,
    stale_names,
    statements_of,
    unused_names,
)
from ssilang.cli.checking.words import misspelt_words
from ssilang.io.plots.palette import COLOURS
from ssilang.language import vocabulary
from ssilang.language.cast3m import cast3m_words
from ssilang.language.registry import OPERATORS, find_operator, keywords_of
from ssilang.language.run.leftovers import is_call
from ssilang.language.run.not_built import put_off
from ssilang.language.run.operands import Operand
from ssilang.language.run.phrases import name_as_word, no_result, unended
from ssilang.language.run.results import results_of
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Span
from ssilang.language.values import Mot, Procedure, known_types
from ssilang.messages.message import Sentence

# statements that may bring names the text does not show
_OPENING = frozenset({"REST", "LIRE", "NOMM", "SAIS", "MENU"})
_DIMENSION = re.compile(r"^[^*].*\bOPTI\w*'?\s[^;]*\bDIME'?\s+\d", re.IGNORECASE | re.MULTILINE)
_NAMING = frozenset({"ARGU", "ACQU", "OBTE"})  # they give values to the names that they show


class Checker:
    """Checks one script against the operators and procedures of a session.

    Parameters
    ----------
    sound : SoundStatements, optional
        What an earlier check of nearly the same text found, which is brought up to date.
    """

    def __init__(self, session: Session, sound: SoundStatements | None = None) -> None:
        self.session = session
        self.sound = sound if sound is not None else SoundStatements()
        self.sound.begin(session)
        self.problems: dict[tuple[str, int], SsiError] = {}  # the first of a code and place
        self.types: dict[int, str] = {}  # of what names are given, by where the name stands
        self.entries: dict[int, Any] = {}  # what entries of tables are given, in the same way
        self.phrases = PhraseReader(session, self._report)
        self._told = 0  # problems, those that were there already among them
        self._doubt = self._dead = False  # whether runs may leave out what is read, or all do
        self._excused = False  # whether a problem is one where a run takes a branch, if at all
        self._procedures: list[tree.Definition] = []
        self._names: set[str] = set()
        self._loops: set[str] = set()
        self._visit: dict[type, Callable[[Any, Scope], None]] = {
            tree.Statement: self._statement,
            tree.If: self._if,
            tree.Loop: self._loop,
            tree.Definition: self._definition,
        }

    def check(self, script: tree.Script) -> list[SsiError]:
        """Errors and warnings, in the order of the text."""
        script = tree.Script(_until_fin(script.body), script.span)
        self._names = assigned_names(script.body)
        self._loops = {name.lstrip("&") for name in self._names if name[0] == "&"}
        self.session.assignments = tree.first_assignments(script.body)
        library = all(isinstance(n, tree.Definition) for n in script.body)
        scope = Scope(dict(self.session.root.variables))
        self._walk(script.body, scope)
        for definition in self._procedures:
            self._body(definition, scope, library)
        entries = doubtful_entries(script, self.session, self.entries)
        for problem in (
            *unused_names(script),
            *stale_names(script),
            *entries,
            *left_to_right(script),
            *crossed_words(script, plane=scope.dimension == 2),
        ):
            self._report(problem)
        names = frozenset({*self._names, *scope.values, *self.session.library.standard_names})
        perhaps = (*misspelt_names(script, names, _known_words()), *misspelt_words(script, names))
        told = {e.span.start for e in self.problems.values() if e.span is not None}
        for problem in perhaps:
            if problem.span is not None and problem.span.start not in told:
                told.add(problem.span.start)
                self._report(problem)
        return sorted(self.problems.values(), key=lambda e: e.span.start if e.span else 0)

    def _report(self, problem: SsiError) -> None:
        self._told += 1
        if self._excused and problem.severity == "error":
            problem.warns = True
            problem.data["in_branch"] = Sentence("in-branch")
        place = -self._told if problem.span is None else problem.span.start
        if problem.code == "unknown-operator":  # what is read after all
            self.problems.pop(("not-built-yet", place), None)
        self.problems.setdefault((problem.code, place), problem)

    def _walk(self, nodes: Iterable[tree.Node], scope: Scope) -> None:
        for node in nodes:
            lost = self._of_other_branches(node, scope) if self._doubt else ()
            self._excused = self._dead or bool(lost)
            try:
                self._visit[type(node)](node, scope)
            except SsiError as error:
                self._report(error)
            scope.forget(lost)  # each is told once
            self._excused = False

    def _of_other_branches(self, node: tree.Node, scope: Scope) -> Iterable[str]:
        """Names that a node reads to which the script gives a value, on no way that leads here."""
        head = next(statements_of([node]))
        paths = [t for t in head.targets if isinstance(t, tree.Path)]
        read = {name.text for name in bare_names((*paths, *head.items))}
        return set() if scope.open else (read & self._names) - scope.values.keys()

    def _branch(self, nodes: Iterable[tree.Node], scope: Scope, taken: bool | None) -> None:
        """One branch of a SI: all runs take it, none does, or nobody knows (None)."""
        before = self._doubt, self._dead
        self._doubt, self._dead = self._doubt or not taken, self._dead or taken is False
        self._walk(nodes, scope)
        self._doubt, self._dead = before

    # ---- blocks --------------------------------------------------------------------------------

    def _if(self, node: tree.If, scope: Scope) -> None:
        try:
            self._condition(node, scope)
        except SsiError as error:
            self._report(error)
        # a branch is taken where what it asks holds: there, numbers from before may be others
        names = [n.text for n in bare_names(node.condition.items)]
        asked = {n: v for n in names if isinstance(v := scope.values.get(n), int | float)}
        scope.values.update({n: typed(kind_word(v)) for n, v in asked.items()})
        other = scope.copy()
        holds = {"VRAI": True, "FAUX": False}.get(" ".join(names))
        self._branch(node.then, scope, holds)
        self._branch(node.otherwise, other, None if holds is None else not holds)
        scope.join(other)
        scope.values.update({n: asked[n] for n in asked.keys() - assigned_names([node])})

    def _condition(self, node: tree.If, scope: Scope) -> None:
        left = self.phrases.read(node.condition.items, scope, node.condition.span)
        if left is None or any(o.value in (UNKNOWN, SOMETHING) for o in left):
            return
        if is_call(left):
            self.session.evaluator.refuse_leftovers(left)
        if len(left) != 1 or kind_word(left[0].value) != "LOGIQUE":
            found = kind_word(left[0].value) if left else "nothing"
            span = left[0].span if left else node.condition.span
            if left and isinstance(left[0].value, Mot) and not left[0].name:
                error = name_as_word("condition", left, scope.values.get(str(left[0].value)))
                if error is not None:
                    raise error
                self.session.evaluator.refuse_leftovers(left)
            raise SsiError("condition", span, found=found)

    def _loop(self, node: tree.Loop, scope: Scope) -> None:
        if node.count:
            left = self.phrases.read(node.count, scope, node.span)
            kind = kind_word(left[0].value) if left and len(left) == 1 else ""
            if kind not in ("", "ENTIER", "FLOTTANT", "TEXTE"):
                self._report(self._no_count(left or [], scope, kind))
        before = scope.copy()
        scope.forget(assigned_names(node.body))
        scope.values[("&" + node.name)[:24]] = typed("ENTIER")
        outer = scope.inside
        scope.inside = (*outer, node.name)
        if _opens(node.body):
            scope.open = True
        self._walk(node.body, scope)
        scope.inside = outer
        counter = scope.values[("&" + node.name)[:24]]
        scope.join(before)
        scope.values[("&" + node.name)[:24]] = counter

    def _no_count(self, left: list[Operand], scope: Scope, kind: str) -> SsiError:
        if not isinstance(left[0].value, Mot):
            return SsiError("loop-count", left[0].span, found=kind)
        name = str(left[0].value)
        error = name_as_word("loop-count", left, scope.values.get(name))
        return error or SsiError("undefined-name", left[0].span, name=name, operator="REPE")

    def _definition(self, node: tree.Definition, scope: Scope) -> None:
        self._procedures.append(node)
        self._shadow(node.name, node.span, defined=True)
        library, here = self.session.library, node.span.source.path
        theirs = library.standard_files.get(node.name)
        itself = here is not None and theirs is not None and here.resolve() == theirs.resolve()
        if library.is_own(node.name) and not itself:
            self._report(SsiError("overrides-procedure", _head(node.span), name=node.name))
        scope.values[node.name] = Procedure(node.name, node)

    def _body(self, node: tree.Definition, outer: Scope, library: bool) -> None:
        scope = outer.copy()
        scope.forget(self._names)
        for name, value in outer.values.items():
            if isinstance(value, Procedure):
                scope.values[name] = value
        scope.open = outer.open or library
        scope.dimension = None
        scope.inside = (node.name, *self._loops)  # it may be called inside of any of them
        scope.values.setdefault("WTAB", UNKNOWN)  # of PASAPAS or CONTINU, which may call it
        for p in node.parameters:
            known = not p.optional and p.type and p.type not in ("MOT", "FLOTTANT")
            scope.values[p.name] = typed(p.type) if known else UNKNOWN
        self._walk(node.body, scope)

    # ---- statements ----------------------------------------------------------------------------

    def _statement(self, statement: tree.Statement, scope: Scope) -> None:
        word = statement.first_word[:4].rstrip()
        if word in ("QUIT", "ITER") and statement.first_word not in scope.values:
            self._jump(statement, scope)
            return
        if not statement.assigns:
            self._effects(statement, word, scope)
        values = self._values(statement, scope)
        names, library = (name.text for name in bare_names(statement.items)), self.session.library
        for name in names if scope.dimension is not None else ():
            called = scope.values[name] if name in scope.values else library.find(name)
            if isinstance(called, Procedure) and _DIMENSION.search(called.definition.span.text):
                scope.dimension = None
        for i, target in enumerate(statement.targets):
            if isinstance(target, tree.Name):
                known = values is not None and i < len(values)
                scope.values[target.text] = values[i] if known and values else UNKNOWN
                self.types[target.span.start] = kind_word(scope.values[target.text])
            elif values is not None and i < len(values):
                self.entries[target.span.start] = values[i]

    def _values(self, statement: tree.Statement, scope: Scope) -> Values:
        """Values that the names of a statement get, None when unknown; reports what is wrong."""
        try:
            key = self.sound.key(statement, scope, self.session.library)
        except SsiError as error:
            self._report(error)
            return None
        found = self.sound.find(key)
        if found is not None:
            return found[0]
        told = self._told
        values = self._read(statement, scope)
        if self._told == told:
            self.sound.keep(key, values)
        return values

    def _read(self, statement: tree.Statement, scope: Scope) -> Values:
        several = unended(statement.targets) is not None
        for item in statement.targets:
            if isinstance(item, tree.Name) and not several:
                self._shadow(item.text, item.span)
            elif isinstance(item, tree.Path):
                self.phrases._path(item, scope)
        one = len(statement.targets) <= 1
        try:
            left = self.phrases.read(statement.items, scope, statement.span, one_name=one)
            return self._outcome(statement, left)
        except SsiError as error:
            known = {*self._names, *scope.values, *self.session.library.standard_names}
            if later := put_off(statement, error, known):
                self._report(SsiError("not-built-yet", error.span, **error.data))
                return [later] * len(statement.targets)
            word = self.session.evaluator.word_of_entry(statement, error)
            if word is None:
                self._report(error)
            return None

    def _jump(self, statement: tree.Statement, scope: Scope) -> None:
        item = statement.items[1] if len(statement.items) == 2 else None
        if not isinstance(item, tree.Name | tree.Quoted) or item.text.upper() in scope.values:
            return
        if item.text.upper() not in scope.inside:
            raise SsiError("no-such-loop", item.span, name=item.text.upper())

    def _effects(self, statement: tree.Statement, word: str, scope: Scope) -> None:
        """What directives change besides giving values to names."""
        words = [
            i.text.upper()[:4] if isinstance(i, tree.Name | tree.Quoted) else ""
            for i in statement.items
        ]
        if len(words) == 1 and scope.values.get(statement.first_word) is UNKNOWN:
            scope.open = True  # a TEXTE runs, which may give names to results
        behind = statement.items[words.index("DONN") + 1 :] if "DONN" in words else ()
        read = word == "OPTI" and behind and not isinstance(behind[0], tree.Number)  # a file
        if word in _OPENING or read:
            scope.open = True
            scope.dimension = None
            named = [i.text for i in statement.items[1:] if isinstance(i, tree.Name)]
            # without names all that was saved comes back, under any name
            scope.forget(named if named or word != "REST" else tuple(scope.values))
        if word in _NAMING:
            scope.forget(i.text for i in statement.items[1:] if isinstance(i, tree.Name))
        if word == "OPTI" and "DIME" in words:
            at = words.index("DIME") + 1
            item = statement.items[at] if at < len(words) else None
            known = isinstance(item, tree.Number) and isinstance(item.value, int)
            scope.dimension = int(item.value) if known and isinstance(item, tree.Number) else None
        if word == "OUBL":
            for item in statement.items[1:2]:
                if isinstance(item, tree.Name) and len(statement.items) == 2:
                    scope.values.pop(item.text, None)

    def _shadow(self, name: str, span: Any, defined: bool = False) -> None:
        found = find_operator(name)
        # a value in the place of what gives none was meant for it (DENS = 0.1); a call of another
        # operator that a name hides is an error of its own
        taken = found and (defined or all(results_of(form) == () for form in found.forms))
        if taken and found and name == found.name:  # a longer form is hardly written
            self._report(SsiError("shadowed-operator", _head(span), name=name))

    def _outcome(self, statement: tree.Statement, left: Any) -> Values:
        """Values that the names of a statement get, None when unknown; reports leftovers."""
        if left is None or any(o.value is UNKNOWN for o in left):
            return None
        evaluator = self.session.evaluator
        if not statement.assigns:
            if error := evaluator.unread(statement, left):
                raise error
            return []
        if any(isinstance(i, tree.Symbol | tree.Quoted) for i in statement.targets):
            return None
        if left and is_call(left):
            evaluator.refuse_leftovers(left[:1])
        count = len(statement.targets)
        if count > 1 and any(o.value is SOMETHING for o in left):
            return None
        if len(left) < count:
            target = statement.targets[len(left)]
            raise no_result(statement.targets, target, count)
        evaluator.refuse_leftovers(left[count:], left[:count])
        return [o.value for o in left]


@cache
def _known_words() -> frozenset[str]:
    """First four letters of operators, procedures of Cast3M, keywords, parameters, colours ..."""
    words = {w[:4] for o in OPERATORS.values() for w in keywords_of(o)}
    words |= {w[:4] for kind in vocabulary.KINDS for w in vocabulary.names(kind)} | {*COLOURS}
    return frozenset({*words, *OPERATORS, *(n[:4] for n in cast3m_words()), *known_types()})


def _until_fin(nodes: tuple[tree.Node, ...]) -> tuple[tree.Node, ...]:
    """The nodes up to the first FIN that ends the run."""
    for i, node in enumerate(nodes):
        if isinstance(node, tree.Statement) and len(node.items) == 1 and node.first_word == "FIN":
            return nodes[:i]
    return nodes


def _head(span: Any) -> Any:
    """The first line of a span."""
    end = span.start + len(span.text.split("\n")[0].split(";")[0].rstrip())
    return Span(span.source, span.start, min(span.end, end))


def _opens(nodes: Iterable[tree.Node]) -> bool:
    """Whether nodes contain a statement that brings names the text does not show."""
    every = statements_of(nodes)
    return any(not s.assigns and s.first_word[:4] in _OPENING for s in every)
