"""The help of operators and procedures as text: what INFO, `ssilang help` and the manual show."""

import re
import textwrap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from ssilang.language import registry
from ssilang.language.say.diagnostics import or_
from ssilang.language.text.source_files import read_source
from ssilang.language.vocabulary.entries import read_declaration
from ssilang.language.vocabulary.entries_table import bounds_told, entries_text, tables_text
from ssilang.messages.message import spoken, teller

WIDTH = 88
TABLE_WIDTH = 100


def family_text(family: str, language: str) -> str:
    """What a family of operators is called."""
    return teller(language)(f"help.family-{family}")


@dataclass(frozen=True, slots=True)
class Page:
    """One page of the reference: an operator or a procedure of the standard library."""

    name: str
    full_name: str
    kind: str  # 'operator' or 'procedure'
    family: str
    title: str
    help: registry.Help
    forms: tuple[tuple[registry.Entry, ...] | None, ...] = ()


def operator_page(found: registry.Operator) -> Page:
    """The page of an operator, from the registry."""
    forms = tuple(form.entries for form in found.forms)
    return Page(found.name, found.full_name, "operator", found.family, "", found.help, forms)


# ---- procedures: the comment at the head of their file is their help --------------------------


def procedure_page(path: Path) -> Page:
    """The page of a procedure, read from the comment lines at the head of its file.

    The head has a first line `* NAME : title`, indented lines of syntax, a paragraph that begins
    with `EN`, one with `FR`, and `Example :` followed by statements.
    """
    head = _head(read_source(path).text)
    title = head[0].split(":", 1)[1].strip() if head and ":" in head[0] else ""
    title = re.sub(r"\s*\(see also.*", "", title)
    parts: dict[str, list[str]] = {"syntax": [], "EN": [], "FR": [], "example": []}
    current = "syntax"
    for line in head[1:]:
        current = _sort_line(line, current, parts)
    examples = _even("\n".join(parts["example"]))
    help_ = registry.Help(
        " ".join(" ".join(parts["EN"]).split()),
        " ".join(" ".join(parts["FR"]).split()),
        _even("\n".join(line for line in parts["syntax"] if line.strip())),
        (examples,) if examples else (),
    )
    name = path.stem.upper()
    return Page(name, name, "procedure", "procedures", title, help_)


def _even(text: str) -> str:
    """Text without its common indentation; a first line that stands alone does not count."""
    first, _, rest = text.rstrip().partition("\n")
    if first.strip() and not first.startswith("    "):
        return "\n".join(p for p in (first.strip(), textwrap.dedent(rest)) if p)
    return textwrap.dedent(text).strip("\n").rstrip()


def _head(text: str) -> list[str]:
    lines = []
    for line in text.split("\n"):
        if not line.startswith("*"):
            break
        lines.append(line[1:])
    return lines


_MARK = re.compile(r"\s*(EN|FR|Example|Exemple|Examples)\b(\s*:)?\s?(.*)", re.IGNORECASE)


def _sort_line(line: str, current: str, parts: dict[str, list[str]]) -> str:
    """Put a line of the head where it belongs; returns the part that goes on."""
    found = _MARK.match(line)
    word = found.group(1) if found else ""
    if found and word in ("EN", "FR") and (found.group(2) or line.startswith((" EN", " FR"))):
        current, line = word, found.group(3)
    elif found and word.lower().startswith("ex") and found.group(2):
        current, line = "example", found.group(3)
    parts[current].append(line)
    return current


# ---- text ------------------------------------------------------------------------------------


def find_page(word: str, procedures: Mapping[str, Path]) -> Page | None:
    """The page that a user means: a procedure in full, else an operator by four letters."""
    word = word.upper().strip()
    if word in procedures:
        return procedure_page(procedures[word])
    found = registry.find_operator(word)
    return operator_page(found) if found is not None else None


def page_text(page: Page, language: str, whole: bool = True) -> str:
    """A page as plain text, at most `WIDTH` columns; `whole`: with the tables of its help."""
    kind = teller(language)(f"help.{page.kind}")
    title = page.title if language == "en" else ""
    full = f" ({page.full_name})" if page.full_name != page.name else ""
    lines = [f"{page.name}{full} : {title or kind} [{family_text(page.family, language)}]", ""]
    text = page.help.told(language)
    for paragraph in text.split("\n"):
        lines += textwrap.wrap(paragraph, WIDTH)
    if page.help.syntax:
        lines += ["", teller(language)("help.syntax")]
        lines += ["    " + line.rstrip() for line in page.help.syntax.split("\n")]
    arguments = _arguments(page, language)
    if arguments:
        lines += ["", teller(language)("help.arguments"), *arguments]
    declared = read_declaration(page.name)
    if declared is not None:
        lines += entries_text(declared, language, TABLE_WIDTH)
    for example in page.help.examples:
        lines += ["", teller(language)("help.example")]
        lines += ["    " + line for line in example_lines(example)]
    if whole and page.help.tables is not None:
        lines += tables_text(page.help.tables(language), TABLE_WIDTH)
    return "\n".join(lines)


