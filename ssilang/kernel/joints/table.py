"""The table of parameters of joint points, from a field of characteristics."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.elements.zone_fields import ZoneField, missing_parameter
from ssilang.kernel.joints.kinematics import JointCells, point_values
from ssilang.kernel.joints.law_table import law_of
from ssilang.kernel.joints.parameters import DEFAULTS, N_PARAMETERS, Parameter
from ssilang.kernel.mesh.nodes import FloatArray

ELASTIC_SHEAR = "CISAILLEMENT_ELASTIQUE"
"""Word of the model for a shear that stays elastic when the joint is open (comparison only)."""


def joint_parameters(joints: JointCells, given: ZoneField) -> FloatArray:
    """Table of parameters at the joint's points, checked by the law, shape (n g, N_PARAMETERS).

    KS serves both shear directions where KS1, KS2 are not given.

    Raises
    ------
    MaterialError
        If KN or KS is missing, or the law refuses the values.
    """
    law = law_of(joints.zone.behaviour)
    n, g = joints.weights.shape
    table = np.zeros((n, g, N_PARAMETERS))
    for name, default in DEFAULTS.items():
        table[:, :, Parameter[name]] = default
    for parameter in Parameter:
        values = _values(joints, given, parameter.name)
        if values is not None:
            table[:, :, parameter] = values
    for name, targets in law.angles.items():
        angle = point_values(given, name, n, joints.shape)
        if angle is None:
            raise missing_parameter(joints.zone, name, given.names)
        for target in targets:
            table[:, :, Parameter[target]] = np.where(
                np.abs(angle) < 90.0, np.tan(np.radians(angle)), np.inf
            )
    if joints.element.name == "JOI1":  # slip of a joint of two points is without dilatancy
        table[:, :, Parameter.TPSI] = 0.0
    if ELASTIC_SHEAR in joints.zone.behaviour:
        table[:, :, Parameter.SHEAR] = 1.0
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
