"""Writes the operator reference and the coverage table from the registry.

    python docs/build.py [FOLDER]        (default docs/reference)

The pages are made, not kept: the repository has what they are made from. One page an operator and a
procedure: syntax, arguments, help, each example with what it printed
when it ran here, and the pictures it drew. `index.md` lists them by family, `coverage.md` says of
every word of Cast3M whether it is built, `ranges.md` which numbers entries and operands take,
`published.md` what the decks of `cases/published` obtain.
"""

import math
import re
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ssilang.cli.run import RunOptions, run_file, run_text
from ssilang.language.cast3m import IN_SCOPE, Cast3mWord, cast3m_words
from ssilang.language.registry import (
    OPERATORS,
    Argument,
    HelpTable,
    arguments_in,
    operators_by_family,
)
from ssilang.language.run.library import standard_procedures
from ssilang.language.say.reference import (
    Page,
    describe,
    example_lines,
    first_sentence,
    operator_page,
    procedure_page,
)
from ssilang.language.vocabulary.entries import (
    Declaration,
    TableEntry,
    declared_names,
    read_declaration,
)
from ssilang.language.vocabulary.entries_table import (
    blocks_of,
    bounds_told,
    heads_of,
    title_of,
)
from ssilang.messages.message import teller
from ssilang.operators.loader import load_operators

_HERE = Path(__file__).resolve().parent
_LINES_SHOWN = 40
WITHOUT_EXAMPLE = "without an example:"
_SIGNS = {
    "+": "sign_plus", "-": "sign_minus", "*": "sign_times", "/": "sign_divide", "**": "sign_power",
    "<": "sign_less", ">": "sign_greater", "<EG": "sign_less_equal", ">EG": "sign_greater_equal",
}  # fmt: skip


@dataclass
class Ran:
    """An example that was run: what it printed, what it drew, what went wrong."""

    text: str
    output: str = ""
    message: str = ""
    pictures: list[Path] = field(default_factory=list)


def run_example(text: str, folder: Path) -> Ran:
    """Run an example in a folder of its own."""
    result = run_text(text, options=RunOptions(output_directory=folder, language="en"))
    pictures = sorted(p for p in folder.rglob("*") if p.suffix in (".png", ".svg"))
    kept = [p for p in pictures if p.suffix == ".png"] or pictures
    return Ran(text, result.output.rstrip("\n"), result.message, kept)


def file_name(name: str) -> str:
    """Name of the page's file: signs have words."""
    return _SIGNS.get(name, name.replace("@", "at_").lower()) + ".md"


def all_pages() -> list[Page]:
    """Pages of all operators, then of all procedures."""
    load_operators()
    members = [o for group in operators_by_family().values() for o in group]
    return [operator_page(o) for o in members] + [
        procedure_page(p) for p in standard_procedures().values()
    ]


def page_markdown(page: Page, examples: Iterable[Ran]) -> str:
    """The page of one operator or procedure."""
    full = f" ({page.full_name})" if page.full_name != page.name else ""
    lines = [f"# {page.name}{full}", "", f"*{page.kind}, {page.family}*", ""]
    lines += [paragraph + "\n" for paragraph in page.help.en.split("\n")]
    if page.help.syntax:
        syntax = [line.rstrip() for line in page.help.syntax.split("\n")]
        lines += ["## Syntax", "", "```", *syntax, "```", ""]
    lines += _arguments(page)
    declared = read_declaration(page.name)
    lines += [] if declared is None else entries_markdown(declared, "en")
    for ran in examples:
        lines += _example(ran)
    lines += _tables(page, "en")
    lines += ["## En français", "", page.help.fr.replace("\n", "\n\n"), ""]
    lines += [] if declared is None else entries_markdown(declared, "fr")
    lines += _tables(page, "fr")
    return "\n".join(lines)


