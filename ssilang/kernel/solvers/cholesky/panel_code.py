"""Writes the code of `panel_products` in LLVM's form.

A vector holds eight numbers: LLVM takes as many registers for it as the processor needs. What is
left of a row is read and written under a mask. A pass takes some rows of a panel together, from
one end to the other: memory is read along few lines.
"""

# mypy: allow-untyped-calls

from collections.abc import Sequence
from typing import Any

from llvmlite import ir
from numba.core import cgutils

WIDTH = 8  # numbers in a vector
TOGETHER = 4  # rows

_INT, _INT32, _FLOAT = ir.IntType(64), ir.IntType(32), ir.DoubleType()
_VECTOR, _MASK = ir.VectorType(_FLOAT, WIDTH), ir.VectorType(ir.IntType(1), WIDTH)
_NUMBERS = ir.VectorType(_INT, WIDTH)
_ZERO = ir.Constant(_VECTOR, [0.0] * WIDTH)
_KIND = f"v{WIDTH}f64"
_FUSED = ("contract",)

Value = Any  # of LLVM


class _Writer:
    """Statements on vectors, at the place of a builder."""

    def __init__(self, builder: Any) -> None:
        self.b = builder

    def place(self, of: Value, *offsets: Value) -> Value:
        """The address some numbers further on."""
        for offset in offsets:
            of = self.b.gep(of, [offset])
        return of

    def loop(self, start: Value, stop: Value, step: int) -> Any:
        """Statements for each number from start on below stop."""
        return cgutils.for_range_slice(self.b, start, stop, _i(step), _INT)

    def whole(self, count: Value, size: int) -> Value:
        """The largest multiple of a power of two that is not above."""
        return self.b.and_(count, _i(-size))

    def spread(self, value: Value, kind: Any) -> Value:
        """A vector of one number."""
        nothing = ir.Constant(kind, ir.Undefined)
        first = self.b.insert_element(nothing, value, ir.Constant(_INT32, 0))
        zeros = ir.Constant(ir.VectorType(_INT32, WIDTH), [0] * WIDTH)
        return self.b.shuffle_vector(first, nothing, zeros)

    def mask(self, count: Value) -> Value:
        """The first ones of a vector."""
        places = ir.Constant(_NUMBERS, list(range(WIDTH)))
        return self.b.icmp_signed("<", places, self.spread(count, _NUMBERS))

    def _call(self, name: str, result: Any, *args: Value) -> Value:
        kind = ir.FunctionType(result, [a.type for a in args])
        made = cgutils.get_or_insert_function(self.b.module, kind, f"llvm.{name}")
        return self.b.call(made, args)

    def read(self, at: Value, mask: Value | None = None) -> Value:
        """A vector from an address."""
        at = self.b.bitcast(at, _VECTOR.as_pointer())
        if mask is None:
            found = self.b.load(at)
            found.align = 8
            return found
        return self._call(f"masked.load.{_KIND}.p0", _VECTOR, at, _i32(8), mask, _ZERO)

    def write(self, value: Value, at: Value, mask: Value | None = None) -> None:
        """A vector to an address."""
        at = self.b.bitcast(at, _VECTOR.as_pointer())
        if mask is None:
            self.b.store(value, at).align = 8
        else:
            self._call(f"masked.store.{_KIND}.p0", ir.VoidType(), value, at, _i32(8), mask)

    def add(self, sums: Value, x: Value, y: Value) -> None:
        """A place of sums += x y."""
        product = self.b.fmul(x, y, flags=_FUSED)
        self.b.store(self.b.fadd(self.b.load(sums), product, flags=_FUSED), sums)

    def room(self) -> Value:
        """A place for a vector."""
        return cgutils.alloca_once(self.b, _VECTOR)

    def total(self, vector: Value) -> Value:
        """The sum of a vector's numbers."""
        kind = ir.FunctionType(_FLOAT, [_FLOAT, _VECTOR])
        name = f"llvm.vector.reduce.fadd.{_KIND}"
        made = cgutils.get_or_insert_function(self.b.module, kind, name)
        start = ir.Constant(_FLOAT, -0.0)
        return self.b.call(made, [start, vector], fastmath=("reassoc",))

    def in_pieces(self, count: Value) -> Any:
        """Vectors that cover a count: (first, mask) with statements to follow.

        Statements are written for each kind of piece.
        """
        ones = self.whole(count, WIDTH)
        with self.loop(_i(0), ones, WIDTH) as (first, _):
            yield first, None
        with self.b.if_then(self.b.icmp_signed("<", ones, count)):
            yield ones, self.mask(self.b.sub(count, ones))


