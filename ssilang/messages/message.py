"""From a code and its data to a sentence, in one language, at the very end.

A code is `room.name`: the room is a file beside this one (`kernel.mesh` is `kernel/mesh.toml`),
read when one of its sentences is first told; a code without a room is the language's own. Each
table of a file is a `Message`; its data fill the templates:

===============================  ==================================================================
`{size:.3g}`                     as in str.format
`{names}`                        a collection: `a, b, c`; `{values:.3g}` shows each in that way
`{names:and}` `{names:or}`       `a, b and c`, in French `a, b et c`
`{names:words}` `{parts:;}`      `a b c`, `a; b; c`
`{count:node|nodes}`             singular or plural, by a number or the size of a collection
`{near:?did you mean {near}?}`   a part that stands only where `near` says something;
                                 `{near:?there is {near}|nothing}` has another one for else
`{problem}` `{problem!h}`        the sentence, and the hint, of another error or `Sentence`
===============================  ==================================================================

One is singular in English; in French nought is, too. Sentences and hints steer no terminal,
whatever a script, a file's name or what stands in it says.
"""

import re
from collections.abc import (
    Callable,
    Collection,
    KeysView,
    Mapping,
    Sequence,
    Set,
    ValuesView,
)
from dataclasses import dataclass
from functools import cache
from pathlib import Path, PurePath
from string import Formatter
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeGuard, runtime_checkable

Severity = Literal["error", "warning", "note"]

_LAST = {"and": {"en": " and ", "fr": " et "}, "or": {"en": " or ", "fr": " ou "}}
_SINGULAR = {"en": (1,), "fr": (0, 1)}
_BETWEEN = {
    "": {"en": ", ", "fr": ", "},
    "words": {"en": " ", "fr": " "},
    ";": {"en": "; ", "fr": " ; "},
}
name_of_type: list[Callable[[object], str]] = []
"""Names what has no text of its own, an object of the language: by its type word."""
_ONE_WORD = ("name", "word", "label", "group")  # fields that lay out nothing
_MANY, _SOME = 60, 20  # words of a collection: beyond, so many are told, and how many more
_LONGEST = 40  # letters of a value that has not the form it should be shown in
COLON = {"en": ": ", "fr": " : "}
# all but the tab and the line end, which lay out text; those of eight bits steer as ESC does, and
# signs of direction show a line in another order than it is read
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")


def visible(text: str) -> str:
    """The text with control characters written as in a program: `\\x1b`."""
    return _CONTROL.sub(lambda m: ascii(m.group())[1:-1], text)


@dataclass(frozen=True, slots=True)
class Message:
    """Sentence and hint of one code, in two languages; `number` is Cast3M's, 0 if it has none.

    `script` is the hint in the words of scripts, where it differs: the kernel knows no operators.
    """

    en: str
    fr: str
    hint_en: str = ""
    hint_fr: str = ""
    script_en: str = ""
    script_fr: str = ""
    number: int = 0
    severity: Severity = "error"


@runtime_checkable
class Said(Protocol):
    """What has a sentence: errors, and parts of other sentences."""

    @property
    def code(self) -> str:
        """Where its sentence stands."""

    @property
    def data(self) -> Mapping[str, Any]:
        """What fills it."""


class Sentence:
    """A part of a sentence, or a hint, that stands in the catalogue under a code of its own."""

    __slots__ = ("code", "data")

    def __init__(self, code: str, /, **data: object) -> None:
        self.code, self.data = code, data

    def __str__(self) -> str:
        """In English."""
        return sentence(self.code, self.data)


class Teller(Protocol):
    """Makes a text of a code and its data, in the language of whoever reads it."""

    def __call__(self, code: str, /, **data: object) -> str:
        """The text."""


def teller(language: str) -> Teller:
    """What makes texts in 'en' or 'fr'."""
    return lambda code, /, **data: sentence(code, data, language)


class Refusal(Exception):
    """What is refused, and why: a code and data, from which a sentence is made at the very end.

    Parameters
    ----------
    code : str
        Key of a message, such as 'kernel.mesh.no-area'.
    **data
        What fills its sentence and its hint. An error that led to this one is data too.
    """

    def __init__(self, code: str, /, **data: object) -> None:
        super().__init__(code)
        self.code, self.data = code, data

    def __str__(self) -> str:
        """The sentence in English."""
        return sentence(self.code, self.data)

    @property
    def hint(self) -> str:
        """What to change to get further, in English, '' if nothing is known."""
        return hint(self.code, self.data)


def spoken(en: str, fr: str, language: str) -> str:
    """The one of two texts that is in 'en' or 'fr'."""
    return en if language == "en" else fr


class Translated:
    """What says an English text, `en`, whose French stands in the catalogue of French texts."""

    __slots__ = ()
    if TYPE_CHECKING:

        @property
        def en(self) -> str: ...

    @property
    def fr(self) -> str:
        """The same in French, line by line."""
        return french(self.en)


def french(en: str) -> str:
    """The French of a text of the operators' declarations, line by line; '' for a line unknown.

    A file a family of operators, `french/mesh.toml`, holds it by the English.
    """
    return "\n".join(_french().get(line, "") for line in en.split("\n"))


@cache
def _french() -> dict[str, str]:
    import tomllib  # most runs tell nothing, many no French

    texts: dict[str, str] = {}
    for path in sorted((Path(__file__).parent / "french").glob("*.toml")):
        texts |= tomllib.loads(path.read_text(encoding="utf-8"))
    return texts


def help_texts(family: str, operator: str) -> Mapping[str, Any]:
    """What help says of an operator: `en`, `fr`, `syntax`, and the same of forms by function."""
    return _of_family("pages", family).get(operator, {})


