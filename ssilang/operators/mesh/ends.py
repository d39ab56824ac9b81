"""How operators that draw lines read their ends, numbers of elements and mesh sizes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.families import Family, family_of
from ssilang.kernel.mesh.lines.lines import (
    CurveMap,
    different_nodes,
    end_sizes,
    line_ends,
    mesh_curve,
)
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.run.call import Call
from ssilang.language.values import type_of
from ssilang.operators.workspace import Workspace, workspace

SIZES_EN = (
    "N1 > 0: that many equal elements; N1 < 0: that many, graded by the mesh sizes of the ends; "
    "without N1 the sizes decide. DINI and DFIN replace the sizes that the ends carry. A line in "
    "place of an end point is continued; a line alone is closed."
)
SIZES_FR = (
    "N1 > 0 : N1 éléments égaux ; N1 < 0 : N1 éléments gradués selon les densités ; sans N1 les "
    "densités décident. DINI et DFIN remplacent les densités des extrémités. Une ligne à la place "
    "d'une extrémité est prolongée ; une ligne seule est fermée."
)


@dataclass
class Cuts:
    """Number of elements and sizes that stand in a call: N1, 'DINI' D1, 'DFIN' D2; 0 if absent."""

    count: int = 0
    first: float = 0.0
    last: float = 0.0

    def sizes(self, densities: tuple[float, float]) -> tuple[float, float]:
        """The given sizes, else those of the two ends."""
        return self.first or densities[0], self.last or densities[1]


def read_sizes(call: Call, cuts: Cuts) -> None:
    """Consume 'DINI' and 'DFIN' with their values where they stand next."""
    while (word := call.keyword(("DINI", "DFIN"))) is not None:
        size = call.required("FLOTTANT", after=call.keyword_end)
        if size <= 0.0:
            raise call.bad(f"a mesh size is positive, this one is {size:g}", size)
        if word == "DINI":
            cuts.first = size
        else:
            cuts.last = size


def read_count(call: Call, cuts: Cuts) -> None:
    """Consume a number of elements if one stands there; 0 counts as none."""
    operand = call.read("ENTIER")
    if operand is not None:
        cuts.count = int(operand.value)


def take_number(call: Call, word: str) -> float | None:
    """Consume the first operand of exactly this type before the next word, else None."""
    for i, operand in enumerate(call.operands):
        if type_of(operand.value) == word:
            call.used.append(operand)
            del call.operands[i]
            return float(operand.value)
        if type_of(operand.value) in ("MOT", "PROCEDUR"):
            break
    return None


def count_and_number(call: Call) -> tuple[int, float | None]:
    """An optional number of elements and a real that may be written as an integer.

    With two integers the first is the number of elements; one integer alone is the real.
    """
    real = take_number(call, "FLOTTANT")
    first = take_number(call, "ENTIER")
    second = take_number(call, "ENTIER") if real is None else real
    if second is None:
        return 0, first
    return int(first or 0), second


def chosen_family(ws: Workspace) -> Family:
    """Cells that go with OPTI ELEM.

    Raises
    ------
    MeshError
        If it was not set.
    """
    if not ws.element:
        raise MeshError("no element type is chosen yet", "set it: OPTI ELEM QUA4 (SEG2, TRI3 ...)")
    return family_of(ws.element)


@dataclass(frozen=True)
class Ends:
    """Where a new line starts and ends, and the lines that it continues on either side."""

    start: int
    end: int
    before: Mesh | None = None
    after: Mesh | None = None


def ends_of(call: Call, items: Sequence[Point | Mesh]) -> Ends:
    """Ends from one or two points or lines; a line alone is closed from its end to its start."""
    if not items:
        raise call.missing(("POINT", "MAILLAGE"))
    first = items[0]
    if len(items) == 1:
        if isinstance(first, Point):
            raise call.missing(("POINT",))
        start, end = line_ends(first)
        return Ends(end, start, first)
    second = items[1]
    start = first.node if isinstance(first, Point) else line_ends(first)[1]
    end = second.node if isinstance(second, Point) else line_ends(second)[0]
    before = first if isinstance(first, Mesh) else None
    return Ends(start, end, before, second if isinstance(second, Mesh) else None)


def positions(ws: Workspace, *nodes: int) -> list[FloatArray]:
    """Copies of the coordinates of nodes."""
    return [ws.nodes.coordinates[n].copy() for n in nodes]


def drawn(call: Call, ends: Ends, curve: CurveMap, length: float, cuts: Cuts) -> Mesh:
    """The line along a curve between the ends, joined to the lines on either side."""
    ws = workspace(call.session)
    different_nodes(ws.nodes, ends.start, ends.end)
    parts = subdivide(length, *cuts.sizes(end_sizes(ws.nodes, ends.start, ends.end)), cuts.count)
    quadratic = chosen_family(ws).quadratic
    line = mesh_curve(ws.nodes, curve, ends.start, ends.end, parts, quadratic, ws.colour)
    pieces = [m for m in (ends.before, line, ends.after) if m is not None]
    return union(*pieces, as_given=True)


def cuts_and_items(call: Call) -> tuple[Cuts, list[Any]]:
    """Number of elements, sizes and points or lines, in whatever order they stand."""
    cuts = Cuts()
    items: list[Any] = []
    before = -1
    while before != len(call.operands):
        before = len(call.operands)
        read_sizes(call, cuts)
        if not cuts.count:
            read_count(call, cuts)
        items += call.all("POINT", "MAILLAGE")
    return cuts, items
