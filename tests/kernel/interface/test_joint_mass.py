"""The mass of a joint's own matter: all of it, shared by both sides."""

import numpy as np
import pytest
from references.assembled import Bench

from ssilang.kernel.elements.families import mass
from ssilang.kernel.interface.family import displacement_names
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
