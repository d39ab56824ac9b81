"""Titles as matplotlib's text."""

from together import together

from ssilang.io.plots.markup import LONGEST, to_mathtext


@together(
    "written, drawn",
    [
        ("plain $ text", r"plain \$ text"),
        (r"\a and \W", "α and Ω"),
        ("u_{i}", r"u$\mathregular{{}_{i}}$"),
        ("x" * LONGEST, "x" * LONGEST),
        ("x" * 300_000, "x" * (LONGEST - 1) + "…"),
    ],
)
def test_a_text_is_drawn_with_its_scripts_as_far_as_there_is_room(written, drawn):
    assert to_mathtext(written) == drawn
