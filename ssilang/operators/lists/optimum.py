"""EXCE: a step towards the least value of a function under conditions."""

from ssilang.kernel.solvers.asymptotes import least, least_linear, shares
from ssilang.operators.prelude import *

_FIXED = 1.0 / 3.0  # T0: asymptotes x T0 and x / T0
_MOVING = 0.7  # S0: they come nearer by it where a variable swings, else go off by 1/sqrt(S0)
_GIVEN_UP = 50.0  # DELTA0: cost of giving up a condition, beside the change of F over the range
_NEAREST, _FARTHEST = 0.01, 10.0  # distances of moving ones, shares of the range
_METHODS = ("STA", "MOV", "LIN")
_HISTORY = "EXCE_ASYMPTOTES"


@operator("EXCE", family="lists", full_name="EXCELLENCE")
def exce(call: Call, table: Table = Arg("TABLE", en="values and slopes")) -> Table:
    """One convex problem."""
    x = _numbers(call, table.get("VX0"), "VX0", None)
    low, high = (_numbers(call, table.get(i), i, len(x)) for i in ("VXMIN", "VXMAX"))
    bounds = (low, high)
    if (x < bounds[0]).any() or (x > bounds[1]).any():
        raise call.error("operators.lists.point-out-of-bounds", table)
    values, slopes = _functions(call, table, len(x))
    # Largest multipliers (m,): infinite for the conditions that the present point meets. To give
    # up what it misses of another one costs DELTA0 times what F may change over the range.
    change = float(np.abs(slopes[0]) @ (high - low))
    cost = _share(call, table, "DELTA0", _GIVEN_UP, 1.0, np.inf) * change
    missed = values[1:] > 0.0
    ceiling = np.full(len(missed), np.inf)
    ceiling[missed] = max(cost, np.finfo(float).tiny) / values[1:][missed]
    method = _method(call, table)
    if method == "LIN":
        table.set(Mot("VX0"), _table_of(least_linear(x, values, slopes, bounds, ceiling)))
        return table
    asymptotes = _asymptotes(call, table, x, bounds, method)
    best = least(shares(x, values, slopes, bounds, asymptotes), x, ceiling)
    table.set(Mot(_HISTORY), _history(table, x, asymptotes))
    table.set(Mot("VX0"), _table_of(best))
    return table


def _functions(call: Call, table: Table, count: int) -> tuple[FloatArray, FloatArray]:
    """Values (m + 1,), less their bounds, and slopes (m + 1, n) of F and the conditions."""
    rows = [_numbers(call, table.get("VF"), "VF", count, 0)]
    conditions = table.get("MC")
    while isinstance(conditions, Table) and conditions.has(len(rows)):
        rows.append(_numbers(call, conditions.get(len(rows)), "MC", count, 0))
    values = np.array([row[0] for row in rows])
    values[1:] -= _numbers(call, table.get("VCMAX"), "VCMAX", len(rows) - 1)
    return values, np.array([row[1:] for row in rows])


def _method(call: Call, table: Table) -> str:
    method = str(table.get("METHODE", "STA")).strip().upper()[:3]
    if method not in _METHODS:
        raise call.error("operators.lists.no-such-method", method=method, methods=list(_METHODS))
    return method


def _asymptotes(
    call: Call, table: Table, x: FloatArray, bounds: tuple[FloatArray, FloatArray], method: str
) -> tuple[FloatArray, FloatArray]:
    """Lower and upper asymptotes (n,)."""
    extent = bounds[1] - bounds[0]
    history = table.get(_HISTORY)
    s = _share(call, table, "S0", _MOVING, 0.0, 1.0)
    if method == "STA" or not isinstance(history, Table):
        t = _share(call, table, "T0", _FIXED if method == "STA" else s, 0.0, 1.0)
        near, far = np.abs(x) * t, np.abs(x) / t
        wide = (bounds[0] < 0.0) & (bounds[1] > 0.0) | (x == 0.0)
        lower = np.where(wide, x - 2.0 * extent, np.where(x > 0.0, near, -far))
        return lower, np.where(wide, x + 2.0 * extent, np.where(x > 0.0, far, -near))
    last, older, lower, upper = (_numbers(call, history.get(i), _HISTORY, len(x)) for i in range(4))
    turn = (x - last) * (last - older)
    factor = np.where(turn < 0.0, s, np.where(turn > 0.0, 1.0 / np.sqrt(s), 1.0))
    below = np.clip(factor * (last - lower), _NEAREST * extent, _FARTHEST * extent)
    above = np.clip(factor * (upper - last), _NEAREST * extent, _FARTHEST * extent)
    return x - below, x + above


def _history(table: Table, x: FloatArray, asymptotes: tuple[FloatArray, FloatArray]) -> Table:
    """The present point, the one before it and the asymptotes, for the next step of MOV."""
    before = table.get(_HISTORY)
    older = before.get(0) if isinstance(before, Table) else _table_of(x)
    points = (_table_of(x), older, *map(_table_of, asymptotes))
    return Table.of(dict(enumerate(points)))


def _share(call: Call, table: Table, index: str, default: float, low: float, high: float) -> float:
    """A setting between two values, both excluded."""
    value = table.get(index, default)
    if not isinstance(value, int | float) or not low < value < high:
        raise call.error("operators.lists.setting-out-of-range", index=index, low=low, high=high)
    return float(value)


def _numbers(call: Call, held: object, index: str, count: int | None, first: int = 1) -> FloatArray:
    """The numbers of a table from `first` on: up to `count`, or all that follow each other."""
    found: list[float] = []
    while isinstance(held, Table) and (count is None or first + len(found) <= count):
        number = held.get(first + len(found))
        if not isinstance(number, int | float):
            break
        found.append(float(number))
    wanted = 1 if count is None else count - first + 1
    if len(found) < wanted:
        raise call.error(
            "operators.lists.numbers-in-entry", index=index, found=len(found), count=wanted
        )
    return np.array(found)


def _table_of(values: FloatArray) -> Table:
    return Table.numbered((float(value) for value in values), "VECTEUR")
