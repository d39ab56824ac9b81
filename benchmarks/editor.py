"""How long an editor waits: requests of the language server on a deck of 2 000 lines.

    python benchmarks/editor.py [lines [keys]]

The deck is made of the decks of `cases/`. A key is put in at places spread over it; after each the
text is cut anew and completion, hover, colours and outline are asked for, in this process: what the
pipe to an editor adds is not counted. Problems are looked for when no key comes; their time is
shown beside.
"""

import re
import statistics
import sys
import time
from pathlib import Path

from ssilang.cli.checking.sound import SoundStatements
from ssilang.cli.editor import complete, outline
from ssilang.cli.editor.document import Document
from ssilang.cli.editor.information import Reader
from ssilang.cli.editor.problems import Findings, find_problems
from ssilang.cli.editor.server import make_server, spare_collections

CASES = Path(__file__).parent.parent / "cases"


def deck(lines: int) -> str:
    """The first lines of all decks, without the ends of their runs."""
    texts = [p.read_text(encoding="utf-8") for p in sorted(CASES.rglob("*.ssi"))]
    joined = "\n".join(re.sub(r"(?m)^\s*FIN\s*;\s*$", "", t) for t in texts)
    whole = joined.split("\n")
    while len(whole) < lines:
        whole += whole
    return "\n".join(whole[:lines])


def main(lines: int = 2000, keys: int = 40) -> None:
    """Print the median and the longest time of each answer, in milliseconds of a processor."""
    server, text = make_server(), deck(lines)
    names = server.library.standard_names
    spent: dict[str, list[float]] = {}
    sound = SoundStatements()
    opened = Document.of(text, None, names)
    find_problems(opened.source, "en", sound=sound)
    spare_collections()

    def timed(label, action):  # type: ignore[no-untyped-def]
        start = time.process_time()
        result = action()
        spent.setdefault(label, []).append(1e3 * (time.process_time() - start))
        return result

    for i in range(keys):
        at = (2 * i + 1) * len(text) // (2 * keys)
        typed = text[:at] + "A" + text[at:]
        document = timed("cut", lambda t=typed: Document.of(t, None, names, opened))
        timed(
            "completion", lambda d=document, o=at: complete.candidates(d, o, server.library, "en")
        )
        reader = Reader(document, Findings((), {}), server.library, "en")
        timed("hover", lambda r=reader, o=at: r.hover(o))
        timed("colours", lambda d=document: outline.colours(d))
        timed("outline", lambda d=document: outline.outline(d))
        timed("problems", lambda d=document: find_problems(d.source, "en", sound=sound))
    for _ in range(3):
        source = Document.of(text, None, names).source
        timed("at its opening", lambda s=source: find_problems(s, "en"))
    for label, times in spent.items():
        print(
            f"{label:14s} median {statistics.median(times):6.1f} ms, longest {max(times):6.1f} ms"
        )


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:]))
