"""Generalised plane strain: the section's own motion stretches it along its normal."""

from dataclasses import replace

import numpy as np
import pytest

from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.results.frames import points_of
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.mesh.mesh import Point
from tests.kernel.elements.samples import cell_zone, material

MODE = Mode.GENERALISED_PLANE_STRAIN
E, NU = 3e7, 0.2


@pytest.fixture(params=["QUA4", "TRI6", "QUA8"])
def zone(request):
    plain = cell_zone(request.param, MODE)
    node = int(plain.cells.nodes.add(np.array([[0.7, -0.4]]))[0])
    return replace(plain, options={"DPGE": Point(plain.cells.nodes, node)})


def motion(zone, u, section):
    """Displacements of the cell's nodes and UZ RX RY of the section's."""
    table = zone.cells.nodes
    nodes = np.sort(zone.cells.connectivity[0])
    parts = {n: NodeValues(nodes, u(table.coordinates[nodes])[:, i]) for i, n in
             enumerate(("UX", "UY"))}  # fmt: skip
    own = np.array([zone.options["DPGE"].number])
    parts |= {n: NodeValues(own, np.array([v])) for n, v in
              zip(("UZ", "RX", "RY"), section, strict=True)}  # fmt: skip
    return NodeField(table, parts, "DIFFUS")


def test_strains_across_grow_from_the_section_s_point(zone):
    A = np.array([[1e-3, -4e-4], [2e-3, 3e-3]])
    found = families.strain(zone, motion(zone, lambda x: x[:, :2] @ A.T, (2e-3, 5e-4, -3e-4)))
    x = points_of(zone, "STRESSES")[0]
    across = 2e-3 + (x[:, 1] + 0.4) * 5e-4 + (x[:, 0] - 0.7) * 3e-4
    for name, value in (("EPXX", 1e-3), ("EPYY", 3e-3), ("GAXY", 1.6e-3), ("EPZZ", across)):
        np.testing.assert_allclose(found.components[name][0], value, atol=1e-12)


def test_forces_on_the_section_are_the_resultants_of_the_stresses_across(zone):
    given = material(zone, YOUN=E, NU=NU)
    u = motion(zone, lambda x: x[:, :2] * [1e-3, -2e-3], (2e-3, 5e-4, -3e-4))
    stress = families.stress(zone, given, u)
    forces = families.internal_forces(zone, CellField((stress,)), given)
    K = families.stiffness(zone, given)
    layout = Layout(zone.cells.nodes, K.raw_nodes, K.local, K.unknowns)
    exact = layout.scatter(np.einsum("cij,cj->ci", K.values, layout.gather(u)))
    nodes = np.unique(K.raw_nodes)
    for name in ("FX", "FY", "FZ", "MX", "MY"):
        np.testing.assert_allclose(
            forces.values_at(name, nodes), exact.values_at(name, nodes), atol=1e-6
        )
    w = families.integration_weights(zone, "STRESSES", given)[0]
    x, s = points_of(zone, "STRESSES")[0], stress.components["SMZZ"][0]
    at = np.array([zone.options["DPGE"].number])
    for name, arm in (("FZ", 1.0), ("MX", x[:, 1] + 0.4), ("MY", 0.7 - x[:, 0])):
        assert forces.values_at(name, at)[0] == pytest.approx((w * s * arm).sum(), rel=1e-9)
