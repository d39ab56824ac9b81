"""Loads in time as a few constant vectors times a few curves."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Load, LoadPart
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import assembly

MECHANICAL = ("", "MECA", "FORC", "DIMP")


@dataclass(frozen=True, eq=False)
class Loading:
    """`F(t) = forces @ c(t)`, `d(t) = imposed @ c(t)`."""

    forces: FloatArray  # (n_unknowns, k)
    imposed: FloatArray  # (n_rows, k) imposed values of the conditions
    # (abscissas, ordinates) of each: linear between points, constant outside
    curves: tuple[tuple[FloatArray, FloatArray], ...]

    def at(self, times: FloatArray) -> FloatArray:
        """Factors c at times (m,), shape (m, k)."""
        columns = [np.interp(times, x, y) for x, y in self.curves]
        return np.stack(columns, axis=1) if columns else np.zeros((len(times), 0))


def loading_of(load: Load | None, numbering: assembly.Numbering, multipliers: IntArray) -> Loading:
    """Vectors and curves of a load on a numbering.

    Raises
    ------
    FieldError
        For a load that is not mechanical, or forces on unknowns that the matrices lack.
    """
    forces, imposed, curves = [], [], []
    for part in load.parts if load is not None else ():
        for field, curve in nodal_terms(part):
            lost = assembly.outside(field, numbering)
            if lost:
                raise FieldError("kernel.stepping.load-matrices-lack", name=part.name, lost=lost[0])
            forces.append(assembly.field_to_vector(field, numbering))
            imposed.append(assembly.imposed_values(field, multipliers))
            curves.append(curve)
    k = len(curves)
    return Loading(
        np.array(forces).reshape(k, numbering.size).T.copy(),
        np.array(imposed).reshape(k, len(multipliers)).T.copy(),
        tuple(curves),
    )


TimeCurve = tuple[FloatArray, FloatArray]


def is_mechanical(part: LoadPart) -> bool:
    """Whether a part is forces or displacements: by its name, or a pressure given as its forces."""
    name, nodal = part.name.strip(), all(isinstance(f, NodeField) for f, _ in terms_of(part))
    return name in MECHANICAL or (name == "PRES" and nodal)


def nodal_terms(part: LoadPart) -> list[tuple[NodeField, TimeCurve]]:
    """Fields of a mechanical part, each with its curve."""
    if not is_mechanical(part):
        raise FieldError("kernel.stepping.load-not-mechanical", name=part.name)
    return [(_nodal(field), curve) for field, curve in terms_of(part)]


def terms_of(part: LoadPart) -> list[tuple[object, TimeCurve]]:
    """Fields of a part, each with its curve (abscissas, ordinates)."""
    if part.steps:
        times = np.array([t for t, _ in part.steps])
        hats = np.eye(len(times))
        return [(f, (times, hats[i])) for i, (_, f) in enumerate(part.steps)]
    if part.time is None:
        return [(part.space, (np.zeros(1), np.ones(1)))]
    curve = part.time.parts[0]
    return [(part.space, (curve.abscissas, curve.ordinates))]


def _nodal(field: object) -> NodeField:
    if not isinstance(field, NodeField):
        raise FieldError("kernel.stepping.mechanical-load-made-nodal")
    return field
