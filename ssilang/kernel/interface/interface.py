"""The interface: all joints of a problem seen from its few unknowns, the jumps of facing nodes.

Equilibrium is `A u + J^T f(J u) = r` with J the jumps of the pairs of facing nodes (global axes)
and `f(delta) = sum_points weight B^T t(B delta)`. Everything that depends on the law lives on
delta, whose size is that of the interface and not of the model.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.elements.families import inelastic
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.interface.bed import (
    OF_WHOLE,
    Bed,
    beds_of,
    common_results,
    places_from,
    whole_variables,
    zone_variables,
)
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.family import ROTATIONS, component_order, displacement_names
from ssilang.kernel.interface.kinematics import JointCells, joint_cells
from ssilang.kernel.interface.laws.columns import (
    N_PARAMETERS,
    N_STATE,
    LawCode,
    Parameter,
    Variable,
)
from ssilang.kernel.interface.laws.law import Law
from ssilang.kernel.interface.laws.law_table import (
    elastic_tangent,
    law_of,
    shown_variables,
    state_of,
)
from ssilang.kernel.interface.laws.parameter_table import joint_parameters
from ssilang.kernel.interface.point_state import energies_of_points, point_states
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.materials.model import Model, Zone, same_elements
from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix

_JUMPS = {
    2: [Variable.SLIP1, Variable.XI], 3: [Variable.SLIP1, Variable.SLIP2, Variable.XI]
}  # fmt: skip
SOFT = 1e4  # stiffness of closed joints times compliance, up to which single precision serves


@dataclass(frozen=True, eq=False)
class Interface:
    """Joints of a problem, ready for compiled code; false where there are none.

    Attributes
    ----------
    joints : tuple of JointCells
        Zones, in order; their points follow one another.
    dimension : int
        d, components of a jump.
    J : csr array (d n_pairs, n_unknowns)
        Jumps of the pairs from the unknowns.
    pairs : array (n_points, m)
        Pairs that each point interpolates (padded with pair 0).
    B : array (n_points, d, m d)
        Local jump of a point from its pairs' jumps (padded with zeros).
    weights : array (n_points,)
    codes : array (n_points,)
        Law of each point.
    parameters : array (n_points, N_PARAMETERS)
    beds : tuple of Bed
        Places under macro-elements whose ground yields; they are points behind those of all joints.
    apart : array (n_points, d) or float
        Jumps that the laws of Mohr-Coulomb joints count at no displacement. Their states are from
        there; results count them.
    """

    joints: tuple[JointCells, ...]
    dimension: int
    J: sp.csr_array
    pairs: IntArray
    B: FloatArray
    weights: FloatArray
    codes: IntArray
    parameters: FloatArray
    beds: tuple[Bed, ...] = ()
    apart: FloatArray | float = 0.0

    def __bool__(self) -> bool:
        return bool(self.joints)

    @cached_property
    def points(self) -> Joints:
        """The points as compiled code takes them."""
        p = np.ascontiguousarray(self.parameters)
        return Joints(self.pairs, self.B, self.weights, self.codes, p)

    @cached_property
    def placed(self) -> list[tuple[JointCells, slice]]:
        """The zones, each with the places of its points."""
        ends = np.cumsum([j.weights.size for j in self.joints])
        return [(j, slice(e - j.weights.size, e)) for j, e in zip(self.joints, ends, strict=True)]

    @property
    def size(self) -> int:
        """Number of interface unknowns."""
        return int(self.J.shape[0])

    @property
    def n_points(self) -> int:
        """Number of integration points."""
        return len(self.weights)

    @property
    def n_shown(self) -> int:
        """Number of points of the joints themselves, without places of beds."""
        return self.n_points - sum(len(bed.areas) for bed in self.beds)

    def cell_of(self, bed: Bed) -> tuple[JointCells, int]:
        """The zone and the cell of a bed's macro-element."""
        zone, cell = _at(self.joints, bed.owner)
        return self.joints[zone], cell

    @property
    def pressing(self) -> IntArray:
        """Points whose tractions are those of one joint: no places, no owners of beds."""
        return np.setdiff1d(np.arange(self.n_shown), [bed.owner for bed in self.beds])

    def carried(self, t: FloatArray) -> FloatArray:
        """Tractions (..., n_shown, d) of the joints from those (..., n_points, d) of all points.

        A macro-element carries the forces of the elastic bed and what yielding takes from them.
        """
        if not self.beds:
            return t
        found = t[..., : self.n_shown, :].copy()
        for bed in self.beds:
            found[..., bed.owner, :] += bed.taken(t[..., bed.points, :])
        return found

    def jumps(self, u: FloatArray) -> FloatArray:
        """Local jumps (n_points, d) by displacements (n,)."""
        of_pairs = (self.J @ u).reshape(-1, self.dimension)[self.pairs]
        return np.einsum("pia,pa->pi", self.B, of_pairs.reshape(len(self.B), self.B.shape[2]))

    def initial_state(self) -> FloatArray:
        """State of joints never loaded, shape (n_points, N_STATE)."""
        return np.zeros((self.n_points, N_STATE))

    def closed_stiffness(self) -> sp.csr_array:
        """Stiffness (size, size) of the closed joints on the jumps."""
        D = elastic_tangent(self.parameters, self.dimension)
        return joint_stiffness(self.points, D, self.size)

    def is_soft(self, S: FloatArray, most: float = SOFT) -> bool:
        """Whether directions may be of single precision, S being the compliance of all else."""
        return bool((self.closed_stiffness().diagonal() * S.diagonal()).max(initial=0.0) < most)


