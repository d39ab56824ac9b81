"""State, tractions, mass and energies at points of joints, along paths whose work is integrated."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from references.law_points import energies as energies_at
from together import together

from ssilang.kernel.elements.families import mass, stiffness
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.family import displacement_names, rotational_stiffness
from ssilang.kernel.interface.laws.columns import (
    N_PARAMETERS,
    N_STATE,
    LawCode,
    Parameter,
)
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.point_state import (
    CLOSED,
    CLOSING,
    OPEN,
    OPENING,
    energies_of_points,
    point_states,
)
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    interface_response,
    mean_response,
    new_trial,
)
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix

ELASTIC, SDM, MOHR, STRIP, PENDULUM = 0, 1, 2, 3, 8


def parameters(**given):
    table = np.zeros((1, N_PARAMETERS))
    for name, value in ({"KN": 1e9, "KS1": 4e8, "KS2": 4e8, "FROT": -1.0} | given).items():
        table[0, Parameter[name]] = value
    return table


class Point:
    """One point walked along jumps, its work by Simpson's rule on the way."""

    def __init__(self, code, **given):
        self.code, self.p = np.array([code]), parameters(**given)
        self.w, self.t, self.work = np.zeros((1, 2)), np.zeros((1, 2)), 0.0
        self.state = np.zeros((1, N_STATE))

    def answer(self, w):
        t, new, D = np.zeros((1, 2)), np.zeros((1, N_STATE)), np.zeros((1, 2, 2))
        respond(self.code, w, self.state, self.p, t, new, D)
        return t, new

    def to(self, shear, normal, pieces=4000):
        last = np.array([[shear, normal]])
        step = (last - self.w) / pieces
        for _ in range(pieces):
            t0 = self.t
            self.w = self.w + step
            self.t, self.state = self.answer(self.w)
            self.work += float(((t0 + self.t) / 2 * step).sum())
        return self

    @property
    def arrays(self):
        return self.code, self.w, self.t, self.state, self.p

    @property
    def condition(self):
        return point_states(*self.arrays)[0]

    @property
    def energies(self):
        return energies_of_points(*self.arrays)[:, 0]


@pytest.mark.parametrize("unit", [1.0, 1e6])
def test_states_of_a_joint_with_strength_along_its_path(unit):
    p = Point(SDM, KN=1e9 / unit, FU=1e5 / unit, GF=20.0 / unit, FC=-2e4 / unit)
    assert p.condition == OPEN  # at rest between FC and the strength
    assert p.to(0, -1e-4).condition == CLOSED
    assert p.to(0, 5e-5).condition == OPEN  # elastic tension
    assert p.to(0, 4e-4).condition == OPENING
    xi = p.state[0, 0]
    assert p.to(0, xi + 1e-6).condition == OPEN  # unloading towards the largest opening
    assert p.to(0, xi / 2).condition == CLOSING
    assert -2e4 < unit * p.t[0, 1] < 0
    assert p.to(0, -1e-4).condition == CLOSED
    assert p.to(0, 8e-4).condition == OPENING


def test_states_of_a_joint_without_tension():
    p = Point(SDM)
    assert p.condition == CLOSED
    assert p.to(0, 1e-3).condition == OPENING
    assert p.to(0, 5e-4).condition == OPEN
    assert p.to(0, 2e-3).condition == OPENING
    assert p.to(0, -1e-6).condition == CLOSED


def test_states_of_the_other_laws():
    assert Point(ELASTIC).to(0, 1e-3).condition == CLOSED  # bonded
    assert Point(MOHR, TPHI=0.5).to(0, -1e-4).condition == CLOSED
    assert Point(MOHR, TPHI=0.5).to(0, 1e-4).condition == OPEN
    assert Point(MOHR, FTRC=1e4, COHE=1e5).to(0, 1e-4).condition == OPENING
    strip = {"KN": 1e6, "LARG": 4.0, "KS1": 1e6 * 16 / 12}
    assert Point(STRIP, **strip).to(1e-4, -1e-3).condition == CLOSED
    assert Point(STRIP, **strip).to(1e-3, -1e-3).condition == OPEN
    bowl = Point(PENDULUM, RAYO=2.0, FROT=0.1).to(0.04, 3e-4)
    assert bowl.condition == CLOSED  # 0.8 mm of the bowl above where it rose to
    assert bowl.to(0.04, 9e-4).condition == OPEN


