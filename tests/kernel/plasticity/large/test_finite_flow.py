"""Plastic bodies in large strains: tangents, turns, volumes, shear against Dienes' solution."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.plasticity.finite import finite_zone
from ssilang.kernel.plasticity.large.finite_flow import LAGRANGIAN
from ssilang.kernel.plasticity.large.finite_yielding import FiniteBulk, InsideOutError
from ssilang.kernel.plasticity.points import PointState
from ssilang.kernel.plasticity.zone_points import plastic_points

MESH = {
    "strain": "OPTI DIME 2 MODE PLAN DEFO ELEM QUA8 ; S = TRAN 1 (DROI 1 (0 0) (1 0)) (0.3 1.) ;",
    "stress": "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = TRAN 1 (DROI 1 (0 0) (1 0)) (0.3 1.) ;",
    "ring": "OPTI DIME 2 MODE AXIS ELEM QUA4 ; S = TRAN 1 (DROI 1 (1 0) (2 0)) (0.3 1.) ;",
    "space": "OPTI DIME 3 ELEM CUB8 ; "
    "S = VOLU 1 (TRAN 1 (DROI 1 (0 0 0) (1 0 0)) (0 1 0)) 'TRAN' (0.2 0 1) ;",
}
LAWS = {
    "perfect": ("PARFAIT", "'SIGY' 0.2"),
    "kinematic": ("CINEMATIQUE", "'SIGY' 0.2 'H' 0.4"),
    "cone": ("DRUCKER_PARFAIT", "'LTR' 0.1 'LCS' 0.3"),
    "elastic": ("PARFAIT", "'SIGY' 1.E9"),
}


def zone_of(mesh, law="perfect", word="MI_PAS"):
    name, numbers = LAWS[law]
    result = ran(
        f"{MESH[mesh]} M = MODE S 'MECANIQUE' 'ELASTIQUE' 'PLASTIQUE' '{name}' ; "
        f"A = MATE M 'YOUN' 5. 'NU' 0.3 {numbers} ;"
    )
    zone, material = result.session.root.find("M").zones[0], result.session.root.find("A")
    points = plastic_points(zone, material)
    made = LAGRANGIAN[word](finite_zone(zone, material), points)
    zero = np.zeros((points.count, 6))
    blank = PointState(zero, zero, zero, np.zeros((points.count, len(points.law.variables))), 0.0)
    cells = zone.cells.nodes.coordinates[zone.cells.connectivity]
    return made, blank, cells[..., : 3 if mesh == "space" else 2]


def moved(cells, amount, seed):
    return amount * np.random.default_rng(seed).standard_normal(cells.shape).reshape(len(cells), -1)


def turned(cells, angle, u):
    """The displacement where the body displaced by u is turned about the last axis."""
    R = np.eye(cells.shape[-1])
    R[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return ((cells + u.reshape(cells.shape)) @ R.T - cells).reshape(len(cells), -1), R


def stretched(cells, *factors):
    return (cells * (np.array(factors) - 1.0)).reshape(len(cells), -1)


@together("word", ["MI_PAS", "FIN_PAS", "TOTAL"])
@together("law", ["perfect", "kinematic", "cone"])
@together("mesh", MESH)
def test_tangent_is_the_derivative_of_the_forces(mesh, law, word):
    zone, blank, cells = zone_of(mesh, law, word)
    first = moved(cells, 0.03, 1)
    last, _ = zone.respond(0.0 * first, first, blank, 1.0)
    u, du, h = first + moved(cells, 0.04, 2), moved(cells, 1.0, 3), 1e-7

    def forces(v):
        return zone.respond(first, v, last, 2.0)[1].forces(v)

    state, now = zone.respond(first, u, last, 2.0)
    assert (state.variables[:, 0] > last.variables[:, 0]).any()
    slope = (forces(u + h * du) - forces(u - h * du)) / (2 * h)
    found = np.einsum("nab,nb->na", now.tangent(u), du)
    np.testing.assert_allclose(found, slope, atol=2e-6 * np.abs(slope).max())


@together("word", ["MI_PAS", "FIN_PAS"])
@together("law", ["kinematic", "cone"])
@together("mesh", ["strain", "stress", "space"])
def test_what_turns_on_its_way_gets_the_same_stresses_turned(mesh, law, word):
    zone, blank, cells = zone_of(mesh, law, word)
    path = [moved(cells, 0.05, 1), moved(cells, 0.05, 1) + moved(cells, 0.04, 2)]
    ends = []
    for angles in ((0.0, 0.0), (1.1, 2.5)):
        before, last = 0.0 * path[0], blank
        for angle, v in zip(angles, path, strict=True):
            u, R = turned(cells, angle, v)
            last, _ = zone.respond(before, u, last, 1.0)
            before = u
        ends.append((last, zone.shown(before, last), R))
    (straight, plain, _), (other, seen, R) = ends
    np.testing.assert_allclose(other.variables, straight.variables, atol=1e-12)
    wide = np.eye(3)
    wide[: len(R), : len(R)] = R
    names = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)][: plain.shape[1]]
    T = np.zeros((*plain[:, 0].shape, 3, 3))
    for row, (i, j) in enumerate(names):
        T[..., i, j] = T[..., j, i] = plain[:, row]
    T = wide @ T @ wide.T
    np.testing.assert_allclose(seen, np.stack([T[..., i, j] for i, j in names], 1), atol=1e-12)


@together("steps", [1, 4])
@together("word", ["MI_PAS", "FIN_PAS"])
def test_flow_keeps_the_volume_whatever_the_steps(word, steps):
    """Stretched at a volume that is kept, then to 1.02 of it: that alone is pressure."""
    zone, last, cells = zone_of("space", word=word)
    before = 0.0 * stretched(cells, 1, 1, 1)
    for share in np.arange(1, steps + 1) / steps:
        u = stretched(cells, 0.4**share, 2.0**share, (1.02 / 0.8) ** share)
        last, _ = zone.respond(before, u, last, 1.0)
        before = u
    mean = last.stress[:, :3].mean(axis=1)
    np.testing.assert_allclose(mean, 5.0 / (3 * 0.4) * np.log(1.02), rtol=1e-12)
    assert np.abs(last.stress).max() < 0.3
    if word == "FIN_PAS":
        np.testing.assert_allclose(zone.shown(u, last)[:, :3].mean(axis=1), mean[0], rtol=1e-12)


def test_simple_shear_follows_dienes():
    """Dienes (1979): 4 G (cos 2b ln cos b + b sin 2b - sin^2 b), 2 tan b the shear of the body."""
    zone, last, cells = zone_of("strain", "elastic", "FIN_PAS")
    before, G, shear = 0.0 * moved(cells, 1.0, 1), 5.0 / 2.6, 3.0
    for amount in np.linspace(0.0, shear, 201)[1:]:
        u = np.zeros_like(cells)
        u[..., 0] = amount * cells[..., 1]
        u = u.reshape(len(cells), -1)
        last, _ = zone.respond(before, u, last, 1.0)
        before = u
    b = np.arctan(0.5 * shear)
    along = 4 * G * (np.cos(2 * b) * np.log(np.cos(b)) + b * np.sin(2 * b) - np.sin(b) ** 2)
    across = 2 * G * np.cos(2 * b) * (2 * b - 2 * np.tan(2 * b) * np.log(np.cos(b)) - np.tan(b))
    seen = zone.shown(before, last)[0]
    np.testing.assert_allclose(seen[0], along, rtol=2e-4)
    np.testing.assert_allclose(seen[1], -along, rtol=2e-4)
    np.testing.assert_allclose(seen[3], across, rtol=2e-4)


@together("word, share", [("FIN_PAS", 0.0), ("MI_PAS", 0.5)])
def test_elastic_stretch_between_rigid_walls(word, share):
    """Cauchy's stress `lambda^share D ln lambda`: for MI_PAS D (lambda - 1) but for third order."""
    zone, blank, cells = zone_of("space", "elastic", word)
    u = stretched(cells, 1.1, 1.0, 1.0)
    last, _ = zone.respond(0.0 * u, u, blank, 1.0)
    D = 5.0 * 0.7 / (1.3 * 0.4)
    seen = zone.shown(u, last)
    np.testing.assert_allclose(seen[:, 0], D * np.log(1.1) * 1.1**share, rtol=1e-12)
    if share:
        np.testing.assert_allclose(seen[:, 0], 0.1 * D, rtol=5e-4)


