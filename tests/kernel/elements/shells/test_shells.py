"""Shells against plate theory, cylinders and rings."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from together import together

from ssilang.kernel.elements import families
from ssilang.kernel.elements.loads.loads import shell_load
from ssilang.kernel.elements.results.skin import shell_skin, shell_tensor
from ssilang.kernel.elements.results.tensors import section_equivalent
from ssilang.kernel.elements.shells.shell_section import moduli_on_mesh
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.relations import blocked
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.modal.modes import modes_near
from tests.kernel.elements.samples import ELASTIC, field, line_zone, material, solved

E, NU, H, RHO = 2.0e11, 0.3, 0.01, 7800.0
PLATE = {"YOUN": E, "NU": NU, "EPAI": H, "RHO": RHO}
D = E * H**3 / 12 / (1 - NU**2)


def plate(nx, ny, a, b, turn=None, astray=0.0):
    """Triangles on a rectangle a x b, nodes inside astray by parts of a cell; mapped by `turn`."""
    table = NodeTable()
    X, Y = np.meshgrid(np.linspace(0, a, nx + 1), np.linspace(0, b, ny + 1), indexing="ij")
    x = np.column_stack([X.ravel(), Y.ravel(), 0 * X.ravel()])
    inside = (np.abs(x[:, :2] / [a, b] - 0.5) < 0.499).all(axis=1)
    moves = np.random.default_rng(5).uniform(-astray, astray, (inside.sum(), 2))
    x[inside, :2] += moves * [a / nx, b / ny]
    ids = table.add(x if turn is None else x @ turn.T).reshape(nx + 1, ny + 1)
    p, q, r, s = (part.ravel() for part in (ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]))
    cells = np.concatenate([np.column_stack([p, q, r]), np.column_stack([p, r, s])])
    block = CellBlock.make(table, "TRI3", cells)
    return Zone(block, "MECANIQUE", ELASTIC, "DKT", Mode.THREE_DIMENSIONAL), x


def quadrangles(element, nx, ny, a, b, bend=None):
    """Cells COQ4 or COQ8 on a rectangle a x b, mapped by `bend`."""
    degree = 2 if element == "COQ8" else 1
    table = NodeTable()
    X, Y = np.meshgrid(
        np.linspace(0, a, degree * nx + 1), np.linspace(0, b, degree * ny + 1), indexing="ij"
    )
    x = np.column_stack([X.ravel(), Y.ravel(), 0 * X.ravel()])
    ids = table.add(x if bend is None else bend(x)).reshape(X.shape)
    d = degree
    steps = {
        1: [(0, 0), (1, 0), (1, 1), (0, 1)],
        2: [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)],
    }[d]
    cells = np.column_stack([ids[i : i + d * nx : d, j : j + d * ny : d].ravel() for i, j in steps])
    kind = "QUA8" if d == 2 else "QUA4"
    block = CellBlock.make(table, kind, cells)
    zone = Zone(block, "MECANIQUE", ELASTIC, element, Mode.THREE_DIMENSIONAL)
    used = np.unique(cells)
    return zone, x, used


def flat_zone(element, n, length, width, across=1):
    """A strip along x, the places of its nodes and those that cells use."""
    if element in ("COQ4", "COQ8"):
        return quadrangles(element, n, across, length, width)
    zone, x = plate(n, across, length, width)
    return replace(zone, element=element), x, np.arange(len(x))


SKEW = np.array([[1.0, 0.4, 0.0], [0.0, 0.8, 0.0], [0.0, 0.0, 1.0]])


@together("element, h, n", [("DKT", H, 2), ("DST", H, 4), ("DST", 0.3, 4), ("COQ3", H, 4)])
def test_plate_bent_to_a_quadratic_surface_has_the_exact_moments(element, h, n):
    """In balance inside; of cubic triangles on a regular mesh alone, that it may be skew."""
    kx, ky, kxy = curved = (1e-3, -5e-4, 3e-4)
    zone, x = plate(n, n, 1.0, 0.7, SKEW, astray=0.0 if element == "COQ3" else 0.3)
    inside = np.flatnonzero((np.abs(x[:, :2] / [1.0, 0.7] - 0.5) < 0.499).all(axis=1))
    zone = replace(zone, element=element)
    u = field(
        zone,
        UZ=lambda x: -kx * x[:, 0] ** 2 / 2 - ky * x[:, 1] ** 2 / 2 - kxy * x[:, 0] * x[:, 1] / 2,
        RX=lambda x: -ky * x[:, 1] - kxy * x[:, 0] / 2,
        RY=lambda x: kx * x[:, 0] + kxy * x[:, 1] / 2,
    )
    mat = material(zone, **(PLATE | {"EPAI": h}))
    strain, stress = families.strain(zone, u, mat), families.stress(zone, mat, u)
    assert strain.components["RTSS"].shape == (2 * n * n, 1 if element == "COQ3" else 3)
    lower = slice(0, n * n, n)  # own x is the global x
    for name, value in zip(("RTSS", "RTTT", "RTST"), curved, strict=True):
        np.testing.assert_allclose(strain.components[name][lower], value, rtol=1e-9)
    moment = E * h**3 / 12 / (1 - NU**2) * (1e-3 - NU * 5e-4)
    np.testing.assert_allclose(stress.components["M11"][lower], moment, rtol=1e-9)
    forces = families.internal_forces(zone, CellField((stress,)), mat)
    for name in ("FZ", "MX", "MY"):
        all_of_them = np.abs(forces.values_at(name, np.arange(len(x)))).max()
        assert np.abs(forces.values_at(name, inside)).max() < 1e-10 * all_of_them


@together("element, h", [("DKT", H), ("DST", H), ("DST", 0.3), ("COQ4", H), ("COQ4", 0.3)])
def test_orthotropic_plate_is_stiff_along_its_first_axis(element, h):
    """A cantilever that bends and shears: P L^3 / 3 E I + P L / (5/6 G A)."""
    ends, b = [], 0.1
    for c, s in ((1.0, 0.0), (0.0, 1.0)):
        zone, x, _ = flat_zone(element, 8, 1.0, b)
        zone = replace(zone, behaviour=("ELASTIQUE", "ORTHOTROPE"))
        # the own frame of the second triangles of a cell starts along the diagonal
        frames = np.array([np.diff(t[:2], axis=0)[0, :2] for t in zone.cells.coordinates])
        e = frames / np.linalg.norm(frames, axis=1, keepdims=True)
        across = {} if element == "DKT" else {"G13": E / 40, "G23": E / 200}
        mat = material(zone, YG1=E, YG2=E / 10, NU12=0, G12=E / 4, EPAI=h, V1X=0, V1Y=0, **across)
        mat.blocks[0].components["V1X"][:, 0] = c * e[:, 0] + s * e[:, 1]
        mat.blocks[0].components["V1Y"][:, 0] = -c * e[:, 1] + s * e[:, 0]
        tip = np.flatnonzero(x[:, 0] > 1 - 1e-9)
        load = NodeField.of(zone.cells.nodes, tip, {"FZ": np.full(2, 0.5)}, "DISCRET")
        u = solved(zone, mat, lambda m, x=x: np.isin(m.nodes, np.flatnonzero(x[:, 0] < 1e-9)), load)
        ends.append(u.values_at("UZ", tip).mean())
    for found, young, G in zip(ends, (E, E / 10), (E / 40, E / 200), strict=True):
        sheared = 0.0 if element == "DKT" else 1 / (5 / 6 * G * b * h)
        assert found == pytest.approx(1 / (3 * young * b * h**3 / 12) + sheared, rel=0.02)


def test_discrete_shear_is_kirchhoffs_when_thin_and_takes_plain_shear_when_thick():
    zone, _ = plate(3, 3, 1.0, 0.7, SKEW, astray=0.3)
    sheared = replace(zone, element="DST")
    thin = material(zone, YOUN=E, NU=NU, EPAI=2e-5)  # of sides of 0.2: 1e-4
    K, limit = (families.stiffness(z, thin).values for z in (sheared, zone))
    np.testing.assert_allclose(K, limit, rtol=0, atol=1e-6 * np.abs(limit[:, 2::6, 2::6]).max())
    u = field(zone, UZ=lambda x: 2e-3 * x[:, 0] - 3e-3 * x[:, 1])
    strain = families.strain(sheared, u, material(zone, YOUN=E, NU=NU, EPAI=1e3)).components
    size = np.hypot(strain["GASN"], strain["GATN"])
    np.testing.assert_allclose(size, np.hypot(2e-3, 3e-3), rtol=1e-5)
    np.testing.assert_allclose(strain["GASN"][:9:3], 2e-3, rtol=1e-5)  # own x is the global x
    u = field(zone, UZ=lambda x: x[:, 0] ** 2 * x[:, 1], RY=lambda x: x[:, 1] ** 3)
    along = families.strain(sheared, u, material(zone, YOUN=E, NU=NU, EPAI=0.3)).components["GASN"]
    np.testing.assert_allclose(along[:, 0], along[:, 1])  # constant along a side, own x
    assert (np.ptp(along, axis=1) > 1e-3).any()


@pytest.mark.parametrize(
    ("element", "n", "rtol"), [("DST", 8, 0.015), ("DST", 16, 0.004), ("COQ4", 8, 0.015)]
)
def test_thick_plate_on_simple_supports_deflects_and_vibrates_as_mindlins_does(element, n, rtol):
    """A fifth of its side thick: Navier's series, and the frequency of the half wave."""
    h = 0.2
    zone, x, _ = flat_zone(element, n, 1.0, 1.0, n)
    mat = material(zone, YOUN=E, NU=NU, EPAI=h, RHO=RHO)
    bends, shears = E * h**3 / 12 / (1 - NU**2), 5 / 6 * E / 2 / (1 + NU) * h

    def fixed(numbering):
        names = np.array([numbering.name(i) for i in range(numbering.size)])
        at = np.abs(x[numbering.nodes, :2] - 0.5) > 0.5 - 1e-9
        turns = (at[:, 0] & (names == "RX")) | (at[:, 1] & (names == "RY"))
        return turns | (at.any(axis=1) & (names == "UZ")) | np.isin(names, ["UX", "UY", "RZ"])

    u = solved(zone, mat, fixed, shell_load(Model((zone,)), 1.0))
    odd = np.arange(1, 100, 2) * np.pi
    p, q = odd[:, None], odd[None]
    k2, wave = p**2 + q**2, 16 / (p * q) * np.sin(p / 2) * np.sin(q / 2)
    middle = wave * (1 / (bends * k2**2) + 1 / (shears * k2))
    centre = np.flatnonzero(np.abs(x[:, :2] - 0.5).max(axis=1) < 1e-9)
    assert abs(u.values_at("UZ", centre)[0]) == pytest.approx(middle.sum(), rel=rtol)
    made = families.stiffness(zone, mat), families.mass(zone, mat)
    numbering = numbering_of(Matrix(zone.cells.nodes, made[:1]))
    free = ~fixed(numbering)
    K, M = (assemble(Matrix(zone.cells.nodes, (m,)), numbering).toarray()[np.ix_(free, free)]
            for m in made)  # fmt: skip
    k = np.sqrt(2) * np.pi
    stiff = np.array([[shears * k**2, shears * k], [shears * k, bends * k**2 + shears]])
    exact = eigh(stiff, RHO * np.diag([h, h**3 / 12]), eigvals_only=True)[0]
    found = eigh(K, M, eigvals_only=True, subset_by_index=[0, 0])[0]
    assert np.sqrt(found / exact) == pytest.approx(1.0, abs=1.5 * rtol)


