"""Makes the web pages: guides, gallery of decks, operators with what they print and draw, search.

    pip install '.[docs]' && python docs/web_pages.py [FOLDER]     (default site/)

Pages are laid out as the repository is, so that its links hold, and MkDocs makes a site of them
that opens from the disk, too. What the repository does not keep is made: a page a deck (`gallery`),
the operators and procedures (`build.py`). MkDocs refuses a link or an anchor that leads nowhere.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

_HERE = Path(__file__).resolve().parent
_ROOT = _HERE.parent
_KEPT = (
    "*.md", "docs/*.md", "docs/*.ipynb", "docs/fr/*.md", "docs/pictures/*.png",
    "cases/*.md", "cases/*/*.md", "cases/*/pictures/*.png", "benchmarks/*.md",
    "benchmarks/pictures/*.png", "editors/vscode/README.md",
)  # fmt: skip
_LINES_OF_A_HEAD = 10
_SIGN = re.compile(r"([\\`*_<>\[\]])")  # says something to Markdown, and is plain text in a head

_CONFIG = """\
site_name: ssilang
site_description: A Gibiane interpreter for soil-structure interaction with foundation uplift
docs_dir: pages
site_dir: {target}
use_directory_urls: false
theme:
  name: material
  font: false
  features:
    [navigation.tabs, navigation.indexes, navigation.prune, content.code.copy, search.suggest]
  palette:
    - {{media: "(prefers-color-scheme: light)", scheme: default}}
    - {{media: "(prefers-color-scheme: dark)", scheme: slate}}
plugins:
  - search: {{lang: [en, fr]}}
markdown_extensions:
  [attr_list, md_in_html, tables, {{toc: {{permalink: true}}}}, pymdownx.superfences]