_STATEMENT = re.compile(r"(?:'[^']*(?:''[^']*)*'|[^;'])*;\s*")


def example_lines(text: str) -> list[str]:
    """An example cut into lines of some whole statements each, where it is written in one."""
    if "\n" in text or len(text) <= WIDTH:
        return text.split("\n")
    statements = _STATEMENT.findall(text)
    if "".join(statements).strip() != text.strip():
        return [text]
    lines = [""]
    for statement in statements:
        if lines[-1] and len(lines[-1]) + len(statement.strip()) > WIDTH:
            lines.append("")
        lines[-1] += statement
    return [line.rstrip() for line in lines]


def _arguments(page: Page, language: str) -> list[str]:
    """Lines that say what each declared form reads."""
    lines: list[str] = []
    forms = [form for form in page.forms if form]
    for number, form in enumerate(forms, 1):
        if len(forms) > 1:
            lines.append(f"  {number}.")
        lines += [f"    {line}" for entry in form for line in describe(entry, language)]
    return lines


def describe(entry: registry.Entry, language: str = "en") -> list[str]:
    """Lines about an entry of a form: name or words, types, meaning, unit, default, inner ones."""
    note = _note(entry, language)
    match entry:
        case registry.Argument():
            return [f"{entry.name:<14} {_types(entry, language)}{_said(entry, language)}{note}"]
        case registry.Keyword():
            words = or_(language).join(f"'{w.strip()}'" for w in entry.words)
            values = "".join(
                f" {a.name}: {_types(a, language)}{_said(a, language)}" for a in entry.arguments
            )
            return [f"{words}{values}{_meaning(entry, language)}{note}"]
        case registry.Select():
            lines = [_meaning(entry, language).lstrip(": ")] if entry.en else []
            for word, inner in entry.cases.items():
                lines.append(f"'{word.strip()}'{note}")
                lines += _indented(inner, language)
            return lines
        case registry.Group():
            head = f"{entry.name}{_meaning(entry, language)}{note}"
            return [head, *_indented(entry.entries, language)]
        case registry.Either():
            lines = [f"{entry.name}{_meaning(entry, language)}{note}"]
            for n, one in enumerate(entry.groups):
                lines += [f"  {teller(language)('help.or')}"] if n else []
                lines += _indented(one.entries, language)
            return lines


def _indented(entries: Iterable[registry.Entry], language: str) -> list[str]:
    return [f"  {line}" for entry in entries for line in describe(entry, language)]


def _meaning(entry: registry.Entry, language: str) -> str:
    text = spoken(entry.en, entry.fr, language)
    return f": {text}" if text else ""


def _said(a: registry.Argument, language: str) -> str:
    """Meaning, unit and default of an operand."""
    unit = f" [{a.unit}]" if a.unit else ""
    default = f" (= {a.default})" if a.optional and a.default not in (None, ()) else ""
    bounds = [("", a.range), ("help.usual-range", a.usual)]
    told = [
        f"; {teller(language)(code) + ' ' if code else ''}{bound}"
        for code, b in bounds
        if (bound := bounds_told(b, a.name, language))
    ]
    return f"{_meaning(a, language)}{unit}{default}{''.join(told)}"


def _types(a: registry.Argument, language: str) -> str:
    if a.types == (registry.ANY,):
        return teller(language)("help.any-object")
    return or_(language).join(a.types)


def _note(entry: registry.Entry, language: str) -> str:
    """Whether an entry may miss or stand several times; of operands the one goes without saying."""
    repeated = not isinstance(entry, registry.Either) and entry.repeated
    several = repeated and isinstance(entry, registry.Argument | registry.Group)
    optional = entry.optional and not several
    codes = ["help.optional"] * optional + ["help.several"] * repeated
    return f"  ({', '.join(map(teller(language), codes))})" if codes else ""


def first_sentence(text: str) -> str:
    """What a list of operators says about one."""
    found = re.match(r"(.+?[.;:])(\s|$)", text.replace("\n", " "))
    return (found.group(1) if found else text).rstrip(".;:")


def overview(procedures: Iterable[Path], language: str) -> str:
    """All operators by family and all procedures, a line each."""
    lines: list[str] = []
    for family, members in registry.operators_by_family().items():
        lines += ["", family_text(family, language).upper()]
        for found in members:
            text = found.help.told(language)
            lines.append(_entry_line(found.name, text))
    lines += ["", family_text("procedures", language).upper()]
    for path in sorted(procedures):
        page = procedure_page(path)
        lines.append(_entry_line(page.name, page.help.told(language)))
    return "\n".join(lines[1:])


def _entry_line(name: str, text: str) -> str:
    return textwrap.shorten(f"{name:<10} {first_sentence(text)}", 100, placeholder=" ...").replace(
        name, f"  {name:<9}", 1
    )


def page_names(procedures: Iterable[str]) -> set[str]:
    """All names that help knows."""
    full = {o.full_name for o in registry.OPERATORS.values()}
    return {*registry.OPERATORS, *full, *procedures}
