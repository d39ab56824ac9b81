"""PROG LECT MOTS ENUM SUIT: lists from their items."""

import math
from array import array

from ssilang.operators.prelude import *

_REAL = ("ENTIER", "FLOTTANT")
_BLOCK = 100_000
LONGEST = 20_000_000
"""Items of one list, or letters of one word, at most: more than any use, and memory holds them."""
_FREE = "its items, steps and repetitions stand in any order"


_KINDS = {"FLOTTANT": _REAL, "ENTIER": ("ENTIER",)}
_STEP = {k: arg("step", *v, en="step", range=ANY_NUMBER) for k, v in _KINDS.items()}
_ITEM = {k: arg("item", *v, en="item", range=CARRIED) for k, v in _KINDS.items()}
_NEXT = {
    k: opt("item", *v, "LISTREEL", "LISTENTI", en="item, or list of them", range=CARRIED)
    for k, v in _KINDS.items()
}
_RATIO = arg("ratio", "FLOTTANT", en="ratio of steps", range=ANY_NUMBER)
_COUNT = arg("count", "ENTIER", en="number of steps", range=NOT_NEGATIVE)
_TIMES = arg("count", "ENTIER", en="repetitions", range=NOT_NEGATIVE)
_FREQUENCY = arg("frequency", "FLOTTANT", en="frequency", unit="Hz", usual=POSITIVE)
_SETTINGS = {
    "PHAS": arg("phase", "FLOTTANT", en="phase", unit="deg", range=ANY_NUMBER),
    "AMPL": arg("size", "FLOTTANT", en="amplitude", range=ANY_NUMBER),
    "A": arg("a", "FLOTTANT", en="slope", range=ANY_NUMBER),
    "B": arg("b", "FLOTTANT", en="constant", range=ANY_NUMBER),
}


_OF_STEPS = (
    key("ratio", "GEOM", _RATIO, en="ratio of steps"),
    key("count", "NPAS", _COUNT, en="number of steps"),
)


def _items(kind: str) -> tuple[Entry, ...]:
    """What `_read_items` reads."""
    return (
        many(
            "items", kind, "LISTREEL", "LISTENTI", en="items, lists of them, or N * item",
            range=CARRIED,
        ),
        key(
            "steps", "PAS", _STEP[kind], repeated=True,
            en="from the item before to the one behind by steps",
        ),
        *_OF_STEPS,
    )  # fmt: skip


_FACTORS = (
    key("a", "A", _SETTINGS["A"], en="slope, 1 by default"),
    key("b", "B", _SETTINGS["B"], en="constant, 0 by default"),
)


def check_length(count: float) -> None:
    """Refuse a list of so many items before any of them is made.

    Raises
    ------
    KernelError
        If there are more than `LONGEST`.
    """
    if not count <= LONGEST:
        raise KernelError("operators.lists.too-long", count=count, longest=LONGEST)


def _star(call: Call) -> bool:
    """Whether a repetition mark stands next; it is consumed."""
    if call.operands and _is_star(call.operands[0]):
        call.used.append(call.operands.pop(0))
        return True
    return False


def _is_star(operand: Operand) -> bool:
    return isinstance(operand.value, Mot) and operand.span.text in ("*", "'*'")


if TYPE_CHECKING:
    Items = list[Any] | array[float]  # numbers under way: reals in one piece of memory


def _extend(items: "Items", more: list[Any] | FloatArray | IntArray) -> None:
    if isinstance(more, list):
        items.extend(more)
    elif isinstance(items, array):
        items.frombytes(np.ascontiguousarray(more, dtype=float).data.cast("B"))
    else:
        items.extend(more.tolist())


def _read_items(call: Call, kinds: tuple[str, ...]) -> "Items":
    """Numbers with repetitions and steps, in order; lists among them are taken whole."""
    items: Items = array("d") if "FLOTTANT" in kinds else []
    plain = frozenset({int, float} if "FLOTTANT" in kinds else {int})
    while True:
        _read_row(call, items, plain)
        if call.at_word() and call.keyword(("PAS",)) is not None:
            # steps that begin the list start from a zero that is not in it
            _extend(items, _steps(call, items[-1] if items else 0, kinds))
            check_length(len(items))
            continue
        value = call.given(_NEXT[kinds[-1]])
        if value is None:
            return items
        if isinstance(value, ListReel | ListEnti):
            _extend(items, value.values)
        elif _star(call):
            _extend(items, _repeated(call, value, kinds))
            check_length(len(items))
        else:
            items.append(value)