def _i(value: int) -> Value:
    return ir.Constant(_INT, value)


def _i32(value: int) -> Value:
    return ir.Constant(_INT32, value)


def _row_products(
    w: _Writer, rows: Value, stride: Value, first: Value, together: int, vector: Value, count: Value
) -> Sequence[Value]:
    """Scalar products of rows that follow one another with a vector of a count of numbers."""
    sums = [w.room() for _ in range(together)]
    for place in sums:
        w.b.store(_ZERO, place)
    begin = w.place(rows, w.b.mul(first, stride))
    for column, mask in w.in_pieces(count):
        part = w.read(w.place(vector, column), mask)
        for c, place in enumerate(sums):
            row = w.place(begin, w.b.mul(stride, _i(c)), column)
            w.add(place, w.read(row, mask), part)
    return [w.total(w.b.load(place)) for place in sums]


def subtract(
    builder: Any, values: Value, pos: Value, w: Value, m: Value, x: Value, at: Value, to: Value
) -> None:
    """y -= P^T b, some rows of P at a time: they are read from one end to the other."""
    writer = _Writer(builder)
    rows, b, y = writer.place(values, pos), writer.place(x, at), writer.place(x, to)
    many = writer.whole(w, TOGETHER)
    for start, stop, together in ((_i(0), many, TOGETHER), (many, w, 1)):
        with writer.loop(start, stop, together) as (j, _):
            begin, factors = writer.place(rows, builder.mul(j, m)), []
            for c in range(together):
                factor = builder.fneg(builder.load(writer.place(b, j, _i(c))))
                factors.append(writer.spread(factor, _VECTOR))
            for column, mask in writer.in_pieces(m):
                total = writer.read(writer.place(y, column), mask)
                for c, factor in enumerate(factors):
                    row = writer.place(begin, builder.mul(m, _i(c)), column)
                    product = builder.fmul(writer.read(row, mask), factor, flags=_FUSED)
                    total = builder.fadd(total, product, flags=_FUSED)
                writer.write(total, writer.place(y, column), mask)


def subtract_transposed(
    builder: Any, values: Value, pos: Value, w: Value, m: Value, x: Value, at: Value, to: Value
) -> None:
    """b -= P y."""
    writer = _Writer(builder)
    rows, b, y = writer.place(values, pos), writer.place(x, at), writer.place(x, to)
    many = writer.whole(w, TOGETHER)
    for start, stop, together in ((_i(0), many, TOGETHER), (many, w, 1)):
        with writer.loop(start, stop, together) as (j, _):
            found = _row_products(writer, rows, m, j, together, y, m)
            for c, total in enumerate(found):
                place = writer.place(b, j, _i(c))
                builder.store(builder.fsub(builder.load(place), total), place)


def times_lower(builder: Any, values: Value, pos: Value, w: Value, x: Value, at: Value) -> None:
    """b = I b, the last rows first: those above need what is replaced."""
    writer = _Writer(builder)
    rows, b = writer.place(values, pos), writer.place(x, at)
    rest = builder.and_(w, _i(TOGETHER - 1))
    for above, count, together in ((rest, builder.sub(w, rest), TOGETHER), (_i(0), rest, 1)):
        with writer.loop(_i(0), count, together) as (done, _):
            left = builder.sub(builder.add(above, count), done)
            first = builder.sub(left, _i(together))
            found = _row_products(writer, rows, w, first, together, b, left)
            for c, total in enumerate(found):
                builder.store(total, writer.place(b, first, _i(c)))


def times_upper(builder: Any, values: Value, pos: Value, w: Value, x: Value, at: Value) -> None:
    """b = I^T b, the first columns first: those behind need none of what is replaced."""
    writer = _Writer(builder)
    rows, b, sums = writer.place(values, pos), writer.place(x, at), writer.room()
    for column, mask in writer.in_pieces(w):
        builder.store(_ZERO, sums)
        with writer.loop(column, w, 1) as (j, _):
            factor = writer.spread(builder.load(writer.place(b, j)), _VECTOR)
            row = writer.place(rows, builder.mul(j, w), column)
            writer.add(sums, writer.read(row, mask), factor)
        writer.write(builder.load(sums), writer.place(b, column), mask)
