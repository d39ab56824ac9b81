"""Every element in two unlike cells: what its matrices, strains, stresses and forces must share."""

import numpy as np
from together import together

from ssilang.kernel.elements import families
from ssilang.kernel.elements.catalog import ELEMENTS, support_rule
from ssilang.kernel.elements.family import Layout, StrainOperator, contract
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS, shape_functions
from ssilang.kernel.elements.zone_fields import carry, transfer_matrix
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import ELASTIC, PLANE, SOLIDS, SPACE, corners_only

SOLID = {"YOUN": 2.1e7, "NU": 0.27, "RHO": 1700.0}
LINE = SOLID | {"SECT": 0.021, "INRY": 3.1e-5, "INRZ": 5.3e-5, "TORS": 6.7e-5, "SECY": 0.013,
                "SECZ": 0.017, "VX": 0.2, "VY": 0.9, "VZ": 0.4}  # fmt: skip
PIPE = SOLID | {"EPAI": 0.011, "RAYO": 0.23, "RACO": 1.3, "VX": 0.2, "VY": 0.9, "VZ": 0.4}
SHELL = SOLID | {"EPAI": 0.04, "EXCE": 0.013}
SPACED = (Mode.THREE_DIMENSIONAL,)
CASES = {
    **dict.fromkeys(PLANE, (SOLID, (Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.AXISYMMETRIC))),
    **dict.fromkeys(SPACE, (SOLID, SPACED)),
    **dict.fromkeys(("BARR", "BAR3"), (LINE, (Mode.PLANE_STRESS, *SPACED))),
    **dict.fromkeys(("POUT", "TIMO"), (LINE, (Mode.PLANE_STRESS, *SPACED))),
    "TUYA": (PIPE, SPACED), "SHB8": (SOLID, SPACED),
    **dict.fromkeys(("DKT", "DST", "COQ3", "COQ4", "COQ6", "COQ8"), (SHELL, SPACED)),
}  # fmt: skip
SHELLS = ("DKT", "DST", "COQ3", "COQ4", "COQ6", "COQ8")
LOOSE = {"Q8RI": 1, "COQ8": 2, "C20R": 6, "P15R": 3}  # of one cell, by strains at few points
ROUGH = ("Q4RI", "COQ3")  # held by more than their stresses, stresses at one point of three
FREE = (Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.THREE_DIMENSIONAL)
ALL = [(e, m) for e, (_, modes) in CASES.items() for m in modes]
VECTORS = (("UX", "UY", "UZ"), ("RX", "RY", "RZ"), ("FX", "FY", "FZ"), ("MX", "MY", "MZ"))
ROUND = (("UR", "UZ", "UT"), ("RX", "RY", "RZ"), ("FR", "FZ", "FT"), ("MX", "MY", "MZ"))


def turned(angle, mode):
    """A rotation: of the plane, or of space."""
    c, s = np.cos(angle), np.sin(angle)
    flat = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return flat @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) if mode in SPACED else flat


