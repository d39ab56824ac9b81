"""The table of parameters of joint points, from a field of characteristics."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.zone_fields import ZoneField, missing_parameter
from ssilang.kernel.interface.kinematics import JointCells, point_values
from ssilang.kernel.interface.laws.columns import N_PARAMETERS, Parameter
from ssilang.kernel.interface.laws.law import DEFAULTS, Law
from ssilang.kernel.interface.laws.law_table import LAWS, law_of
from ssilang.kernel.materials.model import Zone

ELASTIC_SHEAR = "CISAILLEMENT_ELASTIQUE"
"""Word of the model for a shear that stays elastic when the joint is open (comparison only)."""

SYMMETRIC_FRICTION = "FROTTEMENT_SYMETRIQUE"
"""Word of the model for a symmetric tangent of Coulomb's friction (same solution)."""


def joint_parameters(joints: JointCells, given: ZoneField) -> FloatArray:
    """Table of parameters at the joint's points, checked by the law, shape (n g, N_PARAMETERS).

    KS serves both shear directions where KS1, KS2 are not given.

    Raises
    ------
    MaterialError
        If KN or KS is missing, or the law refuses the values.
    """
    law = law_of(joints.zone.behaviour)
    _refuse_faces(joints.zone)
    n, g = joints.weights.shape
    _refuse_turning_slip(point_values(given, "TYPE", n, joints.shape))
    found = {p.name: _values(joints, given, p.name) for p in Parameter}
    for name in law.angles:
        found[name] = point_values(given, name, n, joints.shape)
        if found[name] is None:
            raise missing_parameter(joints.zone, name, given.names)
    table = _table(law, (n, g), {name: v for name, v in found.items() if v is not None})
    if joints.element.name == "JOI1":  # slip of a joint of two points is without dilatancy
        table[:, :, Parameter.TPSI] = 0.0
    if ELASTIC_SHEAR in joints.zone.behaviour:
        table[:, :, Parameter.SHEAR] = 1.0
    if SYMMETRIC_FRICTION in joints.zone.behaviour:
        table[:, :, Parameter.SYMMETRIC] = 1.0
    flat = table.reshape(n * g, N_PARAMETERS)
    if law.check is not None:
        law.check(flat)
    return flat


def _values(joints: JointCells, given: ZoneField, name: str) -> FloatArray | None:
    n = len(joints.upper)
    found = point_values(given, name, n, joints.shape)
    if found is None and name in ("KS1", "KS2"):
        found = point_values(given, "KS", n, joints.shape)
    needed = {2: ("KN", "KS1"), 3: ("KN", "KS1", "KS2")}[joints.element.dimension]
    if found is None and name in needed:
        raise missing_parameter(joints.zone, "KN" if name == "KN" else "KS", given.names)
    return found


def check_given(zone: Zone, values: Mapping[str, NDArray[np.generic]]) -> None:
    """Let the law of a zone look at its parameters as soon as they are given.

    Nothing is checked while a required parameter is still missing, or depends on a field.

    Parameters
    ----------
    values : mapping of str to array (n, p)
        Parameters on the cells, p = 1 where they are constant in a cell.

    Raises
    ------
    MaterialError
        If the law refuses the values.
    """
    law = law_of(zone.behaviour)
    _refuse_faces(zone)
    if any(v.dtype == object for v in values.values()):
        return
    given = {name: np.asarray(v, dtype=float) for name, v in values.items()}
    _refuse_turning_slip(given.get("TYPE"))
    for name in ("KS1", "KS2"):
        if name not in given and "KS" in given:
            given[name] = given["KS"]
    needed = {n for n in (*law.required, *law.angles) if n != "KS"} | {"KS1"}
    shapes = {v.shape[1] for v in given.values()} - {1}
    if not needed <= set(given) or len(shapes) > 1 or law.check is None:
        return
    table = _table(law, (len(zone.cells), max(shapes, default=1)), given)
    law.check(table.reshape(-1, N_PARAMETERS))


def _table(law: Law, shape: tuple[int, int], given: Mapping[str, FloatArray]) -> FloatArray:
    """Parameters that are given on (n, g) points, tangents of angles, defaults of the others."""
    table = np.zeros((*shape, N_PARAMETERS))
    for name, default in DEFAULTS.items():
        table[:, :, Parameter[name]] = default
    for parameter in Parameter:
        if parameter.name in given:
            table[:, :, parameter] = given[parameter.name]
    for name, targets in law.angles.items():
        steep, slope = np.abs(given[name]) >= 90.0, np.tan(np.radians(given[name]))
        for target in targets:
            table[:, :, Parameter[target]] = np.where(steep, np.inf, slope)
    if "MU" in law.angles and "COHE" not in given:  # its cone's apex stands at FTRC
        slope = np.tan(np.radians(given["PHI"]))
        table[:, :, Parameter.COHE] = table[:, :, Parameter.FTRC] * slope
    return table


def _refuse_faces(zone: Zone) -> None:
    law = law_of(zone.behaviour)
    if law.two_points and zone.element != "JOI1":
        name = next(n for n, other in LAWS.items() if other is law)
        raise MaterialError("kernel.interface.law-two-points", name=name, element=zone.element)


def _refuse_turning_slip(kind: FloatArray | None) -> None:
    if kind is not None and (kind != 1.0).any():
        raise MaterialError(
            "kernel.interface.coulomb-type-not-available", kind=kind[kind != 1.0][0]
        )
