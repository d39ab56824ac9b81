"""MOT, CHAI, and what other operators do with words: CHAN 'MAJU', EXTR, DIME, ET."""

from ssilang.language.values import known_types
from ssilang.messages.message import find, places
from ssilang.operators.dispatch import CHAN, DIME, EXTR, union
from ssilang.operators.lists.progressions import check_length
from ssilang.operators.prelude import *
from ssilang.operators.texts.fortran_format import DEFAULT_FORMAT, formatted

_MARKS = frozenset("*/<>")
TEXT = (
    key("form", "FORMAT", "MOT", repeated=True, en="Fortran format of the numbers that follow"),
    many(
        "items",
        "MOT",
        "ENTIER",
        "FLOTTANT",
        "LOGIQUE",
        en="what is written, each with a column if one is given",
        range=CARRIED,
    ),
)
"""What `read_text` reads."""
TEXT_IS_FREE = "its words and numbers stand in any order, with tab marks and formats between"


def written(value: object, form: str = DEFAULT_FORMAT) -> str:
    """A value as CHAI and MESS write it."""
    if isinstance(value, bool):
        return "VRAI" if value else "FAUX"
    if isinstance(value, float):
        return formatted(form, value)
    if isinstance(value, int) and form.upper().lstrip("( SP,").startswith("I"):
        return formatted(form, value)
    return str(value)


def _place(mark: str, column: int, length: int, size: int) -> int:
    """Number of blanks before an item of `size` characters behind `length` written ones."""
    start = {
        "*": column - size,
        "/": column - 1,
        "<": length + column - size,
        ">": length + column - 1,
    }[mark]
    return max(start - length, 0)


_COLUMN = arg("column", "ENTIER", en="column of a mark * / < >", usual=POSITIVE)


def _tab(call: Call) -> tuple[str, int] | None:
    """The tab mark (`*N /N <N >N`) that follows the item just read."""
    if not call.operands or call.operands[0].span.text not in _MARKS:
        return None
    if len(call.operands) < 2 or not isinstance(call.operands[1].value, int | float):
        return None  # without a column the mark is a word as others
    mark = call.operands.pop(0)
    call.used.append(mark)
    column = call.given(_COLUMN)
    return mark.span.text, int(column)


def _at_format(call: Call) -> bool:
    """Whether the next two words are FORMAT and a format."""
    if not call.at_word() or len(call.operands) < 2:
        return False
    first, second = (o.value for o in call.operands[:2])
    said = isinstance(second, Mot) and second.strip()[:1] == "("
    return said and str(first).upper().rstrip() in ("FORMAT", "FORM", "FORMA")


def read_text(call: Call, apart: bool = False) -> str:
    """Join all the words, numbers and logicals that can be read, with tab marks and formats.

    `apart`: a blank between a number and the minus of the next one, for who reads the line.
    """
    text, form = "", DEFAULT_FORMAT
    number_before = False
    while True:
        if _at_format(call) and call.keyword(("FORM",)) is not None:
            form = str(call.required("MOT", after=call.keyword_end))
            continue
        operand = call.read("MOT", "ENTIER", "FLOTTANT", "LOGIQUE")
        if operand is None:
            break
        item = _of_library(call, operand.value) or written(operand.value, form)
        tab = _tab(call)
        number = isinstance(operand.value, int | float)
        glued = apart and number and number_before and item[:1] == "-" and text[-1:] != " "
        number_before = number
        blanks = int(glued) if tab is None else _place(*tab, len(text), len(item))
        check_length(len(text) + blanks + len(item))
        text += " " * blanks + item
    if call.operands:
        wrong = call.operands[0]
        call.used.append(wrong)
        raise call.missing(("MOT", "ENTIER", "FLOTTANT", "LOGIQUE"))
    return text


