"""Harmonic responses against full complex matrices, and frequencies against generalised pairs."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
from references.assembled import Bench
from together import together

from ssilang.kernel.base.errors import FieldError, KernelError, SingularMatrixError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.statics import frequency
from ssilang.kernel.statics.frequency import HarmonicInputs, default_frequencies, sweep
from ssilang.kernel.statics.stability import (
    free_motion_fields,
    negative_eigenvalues,
    negative_unknowns,
)

M, K, C = (2.0, 3.0, 1.5, 0.7), (4e3, 9e3, 2e3, 6e3), (30.0, 0.0, 12.0, 5.0)


class Chain:
    """Four masses; the last moves as it is told, the second and third are tied unequally."""

    def __init__(self, damped=True):
        b = self.bench = Bench()
        self.n = [b.node(float(i), 0.0) for i in range(4)]
        b.spring(K[0], self.n[0])
        for i in range(3):
            b.spring(K[i + 1], self.n[i], self.n[i + 1])
        for i, n in enumerate(self.n):
            b.mass(M[i], n, ("UY",))
            if damped and C[i]:
                b.dashpot(C[i], n)
        self.told = b.relate([(2.0, "UY", self.n[3])])
        self.tie = b.relate([(1.0, "UY", self.n[1]), (-3.0, "UY", self.n[2])])
        self.K = np.zeros((4, 4))
        self.K[0, 0] += K[0]
        for i in range(3):
            self.K[i : i + 2, i : i + 2] += K[i + 1] * np.array([[1, -1], [-1, 1]])
        self.M = np.diag(M)
        self.C = np.diag(C) * damped
        self.rows = np.array([[0, 0, 0, 2.0], [0, 1.0, -3.0, 0]])

    def load(self):
        b, n = self.bench, self.n
        pushes = b.field((n[0], "FY", 5.0), (n[1], "IFY", -3.0), (n[0], "IFY", 2.0))
        moves = b.field((self.told, "FLX", 0.01), (self.told, "IFLX", 0.004))
        parts = b.load(pushes, [1.0, 20.0], [1.0, 3.0]).parts
        return Load(parts + b.load(moves, [2.0, 30.0], [2.0, 0.5]).parts)

    def inputs(self, load=None):
        b = self.bench
        return HarmonicInputs(b.stiffness, b.mass_matrix, b.damping, load or self.load())


@together("dense", [True, False])
def test_responses_are_those_of_the_complex_system(dense, monkeypatch):
    if not dense:
        monkeypatch.setattr(frequency, "_DENSE", 0)
    c = Chain()
    for f, got in zip((0.0, 3.0, 11.0), sweep(c.inputs(), np.array([0.0, 3.0, 11.0])), strict=True):
        w = 2 * np.pi * f
        A = c.K - w**2 * c.M + 1j * w * c.C
        first, second = np.interp(f, [1, 20], [1, 3]), np.interp(f, [2, 30], [2, 0.5])
        b = np.array([first * (5 + 2j), first * -3j, 0, 0, second * (0.01 + 0.004j), 0])
        x = la.solve(np.block([[A, c.rows.T], [c.rows, np.zeros((2, 2))]]), b)
        u = [got.displacement.values_at(n, np.array(c.n)) for n in ("UY", "IUY")]
        np.testing.assert_allclose(u[0] + 1j * u[1], x[:4], rtol=1e-9, atol=1e-12)
        r = [got.reactions.values_at(n, np.array(c.n)) for n in ("FY", "IFY")]
        np.testing.assert_allclose(r[0] + 1j * r[1], -c.rows.T @ x[4:], rtol=1e-9, atol=1e-9)
        at = np.array([c.told, c.tie])
        x_of = [got.displacement.values_at(n, at) for n in ("LX", "ILX")]
        np.testing.assert_allclose(x_of[0] + 1j * x_of[1], x[4:], rtol=1e-9)
        assert got.frequency == f


def exact_frequencies(c):
    T = la.null_space(c.rows)
    return np.sqrt(la.eigh(T.T @ c.K @ T, T.T @ c.M @ T, eigvals_only=True)) / (2 * np.pi)


def test_frequencies_of_a_sweep_are_close_where_it_resounds():
    c = Chain()
    natural = exact_frequencies(c)
    found = default_frequencies(c.inputs())
    np.testing.assert_allclose(frequency.natural_frequencies(frequency._System(c.inputs())),
                               natural, rtol=1e-9)  # fmt: skip
    assert found[0] == pytest.approx(max(natural[0] / 20, 1.0))
    assert found[-1] == pytest.approx(min(2 * natural[-1], 30.0))
    before, steps = found[:-1], np.diff(found)
    assert (steps > 0).all()
    near = natural[np.abs(natural - before[:, None]).argmin(axis=1)]
    away = np.maximum(np.abs(before - near), 0.002 * near)
    usual = np.isclose(steps, np.minimum(0.02 * before, 0.08 * away), rtol=1e-9)
    over = np.isclose(found[1:], 1.002 * near, rtol=1e-9)
    assert (usual | over)[:-1].all()
    assert 0 < over.sum() <= len(natural)
    for f in natural:  # stepped over, not onto
        assert 0.0019999 * f < np.abs(found - f).min() < 5e-3 * f
    whole = default_frequencies(c.inputs(c.bench.load(c.bench.field((c.n[0], "FY", 1.0)))))
    np.testing.assert_allclose(whole[[0, -1]], [natural[0] / 20, 2 * natural[-1]])
    high = c.bench.load(c.bench.field((c.n[0], "FY", 1.0)), [900.0, 990.0], [1.0, 1.0])
    with pytest.raises(KernelError, match="900"):
        default_frequencies(c.inputs(high))


def test_springs_of_the_frequency_add_to_the_matrices_at_every_frequency():
    """Two springs of one zone: on a mass of the chain, and on a node that nothing else holds."""
    c = Chain()
    at = np.array([c.n[2], c.bench.node(9.0, 0.0)])
    cells = CellBlock.make(c.bench.table, "POI1", at[:, None])
    zone = Zone(cells, "MECANIQUE", ("ELASTIQUE", "IMPEDANCE", "COMPLEXE"), "IMP1",
                c.bench.mode, options={"UNKNOWNS": (("UY",), ())})  # fmt: skip
    moco = [CurvePart(np.array([0.0, 10.0]), np.array(y), "f", name)
            for name, y in (("MOCO", (5e3, 9e3)), ("VISC", (40.0, 90.0)))]  # fmt: skip
    data = np.full((2, 1), Curve(tuple(moco)), object)
    field = CellField((CellFieldBlock(cells, {"MOCO": data}, "RIGIDITE", "IMP1"),))
    springs = ((zone, zone_field(zone, field)),)
    push = c.bench.field((c.n[0], "FY", 5.0), (int(at[1]), "FY", 7.0))
    inputs = replace(c.inputs(c.bench.load(push)), springs=springs)
    (got,) = sweep(inputs, np.array([4.0]))
    w = 8 * np.pi
    Z = 6.6e3 + 1j * w * 60.0
    A = c.K - w**2 * c.M + 1j * w * c.C + np.diag([0, 0, Z, 0])
    b = np.array([5.0, 0, 0, 0, 0, 0])
    x = la.solve(np.block([[A, c.rows.T], [c.rows, np.zeros((2, 2))]]), b)
    u = [got.displacement.values_at(n, np.array([*c.n, at[1]])) for n in ("UY", "IUY")]
    np.testing.assert_allclose(u[0] + 1j * u[1], [*x[:4], 7.0 / Z], rtol=1e-9, atol=1e-15)
    c.K[2, 2] += 5e3
    found = frequency.natural_frequencies(frequency._System(inputs))
    np.testing.assert_allclose(found, exact_frequencies(c), rtol=1e-9)


def test_rigid_motions_are_no_frequencies():
    b = Bench()
    n = [b.node(float(i), 0.0) for i in range(6)]
    for i in (0, 2, 4):
        b.spring(1e9, n[i], n[i + 1])
    for i, m in enumerate((2.0, 3.0, 5.0, 7.0, 11.0, 13.0)):
        b.mass(m, n[i], ("UY",))
    inputs = HarmonicInputs(b.stiffness, b.mass_matrix, None, None)
    exact = [np.sqrt(1e9 * (1 / p + 1 / q)) for p, q in ((11, 13), (5, 7), (2, 3))]
    found = frequency.natural_frequencies(frequency._System(inputs))
    np.testing.assert_allclose(found, np.array(exact) / (2 * np.pi), rtol=1e-9)


def test_what_has_no_response_is_refused(monkeypatch):
    c = Chain(damped=False)
    with pytest.raises(SingularMatrixError, match="singular"):
        list(sweep(c.inputs(), exact_frequencies(c)[:1]))
    b = c.bench
    for load, match in (
        (Load((LoadPart("T", b.field((c.n[0], "T", 1.0))),)), "T"),
        (Load((LoadPart("MECA", 3.0),)), "nod"),
        (b.load(b.field((c.n[0], "FX", 1.0))), "FX"),
        (b.load(b.field((c.n[0], "IFX", 1.0))), "FX"),
        (b.load(b.field((b.node(9.0, 9.0), "IFY", 1.0))), "FY"),
    ):
        with pytest.raises(FieldError, match=match):
            list(sweep(c.inputs(load), np.array([1.0])))
    monkeypatch.setattr(frequency, "_LARGEST_GUESS", 3)
    with pytest.raises(KernelError, match="4"):
        default_frequencies(c.inputs())
    b.relate([(1.0, "UY", c.n[0])], sense=1)
    with pytest.raises(KernelError, match="unilateral"):
        list(sweep(c.inputs(), np.array([1.0])))


def test_negative_springs_and_free_motions_are_counted_and_named():
    b = Bench()
    n = [b.node(float(i), 0.0) for i in range(5)]
    b.spring(-7.0, n[0])
    b.spring(2.0, n[0], n[1])
    b.spring(-3.0, n[2])
    b.spring(4.0, n[2])
    b.spring(-1.0, n[3])
    b.spring(-2.0, n[4], unknown="UX")
    b.fix(n[3], "UY")
    found = [(node, name) for node, name, _ in negative_unknowns(b.stiffness)]
    assert found == [(n[0], "UY"), (n[4], "UX")]
    assert negative_unknowns(b.stiffness)[0][2] == pytest.approx(-5.0)
    assert negative_eigenvalues(b.stiffness) == 2  # the held one moves nowhere
    loose = Bench()
    m = [loose.node(float(i), 0.0) for i in range(4)]
    loose.spring(3.0, m[0], m[1])
    loose.spring(2.0, m[1], m[2])
    loose.spring(5.0, m[3])
    fields, pins = free_motion_fields(loose.stiffness)
    assert len(fields) == 1
    np.testing.assert_allclose(fields[0].values_at("UY", np.array(m)), [1, 1, 1, 0], atol=1e-9)
    assert set(pins.tolist()) < set(m[:3])
