"""What help says of a word: its page, all its meanings, or what a search finds."""

import re
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from functools import cache

from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.matrices.matrix import PRIMAL_TO_DUAL
from ssilang.language import vocabulary
from ssilang.language.registry import OPERATORS, keywords_of
from ssilang.language.run.library import standard_procedures
from ssilang.language.say import reference
from ssilang.language.search import Item, nearest, search
from ssilang.language.vocabulary.examples import example
from ssilang.language.vocabulary.terms import Option, Quantity, Word
from ssilang.messages.message import teller
from ssilang.operators.vocabulary import words
from ssilang.resources import resource

_SHOWN = 20  # lines of a search

# ---- the page of a word of the vocabulary -------------------------------------------------------


def vocabulary_text(kind: str, word: Word, language: str) -> str:
    """The page of one meaning of a word."""
    lines = [f"{word.name} : {label(kind, word, language)}", ""]
    lines += textwrap.wrap(word.meaning(language) + ".", reference.WIDTH)
    for part in _PARTS.get(kind, lambda *_: [])(word, language):
        lines += ["", *part] if isinstance(part, list) else [part]
    shown = example(kind, word)
    if kind == "parameter":
        examples = (example(_kind_of(owner), owner) for owner, _ in _owners(word))
        shown = next((e for e in examples if f"'{word.name}'" in e), "")
    if shown:
        lines += ["", teller(language)("help.example")]
        lines += ["    " + line for line in shown.split("\n")]
    see = _see_also(kind, word)
    if see:
        lines += ["", *_filled(teller(language)("help.see"), see)]
    return "\n".join(lines)


def label(kind: str, word: Word, language: str) -> str:
    """What sort of a word it is: 'law of joints'."""
    return teller(language)(label_code(kind, word), option=" ".join(word.of))


def label_code(kind: str, word: Word) -> str:
    """Where it stands in the catalogue what sort of a word it is."""
    more = f"-{word.kind.replace(' ', '-')}" if word.kind and kind != "parameter" else ""
    return f"help.word-{kind}{more}"


def _filled(head: str, names: Iterable[str]) -> list[str]:
    """A head with a list of names, wrapped under themselves."""
    text = " ".join(names)
    return (
        textwrap.wrap(f"{head:<14}{text}", reference.WIDTH, subsequent_indent=" " * 14)
        if text
        else []
    )


def _law(law: Word, language: str) -> Iterator[str | list[str]]:
    zone = words.sample_of_law(law)
    head = _filled(teller(language)("help.elements"), words.elements_of_law(law))
    if head:
        yield head
    if zone is not None:
        yield _table(words.parameter_rows(zone), language)


def _element(element: Word, language: str) -> Iterator[str | list[str]]:
    name = element.name
    lines = _filled(teller(language)("help.cells"), words.cells_of(name))
    if name not in ELEMENTS:
        yield lines
        return
    for part in words.components_of(name):
        modes = ", ".join(m.value for m in part.modes)
        lines += _filled(teller(language)("help.hypotheses"), [modes])
        lines += _filled("  " + teller(language)("help.unknowns"), part.unknowns)
        lines += _filled("  " + teller(language)("help.strains"), part.strains)
        lines += _filled("  " + teller(language)("help.stresses"), part.stresses)
    lines += _filled(teller(language)("help.laws"), [", ".join(words.laws_of(name))])
    yield lines
    zone = list(words.samples_of_element(name))[-1]
    yield _table(words.parameter_rows(zone, section=True), language)


def _table(rows: Sequence[words.Row], language: str) -> list[str]:
    """Name, unit, default, range and meaning of parameters."""
    used = [r for r in rows if not r.word.kind]
    lines = [teller(language)("help.parameters")] if used else []
    for row in used:
        default = default_told(row, language) or "-"
        span = row.word.range.text(row.word.name)
        head = f"    {row.word.name:<5} {row.word.unit or '-':<7} {default:<11} {span:<20} "
        lines += textwrap.wrap(
            head + row.word.meaning(language), 100, subsequent_indent=" " * len(head)
        )
    for kind, code in ((words.AXES, "help.axes"), (words.UNUSED, "help.unused")):
        names = [r.word.name for r in rows if r.word.kind == kind]
        lines += [f"    {teller(language)(code)} : {' '.join(names)}"] if names else []
    return lines