def _read_row(call: Call, items: "Items", plain: frozenset[type]) -> None:
    """Read the bare numbers that stand next, `N * X` among them: pasted lists are long."""
    operands, i = call.operands, 0
    while i < len(operands) and type(value := operands[i].value) in plain:
        if i + 1 == len(operands) or not _is_star(operands[i + 1]):
            items.append(value)
            i += 1
            continue
        behind: Any = operands[i + 2].value if i + 2 < len(operands) else None
        if type(value) is not int or value <= 0 or type(behind) not in plain:
            break  # what is wrong is told where each is read by itself
        check_length(len(items) + value)
        items.extend([behind] * value)
        i += 3
    call.take_first(i)


def _repeated(call: Call, count: Any, kinds: tuple[str, ...]) -> list[Any]:
    if not 0 <= count < math.inf or count != int(count):
        raise call.error("operators.lists.repetition-count", count, count=count)
    check_length(count)
    _tell_no_time(call, count)
    return [call.given(_ITEM[kinds[-1]])] * int(count)


def _tell_no_time(call: Call, count: float) -> None:
    """Warn of an item that is written no time; a count that was computed may be nought."""
    if not count and call.used[-2].span.text.isdigit():
        call.warn("operators.lists.repeated-no-time", count)


def _steps(call: Call, start: Any, kinds: tuple[str, ...]) -> list[Any] | FloatArray:
    step = call.given(_STEP[kinds[-1]], call.keyword_end)
    ratio = None
    if call.keyword(("GEOM",)) is not None:
        ratio = call.given(_RATIO, call.keyword_end)
    if call.keyword(("NPAS",)) is not None:
        count = call.given(_COUNT, call.keyword_end)
        check_length(count)
        return _progression(start, step, count, ratio)
    end = call.given(_ITEM[kinds[-1]])
    more: list[Any] = []
    if _star(call):
        more = _repeated(call, end, kinds)
        if not more:
            raise call.error("operators.lists.steps-without-end")
        end, more = more[0], more[1:]
    if step and (end - start) / step > 0:
        check_length(0 if ratio else (end - start) / step)
    try:
        if "FLOTTANT" in kinds:
            return [*real_steps(float(start), float(step), float(end), ratio), *more]
        return [*integer_steps(start, step, end), *more]
    except KernelError as problem:
        if "FLOTTANT" in kinds and problem.code == "operators.lists.steps-lead-away":
            call.warn("operators.lists.steps-left-out", **problem.data)
            return [end, *more]
        raise call.error(problem.code, end, **problem.data) from None


def _progression(start: Any, step: Any, count: int, ratio: float | None) -> list[Any] | FloatArray:
    if ratio is not None:
        sums: FloatArray = start + np.cumsum(float(step) * ratio ** np.arange(count))
        return sums
    if isinstance(start, int) and isinstance(step, int):
        return [start + step * i for i in range(1, count + 1)]
    return _evenly(_as_written(start), _as_written(step), count)


def integer_steps(start: int, step: int, end: int) -> list[int]:
    """Integers behind `start` up to `end`, whose distance the step divides."""
    if start == end:
        return []
    if step == 0 or (end < start) != (step < 0):
        told = {"step": step, "start": start, "end": end, "meant": -step}
        raise KernelError("operators.lists.steps-lead-away", **told)
    if (end - start) % step:
        raise KernelError("operators.lists.steps-miss-end", step=step, start=start, end=end)
    return list(range(start + step, end + (1 if step > 0 else -1), step))


_SAME = 1e-12  # relative distance of two reals that rounding alone makes differ


