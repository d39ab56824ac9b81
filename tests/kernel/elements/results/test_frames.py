"""Frames are the directions in which their coordinates grow; tensors turn as matrices do."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.results import frames, tensors
from ssilang.kernel.elements.results.skin import skin_stress
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode
from tests.kernel.elements.samples import cell_zone, line_zone, material

C, ON = np.array([0.4, -0.3, 0.2]), np.array([1.0, 0.5, 2.2])
AXIS = (ON - C) / np.linalg.norm(ON - C)
CIRCLE = (
    C + 0.3 * AXIS + 2.0 * np.cross(AXIS, [1.0, 0, 0]) / np.linalg.norm(np.cross(AXIS, [1, 0, 0]))
)
X = np.random.default_rng(3).uniform(1.0, 3.0, (4, 2, 3))


def along_axis(x):
    return (x - C) @ AXIS


def off_axis(x):
    return np.linalg.norm(x - C - along_axis(x)[..., None] * AXIS, axis=-1)


def gradient(f):
    h = 1e-6
    parts = [(f(X + h * e) - f(X - h * e)) / (2 * h) for e in np.eye(3)]
    g = np.stack(parts, axis=-1)
    return g / np.linalg.norm(g, axis=-1, keepdims=True)


# frames, and functions that grow along some of their rows
CASES = {
    "polar": (lambda: frames.polar_frames(X, C),
              {0: lambda x: np.hypot(x[..., 0] - C[0], x[..., 1] - C[1]), 2: lambda x: x[..., 2]}),
    "cylindrical": (lambda: frames.cylindrical_frames(X, C, ON), {0: off_axis, 2: along_axis}),
    "spherical": (lambda: frames.spherical_frames(X, C, ON),
                  {0: lambda x: np.linalg.norm(x - C, axis=-1),
                   1: lambda x: np.arctan2(off_axis(x), along_axis(x))}),
    "torus": (lambda: frames.torus_frames(X, C, ON, CIRCLE),
              {2: lambda x: np.hypot(off_axis(x) - 2.0, along_axis(x) - 0.3)}),
}  # fmt: skip


@together("name", CASES)
def test_rows_are_where_coordinates_grow(name):
    made, grows = CASES[name]
    found = made()
    np.testing.assert_allclose(
        found @ np.swapaxes(found, -1, -2), np.broadcast_to(np.eye(3), found.shape), atol=1e-12
    )
    np.testing.assert_allclose(np.linalg.det(found), 1.0)
    for row, f in grows.items():
        np.testing.assert_allclose(found[..., row, :], gradient(f), atol=1e-8)
    if name == "torus":
        around = np.cross(AXIS, X - C)
        np.testing.assert_allclose(
            found[..., 0, :], around / np.linalg.norm(around, axis=-1, keepdims=True), atol=1e-12
        )


def test_fixed_frames_hold_their_vectors_and_zero_is_refused():
    a, b = np.array([1.0, 2.0, 0.5]), np.array([0.3, -1.0, 2.0])
    found = frames.fixed_frame(a, b)
    np.testing.assert_allclose(found @ a, [np.linalg.norm(a), 0, 0], atol=1e-12)
    assert (found @ b)[1] > 0
    assert (found @ b)[2] == pytest.approx(0.0, abs=1e-12)
    flat = frames.fixed_frame(np.array([3.0, 4.0, 0.0]), None)
    np.testing.assert_allclose(flat, [[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]], atol=1e-12)
    with pytest.raises(FieldError, match="zero"):
        frames.unit(np.zeros((2, 3)))


@together("strains", [False, True])
@together("mode", [Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL])
def test_a_field_seen_in_frames_is_the_turned_matrix(strains, mode):
    zone = cell_zone("CUB8" if mode is Mode.THREE_DIMENSIONAL else "QUA4", mode)
    names = ("XX", "YY", "ZZ", "XY", "XZ", "YZ")[: 6 if mode is Mode.THREE_DIMENSIONAL else 4]
    rng = np.random.default_rng(1)
    p = 8 if len(names) == 6 else 4
    values = rng.standard_normal((len(names), 1, p))
    shears = ("GA", "EP") if strains else ("SM", "SM")
    given = {
        (shears[0] if n[0] != n[1] else shears[1]) + n: v
        for n, v in zip(names, values, strict=True)
    }
    field = CellField((CellFieldBlock(zone.cells, given, "RIGIDITE", zone.element),))
    turn = frames.fixed_frame(np.array([1.0, 2.0, 0.0 if p == 4 else 0.7]), None if p == 4 else ON)
    got = frames.seen_in(zone, field, turn)
    half = 0.5 if strains else 1.0
    for k in range(p):
        T = np.zeros((3, 3))
        for n, v in zip(names, values[:, 0, k], strict=True):
            i, j = ("XYZ".index(c) for c in n)
            T[i, j] = T[j, i] = v * (half if i != j else 1.0)
        R = turn @ T @ turn.T
        for n, full in zip(names, given, strict=True):
            i, j = ("XYZ".index(c) for c in n)
            assert got.components[full][0, k] == pytest.approx(R[i, j] / (half if i != j else 1.0))
        block = T[None, None]
        s = np.linalg.eigvalsh(T)[::-1]
        assert tensors.tresca(block)[0, 0] == pytest.approx(s[0] - s[2])
        mises = np.sqrt(0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2))
        assert tensors.von_mises(block)[0, 0] == pytest.approx(mises)
        first, second, third = (v[0, 0] for v in tensors.invariants(block))
        assert first == pytest.approx(s.sum())
        assert second == pytest.approx(s[0] * s[1] + s[1] * s[2] + s[0] * s[2])
        assert third == pytest.approx(s.prod())
        for ordered in (False, True):
            found = tensors.principal(zone, block, ordered)[0, :, 0]
            value, ways = found[:3], found[3:].reshape(3, 3)
            np.testing.assert_allclose(ways.T @ np.diag(value) @ ways, T, atol=1e-12)
            if ordered or p == 8:
                np.testing.assert_allclose(value, s)
            else:
                np.testing.assert_allclose(np.abs(ways[2]), [0, 0, 1])
                assert value[0] >= value[1]


@together("mode", [Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL])
def test_stress_at_a_point_of_a_section_is_that_of_bending_about_both_axes(mode):
    zone = line_zone(
        "POUT",
        np.array([[0, 0, 0], [2, 1, 0], [2, 4, 1.0]])[:, : 2 + (mode is Mode.THREE_DIMENSIONAL)],
        mode,
    )
    section = {"SECT": 0.2, "INRY": 0.03, "INRZ": 0.05, "DY": 0.4, "DZ": -0.7}
    rng = np.random.default_rng(2)
    names = ("EFFX", "EFFY", "EFFZ", "MOMX", "MOMY", "MOMZ")
    if mode is Mode.PLANE_STRAIN:
        names = ("EFFX", "EFFY", "MOMZ")
    given = {n: rng.standard_normal((2, 2)) for n in names}
    field = CellField((CellFieldBlock(zone.cells, given, "STRESSES", zone.element),))
    got = skin_stress(zone, field, material(zone, **section))
    expected = given["EFFX"] / 0.2 - given["MOMZ"] * 0.4 / 0.05
    if "MOMY" in given:
        expected = expected + given["MOMY"] * -0.7 / 0.03
    np.testing.assert_allclose(got.components["SMXX"], expected)
    assert got.support == "STRESSES"
    with pytest.raises(FieldError, match="QUA4"):
        skin_stress(cell_zone("QUA4", Mode.PLANE_STRAIN), field, material(zone, **section))
