"""RIGI, MASS, AMOR of a modal basis: diagonal matrices on the modes' unknowns ALFA."""

from numpy.typing import ArrayLike

from ssilang.kernel.matrices.build import nodal_diagonal
from ssilang.kernel.modal.basis import MULTIPLIERS, on_marks, projected_matrix, work
from ssilang.kernel.modal.modes import eigenvalue
from ssilang.operators.matrices.element import amor, mass, rigi
from ssilang.operators.modal.basis import Shape, shapes_of
from ssilang.operators.prelude import *


def _diagonal(modes: list[Shape], values: ArrayLike, kind: str) -> Matrix:
    nodes = np.array([m.mark.node for m in modes])
    order = np.argsort(nodes, kind="stable")
    table = modes[0].field.table
    return nodal_diagonal(table, nodes[order], {"ALFA": np.array(values)[order]}, kind)


def _modal(call: Call, basis: Table) -> tuple[list[Shape], list[float], list[float]]:
    """Real modes of a basis, their masses and frequencies."""
    modes = [s for s in shapes_of(call, basis) if s.unknown == "ALFA"]
    if not modes:
        raise call.error("operators.modal.no-modes", basis)
    return modes, _numbers(call, modes, "MASSE_GENERALISEE"), _numbers(call, modes, "FREQUENCE")


def _numbers(call: Call, modes: list[Shape], name: str) -> list[float]:
    """A number of each mode's entry, say its frequency."""
    column = [m.entry.get(name) for m in modes]
    if not all(isinstance(v, float) for v in column):
        raise call.error("operators.modal.no-modes-with", name=name)
    return [float(v) for v in column]  # type: ignore[arg-type]


def _stiffnesses(call: Call, modes: list[Shape]) -> list[float]:
    """Generalised stiffness `m w |w|` of each mode."""
    masses = _numbers(call, modes, "MASSE_GENERALISEE")
    frequencies = _numbers(call, modes, "FREQUENCE")
    return [m * eigenvalue(f) for m, f in zip(masses, frequencies, strict=True)]


# --- modes and static shapes -----------------------------------------------------------------


_PER_CENT = Range(0.1, nought=True)
"""Less is a ratio; nought is a mode without damping."""
_BASIS = arg("basis", "TABLE", en="modes, or static shapes")
_OTHER = opt("other", "TABLE", en="the other of both")


@rigi.form(ahead=True)
def modal_stiffness(call: Call, basis: Table = _BASIS, other: Table | None = _OTHER) -> Matrix:
    shapes = shapes_of(call, *_tables(call, basis, other))
    modes = [s for s in shapes if s.unknown == "ALFA"]
    if len(modes) == len(shapes):
        return _diagonal(modes, _stiffnesses(call, modes), "RIGIDITE")
    marks, unknowns, duals = _places(shapes)
    return on_marks(
        shapes[0].field.table, _static_stiffness(call, shapes), marks, unknowns, duals, "RIGIDITE"
    )


def _tables(call: Call, basis: Table, other: Table | None) -> tuple[Table, ...]:
    if other is None:
        return (basis,)
    if (basis.subtype == "LIAISONS_STATIQUES") == (other.subtype == "LIAISONS_STATIQUES"):
        raise call.error("operators.modal.two-tables-holds-modes", other)
    return (basis, other)


def _static_stiffness(call: Call, shapes: list[Shape]) -> FloatArray:
    """`X^T K X` (n, n) without K: what holds a static shape, `K psi`, is known from its entry.

    Modes fill the diagonal with `m w^2`; the products with a static shape are the works of its
    forces and reactions, zero for a mode that is fixed where they act.
    """
    values = np.zeros((len(shapes), len(shapes)))
    modes = [i for i, s in enumerate(shapes) if s.unknown == "ALFA"]
    values[modes, modes] = _stiffnesses(call, [shapes[i] for i in modes])
    for j, shape in enumerate(shapes):
        if shape.unknown == "BETA":
            forces = _held_by(call, shape)
            values[:, j] = [sum(work(f, s.field) for f in forces) for s in shapes]
    statics = [i for i, s in enumerate(shapes) if s.unknown == "BETA"]
    values[np.ix_(statics, modes)] = values[np.ix_(modes, statics)].T
    return values


def _held_by(call: Call, shape: Shape) -> list[NodeField]:
    """Force and reactions of a static shape; their sum is `K psi`."""
    found = [f for f in map(shape.entry.get, ("FORCE", "REACTION")) if isinstance(f, NodeField)]
    real = [f for f in found if any(name not in MULTIPLIERS for name in f.components)]
    if not real:
        raise call.error("operators.modal.static-shape-neither-force")
    return real


def _places(shapes: list[Shape]) -> tuple[IntArray, list[str], list[str]]:
    """Points that mark shapes (n,), their unknowns and duals."""
    unknowns = [s.unknown for s in shapes]
    return np.array([s.mark.node for s in shapes]), unknowns, [dual_of(u) for u in unknowns]


@mass.form(ahead=True)
def modal_mass(call: Call, basis: Table = _BASIS) -> Matrix:
    if basis.subtype == "LIAISONS_STATIQUES":
        raise call.error("operators.modal.static-shapes-hold-no", basis)
    modes, masses, _ = _modal(call, basis)
    return _diagonal(modes, masses, "MASSE")


@mass.form(ahead=True)
def projected_mass(
    call: Call,
    basis: Table = _BASIS,
    other: Table | None = _OTHER,
    inertia: Matrix = Arg("RIGIDITE", en="mass"),
) -> Matrix:
    shapes = shapes_of(call, *_tables(call, basis, other))
    return projected_matrix(inertia, [s.field for s in shapes], *_places(shapes))


@amor.form()
def modal_damping(
    call: Call,
    basis: Table = _BASIS,
    ratios: ListReel = Arg("LISTREEL", usual=_PER_CENT, en="5. for 5 %", unit="%"),
) -> Matrix:
    modes, masses, frequencies = _modal(call, basis)
    if len(ratios) != len(modes):
        told = {"n_modes": len(modes), "n_ratios": len(ratios)}
        raise call.error("operators.modal.dampings-and-modes-differ", ratios, **told)
    critical = 4.0 * np.pi * np.array(masses) * np.abs(frequencies)
    return _diagonal(modes, critical * ratios.values / 100.0, "AMORTISSEMENT")