def test_long_cylinder_under_pressure_and_clamped_at_one_end():
    R, L, p = 1.0, 2.0, 1e5
    z = np.linspace(0, L, 81)
    zone = line_zone("COQ2", np.column_stack([R + 0 * z, z]), Mode.AXISYMMETRIC)
    mat = material(zone, **PLATE)
    nodes = np.arange(81)
    length = np.full(81, L / 80)
    length[[0, -1]] /= 2
    load = NodeField.of(zone.cells.nodes, nodes, {"FR": 2 * np.pi * R * p * length}, "DISCRET")
    u = solved(zone, mat, lambda m: m.nodes == 0, load)
    free = p * R**2 / (E * H)
    assert u.values_at("UR", nodes[60:61])[0] == pytest.approx(free, rel=1e-4)
    beta = (3 * (1 - NU**2)) ** 0.25 / np.sqrt(R * H)
    stress = families.stress(zone, mat, u)
    clamped = stress.components["M11"][0, 0]
    at = (1 - np.sqrt(3 / 5)) / 2 * L / 80
    moment = -np.exp(-beta * at) * (np.cos(beta * at) - np.sin(beta * at)) * p / (2 * beta**2)
    assert abs(clamped) == pytest.approx(abs(moment), rel=0.02)
    np.testing.assert_allclose(stress.components["N22"][60], p * R, rtol=1e-3)