class Two:
    """Two cells of an element side by side, unlike in shape and matter, all turned by R."""

    def __init__(self, element, mode, R):
        kind, rng = ELEMENTS[element], np.random.default_rng(7)
        linear = corners_only(kind.cell_type)
        corners, nodes = REFERENCE_CELLS[linear].nodes, REFERENCE_CELLS[kind.cell_type].nodes
        places = []
        for far in (3.0, 6.5):
            x = corners + rng.uniform(-0.12, 0.12, corners.shape)
            x = shape_functions(linear, nodes) @ x
            x = np.column_stack([x, np.zeros((len(x), 3 - x.shape[1]))])
            places.append(x + np.array([far, 0.3 * far, 0.0]))
        self.x = np.concatenate(places) @ R.T
        flat = mode not in SPACED
        table = NodeTable()
        ids = table.add(self.x[:, :2] if flat else self.x)
        block = CellBlock.make(table, kind.cell_type, ids.reshape(2, -1)[::-1])
        self.zone = Zone(block, "MECANIQUE", ELASTIC, element, mode)
        given = dict(CASES[element][0])
        if flat or "VX" not in given:
            given = {k: v for k, v in given.items() if k[0] != "V"}
        else:
            given |= zip(("VX", "VY", "VZ"), R @ [0.2, 0.9, 0.4], strict=True)
        unlike = np.array([[1.0], [1.6]])
        values = {k: v * (unlike if k in ("YOUN", "RHO", "SECT", "EPAI") else unlike**0)
                  for k, v in given.items()}  # fmt: skip
        part = CellFieldBlock(block, values, "GRAVITE", element)
        self.material = CellField((part,), "CARACTERISTIQUES")
        self.R, self.names = R, ROUND if mode is Mode.AXISYMMETRIC else VECTORS

    def field(self, values):
        """Displacements from {'U': (n, 3), 'R': (n, 3)} before turning."""
        made = {}
        for names, part in zip(self.names, values, strict=False):
            made |= zip(names, (part @ self.R.T).T, strict=True)
        return NodeField.of(self.zone.cells.nodes, np.arange(len(self.x)), made, "DIFFUS")

    def vectors(self, block, field):
        """Element vectors of a field."""
        return Layout(block.table, block.raw_nodes, block.local, block.unknowns).gather(field)

    def product(self, block, u):
        """Forces of a matrix, (n, 3) and moments, turned back."""
        layout = Layout(block.table, block.raw_nodes, block.local, block.unknowns)
        return self.at_nodes(
            layout.scatter(np.einsum("cij,cj->ci", block.values, layout.gather(u)))
        )

    def at_nodes(self, forces):
        """Forces and moments (2, n, 3), turned back."""
        nodes = np.arange(len(self.x))
        found = [
            np.stack([forces.values_at(n, nodes) for n in names], axis=1) @ self.R
            for names in self.names[2:]
        ]
        return np.array(found)


def drawn(two, mode, seed=3):
    """Displacements and rotations at nodes that are alike for all turns."""
    rng = np.random.default_rng(seed)
    u = 1e-3 * rng.standard_normal((2, len(two.x), 3))
    if mode not in SPACED:
        u[0, :, 2] = u[1, :, :2] = 0.0
    return u


def near(found, expected, tolerance=1e-10):
    assert np.abs(expected).max() > 0.0
    np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance * np.abs(expected).max())


def measure(two, element, mode):
    """Lengths, areas or volumes of the two cells, by their corners; None in space."""
    x = (two.x @ two.R).reshape(2, -1, 3)[::-1]
    if CELL_TYPES[ELEMENTS[element].cell_type].dimension == 1:
        return np.linalg.norm(np.ptp(x, axis=1), axis=1)
    if element in SPACE or element == "SHB8":
        return None
    after = np.roll(x, -1, axis=1)  # nodes stand around the cell
    parts = 0.5 * (x[..., 0] * after[..., 1] - after[..., 0] * x[..., 1])
    if mode is Mode.AXISYMMETRIC:  # Pappus
        parts = 2 * np.pi * parts * (x[..., 0] + after[..., 0]) / 3
    return parts.sum(axis=1)


@together("element, mode", [(e, m) for e, m in ALL if e not in ROUGH])
def test_forces_and_energies_are_those_of_the_stresses(element, mode):
    two = Two(element, mode, np.eye(3))
    zone, given = two.zone, two.material
    u = drawn(two, mode)
    if element in SHELLS:
        u[1, :, 2] = 0.0  # what resists a turn about the normal is no stress
    u = two.field(u)
    K = families.stiffness(zone, given)
    stress, strain = families.stress(zone, given, u), families.strain(zone, u, given)
    forces = two.at_nodes(families.internal_forces(zone, CellField((stress,)), given))
    exact = two.product(K, u)
    if element in SHELLS:
        forces[1, :, 2] = exact[1, :, 2] = 0.0
    tolerance = 1e-7 if element in SHELLS else 1e-12
    near(forces, exact, tolerance)
    near(K.values, np.swapaxes(K.values, 1, 2), 1e-13)
    if element in ("POUT", "TUYA"):  # stresses stand at nodes: two points are too few
        return
    v = two.vectors(K, u)
    weights = families.integration_weights(zone, "STRESSES", given)
    pairs = zip(stress.components.values(), strain.components.values(), strict=True)
    work = sum((weights * s * e).sum(axis=1) for s, e in pairs)
    near(work, np.einsum("ci,cij,cj->c", v, K.values, v), tolerance)


