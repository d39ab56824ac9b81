"""Operands of a phrase and how operators read them.

A phrase keeps its unread operands in order. Reading by type walks them from the front, steps
over operands of other types and never passes an unread word; results are put back in front.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from ssilang.language.cast3m import cast3m_words
from ssilang.language.registry import ANY, Argument, When
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Span
from ssilang.language.values import Mot, Procedure, Texte, is_of_noughts, like_radians, type_of
from ssilang.language.vocabulary.terms import ANY_NUMBER, UNSAID
from ssilang.language.vocabulary.unit_systems import usual_of


@dataclass(slots=True)
class Operand:
    """A value waiting to be read, and where it stands in the source."""

    value: Any
    span: Span
    name: str = ""  # the variable it was read from
    result: bool = False  # came out of an operator
    refusal: SsiError | None = None  # what is wrong if nothing reads it


def name_of(operand: Operand) -> str:
    """The name that an operand was written as: a variable, a word, a procedure."""
    if operand.name:
        return operand.name
    if isinstance(operand.value, Procedure):
        return operand.value.name
    return str(operand.value).rstrip().upper() if isinstance(operand.value, Mot) else ""


def accepts(types: Sequence[str], value: object) -> bool:
    """Whether a value may be read as one of the types."""
    if ANY in types:
        return True
    found = type_of(value)
    return found in types or _is_wide(types, found)


def _is_wide(types: Sequence[str], kind: str) -> bool:
    """Whether a value of a type may be read as another: ENTIER as FLOTTANT, PROCEDUR as MOT."""
    return (kind == "ENTIER" and "FLOTTANT" in types) or (kind == "PROCEDUR" and "MOT" in types)


def _as_read(operand: Operand, types: Sequence[str]) -> Operand:
    """The operand in the type asked for: ENTIER to FLOTTANT, PROCEDUR to its name."""
    value = operand.value
    if ANY in types:
        return operand
    if type(value) is int and "ENTIER" not in types:
        return Operand(float(value), operand.span, operand.name)
    if isinstance(value, Procedure) and "PROCEDUR" not in types:
        return Operand(Mot(value.name), operand.span, operand.name)
    return operand


@cache
def shortened(words: tuple[str, ...], length: int) -> dict[str, str]:
    """Words by the characters that are compared; of two alike the first."""
    return {word[:length].rstrip(): word for word in reversed(words)}


Seen = tuple[tuple[type, ...], tuple[str, ...]]
"""Classes of operands, and the words among them."""

_A_WORD = Mot("")
_NAMED = (Mot, Procedure)  # what may be the name of an operator, a keyword or a procedure
_NAMED_OR_TEXT = (Mot, Procedure, Texte)
_BESIDE_WORDS = ("MOT", "LISTENTI")  # types that may also stand beside the main operand
_ODD = {"not-increasing": "out-of-order", "of-noughts": "of-noughts"}
_MANY = 16  # operands from which what stands there is not looked up
_MAX_EXPANSIONS = 10_000  # TEXTE objects put into one phrase


class Call:
    """The unread operands of a phrase, with the operator that reads them.

    Parameters
    ----------
    operands : list of Operand
        Unread ones, in order; consumed operands are removed.
    """

    __slots__ = ("_after", "_expansions", "name", "operands", "session", "span", "used")

    def __init__(self, session: Session, operands: list[Operand], span: Span) -> None:
        self.session = session
        self.operands = operands
        self.span = span  # of the operator's word
        self.name = ""
        self.used: list[Operand] = []  # consumed since the operator began
        self._after: int = -1
        self._expansions = 0

    # ---- reading ---------------------------------------------------------------------------

    def read(self, *types: str, after: int = -1, only: bool = False) -> Operand | None:
        """Consume and return the first readable operand of one of the types, else None.

        `after` is an offset in the source: operands that stand behind it are preferred (the
        value of a keyword), the others are taken if there is none, unless `only` those count.
        """
        if after >= 0:
            found = self._read(types, after)
            if found is not None or only:
                return found
        return self._read(types, -1)

    def _read(self, types: Sequence[str], after: int) -> Operand | None:
        i = 0
        wants_text = "TEXTE" in types
        operands = self.operands
        while i < len(operands):
            operand = operands[i]
            value = operand.value
            if isinstance(value, Texte) and not wants_text:
                self._expand(i)
                continue
            kind = type_of(value)
            fits = kind in types or ANY in types
            if (fits or _is_wide(types, kind)) and (after < 0 or operand.span.start >= after):
                if type(value) is Mot and value[:1] == '"' and operand.span.text[:1] == '"':
                    raise SsiError("double-quotes", operand.span)
                del operands[i]
                self.used.append(operand)
                return operand if fits else _as_read(operand, types)
            if isinstance(value, _NAMED):
                return None
            i += 1
        return None

    def _expand(self, i: int) -> None:
        operand = self.operands[i]
        self._expansions += 1
        if self._expansions > _MAX_EXPANSIONS:
            raise SsiError("endless-text", operand.span, name=operand.name or operand.span.text)
        if operand.value.targets:
            raise SsiError("text-with-names", operand.span, name=operand.span.text)
        inserted = self.session.evaluator.operands_of(operand.value.items)
        self.operands[i : i + 1] = inserted

    def optional(self, *types: str, default: Any = None) -> Any:
        """Value of the next operand of one of the types, or `default`."""
        operand = self.read(*types)
        return default if operand is None else operand.value

    def needed(self, *types: str, after: int = -1) -> Operand:
        """The next operand of one of the types.

        Raises
        ------
        SsiError
            'wrong-argument' when something else stands there, 'missing-argument' when nothing.
        """
        operand = self.read(*types, after=after)
        if operand is None:
            raise self.missing(types)
        return operand

    def required(self, *types: str, after: int = -1) -> Any:
        """Value of the operand that is `needed`."""
        return self.needed(*types, after=after).value

    def all(self, *types: str) -> list[Any]:
        """Values of all readable operands of the types, up to a word (unless MOT is wanted)."""
        values = []
        while (operand := self.read(*types)) is not None:
            values.append(operand.value)
        return values

    def given(self, a: Argument, after: int = -1) -> Any:
        """Value of the next operand as it is declared, its default where an optional one lacks.

        Operators that read by hand take their numbers so; the binder judges at its end.

        Raises
        ------
        SsiError
            As `required`; 'out-of-range' or 'not-increasing'.
        """
        operand = self.read(*a.types, after=after)
        if operand is None:
            if a.optional:
                return a.default
            raise self.missing(a.types)
        self.refuse(a, operand)
        self.tell_odd(a, operand)
        return operand.value

    def refuse(self, a: Argument, operand: Operand) -> None:
        """Refuse a number outside of the range of its declaration, or that is none.

        Raises
        ------
        SsiError
            'out-of-range' or 'not-increasing'.
        """
        bound = ANY_NUMBER if a.range is UNSAID and a.usual.bounded else a.range
        if wrong := bound.flaw(operand.value, a.name):
            raise self.flaw(wrong[0], a, operand, wrong[1])

    def tell_odd(self, a: Argument, operand: Operand) -> None:
        """Tell of a number that is unusual, of a curve over something else or of noughts."""
        usual = usual_of(a.usual, "", a.unit, self.session.units())
        if odd := usual.flaw(operand.value, a.name):
            self.session.report(self.flaw(_ODD.get(odd[0], "unusual"), a, operand, odd[1]))
        if a.unit == "deg" and (angle := like_radians(operand.value)):
            self.session.report(self.flaw("like-radians", a, operand, {"value": angle}))
        over = getattr(operand.value, "over", "") if a.over else ""
        if a.over and is_of_noughts(operand.value):
            self.session.report(self.flaw("of-noughts", a, operand, {}))
        if over and over != a.over:
            self.session.report(self.flaw("over-other", a, operand, {"axis": over, "over": a.over}))

    def flaw(
        self, code: str, a: Argument, operand: Operand, data: Mapping[str, object]
    ) -> SsiError:
        """What is wrong with an operand, at its place."""
        english = "" if a.en == a.name else a.en
        said = {"operator": self.name, "name": a.name, "en": english, "fr": a.fr}
        return SsiError(code, operand.span, **said, **data)

    def word(self) -> str | None:
        """Consume the first unread word, whatever it says; None if there is none."""
        operand = self.read("MOT")
        return None if operand is None else str(operand.value)

    def peek_word(self) -> str | None:
        """The first unread word, in capitals, left unread."""
        i = self.word_index()
        if i is None:
            return None
        value = self.operands[i].value
        return value.name if isinstance(value, Procedure) else str(value).upper()

    def text_at(self, index: int) -> str:
        """What the word, or name of a procedure, at an index says, as keywords are compared."""
        value = self.operands[index].value
        return (value.name if isinstance(value, Procedure) else str(value)).upper().rstrip()

    def words(self) -> list[str]:
        """All unread words, in capitals, left unread."""
        if self.word_index() is None:
            return []
        values = [o.value for o in self.operands]
        named = (v.name if isinstance(v, Procedure) else v for v in values)
        return [str(v).upper().rstrip() for v in named if isinstance(v, str)]

    def take_name(self, optional: bool = False) -> str:
        """Consume the next operand for its name, whatever object bears it; '' if optional.

        Raises
        ------
        SsiError
            'missing-argument' when nothing stands there, 'wrong-argument' for a value without name.
        """
        name = name_of(self.operands[0]) if self.operands else ""
        if name:
            self.used.append(self.operands.pop(0))
        elif not optional:
            raise self.missing(("MOT",))
        return name

    def at_word(self) -> bool:
        """Whether a word is the very next operand."""
        while self.operands and isinstance(self.operands[0].value, Texte):
            self._expand(0)
        return bool(self.operands) and isinstance(self.operands[0].value, _NAMED)

    def keyword(self, words: Sequence[str], length: int = 4) -> str | None:
        """Consume the first unread word if it is one of `words`; returns that entry of `words`.

        Words compare on their first `length` characters, in capitals as the language's tables.
        """
        i = self.word_index()
        if i is None:
            return None
        word = shortened(tuple(words), length).get(self.text_at(i)[:length])
        if word is not None:
            self.take_keyword(i)
        return word

    def take_keyword(self, index: int) -> None:
        """Consume the word at an index, which is a keyword: values are looked for behind it."""
        operand = self.operands.pop(index)
        self.used.append(operand)
        self._after = operand.span.end

    @property
    def keyword_end(self) -> int:
        """Offset behind the keyword read last: pass it as `after` to read its value."""
        return self._after

    def word_index(self) -> int | None:
        """Index of the first unread word or procedure."""
        operands = self.operands
        i = 0
        while i < len(operands):
            value = operands[i].value
            if not isinstance(value, _NAMED_OR_TEXT):
                i += 1
            elif not isinstance(value, Texte):
                return i
            else:
                self._expand(i)
        return None

    def readable(self, *types: str) -> list[int]:
        """Indices of the operands of the types that reading would reach, in order."""
        found: list[int] = []
        i, words = 0, accepts(types, _A_WORD)
        while i < len(self.operands):
            value = self.operands[i].value
            if isinstance(value, Texte) and "TEXTE" not in types:
                self._expand(i)
                continue
            if accepts(types, value):
                found.append(i)
            elif isinstance(value, _NAMED) and not words:
                break
            i += 1
        return found

    def take_first(self, count: int) -> None:
        """Consume so many operands at once: one by one, what is left would move at each."""
        self.used += self.operands[:count]
        del self.operands[:count]

    def take(self, index: int, *types: str) -> Operand:
        """Consume the operand at an index of the unread ones, as one of the types."""
        operand = self.operands.pop(index)
        self.used.append(operand)
        return _as_read(operand, types)

    def wordless(self) -> bool:
        """Whether certainly no word, procedure or text stands among the unread operands."""
        for operand in self.operands:  # noqa: SIM110
            if isinstance(operand.value, _NAMED_OR_TEXT):
                return False
        return True

    def seen(self) -> Seen | None:
        """Classes of all unread operands, and what the words among them say as they are written.

        None where that does not say all: macros, whose items are not known yet, or very many.
        """
        values = [o.value for o in self.operands]
        if len(values) > _MANY:
            return None
        classes = tuple(map(type, values))
        if Texte in classes:
            return None
        named = [v for v in values if isinstance(v, _NAMED)]
        return classes, tuple([v if isinstance(v, Mot) else v.name for v in named])

    def stands(self, *types: str) -> bool:
        """Whether an unread operand of one of the types stands in the phrase."""
        return any(accepts(types, o.value) for o in self.operands)

    def meets(self, when: When) -> bool:
        """Whether the session is as a form wants it."""
        return when.test(self.session)

    def main_operand(self, *types: str) -> int | None:
        """Index of the operand whose type decides the form: the first of the types.

        Words may stand before it (`MAXI 'ABS' L`); a word may be it, with integers behind it
        (`EXTR 'abc' 2`).
        """
        words = False
        for i, operand in enumerate(self.operands):
            kind = type_of(operand.value)
            beside = 2 if words and "MOT" in types else 1
            if kind in types and kind not in _BESIDE_WORDS[:beside]:
                return i
            words = words or isinstance(operand.value, Mot)
        return next(iter(self.readable(*types)), None)

    # ---- errors ----------------------------------------------------------------------------

    def missing(self, types: Sequence[str]) -> SsiError:
        """The error for an operand that is not there, pointing at what stands instead."""
        every = (*self.used, *self.operands)
        told: dict[str, Any] = {"expected": [ANY] if ANY in types else list(types)}
        told |= {"operator": self.name}
        told |= {"quoted": [o.span.text[1:-1] for o in every if o.span.text[:1] == "'"]}
        if self.operands:
            wrong, text = self.operands[0], isinstance(self.operands[0].value, str)
            told |= {"found": type_of(wrong.value), "name": wrong.name}
            told |= {"bare": text and wrong.span.text[:1] not in ("'", "(")}
            value = str(wrong.value) if text else ""
            if (word := f"{self.name[:4]}.{value.upper().rstrip()}") in cast3m_words():
                return SsiError("unknown-operator", wrong.span, name=word)
            return SsiError("wrong-argument", wrong.span, value=value, **told)
        return SsiError("missing-argument", self.span, **told)

    def error(self, code: str, value: object = None, /, **data: object) -> SsiError:
        """An error placed at the operand that holds `value`, else at the operator."""
        return SsiError(code, self.place_of(value), **{"operator": self.name, **data})

    def warn(self, code: str, value: object = None, /, **data: object) -> None:
        """A warning placed as an error is."""
        self.session.warn(code, self.place_of(value), **{"operator": self.name, **data})

    def place_of(self, value: object) -> Span:
        """Where the operand that holds `value` stands, else the operator."""
        return next((o.span for o in self.used if _is_operand(o.value, value)), self.span)


def _is_operand(held: object, value: object) -> bool:
    """Whether an operand's value is the one meant; words are also known by what they say."""
    return held is value or (isinstance(held, Mot) and isinstance(value, str) and held == value)
