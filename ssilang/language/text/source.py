"""Source texts and places in them."""

import codecs
import re
from bisect import bisect_right
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

# strings, so that what stands in them is passed over, and the ends of statements
STRING = r"'[^']*(?:''[^']*)*'"
STATEMENT_END = re.compile(STRING + "|;")
# comment lines, and the lines that separate the procedures of a library file
_COMMENT_LINE = re.compile(r"^(?:\*|\$\$\$\$).*$", re.MULTILINE)


@dataclass(frozen=True, eq=False)
class Source:
    """A script's text; `name` is the path shown in messages."""

    name: str
    text: str
    path: Path | None = None

    @classmethod
    def decode(cls, name: str, data: bytes, path: Path | None = None) -> "Source":
        """A source from bytes in any encoding that `encoding_of` knows, with any line ends."""
        text = data.decode(encoding_of(data))
        return cls(name, text.replace("\r\n", "\n").replace("\r", "\n"), path)

    @cached_property
    def code(self) -> str:
        """The text with comment lines blanked: same length, same offsets."""
        return _COMMENT_LINE.sub(lambda m: " " * len(m.group()), self.text)

    @property
    def digest(self) -> str:
        """What tells one deck from another: SHA-256 of its text."""
        from hashlib import sha256

        return sha256(self.text.encode("utf-8", "surrogatepass")).hexdigest()

    @cached_property
    def _line_starts(self) -> list[int]:
        return [0, *(m.end() for m in re.finditer("\n", self.text))]

    def position(self, offset: int) -> tuple[int, int]:
        """1-based line and column of an offset."""
        line = bisect_right(self._line_starts, offset)
        return line, offset - self._line_starts[line - 1] + 1

    def offset(self, line: int, column: int) -> int:
        """Offset of a 1-based line and column; beyond the ends, the end of the text or line."""
        if line > len(self._line_starts):
            return len(self.text)
        start = self._line_starts[line - 1]
        return min(start + column - 1, start + len(self.line(line)))

    def line(self, number: int) -> str:
        """Text of a 1-based line, without its end."""
        start = self._line_starts[number - 1]
        end = self.text.find("\n", start)
        return self.text[start:] if end < 0 else self.text[start:end]


def encoding_of(data: bytes) -> str:
    """UTF-16 where its mark stands in front (PowerShell's `>`), UTF-8 or else Latin-1."""
    kinds = (codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (b"", "utf-8")
    kind = next(kind for mark, kind in kinds if data.startswith(mark))
    try:
        data.decode(kind)
    except UnicodeDecodeError:
        return "latin-1"
    return kind


@dataclass(frozen=True, slots=True)
class Span:
    """Characters start:end of a source."""

    source: Source = field(repr=False)
    start: int
    end: int

    def to(self, other: "Span") -> "Span":
        """From the start of this span to the end of another."""
        return Span(self.source, self.start, max(self.end, other.end))

    @property
    def text(self) -> str:
        """The characters themselves."""
        return self.source.text[self.start : self.end]