def default_told(row: words.Row, language: str) -> str:
    """What counts where a parameter is not given: it is required, a number, or '' for neither."""
    if row.required:
        return teller(language)("help.required")
    return "" if row.default is None else _number(row.default)


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:g}"


def _owners(parameter: Word) -> list[tuple[Word, Quantity]]:
    return [(o, w) for o, w in words.owners(parameter.name) if w is parameter]


def _kind_of(word: Word) -> str:
    return "law" if word in vocabulary.words("law") else "element"


def _parameter(word: Word, language: str) -> Iterator[str | list[str]]:
    assert isinstance(word, Quantity)
    facts = [
        ("help.unit", "-" if word.unit is None else word.unit or "1"),
        ("help.default", _number(word.default)),
        ("help.range", word.range.text(word.name) or "-"),
        ("help.usual", word.usual.text(word.name)),
    ]
    lines = [f"{teller(language)(key):<14}{value}" for key, value in facts if value]
    owners = [o for o, _ in _owners(word)]
    lines += _filled(
        teller(language)("help.of-laws"), [o.name for o in owners if _kind_of(o) == "law"]
    )
    elements = [o.name for o in owners if _kind_of(o) == "element"]
    yield lines + _filled(teller(language)("help.of-elements"), elements)


def _component(word: Word, language: str) -> Iterator[str | list[str]]:
    assert isinstance(word, Quantity)
    lines = (
        [f"{teller(language)('help.unit'):<14}{word.unit or '1'}"] if word.unit is not None else []
    )
    dual = {**{d: p for p, d in PRIMAL_TO_DUAL.items()}, **PRIMAL_TO_DUAL}.get(word.name)
    lines += _filled(teller(language)("help.dual"), [dual] if dual else [])
    owners = [e for e in words.elements_with(word.name) if _means(e, word)]
    yield lines + _filled(teller(language)("help.of-elements"), owners)


def _means(element: str, word: Word) -> bool:
    """Whether a component has this meaning at an element."""
    owners = (element, ELEMENTS[element].family)
    return vocabulary.find("component", word.name, owners) is word


def _option(word: Word, language: str) -> Iterator[str | list[str]]:
    assert isinstance(word, Option)
    facts = [("help.takes", word.takes), ("help.default", word.default)]
    lines = [f"{teller(language)(key):<14}{value}" for key, value in facts if value]
    if lines:
        yield lines
    if word.values:
        told = [f"    {v.name:<9} {v.meaning(language)}" for v in word.values]
        yield [teller(language)("help.values"), *told]


def _formulation(word: Word, language: str) -> Iterator[str | list[str]]:
    kinds = {"CONTACT": ("contact",), "CHARGEMENT": ("load",), "LIAISON": ("link",)}.get(
        word.name, words.OF_BODIES
    )
    laws = dict.fromkeys(w.name for w in vocabulary.words("law") if w.kind in kinds)
    yield _filled(teller(language)("help.laws"), laws)


_PARTS = {
    "law": _law,
    "element": _element,
    "parameter": _parameter,
    "component": _component,
    "option": _option,
    "formulation": _formulation,
}


def _see_also(kind: str, word: Word) -> list[str]:
    """Operators, neighbours, pages of the manual that name the word."""
    operators = {"option": ["OPTI", "VALE"], "value": ["OPTI"], "component": ["EXCO"],
                 "structure": ["FIN", "QUIT", "ITER", "ARGU"]}  # fmt: skip
    found = operators.get(kind, ["MODE", "MATE"])
    if kind in ("law", "element") and word.kind:
        alike = [w.name for w in vocabulary.words(kind) if w.kind == word.kind and w is not word]
        found = [*found, *dict.fromkeys(alike[:8])]
    pattern = re.compile(rf"\b{re.escape(word.name)}\b")
    return [*found, *(n for n, text in _manual() if word.name in text and pattern.search(text))]