def test_strip_in_plane_stress_is_a_beam():
    zone = line_zone("COQ2", [(0, 0), (0.6, 0.8)], Mode.PLANE_STRESS)
    mat = material(zone, YOUN=E, NU=NU, EPAI=H, DIM3=0.2)
    load = NodeField.of(
        zone.cells.nodes, np.array([1]), {"FX": np.array([-0.8]), "FY": np.array([0.6])}, "DISCRET"
    )
    u = solved(zone, mat, lambda m: m.nodes == 0, load)
    tip = np.array([1])
    across = -0.8 * u.values_at("UX", tip) + 0.6 * u.values_at("UY", tip)
    assert across[0] == pytest.approx(1 / (3 * E * 0.2 * H**3 / 12), rel=1e-9)


@pytest.mark.parametrize(
    ("element", "n", "h", "factor", "rtol"),
    [("DKT", 12, H, 0.00560, 0.02), ("DST", 16, H, 0.00560, 0.02), ("DST", 16, 1e-4, 0.00560, 0.02),
     ("COQ4", 16, H, 0.00560, 0.02), ("COQ4", 16, 1e-4, 0.00560, 0.02),
     ("COQ8", 12, H, 0.00560, 0.02), ("COQ8", 12, 2e-3, 0.00560, 0.02),
     ("DKT", 12, H, 0.01160, 1e-2), ("DKT", 24, H, 0.01160, 3e-3)],
)  # fmt: skip
def test_square_plate_deflects_as_timoshenko_says_and_does_not_lock(element, n, h, factor, rtol):
    """Under a force P in the middle by 0.00560 P a^2 / D if clamped, 0.01160 on simple supports."""
    zone, x, _ = flat_zone(element, n, 1.0, 1.0, n)
    edge = np.flatnonzero((np.abs(x[:, :2] - 0.5) > 0.5 - 1e-9).any(axis=1))
    centre = int(np.argmin(np.linalg.norm(x - [0.5, 0.5, 0], axis=1)))

    def fixed(numbering):
        names = np.array([numbering.name(i) for i in range(numbering.size)])
        on_edge = np.isin(numbering.nodes, edge) & ((names == "UZ") | (factor < 0.01))
        return on_edge | np.isin(names, ["UX", "UY", "RZ"])

    load = NodeField.of(zone.cells.nodes, np.array([centre]), {"FZ": np.array([1.0])}, "DISCRET")
    u = solved(zone, material(zone, YOUN=E, NU=NU, EPAI=h), fixed, load)
    exact = factor / (E * h**3 / 12 / (1 - NU**2))
    assert u.values_at("UZ", np.array([centre]))[0] == pytest.approx(exact, rel=rtol)


