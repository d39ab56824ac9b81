"""Names for motions that meet no stiffness: rigid-body motions, and what is free in them."""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import SingularMatrixError
from ssilang.kernel.base.graph import chains, entries, parts_of
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.statics.doubled import lying_on
from ssilang.messages.message import Sentence

_TRANSLATIONS = {"UX": 0, "UY": 1, "UZ": 2, "UR": 0}
_ROTATIONS = {"RX": 0, "RY": 1, "RZ": 2}
_NAMES = ("X", "Y", "Z")
_LOOKED_AT = 60  # free motions among which a message looks for those that it names


def rigid_motions(numbering: Numbering, centre: FloatArray | None = None) -> FloatArray:
    """Unit translations along X, Y, Z and small rotations about them at `centre`, (n, 6).

    `centre` (3,) is the mean of the nodes if it is not given. In axisymmetric models the columns
    that are no rigid motions there simply fit nothing.
    """
    points = numbering.table.coordinates[numbering.nodes]
    points = points - (points.mean(axis=0) if centre is None else centre)
    motions = np.zeros((numbering.size, 6))
    for name, axis in _TRANSLATIONS.items():
        at = numbering.where(name) if name in numbering.unknowns else np.empty(0, np.int64)
        motions[at, axis] = 1.0
        motions[at, 3:] = np.cross(np.eye(3), points[at][:, None])[..., axis]
    for name, axis in _ROTATIONS.items():
        if name in numbering.unknowns:
            motions[numbering.where(name), 3 + axis] = 1.0
    return motions


def wrong_signs(matrix: Matrix) -> IntArray:
    """First node (n,) of equalities that rigid motions break, and would not with one sign turned.

    Those between displacements alone are asked for translations: their nodes may be anywhere.
    """
    found, known = [np.zeros(0, np.int64)], {**_TRANSLATIONS, **_ROTATIONS}
    for r in matrix.relations:
        counts, names = np.diff(r.row_start), tuple(dict.fromkeys(r.unknowns))
        if not known.keys() >= {*names} or (counts < 2).all():
            continue
        codes, nodes = np.array([names.index(n) for n in r.unknowns]), r.nodes
        numbering = Numbering(r.table, names, names, nodes, codes, r.table.version)
        some = 6 if {*names} & {*_ROTATIONS} else 3
        terms = r.coefficients[:, None] * rigid_motions(numbering)[:, :some]
        sizes = np.add.reduceat(np.abs(terms), r.row_start[:-1]).max(axis=1)[:, None] * 1e-6
        rows = np.repeat(np.arange(len(counts)), counts)
        total = np.add.reduceat(terms, r.row_start[:-1])
        asked = (np.abs(total) > sizes).any(axis=1) & (counts > 1) & (r.sense == 0)
        fits = (np.abs(total[rows] - 2.0 * terms) <= sizes[rows]).all(axis=1)
        found.append(nodes[r.row_start[:-1]][np.bincount(rows, fits, len(counts)) * asked > 0])
    return np.concatenate(found)


def crossed_lines(matrix: Matrix) -> IntArray:
    """First node (n,) of ties of two lines alike, node by node from opposite ends."""
    found = [np.zeros(0, np.int64)]
    for r in matrix.relations:
        if len(r.row_start) > 3 and (np.diff(r.row_start) == 2).all():
            a, b = r.table.coordinates[r.nodes].reshape(-1, 2, 3).swapaxes(0, 1)
            apart, turned = (np.ptp(x - a, axis=0).max() for x in (b, b[::-1]))
            found += [r.nodes[:1]] if turned < 1e-6 * apart else []
    return np.concatenate(found)


def tied(numbering: Numbering, relations: sp.csr_array, *matrices: sp.csr_array) -> IntArray:
    """Body (0, 1 ...) of each unknown (n,): those of a node, and those that are coupled.

    Parameters
    ----------
    relations : csr array (m, n)
        Each row couples.
    matrices : csr arrays (n, n)
        Stiffness, mass.
    """
    order = np.argsort(numbering.nodes, kind="stable")
    same = numbering.nodes[order][1:] == numbering.nodes[order][:-1]
    of_nodes = order[:-1][same], order[1:][same]
    return parts_of(numbering.size, of_nodes, chains(relations), *map(entries, matrices))


def without_pairs(
    matrix: sp.csr_array, numbering: Numbering, first: IntArray, second: IntArray
) -> sp.csr_array:
    """A matrix (n, n) without what couples nodes `first` with `second` (m,), pair by pair."""
    nodes, most = numbering.nodes, len(numbering.table)
    low, high = numbering.table.resolve(first), numbering.table.resolve(second)
    terms = matrix.tocoo()
    places = nodes[terms.row] * most + nodes[terms.col]
    kept = ~np.isin(places, [low * most + high, high * most + low])
    return sp.csr_array((terms.data[kept], (terms.row[kept], terms.col[kept])), matrix.shape)


