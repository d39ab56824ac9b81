"""What Tab offers in the interactive session: what editors offer, as words to end a line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ssilang.language.run.session import Session

if TYPE_CHECKING:
    from ssilang.cli.editor.complete import Candidate


def completions(text: str, session: Session) -> tuple[str, list[str]]:
    """Candidates for the end of `text`.

    Returns
    -------
    tuple
        The part of `text` that a candidate replaces, and the candidates, sorted.
    """
    # vocabulary and elements are read at the first Tab, not when the session begins
    from ssilang.cli.editor.complete import candidates
    from ssilang.cli.editor.document import Document
    from ssilang.operators.loader import load_operators

    load_operators()
    document = Document.of(text, None, session.library.standard_names)
    found = candidates(document, len(text), session.library, session.language, session)
    prefix = text[found[0].start :] if found else ""
    typed = prefix.lstrip("'").upper()
    words = {_written(c, prefix) for c in found}
    return prefix, sorted(w for w in words if w.lstrip("'").upper().startswith(typed))


def _written(candidate: Candidate, prefix: str) -> str:
    """A candidate as it is typed: keywords need no quotes where none was opened."""
    bare = candidate.kind in ("keyword", "word") and candidate.label.isidentifier()
    return candidate.label if bare and prefix[:1] != "'" else candidate.text