def joint_stiffness(joints: Joints, D: FloatArray, size: int) -> sp.csr_array:
    """Stiffness (size, size) on the jumps of pairs of tangents D (n_points, d, d)."""
    B, d = joints.B, D.shape[1]
    blocks = np.einsum("p,pia,pij,pjb->pab", joints.weights, B, D, B, optimize=True)
    places = (joints.pairs[:, :, None] * d + np.arange(d)).reshape(B.shape[0], B.shape[2])
    rows = np.broadcast_to(places[:, :, None], blocks.shape).ravel()
    columns = np.broadcast_to(places[:, None, :], blocks.shape).ravel()
    return sp.csr_array((blocks.ravel(), (rows, columns)), shape=(size, size))


def _at(joints: Sequence[JointCells], point: int) -> tuple[int, int]:
    """The number of the zone and the cell of a point of joints of two points."""
    starts = np.cumsum([0, *(j.weights.size for j in joints)])
    zone = int(np.searchsorted(starts, point, side="right")) - 1
    return zone, point - int(starts[zone])


def joint_zones(model: Model) -> tuple[Zone, ...]:
    """Zones of joints of a model."""
    return tuple(z for z in model.zones if is_joint(z))


def interface_of(
    zones: tuple[Zone, ...], characteristics: CellField | None, numbering: Numbering
) -> Interface:
    """The interface made by zones of joints; macro-elements come after the others.

    Raises
    ------
    MeshError, MaterialError
        For joints without area, reversed, or with inadmissible parameters.
    """
    if not zones:
        none, no_parameters = np.zeros(0, np.int64), np.zeros((0, N_PARAMETERS))
        J, B = sp.csr_array((0, numbering.size)), np.zeros((0, 1, 1))
        return Interface((), 1, J, np.zeros((0, 1), np.int64), B, np.zeros(0), none, no_parameters)
    joints, tables, codes, given_tables = [], [], [], []
    ordered = sorted(zones, key=lambda z: law_of(z.behaviour).macro)
    for zone in ordered:
        given, law = zone_field(zone, characteristics), law_of(zone.behaviour)
        cells = joint_cells(zone, given)
        table = joint_parameters(cells, given)
        given_tables.append(table)
        if law.rocking is not None:
            _refuse_unfit_macro(zone, law, table)
            given_tables[-1] = table.copy()
            table[:, Parameter.KS1], table[:, Parameter.KS2] = law.turning(
                table, zone.mode.dimension
            )
        joints.append(cells)
        tables.append(table)
        codes.append(np.full(cells.weights.size, law.code, dtype=np.int64))
    d = joints[0].element.dimension
    beds = beds_of(joints, given_tables)
    J, places, B = _jumps(joints, numbering, beds)
    for bed in beds:  # the closed form above knows what its ground bears
        place, cell = _at(joints, bed.owner)
        tables[place][cell, Parameter.QULT] = bed.parameters[Parameter.QULT]
    tables += [bed.table for bed in beds]
    codes += [np.full(len(bed.areas), LawCode.BED, dtype=np.int64) for bed in beds]
    return Interface(
        tuple(joints),
        d,
        J,
        places,
        B,
        np.concatenate([*(j.weights.ravel() for j in joints), *(bed.areas for bed in beds)]),
        np.concatenate(codes),
        np.concatenate(tables),
        beds,
    )