def singular(
    code: str, numbering: Numbering, motions: FloatArray, bodies: IntArray | None = None
) -> SingularMatrixError:
    """The error `code` for free motions (n, p) of a system.

    Each body that moves is named by its place (if there are several), with the rigid motions
    that are free, and the unknowns that move most.
    """
    count, motions = motions.shape[1], motions[:, :_LOOKED_AT]
    span = np.linalg.qr(motions)[0]
    free, named = _most_moved(numbering, span), named_motions(numbering, motions, bodies)
    apart = 0 if bodies is None else _nodes_on_other_bodies(numbering, span, bodies)
    told = {"count": count, "free": free, "more": count - len(free), "apart": apart}
    return SingularMatrixError(code, motions=named, **told)


def _nodes_on_other_bodies(numbering: Numbering, span: FloatArray, bodies: IntArray) -> int:
    """Nodes of the bodies that move at the place of a node of another body."""
    first = int(np.argmax(np.bincount(bodies, (span**2).sum(axis=1), minlength=1)))
    own = np.unique(numbering.nodes[bodies == first])
    return len(lying_on(numbering.table, own, np.setdiff1d(numbering.nodes, own))[0])


def named_motions(
    numbering: Numbering, motions: FloatArray, bodies: IntArray | None = None
) -> list[Sentence]:
    """The bodies that free motions (n, p) move and the rigid motions among these."""
    span = np.linalg.qr(motions)[0]
    labels = np.zeros(numbering.size, np.int64) if bodies is None else bodies
    several = len(np.unique(labels)) > 1
    moving = np.flatnonzero(np.bincount(labels, (span**2).sum(axis=1)) > 1e-9)
    parts = [_describe_body(numbering, span, labels == b, several) for b in moving[:3]]
    if len(moving) > 3:
        parts.append(Sentence("kernel.statics.more-bodies", count=len(moving) - 3))
    return [p for p in parts if p is not None]


def _describe_body(
    numbering: Numbering, span: FloatArray, own: BoolArray, several: bool
) -> Sentence | None:
    """The free rigid motions of one body and where it is, None if there is nothing to say."""
    nodes = np.unique(numbering.nodes[own])
    points = numbering.table.coordinates[nodes]
    centre, extent = points.mean(axis=0), float(np.abs(points).max())
    moves = own & np.isin(numbering.nodes, numbering.nodes[(span**2).sum(axis=1) > 1e-18])
    named = (_rigid_names(numbering, span, rows, centre, extent) for rows in (own, moves))
    names = next(filter(None, named), [])
    if not several:
        return Sentence("kernel.statics.motions", motions=names) if names else None
    told = {"n_nodes": len(nodes), "place": _place(centre, extent), "motions": names}
    return Sentence("kernel.statics.motions-of-body", **told)


def _rigid_names(
    numbering: Numbering, span: FloatArray, own: BoolArray, centre: FloatArray, extent: float
) -> list[Sentence]:
    """Names of the rigid motions of some unknowns that are free."""
    rigid = rigid_motions(numbering, centre)[own]
    left, size, _ = np.linalg.svd(span[own], full_matrices=False)
    local = left[:, size > 1e-6 * size.max(initial=0.0)]
    pure = [k for k in range(6) if _inside(rigid[:, k], local)]
    codes = ("kernel.statics.translation", "kernel.statics.rotation")
    names = [Sentence(codes[k // 3], axis=_NAMES[k % 3]) for k in pure]
    if len(pure) < local.shape[1]:
        names += _turns(rigid, local, pure, centre, extent)
    return names


def _inside(vector: FloatArray, basis: FloatArray) -> bool:
    size = np.linalg.norm(vector)
    return bool(size > 0.0 and np.linalg.norm(vector - basis @ (basis.T @ vector)) < 1e-6 * size)


def _turns(
    rigid: FloatArray, local: FloatArray, pure: list[int], centre: FloatArray, extent: float
) -> list[Sentence]:
    """Names of free rotations about other points than the body's centre."""
    found = []
    for axis in range(3):
        turn = 3 + axis
        if turn in pure or not rigid[:, turn].any():
            continue
        # the translation that makes the rotation free: least squares on what is outside
        shifts = [k for k in range(3) if rigid[:, k].any() and k not in pure and k != axis]
        columns = rigid[:, [turn, *shifts]]
        off = columns - local @ (local.T @ columns)
        by, *_ = np.linalg.lstsq(off[:, 1:], -off[:, 0], rcond=None)
        motion = columns[:, 0] + columns[:, 1:] @ by
        if not _inside(motion, local):
            continue
        slide = np.zeros(3)
        slide[shifts] = by
        fixed = centre + np.cross(np.eye(3)[axis], slide)
        place = _place(fixed, extent)
        found.append(Sentence("kernel.statics.rotation-around", axis=_NAMES[axis], place=place))
    return found


def _place(point: FloatArray, extent: float) -> FloatArray:
    return np.where(np.abs(point) < 1e-8 * extent, 0.0, point)


def _most_moved(numbering: Numbering, span: FloatArray) -> list[Sentence]:
    """Labels of the unknowns that move most, one for each motion, at most six."""
    rest = span.copy()
    labels = []
    for _ in range(min(6, span.shape[1])):
        size = np.linalg.norm(rest, axis=1)
        row = int(np.argmax(size > (1.0 - 1e-6) * size.max()))
        labels.append(numbering.label(row))
        direction = rest[row] / (np.linalg.norm(rest[row]) or 1.0)
        rest = rest - np.outer(rest @ direction, direction)
    return labels