@pytest.mark.parametrize("element", ["COQ4", "COQ8"])
def test_ring_of_shell_cells_under_pressure_grows_evenly(element):
    radius, p, quarter = 1.0, 1e5, np.pi / 2
    zone, x, used = quadrangles(
        element, 12, 1, quarter, 0.1,
        lambda x: np.column_stack([radius * np.cos(x[:, 0]), radius * np.sin(x[:, 0]), x[:, 1]]),
    )  # fmt: skip
    mat = material(zone, YOUN=E, NU=0.0, EPAI=H)
    load = shell_load(Model((zone,)), p)
    start, end = (np.isin(np.arange(len(x)), used) & np.isclose(x[:, 0], s) for s in (0, quarter))

    def fixed(m):
        names = np.array([m.name(i)[:2] for i in range(m.size)])
        at = [np.isin(m.nodes, np.flatnonzero(part)) for part in (start, end)]
        first = at[0] & np.isin(names, ["UY", "RX", "RZ"])
        last = at[1] & np.isin(names, ["UX", "RY", "RZ"])
        return first | last | np.isin(names, ["UZ"])

    u = solved(zone, mat, fixed, load)
    grown = np.abs(u.values_at("UX", np.flatnonzero(start)))
    assert grown.mean() == pytest.approx(p * radius**2 / (E * H), rel=0.01)