@together("word", ["MI_PAS", "FIN_PAS", "TOTAL"])
@together("mesh", MESH)
def test_given_stresses_are_shown_at_their_displacement(mesh, word):
    zone, blank, cells = zone_of(mesh, "kinematic", word)
    u = turned(cells, 0.0 if mesh == "ring" else 2.0, moved(cells, 0.05, 5))[0]
    last, _ = zone.respond(0.0 * u, 0.9 * u if mesh == "ring" else u, blank, 1.0)
    again = zone.taken(zone.shown(u, last), u, last)
    np.testing.assert_allclose(again, last.stress, atol=1e-12)


def test_matter_turned_inside_out_has_no_answer():
    """Its point of departure stays, so that the step can be cut."""
    zone, blank, cells = zone_of("strain")
    before, u = stretched(cells, 1.1, 1), stretched(cells, -1, 1)
    with pytest.raises(InsideOutError):
        zone.respond(before, u, blank, 1.0)
    places = np.arange(u.size, dtype=np.int32)[None]
    bulk = FiniteBulk((), (), u.size, {}, (), (zone,), (places,))
    answer = bulk.respond((before[0], blank), (u - before)[0], 1.0)
    assert np.isnan(answer.force).all()
    assert answer.state[1] is blank
    expected = zone.standing(before, blank).tangent(before)[0]
    np.testing.assert_allclose(answer.tangent.toarray(), expected, atol=1e-12)
