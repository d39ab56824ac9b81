"""VTK's cell numbers and node orders for Cast3M's cell types.

`ORDERS[name]` is (VTK cell type, local nodes in VTK's order). VTK lists corners first, then
middles; Cast3M walks along the contour. Joints become the flat cell between their two faces: it
has no thickness as long as the joint is closed and opens with the displacement in ParaView's
"Warp By Vector". The sixteen-node joint has no VTK cell of its own: its corners are written.

Source: the VTK file formats and `vtkCellType.h` (numbers 1 to 31).
"""

from __future__ import annotations

from ssilang.kernel.mesh.cells import POLYGON_SIDES

VtkOrder = tuple[int, tuple[int, ...]]

ORDERS: dict[str, VtkOrder] = {
    "POI1": (1, (0,)),
    "SEG2": (3, (0, 1)),
    "SEG3": (21, (0, 2, 1)),
    "TRI3": (5, (0, 1, 2)),
    "TRI6": (22, (0, 2, 4, 1, 3, 5)),
    "TRI7": (34, (0, 2, 4, 1, 3, 5, 6)),
    "QUA4": (9, (0, 1, 2, 3)),
    "QUA8": (23, (0, 2, 4, 6, 1, 3, 5, 7)),
    "QUA9": (28, (0, 2, 4, 6, 1, 3, 5, 7, 8)),
    **{name: (7, tuple(range(n))) for name, n in POLYGON_SIDES.items()},
    "TET4": (10, (0, 1, 2, 3)),
    "TE10": (24, (0, 2, 4, 9, 1, 3, 5, 6, 7, 8)),
    "PRI6": (13, (0, 1, 2, 3, 4, 5)),
    "PR15": (26, (0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8)),
    "PYR5": (14, (0, 1, 2, 3, 4)),
    "PY13": (27, (0, 2, 4, 6, 12, 1, 3, 5, 7, 8, 9, 10, 11)),
    "CUB8": (12, (0, 1, 2, 3, 4, 5, 6, 7)),
    "CU20": (25, (0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11)),
    # complete cells without VTK counterpart, or with other inner nodes, are written without them
    "TE15": (24, (0, 2, 4, 9, 1, 3, 5, 6, 7, 8)),
    "PY19": (27, (0, 2, 4, 6, 12, 1, 3, 5, 7, 8, 9, 10, 11)),
    "PR21": (26, (0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8)),
    "CU27": (25, (0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11)),
    "RAC2": (9, (0, 1, 3, 2)),
    "RAC3": (30, (0, 2, 5, 3, 1, 4)),
    "LIA3": (13, (0, 1, 2, 3, 4, 5)),
    "LIA4": (12, (0, 1, 2, 3, 4, 5, 6, 7)),
    "LIA6": (31, (0, 2, 4, 6, 8, 10, 1, 3, 5, 7, 9, 11)),
    "LIA8": (12, (0, 2, 4, 6, 8, 10, 12, 14)),
}