def examples(family: str, operator: str) -> tuple[str, ...]:
    """Scripts that show an operator."""
    return tuple(_of_family("examples", family).get(operator, ()))


@cache
def _of_family(folder: str, family: str) -> dict[str, Any]:
    import tomllib  # most runs tell nothing

    path = Path(__file__).parent / folder / f"{family}.toml"
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def find(code: str) -> Message:
    """The message of a code.

    Raises
    ------
    LookupError
        If no catalogue has it: a defect of the program.
    """
    room, _, name = code.rpartition(".")
    try:
        return _room(room or "language")[name]
    except (FileNotFoundError, KeyError):
        raise LookupError(f"no message has the code '{code}'") from None


def places(template: str) -> int:
    """How many operands fill a text of the library, whose places are numbered: {1} {2} ..."""
    fields = Formatter().parse(template)
    return len({name for _, name, _, _ in fields if name is not None and name.isdigit()})


@cache
def _room(name: str) -> dict[str, Message]:
    import tomllib  # most runs tell nothing

    path = Path(__file__).parent.joinpath(*name.split(".")).with_suffix(".toml")
    found = tomllib.loads(path.read_text(encoding="utf-8"))
    return {code: Message(**fields) for code, fields in found.items()}


def sentence(code: str, data: Mapping[str, Any], language: str = "en") -> str:
    """What is wrong, in 'en' or 'fr'; `speaker` among the data is named first."""
    message = find(code)
    text = filled(spoken(message.en, message.fr, language), data, language)
    return visible(f"{data['speaker']}{COLON[language]}{text}" if "speaker" in data else text)


def hint(code: str, data: Mapping[str, Any], language: str = "en", script: bool = False) -> str:
    """What to do about it, '' if nothing is known; `script`: in the words of scripts."""
    message = find(code)
    of_script = script and message.script_en
    hints = (
        (message.script_en, message.script_fr) if of_script else (message.hint_en, message.hint_fr)
    )
    return visible(filled(spoken(*hints, language), data, language, script))


def filled(template: str, data: Mapping[str, Any], language: str, script: bool = False) -> str:
    """A template with its data put in."""

    def told(part: str) -> str:
        return filled(part, data, language, script)

    made = []
    for literal, name, spec, conversion in Formatter().parse(template):
        made.append(literal)
        if name is not None:
            value, spec = data[name], spec or ""
            if spec[:1] == "?":
                there, absent = [*_branches(spec[1:]), ""][:2]
                made.append(told(there if _says(value) else absent))
            elif "|" in spec:
                made.append(told(_branches(spec)[not _is_one(value, language)]))
            elif conversion == "h" and isinstance(value, Said):
                made.append(hint(value.code, value.data, language, script))
            else:
                quoted = conversion == "r" and _has_text(value)
                shown = repr(value) if quoted else _shown(value, spec, language)
                made.append(shown.replace("\n", "\\n") if name.endswith(_ONE_WORD) else shown)
    return "".join(made)


def _is_one(value: object, language: str) -> bool:
    return (len(value) if _is_several(value) else value) in _SINGULAR[language]


def _branches(spec: str) -> list[str]:
    """The spec cut at the signs | that stand outside of inner fields."""
    parts, depth = [""], 0
    for sign in spec:
        depth += (sign == "{") - (sign == "}")
        if sign == "|" and not depth:
            parts.append("")
        else:
            parts[-1] += sign
    return parts


def _says(value: object) -> bool:
    return bool(len(value)) if _is_several(value) else bool(value)


def _is_several(value: object) -> TypeGuard[Collection[object]]:
    several = isinstance(value, Collection) and not isinstance(value, str)
    return several and getattr(value, "ndim", 1) > 0


def _has_text(value: object) -> bool:
    """Whether a value is told as it is: words, numbers, paths, errors and collections of these."""
    plain = isinstance(value, (str, int, float, complex, PurePath, BaseException, Mapping))
    if plain or value is None or type(value).__module__ in ("numpy", "builtins"):
        return True
    return isinstance(value, (Set, Sequence, KeysView, ValuesView)) or hasattr(value, "__index__")


def _shown(value: object, spec: str, language: str) -> str:
    if isinstance(value, Said):
        return sentence(value.code, value.data, language)
    if not _has_text(value):
        return name_of_type[0](value) if name_of_type else type(value).__name__
    if not _is_several(value):
        return _formatted(value, spec)
    joint, _, form = spec.partition(" ")
    if joint not in _LAST and joint not in _BETWEEN:
        joint, form = "", spec
    words = [_shown(v, form, language).replace("\n", "\\n") for v in value]
    if len(words) > _MANY:  # whoever has 3 000 notes among the motions reads the rest of the screen
        words = [*words[:_SOME], f"... (+{len(words) - _SOME})"]
        joint *= joint not in _LAST
    if joint in _LAST and len(words) > 1:
        return ", ".join(words[:-1]) + _LAST[joint][language] + words[-1]
    return _BETWEEN.get(joint, _BETWEEN[""])[language].join(words)


_STEADY = ".9g"
"""Digits that rounding leaves: a free fall of 4.905e-8 m has three in every order of its sums."""


def _formatted(value: object, spec: str) -> str:
    try:
        if isinstance(value, float) and spec.endswith("g"):
            value = float(format(value, _STEADY))
        told = format(value, spec)
        return told.replace("\n", "\\n") if isinstance(value, PurePath) else told
    except (OverflowError, TypeError, ValueError):  # an integer past all reals, or of another type
        return str(value)[:_LONGEST]