def real_steps(start: float, step: float, end: float, ratio: float | None = None) -> list[float]:
    """Reals behind `start` up to `end`, the step being adjusted so that `end` is hit.

    Without `ratio` the number of steps is the nearest that fits; with it, the first step is the
    nearest above `step` that fits, so that a row is stretched and never shrunk.

    Raises
    ------
    KernelError
        If the step leads away from `end`, or nowhere, or one of the three is no finite number.
    """
    distance = end - start
    if not all(map(math.isfinite, (distance, step, ratio or 0.0))):
        raise KernelError("operators.lists.steps-not-finite", step=step, start=start, end=end)
    if abs(distance) <= _SAME * max(abs(start), abs(end)):
        return [end]
    if step == 0 or (distance < 0) != (step < 0):
        raise KernelError(
            "operators.lists.steps-lead-away", step=step, start=start, end=end, meant=-step
        )
    if ratio is not None:
        return _geometric_steps(start, step, end, ratio)
    count = max(round(distance / step), 1)
    first, last = _as_written(start), _as_written(end)
    values: list[float] = _evenly(first, (last - first) / count, count).tolist()
    values[-1] = end
    return values


def _as_written(value: float) -> np.longdouble:
    """A real to more digits than it has: 0.1 and not the nearest double."""
    return np.longdouble(repr(float(value)))


def _evenly(first: np.longdouble, step: np.longdouble, count: int) -> FloatArray:
    """Reals behind the first, the doubles nearest to what is written: 0.3 behind 0.1 and 0.2."""
    made = np.empty(count)
    for start in range(0, count, _BLOCK):  # a long row takes no more memory than its values
        end = min(start + _BLOCK, count)
        made[start:end] = first + step * np.arange(start + 1, end + 1)
    return made


def _geometric_steps(start: float, step: float, end: float, ratio: float) -> list[float]:
    distance = end - start
    if ratio <= 0:
        return [end]
    wanted, length = distance / step, 1.0
    lengths, total = [length], length
    while (total := total + (length := ratio ** len(lengths))) <= wanted * (1 + 1e-9):
        if length < 1e-12 * total or len(lengths) > 10**6:
            return [end]
        lengths.append(length)
    values: list[float] = (start + distance * np.cumsum(lengths) / sum(lengths)).tolist()
    values[-1] = end
    return values


@operator(
    "PROG",
    select(
        "function",
        {
            "SINU": [
                _FREQUENCY,
                key("phase", "PHAS", _SETTINGS["PHAS"], en="phase, degrees"),
                key("size", "AMPL", _SETTINGS["AMPL"], en="amplitude"),
            ],
            "LINE": _FACTORS,
            "EXPO": _FACTORS,
            "LOGA": _FACTORS,
            "TABL": [arg("table", "TABLE", en="numbers by integers")],
        },
        en="a function of the items, or those of a table",
    ),
    *_items("FLOTTANT"),
    family="lists",
    reads_itself=_FREE,
)
def prog(call: Call) -> ListReel:
    """Read reals."""
    table = _table_said(call)
    if table is not None:
        return ListReel.of(np.asarray(_by_integers(call, table, _REAL), dtype=float))
    word = call.keyword(("SINU", "LINE", "EXPO", "LOGA"))
    if word is not None:
        return _function_of_list(call, word)
    return ListReel.of(np.asarray(_read_items(call, _REAL), dtype=float))


def _table_said(call: Call) -> Table | None:
    """The table behind the word TABL, None where the word does not stand first."""
    first = call.operands[0].value if call.operands else None
    if not isinstance(first, Mot) or first.upper()[:4] != "TABL" or len(call.operands) < 2:
        return None
    if not isinstance(call.operands[1].value, Table):
        return None
    call.take_first(1)
    table: Table = call.required("TABLE")
    return table


def _by_integers(call: Call, table: Table, kinds: tuple[str, ...] = ()) -> list[Any]:
    """What a table holds at integers, in their order; other indices are passed over."""
    indices = sorted(i for i, _ in table.items() if type(i) is int)
    values = [table.get(i) for i in indices]
    for index, value in zip(indices, values, strict=True):
        if kinds and type_of(value) not in kinds:
            raise call.error(
                "operators.lists.no-number-in-table", table, index=index, found=type_of(value)
            )
    return values