def twisted(x):
    """A blade along x, 1.1 wide, that turns by 90 degrees over its length of 12."""
    angle, across = np.pi / 2 * x[:, 0] / 12, x[:, 1] - 0.55
    return np.column_stack([x[:, 0], across * np.cos(angle), across * np.sin(angle)])


@pytest.mark.parametrize(
    ("h", "P", "in_plane", "out_of_plane"),
    [(0.32, 1.0, 5.424e-3, 1.754e-3), (0.0032, 1e-6, 5.256e-3, 1.294e-3)],
)
def test_twisted_blade_of_warped_cells_bends_as_published(h, P, in_plane, out_of_plane):
    """MacNeal and Harder (1985), and the thin one of Belytschko and others (1989)."""
    zone, x, _ = quadrangles("COQ4", 24, 4, 12.0, 1.1, twisted)
    end = np.flatnonzero(x[:, 0] > 12 - 1e-9)
    shares = np.where(np.abs(x[end, 1] - 0.55) > 0.5, 0.5, 1.0) / 4
    for name, force, exact in (("UZ", "FZ", in_plane), ("UY", "FY", out_of_plane)):
        load = NodeField.of(zone.cells.nodes, end, {force: P * shares}, "DISCRET")
        mat = material(zone, YOUN=29e6, NU=0.22, EPAI=h)
        u = solved(zone, mat, lambda m: x[m.nodes, 0] < 1e-9, load)
        assert u.values_at(name, end).mean() == pytest.approx(exact, rel=0.03)


def test_skin_stresses_of_a_bent_and_pulled_plate():
    zone, _ = plate(1, 1, 1.0, 1.0)
    forces = {"N11": 3.0, "N22": 1.0, "N12": 0.5, "M11": 2.0, "M22": -1.0, "M12": 0.25}
    stress = CellField((material(zone, **forces).blocks[0],))
    mat = material(zone, EPAI=0.2)
    for side, sign in (("SUPE", 1), ("MOYE", 0), ("INFE", -1)):
        parts, _ = shell_skin(zone, stress, mat, side)
        assert parts["SMXX"][0, 0] == pytest.approx(3 / 0.2 + sign * 6 * 2 / 0.04)
        assert parts["SMXY"][0, 0] == pytest.approx(0.5 / 0.2 + sign * 6 * 0.25 / 0.04)
        T, _ = shell_tensor(zone, stress, mat, side)
        assert T[0, 0, 1, 1] == pytest.approx(1 / 0.2 - sign * 6 / 0.04)
    equivalent, _ = section_equivalent(zone, stress, mat)
    N, M = np.sqrt(9 + 1 - 3 + 0.75), np.sqrt(4 + 1 + 2 + 3 / 16)
    assert equivalent[0, 0] == pytest.approx(np.hypot(N / 0.2, 4 * M / 0.04))
    strains = {"EPSS": 1e-3, "EPTT": 0.0, "GAST": 2e-4, "RTSS": 1e-2, "RTTT": 0.0, "RTST": 0.0}
    bent = CellField((material(zone, **strains).blocks[0],))
    assert shell_skin(zone, bent, mat, "SUPE")[0]["EPXX"][0, 0] == pytest.approx(2e-3)


def _buckling(zone, stress):
    """Smallest factor of the stresses at which a plate 1 x 1 on simple supports buckles."""
    mat = material(zone, **PLATE)
    K = Matrix(zone.cells.nodes, (families.stiffness(zone, mat),))
    pressed = CellField((material(zone, **stress).blocks[0],))
    G = Matrix(zone.cells.nodes, (families.geometric_stiffness(zone, pressed, mat),))
    numbering = numbering_of(K, G)
    x = zone.cells.nodes.coordinates[numbering.nodes][:, :2]
    side = (np.abs(x - 0.5) > 0.5 - 1e-9).any(axis=1)
    names = np.array([numbering.name(i)[:2] for i in range(numbering.size)])
    free = ~(side & (names == "UZ")) & np.isin(names, ("UZ", "RX", "RY"))
    k, g = (assemble(m, numbering).toarray()[np.ix_(free, free)] for m in (K, G))
    return 1 / np.linalg.eigvals(np.linalg.solve(k, -g)).real.max()


