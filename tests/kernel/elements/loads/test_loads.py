"""Loads on sides and volumes against their resultants; expansion of shells; impedances."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest
import script_runs
from together import together

from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.boundary import absorbing_boundary
from ssilang.kernel.elements.loads.loads import body_force, pressure
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from tests.kernel.elements.samples import PLANE, SPACE, cell_zone, field, material

P = 7.0


def _skin(zone):
    kinds: dict[str, list] = {}
    nodes = zone.cells.connectivity
    for kind, local in zone.cells.kind.faces:
        kinds.setdefault(kind, []).append(nodes[:, list(local)])
    table = zone.cells.nodes
    blocks = [CellBlock.make(table, k, np.concatenate(v)) for k, v in kinds.items()]
    return Mesh(table, tuple(blocks))


def _mode(element):
    return Mode.PLANE_STRAIN if element in PLANE else Mode.THREE_DIMENSIONAL


@together("element", [*PLANE, *SPACE])
def test_pressure_all_around_is_in_balance_with_minus_the_identity(element):
    zone = cell_zone(element, _mode(element))
    got = pressure(Model((zone,)), _skin(zone), P)
    n, names = len(zone.cells), families.family_of(zone).stress_names(zone)
    components = {k: np.full((n, 1), -P if i < 3 else 0.0) for i, k in enumerate(names)}
    stress = CellField((CellFieldBlock(zone.cells, components, "GRAVITE", element),))
    expected = families.internal_forces(zone, stress)
    for name, part in expected.components.items():
        exact = 1e-12 if "RI" not in element and element not in ("C20R", "P15R") else 1e-9
        np.testing.assert_allclose(got.values_at(name, part.nodes), part.values, atol=exact * 50)


@together("element", [*PLANE, *SPACE])
def test_weight_equals_mass_times_gravity(element):
    zone = cell_zone(element, _mode(element))
    name = "FY" if element in PLANE else "FZ"
    density = field(zone, **{name: lambda x: -9.81 * 2.5})
    got = body_force(Model((zone,)), density)
    mass = families.mass(zone, material(zone, RHO=2.5))
    column = [i for i, u in enumerate(mass.unknowns) if u == "U" + name[1]]
    nodal = mass.values[0][np.ix_(column, column)].sum(axis=1) * -9.81
    np.testing.assert_allclose(
        got.values_at(name, zone.cells.connectivity[0]), nodal, rtol=1e-9, atol=1e-9
    )


def test_a_surface_off_the_model_is_refused():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    far = zone.cells.nodes.add([[9.0, 9.0], [8.0, 9.0]])
    with pytest.raises(MeshError, match="no side"):
        pressure(Model((zone,)), Mesh.of(zone.cells.nodes, "SEG2", far[None]), P)


def test_a_pressure_of_two_components_is_refused():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    two = NodeField.of(zone.cells.nodes, np.arange(4), {"A": np.ones(4), "B": np.ones(4)}, "DIFFUS")
    with pytest.raises(FieldError, match="one component"):
        pressure(Model((zone,)), _skin(zone), two)


def test_absorbing_boundary_has_the_impedance_of_the_medium():
    zone = cell_zone("QUA8", Mode.PLANE_STRAIN)
    E, nu, rho = 1e8, 0.3, 1800.0
    nodes = zone.cells.connectivity[0]
    side = Mesh.of(zone.cells.nodes, "SEG3", nodes[None, :3])
    beside = cell_zone("TRI3", Mode.PLANE_STRAIN)  # a body without sides there, nor parameters
    C = absorbing_boundary(Model((beside, zone)), side, material(zone, YOUN=E, NU=nu, RHO=rho))
    (block,) = C.blocks
    ends = zone.cells.coordinates[0, [0, 2], :2]
    t = ends[1] - ends[0]
    length = np.linalg.norm(t)
    t = t / length
    n = np.array([t[1], -t[0]])
    vs = np.sqrt(E / (2 * (1 + nu)) / rho)
    vp = vs * np.sqrt(2 * (1 - nu) / (1 - 2 * nu))
    for direction, speed in ((t, vs), (n, vp)):
        v = np.tile(direction, 3)
        assert v @ block.values[0] @ v == pytest.approx(rho * speed * length, rel=1e-12)


ALPHA, THICKNESS = 1e-5, 0.1
LOWER, MIDDLE, UPPER = 0.0, 30.0, 60.0
SKINS = f"'TINF' {LOWER} 'T' {MIDDLE} 'TSUP' {UPPER}"
CELLS = dict.fromkeys(("DKT", "DST", "COQ3"), "TRI3")
CELLS |= {"COQ4": "QUA4", "COQ6": "TRI6", "COQ8": "QUA8"}


@pytest.fixture
def found(tmp_path: Path):
    """Function `(script, *names)`: the objects of these names; the script must succeed."""
    return partial(script_runs.found, folder=tmp_path)


def plate(element: str, temperatures: str) -> str:
    """2 m by 1 m in the plane z = 0, and the load of a temperature."""
    return (
        f"OPTI DIME 3 MODE TRID ELEM {CELLS[element]} ; O = 0 0 0 ; "
        "Q = (DROI 4 O (2 0 0)) TRAN 2 (0 1 0) ; P = Q POIN 'PROC' (2. 1. 0.) ; "
        f"M = MODE Q 'MECANIQUE' 'ELASTIQUE' '{element}' ; "
        f"A = MATE M 'YOUN' 1.E9 'NU' 0.3 'ALPH' {ALPHA} 'EPAI' {THICKNESS} ; "
        f"S = THET M A (MANU 'CHPO' Q {temperatures}) ; "
    )


@together("element", sorted(CELLS))
def test_plate_warmer_on_its_upper_skin_grows_and_bends(found, element: str) -> None:
    x, y, z = found(
        plate(element, SKINS)
        + "U = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' O)) (BSIG M S A) ; "
        "X = EXTR U 'UX' P ; Y = EXTR U 'UY' P ; Z = EXTR U 'UZ' P ;",
        "X", "Y", "Z",
    )  # fmt: skip
    mean, curvature = ALPHA * MIDDLE, ALPHA * (UPPER - LOWER) / THICKNESS
    assert x == pytest.approx(2 * mean, rel=2e-3)  # drilling springs off by a few 1e-6
    assert y == pytest.approx(mean, rel=2e-3)
    assert z == pytest.approx(-curvature * (2**2 + 1**2) / 2, rel=2e-3)


def test_mean_of_a_parabola_across_holds_the_plate(found) -> None:
    """Simpson's rule is exact: N = E h a (TINF + 4 T + TSUP) / 6 / (1 - nu)."""
    n, m, still = found(
        plate("DKT", "'TINF' 0. 'T' 30. 'TSUP' 12.")
        + "N = MAXI (EXCO 'N22' S) ; M1 = MAXI (EXCO 'M11' S) ; "
        f"A = MATE M 'YOUN' 1.E9 'NU' 0.3 'EPAI' {THICKNESS} ; "  # that nothing says to grow
        "Z = MAXI (THET M A (MANU 'CHPO' Q 'T' 30.)) 'ABS' ;",
        "N", "M1", "Z",
    )  # fmt: skip
    assert still == 0.0
    assert n == pytest.approx(1e9 * THICKNESS * ALPHA * (4 * 30.0 + 12.0) / 6 / 0.7)
    assert m == pytest.approx(1e9 * THICKNESS**3 / 12 * ALPHA * 12.0 / THICKNESS / 0.7)


