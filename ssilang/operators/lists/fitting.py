"""MOCA LEVM GANE: parameters of functions by least squares."""

from ssilang.kernel.fields import node_algebra
from ssilang.language.run.procedures import call_procedure
from ssilang.operators.prelude import *

_ROUNDS = 200
"""Steps of LEVM, taken and refused."""

_GAIN = 1e-12
"""Share of its value by which the criterion falls where LEVM is done."""


@operator("MOCA", family="lists")
def moca(
    call: Call,
    start: ListReel = Arg("LISTREEL", en="parameters", range=ANY_NUMBER),
    measured: ListReel = Arg("LISTREEL", en="measured values", range=ANY_NUMBER),
    values: ListReel = Arg("LISTREEL", en="values for the parameters", range=ANY_NUMBER),
    derivatives: tuple[ListReel, ...] = Many(
        "LISTREEL", at_least=1, en="derivative by each parameter", range=ANY_NUMBER
    ),
    weights: ListReel | None = Key(
        "POIDS", "LISTREEL", range=NOT_NEGATIVE, usual=Range(some=True), en="weights"
    ),
) -> ListReel:
    """Linear least squares from a first set of parameters."""
    if len(derivatives) != len(start.values):
        told = {"n_parameters": len(start.values), "n_derivatives": len(derivatives)}
        raise call.error("operators.lists.parameters-and-derivatives", **told)
    count = len(measured.values)
    w = np.ones(count) if weights is None else _of_length(call, weights, count)
    columns = [_of_length(call, d, len(w)) for d in derivatives]
    gap = measured.values - _of_length(call, values, len(w))
    step = np.linalg.lstsq(w[:, None] * np.column_stack(columns), w * gap, rcond=None)[0]
    return ListReel(start.values + step)


def _of_length(call: Call, values: ListReel, count: int) -> FloatArray:
    if len(values.values) != count:
        raise call.error(
            "operators.lists.one-value-a-point", values, found=len(values.values), count=count
        )
    return values.values


@operator("LEVM", family="lists")
def levm(
    call: Call,
    abscissas: ListReel = Key("ABSC", "LISTREEL", range=ANY_NUMBER, optional=False, en="points"),
    measured: ListReel = Key("ORDO", "LISTREEL", range=ANY_NUMBER, optional=False, en="values"),
    spreads: ListReel = Key("SIGM", "LISTREEL", range=ANY_NUMBER, optional=False, en="weights"),
    start: ListReel = Key(
        "PARA", "LISTREEL", range=ANY_NUMBER, optional=False, en="first parameters, none zero"
    ),
    function: Procedure = Key("PROC", "PROCEDUR", optional=False, en="`LY LDY = PROC1 LX LP`"),
) -> tuple[ListReel, float]:
    """Levenberg's and Marquardt's method."""
    count = len(abscissas.values)
    y, w = _of_length(call, measured, count), _of_length(call, spreads, count)

    def missed(p: FloatArray) -> tuple[FloatArray, FloatArray]:
        operands = [Operand(v, call.span) for v in (abscissas, ListReel(p))]
        session = call.session
        results = call_procedure(session.evaluator, function, Call(session, operands, call.span))
        if len(results) != 2 or not all(isinstance(r, ListReel) for r in results):
            raise call.error("operators.lists.values-and-derivatives", function)
        values = _of_length(call, results[0], count)
        slopes = _of_length(call, results[1], count * len(p)).reshape(count, len(p))
        return w * (values - y), w[:, None] * slopes

    p, criterion = _damped(missed, start.values.copy())
    return ListReel(p), criterion


def _damped(
    missed: Callable[[FloatArray], tuple[FloatArray, FloatArray]], p: FloatArray
) -> tuple[FloatArray, float]:
    """Parameters (k,) of the least sum of squares, from `p`, and that sum.

    Each step solves `(J^T J + d diag(J^T J)) h = - J^T f`; d falls after a step that gains and
    grows after one that does not (Marquardt, J. SIAM 11, 1963).
    """
    damping = 1e-3
    f, J = missed(p)
    criterion = float(f @ f)
    for _ in range(_ROUNDS):
        normal, slope = J.T @ J, J.T @ f
        scale = np.diag(normal).copy()
        scale[scale == 0.0] = 1.0
        step = np.linalg.lstsq(normal + damping * np.diag(scale), -slope, rcond=None)[0]
        f_next, J_next = missed(p + step)
        trial = float(f_next @ f_next)
        if np.isfinite(trial) and trial <= criterion:
            done = criterion - trial <= _GAIN * criterion
            p, f, J, criterion, damping = p + step, f_next, J_next, trial, 0.1 * damping
            if done:
                break
        else:
            damping *= 10.0
            if damping > 1e12:
                break
    return p, criterion


@operator("GANE", family="lists", full_name="GANEWTON")
def gane(
    call: Call,
    table: Table = Arg("TABLE", en="0: values, 1 to n: derivatives"),
    damping: float = Key("AMOR", "FLOTTANT", range=NOT_NEGATIVE, default=0.0, en="damping"),
    matrices: bool = Flag("MATR", en="not available"),
) -> Table:
    """A step of Gauss and Newton."""
    if matrices:
        raise call.error("operators.lists.gauss-newton-matrices", word="MATR")
    columns: list[object] = []
    while table.has(len(columns)):
        columns.append(table.get(len(columns)))
    if len(columns) < 2:
        raise call.error("operators.lists.no-derivatives", table)
    products = np.array([[_inner(call, table, a, b) for b in columns] for a in columns[1:]])
    normal = products[:, 1:] + damping * np.eye(len(columns) - 1)
    step = np.linalg.lstsq(normal, -products[:, 0], rcond=None)[0]
    return Table.numbered((float(h) for h in step), "VECTEUR")


def _inner(call: Call, table: Table, a: object, b: object) -> float:
    if isinstance(a, NodeField) and isinstance(b, NodeField):
        names = [n for n in a.components if n in b.components]
        return float(node_algebra.scalar_product(a, b, names, names).values.sum())
    if isinstance(a, ListReel) and isinstance(b, ListReel):
        return float(a.values @ _of_length(call, b, len(a.values)))
    if isinstance(a, (int, float)) and isinstance(b, (int, float)):
        return float(a) * float(b)
    raise call.error("operators.lists.no-scalar-product", table)
