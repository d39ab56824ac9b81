"""French pages against the English ones: the same scripts, headings and figures."""

import re
from collections import Counter
from pathlib import Path

from together import together

_ROOT = Path(__file__).resolve().parents[2]
_FENCED = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)
_FIGURE = re.compile(
    r"(?<![\w.])\d[\d ]*\d(?:\.\d+)?(?:[eE][-+]?\d+)?|(?<![\w.])\d(?:\.\d+)?(?:[eE][-+]?\d+)?"
)


def texts(name: str) -> tuple[str, str]:
    english = _ROOT / ("README.md" if name == "README.md" else f"docs/{name}")
    french = _ROOT / "docs" / "fr" / name
    return english.read_text(encoding="utf-8"), french.read_text(encoding="utf-8")


def figures(text: str) -> Counter[str]:
    """Numbers of the prose, however they stand at the ends of lines."""
    return Counter(_FIGURE.findall(" ".join(_FENCED.sub("", text).split())))


def headings(text: str) -> list[int]:
    return [len(m) for m in re.findall(r"^(#+) ", _FENCED.sub("", text), re.MULTILINE)]


@together("name", ["language.md", "uplift.md", "faq.md", "matter.md", "waves.md"])
def test_a_page_has_the_scripts_headings_and_figures_of_the_english_one(name):
    english, french = texts(name)
    assert _FENCED.findall(french) == _FENCED.findall(english)
    assert headings(french) == headings(english)
    assert figures(french) == figures(english)


def test_the_presentation_has_the_headings_of_the_readme_its_model_and_no_other_figure():
    english, french = texts("README.md")
    assert headings(french) == headings(english)
    model = [b for b in _FENCED.findall(english) if b.startswith("```ssi")]
    assert [b for b in _FENCED.findall(french) if b.startswith("```ssi")] == model
    known, told = (
        set(re.findall(r"^ssilang ([a-z]+) ", t, re.MULTILINE)) for t in (english, french)
    )
    assert told == known
    assert not figures(french) - figures(english)