def test_points_across_a_thick_shell_see_the_parabola(found) -> None:
    stress = found(plate("COQ8", "'TINF' 0. 'T' 30. 'TSUP' 12."), "S").blocks[0].components["SMSS"]
    height = 1 / 3**0.5
    for side, points in ((-1, stress[:, :4]), (1, stress[:, 4:])):
        warm = 30.0 + 6.0 * side * height - 24.0 / 3
        assert points == pytest.approx(1e9 * ALPHA * warm / 0.7)


@pytest.mark.parametrize("temperatures", ["'T' 30.", SKINS])
def test_a_warm_tube_grows_without_stress_far_from_its_ends(found, temperatures: str) -> None:
    radius, stress = found(
        "OPTI DIME 2 MODE AXIS ELEM SEG2 ; P = 3. 0. ; L = DROI 4 P (3. 1.) ; "
        "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'COQ2' ; "
        f"A = MATE M 'YOUN' 1.E9 'NU' 0.3 'ALPH' {ALPHA} 'EPAI' {THICKNESS} ; "
        "U = RESO ((RIGI M A) ET (BLOQ 'UZ' P) ET (BLOQ 'RT' L)) "
        f"(BSIG M (THET M A (MANU 'CHPO' L {temperatures}))) ; "
        "R = MINI (EXCO 'UR' U) ; S = MAXI 'ABS' (EXCO 'N22' ((SIGM M A U) - "
        f"(THET M A (MANU 'CHPO' L {temperatures})))) ;",
        "R", "S",
    )  # fmt: skip
    assert radius == pytest.approx(ALPHA * MIDDLE * 3.0, rel=1e-9)
    assert stress == pytest.approx(0.0, abs=1e-6)


def test_orthotropic_shell_expands_along_its_axes(found) -> None:
    """Its first axis lies along y: ALP1 is the growth along y."""
    script = (
        plate("DKT", "'T' 1.").split("M = MODE")[0]
        + "M = MODE Q 'MECANIQUE' 'ELASTIQUE' 'ORTHOTROPE' 'DKT' ; "
        "A = MATE M 'DIRE' (0. 1. 0.) 'PARA' 'YG1' 4.E9 'YG2' 1.E9 'NU12' 0.2 'G12' 1.E9 "
        "'EPAI' 0.1 'ALP1' 3.E-5 'ALP2' 1.E-5 ; "
        "F = BSIG M (THET M A (MANU 'CHPO' Q 'T' 10.)) A ; "
        "U = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' O)) F ; "
        "X = EXTR U 'UX' P ; Y = EXTR U 'UY' P ;"
    )
    assert found(script, "X", "Y") == pytest.approx((2e-4, 3e-4), rel=2e-3)


def test_skins_without_the_middle_are_refused(tmp_path: Path) -> None:
    message = script_runs.refused(plate("DKT", "'TINF' 1. 'TSUP' 2."), folder=tmp_path)
    assert "no component T" in message
