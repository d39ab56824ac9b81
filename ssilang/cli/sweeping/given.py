"""Values given on the command line: `--set NAME=VALUES`, `--motions DIR`."""

import hashlib
import itertools
import math
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ssilang.io.atomic import inside
from ssilang.messages.message import Refusal
from ssilang.report.sweep_table import MOTION

Value = int | float | bool | str

_NAME = re.compile(r"@?[A-Za-z][A-Za-z0-9_]*")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([EeDd][+-]?\d+)?")
_ROW = re.compile(rf"[\s,;]*{_NUMBER.pattern}([\s,;]+{_NUMBER.pattern})*[\s,;]*")
_LOOKED_AT = 1 << 16  # bytes of a file: heads of records are much shorter
_UNFIT = re.compile(r"[^\w.+=-]")
_LONGEST_NAME = 120
MOST_VALUES = 1_000_000


class GivenError(Refusal):
    """A value of the command line that cannot be read."""


def parse_value(text: str) -> Value:
    """A number, VRAI or FAUX, else a word."""
    text = text.strip()
    if _NUMBER.fullmatch(text):
        if re.fullmatch(r"[+-]?\d{1,4000}", text):
            return int(text)
        number = float(re.sub("[dD]", "E", text))
        if math.isinf(number):
            raise GivenError("cli.value-too-large", text=text)
        return number
    if text.upper() in ("VRAI", "FAUX"):
        return text.upper() == "VRAI"
    return text


def parse_values(text: str) -> list[Value]:
    """`a,b,c`, or `first:last:step` with both ends in it.

    Raises
    ------
    GivenError
        If a range is empty, goes the wrong way or has no value at its end.
    """
    parts = text.split(":")
    if not all(p.strip() for p in (parts if len(parts) == 3 else text.split(","))):
        raise GivenError("cli.value-empty", text=text)
    if len(parts) != 3 or not all(_NUMBER.fullmatch(p.strip()) for p in parts):
        return [parse_value(p) for p in text.split(",")]
    first, last, step = (parse_value(p) for p in parts)
    assert isinstance(first, int | float)
    assert isinstance(last, int | float)
    assert isinstance(step, int | float)
    if step == 0 or (last - first) / step < 0:
        raise GivenError("cli.range-no-values-first", text=text)
    steps = (last - first) / step
    count = int(steps + 1e-9) + 1
    if abs(steps - round(steps)) > 1e-6:
        end = first + (count - 1) * step
        raise GivenError("cli.range-misses-end", text=text, last=last, end=end)
    if count > MOST_VALUES:
        raise GivenError("cli.range-values", text=text, count=count)
    if all(isinstance(v, int) for v in (first, last, step)):
        return [first + i * step for i in range(count)]
    return [float(f"{first + i * step:.12g}") for i in range(count)]


def parse_setting(text: str) -> tuple[str, list[Value]]:
    """`NAME=VALUES`.

    Raises
    ------
    GivenError
        If it is not written so.
    """
    name, sign, values = text.partition("=")
    name = name.strip().upper()
    if not sign or not _NAME.fullmatch(name) or not values.strip():
        raise GivenError("cli.not-name-value-ag", text=text)
    return name, parse_values(values)


@dataclass(frozen=True)
class Case:
    """One run of a sweep: its number from 1 and the values it sets."""

    number: int
    values: dict[str, Value]


def folder_names(cases: Sequence[Case]) -> list[str]:
    """A folder's name for each case, that says its values and its motion: 'AG=0.5_m1'."""
    names = [_name(case, whole=False) for case in cases]
    if len(set(names)) < len(names):  # motions that differ in their endings alone
        names = [_name(case, whole=True) for case in cases]
    return names


def _name(case: Case, *, whole: bool) -> str:
    said = [f"{n}={_shown(v)}" for n, v in sorted(case.values.items()) if n != MOTION]
    if MOTION in case.values:
        path = Path(str(case.values[MOTION]))
        said.append(path.name if whole else path.stem)
    name = "_".join(said)
    plain = _UNFIT.sub("-", name)
    if plain == name and len(name) <= _LONGEST_NAME:
        return name
    digest = hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:6]
    return f"{plain[:_LONGEST_NAME]}_{digest}"


def _shown(value: Value) -> str:
    if isinstance(value, bool):
        return "VRAI" if value else "FAUX"
    return str(value)


def axes_of(settings: Sequence[str]) -> dict[str, list[Value]]:
    """The values that each name gets.

    Raises
    ------
    GivenError
        For a setting that cannot be read or is given twice.
    """
    axes: dict[str, list[Value]] = {}
    for text in settings:
        name, values = parse_setting(text)
        if name in axes:
            raise GivenError("cli.set-twice", name=name)
        if again := [
            str(v) for (_, v), n in Counter((type(v), v) for v in values).items() if n > 1
        ]:
            raise GivenError("cli.value-twice", name=name, values=again)
        axes[name] = values
    return axes


def cases_of(
    settings: Sequence[str], motions: Path | None, left: list[Path] | None = None
) -> list[Case]:
    """All combinations of the settings' values and the motions, the last one fastest.

    Parameters
    ----------
    left : list of Path, optional
        Gets the files of `motions` that are none.

    Raises
    ------
    GivenError
        As `axes_of`; for a motion that is set beside a folder, a folder without files.
    """
    axes = axes_of(settings)
    if motions is not None and MOTION in axes:
        raise GivenError("cli.set-twice", name=MOTION)
    if motions is not None:
        axes[MOTION] = [*motions_in(motions, [] if left is None else left)]
    return combined(axes)


def combined(axes: Mapping[str, Sequence[Value]]) -> list[Case]:
    """All combinations of values, those of the last name fastest.

    Raises
    ------
    GivenError
        If no name is swept.
    """
    if not axes:
        raise GivenError("cli.nothing-sweep-set-name")
    rows = itertools.product(*axes.values())
    return [Case(i, dict(zip(axes, row, strict=True))) for i, row in enumerate(rows, start=1)]


def motions_in(folder: Path, left: list[Path]) -> list[str]:
    """Paths of the ground motions of a folder; `left` gets the files that are none.

    Raises
    ------
    GivenError
        If it is no folder, has none, or one that is a link out of it.
    """
    if not folder.is_dir():
        raise GivenError("cli.not-folder-ground-motions", folder=folder)
    files = sorted(p for p in folder.iterdir() if p.is_file() and not p.name.startswith("."))
    motions = [p for p in files if is_motion(p)]
    left += [p for p in files if p not in motions]
    if not motions:
        raise GivenError("cli.no-file", folder=folder)
    for path in motions:  # the script may read where its motion is
        if inside(folder, path.name) is None:
            raise GivenError("cli.motion-leads-out", name=path.name, folder=folder)
    return [str(folder.resolve() / p.name) for p in motions]


def is_motion(path: Path) -> bool:
    """Whether a file may be a ground motion: a text that can be read and soon has numbers."""
    try:
        with path.open("rb") as stream:
            head = stream.read(_LOOKED_AT)
    except OSError:
        return False
    if b"\0" in head:
        return False
    lines = head.decode("utf-8", errors="replace").splitlines()
    return any(_ROW.fullmatch(line) for line in lines)