def entries_markdown(declared: Declaration, language: str) -> list[str]:
    """The entries of all tables of a procedure as tables of Markdown."""
    lines: list[str] = []
    for argument in declared.arguments:
        blocks = list(blocks_of(declared, argument.name, language))
        if not blocks:
            continue
        lines += [f"## {title_of(declared, argument.name, language)}", ""]
        for theme, rows in blocks:
            lines += [f"### {teller(language)(f'help.theme-{theme}')}", ""]
            lines += _markdown(heads_of(language), rows)
    return lines


def tables_markdown(tables: Sequence[HelpTable]) -> list[str]:
    """Tables of the same columns as Markdown."""
    lines: list[str] = []
    for table in tables:
        lines += [f"### {table.title}", "", *([f"{table.note}.", ""] if table.note else [])]
        lines += _markdown(table.heads, table.rows) if table.rows else []
    return lines


def _markdown(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """A table whose first column names."""
    lines = ["| " + " | ".join(heads) + " |", "| --- " * len(heads) + "|"]
    for row in rows:
        cells = [" ".join(cell.split()).replace("|", "\\|") for cell in row]
        lines.append("| " + " | ".join([f"`{cells[0]}`", *cells[1:]]) + " |")
    return [*lines, ""]


def _tables(page: Page, language: str) -> list[str]:
    """What the operator has declared elsewhere."""
    return [] if page.help.tables is None else tables_markdown(page.help.tables(language))


def _arguments(page: Page) -> list[str]:
    forms = [form for form in page.forms if form]
    if not forms:
        return []
    lines = ["## Arguments", ""]
    for number, form in enumerate(forms, 1):
        lines += [f"Form {number}:", ""] if len(forms) > 1 else []
        said = [line for entry in form for line in describe(entry)]
        lines += [f"- `{' '.join(line.split())}`" for line in said] + [""]
    return lines


def _example(ran: Ran) -> list[str]:
    lines = ["## Example", "", "```", *example_lines(ran.text), "```", ""]
    if ran.output:
        shown = ran.output.split("\n")
        more = ["..."] if len(shown) > _LINES_SHOWN else []
        lines += ["prints", "", "```", *shown[:_LINES_SHOWN], *more, "```", ""]
    return lines + [f"![{p.stem}](pictures/{p.name})\n" for p in ran.pictures]


def index_markdown(pages: Iterable[Page]) -> str:
    """All pages by family."""
    families: dict[str, list[Page]] = {}
    for page in pages:
        families.setdefault(page.family, []).append(page)
    lines = ["# Operators and procedures", ""]
    for family, members in sorted(families.items()):
        lines += [f"## {family}", "", "| name | what it does |", "| --- | --- |"]
        for page in sorted(members, key=lambda p: p.name):
            text = first_sentence(page.help.en).replace("|", "\\|")
            lines.append(f"| [`{page.name}`]({file_name(page.name)}) | {text} |")
        lines.append("")
    return "\n".join(lines)


# ---- coverage --------------------------------------------------------------------------------

CONTROL = {"SI", "SINO", "FINS", "REPE", "DEBP", "FINP", "DEBM", "FINM", "TEXT", "COMM"}
"""Words that the evaluator itself knows."""


def partly_built() -> dict[str, str]:
    """Operators of which something is not built or not tried, with what it is (`partly.txt`)."""
    found: dict[str, str] = {}
    for line in (_HERE / "partly.txt").read_text(encoding="utf-8").split("\n"):
        if line.strip() and not line.startswith("#"):
            name, _, text = line.partition(":")
            found[name.strip()] = text.strip()
    return found


def untried(remark: str) -> list[str]:
    """Forms ('2') and words of forms ('2 MAXI') that a remark says no example runs."""
    listed = remark.partition(WITHOUT_EXAMPLE)[2]
    return [part.strip() for part in listed.split(",") if part.strip()]


def status(word: Cast3mWord, built: set[str], partly: dict[str, str]) -> tuple[str, str]:
    """Whether a word of Cast3M is built, and a remark: what is missing, or why it is not built."""
    if word.name in built:
        return ("partly", partly[word.name]) if word.name in partly else ("built", "")
    if word.subject == IN_SCOPE:
        return "not built", teller("en")(f"help.reason-{word.reason}")
    return "out of scope", teller("en")(f"help.subject-{word.subject}")


def coverage_markdown() -> str:
    """The table of every word of Cast3M."""
    load_operators()
    built = {*OPERATORS, *standard_procedures(), *CONTROL}
    partly = partly_built()
    words = cast3m_words()
    lines = ["# What is built of Cast3M", "",
             "Names are those of Cast3M's public documentation. *built*: every form of the notice "
             "that belongs to mechanics, and of an operator each one runs in an example of its "
             "page, with every word that chooses what is read; *partly*: the remark says what is "
             "missing, or which forms, by their number, no example tries; *not built*: "
             "belongs here and does not exist (the remark says why); *out of scope*: another "
             "subject. `python docs/build.py` writes this table.", ""]  # fmt: skip
    for kind in ("operator", "procedure"):
        chosen = [w for w in words.values() if w.kind == kind]
        rows = {w.name: status(w, built, partly) for w in chosen}
        lines += [f"## {kind.capitalize()}s", "", *_counts(rows), ""]
        lines += ["| name | state | remark |", "| --- | --- | --- |"]
        for name, (state, remark) in sorted(rows.items()):
            if kind == "procedure" and state == "out of scope":
                continue
            lines.append(f"| `{name}` | {state} | {remark} |")
        lines.append("")
    lines += ["## Ours, not Cast3M's", ""]
    own = sorted(built - set(words) - {n for o in OPERATORS.values() for n in o.aliases})
    lines += [", ".join(f"`{n}`" for n in own), ""]
    return "\n".join(lines)


def _counts(rows: dict[str, tuple[str, str]]) -> list[str]:
    states = ("built", "partly", "not built", "out of scope")
    count = {s: sum(state == s for state, _ in rows.values()) for s in states}
    return [f"{len(rows)} in all: " + ", ".join(f"{n} {s}" for s, n in count.items()) + "."]


# ---- published cases -----------------------------------------------------------------------------


def published_markdown(decks: Iterable[Path]) -> str:
    """Decks whose references were computed elsewhere: each check with its error, and the time."""
    lines = ["# Published cases", "",
             "References that nobody here computed; each deck names its source, and what it should "
             "reach. `python docs/build.py` runs them and writes this table; times are those of a "
             "run in this process.", "",
             "| deck | check | published | obtained | error | time |",
             "| --- | --- | --- | --- | --- | --- |"]  # fmt: skip
    for deck in decks:
        begun = time.perf_counter()
        with tempfile.TemporaryDirectory() as folder:
            options = RunOptions(output_directory=Path(folder), language="en")
            result = run_file(deck, options=options)
        spent = f"{time.perf_counter() - begun:.1f} s"
        if result.exit_code:
            spent = "**fails**"
        for number, check in enumerate(result.session.checks):
            if check.expected is None:
                continue
            error = abs(check.value - check.expected) / (abs(check.expected) or 1.0)
            row = f"{check.expected:.6g} | {check.value:.6g} | {error:.1e}"
            lines.append(
                f"| {'' if number else f'`{deck.stem}`'} | {check.name} | {row} | "
                f"{'' if number else spent} |"
            )
    return "\n".join([*lines, ""])


# ---- writing ---------------------------------------------------------------------------------


_TRIED = (math.nan, math.inf, -1e300, -1.0, 0.0, 0.3, 1.0, 91.0, 1e300)


def ranges_markdown() -> str:
    """Numbers that entries of tables and operands take: range, what is usual, what is told."""
    counts: Counter[str] = Counter()
    rows = []
    for where, index, one in _numbers():
        bounds = [bounds_told(b, index, "en") for b in (one.range, one.usual)]
        counts["range" if bounds[0] else "usual" if bounds[1] else "any"] += 1
        refused = [v for v in _TRIED if one.range.flaw(v, index)]
        odd = [v for v in _TRIED if v not in refused and one.usual.flaw(v, index)]
        counts["refused"] += len(refused)
        counts["told"] += len(odd)
        counts["tried"] += len(_TRIED)
        shown = [" ".join(f"{v:g}" for v in wrong) for wrong in (refused, odd)]
        any_number = "" if any(bounds) else "any"
        rows.append(f"| {where} | {bounds[0] or any_number} | {bounds[1]} | {' | '.join(shown)} |")
    total, inside = len(rows), counts["tried"] - counts["refused"] - counts["told"]
    head = (
        "# Ranges of numbers\n\nWhat makes sense is declared of every number that an entry of a "
        "table or an operand takes: what is outside of the range is refused, outside of what is "
        "usual told. Infinite numbers and what is no number lie outside of every range.\n\n"
        "| numbers that are taken | with a range | with what is usual alone | any number |\n"
        "| --- | --- | --- | --- |\n"
        f"| {total} | {counts['range']} | {counts['usual']} | {counts['any']} |\n\n"
        f"| tried, {len(_TRIED)} on each | refused | told | in range |\n| --- | --- | --- | --- |\n"
        f"| {counts['tried']} | {counts['refused']} | {counts['told']} | {inside} |\n\n"
        "Parameters of materials have theirs on the pages of MATE.\n\n"
        "| entry | range | usual | refused of what was tried | told |\n"
        "| --- | --- | --- | --- | --- |\n"
    )
    return head + "\n".join(rows) + "\n"


def _numbers() -> Iterator[tuple[str, str, TableEntry | Argument]]:
    """Entries and operands that are numbers or lists of them, with where they stand."""
    kinds = {"FLOTTANT", "ENTIER", "LISTREEL", "LISTENTI"}
    for name in declared_names():
        declared = read_declaration(name)
        for e in declared.entries if declared is not None else ():
            if e.is_read and kinds & set(e.types):
                yield f"`{name}` {' . '.join(e.path)}", e.index, e
    seen: set[tuple[str, int]] = set()
    for o in (o for group in operators_by_family().values() for o in group):
        for a in (a for form in o.forms for a in arguments_in(form.entries or ())):
            if kinds & set(a.types) and (o.name, id(a)) not in seen:
                seen.add((o.name, id(a)))
                yield f"`{o.name}` {a.name}", a.name, a


def build(target: Path, only: Collection[str] = ()) -> list[str]:
    """Write everything below `target`; returns the examples that failed.

    Parameters
    ----------
    only : collection of str, optional
        Operators and procedures that get a page, all if none is named.
    """
    pages = [p for p in all_pages() if not only or p.name in only]
    pictures = target / "pictures"
    shutil.rmtree(target, ignore_errors=True)
    pictures.mkdir(parents=True)
    failed = []
    for page in pages:
        examples = []
        for number, text in enumerate(page.help.examples, 1):
            with tempfile.TemporaryDirectory() as folder:
                ran = run_example(text, Path(folder))
                ran.pictures = _kept(page, number, ran.pictures, pictures)
            examples.append(ran)
            if ran.message:
                failed.append(f"{page.name}: {ran.message}")
        text = page_markdown(page, examples)
        (target / file_name(page.name)).write_text(text, encoding="utf-8")
    (target / "index.md").write_text(index_markdown(pages), encoding="utf-8")
    (target / "coverage.md").write_text(coverage_markdown(), encoding="utf-8")
    (target / "ranges.md").write_text(ranges_markdown(), encoding="utf-8")
    return failed


def _kept(page: Page, number: int, found: list[Path], pictures: Path) -> list[Path]:
    """Copies of an example's pictures under names of their own."""
    kept = []
    stem = re.sub(r"\.md$", "", file_name(page.name))
    for i, path in enumerate(found):
        copy = pictures / f"{stem}_{number}{'abcdefgh'[i % 8]}{path.suffix}"
        shutil.copy(path, copy)
        kept.append(copy)
    return kept


def main() -> int:
    """Build the reference; exit code 1 if an example failed."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else _HERE / "reference"
    failed = build(target)
    decks = sorted((_HERE.parent / "cases" / "published").glob("*.ssi"))
    (target / "published.md").write_text(published_markdown(decks), encoding="utf-8")
    for text in failed:
        print(text)
    print(f"{len(list(target.glob('*.md')))} pages in {target}, {len(failed)} examples failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