def _refuse_unfit_macro(zone: Zone, law: Law, table: FloatArray) -> None:
    if zone.mode.dimension != 3:
        return
    if law.in_space is None:
        raise MaterialError("kernel.interface.macro-ressorts-exists-two")
    if any(not (table[:, Parameter[name]] > 0).all() for name in law.in_space):
        raise MaterialError("kernel.interface.macro-semelle-needs-long")


def is_macro(zone: Zone) -> bool:
    """Whether the zone's law is that of a whole footing."""
    return law_of(zone.behaviour).macro


def _jumps(
    joints: list[JointCells], numbering: Numbering, beds: tuple[Bed, ...]
) -> tuple[sp.csr_array, IntArray, FloatArray]:
    """Jump matrix, pairs of each point, operators of the points."""
    plain = [j for j in joints if not is_macro(j.zone)]
    macro = [j for j in joints if is_macro(j.zone)]
    d = joints[0].element.dimension
    rows: list[sp.csr_array] = []
    places, B = np.zeros((0, 1), dtype=np.int64), np.zeros((0, d, d))
    if plain:
        keys, places = _pairs(plain)
        rows.append(_jump_matrix(keys, displacement_names(plain[0].zone), numbering))
        B = _padded_operators(plain, places.shape[1])
    if macro:
        rows += [macro_jumps(j, numbering) for j in macro]
        n, width = sum(len(j.upper) for j in macro), max(places.shape[1], 2 if beds else 1)
        first = sum(r.shape[0] for r in rows[: len(rows) - len(macro)]) // d
        own = np.zeros((n, width), dtype=np.int64)
        own[:, 0] = first + np.arange(n)
        unit = np.zeros((n, d, width * d))
        unit[:, :, :d] = np.eye(d)
        places, B = _wider(places, B, width)
        places, B = np.concatenate([places, own]), np.concatenate([B, unit])
    if beds:
        rows.append(sliding_jumps(beds, joints, numbering))
        n_pairs = sum(r.shape[0] for r in rows) // d - len(beds)
        for i, bed in enumerate(beds):
            below = np.zeros((len(bed.areas), places.shape[1]), dtype=np.int64)
            below[:, 0], below[:, 1] = places[bed.owner, 0], n_pairs + i
            operators = np.zeros((len(bed.areas), d, B.shape[2]))
            operators[:, :, : 2 * d] = bed.operator()
            places, B = np.concatenate([places, below]), np.concatenate([B, operators])
    return sp.csr_array(sp.vstack(rows, format="csr")), places, np.ascontiguousarray(B)