@together("element, mode", [(e, m) for e, m in ALL if m in FREE])
def test_nothing_depends_on_how_a_body_is_turned(element, mode):
    found = []
    for angle in (0.0, 0.7):
        two = Two(element, mode, turned(angle, mode))
        u = two.field(drawn(two, mode))
        K, M = families.stiffness(two.zone, two.material), families.mass(two.zone, two.material)
        stress = CellField((families.stress(two.zone, two.material, u),))
        G = families.geometric_stiffness(two.zone, stress, two.material)
        found.append([two.product(A, u) for A in (K, M, G)])
    for a, b in zip(*found, strict=True):
        near(a, b)


@together("element, mode", [(e, m) for e, m in ALL if m in FREE])
def test_rigid_motions_alone_strain_nothing_and_need_no_force(element, mode):
    two = Two(element, mode, np.eye(3))
    space = mode in SPACED
    w, v = (np.array([0.3, -0.5, 0.8]) * [space, space, 1], np.array([1.1, 0.7, 0.9 * space]))
    u = [v + np.cross(w, two.x), np.tile(w, (len(two.x), 1))]
    K = families.stiffness(two.zone, two.material)
    other = two.product(K, two.field(drawn(two, mode)))
    pushed = two.product(K, two.field(u))
    size = np.abs(other).max(axis=(1, 2)) / 1e-3
    assert (np.abs(pushed).max(axis=(1, 2)) <= 1e-9 * size).all()
    values = np.linalg.eigvalsh(K.values)
    free = (values < 1e-10 * values[:, -1:]).sum(axis=1)
    rigid = 6 if space else 3
    if element[:3] == "BAR":  # held along itself alone
        rigid = K.values.shape[1] - len(K.local) // mode.dimension + 1
    assert (free == LOOSE.get(element, 0) + rigid).all(), free
    strain = families.strain(two.zone, two.field(u), two.material).components
    usual = families.strain(two.zone, two.field(drawn(two, mode)), two.material).components
    for name, values in strain.items():
        assert np.abs(values).max() <= 1e-8 * np.abs(usual[name]).max()


@together("element, mode", [(e, m) for e, m in ALL if m in FREE and e != "SHB8"])
def test_stresses_that_turn_with_a_body_turn_its_forces(element, mode):
    """Geometric stiffness times a small turn is the turned forces, whatever the stresses.

    Of lines and shells those along them.
    """
    two = Two(element, mode, np.eye(3))
    u = drawn(two, mode)
    if element not in SOLIDS:
        two.material.blocks[0].components.pop("EXCE", None)
        u[1] = u[0, :, 2] = 0.0
        u[0] = two.x @ np.array([[1e-3, -4e-4, 0], [2e-3, 3e-3, 0], [0, 0, 0]])
    if CELL_TYPES[ELEMENTS[element].cell_type].dimension == 1:
        x = two.x.reshape(2, -1, 3)
        along = x - x[:, :1]
        axes = along[:, -1] / np.linalg.norm(along[:, -1], axis=1)[:, None]
        u[0] = (1e-3 * np.vecdot(along, axes[:, None])[..., None] * axes[:, None]).reshape(-1, 3)
    stress = CellField((families.stress(two.zone, two.material, two.field(u)),))
    forces = two.at_nodes(families.internal_forces(two.zone, stress, two.material))
    G = families.geometric_stiffness(two.zone, stress, two.material)
    w = np.array([0.3, -0.5, 0.8]) if mode in SPACED else np.array([0.0, 0.0, 1.0])
    spin = two.field([np.cross(w, two.x), np.tile(w, (len(two.x), 1))])
    near(two.product(G, spin)[0], np.cross(w, forces[0]))


@together("element, mode", ALL)
@together("lumped", [False, True])
def test_mass_is_that_of_the_matter_in_each_direction(element, mode, lumped):
    two = Two(element, mode, np.eye(3))
    M = families.mass(two.zone, two.material, lumped)
    given = {k: v[:, 0] for k, v in two.material.blocks[0].components.items()}
    size = measure(two, element, mode)
    if size is None:
        size = families.integration_weights(two.zone, "MASSE", two.material).sum(axis=1)
    section = given.get("SECT", given.get("EPAI", 1.0))
    if element == "TUYA":
        section = np.pi * (given["RAYO"] ** 2 - (given["RAYO"] - given["EPAI"]) ** 2)
    expected = given["RHO"] * size * section
    rng = np.random.default_rng(2)
    for i in range(3 if mode in SPACED else 2):
        along = np.zeros((2, len(two.x), 3))
        along[0, :, i] = 1.0
        v = two.vectors(M, two.field(along))
        crooked = mode is Mode.AXISYMMETRIC and element[:2] == "PO"  # their rule is not exact
        near(np.einsum("ci,cij,cj->c", v, M.values, v), expected, 1e-3 if crooked else 1e-12)
    x = rng.standard_normal((M.values.shape[1], 5))
    assert (np.einsum("ik,cij,jk->ck", x, M.values, x) > 0.0).all() or element in SHELLS
    near(M.values, np.swapaxes(M.values, 1, 2), 1e-13)
    if lumped:
        near(M.values, M.values * np.eye(M.values.shape[1]), 1e-15)


