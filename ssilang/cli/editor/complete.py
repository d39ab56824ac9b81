"""What may be typed at the cursor: operators, keywords, entries, parameters, names, files.

One source for editors, the interactive session and notebooks: these two hand over their session,
whose names and tables are known beside those of the text.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Literal

from ssilang.cli.editor.document import Document, Place, entries_at, suiting
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.language import vocabulary
from ssilang.language.registry import keywords_of, operators_by_family
from ssilang.language.run.library import Library
from ssilang.language.run.session import Session
from ssilang.language.say.reference import first_sentence
from ssilang.language.values import Table, type_of
from ssilang.language.vocabulary.entries import Declaration, TableEntry
from ssilang.messages.message import teller
from ssilang.operators.vocabulary import words

CONTROL = ("SI", "SINON", "FINSI", "REPETER", "FIN", "QUITTER", "ITERER", "DEBPROC", "FINPROC")
_FILES = frozenset({"LIRE", "ACQU", "REST", "SORT", "SAUV", "OPTI"})
_MOST_FILES = 200

Kind = Literal["operator", "procedure", "control", "keyword", "entry", "word", "name", "file"]


@dataclass(frozen=True, slots=True)
class Candidate:
    """A word that may stand at the cursor; `text` is put there in place of start:end."""

    label: str
    kind: Kind
    text: str
    start: int
    end: int
    detail: str = ""


def candidates(
    document: Document,
    offset: int,
    library: Library,
    language: str,
    session: Session | None = None,
) -> list[Candidate]:
    """All candidates at an offset; `session` is the one that the text goes on with."""
    place = document.place(offset)
    quoted = place.token is not None and place.token.kind == "STRING"
    start = place.token.start if place.token is not None else offset
    end = place.token.end if place.token is not None else offset
    if place.path:
        found = list(_entries(place, document, library, language))
        if session is not None:
            found += _entries_held(place, session, library, language)
    elif quoted:
        found = [*_keywords(place, document, language), *_files(place, document)]
    else:
        found = [
            *_keywords(place, document, language),
            *_names(document, offset),
            *(_names_held(session) if session is not None else ()),
            *_commands(library, language),
        ]
    unique = {(label, kind): (text, detail) for label, kind, text, detail in reversed(found)}
    return [
        Candidate(label, kind, text, start, end, detail)
        for (label, kind), (text, detail) in reversed(unique.items())
    ]


_Found = tuple[str, Kind, str, str]


def _entries(place: Place, document: Document, library: Library, language: str) -> Iterator[_Found]:
    for declaration, entry in entries_at(place.path, document, library):
        yield from _entry(declaration, entry, language)


def _entry(declaration: Declaration, entry: TableEntry, language: str) -> Iterator[_Found]:
    if len(entry.index) > 1 and entry.role not in ("unused", "refused"):
        types = "|".join(entry.types)
        said = f"{declaration.name} : {types} {entry.said(language)}"
        yield entry.index, "entry", f"'{entry.index}'", said


def _entries_held(
    place: Place, session: Session, library: Library, language: str
) -> Iterator[_Found]:
    """Indices of a table of the session, and entries of the procedures that it suits."""
    value = session.frame.find(place.path[0].name)
    for token in place.path[1:]:
        if not isinstance(value, Table):
            return
        value = value.get(int(token.text) if token.kind == "INTEGER" else token.name)
    if not isinstance(value, Table):
        return
    given = [index for index in value.indices() if isinstance(index, str | int | float)]
    for index in given:
        text = f"'{index.rstrip()}'" if isinstance(index, str) else str(index)
        yield text.strip("'"), "entry", text, ""
    for declaration, argument in suiting({str(i).rstrip() for i in given}, library):
        for entry in declaration.inside((argument,)).values():
            yield from _entry(declaration, entry, language)


def _keywords(place: Place, document: Document, language: str) -> Iterator[_Found]:
    operator = place.operator
    if operator is None:
        return
    if operator.name in ("MATE", "CARA"):
        yield from _parameters(place, document, language)
    elif operator.name in vocabulary.WORDS_OF:
        for kind in vocabulary.WORDS_OF[operator.name]:
            for word in vocabulary.words(kind):
                detail = words.described(word, language)
                yield word.name, "word", f"'{word.name}'", detail
    for name in keywords_of(operator):
        short = name.rstrip()
        if short and short[0].isalpha():
            yield short, "keyword", f"'{short}'", operator.full_name


def _parameters(place: Place, document: Document, language: str) -> Iterator[_Found]:
    """Parameters of the laws and elements that the model in front was made of."""
    given = _model_words(place, document)
    springs = any(word[:4] == "IMPE" for word in given)
    laws = [m for word in given for m in vocabulary.meanings("law", word)]
    laws = [m for m in laws if m.kind != "impedance" or springs]  # ELASTIQUE is a law of both
    zones = [zone for m in laws if (zone := words.sample_of_law(m)) is not None]
    found = [row for zone in zones for row in words.parameter_rows(zone, True, False)]
    for name in (m.name for w in given for m in vocabulary.meanings("element", w)):
        for zone in list(words.samples_of_element(name))[-1:] if name in ELEMENTS else []:
            found += words.parameter_rows(zone, not zones, True)
    need = f" ({teller(language)('help.required')})"
    rows = {
        row.word.name: words.described(row.word, language) + need * row.required
        for row in found if not row.word.kind
    } or {w.name: words.described(w, language) for w in vocabulary.words("parameter")}  # fmt: skip
    for name, said in rows.items():
        yield name, "word", f"'{name}'", said


def _model_words(place: Place, document: Document) -> list[str]:
    """Words of the statements that gave the names of a phrase their values."""
    given: list[str] = []
    names = {t.name for t in place.before if t.kind == "WORD"}
    for phrase in document.phrases:
        equal = phrase.cut.equal
        if equal is None or phrase is place.phrase:
            continue
        if names & {t.name for t in phrase.cut.tokens[:equal] if t.kind == "WORD"}:
            behind = phrase.cut.tokens[equal:]
            if any(t.is_word and t.name[:4] == "MODE" for t in behind):
                given += [t.name for t in behind if t.is_word]
    return given


def _files(place: Place, document: Document) -> Iterator[_Found]:
    """Files of the script's folder, below it too, for the operators that read or write them."""
    path = document.source.path
    if place.operator is None or place.operator.name not in _FILES or path is None:
        return
    folder = path.parent
    found = (p for pattern in ("*", "*/*") for p in sorted(folder.glob(pattern)))
    for count, file in enumerate(f for f in found if f.is_file() and f.name[0] != "."):
        if count >= _MOST_FILES:
            return
        name = file.relative_to(folder).as_posix()
        yield name, "file", f"'{name}'", ""


def _names(document: Document, offset: int) -> Iterator[_Found]:
    for name, first in document.names.visible(document.names.scope_at(offset)).items():
        line = document.source.position(first.start)[0]
        yield name, "name", name, f"{first.kind} ({line})"


def _names_held(session: Session) -> Iterator[_Found]:
    for name in sorted(session.frame.names()):
        if name[0] != "&":
            yield name, "name", name, type_of(session.frame.find(name))


def _commands(library: Library, language: str) -> Iterator[_Found]:
    for word in CONTROL:
        yield word, "control", word, ""
    for name, summary in _operators(language):
        yield name, "operator", name, summary
    for name in sorted(library.standard_names):
        yield name, "procedure", name, ""


@cache
def _operators(language: str) -> tuple[tuple[str, str], ...]:
    """Names of all operators, and what each does in a sentence."""
    found = {o.full_name: o for group in operators_by_family().values() for o in group}
    return tuple(
        (name, first_sentence(o.help.told(language)))
        for name, o in found.items()
        if name[0].isalpha()
    )