def test_opening_spends_the_fracture_energy():
    fu, gf = 1e5, 20.0
    p = Point(SDM, FU=fu, GF=gf).to(0, 6e-4)
    xi = p.state[0, 0]
    # traction integrated to 1e-9 by Gauss-Legendre on the elastic and on the softening part
    nodes, weights = np.polynomial.legendre.leggauss(40)
    start = fu / 1e9
    w = start + (6e-4 - start) * (nodes + 1) / 2
    t = [Point(SDM, FU=fu, GF=gf).to(0, x, 1).t[0, 1] for x in w]
    work = fu * start / 2 + (6e-4 - start) / 2 * float(weights @ t)
    stored, lost = p.energies
    assert lost == pytest.approx(gf * (1 - np.exp(-fu * xi / gf)), rel=1e-7)
    assert stored + lost == pytest.approx(work, rel=1e-7)


def test_a_joint_of_three_dimensions_opens_along_its_normal():
    """Tension beside shear of the other sign: the traction across decides, not that along."""
    p = parameters(TPHI=0.5, COHE=1e9, FTRC=1e9)
    w, t = np.array([[-1e-3, -2e-3, 1e-3]]), np.array([[-4e5, -8e5, 1e6]])
    state = np.zeros((1, N_STATE))
    assert point_states(np.array([MOHR]), w, t, state, p)[0] == OPENING
    assert point_states(np.array([MOHR]), -w, -t, state, p)[0] == CLOSED


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


KN, KS = 3e8, 1.1e8
LAWS = {
    "opens": {"FU": 0.0, "FC": 0.0, "FROT": -1.0},
    "bonded": {"FU": 2e4, "GF": 15.0, "FC": 0.0, "FROT": 0.4},
    "bonded, closes late": {"FU": 2e4, "GF": 15.0, "FC": -1e4, "FROT": -1.0},
}


@together("d", [2, 3])
@together("name", LAWS)
def test_mean_traction_times_step_is_what_is_stored_and_lost(name, d):
    """Also where a step opens, closes, tears and rests; its tangent by differences."""
    rng, n = np.random.default_rng(9), 60
    p = np.zeros((n, N_PARAMETERS))
    for parameter, value in {"KN": KN, "KS1": KS, "KS2": 0.4 * KS, **LAWS[name]}.items():
        p[:, Parameter[parameter]] = value
    scales = rng.uniform(0.5, 1.5, n)
    p[:, Parameter.KN] *= scales
    pairs, B = np.arange(n)[::-1, None].copy(), np.tile(np.eye(d), (n, 1, 1))
    weights, codes = rng.uniform(0.5, 2.0, n), np.full(n, int(LawCode.SDM))
    joints = Joints(pairs, B, weights, codes, p)
    zero = np.zeros
    now = InterfaceState(zero(n * d), zero(n * d), zero((n, d)), zero((n, d)), zero((n, N_STATE)))

    def answered(w):
        end = new_trial((n, d), n * d, mean=True)
        interface_response(joints, now.state, w[::-1].ravel(), end)
        mean_response(joints, now, end)
        return end, end.mean

    def energies(w, t, state):
        return np.array([energies_at(1, *one) for one in zip(w, t, state, p, strict=True)])

    changed = 0
    for size in (1e-4, 4e-4, 1e-3, 4e-4, 1e-3, 2e-4, 1e-3):
        w = rng.uniform(-1.0, 1.0, (n, d)) * size
        w[::7] = now.w[::7]
        w[1::7, -1] = p[1::7, Parameter.FC] / p[1::7, Parameter.KN] + 0.05 * w[1::7, -1]
        end, tm = answered(w)
        np.testing.assert_allclose(end.w, w, rtol=1e-12)
        step = energies(w, end.t, end.state) - energies(now.w, now.t, now.state)
        work = np.vecdot(tm, w - now.w)
        scale = np.abs(work).max()
        np.testing.assert_allclose(step.sum(axis=1), work, atol=1e-9 * scale)
        np.testing.assert_allclose(end.f.reshape(n, d), (weights[:, None] * tm)[::-1], rtol=1e-12)
        ways = [(answered(w + h)[1] - answered(w - h)[1]) / 2e-9 for h in 1e-9 * np.eye(d)]
        slopes, moved = np.stack(ways, axis=2), np.arange(n) % 7 > 0
        np.testing.assert_allclose(end.D[moved], slopes[moved], rtol=1e-5, atol=1e-6 * KN)
        changed += np.sum((end.t[:, -1] < 0.0) != (now.t[:, -1] < 0.0))
        now = InterfaceState(now.delta, end.f, w, end.t, end.state)
    assert changed > 50
