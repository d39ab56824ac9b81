"""A text that changes has the statements of a text that was always so."""

from hypothesis import example, given, settings
from hypothesis import strategies as st

from ssilang.cli.editor import tokens
from ssilang.cli.editor.document import Document
from ssilang.cli.editor.outline import colours, outline

LINES = [
    "A = 1 ;", "B = 'x;y' ; C = A ;", "* A = 'half ;", "D = 'over", "E' ; F = 2 ;", "G = 'open ;",
    "DEBP PRC X*FLOTTANT Y/ENTIER ;", "Z = X + Y ;", "FINP Z ;", "REPE BOU 3 ; A = &BOU ;",
    "FIN BOU ;", ";;", "H = 'it''s' ;", "  TAB . 'A' = (1 + (2 * 3 ;", "", "quit é § ;",
]  # fmt: skip
PIECES = [
    "'",
    ";",
    "\n",
    "* ",
    "''",
    "(",
    " ",
    "A",
    ";\n",
    "\n*",
    "= 'b' ;",
    "DEBP Q ;\n",
    "FINP ;\n",
]
TEXTS = st.lists(st.sampled_from(LINES), min_size=1, max_size=9).map("\n".join)
CHANGES = st.lists(
    st.tuples(st.floats(0, 1), st.floats(0, 1), st.sampled_from(["", *PIECES])),
    min_size=1,
    max_size=4,
)


@given(TEXTS, CHANGES)
@settings(max_examples=150, deadline=None)
@example("X = 'abc\nY = 3 ; Z = 4\nT = 5 ;", [(1.0, 1.0, "'")])  # closes a string far in front
@example("A = 1 ;\nA = 1 ;\nA = 1 ;", [(0.3, 0.65, "")])  # a statement of three alike goes
def test_a_changed_text_has_the_statements_of_a_text_that_was_always_so(text, changes):
    document = Document.of(text)
    for first, second, piece in changes:
        before = document.source.text
        start, end = sorted(round(f * len(before)) for f in (first, second))
        changed = before[:start] + piece + before[min(end, start + 6) :]
        document, fresh = Document.of(changed, before=document), Document.of(changed)
        assert [p.tokens for p in document.phrases] == [p.tokens for p in fresh.phrases]
        assert [(p.start, p.end, p.cut.closed) for p in document.phrases] == [
            (p.start, p.end, p.cut.closed) for p in fresh.phrases
        ]
        assert [(o.name, o.start, o.end, o.scope) for o in document.names.found] == [
            (o.name, o.start, o.end, o.scope) for o in fresh.names.found
        ]
        assert outline(document) == outline(fresh)
        assert colours(document) == colours(fresh)


def test_what_did_not_change_is_not_read_again(monkeypatch):
    text = "\n".join(f"A{i} = {i} + 'b' ;" for i in range(500))
    document, at = Document.of(text), text.index("A250")
    read = []
    quick = tokens.quick_reader()
    reader = type("Counted", (), {"tokens": lambda _, c, i: map(seen, quick.tokens(c, i))})()
    seen = lambda token: read.append(token) or token  # noqa: E731
    monkeypatch.setattr(tokens, "quick_reader", lambda: reader)
    changed = Document.of(text[:at] + "B" + text[at:], before=document)
    assert len(read) < 15
    assert len(changed.phrases) == 500
    assert changed.phrases[250].tokens[0].text == "BA250"
    assert changed.phrases[499].tokens[0].start == document.phrases[499].tokens[0].start + 1
