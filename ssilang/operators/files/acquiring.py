"""ACQU: values read from a text file into names."""

import math
import re
from contextlib import suppress

from ssilang.language.run.call import name_of
from ssilang.operators.files.outputs import input_path, option_name, run_output
from ssilang.operators.prelude import *

_ITEM = re.compile(r"'([^']*(?:''[^']*)*)'|([^\s,;]+)")


class Bare(str):
    """A word without quotes: its letters are capitals, as in a script."""


@dataclass
class Records:
    """The lines of a file and how far they have been read."""

    name: str
    lines: list[str]
    line: int = 0
    items: list[str | float | int] = field(default_factory=list)

    def next_line(self) -> str:
        """The next line, whole."""
        if self.line >= len(self.lines):
            raise InputError(
                "operators.files.all-lines-read", name=self.name, n_lines=len(self.lines)
            )
        self.line += 1
        return self.lines[self.line - 1]

    def next(self) -> str | float | int:
        """The next item, over as many lines as are needed."""
        while not self.items:
            self.items = [_item(m) for m in _ITEM.finditer(self.next_line())]
        return self.items.pop(0)

    def number(self) -> float | int:
        """The next item, which must be a number."""
        item = self.next()
        if isinstance(item, str):
            raise InputError("operators.files.no-number", name=self.name, line=self.line, item=item)
        return item


def _item(match: re.Match[str]) -> str | float | int:
    if match.group(2) is None:
        return match.group(1).replace("''", "'")
    text = match.group(2)
    with suppress(ValueError):
        return int(text)
    with suppress(ValueError):
        value = float(re.sub("[dD]", "E", text))
        if math.isfinite(value):  # a gap in a record is no number
            return value
    return Bare(text)


def _word(item: Any) -> Mot:
    return Mot(item.upper() if isinstance(item, Bare) else item)


def _whole(records: Records) -> int:
    value = records.number()
    if value != int(value):
        raise InputError(
            "operators.files.no-whole-number", name=records.name, line=records.line, value=value
        )
    return int(value)


_READERS: dict[str, Callable[[Records, int], Any]] = {
    "": lambda r, n: _word(item) if isinstance(item := r.next(), str) else item,
    "ENTIER": lambda r, n: _whole(r),
    "FLOTTANT": lambda r, n: float(r.number()),
    "MOT": lambda r, n: _word(r.next()),
    "LISTENTI": lambda r, n: ListEnti([_whole(r) for _ in range(n)]),
    "LISTREEL": lambda r, n: ListReel([float(r.number()) for _ in range(n)]),
}


@operator(
    "ACQU",
    flag("line", "BRUT", en="the next line, as a word"),
    many("names", "*", en="names, each with * and a type, behind a list the number of its values"),
    family="files",
    full_name="ACQUERIR",
    gives="MOT|",
    reads_itself="its items are names and types, with * between, and numbers of values",
)
def acqu(call: Call) -> Mot | None:
    """Read values into names, or one line."""
    records = _records(call)
    records.items = []  # a statement begins on a new line
    if len(call.operands) == 1 and call.keyword(("BRUT",)) is not None:
        return Mot(records.next_line())
    wanted = _wanted(call)
    if not wanted:
        raise call.missing(("MOT",))
    for name, kind, count in wanted:
        call.session.frame.assign(name, _READERS[kind](records, count))
    return None


def _records(call: Call) -> Records:
    output = run_output(call.session)
    records = output.opened.get("ACQU")
    if records is None:
        path = input_path(call, option_name(call.session, "ACQU", 9))
        text = path.read_text(encoding="utf-8", errors="replace")
        records = output.opened["ACQU"] = Records(path.name, text.splitlines())
    assert isinstance(records, Records)
    return records


def _wanted(call: Call) -> list[tuple[str, str, int]]:
    """Names, types and numbers of values; the operands stand as written."""
    found = []
    operands = call.operands
    while operands:
        operand = operands.pop(0)
        call.used.append(operand)
        name, kind, count = name_of(operand), "", 1
        if not name:
            raise call.error("operators.files.no-name-with-type", operand.value)
        if operands and operands[0].span.text == "*":
            operands.pop(0)
            kind = name_of(operands.pop(0)).strip() if operands else ""
            if kind not in _READERS or not kind:
                types = " ".join(k for k in _READERS if k)
                raise call.error("operators.files.type-not-read", kind=kind, types=types)
        if kind.startswith("LIST"):
            number = operands.pop(0).value if operands else None
            if type(number) is not int or number < 0:
                raise call.error("operators.files.size-missing", name=name, kind=kind)
            count = number
        found.append((name, kind, count))
    return found
