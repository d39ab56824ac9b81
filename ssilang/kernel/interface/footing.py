"""Footings: joints that belong together, and what they carry as one body.

Of the jumps and tractions at the points of a footing: the share of its area in contact, the force
that it presses with, the largest pressure (that of the toe once it rocks), the largest opening,
moment and rotation. It is in contact where nothing gapes.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.bed import Bed
from ssilang.kernel.interface.family import displacement_names
from ssilang.kernel.interface.interface import Interface, is_macro
from ssilang.kernel.interface.kinematics import JointCells
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.interface.laws.macro_law import Outline, outline_of
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices.assembly import Numbering

SINGULAR = 1e-9
"""Part of the largest moment of area below which points stand on one line."""


class Loads(NamedTuple):
    """What a footing carries at some instants; m rotation axes.

    Moment and rotation are those of the structure on the soil, so that a footing on springs has
    a positive stiffness.
    """

    share: FloatArray  # (k,) of the area in contact, 0 to 1
    force: FloatArray  # (k,) along the mean normal, positive in compression (N)
    pressure: FloatArray  # (k,) largest compression (Pa; N of joints of two points)
    opening: FloatArray  # (k,) largest normal jump, 0 if nothing is open (m)
    moment: FloatArray  # (k, m) about the centre of the area at rest (N m)
    rotation: FloatArray  # (k, m) of the structure's side (rad)


@dataclass(frozen=True, eq=False)
class Footing:
    """A footing at rest.

    Its structure is the side of the joints that was named first, or what stands above where that
    side is below the other.

    Attributes
    ----------
    points : array (g,)
        Its points among those of the interface.
    weights : array (g,)
        Area of each (1 for joints of two points, whose tractions are forces).
    frames : array (g, d, d)
        Rows t1, [t2,] n.
    places : array (g, 3)
    centre : array (3,)
        Of the area.
    axes : array (m, 3)
        Unit axes of moments and rotations: out of the plane, or two in the mean plane of the
        footing; none where it cannot rock (axisymmetric, a single point).
    unknowns : array (c,)
        Displacements of the structure's side, indices of the problem, increasing.
    turn : array (m, c)
        Rotation from these, by least squares over the area.
    ends : csr array (2 n_cells, g), optional
        In the plane: values at both ends of each cell from those of its points, so that contact
        ends where the straight line through these says, and toe and edge are those of the footing;
        in space each point counts whole.
    lengths : array (n_cells,)
        Area of each cell, with `ends`.
    pairs : bool
        Whether its joints have two points, whose pressures are forces.
    outline : Outline or None
        Base of a macro-element, whose jumps are rotations and opening.
    bed : Bed or None
        Its bed, where the ground of a macro-element yields.
    """

    points: IntArray
    weights: FloatArray
    frames: FloatArray
    places: FloatArray
    centre: FloatArray
    axes: FloatArray
    unknowns: IntArray
    turn: FloatArray
    ends: sp.csr_array | None = None
    lengths: FloatArray = field(default_factory=lambda: np.zeros(0))
    pairs: bool = False
    outline: Outline | None = None
    bed: Bed | None = None

    @property
    def area(self) -> float:
        """Its area (number of joints where these have two points)."""
        return float(self.weights.sum()) if self.outline is None else self.outline.area

    @property
    def normal(self) -> FloatArray:
        """Mean normal (3,), from the soil to the structure."""
        n = _in_space(np.einsum("g,gi->i", self.weights, self.frames[:, -1]))
        return n / np.linalg.norm(n)

    def loads(self, w: FloatArray, t: FloatArray, u: FloatArray) -> Loads:
        """What it carries at instants.

        Parameters
        ----------
        w, t : arrays (k, n_points, d)
            Jumps and tractions of the whole interface.
        u : array (k, c)
            Displacements at `unknowns`.
        """
        if self.outline is not None:
            return self._macro_loads(self.outline, w, t)
        w, t = w[:, self.points], t[:, self.points]
        wn, tn = w[..., -1], t[..., -1]
        opening, pressure = np.maximum(wn, 0.0).max(axis=1), np.maximum(-tn, 0.0).max(axis=1)
        vectors = _in_space(np.einsum("g,gij,kgi->kgj", self.weights, self.frames, t))
        arms = self.places - self.centre
        share: FloatArray = (wn <= 0.0) @ self.weights / self.area
        if self.ends is not None:
            jumps, pushes = self._at_ends(wn), self._at_ends(-tn)
            # of the area, where normal jumps leave no gap
            low, high = jumps.min(axis=2), jumps.max(axis=2)
            shut = np.where(high <= 0.0, 1.0, 0.0)
            partly = (low < 0.0) & (high > 0.0)
            shut[partly] = low[partly] / (low - high)[partly]
            share = shut @ self.lengths / self.area
            opening = np.maximum(opening, jumps.max(axis=(1, 2)))
            closed = (jumps <= 0.0).all(axis=2, keepdims=True)  # beside a gap it is no line
            pressure = np.maximum(pressure, np.where(closed, pushes, 0.0).max(axis=(1, 2)))
        return Loads(
            share,
            -vectors.sum(axis=1) @ self.normal,
            pressure,
            opening,
            np.cross(arms, vectors).sum(axis=1) @ self.axes.T,
            u @ self.turn.T,
        )

    def _macro_loads(self, outline: Outline, w: FloatArray, t: FloatArray) -> Loads:
        """Of a macro-element: its outline knows where it presses, or the places of its bed do.

        It opens above the ground at rest, wherever this has settled to.
        """
        at = self.points[0]
        own, whole = w[:, at], t[:, at]
        share, pressure = outline.share(own), outline.pressure(own)
        if self.bed is not None:
            w_bed, t_bed = w[:, self.bed.points], t[:, self.bed.points]
            whole = whole + self.bed.taken(t_bed)
            share = self.bed.in_contact(w_bed, t_bed)
            pressure = self.bed.pressures(w_bed, t_bed).max(axis=1)
        return Loads(
            share, -whole[:, -1], pressure, outline.opening(own), whole[:, :-1], own[:, :-1]
        )

    def _at_ends(self, values: FloatArray) -> FloatArray:
        """Values (k, g) of the points at both ends of each cell, (k, n_cells, 2)."""
        assert self.ends is not None
        return (self.ends @ values.T).T.reshape(len(values), -1, 2)


def footings_of(interface: Interface, numbering: Numbering) -> tuple[Footing, ...]:
    """The footings of an interface, the largest first.

    Surface joints that hang together by their nodes are one; so are the joints of two points of
    a zone, and each macro-element.
    """
    found: list[Footing] = []
    faces = [(j, rows.start) for j, rows in interface.placed if _is_face(j)]
    for cells in _hanging_together([j for j, _ in faces]):
        parts = [(*face, c) for face, c in zip(faces, cells, strict=True) if len(c)]
        found.append(_footing(parts, numbering))
    for j, rows in interface.placed:
        every = np.arange(len(j.upper))
        if is_macro(j.zone):
            found += [_macro(j, rows.start + int(c), int(c), interface) for c in every]
        elif not _is_face(j):
            found.append(_footing([(j, rows.start, every)], numbering))
    return tuple(sorted(found, key=lambda f: -f.area))


def _is_face(joints: JointCells) -> bool:
    return joints.element.face != "POI1"


def _hanging_together(joints: list[JointCells]) -> list[list[IntArray]]:
    """Cells of each zone, for each group of cells that share nodes of their upper side."""
    if not joints:
        return []
    nodes = [j.zone.cells.nodes.resolve(j.upper) for j in joints]
    size = max(int(x.max()) for x in nodes) + 1
    first = np.concatenate([np.repeat(x[:, 0], x.shape[1]) for x in nodes])
    other = np.concatenate([x.ravel() for x in nodes])
    labels = parts_of(size, (first, other))
    of_cells = [labels[x[:, 0]] for x in nodes]
    groups = np.unique(np.concatenate(of_cells))
    return [[np.flatnonzero(x == g) for x in of_cells] for g in groups]


def _in_space(values: FloatArray) -> FloatArray:
    """Vectors (..., d) with three components."""
    made = np.zeros((*values.shape[:-1], 3))
    made[..., : values.shape[-1]] = values
    return made


def _footing(parts: list[tuple[JointCells, int, IntArray]], numbering: Numbering) -> Footing:
    """The footing of some cells of zones, whose points begin at a place."""
    points, weights, frames, places, rows = [], [], [], [], []
    d = parts[0][0].element.dimension
    # where the side named first is the one below, what stands on it is the structure
    normal: Any = sum(
        np.einsum("ng,ngi->i", j.weights[c], j.frames[c][:, :, -1]) for j, _, c in parts
    )
    turned = bool(normal[-1] < -0.5 * np.linalg.norm(normal))
    for j, first, cells in parts:
        n, g = len(cells), j.weights.shape[1]
        nodes = j.zone.cells.nodes
        x = nodes.coordinates
        sides = [nodes.resolve(j.upper[cells]), nodes.resolve(j.lower[cells])]
        # two points may stand apart: the structure's is where its force acts
        middle = (x[sides[0]] + x[sides[1]]) / 2.0 if _is_face(j) else x[sides[turned]]
        points.append((first + cells[:, None] * g + np.arange(g)).ravel())
        weights.append(j.weights[cells].ravel())
        # from the other side jumps and tractions are the same in axes that all point away
        frames.append((-1.0 if turned else 1.0) * j.frames[cells].reshape(n * g, d, d))
        places.append(np.einsum("gm,nmx->ngx", j.shape, middle).reshape(-1, 3))
        codes = np.array([numbering.code(name) for name in displacement_names(j.zone)])
        index = numbering.index(sides[turned][:, :, None], codes)  # (n, m, d)
        rows.append((np.broadcast_to(j.shape[None], (n, *j.shape.shape)), index))
    A, x = np.concatenate(weights), np.concatenate(places)
    centre = A @ x / A.sum()
    held = np.unique(np.concatenate([i.ravel() for _, i in rows]))
    made = Footing(
        np.concatenate(points), A, np.concatenate(frames), x, centre, np.zeros((0, 3)),
        held[held >= 0], np.zeros((0, 0)), pairs=not _is_face(parts[0][0]),
    )  # fmt: skip
    axes, lever = _axes(made, parts[0][0].zone.mode)
    turn = np.zeros((len(axes), len(made.unknowns)))
    if len(axes):
        inverse = np.linalg.inv(lever.T @ (A[:, None] * lever))
        spread = (A[:, None] * lever) @ inverse  # (g, m)
        start = 0
        for shape, index in rows:
            n, g, _ = shape.shape
            mine = spread[start : start + n * g].reshape(n, g, -1)
            start += n * g
            share = np.einsum("nga,ngm,d->anmd", mine, shape, made.normal[:d])
            there = index >= 0
            column = np.searchsorted(made.unknowns, index[there])
            for a in range(len(axes)):
                np.add.at(turn[a], column, share[a][there])
    made = replace(made, axes=axes, turn=turn)
    return _with_ends(made, [(j, len(c)) for j, _, c in parts]) if d == 2 else made


def _with_ends(footing: Footing, parts: list[tuple[JointCells, int]]) -> Footing:
    """A footing in the plane with its cells' ends, if these have several points."""
    blocks = []
    for j, n in parts:
        if j.shape.shape[0] < 2:
            return footing
        s = j.shape @ np.linspace(-1.0, 1.0, j.shape.shape[1])  # places of the points, -1 to 1
        fit = np.linalg.pinv(np.stack([np.ones(len(s)), s], axis=1))
        both = np.array([[1.0, -1.0], [1.0, 1.0]]) @ fit
        blocks.append(sp.csr_array(sp.kron(sp.eye_array(n), both)))
    points = [n * j.shape.shape[0] for j, n in parts]
    weights = np.split(footing.weights, np.cumsum(points)[:-1])
    lengths = [w.reshape(n, -1).sum(axis=1) for (_, n), w in zip(parts, weights, strict=True)]
    ends = sp.csr_array(sp.block_diag(blocks, format="csr"))
    return replace(footing, ends=ends, lengths=np.concatenate(lengths))


