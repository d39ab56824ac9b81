"""Pipes against rings and pressure vessels; follower pressures against finite differences."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.loads.follower import gradient_stiffness, pressure_stiffness
from ssilang.kernel.elements.loads.loads import pipe_pressure, pressure_vectors, shell_load
from ssilang.kernel.elements.results.tensors import section_equivalent
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import ELASTIC, cell_zone, field, line_zone, material

E, NU, RE, H = 2.1e11, 0.3, 0.2, 0.02
RI = RE - H
AREA, INERTIA = np.pi * (RE**2 - RI**2), np.pi / 4 * (RE**4 - RI**4)
PIPE = {"YOUN": E, "NU": NU, "RHO": 7800.0, "EPAI": H, "RAYO": RE}


def _pipe(**more):
    zone = line_zone("TUYA", [(0, 0, 0), (0, 3.0, 0)], Mode.THREE_DIMENSIONAL)
    return zone, material(zone, **PIPE, **more)


def test_pipe_has_the_rigidities_and_mass_of_its_ring():
    zone, mat = _pipe()
    beam = Zone(zone.cells, "MECANIQUE", ELASTIC, "POUT", zone.mode)
    ring = {"SECT": AREA, "INRY": INERTIA, "INRZ": INERTIA, "TORS": 2 * INERTIA}
    same = material(beam, YOUN=E, NU=NU, RHO=7800.0, **ring)
    for compute in (families.stiffness, families.mass):
        np.testing.assert_allclose(
            compute(zone, mat).values, compute(beam, same).values, rtol=1e-12, atol=1e-6
        )


def test_elbow_bends_more_easily_by_von_karmans_factor():
    zone, mat = _pipe(RACO=0.5)
    straight = families.stiffness(*_pipe()).values[0]
    bent = families.stiffness(zone, mat).values[0]
    factor = 1.65 / (H * 0.5 / (RE - H / 2) ** 2)
    assert straight[0, 0] / bent[0, 0] == pytest.approx(factor)
    assert straight[1, 1] == pytest.approx(bent[1, 1])  # lengthening does not change


def test_closed_ends_pull_on_a_pipe_under_pressure():
    zone, mat = _pipe(PRES=15e6)
    forces = pipe_pressure(Model((zone,)), mat)
    push = 15e6 * np.pi * RI**2
    np.testing.assert_allclose(forces.components["FY"].values, [-push, push])
    u = field(zone, UY=lambda x: push * x[:, 1] / (E * AREA))
    stress = families.stress(zone, mat, u)
    np.testing.assert_allclose(stress.components["EFFX"], push)
    values, _ = section_equivalent(zone, CellField((stress,)), mat)
    np.testing.assert_allclose(values, push / AREA)


@pytest.mark.parametrize("bend", [0.0, 0.25, 30.0])
@pytest.mark.parametrize("moment", ["MOMY", "MOMZ"])
@pytest.mark.parametrize("pressed", [{}, {"PRES": 2e6, "CFPR": 0.7}])
def test_stress_of_an_elbow_is_that_of_its_ring_times_the_intensity_factor(moment, bend, pressed):
    """M r / I with the ring's inertia, by pi / 4 and 0.89 lambda^(-2/3) where that is above 1.

    The square of CFPR times the hoop stress of a pressure is added to its square.
    """
    zone, mat = _pipe(**({"RACO": bend} if bend else {}), **pressed)
    block = CellFieldBlock(zone.cells, {moment: np.full((1, 1), 3e4)}, "GRAVITE", zone.element)
    values, _ = section_equivalent(zone, CellField((block,)), mat)
    mean = RE - H / 2
    ratio = H * bend / mean**2 if bend else np.inf
    factor = max(1.0, 8 / 9 * ratio ** (-2 / 3))
    hoop = 0.7 * 2e6 * mean / H if pressed else 0.0
    np.testing.assert_allclose(values, np.hypot(3e4 * mean / INERTIA * np.pi / 4 * factor, hoop))


def _quadrangle():
    table = NodeTable()
    ids = table.add(np.array([[0, 0, 0], [1.1, 0.1, 0.2], [1.2, 0.9, -0.1], [0.1, 1.0, 0.3]]))
    block = CellBlock.make(table, "QUA4", ids[None])
    return Zone(block, "CHARGEMENT", ("PRESSION",), "QUA4", Mode.THREE_DIMENSIONAL)


def _line(mode):
    zone = line_zone("COQ2", [(1.0, 0.2), (1.5, 0.9)], mode)
    return Zone(zone.cells, "CHARGEMENT", ("PRESSION",), "SEG2", mode)


SIDES = [
    ("space", _quadrangle, ("UX", "UY", "UZ")),
    (
        "plane",
        lambda: _line(Mode.PLANE_STRAIN),
        ("UX", "UY"),
    ),
    (
        "ring",
        lambda: _line(Mode.AXISYMMETRIC),
        ("UR", "UZ"),
    ),
]


@pytest.mark.parametrize("nodal", [True, False])
@pytest.mark.parametrize(("make", "names"), [s[1:] for s in SIDES], ids=[s[0] for s in SIDES])
def test_follower_matrix_is_the_derivative_of_the_forces(make, names, nodal):
    zone = make()
    table = zone.cells.nodes
    values = 1.0 + np.arange(zone.cells.kind.n_nodes)
    if nodal:
        p = NodeField.of(table, zone.cells.connectivity[0], {"T": values}, "DIFFUS")
    else:
        p = CellField((CellFieldBlock(zone.cells, {"P": values[None]}, "NOEUD", zone.element),))
    block = pressure_stiffness(zone, p, unsymmetric=True)
    layout = Layout(block.table, block.raw_nodes, block.local, block.unknowns)
    step, rng = 1e-6, np.random.default_rng(5)
    move = rng.normal(size=(len(table), len(names)))
    start = table.coordinates.copy()

    def forces(sign):
        table.coordinates[:, : len(names)] = start[:, : len(names)] + sign * step * move
        found = pressure_vectors(zone, p)
        return np.stack([found.components["F" + n[1]].values for n in names], axis=1)

    change = (forces(1) - forces(-1)) / (2 * step)
    table.coordinates[:] = start
    motion = field(zone, **{n: (lambda x, i=i: move[:, i]) for i, n in enumerate(names)})
    product = block.values[0] @ layout.gather(motion)[0]
    expected = change[zone.cells.connectivity[0]].ravel()
    np.testing.assert_allclose(product, expected, atol=1e-8)


@pytest.mark.parametrize(("make", "names"), [s[1:] for s in SIDES], ids=[s[0] for s in SIDES])
def test_sides_that_move_in_a_pressure_that_grows_feel_its_change(make, names):
    zone, d = make(), len(names)
    at, x = zone.cells.connectivity[0], zone.cells.coordinates[0]
    u = np.random.default_rng(2).normal(size=(len(at), d))
    motion = field(zone, **{n: (lambda x, i=i: u[:, i]) for i, n in enumerate(names)})
    along = np.array([0.3, -1.2, 2.0])
    ways = {None: np.array([x[0, 1] - x[1, 1], x[1, 0] - x[0, 0]])} if d == 2 else {}
    for way in (*ways, along):
        own = along[:d] if way is along else ways[way]
        grown = 2.5 * (u @ own)[None] / np.linalg.norm(own)
        p = CellField((CellFieldBlock(zone.cells, {"P": grown}, "NOEUD", zone.element),))
        forces = pressure_vectors(zone, p)
        block = gradient_stiffness(zone, 2.5, way, unsymmetric=True)
        layout = Layout(block.table, block.raw_nodes, block.local, block.unknowns)
        wanted = np.stack([forces.components["F" + n[1]].values[at] for n in names], axis=1)
        np.testing.assert_allclose(block.values[0] @ layout.gather(motion)[0], wanted.ravel())


def test_pressure_on_a_cone_that_moves_and_turns_as_a_whole_goes_with_it():
    """In harmonic 1: nothing for a motion across the axis, each force turned for a turn."""
    zone = _line(Mode.FOURIER)
    zone.options["harmonic"] = 1
    p = field(zone, P=lambda x: 1.0 + x[:, 0] - 2.0 * x[:, 1])
    block = pressure_stiffness(zone, p, unsymmetric=True)
    layout = Layout(block.table, block.raw_nodes, block.local, block.unknowns)
    x = zone.cells.coordinates[0]
    r, z = x[:, 0], x[:, 1]
    still = pressure_vectors(_line(Mode.AXISYMMETRIC), p)
    fr, fz = (0.5 * still.components[n].values for n in ("FR", "FZ"))  # cos^2 around
    turned = np.stack([fz, -fr, -fz], axis=1)
    for u, wanted in (((1 + 0 * r, 0 * r, -1 + 0 * r), 0 * turned), ((z, -r, -z), turned)):
        own = dict(zip(("UR", "UZ", "UT"), u, strict=True))
        motion = field(zone, **{n: (lambda x, c=c: c) for n, c in own.items()})
        found = block.values[0] @ layout.gather(motion)[0]
        np.testing.assert_allclose(found.reshape(2, 3), wanted, atol=1e-12)


@pytest.mark.parametrize(("follows", "share"), [(False, 4), (True, 3)], ids=["dead", "follows"])
def test_ring_buckles_at_the_classical_load(follows, share):
    """In n = 2 waves: n^2 D/R^3 under a dead pressure, (n^2 - 1) D/R^3 under one that follows."""
    radius, young = 1000.0, 20000.0
    z = np.linspace(0, 100, 5)
    zone = line_zone("COQ2", np.column_stack([radius + 0 * z, z]), Mode.FOURIER)
    zone.options["harmonic"] = 2
    table = zone.cells.nodes
    mat = material(zone, YOUN=young, NU=0.0, EPAI=1.0)
    hoop = CellField((material(zone, N22=radius).blocks[0],))  # opposite of the inward load's
    K = Matrix(table, (families.stiffness(zone, mat),))
    parts = [families.geometric_stiffness(zone, hoop)]
    if follows:
        parts.append(pressure_stiffness(zone, field(zone, P=lambda x: 1.0)))
    G = Matrix(table, tuple(parts))
    numbering = numbering_of(K, G)
    ends = np.isin(numbering.nodes, [0, 4])
    axial = np.array([numbering.name(i)[:2] in ("UZ", "RT") for i in range(numbering.size)])
    free = ~(ends & axial)
    k, g = (assemble(m, numbering).toarray()[np.ix_(free, free)] for m in (K, G))
    load = 1 / np.linalg.eigvals(np.linalg.solve(k, g)).real.max()
    assert load == pytest.approx(share * young / 12 / radius**3, rel=1e-6 if follows else 1e-5)


def test_pressures_on_volumes_and_shell_loads_on_solids_are_refused():
    solid = cell_zone("QUA4", Mode.PLANE_STRAIN)
    with pytest.raises(MeshError, match="no pressure"):
        pressure_stiffness(solid, field(solid, P=lambda x: 1.0))
    with pytest.raises(MeshError, match="not for element"):
        shell_load(Model((solid,)), 1.0)