@together(
    "element, n, rtol",
    [("DKT", 8, 0.02), ("DST", 8, 0.02), ("COQ3", 8, 0.02), ("COQ4", 8, 0.03), ("COQ8", 4, 0.03)],
)
def test_square_plate_pressed_on_all_sides_buckles_at_two_pi_squared_d(element, n, rtol):
    forces = ("SMSS", "SMTT") if element == "COQ8" else ("N11", "N22")  # in any own frame
    stress = dict.fromkeys(forces, -1 / H if element == "COQ8" else -1)
    zone = flat_zone(element, n, 1.0, 1.0, n)[0]
    load = _buckling(zone, stress)
    assert load == pytest.approx(2 * np.pi**2 * D, rel=rtol)


@together("element", ["DKT", "DST", "COQ3", "COQ4", "COQ8"])
def test_strip_off_its_mesh_bends_when_pulled_along_the_mesh(element):
    L, b, e = 1.0, 0.1, 0.03
    zone, x, used = flat_zone(element, 8, L, b)
    mat = material(zone, YOUN=E, NU=0.0, EPAI=H, EXCE=e)
    tip = used[x[used, 0] > L - 1e-9]
    share = np.where(np.abs(x[tip, 1] - b / 2) < 1e-9, 4.0, 1.0) if len(tip) == 3 else np.ones(2)
    load = NodeField.of(zone.cells.nodes, tip, {"FX": share / share.sum()}, "DISCRET")
    held = used[x[used, 0] < 1e-9]
    u = solved(zone, mat, lambda m: np.isin(m.nodes, held), load)
    EI, EA = E * b * H**3 / 12, E * b * H
    turn = -e * L / EI  # the middle surface lies above the pull
    assert u.values_at("RY", tip).mean() == pytest.approx(turn, rel=2e-3)
    assert u.values_at("UZ", tip).mean() == pytest.approx(-turn * L / 2, rel=1e-2)
    assert u.values_at("UX", tip).mean() == pytest.approx(L / EA - turn * e, rel=2e-3)
    stress = families.stress(zone, mat, u).components
    if element != "COQ8":
        aligned = slice(0, 8)  # cells whose own x is the strip's
        np.testing.assert_allclose(stress["N11"][aligned].mean(), 1 / b, rtol=0.02)
        np.testing.assert_allclose(np.abs(stress["M11"][aligned]).mean(), e / b, rtol=0.02)


@together("size", [6, 8])
def test_moduli_on_a_mesh_off_the_middle_surface_give_forces_that_are_in_balance(size):
    zone = flat_zone("DST", 1, 1.0, 1.0)[0]
    rng, e = np.random.default_rng(2), np.array([0.03, -0.05])[:, None, None]
    mat = material(zone, EXCE=0.0)
    mat.blocks[0].components["EXCE"] = e[:, :, 0]
    root, strain = rng.normal(size=(2, 1, size, size)), rng.normal(size=(2, size, 1))
    D, middle = root @ root.mT, strain.copy()
    middle[:, :3] += e * strain[:, 3:6]
    forces = D[:, 0] @ middle
    forces[:, 3:6] += e * forces[:, :3]
    found = moduli_on_mesh(D, zone, zone_field(zone, mat))
    np.testing.assert_allclose(found[:, 0] @ strain, forces)


def test_strip_off_its_mesh_buckles_as_if_it_lay_there_when_its_ends_may_not_turn():
    free, off = (_buckling_between_walls(e) for e in (0.0, 0.02))
    assert free == pytest.approx(4 * np.pi**2 * E * H**3 / 12, rel=0.02)
    # linear membrane strains follow EXCE times linear curvatures in the mean of a cell only
    assert off == pytest.approx(free, rel=0.025)