def _function_of_list(call: Call, word: str) -> ListReel:
    settings = {"PHAS": 0.0, "AMPL": 1.0, "A": 1.0, "B": 0.0}
    frequency = call.given(_FREQUENCY, call.keyword_end) if word == "SINU" else 0.0
    names = ("PHAS", "AMPL") if word == "SINU" else ("A", "B")
    while (name := call.keyword(names)) is not None:
        settings[name] = call.given(_SETTINGS[name], call.keyword_end)
    call.keyword(("PROG",))
    x = np.asarray(_read_items(call, _REAL), dtype=float)
    if word == "SINU":
        angle = np.radians(360.0 * frequency * x + settings["PHAS"])
        return ListReel(settings["AMPL"] * np.sin(angle))
    line = settings["A"] * x + settings["B"]
    if word == "LOGA" and np.any(line <= 0):
        raise call.error("operators.lists.logarithm", smallest=line.min())
    if word == "LINE":
        return ListReel(line)
    return ListReel(np.exp(line) if word == "EXPO" else np.log(line))


@operator("LECT", *_items("ENTIER"), family="lists", reads_itself=_FREE)
def lect(call: Call) -> ListEnti:
    """Read integers."""
    items = _read_items(call, ("ENTIER",))
    if not all(abs(i) < 2**63 for i in items):
        raise call.error("operators.lists.integer-too-large")
    if any(isinstance(i, float) and i != math.floor(i) for i in items):
        raise call.error("operators.lists.integers-only")
    return ListEnti(np.asarray(items, dtype=np.int64))


@operator(
    "MOTS",
    many("words", "MOT", "ENTIER", en="words, or N * word", range=ANY_NUMBER),
    family="lists",
    reads_itself=_FREE,
)
def mots(call: Call) -> ListMots:
    """Read words."""
    words: list[str] = []
    while True:
        behind = (i for i, o in enumerate(call.operands) if not isinstance(o.value, Mot))
        row = next(behind, len(call.operands))
        words += [str(o.value) for o in call.operands[:row]]
        call.take_first(row)
        operand = call.operands[0] if call.operands else None
        if operand is not None and type(operand.value) is int:
            count = call.given(_TIMES)
            if not _star(call):
                raise call.error("operators.lists.number-among-words", count)
            check_length(len(words) + count)
            _tell_no_time(call, count)
            words += [str(call.required("MOT"))] * count
            continue
        found = call.read("MOT")
        if found is None:
            return ListMots(words)
        words.append(str(found.value))


@operator("SUIT", family="lists", full_name="SUITE")
def suit(
    fields: tuple[Any, ...] = Many("CHPOINT", "LISTCHPO", en="fields, in order"),
    older: bool = Flag("CHPO", en="changes nothing: its word of before 2012"),
) -> ListChpo:
    """Collect fields."""
    flat: list[Any] = []
    for field in fields:
        flat += field.values if isinstance(field, ListChpo) else [field]
    return ListChpo(flat)


@operator(
    "ENUM",
    many("objects", en="objects of one type, or N * object"),
    family="lists",
    reads_itself=_FREE,
)
def enum(call: Call) -> ListObje:
    """Collect objects."""
    table = _table_said(call)
    objects = _by_integers(call, table) if table is not None else _repeated_objects(call)
    values: list[Any] = []
    for value in objects:
        values += value.values if isinstance(value, ListObje) else [value]
        if values and type_of(values[-1]) != type_of(values[0]):
            told = {"first": type_of(values[0]), "found": type_of(values[-1])}
            raise call.error("operators.lists.object-of-other-type", value, **told)
    return ListObje(values)


def _repeated_objects(call: Call) -> list[Any]:
    """Objects of any type, each as often as the integer and the star before it say."""
    found: list[Any] = []
    while call.operands:
        value = call.operands[0].value
        call.take_first(1)
        if type(value) is int and _star(call):
            check_length(len(found) + max(value, 0))
            if value < 0 or not call.operands:
                raise call.error("operators.lists.repetition-count", value, count=value)
            found += [call.operands[0].value] * value
            call.take_first(1)
            continue
        found.append(value)
    return found