def _wider(places: IntArray, B: FloatArray, width: int) -> tuple[IntArray, FloatArray]:
    """Pairs and operators of points padded to so many pairs."""
    more, d = width - places.shape[1], B.shape[1]
    return np.pad(places, ((0, 0), (0, more))), np.pad(B, ((0, 0), (0, 0), (0, more * d)))


def macro_jumps(joints: JointCells, numbering: Numbering) -> sp.csr_array:
    """Rotations about t1 (and t2) and opening of macro-elements, d rows a cell."""
    d, frames = joints.element.dimension, joints.frames[:, 0]
    resolve = joints.zone.cells.nodes.resolve
    moving = displacement_names(joints.zone)
    matrix = sp.lil_array((len(frames) * d, numbering.size))
    for side, sign in ((joints.upper, 1.0), (joints.lower, -1.0)):
        for cell, node in enumerate(resolve(side).ravel()):
            turn = _places(numbering, int(node), ROTATIONS[d])
            move = _places(numbering, int(node), moving)
            axes = np.ones((1, 1)) if d == 2 else frames[cell, : d - 1]
            for row in range(d - 1):
                matrix[cell * d + row, turn] += sign * axes[row]
            matrix[cell * d + d - 1, move] += sign * frames[cell, -1]
    return sp.csr_array(matrix)


def sliding_jumps(
    beds: tuple[Bed, ...], joints: list[JointCells], numbering: Numbering
) -> sp.csr_array:
    """Motions along the base, d rows a bed: the second pair of its places."""
    d = joints[0].element.dimension
    matrix = sp.lil_array((len(beds) * d, numbering.size))
    for i, bed in enumerate(beds):
        at, cell = _at(joints, bed.owner)
        j = joints[at]
        frame, resolve = j.frames[cell, 0], j.zone.cells.nodes.resolve
        for side, sign in ((j.upper, 1.0), (j.lower, -1.0)):
            node = int(resolve(side[cell]).ravel()[0])
            move = _places(numbering, node, displacement_names(j.zone))
            for row in range(d - 1):
                matrix[i * d + row, move] += sign * frame[row]
            if d == 3:
                turn = _places(numbering, node, ROTATIONS[d])
                matrix[i * d + 2, turn] += sign * frame[-1]
    return sp.csr_array(matrix)


def _places(numbering: Numbering, node: int, names: tuple[str, ...]) -> list[int]:
    return [numbering.index_of(node, name) for name in names]


def _pairs(joints: list[JointCells]) -> tuple[IntArray, IntArray]:
    """Distinct pairs (n_pairs, 2) of (upper, lower) nodes; pairs of each point, padded."""
    resolve = joints[0].zone.cells.nodes.resolve
    sides = [np.stack([resolve(j.upper).ravel(), resolve(j.lower).ravel()], axis=1) for j in joints]
    keys, inverse = np.unique(np.concatenate(sides), axis=0, return_inverse=True)
    width = max(j.upper.shape[1] for j in joints)
    rows, start = [], 0
    for j in joints:
        n, m = j.upper.shape
        here = inverse.ravel()[start : start + n * m].reshape(n, m)
        start += n * m
        padded = np.pad(here, ((0, 0), (0, width - m)))
        rows.append(np.repeat(padded, j.weights.shape[1], axis=0))
    return keys.astype(np.int64), np.concatenate(rows).astype(np.int64)


def _padded_operators(joints: list[JointCells], width: int) -> FloatArray:
    parts = []
    for j in joints:
        G = j.operator
        n, g, d, k = G.shape
        parts.append(np.pad(G.reshape(n * g, d, k), ((0, 0), (0, 0), (0, width * d - k))))
    return np.ascontiguousarray(np.concatenate(parts))


