"""Impedances of every law between points or on one: their forces by the formulas of one spring."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.elements import families
from ssilang.kernel.elements.springs import (
    counts_damping,
    dynamic_stiffness,
    is_impedance,
    law_of_impedance,
    unknowns_of,
)
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable

K, C, M = np.array([3e5, 5e5]), np.array([40.0, 70.0]), np.array([11.0, 17.0])
KR, MR = np.array([8e4, 9e4]), np.array([3.0, 2.0])


def zone_of(law, points, mode=Mode.THREE_DIMENSIONAL, **options):
    table = NodeTable()
    ids = table.add(np.random.default_rng(1).uniform(size=(4, 3))).reshape(2, 2)
    cells = ids if points == 2 else ids[:, 1:]
    block = CellBlock.make(table, "SEG2" if points == 2 else "POI1", cells)
    return Zone(block, "MECANIQUE", ("ELASTIQUE", "IMPEDANCE", law), f"IMP{points}", mode,
                options=options)  # fmt: skip


def given(zone, **values):
    block = CellFieldBlock(zone.cells, {k: np.asarray(v)[:, None] for k, v in values.items()},
                           "RIGIDITE", zone.element)  # fmt: skip
    return CellField((block,), "CARACTERISTIQUES")


def forces(block, u):
    """Forces (n_cells, n_rows) of element matrices on one displacement a row."""
    return np.einsum("cij,j->ci", block.values, u)


def expected(names, points, u, moving, turning, relative=True):
    """One spring an unknown: of a point, between two, or a share at each end."""
    out = np.zeros((2, len(names)))
    half = len(names) // 2
    for i, name in enumerate(names):
        k = turning if name[0] == "R" else moving
        if points == 1:
            out[:, i] = k * u[i]
        elif relative:
            other = (i + half) % len(names)
            out[:, i] = k * (u[i] - u[other])
        else:
            out[:, i] = 0.5 * k * u[i]
    return out


@together("points", [1, 2])
@together("rotations", [False, True])
@together("mode", [Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL])
def test_springs_dashpots_and_masses_act_on_each_unknown_by_itself(points, rotations, mode):
    zone = zone_of("VOIGT", points, mode)
    values = {"RAID": K, "VISC": C, "MASS": M}
    if rotations:
        values |= {"CPLE": KR, "INER": MR, "AMOR": [3.0, 5.0], "AROT": [7.0, 2.0]}
    field = given(zone, **values)
    stiff = families.stiffness(zone, field)
    damped = families.viscosity(zone, field)
    mass = families.mass(zone, field)
    three = mode is Mode.THREE_DIMENSIONAL
    names = ["UX", "UY", "UZ"][: 3 if three else 2]
    names += (["RX", "RY", "RZ"] if three else ["RZ"]) * rotations
    assert list(stiff.unknowns) == names * points
    u = np.random.default_rng(2).standard_normal(len(names) * points)
    kr, mr = (KR, MR) if rotations else (K, M)
    ratio, turning = (np.array([3.0, 5.0]), np.array([7.0, 2.0])) if rotations else (0, 0)
    c = C + 2 * ratio / 100 * np.sqrt(K * M)
    cr = 2 * turning / 100 * np.sqrt(kr * mr)
    np.testing.assert_allclose(forces(stiff, u), expected(stiff.unknowns, points, u, K, kr))
    np.testing.assert_allclose(forces(damped, u), expected(damped.unknowns, points, u, c, cr))
    np.testing.assert_allclose(forces(mass, u), expected(mass.unknowns, points, u, M, mr, False))
    assert is_impedance(zone)
    assert law_of_impedance(zone) == "VOIGT"
    assert counts_damping(zone, zone_field(zone, field))
    assert not counts_damping(zone, zone_field(zone, given(zone, RAID=K)))


@together("points", [1, 2])
@together("rotations", [False, True])
def test_in_series_matrices_and_their_complex_stiffness_are_maxwells(points, rotations):
    """The node between is condensed: what is left is k i w c / (k + i w c)."""
    zone = zone_of("REUSS", points)
    values = {"RAID": K, "VISC": C} | ({"CPLE": KR} if rotations else {})
    field = given(zone, **values)
    stiff, damped = families.stiffness(zone, field), families.viscosity(zone, field)
    assert stiff.unknowns == damped.unknowns
    f = 3.0
    w = 2 * np.pi * f
    whole = stiff.values + 1j * w * damped.values
    made, layout = dynamic_stiffness(zone, zone_field(zone, field), f)
    m = len(layout.unknowns)
    inner = whole[:, m:, m:]
    condensed = whole[:, :m, :m] - whole[:, :m, m:] @ np.linalg.solve(inner, whole[:, m:, :m])
    np.testing.assert_allclose(made, condensed, rtol=1e-12, atol=1e-6)
    series, turning = (k * 1j * w * C / (k + 1j * w * C) for k in (K, KR if rotations else K))
    u = np.random.default_rng(2).standard_normal(m)
    np.testing.assert_allclose(
        np.einsum("cij,j->ci", made, u).real,
        expected(layout.unknowns, points, u, series.real, turning.real),
        rtol=1e-10,
    )
    assert not counts_damping(zone, zone_field(zone, field))
    at_rest, _ = dynamic_stiffness(zone, zone_field(zone, field), 0.0)
    still = [i for i, n in enumerate(layout.unknowns) if n[0] == "U"]
    assert not at_rest[:, still][:, :, still].any()


def curve(name, x, y):
    return CurvePart(np.array(x), np.array(y), "f", name)


@together("points", [1, 2])
@together("own", [False, True])
def test_impedances_over_the_frequency_are_read_between_their_points(points, own):
    zone = zone_of("COMPLEXE", points)
    c = curve("VISC", [0.0, 4.0, 8.0], [10.0, 50.0, 20.0])
    name, stiffer = "RAID" if own else "MOCO", ([3e5, 7e5], [4e5, 9e5])  # a curve each cell
    k = [curve(name, [1.0, 5.0], y) for y in stiffer]
    values = {"RAID": [(x,) for x in k], "VISC": [(c,), (c,)]} if own else {
        "MOCO": [(k[0], c), (c, k[1])]}  # fmt: skip
    arrays = {n: np.array([[Curve(p)] for p in v], object) for n, v in values.items()}
    field = CellField((CellFieldBlock(zone.cells, arrays, "RIGIDITE", zone.element),))
    made, layout = dynamic_stiffness(zone, zone_field(zone, field), 3.0)
    one = np.array([5e5, 6.5e5]) + 1j * 6 * np.pi * 40.0
    u = np.random.default_rng(2).standard_normal(len(layout.unknowns))
    got = np.einsum("cij,j->ci", made, u)
    wanted = expected(layout.unknowns, points, u, one.real, None) + 1j * expected(
        layout.unknowns, points, u, np.full(2, one.imag), None
    )
    np.testing.assert_allclose(got, wanted)
    with pytest.raises(MaterialError, match="frequency"):
        families.stiffness(zone, field)
    other = Curve((curve("XX", [0.0, 1.0], [1.0, 1.0]),))
    wrong = {"MOCO": np.full((2, 1), other, object)}
    block = CellFieldBlock(zone.cells, wrong, "RIGIDITE", zone.element)
    with pytest.raises(MaterialError, match="MOCO"):
        dynamic_stiffness(zone, zone_field(zone, CellField((block,))), 1.0)


def test_named_unknowns_join_unlike_ones_and_modes_have_their_shares():
    zone = zone_of("ELASTIQUE", 2, UNKNOWNS=(("UX", "RZ"), ("UY", "UZ")))
    block = families.stiffness(zone, given(zone, RAID=K))
    assert block.unknowns == ("UX", "RZ", "UY", "UZ")
    assert block.local.tolist() == [0, 0, 1, 1]
    u = np.array([1.0, 2.0, 5.0, 9.0])
    np.testing.assert_allclose(forces(block, u), np.outer(K, [-4, -7, 4, 7]))
    zone = zone_of("ELASTIQUE", 2, UNKNOWNS=(("UX", "RZ"), ("UY",)))
    with pytest.raises(MaterialError, match="unknown"):
        unknowns_of(zone)
    for word, name in (("MODAL", "ALFA"), ("STATIQUE", "BETA")):
        zone = zone_of("ELASTIQUE", 1)
        zone = Zone(zone.cells, "MECANIQUE", ("ELASTIQUE", "IMPEDANCE", word), "IMP1", zone.mode)
        assert unknowns_of(zone) == ((name,), (name,))
        assert law_of_impedance(zone) == "ELASTIQUE"


@together(
    "values, match",
    [({"VISC": C}, "RAID"), ({"RAID": -K}, "negative"), ({"RAID": K, "AMOR": M}, "MASS")],
)
def test_impedances_without_sense_are_refused(values, match):
    zone = zone_of("VOIGT", 2)
    made = families.viscosity if "AMOR" in values else families.stiffness
    with pytest.raises(MaterialError, match=match):
        made(zone, given(zone, **values))
    with pytest.raises(FieldError, match="strain"):
        families.family_of(zone).moduli(zone, zone_field(zone, None), "RIGIDITE")
    assert dynamic_stiffness(zone, zone_field(zone, given(zone, RAID=K)), 2.0) is None