def _of_library(call: Call, value: object) -> str:
    """A text of the library's procedures, told in the language of the run; '' for other words.

    The word is its code; as many operands as the text has places for follow and fill it.
    """
    if not isinstance(value, str) or not value.startswith("stdlib."):
        return ""
    code = value.rstrip()
    try:
        count = places(find(code).en)
    except LookupError:
        return ""
    given = [call.required("MOT", "ENTIER", "FLOTTANT", "LOGIQUE") for _ in range(count)]
    return call.session.told(code, **filling(given))


def filling(values: Sequence[Any]) -> dict[str, object]:
    """What fills a text of the library: its operands by their number, from 1 on."""
    return {
        str(i): v if type(v) is int else written(v).strip() for i, v in enumerate(values, start=1)
    }


@operator(
    "CHAI", *TEXT, family="words", full_name="CHAINE", terminal=True, reads_itself=TEXT_IS_FREE
)
def chai(call: Call) -> Mot:
    """Write operands into one word."""
    return Mot(read_text(call))


@operator("MOT", gives="MOT|PROCEDUR", family="words", terminal=True)
def mot(text: Mot | Procedure = Arg("PROCEDUR", "MOT", en="a word, bare or quoted")) -> Any:
    """Give a word back; a bare name of a procedure stays a procedure."""
    return text


@CHAN.form(said("MAJU", "MINU"), gives=Like("text"))
def _case(
    word: str, text: Mot | ListMots = Arg("MOT", "LISTMOTS", en="words to change")
) -> Mot | ListMots:
    change = str.upper if word == "MAJU" else str.lower
    if isinstance(text, ListMots):
        return ListMots([change(v) for v in text.values])
    return Mot(change(str(text)))


@EXTR.form()
def _letters(
    call: Call,
    text: str = Main("MOT", en="word"),
    places: ListEnti = Arg("LISTENTI", en="places of its characters", range=POSITIVE),
) -> Mot:
    return Mot("".join(_letter(call, text, int(i)) for i in places.values))


@EXTR.form()
def _extract_word(
    call: Call,
    text: str = Main("MOT", en="word"),
    first: int = Arg("ENTIER", en="first character", range=POSITIVE),
    last: int | None = Opt("ENTIER", en="last character, the end by default", range=POSITIVE),
) -> Mot:
    end = len(text) if last is None else last
    if not 1 <= first <= max(len(text), 1) or not first <= end <= len(text):
        told = {"word": text, "size": len(text), "first": first, "last": end}
        raise call.error("operators.texts.characters-beyond-end", first, **told)
    return Mot(text[first - 1 : end])


def _letter(call: Call, word: str, i: int) -> str:
    if not 1 <= i <= len(word):
        raise call.error("operators.texts.no-such-character", word=word, size=len(word), place=i)
    return word[i - 1]


def type_word(call: Call, said: str) -> str:
    """The type that a word names by its first eight letters; a star may stand before it."""
    kind = said.strip().lstrip("*").upper()[:8]
    if kind not in known_types():
        known = sorted(known_types())
        raise call.error("operators.texts.unknown-type", kind=kind, known_types=known)
    return kind


@EXTR.form()
def _named(call: Call, kind: str = Main("MOT", en="type word")) -> Table:
    wanted, named = type_word(call, kind), call.session.frame.named()
    return Table.numbered(value for value in named.values() if type_of(value) == wanted)


@DIME.form()
def _length(text: str = Main("MOT", en="word")) -> int:
    return len(text)


@union(("MOT", "MOT"))
def _join_words(a: str, b: str) -> Mot:
    check_length(len(a) + len(b))
    return Mot(a.strip() + b.strip())


@union(("MOT", "LISTMOTS"))
def _prepend(a: str, b: ListMots) -> ListMots:
    return ListMots([a, *b.values])


@union(("LISTMOTS", "MOT"))
def _append(a: ListMots, b: str) -> ListMots:
    return a.extended([Mot(b)])


@union(("LISTMOTS", "LISTMOTS"))
def _concatenate(a: ListMots, b: ListMots) -> ListMots:
    check_length(len(a.values) + len(b.values))
    return a.extended(b.values)
