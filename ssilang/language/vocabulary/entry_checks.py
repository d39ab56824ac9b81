"""What is wrong with a table that a procedure is called with, by what is declared of its entries.

Values of another type, words that are not allowed, entries that are missing or not available are
errors; an entry that nobody reads is a warning that names the one that was meant.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from ssilang.language.run.scopes import Frame
from ssilang.language.run.session import Session
from ssilang.language.say.errors import SsiError
from ssilang.language.search import meant as near_word
from ssilang.language.text.source import Span
from ssilang.language.values import Annule, Mot, Procedure, Table, is_of_noughts, type_of
from ssilang.language.vocabulary.entries import (
    MADE_BY,
    NUMBER,
    REFUSED,
    UNUSED,
    Declaration,
    TableEntry,
    as_written,
)
from ssilang.language.vocabulary.unit_systems import APART, SOIL, usual_of, wave_flaw
from ssilang.language.vocabulary.unread_entries import reads, unread

_TRUTH = "LOGIQUE"
_TRUTH_WORDS = {"VRAI": True, "FAUX": False}


_OF_ENTRIES = {
    "out-of-range": "entry-out-of-range", "not-increasing": "entry-not-increasing",
    "not-finite": "entry-not-finite",
}  # fmt: skip
_ODD = {
    "out-of-range": "entry-unusual", "not-increasing": "entry-out-of-order",
    "of-noughts": "entry-of-noughts",
}  # fmt: skip


def shown(path: tuple[object, ...]) -> str:
    """Indices as a script writes them, the argument left out: 'SOL' . 'ITERATION' . 1."""
    words = (f"'{i.rstrip()}'" if isinstance(i, str) else i for i in path[1:])
    return " . ".join(str(w) if isinstance(w, str | int | float) else type_of(w) for w in words)


def allowed(entry: TableEntry) -> str:
    """What a value may be: types other than MOT, and the words."""
    kinds = [t for t in entry.types if t != "MOT"]
    kinds = [k for t in kinds for k in (("VRAI", "FAUX") if t == _TRUTH else (t,))]
    return " | ".join([*kinds, *map(as_written, entry.values)])


def meant_truth(entry: TableEntry, value: Any) -> Any:
    """The LOGIQUE that the word 'VRAI' or 'FAUX' means where an entry takes one, else the value.

    Quotes around VRAI and FAUX make them words; published decks write them so.
    """
    free = "MOT" in entry.types and not entry.values
    if not isinstance(value, Mot) or _TRUTH not in entry.types or free:
        return value
    return _TRUTH_WORDS.get(str(value).upper().rstrip(), value)


def truth_told(procedure: str, where: tuple[object, ...], meant: object) -> dict[str, object]:
    """Data of the warning of a word that means a LOGIQUE."""
    word = "VRAI" if meant else "FAUX"
    return {"procedure": procedure, "operator": procedure, "where": shown(where), "word": word}


def checked(
    session: Session, entry: TableEntry, value: Any, where: tuple[object, ...], **data: object
) -> Any:
    """The value of an entry in the form that it is declared in.

    An ENTIER becomes a FLOTTANT where one is wanted, a word the declared one that it is.

    Raises
    ------
    SsiError
        If it is of another type, or no allowed word, or holds what no calculation can use.
    """
    value = meant_truth(entry, value)
    found, place = type_of(value), shown(where)
    if entry.types and found not in entry.types:
        if found != "ENTIER" or "FLOTTANT" not in entry.types:
            kinds = " | ".join(entry.types)
            made = [MADE_BY[t] for t in entry.types if t in MADE_BY][:2]
            raise SsiError(
                "entry-type", None, where=place, kinds=kinds, found=found, made=made,
                en=entry.en, fr=entry.fr, **data,
            )  # fmt: skip
        value = float(value)
    if entry.values and found == "MOT":
        word = entry.word(str(value))
        if word is None:
            near = near_word(str(value), entry.values)
            code = "entry-value-near" if near else "entry-value"
            raise SsiError(
                code, None, where=place, given=str(value).rstrip(), near=near,
                allowed=allowed(entry), **data,
            )  # fmt: skip
        return Mot(word)
    flaw = session.flaw_of(value)
    if flaw:
        raise SsiError(flaw, None, where=place, **data)
    said = entry.range.flaw(value, entry.index)
    if said is not None:
        code, told = said
        raise SsiError(
            _OF_ENTRIES[code], None, where=place, en=entry.en, fr=entry.fr, **told, **data
        )
    return value


class TableCheck:
    """Looks through one table given to a procedure, and the tables in it.

    Parameters
    ----------
    place : Span
        Where the script calls.
    aloud : bool
        Whether to warn of entries that nobody reads.
    """

    def __init__(
        self, session: Session, declared: Declaration, place: Span, aloud: bool = True
    ) -> None:
        self.session, self.declared, self.place, self.aloud = session, declared, place, aloud

    def run(self, table: Table, path: tuple[str, ...], where: tuple[object, ...]) -> None:
        """Check a table, `path` being where it is declared and `where` where it stands.

        Raises
        ------
        SsiError
            For the first entry that the procedure cannot use.
        """
        if type(table) is not Table:  # made by procedures, their values not even found yet
            return
        self._words_of_truth(table, path, where)
        given = [(i, v) for i, v in table.items() if not isinstance(v, Annule)]
        for index, value in given:
            entry = self.declared.at(path, index)
            if entry is None:
                self._unknown(table, path, (*where, index))
            else:
                self._known(entry, value, (*where, index))
        for entry in self.declared.inside(path).values():
            if entry.needed and not any(self.declared.at(path, i) is entry for i, _ in given):
                missing = 1 if entry.index == NUMBER else entry.index
                raise self._error("entry-missing", shown((*where, missing)))
        self._without_effect(table, path, where, given)
        self._waves(path, where, dict(given))

    def _waves(
        self, path: tuple[str, ...], where: tuple[object, ...], given: Mapping[Any, Any]
    ) -> None:
        """Warn of a soil that no ground is, by units of two systems; of layers that none has."""
        inside = [v.get(Mot(SOIL[-1])) for v in given.values() if isinstance(v, Table)]
        layers = [v for v in inside if isinstance(v, float)]
        low, high = min(layers, default=0.0), max(layers, default=0.0)
        if self.aloud and high >= APART * low > 0.0:
            self._warn("soil-densities", where=shown(where), times=high / low, low=low, high=high)
        known, soil = self.declared.inside(path), {n: given.get(Mot(n)) for n in SOIL}
        if not self.aloud or not all(n in known and isinstance(soil[n], float) for n in SOIL):
            return
        flaw = wave_flaw(soil, self.session.units())
        if flaw is not None:
            self._warn("soil-waves", **flaw)

    def _words_of_truth(
        self, table: Table, path: tuple[str, ...], where: tuple[object, ...]
    ) -> None:
        """Put the LOGIQUE in place of the word that means it, and tell."""
        for index, value in list(table.items()):
            entry = self.declared.at(path, index)
            meant = value if entry is None else meant_truth(entry, value)
            if meant is not value:
                told = truth_told(self.declared.name, (*where, index), meant is True)
                self.session.warn("word-of-truth", self.place, **told)
                table.set(index, meant)

    def _without_effect(
        self,
        table: Table,
        path: tuple[str, ...],
        where: tuple[object, ...],
        given: list[tuple[Any, Any]],
    ) -> None:
        """Warn, once for a table, of what changes nothing; FAUX and a default ask for nothing."""
        known = [(i, v, self.declared.at(path, i)) for i, v in given if v is not False]
        options = self.session.options
        for index, _, entry in known if self.aloud else ():
            if entry and entry.only and entry.is_read and not options.get(entry.under):
                self._only_with(table, path, (*where, index), entry.only)
        # other entries that nobody reads are those of tables that operators make
        unused = [(i, e) for i, v, e in known if e and e.theme == UNUSED and v != e.fallback]
        readers = _Readers(self.session, self.place, table, len(path) > 1)
        told = [(i, e) for i, e in unused if self.aloud and not readers.read(str(i).rstrip())]
        if not told:
            return
        reasons = {(e.en, e.fr) for _, e in told}
        en, fr = next(iter(reasons)) if len(reasons) == 1 else ("", "")
        names = [shown((*where, i)) for i, _ in told]
        self._warn("entries-without-effect", names=names, en=en, fr=fr)

    def _only_with(
        self,
        table: Table,
        path: tuple[str, ...],
        where: tuple[object, ...],
        only: Mapping[str, Sequence[str]],
    ) -> None:
        """Warn of an entry that counts with other words of the entries beside it."""
        for index, words in only.items():
            beside = self.declared.at(path, index)
            given = table.get(Mot(index)) if table.has(Mot(index)) else beside and beside.fallback
            said = beside.word(given) if beside is not None and isinstance(given, str) else None
            if isinstance(given, bool):
                said = "VRAI" if given else "FAUX"
            if said is not None and said not in words:
                told = {"where": shown(where), "other": shown((*where[:-1], index))}
                self._warn("entry-only-with", **told, words=list(words), given=said)

    def _known(self, entry: TableEntry, value: Any, where: tuple[object, ...]) -> None:
        if entry.role == REFUSED and value is not False:  # FAUX asks for nothing
            raise self._error("entry-refused", shown(where), en=entry.en, fr=entry.fr)
        if not entry.is_read:
            return
        name = self.declared.name
        try:
            checked(self.session, entry, value, where, procedure=name, operator=name)
        except SsiError as error:
            error.span = self.place
            raise
        usual = usual_of(entry.usual, entry.index, entry.unit, self.session.units())
        said, told = usual.flaw(value, entry.index), {"where": shown(where), "en": entry.en}
        if said is not None:
            self._warn(_ODD[said[0]], **told, fr=entry.fr, **said[1])
        axis = getattr(value, "over", "") if entry.over else ""
        if axis and axis != entry.over:
            self._warn(
                "over-other", **told, fr=entry.fr, name=told["where"], over=entry.over, axis=axis
            )
        if self.aloud and is_of_noughts(value):
            self._warn("entry-of-noughts", **told, fr=entry.fr)
        if isinstance(value, Table) and self.declared.inside(entry.path):
            self.run(value, entry.path, where)

    def _warn(self, code: str, **data: object) -> None:
        name = self.declared.name
        self.session.warn(code, self.place, procedure=name, operator=name, **data)

    def _error(self, code: str, where: str, **data: object) -> SsiError:
        name = self.declared.name
        return SsiError(code, self.place, procedure=name, operator=name, where=where, **data)

    # ---- entries that nobody reads --------------------------------------------------------------

    def _unknown(self, table: Table, path: tuple[str, ...], where: tuple[object, ...]) -> None:
        index = where[-1]
        known = self.declared.inside(path)
        if not self.aloud or not isinstance(index, str) or index == "SOUSTYPE" or not known:
            return
        word = index.rstrip()
        if _Readers(self.session, self.place, table, len(path) > 1).read(word):
            return
        said = unread(
            self.session.library, self.declared, path, word, table.has, self.place.source.code
        )
        if said is not None:
            self._warn(said[0], where=shown(where), **said[1])


class _Readers:
    """Whether the script's own statements read an index of a table.

    Anywhere in its procedures; outside of them where the table goes by one of its names.
    """

    def __init__(self, session: Session, place: Span, table: Table, nested: bool) -> None:
        self.main, self.nested = place.source.code, nested
        self.names: set[str] = set()
        self.procedures: list[str] = []
        frame: Frame | None = session.frame
        while frame is not None:
            for name, value in frame.variables.items():
                if value is table:
                    self.names.add(name)
                elif isinstance(value, Procedure) and value.origin != "stdlib":
                    span = value.definition.span
                    self.procedures.append(span.source.code[span.start : span.end])
            frame = frame.caller

    def read(self, word: str) -> bool:
        """Whether they read that index."""
        if any(True for text in self.procedures for _ in reads(text, word)):
            return True
        return any(
            parent in self.names or (self.nested and parent in "')")
            for parent in reads(self.main, word)
        )


def check_tables(session: Session, name: str, frame: Frame, place: Span) -> None:
    """Check the tables among the arguments of a procedure of the library, `frame` holding them."""
    declared = session.library.declared(name)
    if declared is None:
        return
    aloud = session.frame.procedure not in session.library.standard_names
    check = TableCheck(session, declared, place, aloud)
    for argument in declared.arguments:
        value = frame.variables.get(argument.name)
        if isinstance(value, Table):
            check.run(value, (argument.name,), (argument.name,))