# ---- everything that help knows --------------------------------------------------------------


@cache
def _manual() -> tuple[tuple[str, str], ...]:
    """Pages of the manual by their path, where they are installed, without what is generated."""
    try:
        folder = resource("docs")
    except FileNotFoundError:
        return ()
    pages = sorted(folder.glob("*.md"))
    return tuple((f"docs/{p.name}", p.read_text(encoding="utf-8")) for p in pages)


def items(language: str) -> Iterator[Item]:
    """Operators, procedures, words and pages of the manual."""
    known = standard_procedures()
    made = [reference.operator_page(o) for name, o in sorted(OPERATORS.items()) if o.name == name]
    for page in made + [reference.procedure_page(known[name]) for name in sorted(known)]:
        own = page.help.told(language)
        whole = f"{page.full_name} {page.title} {page.help.en} {page.help.fr} {page.help.syntax}"
        yield Item(
            page.name, teller(language)(f"help.{page.kind}"), reference.first_sentence(own), whole
        )
    for kind in vocabulary.KINDS:
        for word in vocabulary.words(kind):
            meaning = words.described(word, language)
            yield Item(word.name, label(kind, word, language), meaning, f"{word.en} {word.fr}")
    for path, text in _manual():
        for part in re.split(r"(?m)^(?=#+ )", text):
            title = part.partition("\n")[0].lstrip("# ").strip()
            if title:
                yield Item(path, "", title, part)


def exact_pages(word: str, language: str) -> list[str]:
    """The pages of an operator or procedure and of all words that are named so.

    A word of the everyday language ('contact') is searched besides.
    """
    said = word.upper().strip()
    page = reference.find_page(said, standard_procedures())
    pages = []
    if page is not None and (said in _names(page) or page.full_name.startswith(said)):
        pages.append(reference.page_text(page, language))
    for kind, found in vocabulary.all_meanings(said):
        if found.name.startswith(said):
            pages.append(vocabulary_text(kind, found, language))
    known = [o for name, o in sorted(OPERATORS.items()) if o.name == name]
    readers = [o.name for o in known if said in keywords_of(o)]
    if readers:
        pages.append("\n".join(_filled(f"{said} : {teller(language)('help.keyword')} ", readers)))
    if pages and len(said) > vocabulary.SHORT and said.isalpha():
        pages.append(found_text(word, language))
    return [p for p in pages if p]


def _names(page: reference.Page) -> tuple[str, ...]:
    aliases = OPERATORS[page.name].aliases if page.name in OPERATORS else ()
    return (page.name, page.full_name, *aliases)


def found_text(query: str, language: str) -> str:
    """A line for each thing that a search finds, '' if there is none."""
    lines: dict[tuple[str, str], str] = {}
    for item in search(query, items(language)):
        kind = f"[{item.label}] " if item.label else ""
        text = textwrap.shorten(kind + item.summary, 80, placeholder=" ...")
        lines.setdefault((item.name, item.label), f"  {item.name:<17} {text}")
    if not lines:
        return ""
    head, shown = teller(language)("help.found", query=query.strip()), list(lines.values())[:_SHOWN]
    left = len(lines) - len(shown)
    more = [f"  {teller(language)('help.more', count=left)}"] if left else []
    return "\n".join([head, *shown, *more])


def help_text(word: str, language: str) -> str:
    """What help says of a word: its pages, else what a search finds; '' if nothing."""
    return "\n\n".join(exact_pages(word, language)) or found_text(word, language)


def near_name(word: str) -> str:
    """The known name that looks most like a word, '' if none does."""
    known: set[str] = reference.page_names(standard_procedures())
    return nearest(word, known.union(*(vocabulary.names(kind) for kind in vocabulary.KINDS)))