def _jump_matrix(keys: IntArray, names: tuple[str, ...], numbering: Numbering) -> sp.csr_array:
    n_pairs, d = len(keys), len(names)
    codes = np.array([numbering.code(name) for name in names])
    columns = numbering.index(keys[:, :, None], codes[None, None, :])  # (pairs, side, d)
    rows = np.broadcast_to(np.arange(n_pairs * d).reshape(n_pairs, 1, d), columns.shape)
    signs = np.broadcast_to(np.array([1.0, -1.0])[None, :, None], columns.shape)
    shape = (n_pairs * d, numbering.size)
    entries = (signs.ravel(), (rows.ravel(), columns.ravel()))
    return sp.csr_array(sp.coo_array(entries, shape=shape))


# --- joints in matrices ----------------------------------------------------------------------


def replaced_blocks(matrix: Matrix, zones: tuple[Zone, ...]) -> tuple[ElementMatrices, ...]:
    """Blocks of a matrix that the laws of these zones take the place of.

    All on a zone's cells where none is of its own law: they may be its stiffness in a linear
    study. Beside one of its own law those of others are springs of their own, and so are those
    that a further model gives to a law that is linear.
    """
    gone: set[int] = set()
    for zone in zones:
        there = [b for b in matrix.blocks if same_elements(b.zone, zone)]
        alike = [b for b in there if b.zone and b.zone.behaviour == zone.behaviour]
        if is_joint(zone) and law_of(zone.behaviour).linear:
            alike = [b for b in alike if b.zone is zone] or alike[:1]
        gone |= {id(b) for b in alike or there}
    return tuple(b for b in matrix.blocks if id(b) in gone)


def without_zones(matrix: Matrix, zones: tuple[Zone, ...]) -> Matrix:
    """The matrix without the blocks that the laws of these zones take the place of."""
    gone = {id(b) for b in replaced_blocks(matrix, zones)}
    kept = tuple(b for b in matrix.blocks if id(b) not in gone)
    return Matrix(matrix.table, kept, matrix.relations, matrix.kind) if gone else matrix


def nonlinear_blocks(matrix: Matrix) -> tuple[ElementMatrices, ...]:
    """Blocks made from joints whose law is not linear."""
    return tuple(
        b
        for b in matrix.blocks
        if b.zone is not None and is_joint(b.zone) and not law_of(b.zone.behaviour).linear
    )


# --- results ---------------------------------------------------------------------------------


_SLIDING = (LawCode.SDM, LawCode.MOHR)
_TITLES = {
    "jump": "DEFORMATIONS",
    "plastic jump": "DEFORMATIONS INELASTIQUES",
    "traction": "CONTRAINTES",
}
COMMON_VARIABLES = ("ETAT", "ESTO", "EPER")
"""Results at the points of all joints: state, energy stored, energy lost."""

MACRO_NAMES = {
    "jump": {2: ("CXZ", "EXX"), 3: ("CXY", "CXZ", "EXX")},
    "traction": {2: ("MOMZ", "EFFX"), 3: ("MOMY", "MOMZ", "EFFX")},
}
"""Components of macro-elements: rotations and moments about t1 (t2), opening and force."""


def _names(joints: JointCells, kind: str) -> tuple[str, ...]:
    """Components of a zone's jumps or tractions, shear first."""
    if is_macro(joints.zone):
        return MACRO_NAMES[kind][joints.element.dimension]
    return joints.element.stresses if kind == "traction" else joints.element.strains


def interface_field(interface: Interface, values: FloatArray, kind: str) -> CellField:
    """Values (n_points, d) at the points of all joints as a field.

    Parameters
    ----------
    kind : 'jump', 'plastic jump' or 'traction'
        Which names the components get; joints whose law keeps no plastic jump are left out.
    """
    blocks = []
    values = interface.carried(values) if kind == "traction" else values
    for j, rows in interface.placed:
        local = values[rows].reshape(*j.weights.shape, -1)
        if kind == "plastic jump" and law_of(j.zone.behaviour).code not in _SLIDING:
            continue
        names = inelastic(_names(j, kind)) if kind == "plastic jump" else _names(j, kind)
        components = {
            names[i]: np.ascontiguousarray(local[..., i]) for i in component_order(j.zone)
        }
        blocks.append(j.zone.block(components))
    return CellField(tuple(blocks), _TITLES[kind])


