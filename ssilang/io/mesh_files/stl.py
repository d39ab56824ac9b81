"""Surfaces of triangles in STL files, text and binary."""

import struct
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError, OutputError, readable
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.mesh import Mesh


def stl_lines(mesh: Mesh) -> list[str]:
    """The lines of a text file of the triangles of a mesh.

    Raises
    ------
    OutputError
        If the mesh holds other cells than TRI3.
    """
    others = {b.cell_type for b in mesh.blocks} - {"TRI3"}
    if others or not mesh.blocks:
        raise OutputError("io.stl-holds-tri3-only", others=others)
    lines = ["solid surface"]
    for block in mesh.blocks:
        corners = block.coordinates
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        normal = normal / np.where(length > 0, length, 1.0)
        for n, triangle in zip(normal.tolist(), corners.tolist(), strict=True):
            lines.append(f"facet normal {n[0]!r} {n[1]!r} {n[2]!r}")
            lines.append("outer loop")
            lines += [f"vertex {x!r} {y!r} {z!r}" for x, y, z in triangle]
            lines += ["endloop", "endfacet"]
    lines.append("endsolid surface")
    return lines


def read_stl(path: Path) -> FloatArray:
    """Corners of the triangles, shape (n, 3, 3).

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    with readable(path):
        raw = path.read_bytes()
    (count,) = struct.unpack_from("<I", raw, 80) if len(raw) >= 84 else (-1,)
    try:
        if len(raw) == 84 + 50 * count:
            kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
            corners = np.frombuffer(raw, kind, count, 84)["corners"].astype(float)
        else:
            words = [t.split() for t in raw.decode("latin-1").splitlines()]
            rows = [w[1:4] for w in words if w[:1] == ["vertex"]]
            corners = np.array(rows, dtype=float).reshape(-1, 3, 3)
        if not np.isfinite(corners).all():
            raise ValueError("nan, inf")
    except ValueError as error:
        raise InputError("io.no-readable-stl-file", name=path.name, error=error) from error
    if len(corners) == 0:
        raise InputError("io.holds-no-triangles", name=path.name)
    return corners
