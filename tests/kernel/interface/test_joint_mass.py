"""The mass of a joint's own matter, shared by both sides; the moduli of two points."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from together import together

from ssilang.kernel.elements.families import mass, stiffness
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.family import displacement_names, rotational_stiffness
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix


def masses(bench: Bench, zone) -> dict[int, float]:
    """Mass that moves with each node along x, from the row sums."""
    matrix = Matrix(bench.table, (mass(zone, bench.characteristics),), kind="MASSE")
    numbering = numbering_of(matrix)
    M = assemble(matrix, numbering)
    rows = numbering.where(displacement_names(zone)[0])
    moved = np.zeros(numbering.size)
    moved[rows] = 1.0
    carried = M @ moved
    return dict(zip(numbering.nodes[rows].tolist(), carried[rows].tolist(), strict=True))


def test_a_joint_of_two_points_has_its_mass_half_and_half():
    bench = Bench()
    soil, top = bench.node(0.0, 0.0), bench.node(0.0, 1.0)
    zone = bench.joint("SEG2", [soil, top], "JOI1", KN=1.0, KS=1.0, MASS=6.0)
    assert masses(bench, zone) == pytest.approx({soil: 3.0, top: 3.0})


def test_a_surface_joint_has_its_density_on_the_middle():
    """Density 5 on lengths of 3 and 0.8: each corner of both sides has a quarter of a cell's."""
    bench = Bench()
    low, up = ([bench.node(x, 0.0) for x in (0.0, 3.0, 3.8)] for _ in range(2))
    cells = [[*up[k : k + 2], *low[k : k + 2]] for k in (0, 1)]
    zone = bench.joint("RAC2", cells, "JOI2", KN=1.0, KS=1.0, RHO=5.0)
    wanted = dict(zip(low + up, [3.75, 4.75, 1.0] * 2, strict=True))
    assert masses(bench, zone) == pytest.approx(wanted)


@together("mode", [Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL])
@together("kind", ["", "ANISOTROPE"])
def test_two_points_push_by_their_moduli_along_and_about_their_own_axes(mode, kind):
    """Jumps and turns of the second point against the first: normal, two shears; turns alike."""
    rng, bench, d = np.random.default_rng(3), Bench(mode), mode.dimension
    n = 2 * d - (d == 2)  # components, their normal one first
    root = rng.standard_normal((n, n))
    D = root @ root.T + np.eye(n)
    if kind:
        given = {f"D{i + 1}{j + 1}": D[i, j] for i in range(n) for j in range(i + 1)}
    else:
        D = np.diag(np.diag(D))
        names = ("KN", "KS", "QS") if d == 2 else ("KN", "KS1", "KS2", "QN", "QS1", "QS2")
        given = dict(zip(names, np.diag(D), strict=True)) | {"FRIC": 30.0}
    axes = np.linalg.qr(rng.standard_normal((d, d)))[0]
    axes[-1] *= np.linalg.det(axes)
    given |= {f"V{k + 1}{c}": axes[k, i] for k in range(d - 1) for i, c in enumerate("XYZ"[:d])}
    nodes = [bench.node(*(0.0 * axes[0])), bench.node(*axes[0])]
    zone = bench.joint("SEG2", nodes, "JOI1", kind or "ELASTIQUE", **given)
    block = stiffness(zone, bench.characteristics)
    layout = Layout(block.table, block.raw_nodes, block.local, block.unknowns)
    u = {name: rng.standard_normal(2) for name in block.unknowns}
    v = layout.gather(NodeField.of(bench.table, np.array(nodes), u, "DIFFUS"))
    jump, turn = (
        np.array([u[name][1] - u[name][0] for name in names if name in u])
        for names in (("UX", "UY", "UZ"), ("RX", "RY", "RZ"))
    )
    local = np.concatenate([axes @ jump, turn if d == 2 else axes @ turn])
    found = np.einsum("ci,cij,cj->c", v, block.values, v)
    np.testing.assert_allclose(found, local @ D @ local, rtol=1e-12)
    if not kind:  # the turns alone, beside a law of the displacements
        law = ("ELASTIQUE", "ORTHOTROPE", "PLASTIQUE", "COULOMB")
        block = rotational_stiffness(replace(zone, behaviour=law), bench.characteristics)
        found = np.einsum("ci,cij,cj->c", v, block.values, v)
        np.testing.assert_allclose(found, local[d:] @ D[d:, d:] @ local[d:], rtol=1e-12)