def point_values(interface: Interface, field: CellField, kind: str) -> FloatArray:
    """Values (n_points, d) at the points of all joints from a field as `interface_field` gives it.

    Places of beds have none: what they take is in the tractions of their macro-element.

    Raises
    ------
    FieldError
        If the field lacks a component on a joint.
    """
    parts = []
    for j in interface.joints:
        given, names = zone_field(j.zone, field), _names(j, kind)
        missing = [n for n in names if n not in given]
        if missing:
            raise FieldError(
                "kernel.interface.field-lacks-component", name=missing[0], element=j.zone.element
            )
        local = np.stack([given.at(n, "STRESSES") for n in names], axis=-1)
        parts.append(local.reshape(-1, interface.dimension))
    places = interface.n_points - interface.n_shown
    return np.concatenate([*parts, np.zeros((places, interface.dimension))])


def plastic_jumps(interface: Interface, w: FloatArray, t: FloatArray) -> FloatArray:
    """What of the jumps (n_points, d) the springs of the faces do not explain."""
    d = interface.dimension
    stiffness = np.diagonal(elastic_tangent(interface.parameters, d), axis1=1, axis2=2)
    return w + interface.apart - np.divide(t, stiffness, np.zeros_like(t), where=stiffness > 0)


def parted(
    interface: Interface, state: FloatArray, w: FloatArray, given: Sequence[CellField | None]
) -> Interface:
    """Mohr-Coulomb joints that begin with inelastic jumps and tractions (`given`); sets `state`.

    Beyond the jumps w (n_points, d) of the displacements at the start these are `apart`: faces
    that stand open there close by as much before they touch.
    """
    inside, apart = np.zeros((2, *w.shape)), np.zeros_like(w)
    for j, rows in interface.placed:
        names = (inelastic(_names(j, "jump")), _names(j, "traction"))
        for k, held in enumerate(zone_field(j.zone, field) for field in given):
            for i, name in enumerate(names[k]):
                if name in held:
                    inside[k, rows, i] = held.at(name, "STRESSES").ravel()
        if law_of(j.zone.behaviour).code == LawCode.MOHR:
            elastic = -plastic_jumps(interface, np.zeros_like(w), inside[1])
            apart[rows] = (inside[0] + elastic - w)[rows]
    apart[abs(apart) <= 1e-9 * abs(w)] = 0.0
    state[:, _JUMPS[interface.dimension]] -= apart
    return replace(interface, apart=apart)


def state_field(interface: Interface, state: FloatArray, w: FloatArray, t: FloatArray) -> CellField:
    """Internal variables of the joints, by the names of their law, with state and energies.

    All joints: ETAT (1 closed, 2 closing, 3 open, 4 opening, see `point_states`), ESTO and EPER,
    energy stored and lost so far at the point (J/m2; J for a joint of two points).

    JOINT_SDM: SAUT (largest irreversible opening), GLI1, GLI2 (slip). Mohr-Coulomb joints: EPSE
    (cumulated plastic jump), STAT (1 open, 2 in contact), EPOU (opening), LAM1 (openings, added
    up), PLA1, PLA2 (slip), PLA3 (plastic and open normal jump), LAM3, EPCO (plastic compression,
    less than zero in EPCO). Macro-elements whose ground yields: see `bed_results`.
    """
    if not interface:  # nothing compiled is loaded
        return CellField((), "VARIABLES INTERNES")
    blocks = []
    arrays = (interface.codes, w, t, state, interface.parameters)
    counted = state.copy()
    counted[:, _JUMPS[interface.dimension]] += interface.apart
    common = np.vstack([point_states(*arrays)[None], energies_of_points(*arrays)])
    for bed in interface.beds:
        at_places = tuple(x[None, bed.points] for x in (w, t, state))
        elastic = common[1:, bed.owner, None]
        common[:, bed.owner] = common_results(bed, elastic, *at_places)[:, 0]
    for j, rows in interface.placed:
        shape = j.weights.shape
        local, of_all = counted[rows].reshape(*shape, -1), common[:, rows].reshape(-1, *shape)
        fields = shown_variables(law_of(j.zone.behaviour), local, interface.dimension)
        fields |= {name: of_all[i].copy() for i, name in enumerate(COMMON_VARIABLES)}
        owned = (b for b in interface.beds if rows.start <= b.owner < rows.stop)
        beds = {b.owner - rows.start: b for b in owned}
        if beds:
            fields |= zone_variables(beds, len(local), (w, t, state))
        blocks.append(j.zone.block(fields))
    return CellField(tuple(blocks), "VARIABLES INTERNES")