@together("element", ["POUT", "TIMO", "TUYA"])
def test_a_line_that_turns_has_the_energy_of_its_sections_in_their_axes(element):
    two, w = Two(element, Mode.THREE_DIMENSIONAL, np.eye(3)), np.array([0.3, -0.5, 0.8])
    given = {k: v[:, 0] for k, v in two.material.blocks[0].components.items()}
    if element == "TUYA":
        outer, inner = given["RAYO"], given["RAYO"] - given["EPAI"]
        given["INRY"] = given["INRZ"] = np.pi / 4 * (outer**4 - inner**4)
        given["SECT"] = np.pi * (outer**2 - inner**2)
    ends = two.zone.cells.coordinates
    v = np.cross(w, ends)
    along = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(along, axis=1)
    third = np.cross(along, [0.2, 0.9, 0.4])
    axes = [x / np.linalg.norm(x, axis=1)[:, None] for x in (along, np.cross(third, along), third)]
    inertia = (given["INRY"] + given["INRZ"], given["INRY"], given["INRZ"])
    exact = given["SECT"] * (np.vecdot(v[:, 0], v.sum(axis=1)) + np.vecdot(v[:, 1], v[:, 1])) / 3
    exact += sum(moment * (e @ w) ** 2 for e, moment in zip(axes, inertia, strict=True))
    M = families.mass(two.zone, two.material)
    turn = two.vectors(M, two.field([np.cross(w, two.x), np.tile(w, (len(two.x), 1))]))
    near(np.einsum("ci,cij,cj->c", turn, M.values, turn), given["RHO"] * length * exact, 1e-12)


@together("element, mode", ALL)
def test_cells_one_by_one_give_what_all_at_once_do(element, mode, monkeypatch):
    two = Two(element, mode, np.eye(3))
    made = (families.stiffness, families.mass)
    whole = [of(two.zone, two.material).values for of in made]
    monkeypatch.setattr(chunks, "__defaults__", (1,))
    for of, wanted in zip(made, whole, strict=True):
        np.testing.assert_allclose(
            of(two.zone, two.material).values, wanted, atol=1e-12 * np.abs(wanted).max()
        )


@together("points", [1, 2, 4])
@together("varying", [False, True])
@together("cells", [1, 3])
def test_products_sum_over_points_whose_moduli_may_differ(points, varying, cells):
    rng = np.random.default_rng(5)
    B, w = rng.standard_normal((3, 4, points, 5)), rng.uniform(1.0, 2.0, (3, points))
    D = rng.standard_normal((cells, points if varying else 1, 4, 4))
    D[..., 1, 2] = 0.0  # a term that is nowhere
    wide = np.broadcast_to(D, (3, points, 4, 4))
    found = contract(StrainOperator(B, w), D)
    np.testing.assert_allclose(found, np.einsum("cp,cspm,cpst,ctpn->cmn", w, B, wide, B))


@together("element, mode", ALL)
def test_fields_carried_between_supports_stay_what_they_are(element, mode):
    zone = Two(element, mode, np.eye(3)).zone
    places = ("GRAVITE", "RIGIDITE", "MASSE", "STRESSES")
    rng = np.random.default_rng(1)
    for source in places:
        at = support_rule(element, source)
        back = transfer_matrix(element, source, "NOEUD")
        np.testing.assert_allclose(back.sum(axis=1), 1.0, rtol=1e-12, err_msg=source)
        for target in places:
            to = support_rule(element, target)
            drawn_values = rng.standard_normal((len(zone.cells), len(at)))
            found = carry(drawn_values, element, source, target)
            if np.array_equal(at.points, to.points):  # the same points, whatever they are called
                np.testing.assert_allclose(found, drawn_values, rtol=1e-12)
