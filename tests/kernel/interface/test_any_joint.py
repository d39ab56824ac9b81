"""Joints and their law on random data: any face, rule, rotation, size, path."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from references.assembled import Bench
from scipy.spatial.transform import Rotation

import ssilang.kernel.interface.family  # noqa: F401  joints as a family of elements
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.families import stiffness
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.interface.elements import with_rule
from ssilang.kernel.interface.laws.columns import N_PARAMETERS, N_STATE, Parameter, Variable
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.materials.model import Mode

FACES = {
    "JOI2": ("RAC2", "SEG2"),
    "JOI3": ("RAC3", "SEG3"),
    "JOT3": ("LIA3", "TRI3"),
    "JOI4": ("LIA4", "QUA4"),
    "JOT6": ("LIA6", "TRI6"),
    "JOI8": ("LIA8", "QUA8"),
    "JNO2": ("RAC2", "SEG2"),
    "JNO3": ("RAC3", "SEG3"),
    "JNT3": ("LIA3", "TRI3"),
    "JNO4": ("LIA4", "QUA4"),
}
NODAL = {"JOI2": "JNO2", "JOI3": "JNO3", "JOT3": "JNT3", "JOI4": "JNO4", "JOI1": "JOI1"}
AREA = {"SEG2": 2.0, "SEG3": 2.0, "TRI3": 0.5, "TRI6": 0.5, "QUA4": 4.0, "QUA8": 4.0}
angle = st.floats(-3.1, 3.1)
size = st.floats(-2.0, 3.0).map(lambda x: 10.0**x)
component = st.floats(-1.0, 1.0)


def test_rules_lead_from_joints_to_joints_on_the_same_faces():
    for gauss, nodal in NODAL.items():
        for start in (gauss, nodal):
            assert [with_rule(start, r) for r in ("GAUSS", "LOBATTO")] == [gauss, nodal]
    with pytest.raises(MeshError, match="JOI8"):
        with_rule("JOI8", "LOBATTO")


def placed(element, angles, stretch, shift):
    """One joint turned, stretched along its sides and moved: zone, material, nodes, rotation."""
    cell, face = FACES[element]
    reference = REFERENCE_CELLS[face].nodes
    d = reference.shape[1] + 1
    if d == 2:
        c, s = np.cos(angles[0]), np.sin(angles[0])
        R = np.array([[c, -s], [s, c]])
    else:
        R = Rotation.from_rotvec(angles).as_matrix()
    x = np.zeros((len(reference), d))
    x[:, : d - 1] = reference * np.array(stretch)[: d - 1]
    x = x @ R.T + np.array(shift)[:d]
    bench = Bench(Mode.PLANE_STRAIN if d == 2 else Mode.THREE_DIMENSIONAL)
    nodes = [bench.node(*p) for p in (*x, *x)]
    zone = bench.joint(cell, nodes, element, KN=5.0, KS=2.0)
    return zone, bench.characteristics, x, R


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from(list(FACES)),
    st.tuples(angle, angle, angle),
    st.tuples(size, size),
    st.tuples(component, component, component),
    st.tuples(component, component, component),
)
@example("JOI4", (0.0, 0.0, 1.0), (1e3, 1e-2), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))  # slender
def test_patch_of_any_joint(element, angles, stretch, shift, jump):
    """A uniform jump gives the uniform traction's resultant and moment; a rigid motion nothing."""
    zone, material, x, R = placed(element, angles, stretch, shift)
    d, m = x.shape[1], len(x)
    K = stiffness(zone, material).values[0]
    area = AREA[FACES[element][1]] * np.prod(stretch[: d - 1])
    local = np.array(jump[3 - d :])
    u = np.concatenate([np.tile(R @ local, m), np.zeros(m * d)])
    force = (K @ u).reshape(2, m, d)
    traction = R @ (local * np.array([2.0, 2.0, 5.0][3 - d :]))
    scale = 5.0 * area
    sides = stretch[: d - 1]
    rounded = np.finfo(float).eps * max(sides) / min(sides)  # places of the nodes
    assert np.abs(force[0].sum(axis=0) - area * traction).max() <= max(1e-12, rounded) * scale
    assert np.abs(force[0] + force[1]).max() <= 1e-12 * scale
    centre = x.mean(axis=0) if FACES[element][1] not in ("SEG3", "TRI6", "QUA8") else None
    if centre is not None:
        arms = x - centre
        moment = np.einsum("mi,mj->ij", arms, force[0])
        assert np.abs(moment - moment.T).max() <= 1e-11 * scale * max(np.abs(arms).max(), 1.0)
    W = np.array([[0.0, -0.4], [0.4, 0.0]]) if d == 2 else np.cross(np.eye(3), [0.1, -0.3, 0.4])
    rigid = (x @ W.T + local).ravel()
    rest = K @ np.concatenate([rigid, rigid])
    assert np.abs(rest).max() <= 1e-12 * scale * max(np.abs(rigid).max(), 1.0)


def walk(p, corners, pieces):
    state = np.zeros((1, N_STATE))
    t, new, D = np.zeros((1, 2)), np.zeros((1, N_STATE)), np.zeros((1, 2, 2))
    last = 0.0
    for corner in corners:
        for k in range(pieces):
            w = last + (corner - last) * (k + 1) / pieces
            respond(np.array([1]), np.array([[0.0, w]]), state, p, t, new, D)
            state = new.copy()
        last = corner
    return t[0, 1], state[0, Variable.XI]


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.floats(-1.0, 3.0), min_size=1, max_size=6),
    st.floats(1.05, 50.0),
    st.sampled_from([0.0, -0.05, -0.5]),
    st.integers(2, 60),
)
def test_path_of_the_law_does_not_depend_on_its_refinement(corners, ratio, closing, pieces):
    """Jumps in units of GF/FU; ratio is KN over the least admissible one; closing is FC/FU."""
    fu, gf = 1e5, 20.0
    p = np.zeros((1, N_PARAMETERS))
    given = {"KN": ratio * fu**2 / gf, "FU": fu, "GF": gf, "FC": closing * fu, "FROT": -1.0}
    for name, value in given.items():
        p[0, Parameter[name]] = value
    jumps = [c * gf / fu for c in corners]
    coarse, fine = walk(p, jumps, 1), walk(p, jumps, pieces)
    scale = given["KN"] * gf / fu
    assert abs(coarse[0] - fine[0]) <= 1e-9 * scale
    assert abs(coarse[1] - fine[1]) <= 1e-9 * gf / fu