def _axes(footing: Footing, mode: Mode) -> tuple[FloatArray, FloatArray]:
    """Rotation axes (m, 3) about which the points have an extent, and levers (g, m) there."""
    n, none = footing.normal, np.zeros((0, 3))
    if mode is Mode.AXISYMMETRIC:
        return none, np.zeros((len(footing.points), 0))
    if footing.frames.shape[-1] == 2:
        axes = np.array([[0.0, 0.0, 1.0]])
    else:
        axis = np.eye(3)[0 if abs(n[0]) < 0.9 else 1]
        first = axis - (axis @ n) * n
        first = first / np.linalg.norm(first)
        axes = np.array([first, np.cross(n, first)])
    arms = footing.places - footing.centre
    lever = np.stack([np.cross(axis, arms) @ n for axis in axes], axis=1)
    size, turned = np.linalg.eigh(lever.T @ (footing.weights[:, None] * lever))
    extent = footing.weights @ (arms**2).sum(axis=1)
    kept = size > SINGULAR * max(float(extent), np.finfo(float).tiny)
    if kept.all():
        return axes, lever
    axes = (turned.T @ axes)[kept]
    return axes, lever @ turned[:, kept]


def _macro(joints: JointCells, point: int, cell: int, interface: Interface) -> Footing:
    """A macro-element: its law gives force, moments and rotations."""
    nodes = joints.zone.cells.nodes
    place = nodes.coordinates[nodes.resolve(joints.upper[cell])][:1]
    frame, d = joints.frames[cell], joints.element.dimension
    axes = np.array([[0.0, 0.0, 1.0]]) if d == 2 else frame[0, : d - 1]
    bed = next((b for b in interface.beds if b.owner == point), None)
    outline = outline_of(law_of(joints.zone.behaviour).code, interface.parameters[point], d)
    return Footing(
        np.array([point]), np.ones(1), frame, place, place[0], axes, np.zeros(0, np.int64),
        np.zeros((len(axes), 0)), pairs=outline.code == LawCode.SPRINGS,
        outline=outline, bed=bed,
    )  # fmt: skip