class History(Protocol):
    """Jumps and tractions (k, n_points, d) and states (k, n_points, N_STATE) of all joints."""

    @property
    def w(self) -> FloatArray: ...
    @property
    def t(self) -> FloatArray: ...
    @property
    def state(self) -> FloatArray: ...


def point_history(
    interface: Interface, rows: History, kind: str, component: str, place: tuple[int, int, int]
) -> FloatArray | None:
    """A component (k,) of `interface_field` or `state_field` in time at one point.

    Parameters
    ----------
    kind : 'jump', 'traction' or 'variables'
    place : (zone, cell, point)
        From 0.

    Returns
    -------
    array or None
        None if there is no such point or component.
    """
    zone, cell, point = place
    sizes = [j.weights.shape for j in interface.joints]
    if not (0 <= zone < len(sizes) and 0 <= cell < sizes[zone][0] and 0 <= point < sizes[zone][1]):
        return None
    j, own = interface.placed[zone]
    at = own.start + cell * sizes[zone][1] + point
    w, t, state = (np.ascontiguousarray(x[:, at]) for x in (rows.w, rows.t, rows.state))
    bed = next((b for b in interface.beds if b.owner == at), None)
    joints = (rows.w, rows.t, rows.state)
    at_places = () if bed is None else tuple(x[:, bed.points] for x in joints)
    if kind != "variables":
        names = _names(j, kind)
        places = {names[i]: i for i in component_order(j.zone)}
        if bed is not None and kind == "traction":
            t = t + bed.taken(at_places[1])
        values = w if kind == "jump" else t
        return values[:, places[component]] if component in places else None
    if component in COMMON_VARIABLES:
        codes = np.full(len(w), interface.codes[at])
        p = np.tile(interface.parameters[at], (len(w), 1))
        common = np.vstack(
            [point_states(codes, w, t, state, p)[None], energies_of_points(codes, w, t, state, p)]
        )
        if bed is not None:
            common = common_results(bed, common[1:], *at_places)
        return common[COMMON_VARIABLES.index(component)]
    if bed is not None and component in OF_WHOLE:
        return whole_variables(bed, *at_places)[component]
    shown = shown_variables(law_of(j.zone.behaviour), state[:, None], interface.dimension)
    return shown[component][:, 0] if component in shown else None


def state_from_field(interface: Interface, field: CellField) -> FloatArray:
    """State (n_points, N_STATE) from internal variables as `state_field` gives them.

    Variables that the field lacks are zero.
    """
    parts = [
        state_of(law_of(j.zone.behaviour), zone_field(j.zone, field), j.weights.shape)
        for j in interface.joints
    ]
    places = np.zeros((interface.n_points - interface.n_shown, N_STATE))
    found = np.concatenate([*parts, places])
    for bed in interface.beds:
        j, cell = interface.cell_of(bed)
        places_from(zone_field(j.zone, field), cell, found[bed.points])
    return found
