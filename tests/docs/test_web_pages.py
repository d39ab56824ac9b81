"""The site is made in a small form: strict, so that every link and anchor leads somewhere."""

import importlib.util
import json
import sys
from pathlib import Path

import pytest

_DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.fixture(scope="module")
def web():
    """The module `docs/web_pages.py`, which stands in no package."""
    spec = importlib.util.spec_from_file_location("web_pages", _DOCS / "web_pages.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules["web_pages"] = module
    spec.loader.exec_module(module)
    return module


def test_every_deck_has_its_page_with_its_picture_and_its_text(web):
    found = {d.place: d for d in web.decks()}
    cases = _DOCS.parent / "cases"
    assert set(found) == {f"{p.parent.name}/{p.stem}" for p in cases.glob("*/*.ssi")}
    for deck in found.values():
        page = web.deck_markdown(deck)
        assert deck.text.rstrip() in page
        assert page.startswith(f"# {deck.title}\n")
        assert all(p.is_file() for p in deck.pictures)
    gallery = web.gallery_markdown(list(found.values()))
    assert gallery.count("\n## ") == len(found)
    assert "(footing/pictures/strip_uplift.png)" in gallery


def test_pictures_of_the_guides_are_shown_and_small():
    pages = "".join(p.read_text(encoding="utf-8") for p in _DOCS.rglob("*.md"))
    pictures = list((_DOCS / "pictures").glob("*.png"))
    assert pictures
    assert {p.name for p in pictures if f"pictures/{p.name})" not in pages} == set()
    assert {p.name for p in pictures if p.stat().st_size > 60_000} == set()


def test_a_page_belongs_to_the_navigation(web, tmp_path):
    for page in (*_DOCS.glob("*.md"), *_DOCS.glob("fr/*.md")):
        if page.name != "README.md" or page.parent.name == "fr":
            assert page.relative_to(_DOCS.parent).as_posix() in str(web._GUIDES), page


@pytest.mark.skipif(
    not all(map(importlib.util.find_spec, ("material", "latex2mathml"))),
    reason="mkdocs-material and latex2mathml, extra docs, are not installed",
)
def test_the_site_is_made_and_no_link_leads_nowhere(web, tmp_path, capfd):
    assert web.make(tmp_path / "site", ("LIRE", "MAILLER")) == 0, capfd.readouterr().err
    front = (tmp_path / "site" / "index.html").read_text(encoding="utf-8")
    assert 'href="docs/uplift.html' in front
    deck = tmp_path / "site" / "cases" / "footing" / "strip_uplift.html"
    assert "pictures/strip_uplift.png" in deck.read_text(encoding="utf-8")
    gallery = (tmp_path / "site" / "cases" / "gallery.html").read_text(encoding="utf-8")
    assert "n**2 pi/(2 L**2) sqrt(E I/(rho A))" in gallery  # signs of formulas are no emphasis
    equations = (tmp_path / "site" / "docs" / "physics.html").read_text(encoding="utf-8")
    assert equations.count("<math") > 40
    assert equations.count('display="block"') == equations.count('<div style="overflow-x: auto">')
    assert "$" not in equations.partition("<article")[2].partition("</article")[0]
    index = json.loads((tmp_path / "site" / "search" / "search_index.json").read_text())
    places = {d["location"].partition("#")[0] for d in index["docs"]}
    assert {"docs/reference/lire.html", "docs/reference/mailler.html"} <= places
