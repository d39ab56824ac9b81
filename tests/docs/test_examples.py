"""Every example of the help of every operator and procedure runs, prints what is known
beforehand (`test_examples.toml`), and they try all that is built.

`docs/partly.txt` says of an operator what it lacks; behind "without an example:" stand the forms,
by their number, and the words of a choice that no example of it runs. What is not said there is
built, and what is said there is so.
"""

import re
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest
import script_runs
from forms_ran import FormsRan
from together import together

from ssilang.cli.check import typed_source
from ssilang.cli.run import RunOptions, run_text
from ssilang.language.registry import OPERATORS
from ssilang.language.run import phrases
from ssilang.language.run.binding import run_operator
from ssilang.language.run.call import Call, Operand
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.errors import SsiError
from ssilang.language.say.reference import operator_page, procedure_page
from ssilang.language.text.source import Source
from ssilang.language.values import ANNULE, MAY_BE_EMPTY, Mot, is_empty, type_of
from ssilang.operators.loader import load_operators
from ssilang.operators.session.empty_objects import _MAKERS
from ssilang.operators.workspace import workspace

load_operators()
_OPERATORS = [o for n, o in sorted(OPERATORS.items()) if n == o.name]
_PROCEDURES = {p: procedure_page(p) for p in standard_procedures().values()}
_PRINTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def untried(build):
    """What `docs/partly.txt` says is without an example, by operator."""
    return {name: build.untried(text) for name, text in build.partly_built().items()}


def _examples(operator):
    """Its own, or those of the procedures that are written around it."""
    own = operator_page(operator).help.examples
    if own:
        return own
    name = re.compile(rf"\b{re.escape(operator.name)}\b")
    around = [p for p in _PROCEDURES if name.search(p.read_text(encoding="utf-8"))]
    return tuple(e for p in around for e in _PROCEDURES[p].help.examples)


class Emptied:
    """Calls an operator, before each call of its, with every operand in turn that holds nothing."""

    def __init__(self, operator):
        self.operator, self.tried, self.silent, self.busy = operator, set(), [], False

    def __call__(self, found, call):
        inner = call.session.frame.procedure in call.session.library.standard_names
        if found is self.operator and not inner and not self.busy:
            kinds = [type_of(o.value) for o in call.operands]
            words = tuple(str(o.value)[:4] for o in call.operands if isinstance(o.value, str))
            for place, kind in enumerate(kinds):
                if kind in MAY_BE_EMPTY and (*kinds, place, words) not in self.tried:
                    self.tried.add((*kinds, place, words))
                    self.one(found, call, place, kind)
        return run_operator(found, call)

    def one(self, found, call, place, kind):
        nothing = _MAKERS[kind](workspace(call.session), "")
        operands = [
            replace(o, value=nothing if n == place else o.value)
            for n, o in enumerate(call.operands)
        ]
        before, self.busy = len(call.session.warnings), True
        try:
            call.session.evaluator._operate(
                found, Operand(Mot(found.name), call.span), Call(call.session, operands, call.span)
            )
            told = [w.code for w in call.session.warnings[before:]]
            told += ["excess"] * any(o.value is nothing for o in operands)
        except SsiError as error:
            told = [error.code]
        self.busy = False
        del call.session.warnings[before:]
        if "internal" in told or (not (told or found.empties) and is_empty(nothing)):
            self.silent.append((found.name, place, [type_of(o.value) for o in call.operands]))


def assert_same(name, number, output):
    """An example prints what is known."""
    known = _PRINTED.get(name, [])
    if number <= len(known) and known[number - 1]:
        script_runs.assert_says(output, known[number - 1])


def _checked(text, result):
    """The check finds nothing wrong, and the types that it foresees are those of the run."""
    problems, _, types = typed_source(Source("example", text))
    assert [p.code for p in problems if p.severity == "error"] == []
    if re.search(r"\b(REST|LIRE \w+) ;", text):
        return  # names that a file brings
    seen = {}
    for place, word in sorted(types.items()):  # what is said last holds; '' of many types
        seen[re.match(r"[\w@!]+", text[place:])[0].upper()[:24]] = word
    values = {name: result.session.root.find(name) for name in seen}
    there = {n: type_of(v) for n, v in values.items() if v is not None and v is not ANNULE}
    assert {name: seen[name] or there[name] for name in there} == there


@together("operator", _OPERATORS, by=lambda o: o.family)
def test_examples_run_and_try_every_form_that_is_built(operator, untried, tmp_path):
    ran = FormsRan()
    for number, text in enumerate(_examples(operator), 1):
        options = RunOptions(output_directory=tmp_path / str(number), on_form=ran)
        result = run_text(text, options=options)
        assert result.exit_code == 0, result.message
        assert_same(operator.name, number, result.output)
        _checked(text, result)
    assert ran.missing(operator) == untried.get(operator.name, [])


@pytest.mark.usefixtures("unsaved")
@together("operator", [o for o in _OPERATORS if not o.empties], by=lambda o: o.family)
def test_objects_that_hold_nothing_are_told(operator, tmp_path, monkeypatch):
    """Each call of the examples is tried with nothing in place of each of its objects."""
    emptied = Emptied(operator)
    monkeypatch.setattr(phrases, "run_operator", emptied)
    for number, text in enumerate(operator_page(operator).help.examples, 1):
        run_text(text, output_directory=tmp_path / str(number))
    assert not emptied.silent


@pytest.mark.usefixtures("unsaved")
@together("path", _PROCEDURES, by=lambda path: path.stem.strip("@")[:1])
def test_examples_of_procedures_run(path, tmp_path):
    for number, text in enumerate(_PROCEDURES[path].help.examples, 1):
        result = run_text(text, output_directory=tmp_path / str(number))
        assert result.exit_code == 0, result.message
        assert_same(path.stem.upper(), number, result.output)