def _buckling_between_walls(e):
    zone, _, _ = flat_zone("DKT", 16, 1.0, 0.1)
    mat = material(zone, YOUN=E, NU=0.0, EPAI=H, EXCE=e)
    K = Matrix(zone.cells.nodes, (families.stiffness(zone, mat),))
    # the frames of the two triangles of a cell differ: pressed along x in both
    local = np.array([np.diff(t[:2], axis=0)[0, :2] for t in zone.cells.coordinates])
    c, s = (local / np.linalg.norm(local, axis=1, keepdims=True)).T
    stress = material(zone, N11=0.0, N22=0.0, N12=0.0)
    for name, value in (("N11", -c * c), ("N22", -s * s), ("N12", c * s)):
        stress.blocks[0].components[name][:, 0] = value
    G = Matrix(zone.cells.nodes, (families.geometric_stiffness(zone, stress, mat),))
    numbering = numbering_of(K, G)
    at = zone.cells.nodes.coordinates[numbering.nodes][:, 0]
    free = (at > 1e-9) & (at < 1 - 1e-9)
    k, g = (assemble(m, numbering).toarray()[np.ix_(free, free)] for m in (K, G))
    return 1 / np.linalg.eigvals(np.linalg.solve(k, -g)).real.max()


def test_mass_of_a_curved_thick_shell_is_positive_and_idle_about_its_fibres():
    def curved(x):
        turn = x[:, 0] / 0.5
        return np.column_stack([0.5 * np.cos(turn), x[:, 1], 0.5 * np.sin(turn)])

    zone, _, _ = quadrangles("COQ8", 1, 1, 0.6, 0.4, curved)
    mass = families.mass(zone, material(zone, **PLATE)).values[0]
    weights = np.linalg.eigvalsh(mass)
    idle = np.abs(weights) < 1e-12 * weights[-1]
    assert weights[0] > -1e-12 * weights[-1]
    assert idle.sum() == 8  # the rotation of each node about its own fibre
    spin = np.zeros((8, 6))  # a quarter of a cylinder's fibres turning about its axis
    spin[:, 4] = 1.0
    area = 0.6 * 0.4
    inertia = spin.ravel() @ mass @ spin.ravel()
    assert inertia == pytest.approx(RHO * H**3 / 12 * area, rel=1e-2)


def test_clamped_thin_tube_vibrates_as_the_published_case_says():
    """SDLA 01/89 (Guide de validation des progiciels, AFNOR 1990): 534 Hz, six waves around."""
    radius, length, thickness = 0.076073, 0.3048, 0.254e-3
    zone, _, _ = quadrangles(
        "COQ8", 24, 5, np.pi / 2, length / 2,
        lambda x: np.column_stack([radius * np.cos(x[:, 0]), x[:, 1], radius * np.sin(x[:, 0])]),
    )  # fmt: skip
    mat = material(zone, YOUN=2.06e11, NU=0.3, RHO=7850.0, EPAI=thickness)
    table, place = zone.cells.nodes, zone.cells.nodes.coordinates
    faces = {  # planes of symmetry, and the end that is held
        ("UZ", "RX", "RY"): place[:, 2] < 1e-9,
        ("UX", "RY", "RZ"): place[:, 0] < 1e-9,
        ("UY", "RX", "RZ"): place[:, 1] > length / 2 - 1e-9,
        ("UX", "UY", "UZ"): place[:, 1] < 1e-9,
    }
    used = np.unique(zone.cells.connectivity)
    rows = tuple(
        blocked(table, np.intersect1d(np.flatnonzero(there), used), list(names))
        for names, there in faces.items()
    )
    stiffness = Matrix(table, (families.stiffness(zone, mat),), rows)
    mass = Matrix(table, (families.mass(zone, mat),), (), "MASSE")
    for near in (0.0, 300.0, 560.0):
        mode = modes_near(stiffness, mass, [(near, 1)])[0]
        assert mode.frequency == pytest.approx((534.62 + 533.84) / 2, rel=5e-3)


@together("harmonic, rigid", [(0, 2), (1, 2), (2, 0), (3, 0)])
def test_a_cone_moves_freely_in_as_many_ways_as_a_body_does(harmonic, rigid):
    """Along its axis and about it; sideways and tilting in the first harmonic; else not at all."""
    zone = line_zone("COQ2", [(1.0, 0.2), (1.5, 0.9)], Mode.FOURIER)
    zone.options["harmonic"] = harmonic
    block = families.stiffness(zone, material(zone, **PLATE))
    K = block.values[0]
    scale = 1.0 / np.sqrt(np.diag(K))
    values = np.linalg.eigvalsh(scale[:, None] * K * scale)
    assert (np.abs(values) < 1e-12).sum() == rigid
    assert (values > 1e-6).sum() == len(K) - rigid
