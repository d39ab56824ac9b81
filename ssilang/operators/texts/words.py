"""MOT, CHAI, and what other operators do with words: CHAN 'MAJU', EXTR, DIME, ET."""

from __future__ import annotations

from typing import Any

from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots, Mot, Table
from ssilang.operators.dispatch import CHAN, DIME, EXTR, union
from ssilang.operators.lists.making import check_length
from ssilang.operators.texts.fortran_format import DEFAULT_FORMAT, formatted

_MARKS = frozenset("*/<>")


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


def _tab(call: Call) -> tuple[str, int] | None:
    """The tab mark (`*N /N <N >N`) that follows the item just read."""
    if not call.operands or call.operands[0].span.text not in _MARKS:
        return None
    mark = call.operands.pop(0)
    call.used.append(mark)
    column = call.required("ENTIER")
    return mark.span.text, int(column)


def _at_format(call: Call) -> bool:
    """Whether the next two words are FORMAT and a format."""
    if not call.at_word() or len(call.operands) < 2:
        return False
    first, second = (o.value for o in call.operands[:2])
    said = isinstance(second, Mot) and second.strip()[:1] == "("
    return said and str(first).upper().rstrip() in ("FORMAT", "FORM", "FORMA")


def read_text(call: Call) -> str:
    """Join all the words, numbers and logicals that can be read, with tab marks and formats."""
    text, form = "", DEFAULT_FORMAT
    while True:
        if _at_format(call) and call.keyword(("FORM",)) is not None:
            form = str(call.required("MOT", after=call.keyword_end))
            continue
        operand = call.read("MOT", "ENTIER", "FLOTTANT", "LOGIQUE")
        if operand is None:
            break
        item = written(operand.value, form)
        tab = _tab(call)
        blanks = 0 if tab is None else _place(*tab, len(text), len(item))
        check_length(len(text) + blanks + len(item))
        text += " " * blanks + item
    if call.operands:
        wrong = call.operands[0]
        call.used.append(wrong)
        raise call.missing(("MOT", "ENTIER", "FLOTTANT", "LOGIQUE"))
    return text


@operator(
    "CHAI",
    family="words",
    full_name="CHAINE",
    terminal=True,
    help=Help(
        en="Joins words and numbers into one word, without blanks between. Reals are written by "
        "the last FORMAT (a Fortran format, (1PE12.5) at first), integers too by an I format. "
        "Behind an item, *N puts its end at column N, /N its beginning; <N and >N count from the "
        "end of what is written already.",
        fr="Assemble des mots et des nombres en un mot, sans blancs entre eux. Les réels suivent "
        "le dernier FORMAT (à la Fortran, d'abord (1PE12.5)). Derrière un élément, *N met sa fin "
        "en colonne N, /N son début ; <N et >N comptent depuis la fin de ce qui est déjà écrit.",
        syntax="MOT1 = CHAI ('FORMAT' MOT2) OBJ1 (*N1 | /N1 | <N1 | >N1) (OBJ2 ...) ;",
        examples=(
            "N = 3 ; M = CHAI 'case ' N ; MESS M ;",
            "MESS (CHAI 'FORMAT' '(F8.3)' 'x' 2.5*20) ;",
        ),
    ),
    reads_itself=True,
)
def chai(call: Call) -> Mot:
    """Write operands into one word."""
    return Mot(read_text(call))


@operator(
    "MOT",
    family="words",
    terminal=True,
    help=Help(
        en="A word, also when it is the name of an operator or a procedure.",
        fr="Un mot, même si c'est le nom d'un opérateur ou d'une procédure.",
        syntax="MOT1 = MOT MOT2 ;",
        examples=("M = MOT 'LIST' ; LIST M ;",),
    ),
    reads_itself=True,
)
def mot(call: Call) -> Any:
    """Give a word back; a bare name of a procedure stays a procedure."""
    operand = call.read("PROCEDUR", "MOT")
    if operand is None:
        raise call.missing(("MOT",))
    return operand.value


@CHAN.on(
    "MAJU",
    "MINU",
    syntax="MOT2 = CHAN 'MAJU' | 'MINU' MOT1 ;",
    en="MAJU and MINU change the case of a word.",
    fr="MAJU et MINU changent la casse d'un mot.",
    examples=("MESS (CHAN 'MAJU' 'abc') ;",),
)
def _case(call: Call, word: str) -> Mot | ListMots:
    value = call.required("MOT", "LISTMOTS")
    change = str.upper if word == "MAJU" else str.lower
    if isinstance(value, ListMots):
        return ListMots([change(v) for v in value.values])
    return Mot(change(str(value)))


@EXTR.on(
    "MOT",
    syntax="MOT2 = EXTR MOT1 N1 (N2) ; MOT2 = EXTR MOT1 LISTENTI1 ; TAB1 = EXTR 'TYPE1' ;",
    en="Of a word: characters N1 to N2 (to the end without N2). With a type word alone: table of "
    "all named objects of that type.",
    fr="D'un mot : les caractères N1 à N2 (jusqu'à la fin sans N2). Avec un mot de type seul : "
    "table de tous les objets nommés de ce type.",
    examples=("MESS (EXTR 'abcdef' 2 4) ;",),
)
def _extract_word(call: Call, word: str) -> Any:
    places = call.read("LISTENTI")
    if places is not None:
        return Mot("".join(_letter(call, word, int(i)) for i in places.value.values))
    first = call.read("ENTIER")
    if first is None:
        return _named(call, word)
    last = call.optional("ENTIER", default=len(word))
    if not 1 <= first.value <= max(len(word), 1) or not first.value <= last <= len(word):
        raise call.error(
            "operators.texts.characters-beyond-end",
            first.value,
            word=word,
            size=len(word),
            first=first.value,
            last=last,
        )
    return Mot(word[first.value - 1 : last])


def _letter(call: Call, word: str, i: int) -> str:
    if not 1 <= i <= len(word):
        raise call.error("operators.texts.no-such-character", word=word, size=len(word), place=i)
    return word[i - 1]


def _named(call: Call, kind: str) -> Table:
    from ssilang.language.values import known_types, type_of

    wanted = kind.strip().lstrip("*").upper()
    if wanted not in known_types():
        raise call.error(
            "operators.texts.unknown-type-named", kind=kind, known_types=sorted(known_types())
        )
    frame, found = call.session.frame, Table()
    for name in sorted(frame.names()):
        value = frame.find(name)
        if type_of(value) == wanted:
            found.set(len(found) + 1, value)
    return found


@DIME.on(
    "MOT",
    en="Of a word: its number of characters.",
    fr="D'un mot : son nombre de caractères.",
    examples=("LIST (DIME 'abc') ;",),
)
def _length(call: Call, word: str) -> int:
    return len(word)


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
