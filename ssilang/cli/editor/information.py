"""What stands under the cursor, as Markdown: operator, keyword, entry, word, name of the script."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ssilang.cli.editor.document import Document, Place, entries_at, knows
from ssilang.cli.editor.names import Occurrence
from ssilang.cli.editor.problems import Findings
from ssilang.language import vocabulary
from ssilang.language.registry import Keyword, Operator, Select, keywords_in
from ssilang.language.run.library import Library
from ssilang.language.say.reference import describe, find_page, page_text
from ssilang.language.vocabulary.entries import Declaration, TableEntry
from ssilang.messages.message import teller
from ssilang.operators.vocabulary.pages import vocabulary_text

_NAMED = {
    "variable": "cli.name-variable",
    "parameter": "cli.name-parameter",
    "procedure": "cli.name-procedure",
    "loop": "cli.name-loop",
}


@dataclass(frozen=True)
class Reader:
    """Answers about one document, in one language."""

    document: Document
    findings: Findings
    library: Library
    language: str

    def hover(self, offset: int) -> tuple[str, int, int] | None:
        """Markdown about the word at an offset, and where the word stands."""
        place = self.document.place(offset)
        if place.token is None:
            return None
        text = next((t for t in self._told(place, offset) if t), "")
        return (text, place.token.start, place.token.end) if text else None

    def _told(self, place: Place, offset: int) -> Iterator[str]:
        token = place.token
        assert token is not None
        if place.path:
            found = entries_at(place.path, self.document, self.library)
            yield "\n\n---\n\n".join(
                entry_markdown(d, e, self.language) for d, e in found if e.index == token.name
            )
        name = self.document.names.at(offset) if token.kind == "WORD" else None
        if name is not None and not (place.operator and knows(place.operator, token.name)):
            yield self._name(name)
        if place.path and token.kind == "STRING":
            return
        if place.operator is not None:
            yield self._keyword(place.operator, token.name)
        yield self.page(token.name)
        yield self._words(vocabulary.KINDS, token.name)

    # ---- the parts -------------------------------------------------------------------------------

    def _name(self, name: Occurrence) -> str:
        """Type of a name's value, and the statement that gives it."""
        first = self.document.names.definitions(name)[:1]
        if not first:
            return ""
        at = first[0]
        kind = self.findings.types.get(at.start, "")
        line = self.document.source.position(at.start)[0]
        told = teller(self.language)
        said = told(_NAMED[at.kind], line=line)
        text = self.document.source.text[at.whole.start : at.whole.end]
        shown = "\n".join(text.split("\n")[:8])
        return f"**{name.name}**{f' : {kind}' if kind else ''} ({said})\n\n{fenced(shown, 'ssi')}"

    def _keyword(self, operator: Operator, word: str) -> str:
        """What a keyword of an operator is, or a word of the vocabulary that it takes."""
        own = list(dict.fromkeys(_described(operator, word, self.language)))
        words = self._words(vocabulary.WORDS_OF.get(operator.name, ()), word)
        if not own:
            return words
        head = f"**'{word}'** : {operator.full_name}"
        return "\n\n".join(p for p in (head, fenced("\n".join(own)), words) if p)

    def page(self, word: str) -> str:
        """The page of an operator or procedure."""
        page = find_page(word, self.library.standard_files)
        if page is None or not (page.name == word.rstrip() or page.full_name.startswith(word)):
            return ""
        return markdown(page_text(page, self.language, whole=False))

    def _words(self, kinds: Iterable[str], word: str) -> str:
        found = [(k, w) for k in kinds for w in vocabulary.meanings(k, word)]
        return "\n\n---\n\n".join(
            markdown(vocabulary_text(k, w, self.language)) for k, w in found[:3]
        )


def entry_markdown(declaration: Declaration, entry: TableEntry, language: str) -> str:
    """An entry of a procedure's table: types, unit, default, allowed values, meaning."""
    told = teller(language)
    types = f" : {told('help.or').join(f' {t} ' for t in entry.types).strip()}"
    facts = [
        f"{told('help.unit').strip()} {entry.unit}" if entry.unit else "",
        _default(entry, language),
        " ".join(f"'{v}'" for v in entry.values),
    ]
    lines = [f"**{declaration.name} . '{entry.index}'**{types if entry.types else ''}", ""]
    lines.append(entry.said(language))
    shown = " ; ".join(f for f in facts if f)
    return "\n".join([*lines, "", shown] if shown else lines)


def _default(entry: TableEntry, language: str) -> str:
    value = entry.default
    if value is None:
        return ""
    said = value[language == "fr"] if isinstance(value, tuple) else str(value)
    return f"{teller(language)('help.default').strip()} {said}"


def _described(operator: Operator, word: str, language: str) -> Iterator[str]:
    for form in operator.forms:
        for entry in keywords_in(form.entries or ()):
            if any(_same(w, word, entry.length) for w in entry.words):
                yield from _lines_of(entry, word, language)


def _lines_of(entry: Keyword | Select, word: str, language: str) -> list[str]:
    if isinstance(entry, Keyword):
        return describe(entry, language)
    inner = [e for w, es in entry.cases.items() if _same(w, word, entry.length) for e in es]
    return [f"'{word}'", *(f"  {line}" for e in inner for line in describe(e, language))]


def _same(declared: str, word: str, length: int) -> bool:
    short, given = declared.rstrip(), word.rstrip()
    return given == short or (len(given) >= length and given[:length] == short[:length])


def markdown(page: str) -> str:
    """A page of help: its title, its first paragraph, and the rest as it is laid out."""
    title, _, rest = page.partition("\n")
    paragraph, _, rest = rest.strip("\n").partition("\n\n")
    parts = [f"**{title}**", " ".join(paragraph.split())]
    return "\n\n".join([*parts, fenced(rest.strip("\n"))] if rest.strip() else parts)


def fenced(text: str, kind: str = "text") -> str:
    """Text that keeps its layout."""
    return f"```{kind}\n{text}\n```"


def signatures(operator: Operator, typed: Iterable[str]) -> tuple[list[str], int]:
    """The lines of an operator's syntax, and which of them the typed words belong to."""
    lines = [line.strip() for line in operator.help.syntax.split("\n") if line.strip()]
    words = [w for w in typed if len(w) > 1]
    scores = [sum(f"'{w[:4]}" in line for w in words) for line in lines]
    return lines, scores.index(max(scores)) if scores else 0