validation: {{links: {{not_found: warn, anchors: warn, unrecognized_links: warn}}}}
nav:
{nav}
"""

_GUIDES: tuple[tuple[str, tuple[tuple[str, str], ...]], ...] = (
    ("Learn", (
        ("The language", "docs/language.md"), ("Uplift", "docs/uplift.md"),
        ("Meshes of others", "docs/meshes.md"), ("Sweeps", "docs/sweep.md"),
        ("Suites of records", "docs/suites.md"),
        ("Editor", "docs/editor.md"), ("Python", "docs/python.md"),
        ("Notebooks", "docs/jupyter.md"), ("Report", "docs/report.md"), ("PETSc", "docs/petsc.md"),
    )),
    ("Questions", (("Questions", "docs/faq.md"),)),
    ("Physics", (
        ("The equations", "docs/physics.md"), ("Plastic bodies", "docs/laws.md"),
        ("When it matters", "docs/matter.md"), ("Waves and edges", "docs/waves.md"),
    )),
    ("Others", (("OpenSees", "docs/opensees.md"), ("Cast3M", "docs/differences.md"))),
    ("Français", (
        ("Présentation", "docs/fr/README.md"), ("Le langage", "docs/fr/language.md"),
        ("Le décollement", "docs/fr/uplift.md"), ("Questions", "docs/fr/faq.md"),
        ("Quand l'interaction compte", "docs/fr/matter.md"),
        ("Ondes et bords", "docs/fr/waves.md"),
    )),
    ("Inside", (
        ("The house", "docs/architecture.md"), ("Contributing", "CONTRIBUTING.md"),
        ("Adding an operator", "docs/adding_an_operator.md"),
        ("Adding a joint law", "docs/adding_a_joint_law.md"),
        ("Adding a time scheme", "docs/adding_a_time_scheme.md"),
        ("Adding an output format", "docs/adding_an_output_format.md"),
        ("Adding a message", "docs/adding_a_message.md"),
        ("Speed", "benchmarks/README.md"), ("Changes", "CHANGELOG.md"),
    )),
)  # fmt: skip


@dataclass(frozen=True)
class Deck:
    """A deck of `cases/`.

    Attributes
    ----------
    place : str
        Theme and name: 'footing/strip_uplift'.
    title : str
        First line of its head.
    head, text : str
        The head's text without its stars, and the whole deck.
    pictures : tuple of Path
    """

    place: str
    title: str
    head: str
    text: str
    pictures: tuple[Path, ...]


def decks() -> list[Deck]:
    """The decks of `cases/` with the pictures that `make_pictures.py` keeps of them."""
    shown = _module(_ROOT / "cases" / "make_pictures.py").PICTURES
    found = []
    for path in sorted((_ROOT / "cases").glob("*/*.ssi")):
        place = f"{path.parent.name}/{path.stem}"
        text = path.read_text(encoding="utf-8")
        lines = [line[1:] for line in text.split("\n\n")[0].splitlines() if line.startswith("*")]
        head = "\n".join(line.removeprefix(" ") for line in lines if set(line.strip()) != {"="})
        names = shown.get(place, {}).values()
        pictures = tuple(path.parent / "pictures" / f"{name}.png" for name in names)
        found.append(Deck(place, lines[0].strip(), head, text, pictures))
    return found


def _module(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules.setdefault(path.stem, module)
    spec.loader.exec_module(module)
    return module


def deck_markdown(deck: Deck) -> str:
    """The page of a deck: pictures, what its head says, the text."""
    name = deck.place.partition("/")[2]
    head = deck.head.split("\n", 1)[-1].strip("\n")
    pictures = "\n".join(f"![{deck.title}](pictures/{p.name})" for p in deck.pictures)
    return "\n\n".join([
        f"# {deck.title}", pictures, f"```text\n{head}\n```",
        f"`ssilang cases/{deck.place}.ssi` runs it; files go to `results/{name}/`.",
        f"## The deck\n\n```text\n{deck.text.rstrip()}\n```\n",
    ])  # fmt: skip


def gallery_markdown(found: Sequence[Deck]) -> str:
    """All decks: picture, title and the first lines of what each says of itself."""
    lines = ["# Gallery", "", "Decks that check themselves against exact solutions. Each page has "
             "the whole deck; [the table](README.md) has their errors and times.", ""]  # fmt: skip
    for deck in found:
        lines += [f"## {deck.title}", ""]
        if deck.pictures:
            lines += [f"[![{deck.title}]({deck.place.split('/')[0]}/pictures/"
                      f"{deck.pictures[0].name}){{ width=420 }}]({deck.place}.md)", ""]  # fmt: skip
        said = [t for t in re.split(r"\n\s*\n", deck.head) if re.match(r"[A-Z]\w+\. ", t)]
        told = "\n\n".join(said).split("\n")[: _LINES_OF_A_HEAD + len(said) - 1]
        lines += [_SIGN.sub(r"\\\1", "\n".join(told)), "", f"[The deck]({deck.place}.md)", ""]
    return "\n".join(lines)


def with_mathml(text: str) -> str:
    """A page whose formulas, written as on GitHub, are MathML: browsers draw it by themselves."""
    from latex2mathml.converter import convert

    def block(match: re.Match[str]) -> str:
        # on a phone a long one scrolls by itself, and not the page
        return f'<div style="overflow-x: auto">{convert(match[1].strip(), display="block")}</div>'

    text = re.sub(r"^\$\$\n(.*?)^\$\$$", block, text, flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"\$([^$\n]+)\$", lambda m: convert(m[1]), text)


def stage(pages: Path, only: Collection[str] = ()) -> None:
    """Lay out all pages below a folder.

    Parameters
    ----------
    only : collection of str, optional
        Operators and procedures that get a page, all if none is named.
    """
    for pattern in _KEPT:
        for path in _ROOT.glob(pattern):
            target = pages / path.relative_to(_ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)
    equations = pages / "docs" / "physics.md"
    equations.write_text(with_mathml(equations.read_text(encoding="utf-8")), encoding="utf-8")
    found = decks()
    for deck in found:
        (pages / "cases" / f"{deck.place}.md").write_text(deck_markdown(deck), encoding="utf-8")
    (pages / "cases" / "gallery.md").write_text(gallery_markdown(found), encoding="utf-8")
    build = _module(_HERE / "build.py")
    failed = build.build(pages / "docs" / "reference", only)
    if failed:
        raise SystemExit("\n".join(failed))


def navigation(pages: Path) -> str:
    """The lines of `nav`: guides, gallery by theme, operators by family."""
    lines = ["  - Home: README.md"]
    for title, members in _GUIDES:
        there = [(name, page) for name, page in members if (pages / page).is_file()]
        if there:
            lines += [f"  - {title}:", *(f"    - {name}: {page}" for name, page in there)]
        if title == "Learn":
            lines += ["  - Gallery:", "    - cases/gallery.md", "    - All decks: cases/README.md"]
            for deck in decks():
                lines.append(f"    - {deck.place.partition('/')[2]}: cases/{deck.place}.md")
            lines += ["  - Operators:", "    - docs/reference/index.md"]
            lines += ["    - Built of Cast3M: docs/reference/coverage.md"]
            build, reference = _module(_HERE / "build.py"), pages / "docs" / "reference"
            families: dict[str, list[str]] = {}
            for page in build.all_pages():
                families.setdefault(page.family, []).append(page.name)
            for family, names in sorted(families.items()):
                there = [n for n in sorted(names) if (reference / build.file_name(n)).is_file()]
                lines += [f"    - {family}:"] if there else []
                for name in there:
                    lines.append(f'      - "{name}": docs/reference/{build.file_name(name)}')
    return "\n".join(lines)


def make(target: Path, only: Collection[str] = ()) -> int:
    """Make the site; exit code of MkDocs, which is strict.

    Parameters
    ----------
    only : collection of str, optional
        See `stage`.
    """
    if not all(map(importlib.util.find_spec, ("material", "latex2mathml"))):
        print("MkDocs with its theme, and latex2mathml, make the site: pip install 'ssilang[docs]'")
        return 2
    with tempfile.TemporaryDirectory() as folder:
        pages = Path(folder) / "pages"
        stage(pages, only)
        config = _CONFIG.format(target=target.resolve(), nav=navigation(pages))
        (Path(folder) / "mkdocs.yml").write_text(config, encoding="utf-8")
        command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet"]
        quiet = os.environ | {"NO_MKDOCS_2_WARNING": "1"}
        return subprocess.run(command, cwd=folder, env=quiet, check=False).returncode


def main() -> int:
    """Make the site in the folder that the command names."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else _ROOT / "site"
    code = make(target)
    if code == 0:
        print(f"{len(list(target.rglob('*.html')))} pages: {target / 'index.html'}")
    return code


if __name__ == "__main__":
    sys.exit(main())
