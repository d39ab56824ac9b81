"""The words of the grammar as regular expressions, kept in the user's cache folder.

Making them takes Lark, which takes longer to start than most scripts take to read; the scripts
themselves are not kept, since they are read about as fast as their trees could be loaded.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import sys
from pathlib import Path

from ssilang import __version__
from ssilang.resources import resource

Words = list[tuple[str, str]]


def grammar_words() -> Words:
    """Names and regular expressions of the grammar's terminals, in the order of trial."""
    state = f"{__version__} {sys.version} ".encode()
    key = hashlib.sha256(state + resource("grammar", "ssi.lark").read_bytes()).hexdigest()
    path = _folder() / f"words-{key[:16]}.json"
    words = _kept(path, key)
    if words is None:
        from ssilang.language.text.by_grammar import words_of_grammar

        words = words_of_grammar()
        _keep(path, key, words)
    return words


def _folder() -> Path:
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return Path(home) / "ssilang"


def _sum(key: str, words: Words) -> str:
    return hashlib.sha256(f"{key} {json.dumps(words)}".encode()).hexdigest()


def _kept(path: Path, key: str) -> Words | None:
    """What the file holds, None if it is missing, damaged or of another state."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        words = [(str(name), str(pattern)) for name, pattern in data["words"]]
        return words if data["sum"] == _sum(key, words) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _keep(path: Path, key: str, words: Words) -> None:
    """Write the file whole or not at all; without a writable folder it is made each time."""
    part = path.with_suffix(f".{os.getpid()}")
    text = json.dumps({"sum": _sum(key, words), "words": words})
    with contextlib.suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_text(text, encoding="utf-8")
        part.replace(path)
