"""The words of Cast3M and their subjects, to say of a word that is not built what it is."""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

_FILE = Path(__file__).with_name("cast3m_words.txt")

IN_SCOPE = "mechanics"
"""The subject whose words are in scope; all others are not."""


@dataclass(frozen=True, slots=True)
class Cast3mWord:
    """A word of Cast3M: `kind` is 'operator', 'procedure' or 'table', `subject` as in the file.

    Of kind 'table' are words by which an operator reads a table of another subject, as VARI.PSATT.
    `reason` names the sentence why a word that belongs here is not built, '' if it is.
    """

    name: str
    kind: str
    subject: str
    reason: str = ""

    @property
    def here(self) -> bool:
        """Whether ssilang has it: as an operator, or as a word that begins a statement."""
        return self.subject == IN_SCOPE and not self.reason


@cache
def cast3m_words() -> dict[str, Cast3mWord]:
    """All words by name."""
    words: dict[str, Cast3mWord] = {}
    header: list[str] = []
    for line in _FILE.read_text(encoding="utf-8").split("\n"):
        if line.startswith("["):
            header = line.strip("[]").split()
        elif line and not line.startswith("#"):
            words.update({n: Cast3mWord(n, *header) for n in line.split()})
    return words


def find_cast3m_word(name: str) -> Cast3mWord | None:
    """The word that a name stands for: a procedure in full, an operator by four letters."""
    words = cast3m_words()
    exact = words.get(name.upper())
    if exact is not None:
        return exact
    short = words.get(name.upper()[:4])
    return short if short is not None and short.kind == "operator" else None
