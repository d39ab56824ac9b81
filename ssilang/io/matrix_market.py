"""Assembled matrices as Matrix Market text, with the list of their unknowns.

Source: R. F. Boisvert, R. Pozo, K. A. Remington, "The Matrix Market Exchange Formats", NIST 1996.
"""

import io
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.scientific import sp
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.matrix import Matrix


@dataclass(frozen=True, eq=False)
class System:
    """An assembled matrix, its multipliers behind its unknowns: [K D^T; C 0]."""

    rows: IntArray  # (n_terms,) lower triangle if `symmetric`, by columns
    columns: IntArray
    values: FloatArray
    size: int
    symmetric: bool
    nodes: IntArray  # (size,) node of each unknown, multiplier nodes last
    names: tuple[str, ...]
    duals: tuple[str, ...]


def system_of(matrix: Matrix) -> System:
    """The system that RESO solves, before any elimination."""
    numbering = assembly.numbering_of(matrix)
    stiffness = assembly.assemble(matrix, numbering)
    held = assembly.constraint_matrix(matrix, numbering)
    whole: Any = stiffness
    if len(held.multipliers):
        parts: Any = [[stiffness, held.D.T], [held.C, None]]
        whole = sp.block_array(parts)
    symmetric = assembly.is_symmetric(matrix)
    terms = sp.coo_array(sp.tril(whole) if symmetric else whole)
    order = np.lexsort((terms.row, terms.col))
    count = len(held.multipliers)
    return System(
        terms.row[order].astype(np.int64),
        terms.col[order].astype(np.int64),
        terms.data[order],
        whole.shape[0],
        symmetric,
        np.concatenate([numbering.nodes, held.multipliers]),
        (*(numbering.unknowns[c] for c in numbering.codes), *["LX"] * count),
        (*(numbering.duals[c] for c in numbering.codes), *["FLX"] * count),
    )


def market_text(system: System, title: str = "") -> bytes:
    """The Matrix Market file; rows and columns count from 1."""
    from scipy.io import mmwrite

    shape = (system.size, system.size)
    made = io.BytesIO()
    mmwrite(
        made,
        sp.coo_array((system.values, (system.rows, system.columns)), shape=shape),
        comment=title,
        symmetry="symmetric" if system.symmetric else "general",
    )
    return made.getvalue()


def unknown_lines(system: System) -> list[str]:
    """For each unknown, then for each equation: local node, component; then the names' lists."""
    lines = []
    local = np.unique(system.nodes, return_inverse=True)[1].ravel() + 1
    for names in (system.names, system.duals):
        known = list(dict.fromkeys(names))
        place = {name: i for i, name in enumerate(known, start=1)}
        lines += [f"{n} {place[name]}" for n, name in zip(local.tolist(), names, strict=True)]
    for names in (system.names, system.duals):
        lines.append(" ".join(dict.fromkeys(names)))
    return lines


def node_lines(system: System, coordinates: FloatArray) -> list[str]:
    """Coordinates of the local nodes, and their number in the script (from 1) at the end."""
    ids = np.unique(system.nodes)
    return [
        f"{x!r} {y!r} {z!r} {i + 1}"
        for i, (x, y, z) in zip(ids.tolist(), coordinates[ids].tolist(), strict=True)
    ]
